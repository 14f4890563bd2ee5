"""What an answer uses from outside its own cell: modules that are not allowed, names unknown to grading.

Grading runs the answer cell, and what it reads of other cells if that can be taken along. If a function works
in the notebook only because another cell did more, the learner reads it here, before submitting.
"""

import builtins
import dis
import importlib.util
import linecache
import sys
import types
from dataclasses import dataclass, field, replace

from imgproc_course.classroom import course
from imgproc_course.classroom.exercises.cell_syntax import bound_names, statements_of
from imgproc_course.classroom.exercises.running import code_of


@dataclass(frozen=True)
class Dependencies:
    """What an answer uses from outside its cell.

    refused   modules that the exercise does not allow, sorted
    foreign   names that another cell defines, sorted; without those that grading takes along
    taken     names that another cell defines, and that grading takes along (see `split_taken`), sorted
    origins   {name that another cell defines: its import line, "function" for a function of it, or "value"}
    names     {refused module: the name by which the answer uses it}
    """

    refused: tuple = ()
    foreign: tuple = ()
    taken: tuple = ()
    origins: dict = field(default_factory=dict, compare=False)
    names: dict = field(default_factory=dict, compare=False)


# What every answer may use: NumPy, and what shows something. Inside the sandbox nothing else exists.
_FOR_ALL = (
    "numpy",
    "matplotlib",
    "IPython",
    "__main__",
    *course.ALWAYS_ALLOWED,
)


def find_dependencies(function, allowed, provided):
    """What a function and its helper functions use.

    The compiled code is read, so `import cv2 as c` and `from cv2 import cvtColor` in other cells are found
    too.

    Parameters
    ----------
    function : the learner's
    allowed : sequence of str, modules that the exercise allows beside NumPy and the standard library
    provided : set of str, names that every answer has (from the given cells)

    Returns
    -------
    Dependencies
    """
    if code_of(function) is None:
        return Dependencies()
    walker = _Walker(allowed, provided)
    walker.visit(function)
    refused, foreign = tuple(sorted(walker.used_refused)), tuple(sorted(walker.foreign))
    return Dependencies(refused, foreign, (), walker.foreign, walker.used_refused)


def split_taken(dependencies, sources, arguments):
    """Tell the names that grading takes along from those that it cannot.

    It takes along functions, classes and imports, and a value that a plain assignment gives and no loop or
    camera changes: grading would make the same value again.

    Parameters
    ----------
    dependencies : Dependencies, as `find_dependencies` gives it
    sources : list of str, of the cells that ran
    arguments : sequence of str, of the exercise's function; a variable with such a name is a mistake

    Returns
    -------
    Dependencies, with `taken`
    """
    statements = [statement for source in sources for statement in statements_of(source)]
    taken = {
        name
        for name, origin in dependencies.origins.items()
        if name not in arguments and (origin != "value" or _is_made_again(name, statements))
    }
    foreign = dependencies.origins.keys() - taken
    return replace(dependencies, foreign=tuple(sorted(foreign)), taken=tuple(sorted(taken)))


def _is_made_again(name, statements, visiting=()):
    """Whether a value comes from plain assignments alone."""
    if any(
        name in (statement.reads | statement.binds) for statement in statements if statement.kind == "other"
    ):
        return False
    binding = [statement for statement in statements if name in statement.binds]
    if not binding or name in visiting:
        return hasattr(builtins, name)
    latest = binding[-1]
    if latest.kind == "import":
        return not any(part in latest.source for part in course.LIVE_MODULES)
    return all(_is_made_again(other, statements, (*visiting, name)) for other in latest.reads - {name})


class _Walker:
    def __init__(self, allowed, provided):
        self._allowed = allowed
        self._provided = provided
        self._visited = set()
        self.used_refused = {}
        self.foreign = {}

    def visit(self, function):
        code = code_of(function)
        if code is None or code in self._visited:
            return
        self._visited.add(code)
        cell_names = names_of_cell(code.co_filename)
        namespace = function.__globals__
        for name in _imports(code):
            self._is_refused(name, name)
        for name in _global_names(code):
            if name in self._provided or hasattr(builtins, name):
                continue
            if name not in namespace:  # it will raise NameError; would importing a module of that name help?
                self._is_refused(name if importlib.util.find_spec(name) else None, name)
                continue
            value = namespace[name]
            module = _module_of(value)
            if module != namespace.get("__name__") and self._is_refused(module, name):
                continue
            if cell_names is not None and name not in cell_names:
                self.foreign[name] = _origin(name, value)
            if isinstance(value, types.FunctionType) and value.__globals__ is namespace:
                self.visit(value)

    def _is_refused(self, module, used_name):
        """Whether a module is not allowed; such a one is recorded."""
        name = refused_module(module, self._allowed)
        if name is not None:
            self.used_refused.setdefault(name, used_name)
        return name is not None


def refused_module(module, allowed):
    """The name of a module that an exercise does not allow, as messages say it; None for one that it allows.

    Parameters
    ----------
    module : str, "cv2" or "scipy.ndimage"; anything else is no module
    allowed : sequence of str, modules that the exercise allows beside those that every answer may use
    """
    if not isinstance(module, str):
        return None
    top, *submodules = module.split(".")
    allowed = (*_FOR_ALL, *allowed)
    if top in sys.stdlib_module_names or any(f"{module}.".startswith(f"{name}.") for name in allowed):
        return None
    return f"{top}.{submodules[0]}" if top == course.NAME and submodules else top


def _module_of(value):
    """The module that a value is, or that a function or class comes from; None for data."""
    if isinstance(value, types.ModuleType):
        return value.__name__
    if not callable(value):
        return None
    module, name = getattr(value, "__module__", None), getattr(value, "__name__", None)
    if module is None and isinstance(value, types.BuiltinFunctionType):  # such as those of cv2
        return next((key for key, module in list(sys.modules.items()) if _holds(module, name, value)), None)
    return module


def _holds(module, name, value):
    return isinstance(module, types.ModuleType) and vars(module).get(name) is value


def _origin(name, value):
    """The import line of a value of another cell, "function" for a function defined there, or "value"."""
    if isinstance(value, types.ModuleType):
        return f"import {name}" if value.__name__ == name else f"import {value.__name__} as {name}"
    parts = (_module_of(value) or "").split(".") if callable(value) else []
    for count in range(1, len(parts) + 1):
        module = sys.modules.get(".".join(parts[:count]))
        if parts != ["__main__"] and getattr(module, name, None) is value:
            return f"from {module.__name__} import {name}"
    return "function" if isinstance(value, types.FunctionType) else "value"


def _codes(code):
    yield code
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from _codes(constant)


def _global_names(code):
    names = (
        step.argval for part in _codes(code) for step in dis.get_instructions(part) if step.opname in _GLOBAL
    )
    return dict.fromkeys(names)


_IMPORT = dis.opmap["IMPORT_NAME"]
_GLOBAL = ("LOAD_GLOBAL", "LOAD_NAME", "STORE_GLOBAL")


def _imports(code):
    """The modules that a function imports, but not inside try or with: there its own way counts."""
    for part in _codes(code):
        if _IMPORT not in part.co_code[::2]:  # a quick test: disassembling takes much longer
            continue
        steps = dis.Bytecode(part)
        module = ""
        for step in steps:
            if any(entry.start <= step.offset < entry.end for entry in steps.exception_entries):
                continue
            if step.opname == "IMPORT_NAME":
                module = step.argval
                yield from () if module == course.NAME else (module,)
            elif step.opname == "IMPORT_FROM":
                yield f"{module}.{step.argval}"


def names_of_cell(filename):
    """The names that a cell's source binds at its top level.

    Parameters
    ----------
    filename : str, as code objects of the cell carry it

    Returns
    -------
    set of str, or None if the source is not known
    """
    source = "".join(linecache.getlines(filename))
    if not source:
        return None
    return bound_names(source)
