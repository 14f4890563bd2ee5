"""What the check of a figure calls: it runs an answer's cell again, and shows its last figure's pixels."""

import sys
from unittest.mock import patch

import numpy as np

from nbclassroom.autograder.sandbox.inside.answer_mime import MIME
from nbclassroom.autograder.sandbox.inside.check_cell import call_to_json
from nbclassroom.exercises.canonical import canonical
from nbclassroom.exercises.running import CallResult

_MOST_PIXELS, _DPI = 300_000, 100  # they fit into what a check may show


def show_last_figure(source):
    """Run the source of a cell, and show the last figure that it makes, as data; nothing if it makes none."""
    from IPython import get_ipython
    from IPython.display import display
    from matplotlib.figure import Figure

    made, begin = [], Figure.__init__

    def noted(figure, *arguments, **options):
        begin(figure, *arguments, **options)
        made.append(figure)

    if "matplotlib.pyplot" in sys.modules:  # as after each cell of a notebook: no figure is drawn on further
        sys.modules["matplotlib.pyplot"].close("all")
    with patch.object(Figure, "__init__", noted):
        exec(compile(source, "<answer>", "exec", dont_inherit=True), get_ipython().user_ns)
    if made:
        call = call_to_json(CallResult(value=canonical(_pixels(made[-1]), limit=None)))
        display({MIME: {"calls": [call]}}, raw=True)


def _pixels(figure):
    """A figure as (rows, cols, 3) uint8."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    width, height = figure.get_size_inches()
    figure.set_dpi(min(_DPI, (_MOST_PIXELS / (width * height)) ** 0.5))
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()
