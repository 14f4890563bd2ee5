"""Every pattern of the packages takes a time that grows with its text, not with the square of its text.

A pattern that looks harmless can hold a grading process for hours: a learner chooses the text.
"""

import ast
import builtins
import importlib
import itertools
import re
import signal
import time
from pathlib import Path

import pytest

import imgproc_course
import nbclassroom

PACKAGES = [Path(package.__file__).parent for package in (imgproc_course, nbclassroom)]
METHODS = ("match", "fullmatch", "search", "findall", "finditer", "split", "sub", "subn")
SMALL, LARGE = 4 << 10, 2 << 20  # characters
# Processor time for one text. A linear pattern needs a fraction of a second, a quadratic one minutes.
SECONDS = 10
ALPHABET = "a0_ /\n.-(`\"'é"


class Sample(str):
    """Stands for a local name in a pattern that is put together: rf"\\b{name}\\b"."""

    def __getattr__(self, name):
        return self


class _Names(dict):
    def __missing__(self, name):
        return Sample("x")


def modules():
    """(module, its syntax tree) of every module of the package that has patterns."""
    paths = [(path, package) for package in PACKAGES for path in sorted(package.rglob("*.py"))]
    for path, package in paths:
        source = path.read_text(encoding="utf-8")
        if re.search(r"^import re$", source, re.M):
            name = ".".join(path.relative_to(package.parent).with_suffix("").parts)
            yield importlib.import_module(name), ast.parse(source)
        else:
            assert not re.search(r"\bre\.\w+\(|from re import", source), path


def methods_of(name, trees):
    """How the package uses a compiled pattern: {"fullmatch"} of `_ID.fullmatch(...)`."""
    return {
        node.attr
        for tree in trees
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute)
        and node.attr in METHODS
        and ast.unparse(node.value).split(".")[-1] == name
    } or {"finditer"}


def patterns_in(module, tree, trees):
    """(place, compiled pattern, methods) of a module's own patterns."""
    for name, value in vars(module).items():
        if isinstance(value, re.Pattern) and f"{name} = " in Path(module.__file__).read_text("utf-8"):
            yield f"{module.__name__}.{name}", value, methods_of(name, trees)
        elif isinstance(value, tuple | list):
            rows = [row if isinstance(row, tuple | list) else (row,) for row in value]
            yield from (
                (f"{module.__name__}.{name}", cell, {"search"})
                for cell in itertools.chain.from_iterable(rows)
                if isinstance(cell, re.Pattern)
            )
    for node in ast.walk(tree):
        if not (isinstance(node, ast.Call) and re.fullmatch(r"re\.\w+", ast.unparse(node.func))):
            continue
        method = ast.unparse(node.func).removeprefix("re.")
        if method in METHODS:
            code = compile(ast.Expression(node.args[0]), "pattern", "eval")
            pattern = eval(code, _Names(vars(builtins) | vars(module)))
            yield f"{module.__name__}, line {node.lineno}", re.compile(pattern), {method}
        else:
            assert method in ("compile", "escape"), f"{module.__name__}, line {node.lineno}: re.{method}"


@pytest.fixture(scope="module")
def patterns():
    """[(place, compiled pattern, methods)], each pattern once."""
    found = list(modules())
    trees = [tree for _, tree in found]
    rows = [row for module, tree in found for row in patterns_in(module, tree, trees)]
    return list({(row[1].pattern, *sorted(row[2])): row for row in rows}.values())


def units_for(pattern):
    """(beginning, what is repeated after it) of texts that may be hard, from the pattern's own text."""
    source = pattern.pattern if isinstance(pattern.pattern, str) else pattern.pattern.decode("latin-1")
    pieces = re.split(r"\\[A-Za-z]|(?<!\\)[\[\](){}*+?.|^$]+", source)
    words = sorted({re.sub(r"\\(\W)", r"\1", piece) for piece in pieces if len(piece) > 1})
    letters = dict.fromkeys(ALPHABET + "".join(re.findall(r"[^\w\\\[\]+*?{}|^$]", source)))
    units = [*letters, *map("".join, itertools.permutations(letters, 2)), *words]
    return [("", unit) for unit in units] + list(itertools.product(words, letters))


def text_of(start, unit, length):
    return start + (unit * (length // len(unit) + 1))[:length] + "\0"


def run(pattern, methods, text):
    """Use a pattern on a text; returns its processor time, or raises TimeoutError."""

    def stop(_signal, _frame):
        raise TimeoutError

    if isinstance(pattern.pattern, bytes):
        text = text.encode("latin-1", "replace")
    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS)
    start = time.process_time()
    try:
        for method in methods:
            if method in ("match", "fullmatch", "search"):
                getattr(pattern, method)(text)
            else:
                for _ in pattern.finditer(text):
                    pass
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)
    return time.process_time() - start


def test_no_pattern_is_quadratic(patterns):
    assert len(patterns) > 60
    slow = []
    for place, pattern, methods in patterns:
        try:
            # Which text is the hardest is seen on short ones; that choice decides nothing.
            hardest = max(units_for(pattern), key=lambda unit: run(pattern, methods, text_of(*unit, SMALL)))
            run(pattern, methods, text_of(*hardest, LARGE))
        except TimeoutError:
            slow.append(f"{place}: {pattern.pattern!r}")
    assert slow == []
