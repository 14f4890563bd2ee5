"""ROS's log in a notebook: plain text below the cell that made the node.

ROS itself writes to stderr. A notebook shows that like an error, below the cell that ran last.
"""

import contextvars
import sys
from typing import Any

import rclpy.node
from rclpy.context import Context
from rclpy.impl.implementation_singleton import rclpy_implementation

_cells: dict[str, contextvars.Context] = {}  # name of a node's logger: in which cell the node was made


def install():
    """Where a notebook shows what C code prints, shows the log of nodes in this way instead."""
    if not hasattr(sys.stdout, "watch_fd_thread"):  # ipykernel's
        return
    ros: Any = Context
    init, get_logger = ros.init, rclpy.node.get_logger
    write = rclpy_implementation.rclpy_logging_rcutils_log

    def init_without_console(context, args=None, **options):
        args = sys.argv if args is None else args
        init(context, [*args, "--ros-args", "--disable-stdout-logs"], **options)

    def get_logger_of_node(name):
        _cells[name] = contextvars.copy_context()
        return get_logger(name)

    def write_and_print(severity, name, text, *caller):
        write(severity, name, text, *caller)  # to /rosout, and to ROS's log file
        in_cell_of(name)(print, f"[{severity.name}] [{name}]: {text}")

    ros.init = init_without_console
    rclpy.node.get_logger = get_logger_of_node
    rclpy_implementation.rclpy_logging_rcutils_log = write_and_print


def in_cell_of(name):
    """`in_cell_of(name)(function, …)` calls a function; what it prints goes below the cell of the node."""
    return _cells.get(name, contextvars.copy_context()).copy().run
