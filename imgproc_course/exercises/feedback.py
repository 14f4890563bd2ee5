"""The words and pictures of `check`: the same story as plain text and as HTML, and the same each time.

Nothing that varies from run to run stands in them: no time, no address, no order by chance. nbval compares
them byte for byte.
"""

import base64
import html
import io
import re

import numpy as np

from imgproc_course.exercises.canonical import array_of, canonical
from imgproc_course.exercises.comparison import describe, differing

MOST_NUMBERS = 144  # a larger array is described or drawn, not printed
SMALLEST_PICTURE = 13  # rows and cols; a smaller array is better read as numbers
_LONGEST = 12  # lines of print

_COLOURS = {"passed": "#2e7d32", "failed": "#c62828", "open": "#616161"}


# What NumPy says of a number that an array's type cannot hold.
_TOO_SMALL = re.compile(r"Python integer (-?\d+) out of bounds for (\w+)")


def story_of(outcome, difference, function):
    """What went wrong in one call, in a sentence or two; "" where nothing did.

    Parameters
    ----------
    outcome : Outcome
    difference : Difference or None
    function : str, the function's name
    """
    name = f"{function}()"
    if outcome.timed_out:
        told = f"{name} did not come to an end and was stopped. Is there a loop that never ends?"
        return told + (
            " It could not be stopped: restart the kernel before you go on." if outcome.stuck else ""
        )
    if outcome.error:
        told = f"{name} raised {outcome.error}" + (f": {outcome.message}" if outcome.message else "")
        told += f"\nin your {outcome.line}" if outcome.line else ""
        too_small = _TOO_SMALL.search(outcome.message or "")
        return told + (
            f"\n{too_small[1]} does not fit into {too_small[2]}: widen the array first, as in"
            " astype(np.uint32)."
            if too_small
            else ""
        )
    if outcome.changed:
        first = outcome.changed[0]
        if "." in first or not first.isidentifier():
            return (
                f"{name} changed its input {first}. Only read it; keep what you compute in names of your own."
            )
        return f"{name} changed its input {first}. Work on a copy: begin with {first} = {first}.copy()."
    if difference is None:
        return ""
    if outcome.value["type"] == "None":
        return f"{name} gave back None. Did you forget return?"
    message = difference.message[0].upper() + difference.message[1:] + "."
    return f"In answer{difference.where}: {message}" if difference.where else message


# ---------------------------------------------------------------- the parts of a story


class _Part:
    """A labelled value: `given pixels`, its form, and which elements to mark."""

    def __init__(self, label, form, wrong=None):
        self.label = label
        self.form = form
        self.wrong = wrong


def _parts(result, made):
    forms = [canonical(value, limit=None) for value in made.arguments]
    names = [*result.names, *("" for _ in forms)]
    parts = [_Part(f"given {name}".strip(), form) for name, form in zip(names, forms, strict=False)]
    if made.outcome.finished and made.difference is not None:
        parts.append(_Part("came back", made.outcome.value, _wrong(made)))
        parts.append(_Part("expected", made.expected.value, _wrong(made)))
    return parts


def _wrong(made):
    expected, actual = array_of(made.expected.value), array_of(made.outcome.value)
    if expected is None or actual is None or (expected.shape, expected.dtype) != (actual.shape, actual.dtype):
        return None
    return differing(expected, actual, made.case.tolerance)


def _grid(form, wrong):
    """A small array as rows of (text, marked), or None where it is too large or no grid."""
    values = array_of(form)
    if values is None or values.size == 0 or values.size > MOST_NUMBERS or values.ndim not in (1, 2, 3):
        return None
    wrong = np.zeros(values.shape, bool) if wrong is None else wrong
    if values.ndim == 1:
        values, wrong = values[np.newaxis], wrong[np.newaxis]
    return [
        [_cell(value, mark) for value, mark in zip(*row, strict=True)]
        for row in zip(values, wrong, strict=True)
    ]


def _cell(value, mark):
    text = " ".join(_number(number) for number in np.atleast_1d(value))
    return (f"({text})" if np.ndim(value) else text), bool(np.any(mark))


def _number(value):
    return f"{value:.6g}" if value.dtype.kind == "f" else str(value)


def _short(form):
    """A value that is no grid of numbers, in one line."""
    values = array_of(form)
    if values is not None and values.size:
        return f"{describe(form)}, from {_number(values.min())} to {_number(values.max())}"
    if "fields" in form:
        fields = ", ".join(f"{name}={_value(value)}" for name, value in form["fields"].items())
        return f"an object with the fields {fields}"
    if form["type"] in ("tuple", "list") and len(form.get("items", ())) <= 12:
        return (
            f"a {form['type']} of {len(form['items'])}: {', '.join(_value(item) for item in form['items'])}"
        )
    if form["type"] == "dict" and "items" in form:
        return "a dict: " + ", ".join(f"{_value(key)}: {_value(value)}" for key, value in form["items"])
    return describe(form)


def _value(form):
    if form["type"] == "bytes" and "data" in form and form["length"] <= MOST_NUMBERS:
        return f"bytes({list(base64.b64decode(form['data']))})"
    if form["type"] == "ndarray" and "data" in form:
        values = array_of(form)
        return str(values.tolist()) if values.size <= MOST_NUMBERS else describe(form)
    return (
        repr(form["value"])
        if "value" in form
        else describe(form)
        if "fields" not in form
        else f"({_short(form)})"
    )


def _notes(result):
    name = f"{result.exercise.function}()"
    for module in result.reach.refused:
        yield f"{name} uses {module}. This exercise is to be written without it: grading will not take it."
    for foreign in result.reach.foreign:
        yield (
            f"{name} uses {foreign}, which another cell defines. Grading takes the answer's cell alone:"
            f" define {foreign} in it."
        )


def _story(result, each):
    if each.failed is None:
        return "not run, because the call above did not come to an end"
    return story_of(each.failed.outcome, each.failed.difference, result.exercise.function)


def _headline(result):
    declared = result.exercise
    if not result.attempted:
        return "open", f"{declared.id}: not attempted yet"
    right, count = sum(each.passed for each in result.results), len(result.results)
    if right < count:
        return "failed", f"{declared.id}: {right} of {count} checks pass"
    if not result.passed:
        return "failed", f"{declared.id}: the values are right, but grading would refuse this answer"
    return "passed", f"{declared.id}: {'the check passes' if count == 1 else f'all {count} checks pass'}"


def _footer(result):
    declared = result.exercise
    if not result.attempted:
        return (
            f"Write {declared.function}() in its cell, run that cell, then run this one."
            " (If that cell shows an error, repair it first: Python still has the old function.)"
        )
    if declared.practice:
        return "Practice: no points, no hurry."
    here = sum(case.points for case in declared.public)
    told = f"Points here: {result.points if not result.reach.refused else 0} of {here}."
    hidden = len(declared.hidden)
    if not hidden:
        return told
    checks = "1 more check" if hidden == 1 else f"{hidden} more checks"
    return (
        f"{told} Grading runs {checks} on other inputs, worth {sum(case.points for case in declared.hidden)}."
    )


def _hint(result, made):
    if result.mistake is not None:
        return result.mistake.says
    # An exercise's hint is about wrong values; who got an error, None or another shape has another question.
    is_about_values = made.outcome.finished and not made.outcome.changed and _same_form(made)
    return f"Hint: {made.case.hint}" if made.case.hint and is_about_values else ""


def _same_form(made):
    expected, actual = made.expected.value, made.outcome.value
    return all(expected.get(key) == actual.get(key) for key in ("type", "dtype", "shape"))


def _asides(made):
    if made.outcome.warned:
        yield f"NumPy or Python warned: {made.outcome.warned}"
    if made.outcome.printed.strip():
        lines = made.outcome.printed.rstrip().splitlines()
        cut = ["…"] if len(lines) > _LONGEST else []
        yield "Your function printed:\n" + "\n".join(lines[:_LONGEST] + cut)


# ---------------------------------------------------------------- plain text


def as_text(result):
    """A CheckResult as plain text."""
    _, headline = _headline(result)
    lines = [f"{headline}."]
    detailed = False
    for each in result.results:
        lines.append(f"{'✓' if each.passed else '✗'} {each.case.title}")
        if each.passed:
            continue
        lines.append(_indented(_story(result, each)))
        if not detailed:
            lines += [_indented(text) for text in _details_as_text(result, each.failed)]
            detailed = True
    lines += _notes(result)
    lines.append(_footer(result))
    return "\n".join(line for line in lines if line)


def _details_as_text(result, made):
    for part in _parts(result, made):
        grid = _grid(part.form, part.wrong)
        if grid is None:
            yield f"{part.label}: {_short(part.form)}"
            continue
        width = max(len(text) for row in grid for text, _ in row) + 1
        rows = [
            "".join(f"{text:>{width}}{'*' if marked else ' '}" for text, marked in row).rstrip()
            for row in grid
        ]
        yield f"{part.label}: {describe(part.form)}" + (", * differs" if _any(part.wrong) else "")
        yield "\n".join(rows)
    yield _hint(result, made)
    yield from _asides(made)


def _any(wrong):
    return wrong is not None and bool(wrong.any())


def _indented(text):
    return "\n".join(f"    {line}" for line in text.splitlines())


# ---------------------------------------------------------------- HTML


def as_html(result):
    """A CheckResult as HTML that reads well in a light and in a dark JupyterLab."""
    state, headline = _headline(result)
    body = [f'<div style="font-weight: 600; color: {_COLOURS[state]}">{html.escape(headline)}</div>']
    detailed = False
    for each in result.results:
        mark, colour = ("✓", _COLOURS["passed"]) if each.passed else ("✗", _COLOURS["failed"])
        body.append(f'<div><span style="color: {colour}">{mark}</span> {html.escape(each.case.title)}</div>')
        if each.passed:
            continue
        story = _paragraph(_story(result, each))
        details = "" if detailed else "".join(_details_as_html(result, each.failed))
        detailed = True
        body.append(f'<div style="margin: 0 0 6px 18px">{story}{details}</div>')
    body += [_paragraph(note) for note in _notes(result)]
    body.append(f'<div style="margin-top: 4px">{html.escape(_footer(result))}</div>')
    return f'<div style="border-left: 4px solid {_COLOURS[state]}; padding: 4px 10px">{"".join(body)}</div>'


def _paragraph(text):
    return f'<div style="white-space: pre-wrap">{html.escape(text)}</div>' if text else ""


def _details_as_html(result, made):
    yield _paragraph(_hint(result, made))
    for part in _parts(result, made):
        grid = _grid(part.form, part.wrong)
        label = html.escape(part.label)
        if grid is None:
            yield f"<div>{label}: {html.escape(_short(part.form))}</div>"
        else:
            marked = " (what differs is framed)" if _any(part.wrong) else ""
            yield f"<div>{label}: {html.escape(describe(part.form))}{marked}</div>{_table(grid)}"
    yield _picture(result, made)
    yield from (_paragraph(aside) for aside in _asides(made))


def _table(grid):
    plain = "padding: 1px 6px; text-align: right; font-family: monospace; border: 1px solid #9e9e9e"
    marked = f"{plain}; border: 2px solid {_COLOURS['failed']}; font-weight: 700"
    rows = (
        "<tr>"
        + "".join(f'<td style="{marked if mark else plain}">{html.escape(text)}</td>' for text, mark in row)
        + "</tr>"
        for row in grid
    )
    return f'<table style="border-collapse: collapse; margin: 2px 0 4px">{"".join(rows)}</table>'


def _picture(result, made):
    """What was given, came back, was expected, and where they differ; "" where nothing is a picture."""
    actual, expected, wrong = array_of(made.outcome.value), array_of(made.expected.value), _wrong(made)
    if not _is_picture(actual) or wrong is None or not wrong.any():
        return ""
    pictures = {"came back": actual, "expected": expected}
    if made.arguments and _is_picture(made.arguments[0]):
        pictures = {"given": made.arguments[0], **pictures}
    where = wrong.any(axis=2) if wrong.ndim == 3 else wrong
    row, col = (int(k) for k in np.argwhere(where)[0])
    pictures["white: differs"] = where
    from imgproc_course.display import draw  # only to draw: it loads matplotlib

    try:
        figure, axes = draw(pictures)
    except ValueError:
        return ""  # values that are no picture, such as colours outside 0..1: the words have said it
    axes[-1].plot(
        col, row, "o", markersize=14, markerfacecolor="none", markeredgecolor="#ef6c00", markeredgewidth=2
    )
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", metadata={"Software": None})
    count = int(where.sum())
    alt = f"Pictures of {', '.join(pictures)}; {count} pixels differ, the first at row {row}, col {col}."
    data = base64.b64encode(buffer.getvalue()).decode("ascii")
    return f'<img alt="{alt}" style="max-width: 100%" src="data:image/png;base64,{data}">'


def _is_picture(values):
    return (
        isinstance(values, np.ndarray)
        and (values.ndim == 2 or (values.ndim == 3 and values.shape[2] in (3, 4)))
        and min(values.shape[:2]) >= SMALLEST_PICTURE
    )
