"""What the sources of a notebook's cells say by their syntax: what they define, what waits, and slips.

Nothing is run. Only the standard library is imported, no other module of ours: the process that reads
notebooks loads this file alone (see `gradebook.submission_reader`).
"""

import ast
import difflib
import dis
import inspect
import itertools
import keyword
import re
from types import CodeType
from typing import NamedTuple

UNPARSABLE = (SyntaxError, ValueError, RecursionError, MemoryError)
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
_DEFINITIONS = (*_FUNCTIONS, ast.ClassDef)
_CALLABLE_VALUES = (ast.Lambda, ast.Name, ast.Attribute, ast.Call, ast.Subscript)
_LOADS = ("LOAD_NAME", "LOAD_GLOBAL", "LOAD_FROM_DICT_OR_GLOBALS")
_STORES = ("STORE_NAME", "STORE_GLOBAL")
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
_FIRST_PROMPT = re.compile(r"\s*(>>>( |$)|In \[\d+\]: )")
_PROMPT = re.compile(r"^[ \t]*(>>>( |$)|In \[\d+\]: |\.{3,}(: ?| |$))", re.M)
_FENCE = re.compile(r"^```.*$", re.M)  # of a code block in a Markdown cell
_INDENT = re.compile(r"(?:[ \t]*\n)*([ \t]+)(?=\S)")  # of a whole cell: Jupyter drops it
_CELL_MAGIC = re.compile(r"\s*%%(\w+).*\n?")
# Calls of a program that runs by itself: they do not end, or come once in a process; or they wait.
ENDLESS_CALLS = re.compile(r"\.?(spin\w{0,22}|ok)|rclpy\.(init|(try_)?shutdown)")
_WAITING_CALLS = re.compile(rf"{ENDLESS_CALLS.pattern}|main|input|(cv2\.)?(imshow|waitKey\w{{0,9}})")
_PYTHON_MAGICS = ("time", "timeit", "capture", "prun")
_MOST_CHARACTERS = 5_000  # of a source that is mended: each try reads all of it
_MOST_TRIES = 60
# What a keyboard writes, for what a chat, a word processor or a web page puts in its place.
_PLAIN = {
    **dict.fromkeys("\u201c\u201d\u201e\u201f\u2033\u00ab\u00bb", '"'),
    **dict.fromkeys("\u2018\u2019\u201a\u201b\u2032\u00b4", "'"),
    **dict.fromkeys("\u2010\u2011\u2012\u2013\u2014\u2015\u2212", "-"),
    **dict.fromkeys("\u00a0\u2002\u2003\u2007\u2009\u202f\u3000", " "),
    **dict.fromkeys("\u200b\u200c\u200d\u2060\ufeff\u00ad", ""),
    **{"\u00d7": "*", "\u00f7": "/", "\u2026": "...", "\u2264": "<=", "\u2265": ">=", "\u2260": "!="},
    # The wide forms of East Asian keyboards.
    **{chr(code): chr(code - 0xFEE0) for code in range(0xFF01, 0xFF5F) if not chr(code).isalnum()},
    **{"\u3001": ",", "\u3002": "."},
}
_PLAIN_BY_CODE = str.maketrans(_PLAIN)


def plain_python(source):
    """The source without magics, prompts, shell commands and indent; its lines stay. As it is if it parses.

    What a magic computes is lost: `files = !ls` gives None. The Python in `%time` and `%%time` stays.
    """
    if _FIRST_PROMPT.match(source):  # IPython's is an annotation, too
        source = _PROMPT.sub("", source)
    try:
        ast.parse(source)
    except UNPARSABLE:
        source = _FENCE.sub("#", source)
        if indent := _INDENT.match(source):
            source = "\n".join(line.removeprefix(indent[1]) for line in source.split("\n"))
        cell_magic = _CELL_MAGIC.match(source)
        if cell_magic and cell_magic[1] not in _PYTHON_MAGICS:
            return "#" + "\n#".join(source.splitlines())  # another language
        if cell_magic:
            source = "#\n" * cell_magic[0].count("\n") + source[cell_magic.end() :]
        return _MAGIC.sub(_without_magic, source)
    return source


def _without_magic(match):
    if match[0].lstrip().startswith("%time "):
        return match["indent"]
    if match["script"]:
        return f"{match['indent']}exec(open({match['script']!r}, encoding='utf-8').read())"
    return f"{match['indent']}{match['target']} None" if match["target"] else f"{match['indent']}pass"


class NamesUsed(NamedTuple):
    """The names that a statement binds, and reads before; a function reads what its body reads.

    Modules that functions import are apart; `*` stands for an import of everything.
    """

    binds: set
    reads: set
    imports: set


def bound_names(source):
    """The names that a source binds at its top level; a set."""
    return set().union(*(names.binds for names in names_used(source)))


def top_level(source):
    """The statements of a source; none if it does not parse."""
    try:
        return ast.parse(source).body
    except UNPARSABLE:
        return []


def names_used(source):
    return list(map(names_of, top_level(source)))


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
        elif step.opname in _STORES:
            names.binds.add(step.argval)
        elif step.opname in _LOADS and step.argval not in names.binds and not step.argval.startswith("__"):
            names.reads.add(step.argval)
        elif step.opname == "IMPORT_NAME" and code.co_flags & inspect.CO_OPTIMIZED:
            names.imports.add(step.argval)
        elif "IMPORT_STAR" in f"{step.opname} {step.argrepr}":
            names.binds.add("*")
    return names


def definitions(source):
    """{name: statement} of what may be called: functions, classes, `f = np.vectorize(g)`.

    Of two of one name the last that is no stub.
    """
    found = {}
    for statement in (part for whole in top_level(source) for part in _parts_to_name(whole, is_main=True)):
        name = callable_name(statement)
        if name and (name not in found or not is_blank(statement)):
            found[name] = statement
    return found


def callable_name(statement):
    """The name under which a statement defines something to call, or ""."""
    if isinstance(statement, _DEFINITIONS):
        return statement.name
    if isinstance(statement, ast.Assign | ast.AnnAssign) and isinstance(statement.value, _CALLABLE_VALUES):
        target = statement.targets[-1] if isinstance(statement, ast.Assign) else statement.target
        return target.id if isinstance(target, ast.Name) else ""
    return ""


def is_whole_part(source, stub):
    """Whether a source stands in a stub, as a whole definition of it."""
    return source.strip() in map(str.strip, re.split(r"\n(?=\S)", stub))


def _body(statement):
    """The statements of a function or class without its docstring or `...`; of anything else none."""
    body = statement.body if isinstance(statement, _DEFINITIONS) else []
    is_text = body and isinstance(body[0], ast.Expr) and isinstance(body[0].value, ast.Constant)
    return body[1:] if is_text else body


def _initialization(statement):
    body = statement.body if isinstance(statement, ast.ClassDef) else []
    methods = [part for part in body if isinstance(part, _FUNCTIONS) and part.name == "__init__"]
    return _body(methods[-1]) if methods else []


def is_blank(statement):
    """Whether a statement is a stub: `...`, `pass`, NotImplementedError first or in a class's __init__."""
    if not isinstance(statement, _DEFINITIONS):
        return False
    body = _body(statement)
    if not body or [*map(type, body)] == [ast.Pass]:
        return True
    return _is_not_implemented(body[0]) or any(map(_is_not_implemented, _initialization(statement)))


def has_stub_line(statement):
    """Whether a function goes on after the stub's NotImplementedError, or a class has it in __init__."""
    return any(map(_is_not_implemented, [*_body(statement)[:-1][:1], *_initialization(statement)]))


def _is_not_implemented(statement):
    error = statement.exc if isinstance(statement, ast.Raise) else None
    error = error.func if isinstance(error, ast.Call) else error
    return isinstance(error, ast.Name) and error.id == "NotImplementedError"


def program_lines(source, *, is_main=True):
    """[line number, its text] of the statements of a cell that belong to a program which runs by itself.

    They call main(), spin a node, or wait for a window, a key or a person. Below
    `if __name__ == ...` they count if the cell is the main program.
    """
    try:
        body = [part for statement in top_level(source) for part in _parts_to_name(statement, is_main)]
        found = statements_that_call(body, _WAITING_CALLS)
        return [[node.lineno, ast.unparse(node).split("\n")[0]] for node in found]
    except UNPARSABLE:
        return []


def statements_that_call(statements, calls):
    """Those statements that make such calls, directly or through what they define."""
    nodes = [node for statement in statements for node in ast.walk(statement)]
    definitions = [node for node in nodes if isinstance(node, _DEFINITIONS)]
    names: set[str] = set()
    for _ in range(3):  # one may call another one that stands below it
        names |= {node.name for node in definitions if _makes_call(node, calls, names)}
    others = (node for node in statements if not isinstance(node, _DEFINITIONS))
    return [node for node in others if _makes_call(node, calls, names)]


def _makes_call(node, calls, names):
    """Whether a node makes such a call, or one of these names; a class does so in its __init__."""
    body = node.body if isinstance(node, ast.ClassDef) else [node]
    body = [part for part in body if part is node or getattr(part, "name", "__init__") == "__init__"]
    parts = [inner for own in body for inner in ast.walk(own)]
    called = [part.func for part in parts if isinstance(part, ast.Call)]
    plain = {part.id for part in called if isinstance(part, ast.Name)}
    owned = {(getattr(part.value, "id", ""), part.attr) for part in called if isinstance(part, ast.Attribute)}
    is_named = names & (plain | {name for _, name in owned})
    made = plain | {f".{name}" for _, name in owned} | set(map(".".join, owned))
    return bool(is_named) or any(map(calls.fullmatch, made))


def _parts_to_name(statement, is_main):
    """The statements of an `if`, `try` or `with`, or the one itself."""
    if isinstance(statement, ast.If) and not is_main and ast.unparse(statement.test).startswith("__name__"):
        return []
    if isinstance(statement, ast.If | ast.Try | ast.With):
        parts = [node for node in ast.iter_child_nodes(statement) if isinstance(node, ast.stmt)]
        return [inner for part in parts for inner in _parts_to_name(part, is_main)]
    return [statement]


def plain_character(character):
    """What a keyboard writes for a typographic character, "" for one that nobody sees; None if not known."""
    return _PLAIN.get(character)


def without_slip(source, error):
    """A source that does not parse, mended by one change in a line, and its ast.Module; or None."""
    if len(source) > _MOST_CHARACTERS:
        return None
    for candidate in itertools.islice(_candidates(source, error), _MOST_TRIES):
        try:
            return candidate, ast.parse(candidate)
        except UNPARSABLE:
            continue
    return None


def _candidates(source, error):
    plain = source.translate(_PLAIN_BY_CODE)
    if plain != source:
        yield plain
    if isinstance(error, TabError):
        yield source.expandtabs(4)
        yield source.expandtabs(8)
    lines, number = source.split("\n"), (error.lineno or 1) - 1
    if number >= len(lines):
        return
    for line in _mended_lines(lines[number], error):
        yield "\n".join([*lines[:number], line, *lines[number + 1 :]])


def _mended_lines(line, error):
    """Lines with one space more or less, or with one word made a keyword, which it nearly is: `retrun`."""
    if isinstance(error, IndentationError):
        yield from (f" {line}", line[1:])
    elif "invalid syntax" in error.msg:
        for word in re.finditer(r"[A-Za-z]+", line):
            for name in difflib.get_close_matches(word[0], keyword.kwlist, n=2):
                yield line[: word.start()] + name + line[word.end() :]
