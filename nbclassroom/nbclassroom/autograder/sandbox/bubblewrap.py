"""The sandbox around learners' code: bubblewrap's command line, and why there may be no sandbox here.

Inside are, all read-only: the system's programs and libraries, Python, the installed packages, the packages
of the course that answers may use, without the room's files, and `inside/`. There is no network, no home
folder, no environment variable of the user, no key, no master and no submission. `inside/confine.py` confines
each kernel once more; `inside/refusal.py` refuses by their names the modules that an exercise does not allow.
"""

import math
import os
import shutil
import signal
import subprocess
import sys
import sysconfig
import tempfile
import threading
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import psutil

import nbclassroom
from nbclassroom import course
from nbclassroom.autograder.sandbox.inside import confine

_SOURCE = Path(nbclassroom.__file__).resolve().parent
_STUB = _SOURCE / "autograder" / "sandbox" / "inside" / "package_stub.py"
# Modules of `exercises` that check cells need, beside those of the kinds; none of them knows an answer.
_EXERCISES = (
    *("canonical", "cell_syntax", "comparison", "page_run", "running"),
    *("kinds/__init__", "kinds/kind"),
)
_FOLDER_PREFIX = "nbclassroom-"
_TRIALS, _TRIAL_SECONDS = 5, 60
_trial_lock = threading.Lock()
KILLED = (-signal.SIGKILL, 128 + signal.SIGKILL)  # exit codes: bubblewrap was killed, or what ran inside
# Paths inside the sandbox.
SITE, COURSE, COURSE_FILE, PYTHON = "/course/site", "/course/packages", "/course/course.toml", "/python"
_PYTHON_OPTIONS = ("-s", "-P", "-B")  # not -I: it ignores PYTHONHASHSEED
# SYS_RESOURCE: what `die_first` sets is for good. Kernels lose all of them.
_CAPABILITIES = ("SYS_ADMIN", "SYS_RESOURCE", "SETUID", "SETGID", "SETPCAP", "KILL", "CHOWN")
# Of /, and of /usr, /usr/local and Python's own folder: beside them may lie a checkout, a key or submissions.
_ROOT_FOLDERS = ("bin", "sbin", "lib", "lib32", "lib64")
_SYSTEM_FOLDERS = (*_ROOT_FOLDERS, "libexec", "share")
_ETC = ("ld.so.cache", "ld.so.conf", "ld.so.conf.d", "alternatives", "localtime", "nsswitch.conf", "fonts")


class SandboxError(RuntimeError):
    """There is no sandbox on this machine; the message says what is missing and what to do."""


@dataclass(frozen=True)
class Limits:
    """What one kernel may use.

    An endless loop costs seven seconds a case, an endless sleep forty; an honest lesson takes one or two.
    """

    memory: int = 2 << 30  # bytes, as the next three
    scratch: int = 32 << 20
    file: int = 16 << 20
    output: int = 8 << 20
    processes: int = 24
    grace: float = 2.0  # seconds of processor time that a case has beside its exercise's limit for each call
    wall_factor: float = 4.0  # multiplies the processor time
    wall_grace: float = 8.0  # seconds
    submission: float = 120.0  # seconds of wall time, after which no further case of a submission is run

    def cpu(self, seconds):
        """Whole seconds of processor time that the system gives to each process of a kernel."""
        return math.ceil(seconds + self.grace)

    def deadline(self, seconds):
        """Seconds of wall time after which a kernel is ended from outside, whatever it does."""
        return (seconds + self.grace) * self.wall_factor + self.wall_grace


@lru_cache(maxsize=1)
def sandbox_problem():
    """Why there is no sandbox here, with the remedy; "" if there is one."""
    if not sys.platform.startswith("linux"):
        remedy = "grade in a container, in WSL or on a Linux machine"
        return f"grading needs Linux, this is {sys.platform}: {remedy}"
    if shutil.which("bwrap") is None:
        elsewhere = "Fedora: sudo dnf install bubblewrap; Arch: sudo pacman -S bubblewrap"
        return f"bubblewrap is not installed: sudo apt-get install bubblewrap ({elsewhere})"
    error = _error_of_trial()
    if not error:
        return ""
    return (
        f"bubblewrap cannot make a sandbox here ({error}). Allow user namespaces"
        " (sudo sysctl -w kernel.unprivileged_userns_clone=1; on Ubuntu 24.04 also"
        " sudo sysctl -w kernel.apparmor_restrict_unprivileged_userns=0), or grade as root in a container"
        " that was started with --privileged"
    )


def _error_of_trial():
    """What bubblewrap says when it is tried, "" if it makes a sandbox."""
    for _ in range(_TRIALS):
        try:
            trial = subprocess.run(
                [*sandbox_command(confined=True), "-c", "print('inside')"],
                env={},
                capture_output=True,
                text=True,
                timeout=_TRIAL_SECONDS,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return f"no sandbox within {_TRIAL_SECONDS} s"
        if trial.returncode == 0 and trial.stdout.strip() == "inside":
            return ""
        error = " ".join(trial.stderr.split())[:300] or f"exit code {trial.returncode}"
        if trial.returncode not in KILLED:
            break
    return error


def require_sandbox():
    """Raise SandboxError, one line with the remedy, if there is no sandbox here."""
    with _trial_lock:  # the trial of one thread serves all
        problem = sandbox_problem()
    if problem:
        why = "Without a sandbox learners' code would run as you, with your files"
        raise SandboxError(f"{problem}. {why}: --unsafe if you accept that")


def sandbox_command(confined):
    """The command line up to the interpreter and its options; without bubblewrap if not `confined`."""
    if not confined:
        return [sys.executable, *_PYTHON_OPTIONS]
    command = [shutil.which("bwrap") or "bwrap", "--die-with-parent", "--new-session", "--clearenv"]
    for name, value in environment(confined=True).items():
        command += ["--setenv", name, value]
    command += ["--unshare-pid", "--unshare-net", "--unshare-ipc", "--unshare-uts", "--unshare-cgroup-try"]
    command += ["--hostname", "course", "--cap-drop", "ALL"]
    if os.geteuid() != 0:
        command += ["--unshare-user", "--uid", "0", "--gid", "0"]
    for name in _CAPABILITIES:
        command += ["--cap-add", f"CAP_{name}"]
    mounts = [*_system_folders(), *_site_packages(), *_course_packages()]
    places = [Path(mounts[n + 2]) for n, option in enumerate(mounts) if option.startswith("--ro-bind")]
    for folder in sorted({folder for place in places for folder in place.parents} - {Path("/")}):
        command += ["--perms", "0755", "--dir", str(folder)]  # a mount would make it for root alone
    command += [*mounts, "--proc", "/proc", "--dev", "/dev"]
    command += ["--perms", "1777", "--tmpfs", "/dev/shm", "--perms", "1777", "--tmpfs", "/tmp"]
    # If the user does not really change, kernels own these folders: the next kernel would find what one
    # wrote.
    command += ["--remount-ro", "/dev", "--remount-ro", "/"]
    base, mount_point = python_folder()
    interpreter = mount_point / Path(sys.executable).resolve().relative_to(base)
    return [*command, "--chdir", "/tmp", str(interpreter), *_PYTHON_OPTIONS]


def _empty_folder(path):
    return ["--tmpfs", str(path), "--remount-ro", str(path)]


def _system_folders():
    roots = {Path("/usr"): Path("/usr"), Path("/usr/local"): Path("/usr/local")} | dict([python_folder()])
    places = [(Path("/", name), Path("/", name)) for name in _ROOT_FOLDERS]
    places += [(root / name, mount / name) for root, mount in roots.items() for name in _SYSTEM_FOLDERS]
    options = []
    for path, mount_point in places:
        if path.is_symlink():
            options += ["--symlink", str(path.readlink()), str(mount_point)]
        elif path.is_dir():
            options += ["--ro-bind", str(path), str(mount_point)]
    for name in _ETC:
        options += ["--ro-bind-try", f"/etc/{name}", f"/etc/{name}"]
    return options + [option for path in _hidden_folders(roots) for option in _empty_folder(path)]


def _hidden_folders(roots):
    """Below {root: its mount point}, as seen inside: other package folders than ours, and a checkout."""
    package_folders = [path for root in roots for path in root.glob("lib/python3*/*-packages")]
    own = [root for root in course.roots() if not any(map(root.is_relative_to, package_folders))]
    return [
        mount_point / path.relative_to(root)
        for root, mount_point in roots.items()
        for path in (*package_folders, *own)
        if path.is_relative_to(root) and path.is_dir() and not path.is_symlink()
    ]


def _site_packages():
    options = []
    for folder, mount_point in _package_folders().items():
        options += ["--ro-bind", str(folder), mount_point]
        # An installed copy would contain the autograder, and a link to the checkout its path.
        own = ["nbclassroom", *filter(None, [course.package])]
        for path in (path for name in own for path in folder.glob(f"*{name}*")):
            hidden = f"{mount_point}/{path.name}"
            options += _empty_folder(hidden) if path.is_dir() else ["--ro-bind", os.devnull, hidden]
    return options


def _course_packages():
    binds, hidden = {COURSE_FILE: course.file()}, []  # {path inside: what is there}, empty folders
    if source := course.package_folder():
        root, names = f"{COURSE}/{course.package}", ("__init__.py", *course.modules, *course.packages)
        binds |= {f"{root}/{name}": source / name for name in names if (source / name).exists()}
        binds |= {f"{root}/{name}/__init__.py": _STUB for name in course.silent_packages}
        hidden = [f"{root}/{name}" for name in course.hidden_folders]
    own = ["__init__.py", "course.py", *(f"exercises/{module}.py" for module in modules_of_exercises())]
    own += [f"autograder/{name}" for name in ("__init__.py", "sandbox/__init__.py", "sandbox/inside")]
    binds |= {f"{COURSE}/nbclassroom/{name}": _SOURCE / name for name in own}
    binds[f"{COURSE}/nbclassroom/exercises/__init__.py"] = _STUB
    options = [part for place, path in binds.items() for part in ("--ro-bind", str(path), place)]
    return options + [option for path in hidden for option in _empty_folder(path)]


def modules_of_exercises():
    """The modules of `exercises` that kernels have, such as "kinds/kind"."""
    from nbclassroom.exercises import kinds  # here, because it imports NumPy: a process starts without

    own = [(name, ("__init__", "kind", *kinds.kind_of(name).kernel_modules)) for name in kinds.NAMES]
    return [*_EXERCISES, *(f"kinds/{name}/{module}" for name, modules in own for module in modules)]


def _package_folders():
    """{folder of installed packages: where it is inside}."""
    folders = sorted({sysconfig.get_path("purelib"), sysconfig.get_path("platlib")})
    return {Path(folder): f"{SITE}-{n}" for n, folder in enumerate(folders) if Path(folder).is_dir()}


def python_folder():
    """(folder of Python itself, where it is inside the sandbox): the system's stays, another is /python."""
    base = Path(sys.base_prefix).resolve()
    return base, base if base in (Path("/usr"), Path("/usr/local")) else Path(PYTHON)


def environment(confined):
    """The environment variables of every kernel: nothing of the teacher's."""
    _, mount_point = python_folder()
    return {
        "PATH": "/usr/bin:/bin",
        "HOME": "/tmp/home",
        "IPYTHONDIR": "/tmp/home/.ipython",
        "MPLCONFIGDIR": "/tmp/home/.matplotlib",
        "MPLBACKEND": "module://matplotlib_inline.backend_inline",
        "LANG": "C.UTF-8",
        "TZ": "UTC",
        "TERM": "xterm-color",
        "USER": "learner",
        "PYTHONHASHSEED": "0",
        "PYTHONIOENCODING": "utf-8:replace",  # any text may be printed; it leads nowhere
        "OPENCV_LOG_LEVEL": "ERROR",
        # Beside OpenCV's threads no process can be forked.
        **dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "OPENCV_FOR_THREADS_NUM"), "1"),
        course.VARIABLE: COURSE_FILE if confined else str(course.file()),
        "LD_LIBRARY_PATH": str(mount_point / "lib") if mount_point != Path("/usr") else "",
    }


def search_path(confined):
    """Where Python looks for modules inside, after its own library."""
    return [COURSE, *_package_folders().values()] if confined else [str(root) for root in course.roots()]


def kernel_user():
    """The first unused user id for kernels, None if not root; each has the next: limits count by user."""
    return 2_000_000 + os.getpid() * confine.USERS_OF_SERVER if os.geteuid() == 0 else None


def used_under(root, exact_above):
    """(bytes, seconds of processor time) that a process and its descendants use.

    The limits of `inside/confine.py` hold for each process: sixty of two gigabytes may use a hundred and
    twenty. Above `exact_above` bytes, pages that they share are counted once, which takes longer.
    """
    try:
        process = psutil.Process(root)
        processes = [process, *process.children(recursive=True)]
    except psutil.Error:
        return 0, 0.0
    memory = sum(map(_memory_of, processes))
    if memory > exact_above:
        memory = sum(_memory_of(process, exactly=True) for process in processes)
    return memory, sum(map(_seconds_of, processes))


def _seconds_of(process):
    """Of a process and of those children that it has waited for."""
    with suppress(psutil.Error):  # it has ended in the meantime
        return sum(process.cpu_times()[:4])
    return 0.0


def _memory_of(process, *, exactly=False):
    with suppress(psutil.Error):
        if exactly:
            with suppress(psutil.AccessDenied):
                memory = process.memory_full_info()
                return memory.pss + memory.swap
        return process.memory_info().rss
    return 0


def make_temporary_folder():
    """The Path of a new folder of this process, which does not outlive a killed run."""
    remove_abandoned_folders()
    return Path(tempfile.mkdtemp(prefix=f"{_FOLDER_PREFIX}{os.getpid()}-"))


def remove_abandoned_folders():
    """Remove the folders of runs that were killed, and have ended."""
    for folder in Path(tempfile.gettempdir()).glob(f"{_FOLDER_PREFIX}*-*"):
        number = folder.name.removeprefix(_FOLDER_PREFIX).partition("-")[0]
        if number.isdecimal() and not psutil.pid_exists(int(number)):
            shutil.rmtree(folder, ignore_errors=True)  # another user's stays
