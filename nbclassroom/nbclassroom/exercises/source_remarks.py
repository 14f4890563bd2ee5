"""What is certain about a function from its source alone, in sentences that are true whatever it computes."""

import ast
import re
from collections import Counter
from pathlib import Path

from .cell_syntax import has_stub_line, top_level
from .error_advice import read_phrases
from .running import source_of

_NOT_IN_PLACE = (
    *("astype", "reshape", "flatten", "ravel", "transpose", "byteswap", "clip", "copy", "round"),
    *("upper", "lower", "strip", "replace", "split"),
)
_NEW = re.compile(r"(sorted|np\.(sort|pad|where|abs|round|clip|flip|unique|append|\w*stack))\(.*", re.DOTALL)
_MAY_END = ast.Return | ast.Raise | ast.While | ast.Try | ast.Match
STUB_LINE = "The line with raise NotImplementedError is still there, and ends the function: delete it."
# What is said of an answer, and not of the errors of its calls
SAYS = read_phrases(Path(__file__).with_suffix(".txt").read_text(encoding="utf-8"))


def remarks_on_source(function, errors=(), unheeded=()):
    """Sentences on what is certain from the source of a function or class; [] if the source is not known.

    `errors` are the types that its calls raised, "None" if one of them returned None, "TimeUp" if one did not
    end in time. `unheeded` are arguments that the right answer does not use.
    """
    tree = next(iter(top_level(source_of(function))), None)
    parts = tree.body if isinstance(tree, ast.ClassDef) else [tree]
    functions = [part for part in parts if isinstance(part, ast.FunctionDef)]
    remarks = [text for function in functions for text in _remarks_on_function(function)]
    if isinstance(tree, ast.FunctionDef):
        remarks += _why_none(tree) if "None" in errors and SAYS["return in a loop"] not in remarks else []
        unused = [name for name in _unused(tree) if errors and name not in unheeded]
        remarks += [f"{tree.name}() does not use what it gets: {name}." for name in unused]
        has_loop = any(isinstance(node, ast.While) for node in ast.walk(tree))
        remarks += [SAYS["endless while"]] if "TimeUp" in errors and has_loop else []
    return list(dict.fromkeys(remarks))


def unused_arguments(source, name):
    """What the function of this name in a source gets and does not use."""
    functions = (part for part in top_level(source) if isinstance(part, ast.FunctionDef))
    return tuple(argument for part in functions if part.name == name for argument in _unused(part))


def has_done(source, sentence):
    """Whether all code that a sentence tells to write stands in a source already."""
    advised = re.findall(
        r"(?:[Ww]rite|[Uu]se|[Pp]ad with|:) ([\w.]+(?:\[[^\]]+\]|\((?:[^()]|\([^()]*\))+\)))(?! [-+*/@<>=%])",
        sentence,
    )
    source, *advised = ("".join(text.split()).replace("'", '"') for text in (source, *advised))
    return bool(advised) and all(code in source for code in advised)


def _why_none(tree):
    """Where None can come from: a path without return."""
    if not any(isinstance(node, ast.Return) and node.value for node in ast.walk(tree)):
        yield f"{tree.name}() has no return with a value. Did you forget return?"
    elif not _ends(tree.body[-1], _MAY_END):
        yield SAYS["way without return"].format(name=tree.name)


def _unused(tree):
    count = Counter(node.id for node in ast.walk(tree) if isinstance(node, ast.Name))
    names = [argument.arg for argument in tree.args.args]
    loops = [node for node in ast.walk(tree) if isinstance(node, ast.For) and ast.unparse(node.iter) in names]
    parts = [part for loop in loops for part in getattr(loop.target, "elts", ())]
    unused = [name for name in names if not count[name] and name != "memory"]  # a controller may need none
    return [*unused, *(part.id for part in parts if isinstance(part, ast.Name) and count[part.id] == 1)]


def _ends(statement, kinds):
    """Whether a statement is of one of these kinds, or all its branches end with one."""
    if isinstance(statement, ast.If):
        return all(part and _ends(part[-1], kinds) for part in (statement.body, statement.orelse))
    if isinstance(statement, ast.With):
        return _ends(statement.body[-1], kinds)
    return isinstance(statement, kinds)


def _remarks_on_function(tree):
    if has_stub_line(tree):
        yield STUB_LINE
    if any(isinstance(statement, ast.Return) for statement in tree.body[:-1]):
        yield SAYS["lines that never run"].format(name=f"{tree.name}()")
    yield from _remarks_on_arguments(tree)
    slips = ((_slip(node), node) for node in ast.walk(tree))
    yield from (SAYS[slip].format(code=ast.unparse(node).split("\n")[0]) for slip, node in slips if slip)


def _remarks_on_arguments(tree):
    assigned = [ast.unparse(node.targets[0]) for node in ast.walk(tree) if isinstance(node, ast.Assign)]
    for name in [argument.arg for argument in tree.args.args if argument.arg in assigned]:
        word = re.compile(rf"\b{name}\b")
        first = next(part for part in tree.body if word.search(ast.unparse(part)))
        if name == "memory":
            yield SAYS["another memory"]
        elif isinstance(first, ast.Assign) and not word.search(ast.unparse(first.value)):
            yield SAYS["overwritten"].format(name=name, code=ast.unparse(first))


def _only_sets(loop):
    """Whether a loop gives its variable values that nobody reads."""
    names = [part for part in ast.walk(loop) if isinstance(part, ast.Name)]
    names = [name for name in names if name.id == ast.unparse(loop.target)]
    sets = [name for name in names[1:] if isinstance(name.ctx, ast.Store)]
    read = [name.lineno for name in names if isinstance(name.ctx, ast.Load)]
    return bool(sets) and min(name.lineno for name in sets) > max(read, default=0)


def _leaves_a_round(loop):
    """Whether a loop has a break or continue of its own."""
    own = (part for part in loop.body if not isinstance(part, ast.For | ast.While))
    return any(isinstance(inner, ast.Break | ast.Continue) for part in own for inner in ast.walk(part))


def _slip(node):
    """The key in SAYS of what is certain about one node; "" if nothing is."""
    match node:
        case ast.BoolOp(op=ast.Or(), values=[ast.Compare(), *_, ast.Constant()]):
            return "value beside or"
        case ast.Expr(value=ast.Call(func=ast.Attribute(attr=name))) if name in _NOT_IN_PLACE:
            return "result not kept"
        case ast.Expr() if isinstance(node.value, ast.BinOp) or _NEW.fullmatch(ast.unparse(node)):
            return "result not kept"
        case ast.BinOp(op=ast.LShift() | ast.RShift(), right=ast.BinOp(op=ast.Add() | ast.Sub())):
            return "shift of a sum"
        case ast.For() if _only_sets(node):
            return "loop variable"
        case ast.Expr(value=ast.Compare()):
            return "comparison not used"
        case ast.Compare(ops=[ast.Is() | ast.IsNot()], comparators=[ast.Constant(value=bool())]):
            return "is True"
        case ast.For(body=[*_, last]) if _ends(last, ast.Return) and not _leaves_a_round(node):
            return "return in a loop"
        case ast.BinOp(left=ast.List(elts=[ast.List() | ast.BinOp(left=ast.List())]), op=ast.Mult()):
            return "one row several times"
    return ""
