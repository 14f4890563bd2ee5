"""The program of an nbval process: the fork server loads while pytest and nbval are imported."""

import json
import os
import socket
import sys
import types

from imgproc_course.classroom.autograder.nbval_process import SOCKET_VARIABLE
from imgproc_course.classroom.autograder.sandbox.bubblewrap import Limits
from imgproc_course.classroom.autograder.sandbox.inside import confine
from imgproc_course.classroom.autograder.sandbox.kernel_factory import KernelFactory


def main():
    """Run pytest with nbval and `nbval_plugin`."""
    # If the other side ended before this line, the socket is closed, and reading the settings fails.
    confine.die_with_parent()
    connection = socket.socket(fileno=int(os.environ.pop(SOCKET_VARIABLE)))
    lines = connection.makefile("r", encoding="utf-8")
    settings = json.loads(lines.readline())
    limits = Limits(**settings["limits"]) if settings["limits"] else None
    kernel_factory = KernelFactory(unsafe=settings["unsafe"], limits=limits)
    _leave_out_kernels_of_nbval()
    import pytest

    from imgproc_course.classroom.autograder.nbval_plugin import GradingPlugin

    plugin = GradingPlugin(connection, lines, settings["folder"], kernel_factory)
    sys.exit(pytest.main(sys.argv[1:], plugins=[plugin]))


def _leave_out_kernels_of_nbval():
    """Spare nbval the import of Jupyter's client and of coverage: `nbval_plugin` has kernels of its own."""
    kernel, cover = types.ModuleType("nbval.kernel"), types.ModuleType("nbval.cover")
    kernel.RunningKernel = kernel.CURRENT_ENV_KERNEL_NAME = None
    cover.setup_coverage = cover.teardown_coverage = None
    sys.modules |= {"nbval.kernel": kernel, "nbval.cover": cover}
