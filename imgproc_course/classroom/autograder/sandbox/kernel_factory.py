"""Give out kernels, one after another. The next kernels are forked while one is at work."""

from imgproc_course.classroom.autograder.sandbox import bubblewrap
from imgproc_course.classroom.autograder.sandbox.cgroups import ProcessGroup
from imgproc_course.classroom.autograder.sandbox.fork_server_client import ForkedKernel, ForkServer


class KernelFactory:
    """Starts kernels; a context manager.

    unsafe   True: without a sandbox, as the user who grades
    limits   Limits of one kernel, None for the default ones
    """

    def __init__(self, *, unsafe=False, limits=None):
        self._confined = not unsafe
        self.limits = limits or bubblewrap.Limits()
        self._group = ProcessGroup(self.limits.memory, self.limits.processes, use_cgroups=self._confined)
        self._fork_server = ForkServer(self._group, confined=self._confined)
        self._fork_server.start()
        self._spares = {}  # request: the kernel that waits for it

    def start(self, allowed, seconds, next_requests=()):
        """Start a ForkedKernel, and others that wait (see `keep_spares`).

        Its modules are `allowed`, beside those of every answer. Its first case, and so every case that
        shares it, may use so many seconds of processor time.
        """
        request = (tuple(allowed), seconds)
        kernel = self._spares.pop(request, None)
        if kernel is not None and not kernel.is_alive():
            kernel.stop()
            kernel = None
        kernel = kernel or self._fork(request)
        self.keep_spares(next_requests)
        return kernel

    def _fork(self, request, *, has_time=False):
        return ForkedKernel(self._fork_server, *request, self.limits, has_time=has_time)

    def keep_spares(self, requests):
        """Let a kernel wait for each of these requests, (allowed, seconds), and no others."""
        requests = [(tuple(allowed), seconds) for allowed, seconds in requests]
        for request in [request for request in self._spares if request not in requests]:
            self._spares.pop(request).stop()
        for request in requests:
            self._spares[request] = self._spares.get(request) or self._fork(request, has_time=True)

    def close(self):
        """End all kernels and the fork server."""
        self.keep_spares([])
        self._fork_server.stop()
        self._group.remove()

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self.close()
