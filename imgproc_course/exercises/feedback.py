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
from imgproc_course.exercises.values import in_words, parts_of, rows_of, wrong_of

SMALLEST_PICTURE = 13  # rows and cols; a smaller array is better read as numbers
_LONGEST = 12  # lines of print

_COLOURS = {"passed": "#2e7d32", "failed": "#c62828", "open": "#616161"}


# What NumPy says of a number that an array's type cannot hold.
_TOO_SMALL = re.compile(r"Python integer (-?\d+) out of bounds for (\w+)")


def story_of(outcome, difference, function):
    """What went wrong in one call, in a sentence or two; "" where nothing did.

    Parameters
    ----------
    outcome : CallResult
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
    """A labelled value, `given pixels`: its words, its rows, and whether any element of them is marked."""

    def __init__(self, label, form, wrong=None):
        self.label = label.strip()
        self.words = in_words(form)
        self.rows = rows_of(form, wrong)
        self.marked = any(mark for row in self.rows for _, mark in row)


def _parts(result, made):
    names = [*result.names, *("" for _ in made.arguments)]
    for name, value in zip(names, made.arguments, strict=False):
        given = canonical(value, limit=None)
        yield from (_Part(f"given {name}{inner}", form) for inner, form, _ in parts_of(given, given))
    if made.outcome.finished and made.difference is not None:
        for inner, expected, actual in _answers(made):
            wrong = wrong_of(expected, actual, made.case.tolerance)
            yield _Part(f"came back {inner}", actual, wrong)
            yield _Part(f"expected {inner}", expected, wrong)


def _answers(made):
    return parts_of(made.expected.value, made.outcome.value)


def _refusals(result):
    for module in result.reach.refused:
        yield (
            f"{result.exercise.function}() uses {module}. This exercise is to be written without it:"
            " grading will not take it."
        )


def _notes(result):
    name = f"{result.exercise.function}()"
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
    # What is refused comes first: an error below may come of it, and goes with it.
    if right < count and result.reach.refused:
        return "failed", f"{declared.id}: grading would refuse this answer"
    if right < count:
        return "failed", f"{declared.id}: {right} of {count} checks pass"
    if not result.passed:
        return "failed", f"{declared.id}: the values are right, but grading would refuse this answer"
    all_pass = {1: "the check passes", 2: "both checks pass"}.get(count, f"all {count} checks pass")
    return "passed", f"{declared.id}: {all_pass}"


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
    lines = [f"{headline}.", *_refusals(result)]
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
        yield f"{part.label}: {part.words}" + (", * differs" if part.marked else "")
        width = max((len(text) for row in part.rows for text, _ in row), default=0) + 1
        for row in part.rows:
            yield "".join(f"{text:>{width}}{'*' if marked else ' '}" for text, marked in row).rstrip()
    yield _hint(result, made)
    yield from _asides(made)


def _indented(text):
    return "\n".join(f"    {line}" for line in text.splitlines())


# ---------------------------------------------------------------- HTML


def as_html(result):
    """A CheckResult as HTML that reads well in a light and in a dark JupyterLab."""
    state, headline = _headline(result)
    body = [f'<div style="font-weight: 600; color: {_COLOURS[state]}">{html.escape(headline)}</div>']
    body += [_paragraph(note) for note in _refusals(result)]
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
        marked = " (what differs is framed)" if part.marked else ""
        yield f"<div>{html.escape(f'{part.label}: {part.words}{marked}')}</div>"
        if part.rows:
            yield _table(part.rows)
    yield _picture(result, made)
    yield from (_paragraph(aside) for aside in _asides(made))


def _table(rows):
    plain = "padding: 1px 6px; text-align: right; white-space: nowrap; font-family: monospace"
    plain += "; border: 1px solid #9e9e9e"
    marked = f"{plain}; border: 2px solid {_COLOURS['failed']}; font-weight: 700"
    lines = (
        "<tr>"
        + "".join(f'<td style="{marked if mark else plain}">{html.escape(text)}</td>' for text, mark in row)
        + "</tr>"
        for row in rows
    )
    table = f'<table style="border-collapse: collapse; margin: 2px 0 4px">{"".join(lines)}</table>'
    return f'<div style="overflow-x: auto">{table}</div>'


def _picture(result, made):
    """What was given, came back, was expected, and where they differ; "" where nothing is a picture."""
    found = _first_wrong_picture(made)
    if found is None:
        return ""
    inner, expected, actual, wrong = found
    pictures = {f"came back {inner}".strip(): actual, f"expected {inner}".strip(): expected}
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


def _first_wrong_picture(made):
    """(name, expected, actual, which values differ) of the answer's first picture that is wrong, or None."""
    for inner, expected, actual in _answers(made):
        wrong = wrong_of(expected, actual, made.case.tolerance)
        if wrong is not None and wrong.any() and _is_picture(array_of(actual)):
            return inner, array_of(expected), array_of(actual), wrong
    return None


def _is_picture(values):
    return (
        isinstance(values, np.ndarray)
        and (values.ndim == 2 or (values.ndim == 3 and values.shape[2] in (3, 4)))
        and min(values.shape[:2]) >= SMALLEST_PICTURE
    )
