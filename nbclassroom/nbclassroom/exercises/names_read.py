"""What an answer in a notebook reads from outside itself: modules that it may not use, cells that have gone.

The kernel has every module, and every value that a cell has ever made; grading has what the page makes. A
checked function may be older than the cell on the screen: a cell that does not run leaves the function of an
earlier run behind, and so does a cell that defines another name. In a kernel `watch_cells` records the runs.
"""

import builtins
import copy
import functools
import importlib.util
import re
import sys
import types
from collections import deque
from dataclasses import dataclass

from .. import course
from .cell_syntax import names_in, names_used, plain_python, program_lines
from .error_advice import advice_on
from .guesses import read_bare_guess
from .running import attempt, cells_of, functions_of, globals_of, source_of
from .source_remarks import SAYS

# What every answer may use: NumPy, and what shows something. Inside the sandbox nothing else exists.
_FOR_ALL = ("numpy", "matplotlib", "IPython", "__main__", "nbclassroom")
_FOR_ALL += (*course.always_allowed, *course.display_only)
_NO_VALUES = (types.ModuleType, types.FunctionType, types.BuiltinFunctionType, type)
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


def refused_module(module, allowed):
    """The name of a module that an exercise does not allow, as messages say it; None if it allows it."""
    top, *submodules = module.split(".")
    allowed = (*_FOR_ALL, *allowed)
    if top in sys.stdlib_module_names or any(f"{module}.".startswith(f"{name}.") for name in allowed):
        return None
    return f"{top}.{submodules[0]}" if top == course.package and submodules else top


class NamesRead:
    """The global names that an answer, its helpers and the values that it reads need.

    answer    function or class
    runs      the CellRuns of its notebook, None elsewhere

    names     {name: value} of all that it finds in its namespace
    modules   {module that is imported inside a function, or that a name without a value means: its name}
    """

    def __init__(self, answer, runs=None):
        self._namespace, self._runs = globals_of(answer), runs or CellRuns()
        self.names: dict = {}
        self.modules: dict[str, str] = {}
        self._sources: dict[str, str] = {}  # {name: the value that is made with it, "": the answer reads it}
        cells = map(plain_python, cells_of(answer).values())
        self._own = [names for cell in cells for names in names_used(cell)]
        own = (*self._in_code_of(answer), *self._in_statements(getattr(answer, "__name__", "")))
        waiting = deque((names, "") for names in own)
        while waiting:  # first what the answer itself reads
            names, source = waiting.popleft()
            self.modules |= {module: module for module in names.imports}
            self._sources = dict.fromkeys(names.imports | names.reads, source) | self._sources
            for name in sorted(names.reads - self.names.keys()):
                waiting += self._read(name, source)

    def _read(self, name, source):
        """Note a name; each NamesUsed by which it got its value, or that a call runs, with its source."""
        if name not in self._namespace:
            if not hasattr(builtins, name) and importlib.util.find_spec(name):
                self.modules.setdefault(name, name)  # it raises NameError, and an import would not help
            return []
        value = self.names[name] = self._namespace[name]
        source = source or ("" if isinstance(value, _NO_VALUES) else name)
        return [(names, source) for names in (*self._in_code_of(value), *self._in_statements(name))]

    def _in_code_of(self, value):
        """The NamesUsed in functions of the notebook: the value, or its methods, and what these hold."""
        for function in functions_of(value).values():
            if function.__globals__ is self._namespace:
                yield names_in(function.__code__)
                inner = [cell.cell_contents for cell in function.__closure__ or () if _is_function(cell)]
                yield from (names_in(one.__code__) for one in inner)

    def _in_statements(self, name):
        """The NamesUsed of the statements that bound a name last."""
        return self._runs.binding(name) or [names for names in self._own if name in names.binds]

    def refused(self, allowed, given=frozenset()):
        """{module that an exercise does not allow: what the answer uses of it}."""
        found = dict(self.modules)
        for name, value in self.names.items():
            module = value.__name__ if isinstance(value, types.ModuleType) else _module_of(value)
            if name not in given and module not in (None, self._namespace.get("__name__")):
                found.setdefault(module, name)
        pairs = ((refused_module(module, allowed), name) for module, name in found.items())
        return {module: self._use_of(module, name) for module, name in sorted(pairs, key=str) if module}

    def _use_of(self, module, name):
        if source := self._sources.get(name):
            return f"{source}, which is made with {module}"
        return module if name.startswith(module) else f"{name} of {module}"

    def values(self, given):
        """The names of values of other cells, sorted; a wrong answer may take them for its arguments."""
        values = {name for name, value in self.names.items() if not isinstance(value, _NO_VALUES)}
        return sorted(values.difference(given, *(names.binds for names in self._own)))

    def gone(self):
        """{name: "changed" or "deleted"}, what has happened to the cell that made it."""
        return {name: end for name in self.names if (end := self._runs.end_of(name))}


def with_own_globals(function):
    """A function that begins with copies of the values that it reads: no drive continues another one."""
    namespace = globals_of(function)
    if not isinstance(function, types.FunctionType):
        return function
    own = dict(namespace)
    for name, value in NamesRead(function).names.items():
        if isinstance(value, types.FunctionType) and value.__globals__ is namespace:
            own[name] = _copied(value, own)
        elif not isinstance(value, (types.ModuleType, type)):
            own[name] = attempt(functools.partial(copy.deepcopy, value), value)
    return _copied(function, own)


def _copied(function, namespace):
    parts = function.__name__, function.__defaults__, function.__closure__
    copied = types.FunctionType(function.__code__, namespace, *parts)
    copied.__kwdefaults__ = function.__kwdefaults__
    return copied


def _is_function(cell):
    try:
        return isinstance(cell.cell_contents, types.FunctionType)
    except ValueError:  # it is empty
        return False


def _module_of(value):
    """The module of a function or class that is not the notebook's."""
    kinds = (types.FunctionType, types.BuiltinFunctionType, type)
    module = getattr(value, "__module__", None) if isinstance(value, kinds) else None
    return module if isinstance(module, str) and module != "builtins" else None
