"""What the packages, the masters and the tests weigh in lines, and their ceilings; the packages' functions.

.venv/bin/python tests/weight.py [CHECKOUT]
"""

import ast
import statistics
import sys
from collections import Counter
from pathlib import Path

# Ceilings in lines. A change that needs more takes something away.
CEILINGS = {
    "imgproc_course": 16_000,
    "nbclassroom/nbclassroom": 18_500,
    "notebooks/masters": 23_200,
    "tests": 45_500,  # with those of nbclassroom
}
MOST_COMPLEX = 19
TEXTS = (".py", ".toml", ".yaml", ".txt", ".json")

FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
HAVE_DOCSTRINGS = (*FUNCTIONS, ast.ClassDef, ast.Module)
BRANCHES = (
    *(ast.If, ast.IfExp, ast.For, ast.AsyncFor, ast.While, ast.Assert, ast.ExceptHandler),
    *(ast.match_case, ast.comprehension),
)


def count_lines(text, tree):
    """(all lines, those without docstrings, comments and blank lines) of a module."""
    lines = [line.strip() for line in text.splitlines()]
    dropped = {number for number, line in enumerate(lines, 1) if not line or line.startswith("#")}
    for node in ast.walk(tree):
        if isinstance(node, HAVE_DOCSTRINGS) and ast.get_docstring(node) is not None:
            dropped.update(range(node.body[0].lineno, node.body[0].end_lineno + 1))
    return len(lines), len(lines) - len(dropped)


def length(function):
    """Lines of a function's body after its docstring."""
    if ast.get_docstring(function) is not None:
        return function.end_lineno - function.body[0].end_lineno
    return function.end_lineno - function.body[0].lineno + 1


def complexity(function):
    """McCabe's number with boolean operators and comprehensions, as of radon; inner functions count alone."""
    total, nodes = 1, list(function.body)
    while nodes:
        node = nodes.pop()
        if isinstance(node, BRANCHES):
            total += 1
        if isinstance(node, ast.comprehension):
            total += len(node.ifs)
        if isinstance(node, ast.BoolOp):
            total += len(node.values) - 1
        if not isinstance(node, FUNCTIONS):
            nodes += ast.iter_child_nodes(node)
    return total


def weigh(package):
    """(raw and code lines by folder, lengths of functions, {place: complexity}) of a package."""
    raw, code, lengths, complexities = Counter(), Counter(), [], {}
    for path in sorted(package.rglob("*.py")):
        parts = path.relative_to(package).parts
        text = path.read_text(encoding="utf-8")
        tree = ast.parse(text)
        raw_lines, code_lines = count_lines(text, tree)
        folder = parts[0] if len(parts) > 1 else "(modules)"
        raw[folder] += raw_lines
        code[folder] += code_lines
        for function in (node for node in ast.walk(tree) if isinstance(node, FUNCTIONS)):
            lengths.append(length(function))
            complexities[f"{package.name}/{'/'.join(parts)}:{function.lineno}"] = complexity(function)
    return raw, code, sorted(lengths), complexities


def lines_of(folder):
    """The lines of all sources below a folder."""
    paths = (path for path in folder.rglob("*") if path.suffix in TEXTS)
    return sum(len(path.read_text(encoding="utf-8").splitlines()) for path in paths)


def main(root):
    above, lines = [], {}
    for name in ("imgproc_course", "nbclassroom/nbclassroom"):
        raw, code, lengths, complexities = weigh(root / name)
        for folder, count in code.most_common():
            print(f"  {folder:24} {raw[folder]:6} raw {count:6} code")
        worst = max(complexities.values())
        middle, tenth = statistics.median(lengths), lengths[int(0.9 * len(lengths))]
        print(f"{name}: {raw.total()} raw, {code.total()} code; worst complexity {worst}; ", end="")
        print(f"functions: median {middle:g}, nine tenths {tenth}, largest {lengths[-1]}")
        above += [
            f"complexity {number}, at most {MOST_COMPLEX}: {place}"
            for place, number in complexities.items()
            if number > MOST_COMPLEX
        ]
        lines[name] = raw.total()
    lines["notebooks/masters"] = lines_of(root / "notebooks" / "masters")
    lines["tests"] = lines_of(root / "tests") + lines_of(root / "nbclassroom" / "tests")
    for name, ceiling in CEILINGS.items():
        print(f"{name:24} {lines[name]:6} of {ceiling} lines, room for {ceiling - lines[name]}")
        if lines[name] > ceiling:
            above.append(f"{name}: {lines[name]} lines, at most {ceiling}")
    return "\n".join(above) or None


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1]))
