"""The figure of an answer that a person grades: made in the sandbox, and encoded again from its pixels."""

import base64
import html
import io

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
    return _NO_FIGURE.format(why.replace(" ()", "")) if pixels is None else _image(pixels)


def _pixels_of(answers):
    """The pixels that a check showed, (rows, cols, 3) uint8, or None; anybody may have sent them."""
    calls = read_answer(answers)
    form = calls[0].value if calls else None
    pixels = array_of(form) if form else None
    if pixels is None or pixels.dtype != "uint8" or pixels.ndim != 3 or pixels.shape[2] != 3:
        return None
    return pixels if pixels.size else None


def _image(pixels):
    from PIL import Image  # only here: most processes that grade draw nothing

    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "PNG")
    data, (height, width, _) = base64.b64encode(file.getvalue()).decode("ascii"), pixels.shape
    size = f'width="{width}" height="{height}"'
    return f'<figure><img src="data:image/png;base64,{data}" alt="The figure of this answer" {size}></figure>'
