"""Limit what all processes of a sandbox use together: by control groups, or by looking at their sizes.

The limits of `inside/confine.py` hold for each process: sixty processes of two gigabytes each may use a
hundred and twenty. Versions 1 and 2 of control groups are supported. A user who is not root usually can make
neither; then the code that waits for the processes asks for the sum of their sizes.
"""

import itertools
import os
import subprocess
from contextlib import suppress
from pathlib import Path

import psutil

_ROOT = Path("/sys/fs/cgroup")
_PREFIX = "nbclassroom-"
_numbers = itertools.count()  # of the groups of this process
_OWN_MEMORY = 256 << 20  # of the fork server and of a waiting kernel
# Reading ends when this process closes the pipe or ends, however it ends. Then the guard ends what is left in
# the groups, and removes them: within a second, or after eight it leaves them to the next run.
_GUARD = """read -r _
for group; do
    for _ in $(seq 80); do
        [ -d "$group" ] && ! rmdir "$group" 2>/dev/null || break
        xargs -r kill -9 <"$group/cgroup.procs" 2>/dev/null
        sleep 0.1
    done
done"""


class ProcessGroup:
    """The processes of one sandbox."""

    def __init__(self, memory, processes, *, use_cgroups=True):
        self.folders: list[Path] = []  # of its control groups; none if none could be made or are used
        # Of each group its own: the guard ends what is in the folders.
        self._name = f"{_PREFIX}{next(_numbers)}-{os.getpid()}"
        self._max_memory = memory + _OWN_MEMORY
        limits = {
            "memory": {"memory.limit_in_bytes": self._max_memory, "memory.max": self._max_memory},
            "pids": {"pids.max": 2 * processes + 24},
            # As much processor time as one process: however many run here, they do not slow others down.
            "cpu": {"cpu.shares": 1024, "cpu.weight": 100},
            "cpuacct": {"cpuacct.usage": 0},  # counts from 0; version 2 counts in every group
        }
        for controller, values in limits.items() if use_cgroups else ():
            for parent in _parent_folders(controller):
                if self._make_cgroup(parent, values):
                    break
        # Swapped memory too, because some systems do not count it, and it is slow.
        for folder in self.folders:
            for name, limit in (("memory.memsw.limit_in_bytes", self._max_memory), ("memory.swap.max", 0)):
                with suppress(OSError):
                    _set(folder / name, limit)
        self._guard = self._start_guard() if self.folders else None
        self._kills = 0
        self.reset()

    def _make_cgroup(self, parent, values):
        """Make a control group there, unless there is one, with these limits; returns whether it has one."""
        folder, files_set = parent / self._name, []
        with suppress(OSError):
            _remove_abandoned(parent)
            folder.mkdir(exist_ok=True)
            files_set = [_set(folder / name, value) for name, value in values.items()]
        is_limited = any(files_set)
        if folder not in self.folders and is_limited:
            self.folders.append(folder)
        elif folder not in self.folders:
            with suppress(OSError):
                folder.rmdir()
        return is_limited

    def _start_guard(self):
        return subprocess.Popen(
            ["sh", "-c", _GUARD, "guard", *self.folders],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )

    def enter(self):
        """Put this process into the group, before it becomes the sandbox."""
        for folder in self.folders:
            with suppress(OSError):
                (folder / "cgroup.procs").write_text(str(os.getpid()), encoding="ascii")

    def reset(self):
        """Ignore kills that happened until now: the next kernel did not cause them."""
        self._kills = self._count_kills() or 0

    def ran_out_of_memory(self, root):
        """Whether all processes below one use more memory than they may.

        With a control group: whether the system killed one of them since the last question.
        """
        kills = self._count_kills()
        if kills is None:
            return _memory_under(root, self._max_memory) > self._max_memory
        kills_before, self._kills = self._kills, kills
        return kills > kills_before

    def _count_kills(self):
        """How many processes the system killed for want of memory; None if it does not count them."""
        kills = self._count("memory.events", "oom_kill")  # version 2
        return self._count("memory.oom_control", "oom_kill") if kills is None else kills

    def cpu_seconds(self):
        """Seconds of processor time that all processes have used together; None if nobody counts them."""
        nanoseconds, microseconds = self._count("cpuacct.usage"), self._count("cpu.stat", "usage_usec")
        if nanoseconds is not None:
            return nanoseconds / 1e9
        return None if microseconds is None else microseconds / 1e6

    def _count(self, file, name=None):
        """A number in a file of a control group: the first one, or the one after a name; None without it."""
        for folder in self.folders:
            with suppress(OSError, ValueError, IndexError):
                words = (folder / file).read_text(encoding="ascii").split()
                return int(words[words.index(name) + 1 if name else 0])
        return None

    def remove(self):
        """Remove the control groups, with what is still in them."""
        if self._guard is not None:
            if self._guard.poll() is not None:  # somebody killed it
                self._guard.communicate()
                self._guard = self._start_guard()
            self._guard.communicate()


def _set(file, value):
    """Write a value to a file of a control group, if there is one; returns whether there is."""
    if file.exists():
        file.write_text(str(value), encoding="ascii")
    return file.exists()


def _memory_under(root, exact_above):
    """Bytes that a process and its descendants use.

    Above `exact_above` bytes, pages that they share are counted once, which takes longer.
    """
    try:
        process = psutil.Process(root)
        processes = [process, *process.children(recursive=True)]
    except psutil.Error:
        return 0
    used = sum(_memory_of(process) for process in processes)
    return used if used <= exact_above else sum(_memory_of(process, exactly=True) for process in processes)


def _memory_of(process, *, exactly=False):
    with suppress(psutil.Error):  # it has ended in the meantime
        if exactly:
            with suppress(psutil.AccessDenied):
                memory = process.memory_full_info()
                return memory.pss + memory.swap
        return process.memory_info().rss
    return 0


def _parent_folders(controller):
    """Where a group can be made, for a controller of version 1, then of version 2."""
    lines = []
    with suppress(OSError):
        lines = Path("/proc/self/cgroup").read_text(encoding="ascii").splitlines()
    for line in lines:
        _, names, path = line.split(":", 2)
        if controller in names.split(","):
            yield _ROOT / controller / path.lstrip("/")
    for line in lines:
        if line.startswith("0::"):
            # In version 2 a group has either processes or groups in it: ours is made beside our own.
            own_group = _ROOT / line[3:].lstrip("/")
            yield own_group.parent if own_group != _ROOT else own_group


def _remove_abandoned(parent):
    """Remove groups whose autograder was killed."""
    for folder in parent.glob(f"{_PREFIX}*"):
        if not Path("/proc", folder.name.rpartition("-")[2]).exists():
            with suppress(OSError):
                folder.rmdir()
