"""An ImageProcessor as a process of its own: from its first line to a quiet end."""

import sys
from collections.abc import Callable
from typing import Any

import rclpy
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

from imgproc_course.ros.stop_signals import stop_signals
from imgproc_course.ros.stream_statistics import statistics_line

EXPECTED_SIGNALS = 2  # under `ros2 launch` Ctrl-C comes twice, from the terminal and from launch


def run_processor(make_node: Callable[[], Any], args: list[str] | None = None) -> int:
    """Runs an ImageProcessor until Ctrl-C, SIGTERM, or until ROS is shut down.

    Parameters
    ----------
    make_node : function without arguments that returns the node
    args : arguments for ROS; None for those of the command line, which may contain no others

    Returns
    -------
    int, the exit code: 0, or 2 if the node could not start (the reason is one line on stderr)
    """
    from imgproc_course.ros import dds_profile  # not at the top: the package imports this module

    node = None
    # The current image is finished, and no other is begun.
    with stop_signals(EXPECTED_SIGNALS) as stopping:
        try:
            try:
                if args is None:
                    _refuse_other_arguments(sys.argv)
                # ROS's own handlers would shut the context down from another thread, in the middle of a call.
                rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
                node = make_node()
            except (ValueError, RuntimeError, ParameterException) as error:
                print(f"cannot start: {' '.join(str(error).split())}", file=sys.stderr)
                return 2
            profile, logger = dds_profile(), node.get_logger()
            (logger.warning if profile.note else logger.info)(f"DDS profile: {profile}")
            node.spin(stopping.is_set)
        except (KeyboardInterrupt, ExternalShutdownException):
            pass
        finally:
            if node is not None:
                print(f"{node.get_name()}: {statistics_line(node.statistics())}", file=sys.stderr)
                node.destroy_node()
            rclpy.try_shutdown()
    return 0


def _refuse_other_arguments(command_line):
    """ROS ignores them silently: `--low 40` would start a node with the default low."""
    unknown = remove_ros_args(command_line)[1:]
    if unknown:
        raise ValueError(
            f"unknown argument '{' '.join(unknown)}'; set a parameter with --ros-args -p NAME:=VALUE, "
            "remap a topic with --ros-args -r FROM:=TO"
        )
