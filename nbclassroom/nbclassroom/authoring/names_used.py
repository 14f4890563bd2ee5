"""Which names a statement of a master's cell reads, and which it binds: a core must run without the rest."""

import ast
import dis
from types import CodeType
from typing import NamedTuple

from ..exercises.cell_syntax import UNPARSABLE, top_level

_LOADS = ("LOAD_NAME", "LOAD_GLOBAL", "LOAD_FROM_DICT_OR_GLOBALS")
_STORES = ("STORE_NAME", "STORE_GLOBAL")


class NamesUsed(NamedTuple):
    """The names that a statement at the top level of a cell binds, and reads before it binds them."""

    binds: set
    reads: set


def names_used(source):
    """The NamesUsed of each statement of a source; none of one that Python does not compile."""
    for node in top_level(source):
        try:
            module = ast.Module([node], [])
            code = compile(module, "cell", "exec", ast.PyCF_ALLOW_TOP_LEVEL_AWAIT, dont_inherit=True)
        except UNPARSABLE:
            continue
        yield _names_used(code)


def _names_used(code):
    """The NamesUsed of a code object, in the order of its instructions: the compiler knows the scopes.

    A function reads what its body reads where it is defined.
    """
    names = NamesUsed(set(), set())
    for step in dis.get_instructions(code):
        if isinstance(step.argval, CodeType):
            names.reads.update(_names_used(step.argval).reads - names.binds)
        elif step.opname in _STORES:
            names.binds.add(step.argval)
        elif step.opname in _LOADS and step.argval not in names.binds and not step.argval.startswith("__"):
            names.reads.add(step.argval)
    return names
