"""The ways in which a learner runs a lesson, and the tracebacks that its text does not announce.

Each way changes the code cells that run; ways can be joined: "visible+bare".

all        every code cell, from the first to the last
visible    without the folded cells
begin      for each "You can begin here": the visible cells before the first section, and those after it
exercises  only imports, what is given, answers and checks
wrong      every answer returns None
failing    every answer raises an exception
bare       every guess and every answer to a question is words without quotes
sliders    every slider, choice and check box is moved to its ends when its cell has run
twice      every cell runs, then every cell runs again in the same kernel
"""

import ast
import copy
import itertools
import subprocess

from nbclassroom.authoring.execute import CELL_SECONDS, kernel_environment
from nbclassroom.authoring.rules import RAISING_TAGS
from nbclient import NotebookClient
from nbclient.exceptions import CellTimeoutError, DeadKernelError
from nbformat.v4 import new_code_cell

BEGIN_HERE = "You can begin here"  # below it, a lesson needs only the cells before its first section
# Runs after each cell, in the learner's kernel.
MOVE_SLIDERS = """
import ipywidgets as _w
from ipywidgets.widgets.widget import _instances
_moved = globals().setdefault("_moved", set())
for _id, _widget in list(_instances.items()):
    if _id not in _moved and not getattr(_widget, "disabled", False):
        _moved.add(_id)
        if isinstance(_widget, (_w.IntRangeSlider, _w.FloatRangeSlider)):
            _values = [(_widget.max, _widget.max), (_widget.min, _widget.min), (_widget.min, _widget.max)]
        elif isinstance(_widget, (_w.IntSlider, _w.FloatSlider)):
            _values = sorted({_widget.min, _widget.max}, key=lambda value: value == _widget.value)[::-1]
        elif isinstance(_widget, _w.Checkbox):
            _values = [not _widget.value]
        elif isinstance(_widget, (_w.Dropdown, _w.SelectionSlider, _w.RadioButtons, _w.ToggleButtons)):
            _values = [value for _, value in _widget._options_full]
        else:
            _values = []
        for _value in _values:
            _widget.value = _value
"""


def ways_of(notebook, way):
    """The lists of code cells that run in a way, as a learner who has this notebook runs them."""
    parts = [notebook.cells]
    for change in way.split("+"):
        parts = [cells for part in parts for cells in CHANGES[change](part)]
    return [[cell for cell in cells if cell.cell_type == "code"] for cells in parts]


def _all(cells):
    yield cells


def _visible(cells):
    yield [cell for cell in cells if not cell.metadata.get("jupyter", {}).get("source_hidden")]


def _begin(cells):
    texts = [number for number, cell in enumerate(cells) if cell.cell_type == "markdown"]
    (opening,) = _visible(cells[: texts[1]])
    for number in texts:
        if BEGIN_HERE in cells[number].source:
            yield [*opening, *cells[number:]]


def _exercises(cells):
    opening = [number for number, cell in enumerate(cells) if cell.cell_type == "markdown"][1]
    roles = ("given-", "answer-", "check-")
    yield [cell for number, cell in enumerate(cells) if number < opening or cell.id.startswith(roles)]


def _wrong(cells):
    yield [_with_bodies(cell, "return None") for cell in cells]


def _failing(cells):
    yield [_with_bodies(cell, "raise ZeroDivisionError('wrong')") for cell in cells]


def _with_bodies(cell, body):
    """An answer cell whose functions and methods have another body; another cell as it is."""
    if not cell.id.startswith("answer-"):
        return cell
    module = ast.parse(cell.source)
    for node in ast.walk(module):
        if isinstance(node, ast.FunctionDef):
            node.body = ast.parse(f"def wrong():\n    {body}").body[0].body
    return _changed(cell, ast.unparse(module))


def _bare(cells):
    words = itertools.cycle(("yes", "about 36 %"))
    yield [
        _changed(cell, cell.source.replace("None", next(words), 1))
        if cell.id.startswith(("predict-", "ask-"))
        else cell
        for cell in cells
    ]


def _sliders(cells):
    both = ([cell, new_code_cell(MOVE_SLIDERS, id=f"sliders-{cell.id}"[:64])] for cell in cells)
    yield [cell for pair in both for cell in pair]


def _twice(cells):
    yield [*cells, *cells]


def _changed(cell, source):
    cell = copy.deepcopy(cell)
    cell.source = source
    return cell


CHANGES = {
    "all": _all,
    "visible": _visible,
    "begin": _begin,
    "exercises": _exercises,
    "wrong": _wrong,
    "failing": _failing,
    "bare": _bare,
    "sliders": _sliders,
    "twice": _twice,
}


def tracebacks(notebook, way, folder, kernel_name="python3"):
    """(cell id, what it shows) of each traceback that is not announced, when a lesson runs in one way.

    Parameters
    ----------
    notebook : NotebookNode, a lesson as a learner has it
    way : str, see above
    folder : the folder of the learner's copies, in which the kernel runs
    """
    return [found for cells in ways_of(notebook, way) for found in _run(notebook, cells, folder, kernel_name)]


def _run(notebook, cells, folder, kernel_name):
    notebook = copy.deepcopy(notebook)
    notebook.cells = [copy.deepcopy(cell) for cell in cells]  # one may be there twice
    client = NotebookClient(
        notebook,
        timeout=CELL_SECONDS,
        kernel_name=kernel_name,
        resources={"metadata": {"path": str(folder)}},
        allow_errors=True,
        store_widget_state=False,
        coalesce_streams=True,
    )
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    try:
        client.execute(env=kernel_environment(), **quiet)
    except (CellTimeoutError, DeadKernelError) as error:
        yield "kernel", f"{type(error).__name__}: {str(error)[:300]}"
    for cell in notebook.cells:
        if not {*cell.metadata.get("tags", ())} & {*RAISING_TAGS}:
            yield from ((cell.id, text) for output in cell.outputs for text in _traceback_in(output))


def _traceback_in(output):
    if output.output_type == "error":
        yield f"{output.ename}: {output.evalue}"
    elif output.output_type == "stream" and "Traceback (most recent call last)" in output.text:
        yield f"{output.name}: {output.text[-200:]}"
