"""What an answer in a notebook reads from outside itself: modules that it may not use, cells that have gone.

The kernel has every module, and every value that a cell has ever made; grading has what the page makes. A
function may be older than the cell on the screen, and so may a value: a cell that does not run leaves what it
made before, and so does one that was deleted, or makes another name. `watch_cells` records a kernel's runs.
"""

import builtins
import copy
import functools
import importlib.util
import sys
import types
from collections import deque

from .. import course
from .cell_syntax import DEFINITIONS, names_in, names_of, plain_python, program_lines, top_level
from .error_advice import advice_on
from .guesses import read_bare_guess
from .running import attempt, functions_of, globals_of
from .source_remarks import SAYS

# What every answer may use: NumPy, and what shows something. Inside the sandbox nothing else exists.
_FOR_ALL = ("numpy", "matplotlib", "IPython", "__main__", "nbclassroom")
_FOR_ALL += (*course.always_allowed, *course.display_only)
_NO_VALUES = (types.ModuleType, types.FunctionType, types.BuiltinFunctionType, type)
_MOST_RUNS, _MOST_NAMES = 500, 5


class CellRun:
    """A run of a cell; `statements` are the NamesUsed of those that have come to their end."""

    def __init__(self, source, cell_id):
        nodes = top_level(plain_python(source))
        self.statements, self._last_lines = list(map(names_of, nodes)), [node.end_lineno for node in nodes]
        self.cell_id, self.why_failed = cell_id, ""

    def fail(self, error, line=0):
        """Note the error that ended the run in a line; the error has frames, which hold large arrays."""
        pairs = zip(self.statements, self._last_lines, strict=True)
        self.statements = [names for names, last_line in pairs if last_line < line]
        kind, text, place = type(error).__name__, str(error), ""
        if isinstance(error, SyntaxError):
            text, place = f"{error.msg}, line {error.lineno}", f"line: {(error.text or '').strip()}"
        advice = advice_on(kind, getattr(error, "msg", text), place)
        self.why_failed = f"failed when it ran last ({kind}: {text}). {advice}".rstrip(". ")

    def names(self):
        return set().union(*(names.binds for names in self.statements))


class CellRuns:
    """The runs of a notebook's cells, the newest last."""

    def __init__(self):
        self._runs, self._deleted = [], set()  # the ids of deleted cells

    def start(self, source, cell_id=""):
        """Record that a cell begins to run; returns the CellRun."""
        self._runs = [*self._runs[1 - _MOST_RUNS :], CellRun(source, cell_id or "")]
        self._deleted.discard(cell_id)
        return self._runs[-1]

    def begin(self, info):
        request: dict = getattr(sys.modules["IPython"].get_ipython(), "get_parent", dict)()
        deleted = request.get("metadata", {}).get("deletedCells")  # JupyterLab sends it
        self._deleted |= {id for id in deleted if isinstance(id, str)} if isinstance(deleted, list) else set()
        self.start(info.raw_cell, getattr(info, "cell_id", ""))
        source = plain_python(info.raw_cell)
        has_definition = any(isinstance(statement, DEFINITIONS) for statement in top_level(source))
        for line, code in program_lines(source)[:1] if has_definition else ():
            print(SAYS["line of a program"].format(line=line, code=code), SAYS["interrupt"])

    def end(self, result):
        error = result.error_before_exec or result.error_in_exec
        if error is not None and self._runs:
            frames = result.error_in_exec and error.__traceback__ and error.__traceback__.tb_next
            self._runs[-1].fail(error, frames.tb_lineno if frames else 0)

    def binding(self, name):
        """The last CellRun that bound a name, None if none is known."""
        return next((run for run in reversed(self._runs) if name in run.names()), None)

    def statements(self, name):
        """The NamesUsed of the statements that bound a name last."""
        run = self.binding(name)
        return [names for names in run.statements if name in names.binds] if run else []

    def why_gone(self, name):
        """What has happened to the cell that made what Python still has; "" for nothing."""
        run = self.binding(name)
        if run is None or not run.cell_id:
            return ""
        if run.cell_id in self._deleted:
            return "was deleted"
        newest = [one for one in self._runs if one.cell_id == run.cell_id][-1]
        makes = ", ".join(sorted(newest.names())[:_MOST_NAMES]) or "nothing that has a name"
        return "" if newest is run else newest.why_failed or f"now makes {makes}"


RUNS = CellRuns()


def watch_cells():
    """Record the runs of this kernel's cells in RUNS, and read guesses; does nothing outside a kernel."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    if shell is not None:
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
    """

    def __init__(self, answer, runs=None):
        self._namespace, self._name = globals_of(answer), getattr(answer, "__name__", "")
        self._runs = runs or CellRuns()
        self.names: dict = {}
        self._uses: list = []  # (module, the name that is used of it, the value that is made with it or "")
        self._values: set = set()  # names of values that the functions themselves read
        waiting = deque((names, "") for names in self._needs(self._name, answer))
        while waiting:  # first what the answer itself reads
            names, source = waiting.popleft()
            self._uses += [(module, module, source) for module in sorted(names.imports)]
            for name in sorted(names.reads - self.names.keys()):
                waiting += self._read(name, source)

    def _needs(self, name, value):
        """The NamesUsed of the functions of a value of the notebook, and of the statements that bound it."""
        functions = functions_of(value).values()
        own = [one.__code__ for one in functions if one.__globals__ is self._namespace]
        return [*map(names_in, own), *self._runs.statements(name)]

    def _read(self, name, source):
        """Note a name; each NamesUsed by which it got its value, or that a call runs, with its source."""
        if name not in self._namespace:
            if not hasattr(builtins, name) and importlib.util.find_spec(name):
                self._uses.append((name, name, source))  # it raises NameError, and an import would not help
            return []
        value = self.names[name] = self._namespace[name]
        if isinstance(value, _NO_VALUES):
            module = value.__name__ if isinstance(value, types.ModuleType) else value.__module__ or "builtins"
            if module != self._namespace.get("__name__"):
                self._uses.append((module, name, source))
        elif not source:
            source = name
            self._values.add(name)
        return [(names, source) for names in self._needs(name, value)]

    def refused(self, allowed, given=frozenset()):
        """{module that an exercise does not allow: what the answer uses of it}."""
        found: dict[str, str] = {}
        for path, name, source in self._uses:
            module = refused_module(path, allowed)
            if module and name not in given:
                used = module if name.startswith(module) else f"{name} of {module}"
                found.setdefault(module, f"{source}, which is made with {module}" if source else used)
        return found

    def values(self, given):
        """The names of values of other cells, sorted; a wrong answer may take them for its arguments."""
        own = self._runs.binding(self._name)
        return sorted(self._values.difference(given, own.names() if own else ()))

    def gone(self):
        """{name: what has happened to the cell that made it}."""
        return {name: why for name in self.names if (why := self._runs.why_gone(name))}


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
