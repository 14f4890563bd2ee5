"""What an answer in a notebook reads from outside itself: modules that it may not use, cells that have gone.

The kernel has every module, and every value that a cell has ever made; grading has what the page makes.
"""

import builtins
import copy
import functools
import importlib.util
import sys
import types
from collections import deque

from .. import course
from .cell_runs import CellRuns
from .cell_syntax import names_in, names_used, plain_python
from .running import attempt, cells_of, functions_of, globals_of

# What every answer may use: NumPy, and what shows something. Inside the sandbox nothing else exists.
_FOR_ALL = ("numpy", "matplotlib", "IPython", "__main__", "nbclassroom")
_FOR_ALL += (*course.always_allowed, *course.display_only)
_NO_VALUES = (types.ModuleType, types.FunctionType, types.BuiltinFunctionType, type)


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
