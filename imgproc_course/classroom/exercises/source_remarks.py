"""What is certain about a function from its source alone, in sentences that are true whatever it computes."""

import ast
import re
from itertools import pairwise

from imgproc_course.classroom.exercises.running import source_of

_ARRAY_MAKERS = ("array", "zeros", "zeros_like", "empty", "empty_like", "ones", "full", "copy", "astype")
_DISK = ("glob", "rglob", "iterdir", "exists", "is_file", "is_dir", "listdir", "scandir")
_PRODUCT = "{} is the product of two matrices or vectors; a * b multiplies value by value."
STUB_LINE = "The line with raise NotImplementedError is still there, and ends the function: delete it."
_ENDS = (ast.Return, ast.Raise, ast.Continue, ast.Break)


def remarks_on_source(function, errors=(), hints=()):
    """Sentences on what is certain from the source of a function or class; [] if the source is not known.

    `errors` are the types that its calls raised. If the hints use @, an answer with @ needs no remark.
    """
    try:
        source = source_of(function)
        tree = ast.parse(source).body[0]
    except (IndexError, SyntaxError):
        return []
    remarks = [text for node in ast.walk(tree) for text in _remarks_on_node(node, source)]
    functions = [part for part in getattr(tree, "body", ()) if isinstance(part, ast.FunctionDef)]
    for part in functions if isinstance(tree, ast.ClassDef) else [tree]:
        if isinstance(part, ast.FunctionDef):
            remarks += _remarks_on_function(part)
            remarks += _axes_of_positions(part, errors)
    if "IndexError" in errors:
        remarks += [text for node in ast.walk(tree) for text in _values_as_indices(node)]
    if any(" @ " in hint for hint in hints):
        product = _PRODUCT.format("")
        remarks = [remark for remark in remarks if not remark.endswith(product)]
    return list(dict.fromkeys(remarks))


def _remarks_on_node(node, source):
    for kind, rule in _RULES:
        if isinstance(node, kind):
            yield from rule(node, source)


def _always_true(node, _source):
    if not isinstance(node.op, ast.Or) or not isinstance(node.values[0], ast.Compare):
        return
    constants = [value for value in node.values[1:] if isinstance(value, ast.Constant) and value.value]
    if constants:
        yield (
            f"{ast.unparse(node)} is always true, because {ast.unparse(constants[0])} alone counts as"
            f" True. Compare with each of them, or write: in (..., ...)."
        )


def _matrix_product(node, _source):
    if isinstance(node.op, ast.MatMult):
        yield _PRODUCT.format("a @ b")


def _loop_over_uint8(node, source):
    for part in ast.walk(node.test) if "uint8(" in source else ():
        comparison = ast.unparse(part) if isinstance(part, ast.Compare) else ""
        if re.search(r"<= 255$|< 256$", comparison):
            yield (
                f"{comparison} is always true for a uint8: after 255 it goes on with 0. Write for t in"
                " range(256)."
            )


def _two_names_of_one_array(node, _source):
    if len(node.targets) > 1 and _makes_array(node.value):
        first, second, *_ = (ast.unparse(target) for target in node.targets)
        yield (
            f"{first} = {second} = ... gives two names to one array: what you write into {first} is in"
            f" {second} too. Make two arrays, each on a line of its own."
        )


def _remarks_on_call(node, _source):
    name = ast.unparse(node.func)
    if name in ("np.dot", "np.matmul"):
        yield _PRODUCT.format(f"{name}(a, b)")
    if isinstance(node.func, ast.Attribute) and node.func.attr in _DISK:
        yield (
            f".{node.func.attr}() looks on the disk of this computer, where a file or folder of that name"
            " need not exist. Put the result together from the arguments alone."
        )


def _width_before_height(node, _source):
    """width, height = image.shape: the shape begins with the rows."""
    target, value = node.targets[0], ast.unparse(node.value)
    if not isinstance(target, ast.Tuple) or len(target.elts) < 2 or ".shape" not in value[-10:]:
        return
    first, second = (ast.unparse(name) for name in target.elts[:2])
    if re.match(r"(w|width|cols?|columns?)$", first) and re.match(r"(h|height|rows?)$", second):
        yield (
            f"{first} and {second} are exchanged: a shape begins with the number of rows, the height. Write"
            f" {second}, {first} = {value}."
        )


def _makes_array(node):
    return isinstance(node, ast.Call) and ast.unparse(node.func).rpartition(".")[2] in _ARRAY_MAKERS


def _remarks_on_comparison(node, source):
    if len(node.ops) == 1 and ast.dump(node.left) == ast.dump(node.comparators[0]):
        yield f"{ast.unparse(node)} compares a value with itself."
    line = source.splitlines()[node.lineno - 1].encode()
    for part in (node.left, *node.comparators):
        is_mask = isinstance(part, ast.BinOp) and isinstance(part.op, ast.BitAnd | ast.BitOr)
        if is_mask and line[part.col_offset - 1 : part.col_offset] != b"(" and part.lineno == node.lineno:
            yield (
                f"Python computes {ast.unparse(part)} first, before the comparison. Put each comparison in"
                " parentheses: (a > b) & ~c."
            )


def _else_of_last_if(node, _source):
    """An else after several ifs about one value belongs to the last of them only."""
    bodies = (getattr(node, name, None) for name in ("body", "orelse"))
    pairs = (pair for body in bodies if isinstance(body, list) for pair in pairwise(body))
    for first, last in pairs:
        tests = [_equality(statement) for statement in (first, last)]
        if (
            None not in tests
            and ast.dump(tests[0].left) == ast.dump(tests[1].left)
            and not isinstance(first.body[-1], _ENDS)
            and last.orelse
            and not first.orelse
        ):
            yield (
                f"The else belongs to the last if only, so it also runs if {ast.unparse(tests[0])}. Write"
                " elif in place of every if but the first."
            )


def _equality(statement):
    """The test `a == b` of an if, or None."""
    test = statement.test if isinstance(statement, ast.If) else None
    return test if isinstance(test, ast.Compare) and isinstance(test.ops[0], ast.Eq) else None


# (kind of node, rule)
_RULES = (
    (ast.BoolOp, _always_true),
    (ast.BinOp, _matrix_product),
    (ast.Call, _remarks_on_call),
    (ast.Assign, _width_before_height),
    (ast.While, _loop_over_uint8),
    (ast.Compare, _remarks_on_comparison),
    (ast.Assign, _two_names_of_one_array),
    (ast.AST, _else_of_last_if),
)


def _remarks_on_function(tree):
    if any(_is_stub_line(statement) for statement in tree.body[:-1]):
        yield STUB_LINE
    parameters = {argument.arg for argument in tree.args.args}
    for node in ast.walk(tree):
        target = getattr(node, "target", None) if isinstance(node, ast.For) else None
        if isinstance(target, ast.Name) and target.id in parameters:
            yield (
                f"The loop for {target.id} in ... writes over the argument {target.id}. Give the variable"
                " of the loop another name."
            )


def _axes_of_positions(tree, errors):
    """argmax and argmin along the wrong axis, or along none, if the positions led to an error."""
    parameters = {argument.arg for argument in tree.args.args}
    for call in ast.walk(tree):
        name = getattr(getattr(call, "func", None), "attr", "")
        if name not in ("argmax", "argmin"):
            continue
        is_numpy = ast.unparse(call.func.value) in ("np", "numpy")
        given = [*([] if is_numpy else [call.func.value]), *call.args, *(key.value for key in call.keywords)]
        array, *axes = [ast.unparse(value) for value in given] or [""]
        if "IndexError" in errors and axes == ["0"]:
            yield f"{name}(axis=0) gives a row's position for each column. For each row, write axis=1."
        if "TypeError" in errors and not axes and array in parameters:
            yield f"{name}() without axis gives one position in all. {name}(axis=1) gives one for each row."


def _is_stub_line(statement):
    return isinstance(statement, ast.Raise) and "NotImplementedError" in ast.unparse(statement)


def _values_as_indices(node):
    """A loop over an array gives its values; an index that is one of them is mostly outside."""
    if not isinstance(node, ast.For) or not isinstance(node.iter, ast.Name):
        return
    if not isinstance(node.target, ast.Name):
        return
    value, array = node.target.id, node.iter.id
    subscripts = [inner for inner in ast.walk(node) if isinstance(inner, ast.Subscript)]
    # A value that has indices of its own, as in change[ray[:-1]], is no index itself.
    names = {part for inner in subscripts for part in ast.walk(inner.slice) if isinstance(part, ast.Name)}
    if any(name.id == value for name in names - {inner.value for inner in subscripts}):
        yield (
            f"for {value} in {array} gives the values of {array}, not their positions. For positions write a"
            f" loop over range({array}.shape[0])."
        )
