"""Control groups, where this system lets us make them: what all processes of a sandbox may use together.

The limits of `inside/confine.py` hold for each process; sixty processes of two gigabytes each are a hundred
and twenty. Versions 1 and 2 are known; where neither lets us, the limits for each process stand alone.
"""

import os
import time
from contextlib import suppress
from pathlib import Path

_ROOT = Path("/sys/fs/cgroup")
_PREFIX = "imgproc-course-"
_BESIDES = 256 << 20  # the forking process, and a kernel that waits


class Group:
    """A control group for one sandbox; `folders` is empty where none could be made."""

    def __init__(self, memory, processes):
        self.folders = []
        limits = {
            "memory": {"memory.limit_in_bytes": memory + _BESIDES, "memory.max": memory + _BESIDES},
            "pids": {"pids.max": 2 * processes + 8},
        }
        for controller, values in limits.items():
            self._limit(controller, values)
        self._killed = self._kills()

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

    def enter(self):
        """Put this process into it, before it becomes the sandbox."""
        for folder in self.folders:
            with suppress(OSError):
                (folder / "cgroup.procs").write_text(str(os.getpid()), encoding="ascii")

    def ran_out(self):
        """Whether a process of it was ended for want of memory since this was last asked."""
        before, self._killed = self._killed, self._kills()
        return self._killed > before

    def _kills(self):
        for folder in self.folders:
            for name in ("memory.events", "memory.oom_control"):
                with suppress(OSError, ValueError):
                    words = (folder / name).read_text(encoding="ascii").split()
                    return int(words[words.index("oom_kill") + 1])
        return 0

    def remove(self):
        """Remove it, as soon as its last process is gone."""
        for _ in range(40):
            self.folders = [folder for folder in self.folders if not _removed(folder)]
            if not self.folders:
                return
            time.sleep(0.025)


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
