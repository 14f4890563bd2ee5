"""Give out kernels, one after another; the next one is forked while one is at work."""

import contextlib

from nbclassroom.autograder.sandbox import bubblewrap
from nbclassroom.autograder.sandbox.fork_server_client import ForkedKernel, ForkServer


class KernelFactory(contextlib.AbstractContextManager):
    """Starts kernels, `unsafe` ones without a sandbox, as the user who grades; a context manager."""

    def __init__(self, *, unsafe=False, limits=None):
        self.limits = limits or bubblewrap.Limits()
        self._fork_server = ForkServer(self.limits, confined=not unsafe)
        self._fork_server.start()
        self._spare = None  # a kernel that waits: to fork and confine one takes ten milliseconds

    def start(self, allowed, seconds, *, alone=False):
        """Start a ForkedKernel.

        Its modules are `allowed`, beside those of every answer. Its first case, and so every case that
        shares it, may use so many seconds of processor time. `alone`: a new one, while no other one waits.
        """
        if alone:
            self._drop_spare()
        kernel = self._spare or ForkedKernel(self._fork_server, self.limits)
        self._spare = None if alone else ForkedKernel(self._fork_server, self.limits)
        kernel.begin(allowed, seconds)
        return kernel

    def _drop_spare(self):
        if self._spare is not None:
            self._spare.stop()
        self._spare = None

    def __exit__(self, *_error):
        """End all kernels and the fork server."""
        self._drop_spare()
        self._fork_server.close()
