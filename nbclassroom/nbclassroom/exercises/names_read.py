"""What an answer in a notebook reads from outside itself: modules that it may not use, cells that have gone.

The kernel has every module, and every value that a cell has ever made; grading has what the page makes. A
function may be older than the cell on the screen, and so may a value: a cell that does not run leaves what it
made before, and so does one that was deleted, or makes another name.
"""

import builtins
import importlib.util
import sys
import types
from collections import deque

from .. import course
from .cell_syntax import DEFINITIONS, names_in, names_of, plain_python, program_lines, top_level
from .error_advice import advice_on
from .running import codes_of, functions_of, globals_of
from .source_remarks import SAYS

# What every answer may use: NumPy, and what shows something. Inside the sandbox nothing else exists.
_FOR_ALL = ("numpy", "matplotlib", "IPython", "__main__", "nbclassroom")
_FOR_ALL += (*course.always_allowed, *course.display_only)
_NO_VALUES = (types.ModuleType, types.FunctionType, types.BuiltinFunctionType, type)


class CellRuns:
    """What the runs of a notebook's cells have made."""

    def __init__(self):
        self._made = {}  # {name: (id of the cell that bound it last, the NamesUsed of that run's statements)}
        self._cells = {}  # {id of a cell: (the names that its last run has bound, why that failed or "")}
        self._deleted = set()  # ids of cells
        self.start("")

    def start(self, source, cell_id=""):
        """Record that a cell runs, as if it came to its end."""
        self._nodes, self._id, self._before = top_level(plain_python(source)), cell_id or "", self._made
        self._deleted.discard(self._id)
        self._record(self._nodes)

    def _record(self, nodes, why_failed=""):
        statements = list(map(names_of, nodes))
        names = {name for one in statements for name in one.binds}
        self._made = self._before | dict.fromkeys(names, (self._id, statements))
        self._cells[self._id] = names, why_failed

    def fail(self, error, line=0):
        """Note the error that ended the run in a line; the error has frames, which hold large arrays."""
        kind, text, place = type(error).__name__, str(error), ""
        if isinstance(error, SyntaxError):
            text, place = f"{error.msg}, line {error.lineno}", f"line: {(error.text or '').strip()}"
        advice = advice_on(kind, getattr(error, "msg", text), place)
        why = f"failed when it ran last ({kind}: {text}). {advice}".rstrip(". ")
        self._record([node for node in self._nodes if node.end_lineno < line], why)

    def begin(self, info):
        request: dict = getattr(sys.modules["IPython"].get_ipython(), "get_parent", dict)()
        self._deleted.update(request.get("metadata", {}).get("deletedCells") or ())  # JupyterLab sends it
        self.start(info.raw_cell, getattr(info, "cell_id", ""))
        has_definition = any(isinstance(node, DEFINITIONS) for node in self._nodes)
        for line, code in program_lines(plain_python(info.raw_cell))[:1] if has_definition else ():
            print(SAYS["line of a program"].format(line=line, code=code), SAYS["interrupt"])

    def end(self, result):
        error = result.error_before_exec or result.error_in_exec
        if error is not None:
            frames = result.error_in_exec and error.__traceback__ and error.__traceback__.tb_next
            self.fail(error, frames.tb_lineno if frames else 0)

    def run_of(self, name):
        """The NamesUsed of each statement of the run that bound a name last; [] if none is known."""
        return self._made.get(name, ("", []))[1]

    def why_gone(self, name):
        """What has happened to the cell that made what Python still has; "" for nothing."""
        cell_id, _ = self._made.get(name, ("", []))
        if cell_id in self._deleted:
            return "was deleted"
        names, why_failed = self._cells[cell_id]
        makes = ", ".join(sorted(names)[:5]) or "nothing that has a name"
        return "" if not cell_id or name in names else why_failed or f"now makes {makes}"


RUNS = CellRuns()


def refused_module(module, allowed):
    """The name of a module that an exercise does not allow, as messages say it; None if it allows it."""
    parts = module.split(".")
    name = ".".join(parts[: 2 if parts[0] == course.package else 1])
    return None if name in {*sys.stdlib_module_names, *_FOR_ALL, *allowed} else name


class NamesRead:
    """The global names that an answer (a function or class), its helpers and the values that it reads need.

    `runs` are the CellRuns of its notebook, None elsewhere. `names` is {name: value} of all that it finds.
    """

    def __init__(self, answer, runs=None):
        self._namespace, self._runs = globals_of(answer), runs or CellRuns()
        self._answer, self._name = answer, getattr(answer, "__name__", "")
        self.names: dict = {}
        self._uses: list = []  # (module, the name that is used of it, what says by what)
        waiting = deque((names, "") for names in self._needs(self._name, answer))
        while waiting:  # first what the answer itself reads
            names, way = waiting.popleft()
            self._uses += [(module, module, way) for module in sorted(names.imports)]
            for name in sorted(names.reads - self.names.keys()):
                waiting += [(needed, "a value or function that needs ") for needed in self._read(name, way)]

    def _needs(self, name, value):
        """The NamesUsed of the functions of a value of the notebook, and of the statements that bound it."""
        functions = functions_of(value).values()
        own = [one.__code__ for one in functions if one.__globals__ is self._namespace]
        return [*map(names_in, own), *(names for names in self._runs.run_of(name) if name in names.binds)]

    def _read(self, name, way):
        """Note a name; each NamesUsed by which it got its value, or that a call runs."""
        if name not in self._namespace:
            if not hasattr(builtins, name) and importlib.util.find_spec(name):
                self._uses.append((name, name, way))  # it raises NameError, and an import would not help
            return []
        value = self.names[name] = self._namespace[name]
        if isinstance(value, _NO_VALUES):
            module = value.__name__ if isinstance(value, types.ModuleType) else value.__module__ or "builtins"
            if module != self._namespace.get("__name__"):
                self._uses.append((module, name, way))
        return self._needs(name, value)

    def refused(self, allowed, given=frozenset()):
        """{module that an exercise does not allow: what the answer uses of it}."""
        found: dict[str, str] = {}
        for path, name, way in self._uses:
            if name not in given and (module := refused_module(path, allowed)):
                found.setdefault(module, way + (module if name.startswith(module) else f"{name} of {module}"))
        return found

    def values(self, given):
        """The names of values of other cells, sorted; a wrong answer may take them for its arguments."""
        own = {name for one in self._runs.run_of(self._name) for name in one.binds} | given
        reads = {name for code in codes_of(self._answer).values() for name in names_in(code).reads} - own
        return sorted(name for name in reads if not isinstance(self.names.get(name, len), _NO_VALUES))

    def gone(self):
        """{name: what has happened to the cell that made it}."""
        return {name: why for name in self.names if (why := self._runs.why_gone(name))}
