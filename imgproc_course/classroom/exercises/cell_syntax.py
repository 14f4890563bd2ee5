"""What the sources of a notebook's cells say by their syntax: what they define, and what an answer needs.

Nothing is run. Only the standard library is imported, no other module of ours: the process that reads
notebooks loads this file alone (see `gradebook.submission_reader`).
"""

import ast
import builtins
import contextlib
import hashlib
import re
import symtable
from dataclasses import dataclass
from functools import cache, cached_property, lru_cache
from typing import NamedTuple

_MOST_CACHED = 5_000  # characters: most cells are the lesson's, in every notebook; a long one costs memory
UNPARSABLE = (SyntaxError, ValueError, RecursionError, MemoryError)
_MOST_ADDED = 20_000_000  # characters before the statements of all parts; 3,000 short lines have that
ANSWER_MARK = "# The answer cell:"  # the line between what is taken along and the answer
_TAKEN_MARK = "# From other cells of the notebook, because the answer reads it:"
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
_DEFINITIONS = (*_FUNCTIONS, ast.ClassDef)
_CALLABLE_VALUES = (ast.Lambda, ast.Name, ast.Attribute, ast.Call)
_KINDS = dict.fromkeys(_FUNCTIONS, "function") | {ast.ClassDef: "class", ast.Expr: "expression"}
_EXPRESSIONS_WITH_NAMES = (ast.Lambda, ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)
_MAGIC = re.compile(
    r"""^(?P<indent>[ \t]*)(?![ \t])
    (?: %time[ \t]+(?=[A-Za-z_(])            # %time y = f(): only the magic goes
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
_CHANGING_METHODS = ("add", "append", "clear", "discard", "extend", "fill", "insert", "pop", "popitem")
_CHANGING_METHODS += ("put", "remove", "resize", "reverse", "setdefault", "sort", "update")
# Calls that belong to a program which runs by itself: those that never come to an end, or come once in a
# process, and those that wait for a person.
_ENDLESS_CALLS = re.compile(r"(\w{1,9}\.){0,2}(spin\w{0,22}|(rclpy\.)(init|ok|shutdown|try_shutdown)|ok)")
_WAITING_CALLS = re.compile(
    rf"{_ENDLESS_CALLS.pattern}|main|input|(plt|pyplot)\.show|(cv2\.)?(imshow|waitKey\w{{0,9}})"
)
_PYTHON_MAGICS = ("time", "timeit", "capture", "prun")


def plain_python(source):
    """The source without magics, prompts, shell commands and indent; its lines stay. As it is if it parses.

    What a magic computes is lost: `files = !ls` gives None. The Python in `%time` and `%%time` stays.
    """
    try:
        ast.parse(source)
    except UNPARSABLE:
        source = _FENCE.sub("#", source)
        if indent := _INDENT.match(source):
            source = "\n".join(line.removeprefix(indent[1]) for line in source.split("\n"))
        if _FIRST_PROMPT.match(source):
            source = _PROMPT.sub("", source)
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
    return f"{match['indent']}{match['target']} None" if match["target"] else f"{match['indent']}pass"


def bound_names(source):
    """The names that a source binds at its top level, `*` for an import of everything; a set."""
    return {name for statement in _top_level(source) for name in names_bound_by(statement)}


def _top_level(source):
    """The statements of a source; none if it does not parse."""
    try:
        return ast.parse(source).body
    except UNPARSABLE:
        return []


def names_bound_by(statement):
    """The names that a statement binds where it stands, not inside its functions and classes; a set."""
    names, nodes = set(), [statement]
    while nodes:
        node = nodes.pop()
        if isinstance(node, _DEFINITIONS):
            names.add(node.name)
            continue
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            names |= {_name_of(alias) for alias in node.names}
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names.add(node.id)
        if not isinstance(node, _EXPRESSIONS_WITH_NAMES):
            nodes.extend(ast.iter_child_nodes(node))
    return names


def _name_of(alias):
    return (alias.asname or alias.name).split(".")[0]


def function_definitions(source):
    """What a source defines at its top level that may be called: functions, classes, `f = np.vectorize(g)`.

    {name: BLANK for a stub, else a digest of its body without docstring, or "" if it is long}; of two of one
    name the last that is no stub.
    """
    definitions = {}
    for statement in _top_level(source):
        name, digest = _callable_name(statement), _body_digest(statement)
        if name and (name not in definitions or digest != BLANK):
            definitions[name] = digest
    return definitions


def _callable_name(statement):
    """The name under which a statement defines something to call, or ""."""
    if isinstance(statement, _DEFINITIONS):
        return statement.name
    if isinstance(statement, ast.Assign) and isinstance(statement.value, _CALLABLE_VALUES):
        target = statement.targets[-1]
        return target.id if isinstance(target, ast.Name) else ""
    return ""


_LONGEST_DIGESTED = 6  # statements; a digest tells whether a body is still the stub as handed out
BLANK = "blank"


def _body_digest(statement):
    """BLANK for a stub (see `_is_blank`), a digest of another short body, or ""."""
    if _is_blank(statement):
        return BLANK
    body = _body(statement)
    if not 0 < len(body) <= _LONGEST_DIGESTED:
        return ""
    try:
        text = "\n".join(map(_dump, body))
    except (RecursionError, MemoryError):
        return ""
    return hashlib.sha256(text.encode("utf-8", "replace")).hexdigest()


def _dump(statement):
    """A statement as text; of a function or class the name and the body."""
    if isinstance(statement, _DEFINITIONS):
        return "\n".join([statement.name, *map(_dump, _body(statement))])
    return ast.dump(statement)


def _body(statement):
    """The statements of a function or class without its docstring or `...`; of anything else none."""
    body = statement.body if isinstance(statement, _DEFINITIONS) else []
    is_text = body and isinstance(body[0], ast.Expr) and isinstance(body[0].value, ast.Constant)
    return body[1:] if is_text else body


def _initialization(statement):
    """The statements of the __init__ of a class."""
    body = statement.body if isinstance(statement, ast.ClassDef) else []
    methods = [part for part in body if isinstance(part, _FUNCTIONS) and part.name == "__init__"]
    return _body(methods[-1]) if methods else []


def _is_blank(statement):
    """Whether a statement is a stub: `...`, `pass`, NotImplementedError first or in a class's __init__."""
    if not isinstance(statement, _DEFINITIONS):
        return False
    body = _body(statement)
    if not body or [*map(type, body)] == [ast.Pass]:
        return True
    return _is_not_implemented(body[0]) or any(map(_is_not_implemented, _initialization(statement)))


def functions_with_stub_line(tree):
    """Names of functions that go on after the stub's NotImplementedError, of classes with it in __init__."""
    definitions = [statement for statement in tree.body if isinstance(statement, _DEFINITIONS)]
    return [
        definition.name
        for definition in definitions
        if any(map(_is_not_implemented, _initialization(definition)))
        or (len(_body(definition)) > 1 and _is_not_implemented(_body(definition)[0]))
    ]


def _is_not_implemented(statement):
    error = statement.exc if isinstance(statement, ast.Raise) else None
    error = error.func if isinstance(error, ast.Call) else error
    return isinstance(error, ast.Name) and error.id == "NotImplementedError"


def program_lines(source, *, is_main=True):
    """[line number, its text] of the statements of a cell that belong to a program which runs by itself.

    They call main(), spin a node, loop without an end, or wait for a window, a key or a person. Below
    `if __name__ == ...` they count if the cell is the main program.
    """
    try:
        body = [part for statement in _top_level(source) for part in _parts_to_name(statement, is_main)]
        statements = _statements_that_call(body, _WAITING_CALLS)
        return [[statement.lineno, ast.unparse(statement).split("\n")[0]] for statement in statements]
    except UNPARSABLE:
        return []


def _parts_to_name(statement, is_main):
    """The statements of an `if`, `try` or `with`, or the one itself."""
    if isinstance(statement, ast.If) and not is_main and ast.unparse(statement.test).startswith("__name__"):
        return []
    if isinstance(statement, ast.If | ast.Try | ast.With):
        parts = [node for node in ast.iter_child_nodes(statement) if isinstance(node, ast.stmt)]
        return [inner for part in parts for inner in _parts_to_name(part, is_main)]
    return [statement]


def _statements_that_call(statements, calls):
    """The statements that loop without an end or make such calls, directly or through what they define."""
    nodes = [node for statement in statements for node in ast.walk(statement)]
    called = {node: _names_called(node) for node in nodes if isinstance(node, _DEFINITIONS)}
    called |= {statement: _names_called(statement) for statement in statements if statement not in called}
    names, count = {"while"}, -1
    while len(names) > count:
        count = len(names)
        meant = {node for node, own in called.items() if own & names or any(map(calls.fullmatch, own))}
        own_names = {node.name for node in meant if isinstance(node, _DEFINITIONS)}
        names |= own_names | {f".{name}" for name in own_names}
    return [node for node in statements if node in meant and not isinstance(node, _DEFINITIONS)]


def _names_called(node):
    """What a node calls: f, or a.f and .f; `while` for a loop without an end. A class calls its __init__."""
    names, body = set(), getattr(node, "body", ()) if isinstance(node, ast.ClassDef) else [node]
    body = [part for part in body if part is node or getattr(part, "name", "__init__") == "__init__"]
    for part in (inner for own in body for inner in ast.walk(own)):
        if isinstance(part, ast.Call) and isinstance(part.func, ast.Name | ast.Attribute):
            names |= {f".{getattr(part.func, 'attr', '')}", ast.unparse(part.func)}
        elif isinstance(part, ast.While) and getattr(part.test, "value", False) in (True, 1):
            ends = (ast.Break, ast.Return, ast.Raise, ast.Yield)
            names |= set() if any(isinstance(inner, ends) for inner in ast.walk(part)) else {"while"}
    return names


def without_endless(source):
    """A source without the statements that never come to an end; its lines stay."""
    lines, body, endless = source.split("\n"), _top_level(source), []
    with contextlib.suppress(*UNPARSABLE):
        endless = _statements_that_call(body, _ENDLESS_CALLS)
    for statement in endless:
        first, last = statement.lineno, statement.end_lineno
        if sum(first <= other.end_lineno and other.lineno <= last for other in body) == 1:
            lines[first - 1 : last] = ["#"] * (last - first + 1)
    return "\n".join(lines)


def parts_of(source):
    """The parts in which an answer is run, one after another: an error in one must not cost the others.

    There is one for each statement, a str; the lines of the answer keep their numbers. What says how the rest
    is to be read (`from __future__ import ...`) stands in each of them. The whole source is one part if it
    does not parse, or has far more lines and statements than any answer: the parts grow with their product.
    """
    return [part for cell in cells_of(source) for part in _statements_as_text(cell)]


def cells_of(source):
    """What `compose` took along and the answer itself, if there is both: a list of str."""
    definitions, mark, answer = source.partition(f"{ANSWER_MARK}\n")
    return [cell for cell in (definitions, answer) if cell] if mark else [source] * bool(source)


def _statements_as_text(source):
    statements = _top_level(source)
    starts = [_first_line(statement) for statement in statements]
    ends = [statement.end_lineno for statement in statements]
    share_lines = any(start <= end for start, end in zip(starts[1:], ends, strict=False))
    lines = source.split("\n")
    if share_lines or len(starts) < 2 or ends[-1] > len(lines):
        return [source]
    before = ["#"] * len(lines)
    for statement in statements:
        if isinstance(statement, ast.ImportFrom) and statement.module == "__future__":
            place = slice(statement.lineno - 1, statement.end_lineno)
            before[place] = lines[place]
    if len(starts) * len("\n".join(before)) > _MOST_ADDED:
        return [source]
    places = zip(starts, ends, strict=True)
    return ["\n".join(before[: start - 1] + lines[start - 1 : end]) for start, end in places]


def _first_line(statement):
    decorators = getattr(statement, "decorator_list", ())
    return min([statement.lineno, *(decorator.lineno for decorator in decorators)])


# ---------------------------------------------------------------- what an answer reads from other cells


@dataclass(frozen=True)
class Statement:
    """A statement at the top level of a cell, and the names that it binds, and reads before it binds them."""

    kind: str  # "function", "class", "import", "value" (of plain names), "expression" or "other"
    binds: frozenset
    reads: frozenset
    reads_at_once: frozenset  # where it stands: not in the body of a function or method
    changes: frozenset  # of whose values: `total += 1`, `table[k] = 3`, `names.append(3)`
    source: str
    is_stub: bool

    @property
    def is_definition(self):
        """Whether it is a function or a class."""
        return self.kind in ("function", "class")

    @property
    def runs_at_once(self):
        """Whether it computes where it stands; functions and classes count when they are called."""
        return self.kind in ("value", "expression", "other")


def cached_if_short(function):
    """The function of a source, with its results for short sources cached."""
    cached = lru_cache(maxsize=2_000)(function)
    return lambda source: (cached if len(source) <= _MOST_CACHED else function)(source)


@cached_if_short
def statements_of(source):
    """The top-level statements of a source as a tuple of Statement; an import of two names gives two."""
    try:
        return tuple(_statement(node) for whole in _top_level(source) for node in _imports_apart(whole))
    except UNPARSABLE:
        return ()


def _imports_apart(node):
    if isinstance(node, ast.Import):
        return [ast.Import([alias]) for alias in node.names]
    if isinstance(node, ast.ImportFrom):
        return [ast.ImportFrom(node.module, [alias], node.level) for alias in node.names]
    return [node]


def _statement(node):
    source, binds = ast.unparse(node), frozenset(names_bound_by(node))
    kind, reads, changes = _kind_of(node), _names_read(source), frozenset()
    if kind not in ("function", "class", "import"):
        changes = frozenset(_names_changed(node))
        reads -= _names_bound_first(node)
    reads = frozenset(reads | changes)
    at_once = reads & _names_read_at_once(source) if isinstance(node, _DEFINITIONS) else reads
    return Statement(kind, binds, reads, at_once, changes, source, _is_blank(node))


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
        yield from ((_name_of(alias), True) for alias in node.names)
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


def _names_changed(statement):
    """The names whose values a statement changes without a new assignment."""
    for node in ast.walk(statement):
        if isinstance(node, ast.AugAssign):
            node = node.target
        elif isinstance(node, ast.Call) and getattr(node.func, "attr", "") in _CHANGING_METHODS:
            node = node.func
        elif not isinstance(getattr(node, "ctx", None), ast.Store) or isinstance(node, ast.Name):
            continue
        while isinstance(node, (ast.Attribute, ast.Subscript)):
            node = node.value
        if isinstance(node, ast.Name):
            yield node.id


def _kind_of(node):
    if isinstance(node, (ast.Import, ast.ImportFrom)):
        is_plain = node.names[0].name != "*" and getattr(node, "module", "") != "__future__"
        return "import" if is_plain else "other"
    targets = node.targets if isinstance(node, ast.Assign) else []
    if isinstance(node, ast.AnnAssign) and node.value is not None:
        targets = [node.target]
    names = [name for target in targets for name in getattr(target, "elts", [target])]
    binds_plain_names = names and all(isinstance(name, ast.Name) for name in names)
    return _KINDS.get(type(node), "value" if binds_plain_names else "other")


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


def _names_read_at_once(source):
    """The names that functions and classes read when they are defined: decorators, bases, default values."""
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, _FUNCTIONS):
            node.body = [ast.Pass()]
        elif isinstance(node, ast.Lambda):
            node.body = ast.Constant(None)
    return _names_read(ast.unparse(tree))


def needed_statements(statements, function, *, with_changes=True, helpers=frozenset()):
    """The statements of a cell that a function needs, itself included, in their order.

    `with_changes`: also those that only change a value, such as a loop that fills a table, or a call of a
    function of the cell, or of `helpers`, which are those of other cells.
    """
    names, numbers, size = {function}, set(), -1
    helpers = helpers.union(*(statement.binds for statement in statements if statement.is_definition))
    while len(numbers) > size:
        size = len(numbers)
        needed = map(statements.__getitem__, numbers)
        values = set().union(*(statement.binds for statement in needed if statement.runs_at_once))
        for number, statement in enumerate(statements):
            changes = statement.changes & names or _may_change(statement, values, names, helpers)
            if statement.binds & names or (with_changes and changes):
                numbers.add(number)
                names |= statement.reads
    return [statements[number] for number in sorted(numbers)]


def needed_parts(parts, function):
    """Those of the parts of a cell that a function needs, a set; see `parts_of` and `needed_statements`."""
    statements = [(part, statement) for part in parts for statement in statements_of(part)]
    needed = needed_statements([statement for _, statement in statements], function)
    needed_ids = {id(statement) for statement in needed}
    return {part for part, statement in statements if id(statement) in needed_ids or "*" in statement.binds}


def _may_change(statement, values, names, helpers):
    """Whether a statement may change a value that is needed: `fill(table)` may, `print(table)` does not."""
    if statement.is_definition:
        return statement.reads_at_once & helpers  # a decorator or a base class: `@register`
    if statement.kind == "expression":
        return statement.reads & helpers and (statement.reads - helpers) & names
    return statement.kind == "other" and statement.reads & values


def names_needed(statements, function, helpers=frozenset()):
    """The names that a function and its helpers read from outside their own cell; a set."""
    names, bound_above = set(), {function}
    bound = bound_above.union(*(statement.binds for statement in statements))
    for statement in needed_statements(statements, function, helpers=helpers):
        names |= (statement.reads_at_once - bound_above) | (statement.reads - bound)
        bound_above |= statement.binds
    return names


@dataclass(frozen=True)
class Taken:
    """A definition that is taken along: its name, its kind (see `Statement`) and the number of its cell."""

    name: str
    kind: str
    cell: int


class _Place(NamedTuple):
    """A Statement with its number in its cell, and the number of that cell."""

    cell: int
    number: int
    statement: Statement


class CellDefinitions:
    """What the cells of a notebook define: sources of code, and None for another cell."""

    def __init__(self, cells):
        self._cells = cells

    def compose(self, position, function, given=(), preferred=None, arguments=0):
        """The source by which an answer is graded: what it reads from other cells, then its own cell.

        A name has the value that it has after all cells above the answer ran: its last definition, and what
        changes it, with the earlier values that these read. If no cell above defines it, the first one below
        does. What is given is never bound again, and a built-in name only by a function, a class or an import
        above. `from module import *` may define every name that nothing else defines.

        `position` is that of the answer's cell; `preferred` is {name: position of the cell that defines it}
        for other answers; `arguments` is how many arguments every call gives: their default values count for
        nothing. Returns the source, a tuple of Taken, and the set of names that nothing defines.
        """
        answer = without_endless(_without_stub(self._cells[position], function))
        answer = _without_defaults(answer, function, arguments)
        statements = statements_of(answer)
        own_names = {name for statement in statements for name in statement.binds}
        slice_ = _Slice(self._places_by_name, position, set(given), own_names, preferred or {})
        definitions, names, missing = slice_.of(names_needed(statements, function, self._own) - set(given))
        if not definitions:
            return answer, (), missing
        text = "\n\n".join(place.statement.source for place in definitions)
        return f"{_TAKEN_MARK}\n{text}\n\n{ANSWER_MARK}\n{answer}", _taken(definitions, names), missing

    def calls_left_out(self, position, taken):
        """The calls above an answer that may change a value taken along: [name, number of the cell, 0, call].

        They call functions of the notebook with it, such as `fill(table)`, or a method of a class of its own.
        """
        calls = [
            place for place in self._places if place.statement.kind == "expression" and place.cell < position
        ]
        values = [(one.name, one.cell) for one in taken if one.kind == "value"]
        for name, first in values if calls else ():
            made_by = self._places_by_name[name][-1].statement.reads & self._own
            for cell, _, call in calls:
                runs = made_by if call.source.startswith(f"{name}.") else call.reads & self._own
                if cell >= first and runs and name in call.reads - call.changes:
                    yield [name, cell, 0, call.source]

    @cached_property
    def _places(self):
        """The places of all statements, in order."""
        cells = [statements_of(source or "") for source in self._cells]
        return [_Place(cell, number, one) for cell, own in enumerate(cells) for number, one in enumerate(own)]

    @cached_property
    def _own(self):
        """The names of the functions and classes of the cells."""
        return frozenset().union(*(one.binds for _, _, one in self._places if one.is_definition))

    @cached_property
    def _places_by_name(self):
        """{name: the places of all that bind or change it, in order}."""
        index = {}
        for place in self._places:
            for name in place.statement.binds | place.statement.changes:
                index.setdefault(name, []).append(place)
        return index


def _taken(definitions, names):
    """The definitions of the names that are read, each by its last one: a tuple of Taken."""
    taken = {}
    for cell, _, statement in definitions:
        for name in sorted(statement.binds & names):
            if statement.kind != "other" or name not in taken:
                taken[name] = Taken(name, statement.kind, cell)
        if "*" in statement.binds:
            module = ast.parse(statement.source).body[0].module
            taken[module] = Taken(f"{module}.*", statement.kind, cell)
    return tuple(taken.values())


class _Slice:
    """The statements of other cells that decide what names are when an answer is called: a program slice."""

    def __init__(self, index, position, given, own_names, preferred):
        self._index, self._position, self._preferred = index, position, preferred
        self._given, self._own_names = given, own_names
        self._places = cache(self._find_places)

    def of(self, names):
        """(the places that count, in order; all names that they and the answer read; the undefined ones)."""
        names = self._closure(names)
        places = {place for name in names for place in self._places(name)}
        wanted, taken = set(names), []
        for place in sorted(places, reverse=True):  # from the last statement to the first
            statement = place.statement
            if any(place in self._places(name) for name in (statement.binds | statement.changes) & wanted):
                taken.append(place)
                # Earlier values of what it binds no longer count; a loop or an `if` may leave them.
                if statement.kind != "other":
                    wanted -= statement.binds
                wanted |= self._closure(self._reads(statement))
        unknown = {name for name in names if not self._places(name)}
        missing = {name for name in unknown if not hasattr(builtins, name)}
        return sorted([*taken, *self._imports_of_everything(unknown, missing)]), names, missing

    def _closure(self, names):
        """The names, and all that their definitions read."""
        known_names, waiting = set(), list(names)
        while waiting:
            name = waiting.pop()
            if name not in known_names:
                known_names.add(name)
                for place in self._places(name):
                    waiting += self._reads(place.statement)
        return known_names

    def _reads(self, statement):
        """What a statement reads that is not given; functions run when the answer's cell has run."""
        return (statement.reads_at_once | (statement.reads - self._own_names)) - self._given

    def _find_places(self, name):
        """What binds or changes a name; [] if no cell binds it."""
        is_builtin = hasattr(builtins, name)
        places = [
            place
            for place in self._index.get(name, ())
            if place.cell != self._position
            and not place.statement.binds & self._given
            and not (is_builtin and (place.statement.runs_at_once or place.cell > self._position))
        ]
        binding = [place for place in places if name in place.statement.binds]
        binding = [place for place in binding if not place.statement.is_stub] or binding[-1:]
        cells = self._cells_that_count(name, sorted({place.cell for place in binding}))
        places = [place for place in places if place in binding or not place.statement.is_stub]
        return [place for place in places if place.cell in cells]

    def _cells_that_count(self, name, cells):
        """Those of the cells that bind or change a name: all above the answer, or the first one below."""
        if self._preferred.get(name) in cells:
            return (self._preferred[name],)
        if not cells or cells[0] > self._position:
            return tuple(cells[:1])
        return range(cells[0], self._position)

    def _imports_of_everything(self, unknown, missing):
        """The places of `from module import *` that may define names; for built-in names only those above."""
        return [
            place
            for place in self._index.get("*", ())
            if unknown and place.cell != self._position and (place.cell < self._position or missing)
        ]


def argument_count(source, function):
    """How many arguments without a default value a function of a source takes; 0 if it defines none."""
    counts = [
        len(definition.args.posonlyargs + definition.args.args) - len(definition.args.defaults)
        for definition in _functions_named(source, function)
    ]
    return counts[-1] if counts else 0


def _functions_named(source, name):
    return [node for node in _top_level(source) if isinstance(node, _FUNCTIONS) and node.name == name]


def _without_defaults(source, function, count):
    """The source with None for the default values of the first arguments that read names.

    Every call gives these arguments: `def luma(bgr=frame)` needs no frame. A function that names itself may
    call itself without them.
    """
    for definition in _functions_named(source, function) if "\r" not in source else ():
        if function in _names_read(ast.unparse(definition)):
            continue
        arguments = [*definition.args.posonlyargs, *definition.args.args]
        defaults = zip(arguments[::-1], definition.args.defaults[::-1], strict=False)
        for argument, default in defaults:  # from the last to the first: places before stay
            if arguments.index(argument) < count and _names_read(ast.unparse(default)):
                source = _replaced(source, default, "None")
    return source


def _replaced(source, node, text):
    """The source with another text for a node, on as many lines."""
    lines = source.encode("utf-8", "replace").split(b"\n")
    first, last = node.lineno - 1, node.end_lineno - 1
    before, after = lines[first][: node.col_offset], lines[last][node.end_col_offset :]
    lines[first : last + 1] = [before + text.encode() + b"\n" * (last - first) + after]
    return b"\n".join(lines).decode("utf-8")


def _without_stub(source, function):
    """The source without a stub of the function, if it also defines the function itself."""
    own = [statement for statement in _top_level(source) if _callable_name(statement) == function]
    stubs = [statement for statement in own if _is_blank(statement)]
    if len(stubs) in (0, len(own)):
        return source
    lines = source.split("\n")
    for stub in stubs:
        first, last = _first_line(stub), stub.end_lineno
        lines[first - 1 : last] = ["#"] * (last - first + 1)
    return "\n".join(lines)
