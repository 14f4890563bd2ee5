"""The one small change with which a wrong answer passes its public cases, and a question about that place.

The question has evidence: the change was tried. It does not say what to write.
"""

import ast
import re
import time
from dataclasses import replace
from itertools import combinations, pairwise

from imgproc_course.classroom.exercises.comparison import compare

_MOST_CHANGES, _SECONDS = 600, 1.0  # of processor time, for all changes of an answer
_CALL_SECONDS = 0.25
# A changed copy of an answer that uses these could do harm.
_HARMFUL = {"open", "os", "shutil", "subprocess", "pathlib", "Path", "sys", "input", "exec", "eval", "socket"}
_EQUAL = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt}
_REVERSED = {ast.Lt: ast.Gt, ast.LtE: ast.GtE, ast.Gt: ast.Lt, ast.GtE: ast.LtE}
_REVERSED |= {ast.Eq: ast.NotEq, ast.NotEq: ast.Eq}
_OPERATORS = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Div: ast.FloorDiv, ast.FloorDiv: ast.Div}
_OPERATORS |= {ast.BitAnd: ast.BitOr, ast.BitOr: ast.BitAnd, ast.MatMult: ast.Mult, ast.Mult: ast.Div}
_SIGNS = {ast.Add: "+", ast.Sub: "-", ast.Div: "/", ast.FloorDiv: "//", ast.Mult: "*", ast.MatMult: "@"}
_SIGNS |= {ast.BitAnd: "&", ast.BitOr: "|"}
_FUNCTIONS = ("sum mean", "mean median", "min max", "argmin argmax", "log log10", "minimum maximum")
_FUNCTIONS += ("int round", "floor ceil", "sin cos", "any all", "sum max", "int8 int16", "uint8 int32")
_FUNCTIONS += ("uint16 uint32", "int16 int32")
_FUNCTIONS = [pair for names in _FUNCTIONS for pair in (names.split(), names.split()[::-1])]


def near_miss(exercise, answer):
    """A question about the place where one small change of a ComposedAnswer makes it pass; "" if none does."""
    try:
        tree = ast.parse(answer.source)
    except (SyntaxError, ValueError, RecursionError):
        return ""
    definitions = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    names |= {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    if names & _HARMFUL or answer.function not in {definition.name for definition in definitions}:
        return ""
    exercise, lines = replace(exercise, time_limit=_CALL_SECONDS), answer.source.splitlines()
    end = time.thread_time() + _SECONDS
    for _, (question, line, change) in zip(range(_MOST_CHANGES), _changes(definitions), strict=False):
        before = [(node, field, getattr(node, field)) for node, field, _ in change]
        for node, field, value in change:
            setattr(node, field, value)
        has_passed = _passes(exercise, ast.unparse(ast.fix_missing_locations(tree)), answer.function)
        for node, field, value in before:
            setattr(node, field, value)
        if has_passed:
            place = f" Look at the line {lines[line - 1].strip()}" if line else ""
            return f"With one small change all checks here pass.{place}\n{question}"
        if time.thread_time() > end:
            break
    return ""


def _passes(exercise, source, function):
    names, _ = exercise.run_answer(source, function)
    if not callable(names.get(function)):
        return False
    for case in exercise.cases:
        for expected in case.calls:
            result = exercise.call(names[function], expected.arguments)
            if not result.finished or result.changed:
                return False
            value, tolerance = expected.result.value, case.tolerance
            if compare(value, result.value, tolerance, exact_type=exercise.exact_type):
                return False
    return True


def _changes(definitions):
    """(question, number of a line or 0, [(node, field, value)]) of each change, the likeliest first."""
    nodes = [node for definition in definitions for node in ast.walk(definition)]
    for kind, rule in _RULES:
        # Equal parts, whatever their names, may have the same mistake: row : row + 2, col : col + 2
        alike = {}
        for node in nodes:
            if isinstance(node, kind):
                alike.setdefault(re.sub(r"id='\w+'", "", ast.dump(node)), []).append(node)
        for group in alike.values():
            for same in ([node] for node in group) if len(group) == 1 else (*([node] for node in group), group):
                line = same[0].lineno if isinstance(same[0], ast.expr) else 0
                for (question, *change), *others in zip(*map(rule, same), strict=False):
                    yield question, line, [*change, *(step for _, *more in others for step in more)]
    for definition in definitions:
        yield from _exchanges_everywhere(definition)
        yield from _inputs(definition)


def _equal_values(node):
    for ops, old, new in _replaced(node.ops, _EQUAL):
        text = f"{ast.unparse(node)}: does an equal value count in the right way?"
        yield text, (node, "ops", ops)


def _directions(node):
    for ops, old, new in _replaced(node.ops, _REVERSED):
        yield f"{ast.unparse(node)}: is this comparison the right way round?", (node, "ops", ops)


def _replaced(operators, others):
    for place, old in enumerate(operators):
        if type(old) in others:
            new = others[type(old)]()
            yield [*operators[:place], new, *operators[place + 1 :]], old, new


def _conditions(node):
    new = ast.Or() if isinstance(node.op, ast.And) else ast.And()
    yield "Must both conditions hold (and), or is one of them enough (or)?", (node, "op", new)


def _parentheses(node):
    for side in ("left", "right"):
        inner = getattr(node, side)
        if not isinstance(inner, ast.BinOp):
            continue
        if side == "right":
            left = ast.BinOp(node.left, node.op, inner.left)
            change = [(node, "left", left), (node, "op", inner.op), (node, "right", inner.right)]
        else:
            right = ast.BinOp(inner.right, node.op, node.right)
            change = [(node, "left", inner.left), (node, "op", inner.op), (node, "right", right)]
        yield f"Python computes {ast.unparse(inner)} first. Are parentheses missing?", *change


def _exchanges(node):
    if isinstance(node, ast.BinOp):
        if isinstance(node.op, ast.Sub | ast.Div | ast.MatMult | ast.FloorDiv):
            parts, change = (node.left, node.right), [(node, "left", node.right), (node, "right", node.left)]
            yield _exchanged(*parts), *change
        return
    field = "args" if isinstance(node, ast.Call) else "elts"
    values = getattr(node, field)
    if field == "elts" and all(_is_number(value) for value in values):
        return
    for first, second in combinations(range(min(len(values), 4)), 2):
        swapped = list(values)
        swapped[first], swapped[second] = values[second], values[first]
        yield _exchanged(values[first], values[second]), (node, field, swapped)


def _is_number(node):
    return isinstance(node, ast.Constant | ast.UnaryOp)


def _exchanged(first, second):
    return f"Are {ast.unparse(first)} and {ast.unparse(second)} exchanged?"


def _numbers(node):
    """The whole numbers in an expression; one that is compared with == has no neighbours."""
    if isinstance(node, ast.Compare) and isinstance(node.ops[0], ast.Eq):
        return
    parts = getattr(node.slice, "elts", [node.slice]) if isinstance(node, ast.Subscript) else None
    for number in parts or ast.iter_child_nodes(node):
        if isinstance(number, ast.Constant) and type(number.value) is int and number.value < 10_000:
            for step, word in ((1, "small"), (-1, "large")):
                text = f"Is {number.value} one too {word} in {ast.unparse(node)}?"
                if isinstance(node, ast.keyword | ast.Subscript):
                    text = f"Is {ast.unparse(node)} the right one?"
                yield text, (number, "value", number.value + step)


def _ends(node):
    """The begin and the end of a slice or a range."""
    if isinstance(node, ast.Slice):
        parts = [("lower", node.lower), ("upper", node.upper)]
    else:
        parts = [("args", argument) for argument in node.args] if _name(node) == "range" else []
    for field, part in parts:
        if part is None or isinstance(part, ast.Constant):
            continue
        for op, word in ((ast.Add(), "small"), (ast.Sub(), "large")):
            new = ast.BinOp(part, op, ast.Constant(1))
            value = [new if argument is part else argument for argument in node.args] if field == "args" else new
            yield f"Is {ast.unparse(part)} one too {word} in {ast.unparse(node)}?", (node, field, value)


def _operators(node):
    if type(node.op) in _OPERATORS:
        yield f"Is {_SIGNS[type(node.op)]} the right sign?", (node, "op", _OPERATORS[type(node.op)]())


def _name(call):
    return getattr(call.func, "attr", getattr(call.func, "id", ""))


def _functions(node):
    field = "attr" if isinstance(node, ast.Attribute) else "id"
    for old, new in _FUNCTIONS:
        if getattr(node, field) == old:
            yield f"Is {old} the right one?", (node, field, new)


def _left_out(node):
    """What stands around a value, or a factor beside it, left out."""
    for field, child in ast.iter_fields(node):
        for part in _inner(child):
            yield _enough(child, part), (node, field, part)
        if isinstance(child, list):
            for place, item in enumerate(child):
                for part in _inner(item):
                    yield _enough(item, part), (node, field, [*child[:place], part, *child[place + 1 :]])


def _enough(whole, part):
    return f"Is {ast.unparse(whole)} right, or is {ast.unparse(part)} enough?"


def _inner(node):
    if isinstance(node, ast.UnaryOp):
        yield node.operand
    elif isinstance(node, ast.Call):
        if isinstance(node.func, ast.Attribute):
            yield node.func.value
        yield from node.args[:1]
    elif isinstance(node, ast.Attribute) and node.attr == "T" or isinstance(node, ast.Subscript):
        yield node.value
    elif isinstance(node, ast.BinOp):
        yield from (node.left, node.right)


def _added(node):
    """A square or a transposition that is missing."""
    for side in ("left", "right"):
        part = getattr(node, side)
        if isinstance(node.op, ast.MatMult):
            transposed = ast.Attribute(part, "T")
            yield f"Must {ast.unparse(part)} be transposed?", (node, side, transposed)
        square = ast.BinOp(part, ast.Pow(), ast.Constant(2))
        yield f"Must {ast.unparse(part)} be squared?", (node, side, square)


def _indentation(node):
    """The last line of a block behind it, or the line behind it in it."""
    for field in ("body", "orelse"):
        block = getattr(node, field, None)
        if not isinstance(block, list):
            continue
        for place, (first, second) in enumerate(pairwise([*block, None])):
            inner = getattr(first, "body", None)
            if not inner or isinstance(first, ast.FunctionDef):
                continue
            before, after = block[: place + 1], block[place + 1 :]
            if len(inner) > 1 and not isinstance(inner[-1], ast.Return):
                change = [(first, "body", inner[:-1]), (node, field, [*before, inner[-1], *after])]
                yield _belongs(inner[-1]), *change
            if second is not None and not isinstance(second, ast.FunctionDef):
                yield _belongs(second), (first, "body", [*inner, second]), (node, field, [*before, *after[1:]])


def _belongs(statement):
    line = ast.unparse(statement).splitlines()[0]
    return f"Look at how far {line} is indented: does it belong inside the block above it, or below it?"


def _exchanges_everywhere(definition):
    """Two numbers, or two names, exchanged in the whole function."""
    nodes = list(ast.walk(definition))
    numbers = [node for node in nodes if isinstance(node, ast.Constant) and type(node.value) in (int, float)]
    reads = [node for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)]
    for field, same in (("value", numbers), ("id", reads)):
        values = list(dict.fromkeys(getattr(node, field) for node in same))
        for first, second in combinations(values, 2):
            other = {first: second, second: first}
            pairs = [(node, getattr(node, field)) for node in same]
            change = [(node, field, other[value]) for node, value in pairs if value in other]
            yield f"Are {first} and {second} exchanged?", change[0][0].lineno, change


def _inputs(definition):
    """Each argument as a mask, and as wider numbers."""
    for argument in definition.args.args:
        name = argument.arg
        for text, code in (
            (f"{name} holds numbers, and here a mask is needed: True and False. A comparison makes one.", f"{name} > 0"),
            (f"Too small or too large values wrap around in the dtype of {name}. Widen it first.", f"{name}.astype(float)"),
            (f"Too small or too large values wrap around in the dtype of {name}. Widen it first.", f"{name}.astype(int)"),
        ):
            statement = ast.parse(f"{name} = {code}").body
            yield text, 0, [(definition, "body", [*statement, *definition.body])]


# (kind of node, rule), the likeliest changes first
_RULES = (
    (ast.Compare, _equal_values),
    (ast.AST, _indentation),
    (ast.BinOp, _parentheses),
    ((ast.Tuple, ast.List, ast.Call, ast.BinOp), _exchanges),
    ((ast.keyword, ast.expr, ast.Assign, ast.AugAssign, ast.Slice, ast.Return), _numbers),
    ((ast.Slice, ast.Call), _ends),
    (ast.Compare, _directions),
    (ast.BoolOp, _conditions),
    (ast.BinOp, _operators),
    (ast.AugAssign, _operators),
    ((ast.Name, ast.Attribute), _functions),
    (ast.BinOp, _added),
    (ast.expr, _left_out),
)
