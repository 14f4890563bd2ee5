"""What an answer reaches for outside its own cell: refused modules, and names that grading will not know.

Grading takes the answer's cell alone. A function that works in the notebook only because another cell defined
something is told so here, before handing in.
"""

import ast
import builtins
import dis
import linecache
import types
from dataclasses import dataclass

from imgproc_course.exercises.running import code_of


@dataclass(frozen=True)
class Reach:
    """refused: modules, as the exercise names them; foreign: names that another cell defines. Sorted."""

    refused: tuple = ()
    foreign: tuple = ()


def reach_of(function, refused, provided):
    """What a function and its helper functions reach for.

    The code that would run is read, so `import cv2 as c` and `from cv2 import cvtColor` in other cells are
    seen too.

    Parameters
    ----------
    function : the learner's
    refused : sequence of str, module names; their submodules are refused with them
    provided : set of str, names that every answer finds (the given cells')

    Returns
    -------
    Reach
    """
    if code_of(function) is None:
        return Reach()
    walker = _Walker(tuple(refused), provided)
    walker.visit(function)
    return Reach(tuple(sorted(walker.refused_found)), tuple(sorted(walker.foreign)))


class _Walker:
    def __init__(self, refused, provided):
        self._refused = refused
        self._provided = provided
        self._seen = set()
        self.refused_found = set()
        self.foreign = set()

    def visit(self, function):
        code = code_of(function)
        if code is None or code in self._seen:
            return
        self._seen.add(code)
        here = names_of_cell(code.co_filename)
        space = function.__globals__
        for name in _imports(code):
            self._refuse(name)
        for name in _global_names(code):
            if name not in space:
                # A built-in, or a NameError that the call itself will show: of a module that is refused,
                # there is no use in importing it.
                self._refuse(name)
                continue
            value = space[name]
            own = (
                value.__name__ if isinstance(value, types.ModuleType) else getattr(value, "__module__", None)
            )
            if self._refuse(own) or name in self._provided or hasattr(builtins, name):
                continue
            if here is not None and name not in here:
                self.foreign.add(name)
            elif isinstance(value, types.FunctionType) and value.__globals__ is space:
                self.visit(value)

    def _refuse(self, module):
        """Whether a module is refused; notes it where it is."""
        if not isinstance(module, str):
            return False
        found = {name for name in self._refused if module == name or module.startswith(name + ".")}
        self.refused_found |= found
        return bool(found)


def _codes(code):
    yield code
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from _codes(constant)


def _global_names(code):
    found = (
        step.argval for part in _codes(code) for step in dis.get_instructions(part) if step.opname in _GLOBAL
    )
    return dict.fromkeys(found)


_IMPORT = dis.opmap["IMPORT_NAME"]
_GLOBAL = ("LOAD_GLOBAL", "LOAD_NAME", "STORE_GLOBAL")


def _imports(code):
    for part in _codes(code):
        if _IMPORT not in part.co_code[::2]:  # to take it apart takes much longer
            continue
        module = ""
        for step in dis.get_instructions(part):
            if step.opname == "IMPORT_NAME":
                module = step.argval
                yield module
            elif step.opname == "IMPORT_FROM":
                yield f"{module}.{step.argval}"


def names_of_cell(filename):
    """The names that a cell's source binds at its top level.

    Parameters
    ----------
    filename : str, as code objects of the cell carry it

    Returns
    -------
    set of str, or None where the source is not known
    """
    source = "".join(linecache.getlines(filename))
    if not source:
        return None
    return bound_names(source)


def bound_names(source):
    """The names that a source binds at its top level; empty for one that does not parse."""
    try:
        statements = ast.parse(source).body
    except SyntaxError:
        return set()
    bound = set()
    for statement in statements:
        for node in _own_nodes(statement):
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
                bound.add(node.name)
            elif isinstance(node, (ast.Import, ast.ImportFrom)):
                bound |= {(alias.asname or alias.name).split(".")[0] for alias in node.names}
            elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                bound.add(node.id)
    return bound


def _own_nodes(node):
    yield node
    if not isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Lambda)):
        for child in ast.iter_child_nodes(node):
            yield from _own_nodes(child)
