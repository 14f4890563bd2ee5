"""Fingerprints of answers: what an answer is by its syntax, whatever its names, comments and spacing.

The text that is parsed is the learners', so the process of `submission_reader` does it, with limits on time
and memory. Nothing is run. Only the standard library is imported.

The fingerprints are those of winnowing: of the hashes of all sequences of K tokens, the least one in each
window of W. Every sequence of W + K - 1 tokens that two answers share gives them a common fingerprint.
Source: S. Schleimer, D. Wilkerson, A. Aiken, Winnowing: Local Algorithms for Document Fingerprinting (2003),
the method of MOSS.
"""

import ast
import hashlib

K, W = 16, 8  # tokens; a line of code has about ten
LONGEST = 20_000  # characters of an answer; a longer one is not compared
_UNPARSABLE = (SyntaxError, ValueError, RecursionError, MemoryError)
# Where a kind of syntax has the name that it binds.
_NAMES = {ast.arg: "arg", ast.ExceptHandler: "name"}
_NAMES |= dict.fromkeys((ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef), "name")
_IGNORED = (ast.expr_context, ast.Import, ast.ImportFrom, ast.Pass)
_UNTOLD = {"annotation", "returns", "type_comment", "kind"}  # fields that change nothing


def syntax_tokens(source):
    """The tokens of a source, (token, line): kinds of syntax, constants, and names that are not its own.

    A name that the source binds is "V" and its number, by first occurrence. There are none if the source does
    not parse or is longer than LONGEST.
    """
    try:
        tree = ast.parse(source) if len(source) <= LONGEST else ast.Module([], [])
    except _UNPARSABLE:
        return []
    own, numbers, tokens, line = _own_names(tree), {}, [], 1
    nodes = [tree]
    while nodes:
        node = nodes.pop()
        if isinstance(node, str):
            token = f"V{numbers.setdefault(node, len(numbers))}" if node in own else node
            tokens.append((token, line))
            continue
        line = getattr(node, "lineno", line)
        if isinstance(node, ast.Constant):
            value = node.value  # Python refuses to write huge decimals
            tokens.append((hex(value) if type(value) is int else repr(value), line))
        elif not isinstance(node, _IGNORED) and not _is_text(node):
            tokens.append((type(node).__name__, line))
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


def _is_text(node):
    """Whether a node is a docstring, or another statement that is only a text."""
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


def _parts(node):
    for name, value in ast.iter_fields(node):
        if name not in _UNTOLD:
            for part in value if isinstance(value, list) else (value,):
                if isinstance(part, (ast.AST, str)):
                    yield part


def shape_of(tokens):
    """[digest, number of tokens, digest without numbers]: the same whatever the names and comments."""
    texts = [token for token, _ in tokens]
    without_numbers = ["number" if text[:1].isdigit() else text for text in texts]
    return [_digest(texts), len(texts), _digest(without_numbers)]


def winnowed(tokens):
    """{fingerprint: (first line, last line)}; all names of the source's own are equal here."""
    plain = ["V" if token[0] == "V" and token[1:].isdigit() else token for token, _ in tokens]
    hashes = [(_digest(plain[start : start + K]), -start) for start in range(len(plain) - K + 1)]
    prints = {}
    for start in range(max(len(hashes) - W + 1, min(len(hashes), 1))):
        least, place = min(hashes[start : start + W])  # of equal ones the last
        prints.setdefault(least, (tokens[-place][1], tokens[-place + K - 1][1]))
    return prints


def _digest(tokens):
    data = "\0".join(tokens).encode("utf-8", "surrogatepass")
    return hashlib.blake2b(data, digest_size=8).hexdigest()


def fingerprints(answers):
    """Of {id: source}: "shapes" {id: shape_of} and "prints" {fingerprint: [id, first line, last line]}."""
    shapes, prints = {}, {}
    for id, source in sorted(answers.items()):
        tokens = syntax_tokens(source)
        if tokens:
            shapes[id] = shape_of(tokens)
            for fingerprint, lines in winnowed(tokens).items():
                prints.setdefault(fingerprint, [id, *lines])
    return {"shapes": shapes, "prints": prints}
