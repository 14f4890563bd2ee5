"""Makes `rclpy.spin(node)` in a cell behave as in a script: it blocks, and Interrupt ends it.

Without this, the call needs rclpy.init(), and rclpy's handler of the interrupt signal then shuts down every
context of the process, also the session's.
"""

import functools
import itertools
import sys
from pathlib import Path
from typing import Any

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import uninstall_signal_handlers

RCLPY, OURS = Path(rclpy.__file__).parent, Path(__file__).parents[1]
INTERRUPT_PERIOD = 0.1  # seconds; without rclpy's handler, a signal does not end a wait

_default_global_executor = rclpy.get_global_executor


class InterruptibleExecutor(SingleThreadedExecutor):
    """Spins in a cell. Afterwards, `take_back(node)` lets the session spin its node again."""

    def __init__(self, context, take_back):
        super().__init__(context=context)
        self._take_back = take_back

    def spin_once(self, timeout_sec=None):
        try:
            super().spin_once(INTERRUPT_PERIOD if timeout_sec is None else timeout_sec)
        except Exception as learners_error:  # of a callback
            error: Any = learners_error
            error._render_traceback_ = functools.partial(_learners_traceback, error)  # IPython calls it
            raise

    def remove_node(self, node):
        super().remove_node(node)
        self._take_back(node)


def install(context, take_back):
    """In a notebook, lets rclpy.spin, spin_once and spin_until_future_complete use such an executor."""
    shell: Any = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    if getattr(shell, "kernel", None) is None:
        return
    executor_of = functools.lru_cache(maxsize=1)(InterruptibleExecutor)

    def global_executor():
        if shell.get_parent().get("metadata", {}).get("imgproc_course", {}).get("exercise"):
            text = "an answer cell does not spin, which never ends: delete this line and what calls it"
            error: Any = RuntimeError(text)
            error._render_traceback_ = functools.partial(_learners_traceback, error)
            raise error
        uninstall_signal_handlers()  # rclpy.init() installs them
        return executor_of(rclpy.utilities.get_default_context() if rclpy.ok() else context, take_back)

    rclpy.get_global_executor = global_executor


def uninstall():
    rclpy.get_global_executor = _default_global_executor


def _learners_traceback(error):
    """The lines that IPython shows of an error, without the frames that are rclpy's or ours."""
    entries, trace = [], error.__traceback__
    while trace is not None:
        path = Path(trace.tb_frame.f_code.co_filename)
        if path.parent != RCLPY and OURS not in path.parents:
            entries.append(trace)
        trace = trace.tb_next
    for entry, following in itertools.pairwise([*entries, None]):
        entry.tb_next = following
    shell = sys.modules["IPython"].get_ipython()
    return shell.InteractiveTB.structured_traceback(type(error), error, entries[0])
