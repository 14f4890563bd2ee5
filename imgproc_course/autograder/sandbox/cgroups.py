"""What all processes of a sandbox may use together: control groups, or a look at their sizes now and then.

The limits of `inside/confine.py` hold for each process; sixty processes of two gigabytes each are a hundred
and twenty. Versions 1 and 2 of control groups are known. Where neither lets us make one, as is usual for a
user who is not root, whoever waits for the processes asks for the sum of their sizes.
"""

import os
import time
from contextlib import suppress
from pathlib import Path

import psutil

_ROOT = Path("/sys/fs/cgroup")
_PREFIX = "imgproc-course-"
_BESIDES = 256 << 20  # the forking process, and a kernel that waits


class Group:
    """A sandbox's processes; `folders` of control groups, empty where none could be made or are wanted."""

    def __init__(self, memory, processes, *, control=True):
        self.folders = []
        self._most = memory + _BESIDES
        limits = {
            "memory": {"memory.limit_in_bytes": self._most, "memory.max": self._most},
            "pids": {"pids.max": 2 * processes + 8},
        }
        for controller, values in limits.items() if control else ():
            self._limit(controller, values)
        self._without_swap()
        self._counts = self._file_that_counts()
        self._killed, self._used = self._kills(), 0

    def _limit(self, controller, values):
        for parent in _parents(controller):
            folder = parent / f"{_PREFIX}{os.getpid()}"
            try:
                _sweep(parent)
                folder.mkdir(exist_ok=True)
                files = [name for name in values if (folder / name).exists()]
                for name in files:
                    (folder / name).write_text(str(values[name]), encoding="ascii")
            except OSError:
                files = []
            if files:
                self.folders += [folder] if folder not in self.folders else []
                return
            with suppress(OSError):
                folder.rmdir()

    def _without_swap(self):
        """Memory that is swapped out is memory too, and slow; some systems do not count it."""
        for folder in self.folders:
            for name, most in (("memory.memsw.limit_in_bytes", self._most), ("memory.swap.max", 0)):
                if (folder / name).exists():
                    with suppress(OSError):
                        (folder / name).write_text(str(most), encoding="ascii")

    def enter(self):
        """Put this process into it, before it becomes the sandbox."""
        for folder in self.folders:
            with suppress(OSError):
                (folder / "cgroup.procs").write_text(str(os.getpid()), encoding="ascii")

    def forget(self):
        """Let what was ended before now count no more: it is not the next kernel's doing."""
        self._killed, self._used = self._kills() or 0, 0

    def ran_out(self, root):
        """Whether the processes use more than they may.

        Parameters
        ----------
        root : int, the process that they are all under

        Returns
        -------
        bool; with a control group, whether the system ended one of them for it since this was last asked
        """
        kills = self._kills()
        if kills is None:
            self._used = _memory_under(root, self._most)
            return self._used > self._most
        before, self._killed = self._killed, kills
        return self._killed > (before or 0)

    def is_crowded(self):
        """Whether half of the memory is in use, or was at the last look where there is no control group."""
        for folder in self.folders:
            for name in ("memory.current", "memory.usage_in_bytes"):
                with suppress(OSError, ValueError):
                    return int((folder / name).read_text(encoding="ascii")) > self._most // 2
        return self._used > self._most // 2

    def _file_that_counts(self):
        """The file with the number of processes that the system has ended for want of memory, or None."""
        names = [folder / name for folder in self.folders for name in ("memory.events", "memory.oom_control")]
        for path in names:
            with suppress(OSError):
                if "oom_kill" in path.read_text(encoding="ascii").split():
                    return path
        return None

    def _kills(self):
        """How many processes the system has ended for want of memory; None where it does not count that."""
        if self._counts is None:
            return None
        with suppress(OSError, ValueError):
            words = self._counts.read_text(encoding="ascii").split()
            return int(words[words.index("oom_kill") + 1])
        return None

    def remove(self):
        """Remove it, as soon as its last process is gone."""
        for _ in range(40):
            self.folders = [folder for folder in self.folders if not _removed(folder)]
            if not self.folders:
                return
            time.sleep(0.025)


def _memory_under(root, enough):
    """Bytes that a process and all under it use; beyond `enough`, with the pages that they share once."""
    try:
        top = psutil.Process(root)
        processes = [top, *top.children(recursive=True)]
    except psutil.Error:
        return 0
    used = sum(_resident(process) for process in processes)
    return used if used <= enough else sum(_proportional(process) for process in processes)


def _resident(process):
    with suppress(psutil.Error):
        return process.memory_info().rss
    return 0  # it has ended meanwhile


def _proportional(process):
    try:
        found = process.memory_full_info()
    except psutil.AccessDenied:
        return _resident(process)
    except psutil.Error:
        return 0
    return found.pss + found.swap


def _removed(folder):
    try:
        folder.rmdir()
    except FileNotFoundError:
        return True
    except OSError:
        return False
    return True


def _parents(controller):
    """Where a group of ours could stand, for a controller of version 1, then of version 2."""
    lines = []
    with suppress(OSError):
        lines = Path("/proc/self/cgroup").read_text(encoding="ascii").splitlines()
    for line in lines:
        _, names, place = line.split(":", 2)
        if controller in names.split(","):
            yield _ROOT / controller / place.lstrip("/")
    for line in lines:
        if line.startswith("0::"):
            # Version 2 has no processes beside groups: ours stands beside our own.
            own = _ROOT / line[3:].lstrip("/")
            yield own.parent if own != _ROOT else own


def _sweep(parent):
    """Remove groups whose grader has been killed."""
    for folder in parent.glob(f"{_PREFIX}*"):
        if not Path("/proc", folder.name.removeprefix(_PREFIX)).exists():
            with suppress(OSError):
                folder.rmdir()
