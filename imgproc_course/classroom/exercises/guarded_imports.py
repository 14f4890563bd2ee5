"""An answer as it runs in grading: a guarded import of a module that the exercise does not allow fails.

In grading such a module is not there. An import of it inside a try or a with statement raises ImportError, so
that the answer takes its own way. `check` lets it fail too, though the module is installed: both judge the
same way.
"""

import ast
import linecache
from pathlib import Path

from imgproc_course.classroom import course
from imgproc_course.classroom.exercises.cell_syntax import UNPARSABLE
from imgproc_course.classroom.exercises.dependencies import refused_module
from imgproc_course.classroom.exercises.running import code_of

_GUARDS = (ast.Try, ast.TryStar, ast.With, ast.AsyncWith)
_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Lambda)


def tree_as_graded(source, allowed):
    """The syntax tree of a source, its guarded imports of other modules replaced by their failure.

    Parameters
    ----------
    source : str
    allowed : sequence of str, modules that the exercise allows beside those that every answer may use

    Returns
    -------
    ast.Module, or None if there is no such import
    """
    try:
        tree = ast.parse(source)
    except UNPARSABLE:
        return None
    failing = _Failing(allowed)
    tree = ast.fix_missing_locations(failing.visit(tree))
    return tree if failing.has_changed else None


def function_as_graded(function, allowed):
    """The function that its cell defines in grading; the same one if that makes no difference.

    The other statements of the cell run again, without those that only show something.
    """
    code = code_of(function)
    if code is None or Path(code.co_filename).exists():  # not of a cell
        return function
    tree = tree_as_graded("".join(linecache.getlines(code.co_filename)), allowed)
    if tree is None:
        return function
    names = dict(function.__globals__)
    for statement in tree.body:
        if not isinstance(statement, ast.Expr):
            try:
                exec(compile(ast.Module([statement], []), code.co_filename, "exec"), names)
            except Exception:  # noqa: BLE001 - the learner's code; as in grading, it costs only itself
                continue
    return names.get(function.__name__, function)


class _Failing(ast.NodeTransformer):
    def __init__(self, allowed):
        self._allowed, self._is_guarded, self.has_changed = allowed, False, False

    def visit(self, node):
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            return self._import(node)
        outside = self._is_guarded
        if isinstance(node, _GUARDS):
            self._is_guarded = True
        elif isinstance(node, _SCOPES):
            self._is_guarded = False
        self.generic_visit(node)
        self._is_guarded = outside
        return node

    def _import(self, node):
        module = getattr(node, "module", None)
        names = [alias.name for alias in node.names] if module in (None, course.NAME) else []
        modules = [f"{module}.{name}" if module else name for name in names] or [module]
        refused = next(filter(None, (refused_module(name, self._allowed) for name in modules)), None)
        if not self._is_guarded or refused is None:
            return node
        self.has_changed = True
        text = f"write this exercise without {refused}"
        (failure,) = ast.parse(f"raise ModuleNotFoundError({text!r}, name={refused!r})").body
        return ast.copy_location(failure, node)
