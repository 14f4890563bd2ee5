"""What is certain about a wrong answer: from its type, its shape, its dtype, and where its values are wrong.

A sentence is given only if it is true of the values in every call: a wrong name for a mistake costs a learner
more than none.
"""

import math
from dataclasses import dataclass
from itertools import chain, combinations, permutations
from typing import Any

import numpy as np

from .canonical import array_of
from .comparison import as_float, as_type_of, compare, differing, kind_of, named_items

_COINCIDENCE = 0.01
_MANY = 4  # wrong values, of which a sentence is said that may be chance for fewer
UNCHANGED = "unchanged: what you compute does not get into it"
_RIGHT = "The values are right"
_TRANSPOSED = "Rows and columns are exchanged: your result is the expected one, transposed."
_FUNCTIONS: tuple[str, ...] = ("function", "builtin_function_or_method", "method")
_FUNCTIONS += ("numpy.ufunc", "numpy._ArrayFunctionDispatcher")
_NUMBERS, _SEQUENCES = ("int", "float"), ("tuple", "list")
_NOUNS = {
    **{"ndarray": "an array", "int": "a number", "float": "a number", "str": "a text", "dict": "a dict"},
    **{"bool": "True or False", "bytes": "bytes", "set": "a set"},
    **dict.fromkeys(_FUNCTIONS, "a function itself"),
}
_AROUND = dict.fromkeys((2, 4), ": the border of the image is missing.")
_AROUND |= dict.fromkeys((-2, -4), ": is it padding?")
_SIDES: dict[str, Any] = {"in the first row": np.s_[:1], "in the last row": np.s_[-1:]}
_SIDES |= {"in the first column": np.s_[:, :1], "in the last column": np.s_[:, -1:]}
_ANY_SIDE = ("on the border of the image",)
_ONE_BESIDE = {
    (1,): "Each wrong value is one too large: is it rounded up, or counted from the wrong number?",
    (-1,): "Each wrong value is one too small: is it rounded down, or counted from the wrong number?",
}
_ONE_FACTOR = (
    "In each call, all your values are the expected ones times one number. Is a division or a multiplication"
    " missing at the end, or one too many?"
)


@dataclass(frozen=True)
class Diagnosis:
    """What is certain about an answer."""

    text: str = ""  # sentences, "" if nothing is certain
    replaces_hint: bool = False  # they say what to repair
    on_border: bool = False  # all wrong values lie on the borders of images


def diagnose(calls, shown, names=(), *, exact_type=True):
    """The Diagnosis of a wrong answer, from its CaseCalls and the failed one that is shown."""
    expected, actual = shown.expected.value, shown.result.value
    if kind_of(actual) == "None":
        return Diagnosis(replaces_hint=bool(shown.result.printed))
    tolerance = shown.case.tolerance
    parts = side_by_side(expected, actual)
    if not exact_type:
        parts = [(form, as_type_of(form, actual_form)) for form, actual_form in parts]
    differences = [(compare(*pair, tolerance, exact_type=exact_type), pair) for pair in parts]
    # The first pair of each kind of difference
    wrong = {difference.kind: pair for difference, pair in reversed(differences) if difference}
    returned = [call for call in calls if call.result.finished]
    advice = _advice_on_constant(calls, parts)
    if advice:
        return Diagnosis(advice)
    # If the type need not be exact, a dtype that cannot hold the values shows as wrong values.
    if wrong.keys() <= {"dtype", "value"}:
        different = [pair for difference, pair in differences if difference]
        advice = _advice_on_dtypes(different, tolerance, exact="dtype" in wrong)
        return advice if advice.text or "dtype" in wrong else _diagnose_values(returned, names)
    if "shape" in wrong:
        expected, actual = wrong["shape"]
        return _diagnose_shape(expected, actual, shown.arguments, names, is_turned=_are_turned(returned))
    other_pair = next(pair for difference, pair in differences if difference and difference.kind != "value")
    return _advice_on_part(expected, *other_pair)


def side_by_side(expected: dict, actual: dict) -> list[tuple[dict, dict]]:
    """The parts of two answers in pairs of forms; one pair of the wholes if their containers differ."""
    items, actual_items = named_items(expected), named_items(actual)
    same_names = [name for name, _ in items] == [name for name, _ in actual_items]
    if not items or kind_of(expected) != kind_of(actual) or not same_names:
        return [(expected, actual)]
    parts = zip(items, actual_items, strict=True)
    return [pair for (_, form), (_, actual_form) in parts for pair in side_by_side(form, actual_form)]


# ---------------------------------------------------------------- type


def _advice_on_part(whole, expected, actual):
    text = _advice_on_type(expected, actual)
    text = text if expected is whole else text.replace("You return", "There you return")
    return Diagnosis(text, replaces_hint=bool(text) and kind_of(actual) != "None")


def _advice_on_type(expected, actual):
    kind, actual_kind = kind_of(expected), kind_of(actual)
    if actual.get("too_large"):
        return ""
    if kind in _SEQUENCES and actual_kind in _SEQUENCES:
        count = len(expected["items"])
        is_right = len(actual["items"]) == count
        return "" if is_right else f"You return {_noun(actual)}, and the task asks for {count}."
    if kind in _SEQUENCES and actual_kind == "ndarray":
        count = len(expected["items"])
        both = "both" if count == 2 else "them"
        text = f"You return one array, and the task asks for {count}: return {both}"
        return f"{text}, with a comma between them."
    if kind == "ndarray" and actual_kind in _SEQUENCES:
        shapes = [form.get("shape") for form in actual.get("items", ())]
        if expected["shape"] in shapes:
            return (
                f"You return {_noun(actual)}. The one at index {shapes.index(expected['shape'])} has the"
                " shape of the task: return it alone."
            )
        dtype = expected["dtype"]
        return f"A {actual['type']} is not an array. Make it one: np.array(..., dtype=np.{dtype})."
    if kind == "ndarray" and actual_kind in (*_NUMBERS, "bool"):
        return "You return one number, not an array. Which line makes one number of many?"
    wanted = _wanted(expected, actual)
    text = f"You return {_noun(actual)}, and the task asks for {wanted}."
    return text.replace("?.", "?") if wanted not in ("", _noun(actual)) else ""


def _wanted(expected, actual):
    """What the task asks for, the end of a sentence; "" for what no task asks for."""
    kind, actual_kind = kind_of(expected), kind_of(actual)
    if kind == "str":
        return "a text, such as its name" if actual["type"] in _FUNCTIONS else "a single text"
    if kind in (*_NUMBERS, "bool") and actual_kind == "str":
        return "a number: return it without quotes, not an f-string"
    if kind in _NUMBERS and actual_kind == "ndarray":
        return "a number: is a sum, a mean or an index missing, or an axis too many?"
    if kind in (*_NUMBERS, "bool") and actual_kind in _SEQUENCES:
        return "one number alone"
    return _noun(expected) if kind in (*_NUMBERS, *_SEQUENCES, "bool", "ndarray") else ""


def _noun(form):
    kind = form["type"] if form.get("opaque") else kind_of(form)
    if kind in _SEQUENCES:
        count = len(form.get("items", ()))
        return f"{count} value{'s' * (count != 1)} (a {kind})"
    return _NOUNS.get(kind, f"a value of type {kind}")


# ---------------------------------------------------------------- dtype


def _advice_on_dtypes(pairs: list[tuple[dict, dict]], tolerance: float, *, exact: bool) -> Diagnosis:
    """What to do if all that differs is the dtype, or the dtype with the values that it cannot hold."""
    differences = [compare(*pair, tolerance) for pair in pairs]
    if any(difference is None or difference.kind != "dtype" for difference in differences):
        return Diagnosis()
    texts = dict.fromkeys(_advice_on_dtype(*pair, tolerance) for pair in pairs)
    if "" in texts:
        others = [compare(*pair, tolerance, exact_type=False) for pair in pairs if exact]
        messages = [other.message for other in others if other and other.kind == "value"]
        return Diagnosis(f"Not only the dtype: {messages[0]}." if messages else "")
    wrong = [text for text in texts if not text.startswith(_RIGHT)]
    return Diagnosis(" ".join(wrong or texts), replaces_hint=True)


def _advice_on_dtype(expected, actual, tolerance):
    """What to do about a dtype if nothing else is wrong; "" if the values are wrong too."""
    dtype, actual_dtype = expected["dtype"], actual["dtype"]
    values, actual_values = array_of(expected), array_of(actual)
    if values is None or actual_values is None:
        return ""
    same = _same(values, actual_values, tolerance)
    if dtype == "bool" and np.array_equal(actual_values != 0, values):
        return (
            f"The task asks for bool, True and False, and you return numbers ({actual_dtype}). A"
            f" comparison such as a > b is bool already."
        )
    if actual_dtype == "bool" and np.array_equal(values != 0, actual_values):
        text = f"The task asks for numbers ({dtype}), and you return True and False (bool)"
        levels = set(np.unique(values).tolist())
        if levels <= {0, 255} or levels <= {0, 1}:
            return f"{text}: write np.where(mask, {max(levels)}, 0).astype(np.{dtype})."
        return f"{text}. Keep the numbers themselves: an array made like a mask has only these two."
    if same:
        text = f"{_RIGHT}; only the dtype is not: you return {actual_dtype}."
        return f"{text} End with .astype(np.{dtype})."
    if values.dtype.kind == "f" and np.abs(values - actual_values).max(initial=0) < 1:
        return f"The fractions are lost: you return {actual_dtype}, and the task asks for {dtype}."
    if values.dtype.kind in "iu" and np.array_equal(values.astype(actual_values.dtype), actual_values):
        return f"The values do not all fit into {actual_dtype}, and were cut. Make the result {dtype}."
    return ""


def _same(values, actual, tolerance=0.0):
    """Whether two arrays of one shape agree as numbers, whatever their dtypes."""
    if values.shape != actual.shape:
        return False
    with np.errstate(all="ignore"):
        return not differing(values.astype(np.float64), actual.astype(np.float64), tolerance).any()


# ---------------------------------------------------------------- shape


def _are_turned(calls):
    """Whether all arrays have the numbers of their rows and columns exchanged."""
    shapes = [(np.shape(expected), np.shape(actual)) for expected, actual, _ in _arrays(calls)]
    return all(actual == (*shape[1::-1], *shape[2:]) for shape, actual in shapes if len(shape) > 1)


def _diagnose_shape(expected, actual, arguments, names, *, is_turned):
    given = [np.shape(value) for value in arguments if isinstance(value, np.ndarray)]
    rules = _shape_rules(expected, actual, given, names[0] if names else "", is_turned)
    text = next((advice for holds, advice in rules if holds), "")
    return Diagnosis(text, replaces_hint=bool(text) and not text.startswith("Your result has"))


def _shape_rules(expected, actual, given, name, is_turned):
    """(whether it holds, advice) of each rule, the surest first; `given` are the shapes of the arguments."""
    shape, actual_shape = tuple(expected["shape"]), tuple(actual["shape"])
    values, actual_values = array_of(expected), array_of(actual)
    is_transposed = actual_shape == shape[::-1] and values is not None and _same(values.T, actual_values)
    yield is_transposed, _TRANSPOSED
    if len(shape) == 3 and values is not None and actual_values is not None:
        orders = (_same(values.transpose(order), actual_values) for order in permutations(range(3)))
        yield any(orders), f"{_RIGHT}; the axes stand in another order: rows come first, channels last."
    has_shape = is_turned and len(shape) > 1 and actual_shape == (*shape[1::-1], *shape[2:]) != shape
    text = "Rows and columns are exchanged in the shape of your result: the number of rows comes first."
    yield has_shape, text
    if values is not None and actual_values is not None and len(np.unique(values)) > 2:
        text = f"{_RIGHT} and in the right order; only the shape is not: reshape them."
        yield _same(values.ravel(), actual_values.ravel()), text
    first = given[0] if given and name else ()
    if len(first) > len(shape) and actual_shape == first[1:]:
        text = "Axis 0, the rows, is gone from your result: "
        yield len(first) == 2, f"{text}axis=0 goes along the rows, and axis=1 along the columns."
        yield (
            True,
            f"{text}{name}[0] is the first row, and axis=0 goes along the rows. The channels are the last"
            f" axis: {name}[..., 0], axis=-1.",
        )
    text = "One axis is too many: did you make your result with the shape of a colour image?"
    yield len(shape) == 2 and actual_shape[:-1] == shape, text
    if len(shape) == 3:
        text = f"The axis of the channels is missing: each pixel has {shape[2]} values."
        yield actual_shape == shape[:2], text
    if len(shape) == len(actual_shape):
        yield from _size_rules(shape, actual_shape, first)


def _size_rules(shape, actual_shape, first):
    if len(shape) == 1:
        text = f"Your result has {actual_shape[0]} values, and the task asks for {shape[0]} here"
        yield True, f"{text}. Does their number depend on the input?"
    if len(shape) >= 2:
        gaps = (actual - expected for actual, expected in zip(actual_shape, shape, strict=True))
        changes = [_surplus(gap, noun) for gap, noun in zip(gaps, ("row", "column"), strict=False) if gap]
        missing_rows, missing_cols = shape[0] - actual_shape[0], shape[1] - actual_shape[1]
        is_all_around = missing_rows == missing_cols and shape[:2] == first[:2]
        end = _AROUND.get(missing_rows if is_all_around else 0, ".")
        yield changes, f"Your result has {' and '.join(changes)}{end}"


def _surplus(count, noun):
    """`2 rows too many`, `one column too few`"""
    number = f"one {noun}" if abs(count) == 1 else f"{abs(count)} {noun}s"
    return f"{number} too {'many' if count > 0 else 'few'}"


# ---------------------------------------------------------------- values


def _diagnose_values(calls, names):
    """The first sentence that is true of every call, and where the wrong values lie."""
    forms = [(call.expected.value, call.result.value) for call in calls]
    kinds, tolerance = {kind_of(form) for form in chain(*forms)}, calls[0].case.tolerance
    if any(form.get("too_large") for form in chain(*forms)):
        return Diagnosis()
    pairs = [pair for whole in forms for pair in side_by_side(*whole) if compare(*pair, tolerance)]
    are_numbers = pairs and all(kind_of(form) in _NUMBERS for pair in pairs for form in pair)
    text = _relation_of_angles(pairs) if are_numbers else ""
    if text or kinds <= {*_NUMBERS}:
        return Diagnosis(text or _relation_of_numbers(forms))
    text = _unchanged(calls, names) or _relation_of_arrays(calls) or _relation_of_lists(forms)
    # A sentence that only asks ("Is it ...?") leaves the hint in.
    return Diagnosis(text, replaces_hint="?" not in text) if text else _place(calls)


def _unchanged(calls, names):
    for number, name in enumerate(names):
        pairs = [(call.arguments[number : number + 1], array_of(call.result.value)) for call in calls]
        if all(
            given and isinstance(given[0], np.ndarray) and values is not None and _same(given[0], values)
            for given, values in pairs
        ):
            return f"Your result is {name}, {UNCHANGED}."
    return ""


def _advice_on_constant(calls, parts):
    forms = [(call.expected.value, call.result.value) for call in calls]
    if len(forms) < 2 or all(expected == forms[0][0] for expected, _ in forms):
        return _advice_on_equal_parts(parts)
    if not all(call.result.finished for call in calls):
        return ""
    if any(actual != forms[0][1] or actual.get("opaque") for _, actual in forms):
        return _advice_on_equal_parts(parts)
    value = forms[0][1].get("value")
    text = "the same" if value is None else repr(value) if isinstance(value, str) else str(value)
    return f"Your function returns {text} for every input of these checks."


def _advice_on_equal_parts(parts):
    (expected, actual), *others = parts
    are_alike = others and all(form == actual for _, form in others) and kind_of(actual) == "ndarray"
    if not are_alike or all(form == expected for form, _ in others):
        return ""
    return "All that you return is the same array: does it have two names?"


def _number_pairs(forms):
    """(expected, actual) numbers, two arrays; of nan if one of them is not finite."""
    numbers = np.array([[as_float(form["value"]) for form in pair] for pair in forms])
    return numbers.T if np.isfinite(numbers).all() else numbers.T * np.nan


def _relation_of_angles(wrong_pairs):
    """How wrong numbers are right as angles; "" if they are not."""
    expected, actual = _number_pairs(wrong_pairs)
    turns = ((actual - expected) / math.tau).round()
    if turns.all() and np.allclose(actual, expected + turns * math.tau, rtol=0, atol=1e-6):
        return "Your angle is a whole turn (2π) away: bring it into the range that the task asks for."
    for name, other, change in (("degrees", "radians", np.degrees), ("radians", "degrees", np.radians)):
        if np.allclose(actual, change(expected), rtol=1e-6, atol=0):
            return f"Your angle is in {name}, and the task asks for {other}."
    return ""


def _relation_of_numbers(forms):
    expected, actual = _number_pairs(forms)
    if kind_of(forms[0][0]) == "int" and abs(np.unique(actual - expected)).tolist() == [1.0]:
        return f"Your number is one too {'large' if actual[0] > expected[0] else 'small'}, in every check."
    if expected.any() and np.allclose(actual, expected * 100, rtol=1e-6, atol=0):
        return "Your number is 100 times the expected number (is it in percent?), in every check."
    return ""


def _arrays(calls):
    """(expected, actual, tolerance) of each part of all calls; an array, or None."""
    return [
        (array_of(expected), array_of(actual), call.case.tolerance)
        for call in calls
        for expected, actual in side_by_side(call.expected.value, call.result.value)
    ]


def _relation_of_arrays(calls):
    """A relation between all arrays of all calls and the expected ones."""
    arrays = [(expected, actual) for expected, actual, _ in _arrays(calls)]
    if any(a is None or b is None or (a.shape, a.dtype) != (b.shape, b.dtype) for a, b in arrays):
        return ""
    if sum(expected.size for expected, _ in arrays) < 4:
        return ""
    for text, change in _RELATIONS:
        if all(_same(change(_wide(expected)), _wide(actual)) for expected, actual in arrays):
            return text
    if text := _one_value_for_another(arrays):
        return text
    if all(_is_multiple(*pair) for pair in arrays):
        return _ONE_FACTOR
    gaps = {gap for expected, actual in arrays for gap in np.unique(_wide(actual) - _wide(expected))} - {0}
    has_levels = all(expected.dtype.kind in "iu" and len(np.unique(expected)) > 2 for expected, _ in arrays)
    return _ONE_BESIDE.get(tuple(gaps), "") if has_levels else ""


def _relation_of_lists(forms):
    """How all wrong lists are the expected ones the other way round, as wholes or in each part; or ""."""
    wrong = [(expected.get("items", ()), actual.get("items", ())) for expected, actual in forms]
    wrong = [(expected, actual) for expected, actual in wrong if expected != actual]
    if wrong and all(actual == expected[::-1] for expected, actual in wrong):
        return "Your result is the other way round: it begins with what should be its last value."
    turned = ([part | {"items": part.get("items", ())[::-1]} for part in parts] for parts, _ in wrong)
    if wrong and all(parts == actual for parts, (_, actual) in zip(turned, wrong, strict=True)):
        return "In each part of this result, the first and the last value are exchanged."
    return ""


def _one_value_for_another(arrays):
    """The sentence if only the values of one expected value are wrong, all in one way; or only signs are."""
    masks = [(expected, actual, expected != actual) for expected, actual in arrays]
    wrong = {pair for one, other, mask in masks for pair in zip(one[mask], other[mask], strict=True)}
    right = {value for expected, _, mask in masks for value in expected[~mask]}
    count = sum(mask.sum() for *_, mask in masks)
    if len(wrong) != 1 or count < _MANY or not right or {value for value, _ in wrong} & right:
        return _only_signs(arrays)
    ((value, actual_value),) = wrong
    return f"Where {value} is expected, your result has {actual_value}. Everything else is right."


def _only_signs(arrays):
    is_so = all(_same(*(np.abs(_wide(values)) for values in pair)) for pair in arrays)
    return "Only signs are wrong: without them, all your values are right." if is_so else ""


def _is_multiple(expected, actual):
    """Whether an array of floats is the expected one times a number other than 0."""
    values, actual_values = _wide(expected).ravel(), _wide(actual).ravel()
    if expected.dtype.kind != "f" or len(np.unique(values)) < 3:
        return False
    factor = values @ actual_values / (values @ values)
    return factor != 0 and np.allclose(actual_values, factor * values, rtol=1e-6, atol=0)


def _wide(values):
    return values.astype(np.float64)


def _mirrored(axis):
    return lambda values: np.flip(values, axis) if values.ndim > axis else values + np.nan


# (what the learner reads, the wrong values computed from the expected ones)
_RELATIONS = (
    ("Every value of your result is 0: where do they become 0?", lambda values: values * 0),
    ("All signs are exchanged: minus should be plus, and plus minus.", lambda values: -values),
    ("The values are right but for the sign: negative values must stay negative, without abs().", np.abs),
    ("True and False are exchanged.", lambda values: 1 - values),
    (_TRANSPOSED, lambda v: np.swapaxes(v, 0, 1) if v.ndim > 1 else v + np.nan),
    ("Your result is the expected one, mirrored from left to right.", _mirrored(1)),
    ("Your result is the expected one, upside down.", _mirrored(0)),
    ("The channels are in the wrong order: the first and the last are exchanged.", _mirrored(2)),
)


def _place(calls):
    """Where the wrong values of all calls lie, if that tells something."""
    wrong = _wrong_elements(_arrays(calls))
    pixels = [mask.any(axis=2) if mask.ndim == 3 else mask for mask, _ in wrong]
    chances = (_on(mask, _SIDES).mean() ** mask.sum() for mask in pixels)
    if not wrong or not _lie_on(pixels, _SIDES) or math.prod(chances) >= _COINCIDENCE:
        return Diagnosis()
    groups = (names for count in (1, 2) for names in combinations(_SIDES, count))
    sides = " and ".join(next((names for names in groups if _lie_on(pixels, names)), _ANY_SIDE))
    zeros = all(not values[mask].any() for mask, values in wrong)
    left = ", and there your result is 0: is the border never computed?" if zeros else "."
    return Diagnosis(f"Only values {sides} are wrong{left}", on_border=True)


def _wrong_elements(arrays):
    """[(which values are wrong, the values)] of images; [] if one of the arrays is none."""
    if any(a is None or b is None or a.shape != b.shape or a.ndim not in (2, 3) for a, b, _ in arrays):
        return []
    masks = [(differing(*array), array[1]) for array in arrays]
    return [(mask, values) for mask, values in masks if mask.any()]


def _on(mask, names):
    """A mask of these sides of an image."""
    on_sides = np.zeros_like(mask)
    for name in names:
        on_sides[_SIDES[name]] = True
    return on_sides


def _lie_on(masks, names):
    return not any((mask & ~_on(mask, names)).any() for mask in masks)
