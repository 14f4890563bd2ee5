"""Which cells of a lesson others need: by the names that cells read, bind and change."""

import ast

from IPython.core.inputtransformer2 import TransformerManager
from nbclassroom.exercises import cell_syntax


def tree_of(source):
    """The syntax tree of a cell, which may hold magics."""
    return ast.parse(TransformerManager().transform_cell(source))


def names_used(source):
    return list(map(cell_syntax.names_of, tree_of(source).body))


def names_of(source):
    """The names that a cell reads, and those that it binds; no local name of a function."""
    parts = names_used(source)
    return set().union(*(part.reads for part in parts)), set().union(*(part.binds for part in parts))


def names_imported(source):
    aliases = (node for node in ast.walk(tree_of(source)) if isinstance(node, ast.alias))
    return {(alias.asname or alias.name).partition(".")[0] for alias in aliases}


def names_changed(source, methods=None):
    """The names whose value a cell may change: by an item, an attribute, `x += 1`, or one of the methods."""
    values = set()
    for node in ast.walk(tree_of(source)):
        if isinstance(node, ast.Call):
            method = getattr(node.func, "attr", "")
            values.add(node.func.value if method and (methods is None or method in methods) else None)
        elif isinstance(node, ast.Subscript | ast.Attribute) and not isinstance(node.ctx, ast.Load):
            values.add(node.value)
        elif isinstance(node, ast.AugAssign):
            values.add(node.target)
    return {_root(value) for value in values} & set().union(*names_of(source))


def _root(node):
    while isinstance(node, ast.Subscript | ast.Attribute):
        node = node.value
    return node.id if isinstance(node, ast.Name) else None


def needed_cells(names, chosen, changes=()):
    """The chosen cells, and those before them that bind or change what they read.

    Parameters
    ----------
    names : sequence of (names read, names bound), of the code cells in order
    chosen : set of int
    changes : sequence of set, names changed by each cell; () for none

    Returns
    -------
    list of int, in order
    """
    needed, missing = [], set()
    for number in reversed(range(len(names))):
        read, bound = names[number]
        if number in chosen or (bound | (changes[number] if changes else set())) & missing:
            needed.insert(0, number)
            missing = missing - bound | read
    return needed
