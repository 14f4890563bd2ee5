"""Makes `rclpy.spin(node)` in a cell behave as in a script: it blocks, and Interrupt ends it.

Without this, the call needs rclpy.init(), and rclpy's handler of the interrupt signal then shuts down every
context of the process, also the session's.
"""

import functools
import sys

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import uninstall_signal_handlers

INTERRUPT_PERIOD = 0.1  # seconds; without rclpy's handler, a signal does not end a wait

_default_global_executor = rclpy.get_global_executor


class InterruptibleExecutor(SingleThreadedExecutor):
    """Spins in a cell. Afterwards, `take_back(node)` lets the session spin its node again."""

    def __init__(self, context, take_back):
        super().__init__(context=context)
        self._take_back = take_back

    def spin_once(self, timeout_sec=None):
        super().spin_once(INTERRUPT_PERIOD if timeout_sec is None else timeout_sec)

    def remove_node(self, node):
        super().remove_node(node)
        self._take_back(node)


def install(context, take_back):
    """In a notebook, lets rclpy.spin, spin_once and spin_until_future_complete use such an executor."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    if getattr(shell, "kernel", None) is None:
        return
    executor_of = functools.lru_cache(maxsize=1)(InterruptibleExecutor)

    def global_executor():
        uninstall_signal_handlers()  # rclpy.init() installs them
        return executor_of(rclpy.utilities.get_default_context() if rclpy.ok() else context, take_back)

    rclpy.get_global_executor = global_executor


def uninstall():
    """Gives rclpy its own executor back."""
    rclpy.get_global_executor = _default_global_executor
