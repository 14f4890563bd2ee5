"""What pages show of a graded answer: what `check` in the notebook would show, as HTML with classes.

And of an answer that a person grades: its text, or its figure. In neither anything acts. Most processes that
grade meet none: what this needs is imported when it is used.
"""

import html
from dataclasses import dataclass, replace

from ..exercises.canonical import array_of
from ..exercises.document import Html, Paragraphs
from ..exercises.error_advice import advice_on
from ..exercises.feedback import blocks_of
from ..exercises.judging import judge
from .outcomes import PHRASES, Outcome
from .sanitize import reproducible_text, sanitize_text
from .verdict import read_answer

_LONGEST = 2_000  # characters of a text, and of what an answer printed
_LONGEST_WRITTEN = 20_000  # of an answer that a person grades
# Cases that ended so are explained by the outcome, and not by a call.
_NO_CALL = (Outcome.HOSTILE, Outcome.NOT_ATTEMPTED, Outcome.REFUSED_MODULE, Outcome.NOT_GRADED)
_NAMES = "p br hr h1 h2 h3 h4 h5 h6 em strong del code pre blockquote ul ol li table thead tbody tr th td"
_TAGS = frozenset(_NAMES.split())
_SHOW = (
    "from nbclassroom.autograder.sandbox.inside.check_cell import show_last_figure\nshow_last_figure({!r})"
)
_NO_FIGURE = "<p>Its cell makes no figure{}.</p>"


class PageHtml(Html):
    """How blocks become HTML on a page: with classes, which its style knows."""

    def look(self, name):
        return f'class="{name}"'

    def text(self, text):
        return html.escape(sanitize_text(text, _LONGEST))


@dataclass(frozen=True)
class CheckedAnswer:
    """What somebody may see of a graded answer: sentences on all checks, and CheckResults."""

    remarks: tuple
    results: tuple

    def html(self):
        return "".join(block.html(PageHtml()) for block in self._blocks())

    def plain(self):
        text = "\n".join(filter(None, (block.plain() for block in self._blocks())))
        return sanitize_text(text, 10 * _LONGEST)

    def _blocks(self):
        yield from map(Paragraphs, self.remarks)
        for result in self.results:
            yield from blocks_of(result, graded=True)


def checked_answers(exercise, cases, runs, mistake, message, *, advises=True):
    """The CheckedAnswers for the learner and for the teacher, of GradedCases and {id of a case: CaseRun}.

    The learner's has only the title, the ending and the hint of a hidden case. `message` is about the cell.
    """
    graded, is_said = {case.id: case for case in cases}, _ended_alike(cases)
    public = _result(replace(exercise, cases=exercise.public), graded, runs, mistake, is_said=is_said)
    shown = public.shown
    cause = "" if message or shown else cases[0].message
    advice = _advice(cases, message) if advises else ""
    remarks = tuple(filter(None, (_sentence(cause), advice))) if is_said else ()
    if is_said and shown and not remarks:  # an exception: does the public call say what it means?
        is_said = bool(exercise.kind.advice_on_error(exercise, shown.result))
    hidden = _result(replace(exercise, cases=exercise.hidden), graded, runs, None, is_said=is_said)
    # Of a hidden one its hint is told only if the input can be the reason.
    hints = ["" if is_said or not case.hint else f"\nHint: {case.hint}" for case in exercise.hidden]
    told = tuple(
        replace(result, failed_call=None, reason=result.reason + hint)
        for result, hint in zip(hidden.results, hints, strict=True)
    )
    for_learner = replace(hidden, results=told, calls=())
    return CheckedAnswer(remarks, (public, for_learner)), CheckedAnswer(remarks, (public, hidden))


def _ended_alike(cases):
    """Whether all cases ended in one way that is no wrong value: then the cause is not in the inputs."""
    endings = {
        (case.outcome, case.message.partition(":")[0] * (case.outcome == Outcome.RAISED)) for case in cases
    }
    return len(endings) == 1 and not endings & {(Outcome.WRONG, ""), (Outcome.PASSED, "")}


def _result(exercise, graded, runs, mistake, *, is_said):
    """The CheckResult of some cases of an exercise; `is_said`: how all of them ended is said above."""
    untold = {*_NO_CALL} | ({Outcome.TIME} if exercise.kind.expects_values else set())
    by_call = [case for case in exercise.cases if case.id in runs and graded[case.id].outcome not in untold]
    calls = [_readable(call) for case in by_call for call in runs[case.id].verdict.calls]
    result = judge(exercise, calls, mistake)
    cases = [graded[case.id] for case in exercise.cases]
    results = [
        replace(
            case_result,
            passed=case.passed,
            reason=_ending(case, is_said=is_said),
            note=_note(case),
            is_open=case.outcome == Outcome.NOT_ATTEMPTED,
        )
        for case_result, case in zip(result.results, cases, strict=True)
    ]
    return replace(result, results=tuple(results))


def _readable(call):
    """A CaseCall whose texts of the learner's differ neither from run to run nor hide anything."""
    about = call.result
    texts = {name: reproducible_text(getattr(about, name)) for name in ("message", "line")}
    return replace(call, result=replace(about, **texts, printed=reproducible_text(about.printed, _LONGEST)))


def _ending(case, *, is_said):
    """How a case ended that no call explains, a sentence."""
    label = "" if case.outcome == Outcome.WRONG and case.message else PHRASES[case.outcome]
    return _sentence(": ".join(filter(None, (label, "" if is_said else case.message))))


def _sentence(text):
    return capital(text) + ("" if text.endswith((".", "?", ")")) or not text else ".")


def capital(text):
    """The text with a capital, unless it begins with a name such as my_psnr()."""
    return text[:1].upper() + text[1:] if text.split(" ", 1)[0].rstrip(":,").isalpha() else text


def _note(case):
    points = f"{case.points} of {case.max_points}" if case.max_points else "no points"
    return f" (on other inputs; {points})" if case.hidden else f" ({points})"


def _advice(cases, message):
    """What helps if all cases ended alike, "" if nothing is certain."""
    outcome = cases[0].outcome
    if outcome != Outcome.RAISED:
        return PHRASES.get(f"{outcome}: advice", "")
    if ": RefusedModule: " in message:
        return PHRASES["value: advice"]
    if message:
        error, _, text = message.partition(": ")[2].partition(": ")
        return f"{advice_on(error, text)} {PHRASES['cell: advice']}".strip()
    return PHRASES["name: advice"] if cases[0].message.startswith("NameError") else ""


def rendered_text(text):
    """A text in Markdown as HTML without links, images and styles; HTML that it contains is shown as text."""
    import bleach
    import mistune

    html_of = mistune.create_markdown(escape=True, plugins=["strikethrough", "table"])
    return bleach.clean(html_of(sanitize_text(text, _LONGEST_WRITTEN)), _TAGS, attributes={}, strip=True)


def figure_html(exercise, page, kernels):
    """The last figure that the cell of an answer makes, encoded again from its pixels, or why it has none."""
    sources = [cell["source"] for cell in page["cells"] if cell["exercise"] == exercise.id]
    if not sources:
        return _NO_FIGURE.format(" (it is no code cell)")
    process, run = kernels.open_check(exercise, exercise.time_limit)
    if not run.ended:
        run = process.run_check(_SHOW.format(sources[0]), [[]], exercise.time_limit)
    process.stop()
    why = f" ({html.escape(reproducible_text(': '.join(filter(None, (run.ended, *run.error)))))})"
    pixels = _pixels_of(run.answers)
    if pixels is None:
        return _NO_FIGURE.format(why.replace(" ()", ""))
    from PIL import Image

    from ..exercises.answer_images import encode_image

    image = encode_image("", "The figure of this answer", Image.fromarray(pixels))
    size = f'width="{image.width}" height="{image.height}"'
    return f'<figure><img src="{image.url}" alt="{image.alt}" {size}></figure>'


def _pixels_of(answers):
    """The pixels that a check showed, (rows, cols, 3) uint8, or None; anybody may have sent them."""
    calls = read_answer(answers)
    form = calls[0].value if calls else None
    pixels = array_of(form) if form else None
    if pixels is None or pixels.dtype != "uint8" or pixels.ndim != 3 or pixels.shape[2] != 3:
        return None
    return pixels if pixels.size else None
