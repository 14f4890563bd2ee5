"""The shape of an answer: what it is by its syntax, whatever its names, numbers, comments and spacing.

The text that is parsed is the learners', so the process of `submission_reader` does it, with limits on time
and memory. Nothing is run. Only the standard library is imported.
"""

import ast
import hashlib

LONGEST = 20_000  # characters of an answer; a longer one is not compared
_UNPARSABLE = (SyntaxError, ValueError, RecursionError, MemoryError)
# Where a kind of syntax has the name that it binds.
_NAMES = {ast.arg: "arg", ast.ExceptHandler: "name"}
_NAMES |= dict.fromkeys((ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef), "name")
_IGNORED = (ast.expr_context, ast.Import, ast.ImportFrom, ast.Pass)
_UNTOLD = {"annotation", "returns", "type_comment", "kind"}  # fields that change nothing


def syntax_tokens(source):
    """The tokens of a source, a list of str: kinds of syntax, constants, and names that are not its own.

    A name that the source binds is "V" and its number, by first occurrence. Of a text that is no Python, such
    as a written answer, they are its words. There are none if the source is longer than LONGEST.
    """
    try:
        tree = ast.parse(source) if len(source) <= LONGEST else ast.Module([], [])
    except _UNPARSABLE:
        return source.split()
    own, tokens, nodes = _own_names(tree), [], [tree]
    numbers: dict[str, int] = {}
    while nodes:
        node = nodes.pop()
        if isinstance(node, str):
            tokens.append(f"V{numbers.setdefault(node, len(numbers))}" if node in own else node)
        elif isinstance(node, ast.Constant):
            value = node.value  # Python refuses to write huge decimals
            tokens.append(hex(value) if type(value) is int else repr(value))
        elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            continue  # a docstring, or another statement that is only a text
        elif not isinstance(node, _IGNORED):
            tokens.append(type(node).__name__)
            nodes += reversed(list(_parts(node)))
    return tokens


def _own_names(tree):
    """The names that a source binds; np is everybody's."""
    names = set()
    for node in ast.walk(tree):
        if type(node) in _NAMES:
            names.add(getattr(node, _NAMES[type(node)]))
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names.add(node.id)
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            names |= {node.attr} if getattr(node.value, "id", "") == "self" else set()
        elif isinstance(node, ast.alias) and node.asname != "np":
            names.add(node.asname or node.name)
    return names


def _parts(node):
    for name, value in ast.iter_fields(node):
        if name not in _UNTOLD:
            for part in value if isinstance(value, list) else (value,):
                if isinstance(part, (ast.AST, str)):
                    yield part


def shapes(answers):
    """{id: [digest, number of tokens]} of {id: source}, without sources that have no tokens."""
    found = {}
    for id, source in answers.items():
        if tokens := syntax_tokens(source):
            text = "\0".join("number" if token[:1].isdigit() else token for token in tokens)
            digest = hashlib.blake2b(text.encode("utf-8", "surrogatepass"), digest_size=8).hexdigest()
            found[id] = [digest, len(tokens)]
    return found
