"""Whether ROS can be used here; and if not, stubs with the public names that say what to install."""

import ctypes
import functools
import importlib
import os
import sys

# What this package imports, and visualization_msgs, which lessons import where ROS is available.
MESSAGES = ("sensor_msgs.msg", "geometry_msgs.msg", "nav_msgs.msg", "std_msgs.msg", "visualization_msgs")
MODULES = ("rclpy", "rclpy.node", *MESSAGES, "rcl_interfaces.msg", "std_srvs.srv")


class RosMissingError(ImportError):
    """ROS 2 is not installed here, or cannot be loaded. The text says what to do."""


def import_problem():
    """Why rclpy cannot be imported here, with the remedy, in one line; None if it can be imported."""
    middleware = os.environ.get("RMW_IMPLEMENTATION")
    # If this variable names a middleware that is not installed, rclpy ends the whole process: the kernel.
    if middleware and sys.platform == "linux":
        try:
            ctypes.CDLL(f"lib{middleware}.so")
        except OSError:
            return (
                f"RMW_IMPLEMENTATION={middleware} is set, but that middleware is not installed here; "
                "unset RMW_IMPLEMENTATION, then start again (in a notebook: restart the kernel)"
            )
    for name in MODULES:
        try:
            if getattr(importlib.import_module(name), "__file__", None) is None:
                # What takes the place of ROS in exercises: nothing is sent by it.
                raise ModuleNotFoundError(name=name)
        except ImportError as error:
            own_names = (name, name.partition(".")[0])
            if not isinstance(error, ModuleNotFoundError) or error.name not in own_names:
                version = f"{sys.version_info.major}.{sys.version_info.minor}"
                return (
                    f"ROS 2 is installed, but Python {version} cannot load it ({error}); start JupyterLab "
                    "with environment/lab, or from a shell in which ROS is sourced, with the Python that ROS "
                    "was built for"
                )
            return (
                f"ROS 2 is missing ({name} is not installed), and this needs a running graph; "
                "on Linux x86-64: environment/setup, or in the checkout pip install '.[ros]'. On macOS or "
                "ARM: environment/pixi.toml or environment/Dockerfile. On Windows: WSL. Without ROS, use "
                "open_recording('drive')"
            )
    return None


@functools.cache
def say_what_is_skipped():
    """Once, in a notebook: what cells that ask for ROS do without it, and where their results are."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    if hasattr(shell, "kernel"):
        print(
            "Without ROS 2, the cells that begin with `if ros_available():` do nothing. environment/site"
            " --serve opens the course's pages with their results, and a still image or film in their place."
        )


def refuse_to_run(problem, make_node, args=None):
    """In place of `run_processor`: prints why the node cannot start, in one line, and returns exit code 2."""
    print(f"cannot start: {problem}", file=sys.stderr)
    return 2


def class_stub(name, problem):
    """A class with this name. Creating an object, or calling `current`, raises RosMissingError(problem)."""

    def refuse(*args, **kwargs):
        raise RosMissingError(problem)

    return type(name, (), {"__new__": refuse, "current": staticmethod(refuse), "__doc__": problem})
