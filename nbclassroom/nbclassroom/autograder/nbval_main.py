"""The program of an nbval process: the fork server loads while pytest and nbval are imported."""

import json
import socket
import sys
import types

from .sandbox.bubblewrap import Limits
from .sandbox.fork_server_client import KernelFactory
from .sandbox.inside import confine


def main():
    """Run pytest with nbval and `nbval_plugin`; the first argument holds the settings, as JSON."""
    confine.die_with_parent()  # if it has ended already, there is nothing to read from the socket
    settings, arguments = json.loads(sys.argv[1]), sys.argv[2:]
    connection = socket.socket(fileno=settings["socket"])
    kernel_factory = KernelFactory(unsafe=settings["unsafe"], limits=Limits(**settings["limits"]))
    _leave_out_kernels_of_nbval()
    import pytest

    from .nbval_plugin import GradingPlugin

    sys.exit(pytest.main(arguments, plugins=[GradingPlugin(connection, settings["folder"], kernel_factory)]))


def _leave_out_kernels_of_nbval():
    """Spare nbval the import of Jupyter's client and of coverage: `nbval_plugin` has kernels of its own."""
    kernel, cover = types.ModuleType("nbval.kernel"), types.ModuleType("nbval.cover")
    vars(kernel).update(RunningKernel=None, CURRENT_ENV_KERNEL_NAME=None)
    vars(cover).update(setup_coverage=None, teardown_coverage=None)
    sys.modules |= {"nbval.kernel": kernel, "nbval.cover": cover}
