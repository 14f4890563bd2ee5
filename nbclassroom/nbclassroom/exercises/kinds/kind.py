"""What a kind of answer says about itself."""

import contextlib
import inspect


class Kind:
    """A kind of answer, with what most kinds need; a folder changes what is particular about its kind.

    `answer` is a learner's, as the notebook has it; a call is a CaseCall, and `calls` are all of a check.
    Each kind defines `name`, and what raises NotImplementedError here. What none can change: an answer binds
    the name of its task, and gets its points from checks, unless a person grades it.
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
    graded_by_person = False  # by the lines of a rubric: nothing is run, and no case is declared
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

    def tolerance(self, declared):
        """The tolerance of a case, from the one that is declared."""
        return declared

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
        raise NotImplementedError

    def partner(self, exercise, case):
        """What a graded answer talks to in a case; None: it gets the arguments, and its values come back."""
        return None

    def progress(self, exercise):
        """A context in which a check runs: gives what takes the share that is done, or None."""
        return contextlib.nullcontext()

    def run_cases(self, exercise, answer, progress=None):
        """The CaseCalls of an answer in an exercise's cases."""
        raise NotImplementedError

    def draw_for_key(self, exercise, seed, run_solution):
        """{id of a case: its ExpectedCalls} in a key; those left out are run."""
        return {}

    def seconds_for_key(self, exercise):
        """About how long a key needs for an exercise on two quiet cores, beside its runs."""
        return 0.0

    def look_at(self, exercise):
        """What `check` shows of an answer that a person grades; only such a kind defines it."""
        raise NotImplementedError

    def known_mistake(self, exercise, calls):
        """The declared Mistake that explains these calls, or None."""
        raise NotImplementedError

    def explain(self, exercise, call):
        """What went wrong in a call, in a sentence or two; "" if nothing did."""
        raise NotImplementedError

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

    def table_of(self, calls):
        """The rows of a table of all calls: (text, whether it is marked) of each cell."""
        return ()

    def images_of_all(self, calls):
        """AnswerImages of all calls."""
        return ()
