"""Kernels to be had one after another, of either kind, the next one being made while one is at work."""

from imgproc_course.autograder.sandbox import bubblewrap
from imgproc_course.autograder.sandbox.cgroups import Group
from imgproc_course.autograder.sandbox.fork_server_client import ForkedKernel, Zygote
from imgproc_course.autograder.sandbox.ipykernel_client import OrdinaryKernel

KINDS = ("fast", "ipykernel")


class Kernels:
    """Where kernels come from; a context manager.

    kind     "fast": forked from a process that has the imports loaded; "ipykernel": Jupyter's own, a process
             each, over ipc
    unsafe   True: without a sandbox, as the user who grades; else `bubblewrap.demand` decides
    """

    def __init__(self, kind="fast", *, unsafe=False, limits=None):
        if kind not in KINDS:
            raise ValueError(f"kernel {kind!r}: there are {' and '.join(KINDS)}")
        self._kind, self._confined = kind, not unsafe
        self.limits = limits or bubblewrap.Limits()
        self._group = Group(self.limits.memory, self.limits.processes, control=self._confined)
        self._zygote = Zygote(self._group, confined=self._confined)
        if kind == "fast":
            self._zygote.begin()
        self._spare, self._spare_is = None, None

    def start(self, refused, seconds, then=None):
        """A fresh kernel.

        Parameters
        ----------
        refused : sequence of str, modules that it must not have
        seconds : float, processor time that the first case may use, and with it all that share the kernel
        then : (refused, seconds) of the kernel that will be wanted next, or None
        """
        wanted = (tuple(refused), seconds)
        if self._kind == "ipykernel":
            return OrdinaryKernel(*wanted, self.limits, self._group, confined=self._confined)
        if self._spare_is == wanted and not self._spare.answers():
            self._drop_spare()
        if self._spare_is == wanted:
            kernel, self._spare, self._spare_is = self._spare, None, None
        else:
            kernel = self._fork(wanted)
        then = then and (tuple(then[0]), then[1])
        if self._spare_is != then:
            self._drop_spare()
            self._spare, self._spare_is = then and self._fork(then), then
        return kernel

    def _fork(self, wanted):
        return ForkedKernel(self._zygote, *wanted, self.limits)

    def _drop_spare(self):
        if self._spare is not None:
            self._spare.stop()
        self._spare, self._spare_is = None, None

    def close(self):
        """End them all."""
        self._drop_spare()
        self._zygote.stop()
        self._group.remove()

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self.close()
