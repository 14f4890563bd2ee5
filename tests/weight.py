"""What imgproc_course weighs: its lines, and its functions' lengths and complexity.

.venv/bin/python tests/weight.py [CHECKOUT]
"""

import ast
import statistics
import sys
from collections import Counter
from pathlib import Path

# Ceilings to stay under, not records of today.
BUDGET = {"raw lines": 37_292, "code lines": 25_450, "worst complexity": 19}

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


def package_of(parts):
    """The package in which a module counts; the parts of the classroom count one by one."""
    if parts[0] == "classroom":
        return "/".join(parts[: min(2, len(parts) - 1)])
    return parts[0] if len(parts) > 1 else "(modules)"


def weigh(root):
    """(raw and code lines by package, lengths of functions, {place: complexity}) of `root`'s package."""
    raw, code, lengths, complexities = Counter(), Counter(), [], {}
    for path in sorted((root / "imgproc_course").rglob("*.py")):
        parts = path.relative_to(root / "imgproc_course").parts
        text = path.read_text(encoding="utf-8")
        tree = ast.parse(text)
        raw_lines, code_lines = count_lines(text, tree)
        raw[package_of(parts)] += raw_lines
        code[package_of(parts)] += code_lines
        for function in (node for node in ast.walk(tree) if isinstance(node, FUNCTIONS)):
            lengths.append(length(function))
            complexities[f"{'/'.join(parts)}:{function.lineno} {function.name}"] = complexity(function)
    return raw, code, sorted(lengths), complexities


def main(root):
    raw, code, lengths, complexities = weigh(root)
    for package, lines in code.most_common():
        print(f"  {package:24} {raw[package]:6} raw {lines:6} code")
    worst = max(complexities.values())
    middle, tenth = statistics.median(lengths), lengths[int(0.9 * len(lengths))]
    print(f"imgproc_course: {raw.total()} raw, {code.total()} code; worst complexity {worst}; ", end="")
    print(f"functions: median {middle:g}, nine tenths {tenth}, largest {lengths[-1]}")
    limit = BUDGET["worst complexity"]
    too_complex = {place: number for place, number in complexities.items() if number > limit}
    for place, number in sorted(too_complex.items(), key=lambda item: -item[1]):
        print(f"  complexity {number}, at most {limit}: imgproc_course/{place}")
    weight = {"raw lines": raw.total(), "code lines": code.total(), "worst complexity": worst}
    above = [f"{name} {weight[name]}, at most {most}" for name, most in BUDGET.items() if weight[name] > most]
    return f"above the budget: {'; '.join(above)}" if above else None


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1]))
