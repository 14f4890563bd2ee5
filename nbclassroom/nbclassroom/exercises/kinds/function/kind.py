import numpy as np

from ...canonical import array_of
from ...running import NONE, explain_call, overwrite_freed_memory
from ..kind import Kind as AnyKind

_EMIT = "from nbclassroom.autograder.sandbox.inside.check_cell import emit\n\nemit({function}{name})"


class Kind(AnyKind):
    """A function, whose values are compared; also what nodes and packages have in common with it."""

    name = "function"
    shows_values = tries_changes = True

    def check_source(self, exercise):
        name = "" if self.name == "function" else f', "{self.name}"'
        return _EMIT.format(function=exercise.function, name=name)

    def run_cases(self, exercise, answer, progress=None):
        """Until a call does not end in time, or is not attempted."""
        calls = []
        pairs = [(case, expected) for case in exercise.cases for expected in case.calls]
        for case, expected in pairs:
            overwrite_freed_memory(expected.result.value)
            call = exercise.judged_call(answer, case, expected)
            calls.append(call)
            if call.result.timed_out or call.result.error == "NotImplementedError":
                break  # a learner waits for one time limit, not for one per call
        return calls

    def known_mistake(self, exercise, calls):
        """The declared mistake that explains the CaseCalls of an answer, or None.

        A mistake explains an answer if both do the same in every call. It may also be the only mistake that
        does the same in every call in which the answer returned a value, unless these are arrays of one
        value. First a mistake with the same types is looked for; then one with the same values, unless they
        are right and only their type is not.
        """
        returned = [case_call for case_call in calls if case_call.result.value not in (None, NONE)]
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
        return explain_call(call.result, call.difference, exercise.answer_name)

    def images_of(self, exercise, call):
        """The images of the first part of the answer that is a wrong image; else those that were given."""
        # Here, because it imports Pillow: the processes that grade import this package, and draw nothing.
        from ...answer_images import images_of_call

        return images_of_call(exercise.names, call) if call.result.finished else ()


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
