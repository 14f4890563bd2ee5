"""Which names a statement of a master's cell reads, and which it binds: a core must run without the rest."""

import ast
import symtable
from dataclasses import dataclass

from ..exercises.cell_syntax import UNPARSABLE, names_bound_by, top_level

_EXPRESSIONS_WITH_NAMES = (ast.Lambda, ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)
_DEFINITIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)


@dataclass(frozen=True)
class NamesUsed:
    """The names that a statement at the top level of a cell binds, and reads before it binds them."""

    binds: frozenset
    reads: frozenset


def names_used(source):
    """The NamesUsed of each statement of a source."""
    for node in top_level(source):
        reads = _names_read(ast.unparse(node))
        reads -= set() if isinstance(node, _DEFINITIONS) else _names_bound_first(node)
        yield NamesUsed(frozenset(names_bound_by(node)), frozenset(reads))


def _names_bound_first(statement):
    """The names that a statement binds before it reads them, such as the variable of a loop; a set."""
    is_bound = {}
    for name, binds in _uses_in_order(statement):
        is_bound.setdefault(name, binds)
    return {name for name, binds in is_bound.items() if binds}


def _uses_in_order(node):
    """(name, whether it is bound there) for every use of a name, in the order in which Python runs them."""
    if isinstance(node, (*_DEFINITIONS, *_EXPRESSIONS_WITH_NAMES)):
        yield from ((name, False) for name in _names_read(ast.unparse(node)))
        yield from ((name, True) for name in names_bound_by(node))
    elif isinstance(node, (ast.Import, ast.ImportFrom)):
        yield from (((alias.asname or alias.name).split(".")[0], True) for alias in node.names)
    elif isinstance(node, ast.Name):
        yield node.id, isinstance(node.ctx, ast.Store)
    else:
        if isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name):
            yield node.target.id, False
        # Python computes the right side before it binds the left one: `for x in ITER`, `x = VALUE`.
        first = getattr(node, "iter", None) or getattr(node, "value", None)
        first = [first] if isinstance(first, ast.AST) else []
        for child in (*first, *(child for child in ast.iter_child_nodes(node) if child not in first)):
            yield from _uses_in_order(child)


def _names_read(source):
    """The global names that a source reads, also inside its functions and classes; a set.

    symtable knows the scopes as Python's compiler does: a local variable of a function is no global name.
    """
    try:
        if " for " in source:
            source = ast.unparse(_Generators().visit(ast.parse(source)))
        tables = [symtable.symtable(source, "cell", "exec")]
    except UNPARSABLE:
        return set()
    names = set()
    while tables:
        table = tables.pop()
        outermost = table.get_type() == "module"
        names |= {
            symbol.get_name()
            for symbol in table.get_symbols()
            if (symbol.is_referenced() and (outermost or symbol.is_global())) or symbol.is_declared_global()
        }
        tables += table.get_children()
    return names


class _Generators(ast.NodeTransformer):
    """Comprehensions as generator expressions.

    From Python 3.12 on (PEP 709), symtable shows a comprehension's variable in the scope around it.
    """

    def visit_ListComp(self, node):
        self.generic_visit(node)
        return ast.GeneratorExp(node.elt, node.generators)

    visit_SetComp = visit_ListComp

    def visit_DictComp(self, node):
        self.generic_visit(node)
        return ast.GeneratorExp(ast.Tuple([node.key, node.value], ast.Load()), node.generators)
