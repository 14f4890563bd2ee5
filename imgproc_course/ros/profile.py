"""Chooses the Fast DDS profile of this process, before the first ROS node of the process exists.

Fast DDS reads the name of its profile file from the environment, once, when the first participant is created.
"""

import contextlib
import os
import re
import shutil
import sys
import time
import warnings
from array import array
from dataclasses import dataclass
from pathlib import Path

# Fast DDS 2 (Humble, Jazzy) reads the first name, Fast DDS 3 (Kilted and later) the second.
PROFILE_VARIABLES = ("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE")
LARGE = Path(__file__).with_name("fastdds.xml")
SMALL = Path(__file__).with_name("fastdds_small.xml")
SEGMENT_BYTES = {LARGE: 64 << 20, SMALL: 16 << 20}
SHARED_MEMORY = Path("/dev/shm")

# Measured: a segment takes 1.05 times its size, a participant 0.7 MiB more.
_SMALL_NEEDS = 18 << 20
# Camera, notebook, and two more processes, so that the first one does not take all of it.
_LARGE_NEEDS = 4 * (69 << 20)
_SEGMENT_NAME = re.compile(r"fastrtps_[0-9a-f]{16}")
_REMOVED_PORT = re.compile(r"^([0-9a-f]+)-.*/(fastrtps_port[0-9]+) \(deleted\)$", re.MULTILINE)


@dataclass(frozen=True)
class DdsProfile:
    """The profile that is in use. Its `str()` is one readable line.

    Attributes
    ----------
    chosen_by : "course", "user" (by an environment variable or a file), or "nobody" (Fast DDS's defaults)
    path : the profile file, or None if none is used
    note : a problem, with the remedy; None if there is none
    """

    chosen_by: str
    path: str | None = None
    note: str | None = None

    def __str__(self):
        if self.path is not None and self.chosen_by == "course":
            path = Path(self.path)
            profile = f"the course's {path.name}: {SEGMENT_BYTES[path] >> 20} MiB shared memory, and UDP"
        elif self.chosen_by == "user":
            profile = f"your own choice ({self.path})" if self.path else "your own choice"
        else:
            profile = "none: Fast DDS's defaults"
        return f"{profile}; {self.note}" if self.note else profile


def choose_profile():
    """Sets the profile for this process and its children, unless the user chose one. Returns a DdsProfile."""
    user_profile = _users_choice()
    if user_profile is not None:
        return user_profile
    free = free_shared_memory()
    if free is not None and free < _LARGE_NEEDS and remove_stale_segments():
        free = free_shared_memory()
    problem = _why_not(free)
    if problem is not None:
        warnings.warn(problem, RuntimeWarning, stacklevel=3)
        return DdsProfile("nobody", note=problem)
    path = LARGE if free is None or free >= _LARGE_NEEDS else SMALL
    for variable in PROFILE_VARIABLES:
        os.environ[variable] = str(path)
    remedy = "docker run --shm-size=1g, or sudo mount -o remount,size=1g /dev/shm, gives more"
    note = f"{SHARED_MEMORY} has only {(free or 0) >> 20} MiB free; {remedy}"
    return DdsProfile("course", str(path), note if path is SMALL else None)


def _why_not(free):
    """Why the course's profile cannot be used, and the remedy, in one line; None if it can."""
    if _a_node_exists():
        return (
            "a ROS node existed before imgproc_course.ros was imported, so images get lost between programs; "
            "restart the kernel and import imgproc_course.ros first"
        )
    if SHARED_MEMORY.is_dir() and not os.access(SHARED_MEMORY, os.W_OK):
        return (
            f"{SHARED_MEMORY} cannot be written, so raw images get lost between processes; mount it so that "
            "you can write (mount -o remount,rw /dev/shm, mode 1777), or subscribe to the /compressed topic"
        )
    if free is not None and free < _SMALL_NEEDS:
        return (
            f"{SHARED_MEMORY} has {free >> 20} MiB free, but images need {_SMALL_NEEDS >> 20}, so raw images "
            "get lost between processes; enlarge it (docker run --shm-size=1g, or mount -o "
            "remount,size=1g /dev/shm), or subscribe to the /compressed topic"
        )
    return None


def _users_choice():
    middleware = os.environ.get("RMW_IMPLEMENTATION", "")
    if middleware and "fastrtps" not in middleware:
        return DdsProfile("user", note=f"RMW_IMPLEMENTATION={middleware}, which uses no Fast DDS profile")
    course_files = {str(path) for path in SEGMENT_BYTES}  # inherited from a parent process that chose it
    for name in PROFILE_VARIABLES:
        path = os.environ.get(name)
        if path and path not in course_files:
            if not Path(path).is_file():
                note = f"{name} names a file that does not exist; unset it"
            elif not os.environ.get(PROFILE_VARIABLES[0]):
                note = f"Fast DDS 2 (ROS 2 Jazzy) reads only {PROFILE_VARIABLES[0]}; set it too"
            else:
                note = _lack_of(path)
            return DdsProfile("user", path, note=note)
    transports = os.environ.get("FASTDDS_BUILTIN_TRANSPORTS")
    if transports:
        return DdsProfile("user", note=f"FASTDDS_BUILTIN_TRANSPORTS={transports}")
    local_file = Path("DEFAULT_FASTRTPS_PROFILES.xml")  # Fast DDS reads a file with this name by itself
    if not local_file.is_file():
        return None
    return DdsProfile("user", str(local_file.absolute()), note=_lack_of(local_file))


def _lack_of(path):
    """What a user's profile lacks, and the remedy, in one line; None if nothing."""
    if "initialAnnouncements" in Path(path).read_text(errors="replace"):
        return None
    return (
        "without <initialAnnouncements> the first image can come 3 s late; copy <builtin> of "
        f"imgproc_course/ros/{LARGE.name}"
    )


def _a_node_exists():
    """Whether this process already has a DDS participant: its memory is mapped."""
    rclpy = sys.modules.get("rclpy")
    if rclpy is None:
        return False
    maps = Path("/proc/self/maps")
    return f"{SHARED_MEMORY}/fastrtps_" in maps.read_text() if maps.exists() else rclpy.ok()


def free_shared_memory():
    """Free bytes of /dev/shm, or None if there is no such folder, or nothing can be written there."""
    usable = SHARED_MEMORY.is_dir() and os.access(SHARED_MEMORY, os.W_OK)
    return shutil.disk_usage(SHARED_MEMORY).free if usable else None


def lost_ports():
    """The shared-memory ports of this process that others have removed: name -> address. Nothing new comes.

    For 20 s after a process was killed, others send to its ports, and Fast DDS 2.14 creates and removes such
    a port for each message. A process that takes the same port can lose it then, and does not notice.
    """
    maps = Path("/proc/self/maps")
    removed = _REMOVED_PORT.findall(maps.read_text()) if maps.exists() else []
    links = Path("/proc/self/fd").iterdir() if removed else ()
    locked = {Path(os.path.realpath(link)).name for link in links}
    return {name: int(address, 16) for address, name in removed if f"{name}_el" in locked}


def restore_lost_ports():
    """Lets Fast DDS open this process's lost ports again, which takes it a third of a second.

    It does so with a port that is marked as not OK, but does not mark one that it removes because its owner
    seems to be dead. Can go when it does: Fast DDS's pull request 4728.

    The mark is the lowest bit of a word in the port's memory (PortNode in SharedMemGlobal.hpp). Before it
    come the port's number, its listeners, two timeouts of which the second is a third of the first, the
    capacity, and who waits. Through /proc, an address that has gone meanwhile is an error, not a crash.
    """
    for name, address in lost_ports().items():
        with contextlib.suppress(OSError), Path("/proc/self/mem").open("r+b", buffering=0) as memory:
            memory.seek(address)
            words = array("I", memory.read(4096))
            for place, number in enumerate(words[:-6]):
                timeout, third = words[place + 2 : place + 4]
                if name.endswith(f"port{number}") and third and third == timeout // 3:
                    memory.seek(address + 4 * (place + 6))
                    memory.write(array("I", [words[place + 6] & ~1]))


def remove_stale_segments(*, older_than=10.0):
    """Removes the shared memory of killed processes: up to 67 MB each. Fast DDS never frees it.

    A running owner holds a lock on its segment's `_el` file; a killed one holds none. Files of other users
    stay, and files younger than `older_than` seconds, which their owner may not have locked yet. Returns how
    many segments were removed.
    """
    if sys.platform != "linux" or not SHARED_MEMORY.is_dir():
        return 0
    removed = 0
    for segment in [path for path in SHARED_MEMORY.iterdir() if _SEGMENT_NAME.fullmatch(path.name)]:
        lock = segment.with_name(f"{segment.name}_el")
        try:
            if time.time() - segment.stat().st_mtime > older_than and _is_unlocked(lock):
                segment.unlink()
                lock.unlink(missing_ok=True)
                removed += 1
        except (PermissionError, FileNotFoundError):
            continue  # it belongs to another user, or its owner has just removed it
    return removed


def _is_unlocked(lock):
    import fcntl

    with lock.open("r+b") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
    return True
