"""The shape of an answer: what it is by its syntax, whatever its names, numbers, comments and spacing.

The text that is parsed is the learners', so the process of `submission_reader` does it, with limits on time
and memory. Nothing is run. Only the standard library is imported.
"""

import ast
import builtins
import hashlib

LONGEST = 20_000  # characters of an answer; a longer one is not compared
_UNPARSABLE = (SyntaxError, ValueError, RecursionError, MemoryError)
_NAMES = ("id", "arg", "name", "asname")  # fields of syntax that hold a name
_KEPT = {"np", *dir(builtins)}  # everybody's
_IGNORED = (ast.expr_context, ast.Import, ast.ImportFrom, ast.Pass)
_UNTOLD = {"annotation", "returns", "type_comment", "kind"}  # fields that change nothing


def syntax_tokens(source):
    """The tokens of a source, a list of str: kinds of syntax, constants, attributes, and everybody's names.

    Another name is "V" and its number, by first occurrence. Of a text that is no Python, such
    as a written answer, they are its words. There are none if the source is longer than LONGEST.
    """
    try:
        tree = ast.parse(source) if len(source) <= LONGEST else ast.Module([], [])
    except _UNPARSABLE:
        return source.split()
    tokens, nodes = [], [tree]
    numbers: dict[str, int] = {}
    while nodes:
        node = nodes.pop()
        if isinstance(node, tuple):
            tokens.append(f"V{numbers.setdefault(node[0], len(numbers))}")
        elif isinstance(node, str):
            tokens.append(node)
        elif isinstance(node, ast.Constant):
            value = node.value  # Python refuses to write huge decimals
            tokens.append(hex(value) if type(value) is int else repr(value))
        elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            continue  # a docstring, or another statement that is only a text
        elif not isinstance(node, _IGNORED):
            tokens.append(type(node).__name__)
            nodes += reversed(list(_parts(node)))
    return tokens


def _parts(node):
    """What is inside a node; a name of its own in a tuple. So is an attribute of self."""
    names = (*_NAMES, "attr") if getattr(getattr(node, "value", None), "id", "") == "self" else _NAMES
    for field, value in ast.iter_fields(node):
        if isinstance(value, str) and field not in _UNTOLD:
            yield (value,) if field in names and value not in _KEPT else value
        elif field not in _UNTOLD:
            parts = value if isinstance(value, list) else (value,)
            yield from (part for part in parts if isinstance(part, ast.AST))


def shapes(answers):
    """{id: [digest, number of tokens]} of {id: source}, without sources that have no tokens."""
    found = {}
    for id, source in answers.items():
        if tokens := syntax_tokens(source):
            text = "\0".join("number" if token[:1].isdigit() else token for token in tokens)
            digest = hashlib.blake2b(text.encode("utf-8", "surrogatepass"), digest_size=8).hexdigest()
            found[id] = [digest, len(tokens)]
    return found
