"""What the programs of this folder share: a node as a lesson defines it, and the loop that spins a node."""

import ast
import signal
import sys
from pathlib import Path

import rclpy
from nbclassroom.authoring.masters import read_master
from rclpy.signals import SignalHandlerOptions

from imgproc_course.ros import dds_profile  # chooses the profile, before the first node

MASTERS = Path(__file__).parents[2] / "notebooks" / "masters"
DEFINITIONS = ast.Import | ast.ImportFrom | ast.FunctionDef | ast.ClassDef


def lesson_definitions(lesson, **names):
    """The imports, functions and classes of a lesson's master, and the names given, which they may read.

    No cell that opens a camera runs; of `if ros_available():`, what stands in it.
    """
    (master,) = MASTERS.glob(f"*_{lesson}.py")
    for cell in read_master(master).cells:
        if cell.kind != "code" or cell.role not in ("", "given"):
            continue
        for node in ast.parse(cell.source).body:
            inner = node.body if isinstance(node, ast.If) else [node]
            definitions = [statement for statement in inner if isinstance(statement, DEFINITIONS)]
            exec(compile(ast.Module(definitions, []), cell.id, "exec"), names)
    return names


def run_assignments(lesson, needed, names):
    """Adds what a lesson's cells compute for the names needed to its definitions, in the lesson's order.

    An assignment to an attribute runs only if the name that it belongs to is needed.
    """
    (master,) = MASTERS.glob(f"*_{lesson}.py")
    for cell in read_master(master).cells:
        if cell.kind != "code" or cell.role not in ("", "given"):
            continue
        for node in ast.parse(cell.source).body:
            targets = node.targets if isinstance(node, ast.Assign) else []
            stored = {part.id for t in targets for part in ast.walk(t) if isinstance(part, ast.Name)}
            if stored & needed:
                exec(compile(ast.Module([node], []), cell.id, "exec"), names)
    return names


def spin(make_node, is_over, result):
    """Spins a node until is_over(node) or Ctrl-C, and prints result(node)."""
    print(dds_profile(), file=sys.stderr)
    # An exception, or the end of the context, may come in the middle of a callback: Ctrl-C sets a flag.
    interrupts = []
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGINT, lambda *_: interrupts.append(True))
    node = make_node()
    try:
        while not interrupts and not is_over(node):
            rclpy.spin_once(node, timeout_sec=1.0)
    finally:
        print(result(node), flush=True)
        node.destroy_node()
        rclpy.try_shutdown()


def looked_for(seconds):
    """The function that tells whether a node's images span so many seconds of the robot's stamps."""
    first = None

    def is_over(node):
        nonlocal first
        if not node.looks:
            return False
        stamp = node.image.header.stamp
        newest = stamp.sec + stamp.nanosec / 1e9
        first = newest if first is None else first
        return newest - first >= seconds

    return is_over
