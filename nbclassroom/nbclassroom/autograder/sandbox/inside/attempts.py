"""What a learner's code tries that the sandbox refuses: the teacher reads it, and no verdict depends on it.

Python's audit events tell it. Only what the learner's code does counts, itself or through the standard
library: NumPy and matplotlib read files and start programs, too.
"""

import os
import sys

_MOST, _MOST_CHARACTERS = 20, 80  # attempts that a process tells, and of each
_LIBRARY = os.path.dirname(os.__file__) + os.sep  # noqa: PTH120 - `os` only, see `confine`
_ABOUT_THE_MACHINE = ("/etc/os-release/", "/etc/hostname/", "/proc/cpuinfo/", "/proc/meminfo/")
_SUBMISSION, _SCRATCH = "/tmp/submission/", ("/tmp/", "/dev/", "/content/")  # /content/: Colab's, not here
_OPEN_TO_ALL = ("/tmp/", "/course/", "/usr/", "/python/", "/dev/", "/content/", _LIBRARY, *_ABOUT_THE_MACHINE)
_PROGRAM, _NETWORK, _END = "start a program", "open the network", "end Python"
_READ, _WRITE, _REMOVE = "read files", "write files", "remove files"
_absolute, _FOR_WRITING = os.path.abspath, os.O_WRONLY | os.O_RDWR | os.O_CREAT
_HARMLESS = f"{_PROGRAM} (uname -p)"  # by platform.processor()
_EVENTS = {  # {audit event: (what it is an attempt to do, the number of the argument that is told or None)}
    "os.system": (_PROGRAM, 0),
    "os.exec": (_PROGRAM, 1),
    "os.posix_spawn": (_PROGRAM, 1),
    "subprocess.Popen": (_PROGRAM, 1),
    "socket.connect": (_NETWORK, 1),
    "socket.getaddrinfo": (_NETWORK, 0),
    "os.kill": (_END, None),
    "os._exit": (_END, None),  # ours: Python has no event for it
    "shutil.rmtree": (_REMOVE, 0),
    "os.remove": (_REMOVE, 0),
    "os.rename": (_WRITE, 1),
    "open": (_READ, 0),
    "os.listdir": (_READ, 0),
    "os.scandir": (_READ, 0),
}


def tell_attempts(send):
    """Call send("tried", text=...) with each attempt of this process from now on."""
    attempts = {_HARMLESS}

    def tell_attempt(event, arguments):
        purpose, number = _EVENTS.get(event, ("", None))
        detail = event if number is None else arguments[number]
        if event == "open" and arguments[2] & _FOR_WRITING:
            purpose = _WRITE
        if not purpose or (purpose in (_READ, _WRITE, _REMOVE) and not _is_elsewhere(detail, purpose)):
            return
        text = f"{purpose} ({_text_of(detail)[:_MOST_CHARACTERS]})"
        if text not in attempts and len(attempts) < _MOST and _is_learners(sys._getframe(1), purpose):
            attempts.add(text)
            send("tried", text=text)

    def end_process(status):
        sys.audit("os._exit")
        _exit(status)

    _exit, os._exit = os._exit, end_process
    sys.addaudithook(tell_attempt)


def _is_elsewhere(path, purpose):
    """Whether a path is in a folder of the machine that no answer needs, or leads out of its own folder."""
    path = os.fsdecode(path) if isinstance(path, str | bytes | os.PathLike) else ""
    leads_up = purpose != _READ and ".." in path.split("/")
    folders = _SUBMISSION if leads_up else _OPEN_TO_ALL if purpose == _READ else _SCRATCH
    return (leads_up or path.startswith("/")) and not f"{_absolute(path)}/".startswith(folders)


def _is_learners(frame, purpose):
    """Whether code of the learner's calls, perhaps through the library, which itself ends processes."""
    while frame is not None and _is_passed(frame.f_code, purpose):
        frame = frame.f_back
    return frame is not None and frame.f_globals.get("__name__") == "__main__"


def _is_passed(code, purpose):
    is_wrapper = code.co_name in ("_modified_open", "end_process")  # IPython's open, and ours
    return is_wrapper or (purpose != _END and code.co_filename.startswith((_LIBRARY, "<frozen os>")))


def _text_of(detail):
    if isinstance(detail, tuple):  # an address
        detail = detail[0]
    if isinstance(detail, list):
        return " ".join(map(_text_of, detail[:5]))
    return detail.decode(errors="replace") if isinstance(detail, bytes) else str(detail)
