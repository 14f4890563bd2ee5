"""The last runs of the notebook's cells: a checked function may be older than the cell on the screen.

A cell that does not run leaves the function of an earlier run behind, and so does a cell that defines another
name. In a kernel the runs are recorded from the import of this package on; elsewhere nothing is recorded.
"""

import re
import sys
from dataclasses import dataclass

from .. import course
from .cell_syntax import names_used, plain_python, program_lines
from .error_advice import advice_on
from .guesses import read_bare_guess
from .running import source_of
from .source_remarks import SAYS

_MOST_RUNS = 500
_FAILED = (
    "The last run of your cell failed. {error}\nPython still has the older {name}, not the one on the"
    " screen. Repair the cell, run it, then run this one."
)


@dataclass
class CellRun:
    source: str
    cell_id: str = ""  # may be missing
    exercise: str = ""  # that it answers, by the id of the cell, or in JupyterLab's metadata of it
    error: str = ""  # a sentence, "" if it came to its end
    is_read: bool = True  # whether Python could read it

    def fail(self, error):
        """Record the error that ended the run, without its frames: they would keep large arrays alive."""
        kind, self.is_read = type(error).__name__, not isinstance(error, SyntaxError)
        if self.is_read:
            self.error = f"{kind}: {error}. {advice_on(kind, str(error))}".rstrip()
        else:
            advice = advice_on(kind, error.msg, f"line {error.lineno}: {(error.text or '').strip()}")
            text = f"Python cannot read it: {kind}, {error.msg}, in line {error.lineno}. {advice}"
            self.error = text.rstrip()

    def statements(self):
        """The NamesUsed of its statements, which it has bound as far as it came to its end."""
        return names_used(plain_python(self.source)) if self.is_read else []

    def binds(self, name):
        return any(name in names.binds for names in self.statements())

    def definitions(self):
        """The functions and classes that the cell defines at its top level, also if it does not parse."""
        return re.findall(r"^(?:(?:async\s+)?def|class)\s+(\w+)", self.source, re.MULTILINE)


class CellRuns:
    """The runs of a notebook's cells, the newest last."""

    def __init__(self):
        self._runs, self._deleted = [], set()  # the ids of deleted cells

    def start(self, source, cell_id="", exercise=""):
        """Record that a cell begins to run; returns the CellRun."""
        cell_id = cell_id or ""
        by_id = cell_id.removeprefix("answer-") if cell_id.startswith("answer-") else ""
        self._runs = [*self._runs[1 - _MOST_RUNS :], CellRun(source, cell_id, exercise or by_id)]
        return self._runs[-1]

    def begin(self, info):
        """Record that IPython begins to run a cell."""
        shell = sys.modules["IPython"].get_ipython()
        request = shell.get_parent() if hasattr(shell, "get_parent") else {}
        metadata = request.get("metadata", {})  # JupyterLab sends the cell's, and which cells were deleted
        about, deleted = metadata.get(course.name), metadata.get("deletedCells")
        exercise = about.get("exercise") if isinstance(about, dict) else None
        self._deleted |= {id for id in deleted if isinstance(id, str)} if isinstance(deleted, list) else set()
        run = self.start(info.raw_cell, getattr(info, "cell_id", None), exercise if exercise else "")
        lines = program_lines(plain_python(run.source)) if run.exercise or run.definitions() else ()
        for line, code in lines[:1]:
            print(SAYS["line of a program"].format(line=line, code=code), SAYS["interrupt"])

    def end(self, result):
        error = result.error_before_exec or result.error_in_exec
        if error is not None and self._runs:
            self._runs[-1].fail(error)

    def binding(self, name):
        """The NamesUsed of the statements of the last run that bound a name, [] if none is known."""
        run = next((run for run in reversed(self._runs) if run.binds(name)), None)
        return [names for names in run.statements() if name in names.binds] if run else []

    def end_of(self, name):
        """What has happened to the cell that bound a name last: "changed", "deleted", or "" for nothing."""
        binding = [number for number, run in enumerate(self._runs) if run.binds(name)]
        cell_id = self._runs[binding[-1]].cell_id if binding else ""
        later = [run for run in self._runs[binding[-1] + 1 :] if run.cell_id == cell_id] if cell_id else []
        if later:  # it has run again, and does not bind the name any more
            return "changed"
        return "deleted" if cell_id in self._deleted else ""

    def why_older(self, exercise_id, name, function):
        """Why a function is older than the learner's cell of this name, and what to do; "" if it is not."""
        runs = reversed(self._runs)
        own = (run for run in runs if run.exercise == exercise_id or name in run.definitions())
        run = next(own, None)
        if run is None:
            return ""
        kind, marks, start = "function", "()", f"def {name}(...):"
        if isinstance(function, type):
            kind, marks, start = "class", "", f"class {name}(...):"
        if run.error:
            is_current = run.is_read and (source_of(function).strip() or "\0") in run.source
            return "" if is_current else _FAILED.format(error=run.error, name=f"{name}{marks}")
        # Under the name that is asked for there may also be a lambda, or an imported function.
        if re.search(rf"\b{name}\b", run.source):
            return ""
        defined_name = next(iter(run.definitions()), "")
        defined = f"defines {defined_name}{marks}" if defined_name else f"defines no {kind}"
        return SAYS["another name"].format(defined=defined, kind=kind, name=f"{name}{marks}", start=start)


RUNS = CellRuns()


def watch_cells():
    """Record the runs of this kernel's cells in RUNS, and read guesses; does nothing outside a kernel."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    if shell is None or getattr(shell, "nbclassroom_runs", None) is RUNS:
        return
    shell.nbclassroom_runs = RUNS
    for source in shell.history_manager.input_hist_raw[1:]:  # before the import of this package
        RUNS.start(source)
    shell.events.register("pre_run_cell", RUNS.begin)
    shell.events.register("post_run_cell", RUNS.end)
    shell.input_transformers_cleanup.append(lambda lines: read_bare_guess(lines, shell.user_ns))
