"""What a kind of answer says about itself."""

import inspect

import numpy as np

from ..canonical import array_of
from ..running import NONE, explain_call, overwrite_freed_memory

_EMIT = 'from nbclassroom.autograder.sandbox.inside.check_cell import emit\n\nemit({function}, "{kind}")'


class Kind:
    """A kind of answer, with what most kinds need; a folder changes what is particular about its kind.

    `answer` is a learner's, as the notebook has it; a call is a CaseCall, and `calls` are all of a check.
    Each kind defines `name`. What none can change: an answer binds the name of its task, and gets its points
    from checks, unless a person grades it.
    """

    name: str  # as `subject` in a declaration
    noun = "function"  # what texts call an answer
    kernel_modules: tuple[str, ...] = ()  # modules of the folder, which the kernels that grade need
    sensors: tuple[str, ...] = ()  # what an answer may observe, of which a declaration names some
    expects_values = True  # whether what the solution gives is expected; else thresholds judge
    shares_kernel = True  # whether checks run one after another in one process
    shows_values = False  # whether its values are shown and explained
    tries_changes = False  # whether one change is searched that makes it right
    has_sentences = False  # for what differs, so that declared mistakes are not needed
    explains_enough = False  # of a call that returned, so that hints are not needed
    refuses_parts = False  # whether its check does not know all that an answer may use
    shows_last_prints = False  # of what an answer printed, not the first ones
    not_attempted = "not attempted yet"
    # By the lines of a rubric: nothing is run, no case is declared, and look_at(exercise) is what `check`
    # shows of it.
    graded_by_person = False
    cell_kinds: tuple[str, ...] = ("code",)  # of the cells with the stub and with the solution

    def declaration_rules(self, function, points, rubric):
        """(whether an argument of a declaration is wrong, what is wrong with it) of each rule."""
        is_name = isinstance(function, str) and function.isidentifier()
        yield not is_name, f"function={function!r}, expected the name of a function"
        yield bool(points or rubric), "points and rubric are declared for subject='written' only"

    def name_of(self, function):
        """How texts name an answer, such as double()."""
        return f"{function}()"

    def can_be_answer(self, value):
        """Whether a value is of this kind."""
        return callable(value)

    def modules(self):
        """Modules that each answer may use."""
        return ()

    def prepare(self):
        """Make importable what answers import."""

    def checked_inputs(self, case, calls, place):
        """What inputs(rng) gave, a list of tuples; MasterError: `place` declares something wrong."""
        return calls

    def has_inputs(self, calls):
        """Whether an answer gets something in a case with these arguments, which its seed may draw."""
        return True

    def seconds_of(self, exercise, case):
        """Processor time of a case in grading, seconds."""
        return exercise.time_limit * len(case.calls)

    def simulated_seconds(self, exercise):
        """How long a robot drives in all cases."""
        return 0.0

    def argument_names(self, answer):
        """The names of an answer's arguments; [] if they are not known."""
        try:
            return list(inspect.signature(answer).parameters)
        except (TypeError, ValueError):
            return []

    def run(self, answer, *arguments):
        """What an answer does with the arguments of a call, as a value."""
        return answer(*arguments)

    def check_source(self, exercise):
        """The source of the cell that checks a case in grading."""
        return _EMIT.format(function=exercise.function, kind=self.name)

    def partner(self, exercise, case):
        """What a graded answer talks to in a case; None: it gets the arguments, and its values come back."""
        return None

    def run_cases(self, exercise, answer):
        """The CaseCalls of an answer in an exercise's cases.

        None follows a call that does not end in time, or is not attempted.
        """
        calls = []
        pairs = [(case, expected) for case in exercise.cases for expected in case.calls]
        for case, expected in pairs:
            overwrite_freed_memory(expected.result.value)
            call = exercise.judged_call(answer, case, expected)
            calls.append(call)
            if call.result.timed_out or call.result.error == "NotImplementedError":
                break  # a learner waits for one time limit, not for one per call
        return calls

    def draw_for_key(self, exercise, seed, run_solution):
        """{id of a case: its ExpectedCalls} in a key; those left out are run."""
        return {}

    def seconds_for_key(self, exercise):
        """About how long a key needs for an exercise on two quiet cores, beside its runs."""
        return 0.0

    def known_mistake(self, exercise, calls):
        """The declared mistake that explains the CaseCalls of an answer, or None.

        A mistake explains an answer if both do the same in every call. It may also be the only mistake that
        does the same in every call in which the answer returned a value, unless these are arrays of one
        value. First a mistake with the same types is looked for; then one with the same values, unless they
        are right and only their type is not.
        """
        missing = (None,) if any(one.expected.value == NONE for one in calls) else (None, NONE)
        returned = [case_call for case_call in calls if case_call.result.value not in missing]
        is_right = all(case_call.passed for case_call in returned)
        for exact_type in (True,) if all(one.has_right_values for one in returned) else (True, False):
            matches = _mistakes_like(exercise, calls, exact_type)
            if not matches and not is_right and not all(map(_is_constant, returned)):
                matches = _mistakes_like(exercise, returned, exact_type)
                matches = matches if len(matches) == 1 else []
            if matches:
                return matches[0]
        return None

    def explain(self, exercise, call):
        """What went wrong in a call, in a sentence or two; "" if nothing did."""
        return explain_call(call.result, call.difference, exercise.answer_name)

    def advice_on_error(self, exercise, result):
        """What the exception of a CallResult means, "" if nothing is certain."""
        from ..error_advice import advice_on

        about = (result.error, result.message, result.line, exercise.names)
        return advice_on(*about, exercise.function, result.closest)

    def common_failure(self, exercise, calls):
        """What went wrong in the same way in all calls, "" if nothing did."""
        return ""

    def images_of(self, exercise, call):
        """The AnswerImages of the failed call that is shown."""
        return ()

    def blocks_of_all(self, calls):
        """Blocks of a Document on all calls."""
        return ()


def _mistakes_like(exercise, calls, exact_type):
    """The declared mistakes that do the same in all these calls."""
    return [
        mistake
        for mistake in exercise.mistakes
        if all(_does_the_same(mistake, case_call, exact_type) for case_call in calls)
    ]


def _does_the_same(mistake, case_call, exact_type):
    position = [id(expected.arguments) for expected in case_call.case.calls].index(id(case_call.arguments))
    predicted = mistake.results[case_call.case.id][position]
    return case_call.result.matches(predicted, case_call.case.tolerance, exact_type=exact_type)


def _is_constant(case_call):
    """Whether an answer is an array of equal values, as many mistakes make one."""
    values = array_of(case_call.result.value)
    return values is not None and len(np.unique(values)) < 2
