"""The cells of a lesson for which it makes a difference whether ROS is installed."""

import ast

from needed_cells import names_of, needed_cells, tree_of

# What differs: only these packages import ROS, or choose their messages by it (tests/test_imports.py).
PACKAGES = ("imgproc_course.ros", "imgproc_course.messages")
WIDGETS = {"live_view", "drive"}  # of imgproc_course.display: they import imgproc_course.ros


def cells_of_ros(sources):
    """The cells that use ROS, or anything that a cell of ROS binds, and what they need without ROS.

    What stands under `if ros_available():` runs with ROS only, and needs nothing here.

    Parameters
    ----------
    sources : sequence of str, the code cells of a lesson in order

    Returns
    -------
    list of int, the numbers of these cells in order
    """
    names = [names_of(source) for source in sources]
    differs, chosen = WIDGETS.union(*(names_from(PACKAGES, source) for source in sources)), set()
    for number, (read, bound) in enumerate(names):
        if read & differs:
            chosen.add(number)
            differs |= bound
    names = [
        (names_of(_without_ros(source))[0], bound) for source, (_, bound) in zip(sources, names, strict=True)
    ]
    return needed_cells(names, chosen)


def names_from(packages, source):
    """The names that a cell imports from some packages, or from modules in them."""
    places = tuple(f"{package}." for package in packages)
    imports = [node for node in ast.walk(tree_of(source)) if isinstance(node, ast.ImportFrom)]
    imports = [node for node in imports if f"{node.module}.".startswith(places)]
    return {alias.asname or alias.name for node in imports for alias in node.names}


def _without_ros(source):
    return ast.unparse(_WithoutRos().visit(tree_of(source)))


class _WithoutRos(ast.NodeTransformer):
    """Leaves out what is not reached if ros_available() is False."""

    def visit_If(self, node):
        if _asks(node.test):
            node.body = [ast.Pass()]
        return self.generic_visit(node)

    def visit_IfExp(self, node):
        return self.visit(node.orelse) if _asks(node.test) else self.generic_visit(node)

    def visit_BoolOp(self, node):
        first = node.values[0]
        if isinstance(node.op, ast.Or) and isinstance(first, ast.UnaryOp) and _asks(first.operand):
            return first
        return self.generic_visit(node)


def _asks(node):
    return ast.unparse(node) == "ros_available()"
