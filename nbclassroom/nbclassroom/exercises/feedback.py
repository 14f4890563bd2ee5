"""The feedback of `check`, as plain text and as HTML.

Both hold nothing that varies from run to run: no time, no address, no random order. nbval compares them byte
for byte.
"""

import html
import re
from itertools import chain, repeat

from .canonical import canonical
from .source_remarks import SAYS
from .values import answer_parts, describe_value, differing_elements, table_rows

_MOST_LINES = 12  # of the function's own prints

_BORDER = "Pixels there have neighbours outside the image: how does the task treat those?"

# JupyterLab's colours that have a contrast of at least 4.5 in its light and in its dark theme.
_COLOURS = {
    "passed": "var(--jp-success-color0, #1b5e20)",
    "failed": "var(--jp-error-color1, #c62828)",
    "open": "var(--jp-content-font-color2, #616161)",
}


# ---------------------------------------------------------------- the parts of the feedback


def _values(result, call, marks):
    """(caption, rows of its table) of each value of a call; `marks` says how those that differ are shown."""
    for label, form, wrong in _labelled_forms(result, call):
        rows = table_rows(form, wrong)
        has_marks = any(is_wrong for row in rows for _, is_wrong in row)
        yield f"{label.strip()}: {describe_value(form)}{marks if has_marks else ''}", rows


def _labelled_forms(result, call):
    """(label, form, which of its elements differ) of what was given, and returned and expected."""
    if not result.exercise.kind.shows_values:
        return
    names = [*result.exercise.names, *("" for _ in call.arguments)]
    for name, argument in zip(names, call.arguments, strict=False):
        argument_form = canonical(argument, limit=None)
        for part_name, form, _ in answer_parts(argument_form, argument_form):
            yield f"given {name}{part_name}", form, None
    if call.result.finished and call.difference is not None:
        for part_name, expected, actual in answer_parts(call.expected.value, call.result.value):
            if part_name and expected == actual:
                continue  # a right part of the answer only hides the wrong one
            wrong = differing_elements(expected, actual, call.case.tolerance)
            yield f"returned {part_name}", actual, wrong
            yield f"expected {part_name}", expected, wrong


def _remarks(result):
    """Sentences on the whole answer."""
    yield result.why_older
    yield from _refusals(result)
    yield from _gone(result)
    yield from result.remarks


def _refusals(result):
    for module, name in result.refused.items():
        used = module if name.startswith(module) else f"{name} of {module}"
        reason = "the task does not allow it" if result.exercise.practice else "grading refuses it"
        yield f"{result.exercise.answer_name} uses {used}. Write this exercise without it: {reason}."


def _gone(result):
    for name, end in result.gone.items():
        yield SAYS["gone"].format(answer=result.exercise.answer_name, name=name, end=end)


def _cases(result):
    """(CaseResult, what went wrong, the call whose values are shown or None) of each case."""
    kind = result.exercise.kind
    steps, ending = {}, kind.common_failure(result.exercise, result.calls)
    for case_result in result.results:
        call, explanation = case_result.failed_call, ""
        if ending:
            explanation = f"In all {len(result.results)} scenarios: {ending}" if not steps else ""
            steps[ending] = ending
        elif call is not None:
            explanation = kind.explain(result.exercise, call)
            step = case_result.case.title.partition(":")[0]
            first = steps.setdefault(re.sub(r"\d+", "", explanation), step)
            if kind.has_sentences and first != step:
                explanation = f"as in {first} above"
        elif not case_result.passed:
            explanation = "not run, because the call above did not finish"
        yield case_result, explanation, call if call is result.shown else None


def _headline(result):
    if result.why_older:
        return f"this is an older {result.exercise.kind.noun}"
    if not result.attempted:
        return result.exercise.kind.not_attempted
    passed, count = sum(case_result.passed for case_result in result.results), len(result.results)
    refused = "grading would refuse this answer"
    if result.exercise.practice:
        refused = "this answer uses what is not allowed here"
    # A refused module comes first: it may be the cause of an error below.
    if result.refused:
        return refused if passed < count else f"the values are right, but {refused}"
    if passed < count:
        return f"{passed} of {count} checks pass"
    if not result.passed:
        return "the values are right, but the page has changed since"
    return {1: "the check passes", 2: "both checks pass"}.get(count, f"all {count} checks pass")


def _footer(result):
    exercise = result.exercise
    if result.why_older:
        return ""
    if not result.attempted:
        return SAYS["not attempted"].format(name=exercise.answer_name, kind=exercise.kind.noun)
    if exercise.practice:
        return "Practice: no points."
    text = f"Points here: {result.points} of {exercise.points}."
    if not exercise.hidden_count:
        return text
    if result.points == exercise.points and not result.passed:
        text += " But a check fails, and grading takes points for that on other inputs."
    checks = f"{exercise.hidden_count} more check{'s' * (exercise.hidden_count > 1)}"
    return f"{text} Grading runs {checks} on other inputs, worth {exercise.hidden_points}."


def _ends(result):
    """Where a learner finds help after a try, or what else is right."""
    if result.passed:
        yield result.exercise.another_way
    elif result.attempted and not result.why_older and result.exercise.hints:
        yield f'Stuck? hint("{result.exercise.id}") gives help in steps.'


def _advice(result, call):
    """What is known of the mistake; if that is not all, the hint of the case."""
    kind = result.exercise.kind
    if result.mistake is not None:
        yield result.mistake.says
        yield result.one_change
        return
    if call.result.timed_out:
        yield SAYS["time is up"]
        if "overflow" in call.result.warning:
            yield SAYS["overflow in a loop"]
    elif call.result.error:
        yield kind.advice_on_error(result.exercise, call.result)
    yield result.one_change
    if call.difference is None or call.result.changed or kind.explains_enough(call):
        return
    diagnosis = result.diagnosis
    yield diagnosis.text
    if diagnosis.on_border:
        yield result.exercise.border_hint or _BORDER
    elif call.case.hint and not diagnosis.replaces_hint:
        yield f"Hint: {call.case.hint}"


def _warning_and_output(call, kind):
    if call.result.warning:
        yield f"NumPy or Python warned: {call.result.warning}"
        if "empty slice" in call.result.warning:
            yield SAYS["no values"]
    if call.result.printed.strip():
        lines = call.result.printed.rstrip().splitlines()
        ellipsis = ["…"] if len(lines) > _MOST_LINES else []
        from_the_end = ellipsis + lines[-_MOST_LINES:]
        shown = from_the_end if kind.shows_last_prints else lines[:_MOST_LINES] + ellipsis
        yield f"Your {kind.noun} printed:\n" + "\n".join(shown)


# ---------------------------------------------------------------- plain text


def as_text(result):
    """A CheckResult as plain text."""
    lines = [f"{result.exercise.id}: {_headline(result)}.", *_remarks(result)]
    lines += _rows_as_text(result.exercise.kind.table_of(result.calls))
    for case_result, explanation, call in _cases(result):
        lines.append(f"{'✓' if case_result.passed else '✗'} {case_result.case.title}")
        lines += map(_indent, (explanation, *_details_as_text(result, call)))
    return "\n".join(filter(None, (*lines, _footer(result), *_ends(result))))


def as_bare_text(result, fault):
    """The verdict, the values and a sentence on a fault: what is left if `as_text` fails."""
    lines = [f"{result.exercise.id}: {_headline(result)}.", fault]
    for case_result in result.results:
        lines.append(f"{'✓' if case_result.passed else '✗'} {case_result.case.title}")
        call = case_result.failed_call
        if call is not None and call.result.finished:
            forms = {"returned": call.result.value, "expected": call.expected.value}
            lines += [f"    {name}: {describe_value(form)}" for name, form in forms.items()]
    return "\n".join(lines)


def _details_as_text(result, call):
    if call is None:
        return
    for caption, rows in _values(result, call, ", * differs"):
        yield caption
        yield from _rows_as_text(rows)
    yield from _advice(result, call)
    yield from _warning_and_output(call, result.exercise.kind)


def _rows_as_text(rows):
    width = max((len(text) for row in rows for text, _ in row), default=0) + 1
    for row in rows:
        yield "".join(f"{text:>{width}}{'*' if mark else ' '}" for text, mark in row).rstrip()


def _indent(text):
    return "\n".join(f"    {line}" for line in text.splitlines())


# ---------------------------------------------------------------- HTML


def as_html(result):
    """A CheckResult as HTML that reads well in a light and in a dark JupyterLab."""
    colour = _COLOURS["passed" if result.passed else "failed" if result.attempted else "open"]
    headline = html.escape(f"{result.exercise.id}: {_headline(result)}")
    body = [f'<div style="font-weight: 600; color: {colour}">{headline}</div>']
    body += map(_paragraph, _remarks(result))
    body += _table_of_all(result)
    for case_result, explanation, call in _cases(result):
        mark, mark_colour = ("✓", _COLOURS["passed"]) if case_result.passed else ("✗", _COLOURS["failed"])
        title = html.escape(case_result.case.title)
        body.append(f'<div><span style="color: {mark_colour}">{mark}</span> {title}</div>')
        if not case_result.passed:
            details = "".join((_paragraph(explanation), *_details_as_html(result, call)))
            body.append(f'<div style="margin: 0 0 6px 18px">{details}</div>')
    body.append(f'<div style="margin-top: 4px">{html.escape(_footer(result))}</div>')
    body += map(_paragraph, _ends(result))
    return f'<div style="border-left: 4px solid {colour}; padding: 4px 10px">{"".join(body)}</div>'


def as_bare_html(result, fault):
    """As `as_bare_text`."""
    return _paragraph(as_bare_text(result, fault))


def _table_of_all(result):
    """The table of all calls, and their images, of a kind that has them."""
    kind = result.exercise.kind
    if rows := kind.table_of(result.calls):
        yield _table(rows, 'th scope="col"')
        yield _row_of_figures(kind.images_of_all(result.calls))
        yield _paragraph(SAYS["map of a drive"])


def _paragraph(text):
    return f'<div style="white-space: pre-wrap">{html.escape(text)}</div>' if text else ""


def _details_as_html(result, call):
    if call is None:
        return
    yield from map(_paragraph, _advice(result, call))
    for caption, rows in _values(result, call, " (values that differ are framed)"):
        yield f"<div>{html.escape(caption)}</div>"
        if rows:
            yield _table(rows)
    yield _row_of_figures(result.exercise.kind.images_of(result.exercise, call))
    yield from map(_paragraph, _warning_and_output(call, result.exercise.kind))


def _table(rows, first="td"):
    """A table of (text, whether it is marked) of each cell; `first` is the tag of the first row's cells."""
    plain = "padding: 1px 6px; text-align: right; white-space: nowrap; font-family: monospace"
    plain += "; border: 1px solid #9e9e9e"
    framed = f"{plain}; border: 2px solid {_COLOURS['failed']}; font-weight: 700"
    lines = ""
    for tag, row in zip(chain([first], repeat("td")), rows, strict=False):
        styled = [(framed if mark else plain, html.escape(text)) for text, mark in row]
        if tag.startswith("th"):  # a long name of a metric takes two lines
            styled = [(style.replace("nowrap", "normal"), text) for style, text in styled]
        cells = "".join(f'<{tag} style="{style}">{text}</{tag[:2]}>' for style, text in styled)
        lines += f"<tr>{cells}</tr>"
    table = f'<table style="border-collapse: collapse; margin: 2px 0 4px">{lines}</table>'
    return f'<div style="overflow-x: auto" tabindex="0">{table}</div>'


def _row_of_figures(images):
    figures = "".join(map(_figure, images))
    flow = "display: flex; flex-wrap: wrap; gap: 10px; margin: 4px 0"
    return f'<div style="{flow}">{figures}</div>' if figures else ""


def _figure(image):
    return (
        f'<figure style="margin: 0"><img src="{image.url}" alt="{html.escape(image.alt)}"'
        f' width="{image.width}" height="{image.height}"'
        ' style="max-width: 100%; height: auto; image-rendering: pixelated">'
        f"<figcaption>{html.escape(image.caption)}</figcaption></figure>"
    )
