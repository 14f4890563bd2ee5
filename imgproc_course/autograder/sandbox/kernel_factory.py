"""Give out kernels of either kind, one after another. The next kernel is forked while one is at work."""

from imgproc_course.autograder.sandbox import bubblewrap
from imgproc_course.autograder.sandbox.cgroups import ProcessGroup
from imgproc_course.autograder.sandbox.fork_server_client import ForkedKernel, ForkServer

KINDS = ("fast", "ipykernel")


class KernelFactory:
    """Starts kernels; a context manager.

    kind     "fast": forked from a process that has the imports loaded; "ipykernel": Jupyter's own kernel, one
             process each, over ipc
    unsafe   True: without a sandbox, as the user who grades
    limits   Limits of one kernel, None for the default ones
    """

    def __init__(self, kind="fast", *, unsafe=False, limits=None):
        if kind not in KINDS:
            raise ValueError(f"kernel {kind!r}: expected {' or '.join(KINDS)}")
        self._kind, self._confined = kind, not unsafe
        self.limits = limits or bubblewrap.Limits()
        self._group = ProcessGroup(self.limits.memory, self.limits.processes, use_cgroups=self._confined)
        self._fork_server = ForkServer(self._group, confined=self._confined)
        if kind == "fast":
            self._fork_server.start()
        self._spare, self._spare_request = None, None

    def start(self, allowed, seconds, next_request=None):
        """Start a new kernel.

        Parameters
        ----------
        allowed : sequence of str, modules that it has beside those that every answer may use
        seconds : float, processor time that the first case may use, and with it all that share the kernel
        next_request : (allowed, seconds) of the kernel that will be needed next, or None

        Returns
        -------
        ForkedKernel or IPykernelClient
        """
        request = (tuple(allowed), seconds)
        if self._kind == "ipykernel":
            # Only this kind needs jupyter_client, whose import takes a quarter of a second.
            from imgproc_course.autograder.sandbox.ipykernel_client import IPykernelClient

            return IPykernelClient(*request, self.limits, self._group, confined=self._confined)
        if self._spare_request == request and not self._spare.is_alive():
            self._drop_spare()
        if self._spare_request == request:
            kernel, self._spare, self._spare_request = self._spare, None, None
        else:
            kernel = self._fork(request)
        next_request = next_request and (tuple(next_request[0]), next_request[1])
        if self._spare_request != next_request:
            self._drop_spare()
            self._spare, self._spare_request = next_request and self._fork(next_request), next_request
        return kernel

    def _fork(self, request):
        return ForkedKernel(self._fork_server, *request, self.limits)

    def _drop_spare(self):
        if self._spare is not None:
            self._spare.stop()
        self._spare, self._spare_request = None, None

    def close(self):
        """End all kernels and the fork server."""
        self._drop_spare()
        self._fork_server.stop()
        self._group.remove()

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self.close()
