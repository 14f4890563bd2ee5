"""Which declared mistake explains an answer."""

import numpy as np

from .canonical import array_of

_NONE = {"type": "None"}


def known_mistake(exercise, calls):
    """The declared mistake that explains the CaseCalls of an answer, or None.

    A mistake explains an answer if both do the same in every call. It may also be the only mistake that does
    the same in every call in which the answer returned a value, unless these are arrays of one value. First a
    mistake with the same types is looked for; then one with the same values, unless they are right and only
    their type is not.
    """
    returned = [case_call for case_call in calls if case_call.result.value not in (None, _NONE)]
    is_right = all(case_call.passed for case_call in returned)
    for exact_type in (True,) if all(map(has_right_values, returned)) else (True, False):
        matches = _mistakes_like(exercise, calls, exact_type)
        if not matches and not is_right and not all(map(_is_constant, returned)):
            matches = _mistakes_like(exercise, returned, exact_type)
            matches = matches if len(matches) == 1 else []
        if matches:
            return matches[0]
    return None


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


def has_right_values(case_call):
    """Whether values are right, in a type that may be wrong, also if that type has cut them."""
    expected, result = case_call.expected, case_call.result
    if result.matches(expected, case_call.case.tolerance, exact_type=False):
        return True
    values, actual = array_of(expected.value), array_of(result.value)
    if values is None or actual is None:
        return False
    with np.errstate(all="ignore"):
        return np.array_equal(values.astype(actual.dtype), actual)
