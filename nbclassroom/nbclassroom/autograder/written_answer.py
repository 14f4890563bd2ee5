"""What pages show of an answer that a person grades: its text, or its figure. In neither anything acts.

Most processes that grade meet none: what this needs is imported when it is used.
"""

import html

from ..exercises.canonical import array_of
from .sanitize import reproducible_text, sanitize_text
from .verdict import read_answer

_LONGEST = 20_000  # characters
_NAMES = "p br hr h1 h2 h3 h4 h5 h6 em strong del code pre blockquote ul ol li table thead tbody tr th td"
_TAGS = frozenset(_NAMES.split())
_SHOW = (
    "from nbclassroom.autograder.sandbox.inside.check_cell import show_last_figure\nshow_last_figure({!r})"
)
_NO_FIGURE = "<p>Its cell makes no figure{}.</p>"


def rendered_text(text):
    """A text in Markdown as HTML without links, images and styles; HTML that it contains is shown as text."""
    import bleach
    import mistune

    html_of = mistune.create_markdown(escape=True, plugins=["strikethrough", "table"])
    return bleach.clean(html_of(sanitize_text(text, _LONGEST)), _TAGS, attributes={}, strip=True)


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
