"""The one small change with which a wrong answer passes its public cases, and a question about that place.

The question has evidence: the change was tried. It does not say what to write.
"""

import ast
import re
import time
from dataclasses import replace
from itertools import combinations, islice

from imgproc_course.classroom.exercises.comparison import compare

_MOST_CHANGES, _SECONDS = 500, 0.7  # of processor time, for all changes of an answer
_CALL_SECONDS = 0.25
# A changed copy of an answer that uses these could do harm.
_HARMFUL = {"open", "os", "shutil", "subprocess", "pathlib", "Path", "sys", "input", "exec", "eval", "socket"}
# {operator: (its sign, what may be meant; for a comparison first the one that differs for equal values)}
_OPERATORS = {
    **{ast.Lt: ("<", ast.LtE, ast.Gt), ast.LtE: ("<=", ast.Lt, ast.GtE), ast.Eq: ("==", ast.NotEq)},
    **{ast.Gt: (">", ast.GtE, ast.Lt), ast.GtE: (">=", ast.Gt, ast.LtE), ast.NotEq: ("!=", ast.Eq)},
    **{
        ast.Add: ("+", ast.Sub),
        ast.Sub: ("-", ast.Add),
        ast.Mult: ("*", ast.Div),
        ast.MatMult: ("@", ast.Mult),
    },
    **{ast.Div: ("/", ast.FloorDiv, ast.Mult), ast.FloorDiv: ("//", ast.Div), ast.And: ("and", ast.Or)},
    **{ast.Or: ("or", ast.And), ast.BitAnd: ("&", ast.BitOr), ast.BitOr: ("|", ast.BitAnd)},
}
_NAMES = "sum mean median, min max, argmin argmax, log log10, minimum maximum, int round, floor ceil, any all"
_NAMES += ", sin cos tan, int8 int16 int32 uint8, uint16 uint32"
_NAMES = [set(names.split()) for names in _NAMES.split(",")]
_WRAPS = (
    "Values wrap around in the dtype of {0}, because they are too small or too large for it. Widen {0} first."
)
_NO_MASK = "{0} holds numbers, and here a mask is needed, True and False. A comparison makes one."
_CONVERSIONS = (_NO_MASK, "{0} > 0"), (_WRAPS, "{0}.astype(float)"), (_WRAPS, "{0}.astype(int)")


def near_miss(exercise, answer):
    """A question about the one small change that makes a ComposedAnswer pass; "" if none does."""
    try:
        tree = ast.parse(answer.source)
    except (SyntaxError, ValueError, RecursionError):
        return ""
    definitions = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    names = set(re.findall(r"\w+", answer.source))
    if names & _HARMFUL or answer.function not in {definition.name for definition in definitions}:
        return ""
    exercise, lines = replace(exercise, time_limit=_CALL_SECONDS), answer.source.splitlines()
    end = time.thread_time() + _SECONDS
    for question, change in islice(_changes(definitions), _MOST_CHANGES):
        before = [_put(*place, new) for *place, new in change]
        try:
            has_passed = _passes(exercise, ast.unparse(ast.fix_missing_locations(tree)), answer.function)
        except (ValueError, SyntaxError):  # a change that Python cannot write
            has_passed = False
        for (*place, _), old in zip(change, before, strict=True):
            _put(*place, old)
        if has_passed:
            line = getattr(before[0], "lineno", 0)
            place = f"\nin your line: {lines[line - 1].strip()}" if line else ""
            return f"With one small change all checks here pass.{place}\n{question}"
        if time.thread_time() > end:
            break
    return ""


def _put(node, field, position, new):
    """Put a value at a place of a tree; what stood there before."""
    values = getattr(node, field)
    if position is None:
        setattr(node, field, new)
        return values
    old, values[position] = values[position], new
    return old


def _passes(exercise, source, function):
    names, _ = exercise.run_answer(source, function)
    pairs = [(case, expected) for case in exercise.cases for expected in case.calls]
    return callable(names.get(function)) and all(
        result.finished
        and not result.changed
        and not compare(value, result.value, case.tolerance, exact_type=exercise.exact_type)
        for case, expected in pairs
        for result, value in [(exercise.call(names[function], expected.arguments), expected.result.value)]
    )


def _changes(definitions):
    """(question, [(node, field, position or None, new value)]) of each change, the likeliest first."""
    places = [place for definition in definitions for place in _places(definition)]
    for rule in _RULES:
        yield from _changes_of(rule, places)
    yield from _exchanged_everywhere([place for place in places if _is_number(place[-1])])
    yield from (change for definition in definitions for change in _converted(definition))


def _changes_of(rule, places):
    alike = {}
    for *place, child in places:
        variants = [(question, (*place, new)) for question, new in rule(child, place[0])]
        yield from ((question, [change]) for question, change in variants)
        # Parts that are alike but for names may have the same mistake: row : row + 2, col : col + 2
        kind = re.sub(r"id='\w+'", "", ast.dump(child))
        key = ast.dump(child.op) if isinstance(child, ast.BinOp) and rule is _operators else kind
        alike.setdefault((key, len(variants)), []).append(variants)
    for group in (group for group in alike.values() if len(group) > 1):
        for same in zip(*group, strict=True):
            yield same[0][0], [change for _, change in same]


def _converted(definition):
    for name in (argument.arg for argument in definition.args.args):
        for text, code in _CONVERSIONS:
            first = ast.parse(f"{name} = {code.format(name)}").body
            yield text.format(name), [(definition, "body", None, first + definition.body)]


def _exchanged_everywhere(numbers):
    for first, second in combinations({place[-1].value for place in numbers}, 2):
        other = {first: ast.Constant(second), second: ast.Constant(first)}
        change = [(*place, other[child.value]) for *place, child in numbers if child.value in other]
        yield f"Are {first} and {second} exchanged?", change


def _places(definition):
    """(node, field, position in a list or None, expression) of each expression of a function."""
    for node in ast.walk(definition):
        for field, value in ast.iter_fields(node):
            for position, child in enumerate(value) if isinstance(value, list) else [(None, value)]:
                if isinstance(child, ast.expr) and not isinstance(node, ast.JoinedStr):
                    yield node, field, position, child


# ---------------------------------------------------------------- (question, new expression) of a change


def _operators(child, _node):
    field = "ops" if isinstance(child, ast.Compare) else "op"
    if not hasattr(child, field):
        return
    code, old = ast.unparse(child), getattr(child, field)
    sign, *others = _OPERATORS.get(type(old[0] if field == "ops" else old), ("",))
    for place, new in enumerate(others):
        is_equal = field == "ops" and place == 0 and sign not in ("==", "!=")
        text = f"Is {sign} right in {code}, or must it be {_OPERATORS[new][0]}?"
        text += " What about a value that is equal?" if is_equal else ""
        yield text, _with(child, **{field: [new(), *old[1:]] if field == "ops" else new()})


def _with(node, **fields):
    return ast.copy_location(type(node)(**{**dict(ast.iter_fields(node)), **fields}), node)


def _parentheses(child, _node):
    for side in ("left", "right") if isinstance(child, ast.BinOp) else ():
        inner = getattr(child, side)
        if isinstance(inner, ast.BinOp):
            if side == "right":
                left = ast.BinOp(child.left, child.op, inner.left)
                new = ast.BinOp(left, inner.op, inner.right)
            else:
                new = ast.BinOp(inner.left, inner.op, ast.BinOp(inner.right, child.op, child.right))
            yield f"Python computes {ast.unparse(inner)} first. Are parentheses missing?", new


def _exchanged(child, _node):
    if isinstance(child, ast.BinOp) and isinstance(child.op, ast.Sub | ast.Div | ast.MatMult | ast.FloorDiv):
        yield _are_exchanged(child.left, child.right), _with(child, left=child.right, right=child.left)
    field = {ast.Call: "args", ast.Tuple: "elts", ast.List: "elts"}.get(type(child))
    if isinstance(child, ast.Slice) and child.lower and child.upper:
        yield _are_exchanged(child.lower, child.upper), _with(child, lower=child.upper, upper=child.lower)
    values = getattr(child, field) if field else []
    if field == "elts" and all(isinstance(value, ast.Constant | ast.UnaryOp) for value in values):
        return  # a table
    for first, second in combinations(range(min(len(values), 4)), 2):
        swapped = list(values)
        swapped[first], swapped[second] = values[second], values[first]
        yield _are_exchanged(values[first], values[second]), _with(child, **{field: swapped})


def _are_exchanged(first, second):
    return f"Are {ast.unparse(first)} and {ast.unparse(second)} exchanged?"


def _is_number(node):
    return isinstance(node, ast.Constant) and type(node.value) is int and node.value < 100_000


def _numbers(child, node):
    """A number one larger or smaller; the index of a channel; an axis; not what == compares with."""
    is_test = isinstance(node, ast.Compare) and isinstance(node.ops[0], ast.Eq)
    if is_test or isinstance(node, ast.AugAssign) or not _is_number(child):
        return
    is_step = isinstance(node, ast.BinOp | ast.Slice | ast.Assign) or _is_range(node)
    for step, word in ((1, "small"), (-1, "large")):
        text = f"Is {child.value} one too {word} in {ast.unparse(node)}?"
        text = text if is_step else f"Is {child.value} right in {ast.unparse(node)}, or {child.value + step}?"
        yield text, ast.copy_location(ast.Constant(child.value + step), child)


def _is_range(node):
    return isinstance(node, ast.Call) and ast.unparse(node.func) == "range"


def _ends(child, node):
    """The begin and the end of a slice or a range."""
    if isinstance(node, ast.Slice):
        yield f"Is {ast.unparse(child)} right in the slice {ast.unparse(node)}?", None
    is_end = isinstance(node, ast.Slice) or (_is_range(node) and child is not node.func)
    if is_end and not _is_number(child):
        for operator, word in ((ast.Add(), "small"), (ast.Sub(), "large")):
            text = f"Is {ast.unparse(child)} one too {word} in {ast.unparse(node)}?"
            yield text, ast.copy_location(ast.BinOp(child, operator, ast.Constant(1)), child)


def _names(child, _node):
    field = {ast.Attribute: "attr", ast.Name: "id"}.get(type(child))
    old = getattr(child, field) if field else ""
    for new in sorted({name for names in _NAMES if old in names for name in names} - {old}):
        yield f"Is {old} right, or must it be {new}?", _with(child, **{field: new})


def _added(child, node):
    if isinstance(node, ast.BinOp):
        if isinstance(node.op, ast.MatMult):
            yield f"Must {ast.unparse(child)} be transposed?", ast.Attribute(child, "T")
        yield f"Must {ast.unparse(child)} be squared?", ast.BinOp(child, ast.Pow(), ast.Constant(2))


def _parts(child, _node):
    """A part of an expression alone: of ~mask, image.T, abs(a), values[::-1], a + b."""
    parts = [getattr(child, field, None) for field in ("operand", "value", "left", "right")]
    if isinstance(child, ast.Call):
        parts += [getattr(child.func, "value", None), *child.args[:1]]
    for part in parts:
        if isinstance(part, ast.expr):
            yield f"Is {ast.unparse(child)} right, or is {ast.unparse(part)} enough?", part


_RULES = (_operators, _parentheses, _exchanged, _numbers, _ends, _names, _added, _parts)
