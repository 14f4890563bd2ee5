"""What the sources of a notebook's cells say by their syntax: what they define, and what waits.

Nothing is run. Only the standard library is imported, no other module of ours: the process that reads
notebooks loads this file alone (see `gradebook.submission_reader`).
"""

import ast
import dis
import functools
import inspect
import re
import textwrap
from types import CodeType
from typing import NamedTuple

UNPARSABLE = (SyntaxError, ValueError, RecursionError, MemoryError)
DEFINITIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
_LOADS = ("LOAD_NAME", "LOAD_GLOBAL", "LOAD_FROM_DICT_OR_GLOBALS")
_MAGIC = re.compile(
    r"""^(?P<indent>[ \t]*)(?![ \t])
    (?: %time[ \t]+(?=[A-Za-z_(])            # %time y = f(): only the magic goes
      | %run[ \t]+(?:-i[ \t]+)?["']?(?P<script>[\w./-]+\.py)["']?[ \t]*$  # runs what a cell has written
      | (?P<target>[\w, \t]+=)[ \t]*[%!].*   # files = !ls: becomes files = None
      | [%!?].*                              # another magic or shell command: becomes pass
      | [\w.]+\?\??$                         # np.mean?: becomes pass
    )""",
    re.M | re.X,
)
# The prompts of Python and IPython, pasted from a terminal or a page: Jupyter drops them too.
_PROMPT = re.compile(r"^[ \t]*(>>>( |$)|In \[\d+\]: |\.{3,}(: ?| |$))", re.M)
_FENCE = re.compile(r"^```.*$", re.M)  # of a code block in a Markdown cell
_CELL_MAGIC = re.compile(r"\s*%%((?:time|timeit|capture|prun)\b)?.*\n?")  # those of Python
# Calls of a program that runs by itself: they do not end, or wait for somebody.
_WAITING_CALLS = re.compile(
    r"(^|\.)(spin\w*|ok)$|^(rclpy\.(init|(try_)?shutdown)|main|input|(cv2\.)?(imshow|waitKey\w*))$"
)


@functools.lru_cache(maxsize=2_000)  # most cells are the lesson's, in every notebook
def plain_python(source):
    """The source without magics, prompts, shell commands and indent; its lines stay. As it is if it parses.

    What a magic computes is lost: `files = !ls` gives None. The Python in `%time` and `%%time` stays.
    """
    if source.lstrip().startswith((">>>", "In [")):  # IPython's is an annotation, too
        source = _PROMPT.sub("", source)
    if top_level(source):
        return source
    source = textwrap.dedent(_FENCE.sub("#", source))
    cell_magic = _CELL_MAGIC.match(source)
    if cell_magic and not cell_magic[1]:
        return "#" + "\n#".join(source.splitlines())  # another language
    if cell_magic:
        source = "#\n" * cell_magic[0].count("\n") + source[cell_magic.end() :]
    return _MAGIC.sub(_without_magic, source)


def _without_magic(match):
    if match[0].lstrip().startswith("%time "):
        return match["indent"]
    if match["script"]:
        return f"{match['indent']}exec(open({match['script']!r}, encoding='utf-8').read())"
    return f"{match['indent']}{match['target']} None" if match["target"] else f"{match['indent']}pass"


class NamesUsed(NamedTuple):
    """The names that a statement uses; a function reads what its body reads."""

    binds: set  # `*` stands for an import of everything
    reads: set  # before they are bound
    imports: set  # modules that functions import


def bound_names(source):
    """The names that a source binds at its top level; a set."""
    return {name for statement in top_level(source) for name in names_of(statement).binds}


def top_level(source):
    """The statements of a source; none if it does not parse."""
    try:
        return ast.parse(source).body
    except UNPARSABLE:
        return []


def names_of(statement):
    """The NamesUsed of a statement; none if Python does not compile it."""
    try:
        module = ast.Module([statement], [])
        return names_in(compile(module, "cell", "exec", ast.PyCF_ALLOW_TOP_LEVEL_AWAIT, dont_inherit=True))
    except UNPARSABLE:
        return NamesUsed(set(), set(), set())


def names_in(code):
    """The NamesUsed of a code object, in the order of its instructions: the compiler knows the scopes."""
    names = NamesUsed(set(), set(), set())
    for step in dis.get_instructions(code):
        if isinstance(step.argval, CodeType):
            inner = names_in(step.argval)
            names.reads.update(inner.reads - names.binds)
            names.imports.update(inner.imports)
        elif step.opname in ("STORE_NAME", "STORE_GLOBAL"):
            names.binds.add(step.argval)
        elif step.opname in _LOADS and step.argval not in names.binds and not step.argval.startswith("__"):
            names.reads.add(step.argval)
        elif step.opname == "IMPORT_NAME" and code.co_flags & inspect.CO_OPTIMIZED:
            names.imports.add(step.argval)
        elif "IMPORT_STAR" in f"{step.opname} {step.argrepr}":
            names.binds.add("*")
    return names


def is_part_of(source, whole):
    """Whether all statements of a source stand in another one, such as a stub; comments do not count."""
    try:
        parts, known = ({*map(ast.dump, top_level(text))} for text in (source, whole))
    except UNPARSABLE:
        return False
    return bool(parts) and parts <= known


def is_stub(statement, stub):
    """Whether a statement is a definition as handed out, or one that computes nothing."""
    if not isinstance(statement, DEFINITIONS):
        return False
    return ast.dump(statement) in map(ast.dump, top_level(stub)) or _blank(statement) is not None


def has_stub_line(definition):
    """Whether a definition has the stub's NotImplementedError, and other statements beside it."""
    return len(_blank(definition) or ()) > 1


def _blank(definition):
    """The statements of a function, or of a class and its __init__, if it computes nothing; else None.

    Texts, `...` and `pass` do not count, and nothing is returned before NotImplementedError is raised.
    """
    parts: list[ast.stmt] = []
    for part in definition.body:
        parts += part.body if getattr(part, "name", "") == "__init__" else [part]
    texts = [part for part in parts if isinstance(part, ast.Expr) and isinstance(part.value, ast.Constant)]
    body = [part for part in parts if not isinstance(part, ast.Pass) and part not in texts]
    for part in body:
        if isinstance(part, ast.Raise) and "NotImplementedError" in ast.dump(part):
            return body
        if any(isinstance(inner, ast.Return) for inner in ast.walk(part)):
            return None
    return None if body else body


def program_lines(source, *, is_main=True):
    """[line number, its text] of the calls in a cell that belong to a program which runs by itself.

    They call main(), spin a node, or wait for a window, a key or a person. Below
    `if __name__ == ...` they count if the cell is the main program.
    """
    try:
        return sorted([call.lineno, ast.unparse(call)] for call in _waiting_calls(ast.parse(source), is_main))
    except UNPARSABLE:
        return []


def _waiting_calls(node, is_main):
    for part in ast.iter_child_nodes(node):
        is_of_main = isinstance(part, ast.If) and ast.unparse(part.test).startswith("__name__")
        if not isinstance(part, DEFINITIONS) and (is_main or not is_of_main):
            if isinstance(part, ast.Call) and _WAITING_CALLS.search(ast.unparse(part.func)):
                yield part
            yield from _waiting_calls(part, is_main)
