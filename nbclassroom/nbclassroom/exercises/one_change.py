"""The one small change that makes a wrong answer right: usual ones are tried until every public call passes.

A sentence that points at its place is true whatever the answer means, and it does not give the change away.
"""

import ast
import contextlib
import math
import re
import sys
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from itertools import chain, pairwise, product

from .limited_fork import limit_memory, text_within
from .running import cells_of, code_of, globals_of, source_of

_MOST_SECONDS, _BRANCH_SECONDS = 1.2, 0.3  # for all changes together, and for what never ran
_PER_CALL = 0.1  # seconds, and ten times what the answer takes itself
_LONGEST_SOURCE = 20_000  # characters
_SHORT = 12  # characters: what is shorter is shown with its line
_LIMIT = "is the limit itself included?"
_DIRECTION = "is it the right way round?"
_FIRST = "which of them comes first?"
_ORDERED = ast.Sub | ast.Div | ast.MatMult | ast.Pow  # operators for which the order counts
_ROUNDS = "should it run once, or in each round of the loop?"
_TYPE = "your numbers do not fit into the dtype of {name}. Widen {name} first, with astype."
_QUESTIONS = dict.fromkeys(("int", "round", "float", "floor"), "should it be cut or rounded here?")
_QUESTIONS |= {"abs": "is its sign needed?", "sqrt": "is the root needed?"}
# Calls that have a question of their own
_NEEDED = re.compile(rf"{'|'.join(_QUESTIONS)}|sin|cos|u?int\d+|float\d+")
_ALIKE = "int round floor ceil, min max, argmin argmax, minimum maximum, sin cos, any all, sum mean"
_ALIKE += ", zeros ones, std var, append extend, log log10 log2, atan atan2, argsort sort"
_BEGINNING = re.compile(r"[\d., ()\[\]{}-]+|-?(np|math)\.inf|float\('-?inf'\)|None")  # of a loop
_COMPARISONS: dict[type[ast.cmpop], tuple[tuple[type[ast.cmpop], str], ...]] = {
    ast.Lt: ((ast.LtE, _LIMIT), (ast.Gt, _DIRECTION)),
    ast.LtE: ((ast.Lt, _LIMIT), (ast.GtE, _DIRECTION)),
    ast.Gt: ((ast.GtE, _LIMIT), (ast.Lt, _DIRECTION)),
    ast.GtE: ((ast.Gt, _LIMIT), (ast.LtE, _DIRECTION)),
}
_OPPOSITES = ((ast.Eq, ast.NotEq), (ast.NotEq, ast.Eq), (ast.In, ast.NotIn), (ast.NotIn, ast.In))
_COMPARISONS |= {one: ((other, _DIRECTION),) for one, other in _OPPOSITES}
_OPERATORS = {
    ast.Add: (ast.Sub,),
    ast.Sub: (ast.Add,),
    ast.Mult: (ast.Div, ast.MatMult, ast.Pow),
    ast.MatMult: (ast.Mult,),
    ast.Div: (ast.Mult, ast.FloorDiv),
    ast.FloorDiv: (ast.Div,),
    ast.BitXor: (ast.Pow,),
    ast.BitAnd: (ast.BitOr,),
    ast.BitOr: (ast.BitAnd,),
    ast.LShift: (ast.RShift,),
    ast.RShift: (ast.LShift,),
}


@dataclass(frozen=True)
class _Change:
    """What the `kind`-th possibility of a rule changes at the `number`-th node of a tree."""

    rule: Callable
    number: int
    kind: int
    question: str


def sentence_on_change(function, passes, task=""):
    """Where one change of a Python function makes it pass, a sentence; "" if no usual change does.

    `passes(function, seconds)` tells whether a changed function passes every call within a time for each. The
    numbers in the text of the task are tried in the place of others, and a line that stands in it is right.
    All changes are tried in another process, within limits on time and memory.
    """
    return text_within(lambda: _find_change(function, passes, task), _MOST_SECONDS)


def sentence_on_branch(function, run):
    """A condition of a function that was never true, or always, while `run()` called it; "" if none was."""
    return text_within(lambda: _find_branch(function, run), _BRANCH_SECONDS)


def _find_branch(function, run):
    code, source, ran = code_of(function), source_of(function), set()

    def trace(frame, _event, _argument):
        if frame.f_code is code:
            ran.add(frame.f_lineno - code.co_firstlineno + 1)
            return trace
        return None

    limit_memory()
    sys.settrace(trace)
    run()
    sys.settrace(None)
    tree = ast.parse(source)
    conditions = [node for node in ast.walk(tree) if isinstance(node, ast.If)]
    last = [other for node in conditions for other in node.orelse]  # an elif is one of these
    for node in conditions:
        asks = [type(part) for part in ast.walk(node.test)]  # a comparison of sizes may be for other inputs
        is_telling = node in last or {ast.Eq, ast.Is, ast.In, ast.NotEq, ast.Call} & {*asks}
        blocks = {"never": node.body, "always": node.orelse} if is_telling else {}
        for end, block in blocks.items():
            if block and node.lineno in ran and block[0].lineno not in ran:
                line = block[0].lineno + code.co_firstlineno - 1
                return f"In these checks {ast.unparse(node.test)} was {end} true: line {line} never ran."
    return ""


def _find_change(function, passes, task):
    source, cell = source_of(function), next(iter(cells_of(function).values()), "")
    texts = dict.fromkeys(re.findall(r"(?<![\w.])\d+(?:\.\d+)?\b", task))
    numbers = [float(text) if "." in text else int(text) for text in texts]
    tree = _tree(source if len(source) < _LONGEST_SOURCE else "pass", numbers)
    if not isinstance(tree, ast.FunctionDef | ast.ClassDef):
        return ""
    code, first = code_of(function), cell.partition(source.split("\n")[0])[0].count("\n")
    first = code.co_firstlineno - 1 if code else first
    started = time.perf_counter()
    passes(function, 1)
    seconds = _PER_CALL + 10 * (time.perf_counter() - started)
    limit_memory()  # the answer itself may take more

    def helps(changes):
        changed_function = _compiled(_changed(_tree(source, numbers), changes), function)
        return changed_function is not None and passes(changed_function, seconds)

    nodes, lines = list(ast.walk(tree)), source.split("\n")
    given = {row for row, line in enumerate(map(str.strip, lines), 1) if len(line) > _SHORT and line in task}
    possible = [
        _Change(rule, number, kind, question)
        for rule in _RULES
        for number, node in enumerate(nodes)
        if node is tree or not (getattr(node, "lineno", 0) in given or _stands_in(task, node))
        for kind, (question, _) in enumerate(rule(node, tree))
    ]
    for changes in _groups(possible, nodes):
        if helps(changes):
            return _sentence([nodes[change.number] for change in changes], changes[0].question, lines, first)
    return ""


def _tree(source, numbers):
    """The tree of a function, with the numbers of its task, and the values from which it counts on."""
    (tree,) = ast.parse(source).body
    nodes = list(ast.walk(tree))
    counted = [ast.unparse(node.target) for node in nodes if isinstance(node, ast.AugAssign)]
    assigned = [node for node in nodes if isinstance(node, ast.Assign)]
    starts = [node.value for node in assigned if ast.unparse(node.targets[0]) in counted]
    indices: list[ast.AST] = [node.slice for node in nodes if isinstance(node, ast.Subscript)]
    indices += [node for node in nodes if isinstance(node, ast.Call) and ast.unparse(node.func) == "range"]
    vars(tree).update(numbers=numbers, starts=starts, places={*chain(*map(ast.walk, indices))})
    return tree


def _stands_in(task, node):
    """Whether an expression is one of the task's, and so right."""
    return isinstance(node, ast.BinOp | ast.Call) and len(code := ast.unparse(node)) > _SHORT and code in task


def _sentence(places, question, lines, offset):
    if isinstance(places[0], ast.FunctionDef):
        return f"With one change, these checks pass: {question}"
    numbers = sorted({place.lineno for place in places})
    shown = dict.fromkeys(ast.unparse(place).split("\n")[0].rstrip(":") for place in places)
    code = ", and ".join(list(shown)[:3]) + ", and more like these" * (len(shown) > 3)
    line = lines[numbers[0] - 1].strip().rstrip(":")
    if len(numbers) == 1 and len(code) < min(_SHORT, len(line)):
        code += f" in {line}"
    where = f"line{'s' * (len(numbers) > 1)} {', '.join(str(number + offset) for number in numbers)}"
    return f"With one change in {where}, these checks pass. Look at {code}: {question}"


def _compiled(tree, function):
    names = dict(globals_of(function))
    try:
        with warnings.catch_warnings(action="ignore", category=SyntaxWarning):
            module = ast.fix_missing_locations(ast.Module([tree], []))
            exec(compile(module, "<changed answer>", "exec", dont_inherit=True), names)
    except Exception:  # noqa: BLE001 - such as a default value of the learner's
        return None
    return names.get(tree.name)


def _groups(possible, nodes):
    """Lists of changes to try together: one by one, then those of a kind at several places."""
    for are_usual in (True, False):
        changes = [change for change in possible if (change.rule not in _LAST_RULES) == are_usual]
        yield from ([change] for change in changes)
        groups: dict[tuple, list] = {}
        for change in changes:
            place = nodes[change.number]
            line, code = getattr(place, "lineno", 0), ast.unparse(place)
            for about in (line, _form(place), code, (line, code)):
                groups.setdefault((change.rule, change.kind, change.question, about), []).append(change)
        yield from (group for group in groups.values() if len(group) > 1)


def _form(place):
    """What places have in common that differ only by their names."""
    text = re.sub(r"[^\W\d]\w*", "x", ast.unparse(place))
    return text if len(text) > 2 else place, type(getattr(place, "ctx", None))


def _changed(tree, changes):
    """A tree, with changes in it."""
    nodes = list(ast.walk(tree))
    for change in changes:
        possible = list(change.rule(nodes[change.number], tree))
        if change.kind < len(possible):  # one change can take away the place of the next
            possible[change.kind][1]()
    return tree


def _setting(node, **values):
    return lambda: vars(node).update(values)


def _parsed(text):
    return ast.parse(text, mode="eval").body


def _replacing(node, part):
    """Lets a node become a part of it."""

    def replace():
        node.__class__, node.__dict__ = type(part), {**vars(part), "lineno": node.lineno, "end_lineno": None}

    return replace


def _block_of(node, tree):
    """The list of statements in which a statement stands; [] for anything else."""
    blocks = (getattr(part, name, ()) for part in ast.walk(tree) for name in ("body", "orelse"))
    return next((block for block in blocks if isinstance(block, list) and node in block), [])


def _moving(statement, block, target, place=0):
    """Lets a statement of a block stand in another one."""

    def move():
        block.remove(statement)
        target.insert(place, statement)

    return move


def _superfluous(node, _tree):
    if isinstance(node, ast.BinOp):
        yield "is the second part needed?", _replacing(node, node.left)
    if isinstance(node, ast.BinOp) and isinstance(node.left, ast.BinOp):
        yield "are the last two parts needed?", _replacing(node, node.left.left)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.BitAnd):
        yield "is the first part needed?", _replacing(node, node.right)
    if isinstance(node, ast.If) and not node.orelse:
        yield "is this condition needed?", _setting(node, test=ast.Constant(True))


def _assigned(node, tree):
    block = _block_of(node, tree) if isinstance(node, ast.Assign | ast.AugAssign) else []
    below = block[block.index(node) + 1 :] if block else []
    yield from _assignment(node, below) if block else ()
    if below:
        yield "should it come after what stands below it?", _moving(node, block, block, block.index(node) + 1)
    if block and isinstance(node.value, ast.Constant):
        yield "is this number right?", _setting(node.value, value=math.inf)
    if isinstance(node, ast.Assign) and _BEGINNING.fullmatch(ast.unparse(node.value)):
        for loop in (part for part in ast.walk(tree) if isinstance(part, ast.For | ast.While)):
            if any(loop in ast.walk(part) for part in below):
                yield _ROUNDS, _moving(node, block, loop.body)
            elif block is loop.body:
                around = _block_of(loop, tree)
                yield _ROUNDS, _moving(node, block, around, around.index(loop))


def _assignment(node, below):
    if isinstance(node, ast.AugAssign):
        assigned = ast.Assign([node.target], node.value)
        yield "should it be added, or replace what is there?", _replacing(node, assigned)
        return
    target, value = ast.unparse(node.targets[0]), ast.unparse(node.value)
    if isinstance(node.value, ast.Name | ast.Subscript):
        question = "is it a new array, or another name for the same one?"
        yield question, _setting(node, value=_parsed(f"({value}).copy()"))
    added = ast.AugAssign(node.targets[0], ast.Add(), node.value)
    question = "is this line needed?" if value == "0" else "should it be added, or replace what is there?"
    yield question, _replacing(node, added)
    if below and isinstance(below[0], ast.Assign) and len(below[0].targets) == 1:
        both = f"{target}, {ast.unparse(below[0].targets[0])} = {value}, {ast.unparse(below[0].value)}"

        def join():
            _replacing(node, ast.parse(both).body[0])()
            _setting(below[0], targets=[ast.Name("_", ast.Store())], value=ast.Constant(0))()

        yield "does the line below it need the old value?", join


def _compare(node, _tree):
    if isinstance(node, ast.Compare):
        for number, operator in enumerate(node.ops):
            for comparison, question in _COMPARISONS.get(type(operator), ()):
                ops = [*node.ops[:number], comparison(), *node.ops[number + 1 :]]
                yield question, _setting(node, ops=ops)
    if isinstance(node, ast.BoolOp):
        opposite = ast.And if isinstance(node.op, ast.Or) else ast.Or
        yield "must both be true, or is one enough?", _setting(node, op=opposite())


def _order(node, _tree):
    names = ast.unparse(node) if isinstance(getattr(node, "ctx", None), ast.Store) else ""
    is_as_in_shape = re.fullmatch(r"\(?(h|rows?|height), (w|cols?|width)\)?", names)
    elements = () if is_as_in_shape else getattr(node, "elts", ())
    for first, last in pairwise(elements):
        swapped = {first: last, last: first}
        if ast.dump(first) != ast.dump(last):
            yield _FIRST, _setting(node, elts=[swapped.get(element, element) for element in elements])
    has_order = isinstance(node, ast.BinOp) and isinstance(node.op, _ORDERED)
    if has_order and not isinstance(node.right, ast.Constant):
        yield _FIRST, _setting(node, left=node.right, right=node.left)
    if isinstance(node, ast.BinOp) and isinstance(node.left, ast.BinOp):
        left = ast.BinOp(node.left.left, node.op, node.right)
        yield _FIRST, _setting(node, left=left, op=node.left.op, right=node.left.right)
    if isinstance(node, ast.Call) and len(node.args) > 1:
        yield "is the order of arguments right?", _setting(node, args=[*node.args[:-2], *node.args[:-3:-1]])


def _square(node, tree):
    formulas = [part for part in ast.walk(tree) if isinstance(part, ast.BinOp)]
    if isinstance(node, ast.Name) and any(node in (part.left, part.right) for part in formulas):
        yield "is its square needed?", _replacing(node, _parsed(f"{node.id} ** 2"))


def _parentheses(node, _tree):
    """a / b * c + d becomes a / (b * c + d), and a + b / c becomes (a + b) / c."""
    text = ast.unparse(node) if isinstance(node, ast.BinOp) else ""
    for operator in (" / ", " // ", " * "):
        first, _, rest = text.partition(operator)
        start, _, last = text.rpartition(operator)
        for left, right in ((first, f"({rest})"), (f"({start})", last)) if rest else ():
            with contextlib.suppress(SyntaxError):  # it is within other parentheses
                changed = _parsed(left + operator + right)
                if ast.dump(changed) != ast.dump(node):
                    yield "do parentheses stand where they should?", _replacing(node, changed)


def _operator(node, _tree):
    if isinstance(node, ast.BinOp | ast.AugAssign):
        for operator in _OPERATORS.get(type(node.op), ()):
            yield "is it the right operator?", _setting(node, op=operator())
    if isinstance(node, ast.Break | ast.Continue):
        yield "is it needed?", _replacing(node, ast.Pass())
        yield "should the loop end here, or go on with its next round?", _replacing(node, ast.Continue())
    if isinstance(node, ast.UnaryOp):
        yield _DIRECTION, _replacing(node, node.operand)
        if isinstance(node.op, ast.Not):
            is_none = _parsed(f"{ast.unparse(node.operand)} is None")
            yield "0 counts as False: is None meant?", _replacing(node, is_none)


def _call(node, _tree):
    if not isinstance(node, ast.Call):
        return
    owner, dot, name = ast.unparse(node.func).rpartition(".")
    for alike in next((group.split() for group in _ALIKE.split(", ") if name in group.split()), ()):
        yield "is it the right function?", _setting(node, func=_parsed(f"{owner}{dot}{alike}"))
    if name in _QUESTIONS and node.args:
        yield _QUESTIONS[name], _replacing(node, node.args[0])
    if owner in ("", "np", "math") and node.args and not _NEEDED.fullmatch(name):
        yield "is this call needed?", _replacing(node, node.args[0])
    elif isinstance(node.func, ast.Attribute) and name != "astype":
        yield f"is .{name} needed?", _replacing(node, node.func.value)
    yield from _call_arguments(node, name)


def _call_arguments(node, name):
    for number, keyword in enumerate(node.keywords):
        others = [*node.keywords[:number], *node.keywords[number + 1 :]]
        yield f"is {keyword.arg} needed?", _setting(node, keywords=others)
    if name in ("max", "min") and len(node.args) == 1:
        largest = _parsed(f"{ast.unparse(node)[:-1]}, key={ast.unparse(node.args[0])}.get)")
        yield "of a dict, this compares the keys: are the values meant?", _replacing(node, largest)
    elif name in ("max", "min"):
        sizes = [_parsed(f"abs({ast.unparse(argument)})") for argument in node.args]
        yield "is their sign needed?", _setting(node, args=sizes)
    if name == "len" and node.args:
        yield "is it the right size?", _replacing(node, _parsed(f"{ast.unparse(node.args[0])}.shape[1]"))
    for change in ("+ 1", "- 1", "* 2 + 1") if name == "range" and node.args else ():
        start, stop, step = node.args[:-1][:1], node.args[:2][-1], node.args[2:]
        other = _parsed(f"({ast.unparse(stop)}) {change}")
        yield "does it end at the right place?", _setting(node, args=[*start, other, *step])


def _constant(node, tree):
    value = node.value if isinstance(node, ast.Constant) and node not in tree.starts else None
    if isinstance(value, int | float) and not isinstance(value, bool):
        for number in (value + 1, value - 1, -value, 2 * value, value / 2, value * value):
            if value or number > 0:
                yield "is this number right?", _setting(node, value=number)
        for number in tree.numbers:
            yield "is it the number of the task?", _setting(node, value=number)
    if isinstance(value, bool):
        yield _DIRECTION, _setting(node, value=not value)
    if isinstance(value, str) and re.fullmatch(r"[<>=]?[iu]\d", value):
        yield "can this type hold every value?", _setting(node, value=value.translate({105: "u", 117: "i"}))
    if isinstance(node, ast.Attribute) and re.fullmatch(r"u?int(8|16)|uint32", node.attr):
        yield "can this type hold every value?", _setting(node, attr="int64")


_SIZES = ("{}.size", "{}.shape[0]", "{}.shape[1]", "2 * {} + 1", "{} + 1")


def _size(node, tree):
    is_number = isinstance(node, ast.Constant) and isinstance(node.value, int) and node.value > 2
    is_size = is_number or (isinstance(node, ast.BinOp) and re.fullmatch(r"\d+ \* \d+", ast.unparse(node)))
    for argument, size in product(_arguments(tree), _SIZES) if is_size else ():
        yield "is it the same for every input?", _replacing(node, _parsed(size.format(argument.arg)))


def _arguments(tree):
    """The arguments of a function; a class has none."""
    return tree.args.args if isinstance(tree, ast.FunctionDef) else ()


def _index(node, _tree):
    part = getattr(node, "slice", None)
    indices = getattr(part, "elts", [part])
    if isinstance(node, ast.Slice) and isinstance(node.lower, ast.BinOp):
        lower = _parsed(f"max(0, {ast.unparse(node.lower)})")
        yield "can it begin below 0, which counts from the end?", _setting(node, lower=lower)
    if isinstance(node, ast.Slice) and node.upper:
        end = ast.unparse(node.upper)
        yield "is its last element left out?", _setting(node, upper=_parsed(f"{end} + 1"))
        yield "what does an end of 0 or -0 mean?", _setting(node, upper=_parsed(f"({end}) or None"))
    elif isinstance(part, ast.Slice):
        yield "should it take columns?", _setting(node, slice=ast.Tuple([ast.Slice(), part], ast.Load()))
    elif part and not any(isinstance(index, ast.Slice | ast.Starred) for index in indices):
        for step in ("+ 1", "- 1"):
            moved = _parsed(", ".join(f"{ast.unparse(index)} {step}" for index in indices))
            yield "is it the right place?", _setting(node, slice=moved)


def _argument(node, tree):
    for argument in _arguments(tree) if node is tree else ():
        line = ast.parse(f"{argument.arg} = {argument.arg}.astype(int)").body[0]
        yield _TYPE.format(name=argument.arg), lambda line=line: tree.body.insert(0, line)


def _name(node, tree):
    stored = [part for part in ast.walk(tree) if isinstance(getattr(part, "ctx", None), ast.Store)]
    names = [part.arg for part in _arguments(tree)]
    names += [part.id for part in stored if isinstance(part, ast.Name)]
    if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load) and node.id in names:
        parts = [part for part in ast.walk(tree) if isinstance(part, ast.Call | ast.Tuple | ast.List)]
        groups = [getattr(part, "elts", ()) or getattr(part, "args", ()) for part in parts]
        beside = [ast.unparse(other) for group in groups if node in group for other in group]
        for variable in sorted({*names} - {node.id, *beside}):
            yield "is it the right variable?", _setting(node, id=variable)
        yield "is its sign right?", _replacing(node, _parsed(f"-{node.id}"))
        if node in tree.places:
            return
        for factor, times in (2, "twice, or what stands beside it half"), (3, "three times"):
            yield f"should it count {times}?", _replacing(node, _parsed(f"{factor} * {node.id}"))
        yield _DIRECTION, _replacing(node, _parsed(f"{node.id} == False"))


# The first change that helps counts.
_LAST_RULES = (_index, _name)
_RULES = (
    _argument,
    _superfluous,
    _compare,
    _order,
    _operator,
    _call,
    _constant,
    _assigned,
    _size,
    _square,
    _parentheses,  # these may help by chance, where a square is missing
    *_LAST_RULES,
)
