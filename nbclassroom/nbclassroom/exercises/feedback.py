"""The feedback of `check`, as a Document."""

import re

from .canonical import canonical
from .document import Check, Document, Figures, Table, Text
from .source_remarks import SAYS
from .values import answer_parts, describe_value, differing_elements, table_rows

_MOST_LINES = 12  # of the function's own prints
_ON_NAMES = ("NameError", "AttributeError")  # what is advised on others is a guess


def _labelled_forms(result, call):
    """(label, form, which of its elements differ) of what was given, and returned and expected."""
    if not result.exercise.kind.shows_values:
        return
    names = [*result.exercise.names, *("" for _ in call.arguments)]
    for name, argument in zip(names, call.arguments, strict=False):
        argument_form = canonical(argument)
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
    reason = "the task does not allow it" if result.exercise.practice else "grading refuses it"
    for used in result.refused.values():
        text = f"{result.exercise.answer_name} uses {used}. Write this exercise without it: {reason}."
        yield f"{text} You may use {', '.join(['numpy', *result.exercise.allowed])}."
    for name, why in result.gone.items():
        yield SAYS["gone"].format(name=name, why=why)
    yield from result.remarks


def _checks(result, graded):
    """The Check of each case, with what went wrong."""
    kind = result.exercise.kind
    ending = kind.common_failure(result.exercise, result.calls)
    steps: dict[str, str] = {}
    for number, one in enumerate(result.results):
        call, explanation = one.failed_call, ""
        if ending:
            first = f"In all {len(result.results)} scenarios, as in the first: {ending}"
            explanation = "" if number else first
        elif call is not None:
            explanation = kind.explain(result.exercise, call)
            step = one.case.title.partition(":")[0]
            first = steps.setdefault(re.sub(r"\d+", "", explanation), step)
            if kind.has_sentences and first != step:
                explanation = f"as in {first} above"
        elif not one.passed:
            explanation = one.reason
        details = _details(result, call, graded) if call and call is result.shown else ()
        yield Check(one.case.title, one.passed, (Text(explanation), *details), one.note, one.is_open)


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


def _advice(result, call, graded):
    """What is known of the mistake; if that is not all, the hint of the case."""
    kind = result.exercise.kind
    if result.mistake is not None:
        yield result.mistake.says
        yield SAYS["none of these"] if "sual causes" in result.mistake.says else ""
        return
    if call.result.timed_out:
        yield "" if graded else SAYS["time is up"]
    elif call.result.error and (not result.one_change or call.result.error in _ON_NAMES):
        yield kind.advice_on_error(result.exercise, call.result)
    yield result.one_change
    if call.difference is None or call.result.changed or kind.explains_enough:
        return
    diagnosis = result.diagnosis
    yield diagnosis.text
    if diagnosis.on_border and result.exercise.border_hint:
        yield result.exercise.border_hint
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


def document_of(result):
    """The Document of a CheckResult."""
    ends = [Text(_footer(result), "below"), *map(Text, _ends(result))]
    colour = "passed" if result.passed else "failed" if result.attempted else "open"
    heading = f"{result.exercise.id}: {_headline(result)}"
    return Document(heading, (*blocks_of(result), *ends), colour, ".")


def blocks_of(result, *, graded=False):
    """The blocks on the checks of a CheckResult; `graded`: in a process that grades."""
    yield from map(Text, _remarks(result))
    yield from result.exercise.kind.blocks_of_all(result.calls)
    yield from _checks(result, graded)


def _details(result, call, graded):
    """Blocks on the call whose values are shown."""
    kind = result.exercise.kind
    yield from map(Text, _advice(result, call, graded))
    for label, form, wrong in _labelled_forms(result, call):
        yield Table(table_rows(form, wrong), f"{label.strip()}: {describe_value(form)}")
    if kind.expects_values or not graded:
        yield Figures(lambda: kind.images_of(result.exercise, call))
    yield from map(Text, _warning_and_output(call, kind))
