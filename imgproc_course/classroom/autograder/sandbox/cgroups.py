"""Limit what all processes of a sandbox use together: by control groups, or by looking at their sizes.

The limits of `inside/confine.py` hold for each process: sixty processes of two gigabytes each may use a
hundred and twenty. Versions 1 and 2 of control groups are supported. A user who is not root usually can make
neither; then the code that waits for the processes asks for the sum of their sizes.
"""

import os
import subprocess
import time
from contextlib import suppress
from pathlib import Path

import psutil

_ROOT = Path("/sys/fs/cgroup")
_PREFIX = "imgproc-course-"
_OWN_MEMORY = 256 << 20  # of the fork server and of a waiting kernel
# Reading ends with this process, however it ends. Then the guard ends what is left in the groups, and removes
# them: within a second, or after eight it leaves them to the next run.
_GUARD = """read -r _
for group; do
    for _ in $(seq 80); do
        [ -d "$group" ] && ! rmdir "$group" 2>/dev/null || break
        xargs -r kill -9 <"$group/cgroup.procs" 2>/dev/null
        sleep 0.1
    done
done"""


class ProcessGroup:
    """The processes of one sandbox.

    folders   Paths of its control groups; empty if none could be made or none are used
    """

    def __init__(self, memory, processes, *, use_cgroups=True):
        self.folders = []
        self._max_memory = memory + _OWN_MEMORY
        limits = {
            "memory": {"memory.limit_in_bytes": self._max_memory, "memory.max": self._max_memory},
            "pids": {"pids.max": 2 * processes + 24},
            # As much processor time as one process: however many run here, they do not slow others down.
            "cpu": {"cpu.shares": 1024, "cpu.weight": 100},
            "cpuacct": {"cpuacct.usage": 0},  # counts from 0; version 2 counts in every group
        }
        for controller, values in limits.items() if use_cgroups else ():
            self._make_cgroup(controller, values)
        self._guard = self._start_guard() if self.folders else None
        self._limit_swap()
        self._kill_counter = self._find_kill_counter()
        self._cpu_counter = self._find_cpu_counter()
        self._kills = self._count_kills()

    def _make_cgroup(self, controller, values):
        for parent in _parent_folders(controller):
            folder = parent / f"{_PREFIX}{os.getpid()}"
            try:
                _remove_abandoned(parent)
                folder.mkdir(exist_ok=True)
                files = [name for name in values if (folder / name).exists()]
                for name in files:
                    (folder / name).write_text(str(values[name]), encoding="ascii")
            except OSError:
                files = []
            if files:
                self.folders += [folder] if folder not in self.folders else []
                return
            if folder not in self.folders:
                with suppress(OSError):
                    folder.rmdir()

    def _start_guard(self):
        return subprocess.Popen(
            ["sh", "-c", _GUARD, "guard", *self.folders],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )

    def _limit_swap(self):
        """Count swapped memory too, because some systems do not, and it is slow."""
        for folder in self.folders:
            for name, limit in (("memory.memsw.limit_in_bytes", self._max_memory), ("memory.swap.max", 0)):
                if (folder / name).exists():
                    with suppress(OSError):
                        (folder / name).write_text(str(limit), encoding="ascii")

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
        return self._kills > (kills_before or 0)

    def cpu_seconds(self):
        """Seconds of processor time that all processes have used together; None if nobody counts them."""
        return None if self._cpu_counter is None else _cpu_seconds_in(self._cpu_counter)

    def _find_cpu_counter(self):
        """The file in which the system counts their processor time, or None."""
        paths = (folder / name for folder in self.folders for name in ("cpuacct.usage", "cpu.stat"))
        return next((path for path in paths if _cpu_seconds_in(path) is not None), None)

    def _find_kill_counter(self):
        """The file in which the system counts the processes that it killed for want of memory, or None."""
        names = [folder / name for folder in self.folders for name in ("memory.events", "memory.oom_control")]
        for path in names:
            with suppress(OSError):
                if "oom_kill" in path.read_text(encoding="ascii").split():
                    return path
        return None

    def _count_kills(self):
        """How many processes the system killed for want of memory; None if it does not count them."""
        if self._kill_counter is None:
            return None
        with suppress(OSError, ValueError):
            fields = self._kill_counter.read_text(encoding="ascii").split()
            return int(fields[fields.index("oom_kill") + 1])
        return None

    def remove(self):
        """Remove the control groups as soon as their last process has ended."""
        for _ in range(40):
            self.folders = [folder for folder in self.folders if not _remove_folder(folder)]
            if not self.folders:
                break
            time.sleep(0.025)
        if self._guard is not None:
            self._guard.kill()
            self._guard.communicate()


def _cpu_seconds_in(path):
    """The seconds that cpuacct.usage (version 1) or cpu.stat (version 2) says, or None."""
    with suppress(OSError, ValueError):
        fields = path.read_text(encoding="ascii").split()
        if path.name == "cpuacct.usage":
            return int(fields[0]) / 1e9
        return int(fields[fields.index("usage_usec") + 1]) / 1e6
    return None


def _memory_under(root, exact_above):
    """Bytes that a process and its descendants use.

    Above `exact_above` bytes, pages that they share are counted once, which takes longer.
    """
    try:
        process = psutil.Process(root)
        processes = [process, *process.children(recursive=True)]
    except psutil.Error:
        return 0
    used = sum(_resident_memory(process) for process in processes)
    return used if used <= exact_above else sum(_proportional_memory(process) for process in processes)


def _resident_memory(process):
    with suppress(psutil.Error):
        return process.memory_info().rss
    return 0  # it has ended in the meantime


def _proportional_memory(process):
    try:
        memory = process.memory_full_info()
    except psutil.AccessDenied:
        return _resident_memory(process)
    except psutil.Error:
        return 0
    return memory.pss + memory.swap


def _remove_folder(folder):
    """Remove a folder; returns whether it is gone."""
    try:
        folder.rmdir()
    except FileNotFoundError:
        return True
    except OSError:
        return False
    return True


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
        if not Path("/proc", folder.name.removeprefix(_PREFIX)).exists():
            with suppress(OSError):
                folder.rmdir()
