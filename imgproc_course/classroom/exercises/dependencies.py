"""Modules that an exercise does not allow: which of them an answer uses, and how their imports fail.

In grading such a module is not there. An answer that uses it is refused; an import of it inside a try or a
with statement raises ImportError, so that the answer takes its own way.
"""

import ast
import builtins
import importlib.util
import sys
import types
from dataclasses import dataclass, field

from .. import course
from .cell_syntax import UNPARSABLE, cells_of, needed_statements, statements_of


@dataclass(frozen=True)
class Dependencies:
    """What an answer uses from outside its cell; of `refused` modules the name by which it uses them."""

    refused: dict = field(default_factory=dict)  # {module that the exercise does not allow: name}
    foreign: dict = field(default_factory=dict)  # {name that grading does not have: "function" or "value"}
    taken: dict = field(default_factory=dict)  # {name that grading takes along: its kind, see `Statement`}
    error: str = ""  # why the answer's cell does not run by itself

    @property
    def are_accepted(self):
        """Whether grading accepts them."""
        return not (self.refused or self.foreign or self.error)


# What every answer may use: NumPy, and what shows something. Inside the sandbox nothing else exists.
_FOR_ALL = ("numpy", "matplotlib", "IPython", "__main__", *course.ALWAYS_ALLOWED, *course.DISPLAY_ONLY)
_GUARDS = (ast.Try, ast.TryStar, ast.With, ast.AsyncWith)
_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Lambda)


def refused_module(module, allowed):
    """The name of a module that an exercise does not allow, as messages say it; None if it allows it."""
    top, *submodules = module.split(".")
    allowed = (*_FOR_ALL, *allowed)
    if top in sys.stdlib_module_names or any(f"{module}.".startswith(f"{name}.") for name in allowed):
        return None
    return f"{top}.{submodules[0]}" if top == course.NAME and submodules else top


def find_refused(source, function, allowed, given, namespace):
    """The modules that an answer uses, and that its exercise does not allow.

    The answer's cell is searched, and functions, classes and imports of other cells. A value of another cell
    that needs such a module is no use of it: in grading it is missing. `source` is as `compose` gives it,
    `given` are names that every answer has, and `namespace` is what the function finds in the notebook.
    Returns {module: the name by which the answer uses it}.
    """
    statements, visitor = _searched_statements(source, function), _AsGraded(allowed)
    for statement in statements:
        visitor.visit(ast.parse(statement.source))
    refused = visitor.refused
    for name in sorted(_names_unbound(statements) - given):
        # It raises NameError in grading. Is it a module, or would an import of one help?
        is_value = not isinstance(namespace.get(name, sys), types.ModuleType)
        module = None if is_value or not importlib.util.find_spec(name) else refused_module(name, allowed)
        refused |= {module: name} if module else {}
    return dict(sorted(refused.items()))


def dependencies_of(answer, names, namespace):
    """The Dependencies of a ComposedAnswer that runs by itself, and then has these names."""
    statements = _searched_statements(answer.source, answer.function)
    unbound = _names_unbound(statements)
    names_read = unbound.union(*(statement.binds for statement in statements)) & names
    kinds = {taken.name: taken.kind for taken in answer.taken}
    taken = {name: kind for name, kind in kinds.items() if name.endswith(".*") or name in names_read}
    foreign = {
        name: "function" if isinstance(namespace[name], (types.FunctionType, type)) else "value"
        for name in sorted(unbound & namespace.keys() - names)
    }
    return Dependencies(foreign=foreign, taken=taken)


def _searched_statements(source, function):
    """The statements that decide which names an answer reads; see `find_refused`."""
    *other_cells, answer = cells_of(source) or [""]
    statements = [statement for cell in other_cells for statement in statements_of(cell)]
    statements = [statement for statement in statements if not statement.runs_at_once]
    return needed_statements([*statements, *statements_of(answer)], function, with_changes=False)


def _names_unbound(statements):
    """The names that statements read, and that neither they nor Python define; a set."""
    names = set().union(*(statement.reads for statement in statements))
    names = names.difference(*(statement.binds for statement in statements))
    return {name for name in names if not hasattr(builtins, name)}


def tree_as_graded(source, allowed):
    """(A source's tree in which other modules cannot be imported, or None; {name: module without guard})."""
    visitor = _AsGraded(allowed)
    try:
        tree = ast.fix_missing_locations(visitor.visit(ast.parse(source)))
    except UNPARSABLE:
        return None, {}
    return tree, {name: module for module, name in visitor.refused.items()}


class _AsGraded(ast.NodeTransformer):
    """Lets guarded imports of other modules fail, and removes those at the top of a cell.

    Inside a function they stay: an answer that comes so far is refused. `refused` has the modules of imports
    that nothing guards, as `find_refused` gives them.
    """

    def __init__(self, allowed):
        self._allowed, self._is_guarded, self._is_inside = allowed, False, False
        self.refused = {}

    def visit(self, node):
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            return self._import(node)
        outside = self._is_guarded, self._is_inside
        if isinstance(node, _GUARDS):
            self._is_guarded = True
        elif isinstance(node, _SCOPES):
            self._is_guarded, self._is_inside = False, True
        self.generic_visit(node)
        self._is_guarded, self._is_inside = outside
        return node

    def _import(self, node):
        module = getattr(node, "module", None)
        names = node.names if module in (None, course.NAME) else node.names[:1]
        for alias in names:
            imported = alias.name if module is None else f"{module}.{alias.name}"
            refused = refused_module(imported if module in (None, course.NAME) else module, self._allowed)
            if refused is not None:
                return self._without(node, refused, alias.asname or alias.name)
        return node

    def _without(self, node, refused, name):
        if not self._is_guarded:
            self.refused.setdefault(refused, name)
        if self._is_inside and not self._is_guarded:
            return node
        text = f"write this exercise without {refused}"
        failure = f"raise ModuleNotFoundError({text!r}, name={refused!r})"
        (statement,) = ast.parse(failure if self._is_guarded else "pass").body
        return ast.copy_location(statement, node)
