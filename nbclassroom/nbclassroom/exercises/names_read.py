"""What an answer in a notebook reads from outside itself: modules that it may not use, cells that have gone.

The kernel has every module, and every value that a cell has ever made; grading has what the page makes.
"""

import ast
import builtins
import copy
import dis
import functools
import importlib.util
import linecache
import sys
import types

from .. import course
from .cell_runs import CellRuns
from .cell_syntax import bound_names, names_bound_by, plain_python, top_level
from .running import attempt, codes_of, functions_of, globals_of

# What every answer may use: NumPy, and what shows something. Inside the sandbox nothing else exists.
_FOR_ALL = ("numpy", "matplotlib", "IPython", "__main__", "nbclassroom")
_FOR_ALL += (*course.always_allowed, *course.display_only)
_LOADS = ("LOAD_GLOBAL", "LOAD_NAME")


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
        self.names, self.modules = {}, {}
        self._seen: set[types.CodeType] = set()
        files = {code.co_filename for code in codes_of(answer).values()}
        self._sources = ["".join(linecache.getlines(file)) for file in files]
        self._own = set().union(*(bound_names(plain_python(source)) for source in self._sources))
        waiting = [*functions_of(answer).values(), *self._read_at_once(getattr(answer, "__name__", ""))]
        while waiting:
            function = waiting.pop()
            if function.__code__ not in self._seen:
                inside = [cell.cell_contents for cell in function.__closure__ or () if _is_function(cell)]
                waiting += [*inside, *self._read_code(function.__code__)]

    def _read_code(self, code):
        """Note what a code object reads; yields the functions of the notebook among it."""
        self._seen.add(code)
        for step in dis.get_instructions(code):
            if step.opname in _LOADS:
                yield from self._read_name(step.argval)
            elif step.opname == "IMPORT_NAME":
                self.modules.setdefault(step.argval, step.argval)
            elif isinstance(step.argval, types.CodeType):
                yield from self._read_code(step.argval)

    def _read_name(self, name):
        if name not in self._namespace and not hasattr(builtins, name) and importlib.util.find_spec(name):
            self.modules.setdefault(name, name)  # it raises NameError, and an import would not help
        if name in self.names or name not in self._namespace:
            return
        value = self.names[name] = self._namespace[name]
        yield from (one for one in functions_of(value).values() if one.__globals__ is self._namespace)
        yield from self._read_at_once(name)

    def _read_at_once(self, name):
        """Read what the statements that bind a name read where they stand, not in the bodies of functions."""
        for source in [self._runs.source_that_binds(name), *self._sources]:
            nodes = [node for node in top_level(plain_python(source)) if name in names_bound_by(node)]
            for node in nodes:
                for other in _names_at_once(node):
                    yield from self._read_name(other)
            if nodes:
                return

    def refused(self, allowed, given=frozenset()):
        """{module that an exercise does not allow: the name by which the answer uses it}."""
        found = dict(self.modules)
        for name, value in self.names.items():
            module = value.__name__ if isinstance(value, types.ModuleType) else _module_of(value)
            if name not in given and module not in (None, self._namespace.get("__name__")):
                found.setdefault(module, name)
        pairs = ((refused_module(module, allowed), name) for module, name in found.items())
        return dict(sorted((module, name) for module, name in pairs if module))

    def values(self, given):
        """The names of values of other cells, sorted; a wrong answer may take them for its arguments."""
        kinds = (types.ModuleType, types.FunctionType, types.BuiltinFunctionType, type)
        values = {name for name, value in self.names.items() if not isinstance(value, kinds)}
        return sorted(values - given - self._own)

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


def _names_at_once(node):
    """The names that a statement reads where it stands: of a function, in its decorators and defaults."""
    if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
        yield node.id
    parts = list(ast.iter_child_nodes(node))
    if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)):
        defaults = [part for part in (*node.args.defaults, *node.args.kw_defaults) if part]
        parts = [*getattr(node, "decorator_list", ()), *defaults]
    scopes = node.body if isinstance(node, ast.ClassDef) else getattr(node, "generators", ())
    own = set().union(*map(names_bound_by, scopes))  # of a class or a comprehension
    for part in parts:
        yield from (name for name in _names_at_once(part) if name not in own)
