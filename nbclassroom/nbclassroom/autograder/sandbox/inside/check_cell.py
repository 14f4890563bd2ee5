"""What a check cell calls: it gives the learner's function its inputs and shows what the function returned.

It shows values, never verdicts. The inputs of one case are delivered just before its cell runs. The expected
values are outside the sandbox.
"""

import random
import signal
import sys

import numpy as np

from nbclassroom.autograder.sandbox.inside import MIME
from nbclassroom.exercises import running
from nbclassroom.exercises.canonical import canonical, decode, shorten_form
from nbclassroom.exercises.kinds import kind_of

MAX_DATA = 1_000_000  # bytes of one array; a larger one is replaced by its digest
_MOST_PIXELS, _DPI = 300_000, 100  # of a figure: they fit into what a check may show
CASE: dict = {}  # what was delivered last


def deliver(case):
    """Take the next check's inputs: its encoded "calls", and "seconds" that each may take.

    Answers may draw from the global generators: their state is the same before each check.
    """
    CASE.clear()
    CASE.update(case)
    random.seed(0)
    np.random.seed(0)  # noqa: NPY002 - the global generator is meant, not one of ours


def emit(function, kind="function"):
    """Run an answer of a kind with the inputs of this case; show what it did, as data."""
    from IPython.display import display

    kind, calls = kind_of(kind), []
    for encoded in CASE["calls"]:
        result = _call(function, decode(encoded), CASE["seconds"], kind)
        calls.append(call_to_json(result))
        if result.timed_out:
            break
    display({MIME: {"calls": calls}}, raw=True)


def _call(function, arguments, seconds, kind):
    """Call it as `check` does, but measure processor time: a busy machine costs nobody any time."""
    running.set_handler(signal.SIGPROF, raise_time_up)
    running.set_timer(signal.ITIMER_PROF, seconds, 0.1)
    try:
        return running.call(function, arguments, kind.argument_names(function), 1e6, kind.run)
    except running.TimeUp:  # raised between the call's end and here
        return running.CallResult(timed_out=True)
    finally:
        running.set_timer(signal.ITIMER_PROF, 0)


def raise_time_up(_signal, _frame):
    raise running.TimeUp


def call_to_json(result):
    """A CallResult as data for json.dumps; `verdict.read_answer` reads it."""
    if result.timed_out:
        return {"timed_out": True}
    data = {"changed": list(result.changed), "printed": result.printed}
    if result.error:
        is_slip = result.error == "NameError" and result.closest
        message = f"{result.message}. {running.MEANT} {result.closest}?" if is_slip else result.message
        return data | {"error": result.error, "message": message, "line": result.line}
    return data | {"value": shorten_form(result.value, MAX_DATA)}


def refuse_input(prompt=""):
    raise RuntimeError("input() waits for a person, and there is none here. Pass the value as an argument")


def show_last_figure(source):
    """Run the source of an answer's cell again, and show the pixels of its last figure, if it makes one."""
    from unittest.mock import patch

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
        call = call_to_json(running.CallResult(value=canonical(_pixels(made[-1]))))
        display({MIME: {"calls": [call]}}, raw=True)


def _pixels(figure):
    """A figure as (rows, cols, 3) uint8."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    width, height = figure.get_size_inches()
    figure.set_dpi(min(_DPI, (_MOST_PIXELS / (width * height)) ** 0.5))
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()
