"""The figure of an answer that a person grades: made in the sandbox, and encoded again from its pixels."""

import html

from ..exercises.canonical import array_of
from .answer_forms import read_answer
from .sanitize import reproducible_text

_SHOW = (
    "from nbclassroom.autograder.sandbox.inside.figure_cell import show_last_figure\nshow_last_figure({!r})"
)
_NO_FIGURE = "<p>Its cell makes no figure{}.</p>"


def figure_html(exercise, page, kernels):
    """The last figure that the cell of an answer makes, as HTML, or a sentence on why there is none."""
    sources = [cell["source"] for cell in page["cells"] if cell["exercise"] == exercise.id]
    if not sources:
        return _NO_FIGURE.format(" (it is no code cell)")
    process, answer_run = kernels.open_check(exercise, exercise.time_limit)
    run = answer_run
    if not run.ended:
        run = process.run_check(_SHOW.format(sources[0]), [[]], exercise.time_limit)
    process.stop()
    why = f" ({html.escape(reproducible_text(': '.join(filter(None, (run.ended, *run.error)))))})"
    pixels = _pixels_of(run.answers)
    if pixels is None:
        return _NO_FIGURE.format(why.replace(" ()", ""))
    from PIL import Image  # only here: most processes that grade draw nothing

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
