"""The sandbox around learners' code: bubblewrap's command line, and why there may be no sandbox here.

Inside are, all read-only: the system's libraries and a few of its commands, Python, `inside/`, and the
installed packages that every answer may use; others, and packages of the course, for an exercise that allows
them (`allowed_modules`).
There is no network, no home folder, no environment variable of the user, no key, no master and no
submission. `inside/confine.py` confines each kernel once more.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import sysconfig
import threading
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from imgproc_course.classroom import course
from imgproc_course.classroom.autograder.sandbox.inside import confine

SOURCE = Path(__file__).resolve().parents[3]  # the folder imgproc_course
INSIDE = Path(__file__).resolve().parent / "inside"
# Modules of `exercises` that check cells need; none of them knows an answer.
EXERCISES_MODULES = ("canonical", "comparison", "input_encoding", "running")
SITE, COURSE, PYTHON = "/course/site-packages", "/course/packages", "/python"  # paths inside the sandbox
EXTRA, ALLOWED = confine.EXTRA, confine.ALLOWED
CLASSROOM = f"{COURSE}/{course.NAME}/classroom"
_PYTHON_OPTIONS = ("-s", "-P", "-B")  # not -I: it ignores PYTHONHASHSEED
# SYS_RESOURCE: what `die_first` sets is for good. Kernels lose all of them.
_CAPABILITIES = ("SYS_ADMIN", "SYS_RESOURCE", "SETUID", "SETGID", "SETPCAP", "KILL", "CHOWN")
_COMMAND_FOLDERS = (
    *("/bin", "/sbin", "/usr/bin", "/usr/sbin", "/usr/games", "/usr/libexec"),
    *("/usr/local/bin", "/usr/local/sbin", "/usr/local/games"),
)
_COMMANDS = (
    *(
        "sh",
        "bash",
        "env",
        "true",
        "false",
        "echo",
        "printf",
        "cat",
        "ls",
        "pwd",
        "head",
        "tail",
        "wc",
        "grep",
    ),
    *("sed", "sort", "cut", "tr", "mkdir", "rm", "cp", "mv", "touch", "sleep", "kill", "date", "uname", "id"),
)
# Of /usr, /usr/local and Python's own folder. Beside them lie other people's programs, a checkout, or
# environments with every library.
_SYSTEM_FOLDERS = (
    *("bin", "sbin", "games", "libexec", "lib", "lib32", "lib64", "libx32"),
    *("share", "etc", "ssl", "include", "man"),
)
# Libraries with functions that solve exercises, in C: no Python is needed to call them.
_IMAGE_LIBRARIES = re.compile(
    r"lib(opencv_|Magick|GraphicsMagick|vips|gd\.|gdk_pixbuf|cairo|pixman|avfilter|swscale|gegl|Imlib2|IL\."
    r"|freeimage|lept|tesseract|dlib|itk|ITK|netpbm|zbar|aruco|apriltag|pcl_)",
)
_LIBRARY_FOLDERS = ("lib", "lib/*-linux-gnu*", "lib64", "local/lib", "local/lib64")
# Below these folders: programs with libraries of their own, and other languages.
_PROGRAM_FOLDERS = re.compile(
    r"jvm|java.*|R|octave|gimp|GIMP|julia.*|mono|dotnet|node_modules|nodejs|libreoffice|chromium.*|firefox.*"
    r"|google-cloud-sdk|(Image|Graphics)Magick.*|frei0r.*|gstreamer.*|gdk-pixbuf.*|gegl.*"
)
_ETC = ("ld.so.cache", "ld.so.conf", "ld.so.conf.d", "alternatives", "localtime", "nsswitch.conf", "fonts")


class SandboxError(RuntimeError):
    """There is no sandbox on this machine; the message says what is missing and what to do."""


@dataclass(frozen=True)
class Limits:
    """What one kernel may use.

    A case's processor time is its exercise's time limit for each of its calls, plus `grace`. memory, scratch,
    file and output are bytes; grace and wall_grace are seconds; wall_factor multiplies the processor time.
    `submission` is the wall time, in seconds, after which no further case of a submission is run: an endless
    loop costs seven seconds a case, an endless sleep forty, and an honest lesson is graded in one or two.
    """

    memory: int = 2 << 30
    scratch: int = 32 << 20
    file: int = 16 << 20
    output: int = 8 << 20
    processes: int = 24
    grace: float = 2.0
    wall_factor: float = 4.0
    wall_grace: float = 8.0
    submission: float = 120.0

    def for_system(self, seconds):
        """The limits that the operating system enforces on a kernel that may use so many seconds."""
        return vars(self) | {"cpu": int(-(-(seconds + self.grace) // 1))}

    def deadline(self, seconds):
        """Seconds of wall time after which a kernel is ended from outside, whatever it does."""
        return (seconds + self.grace) * self.wall_factor + self.wall_grace


_TRIALS, _TRIAL_SECONDS = 5, 60
_trial_lock = threading.Lock()
KILLED = (-signal.SIGKILL, 128 + signal.SIGKILL)  # exit codes: bubblewrap was killed, or what ran inside


@lru_cache(maxsize=1)
def sandbox_problem():
    """Why there is no sandbox here, with the remedy; "" if there is one."""
    if not sys.platform.startswith("linux"):
        return (
            f"grading needs Linux, this is {sys.platform}: grade in the course's container"
            " (environment/Dockerfile), in WSL or on a Linux machine"
        )
    if shutil.which("bwrap") is None:
        return (
            "bubblewrap is not installed: sudo apt-get install bubblewrap"
            " (Fedora: sudo dnf install bubblewrap; Arch: sudo pacman -S bubblewrap)"
        )
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
                [*sandbox_command(confined=True, packages=False), "-c", "print('inside')"],
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
        raise SandboxError(
            f"{problem}. Without a sandbox learners' code would run as you, with your files: --unsafe if you"
            " accept that"
        )


# ---------------------------------------------------------------- the command line


def sandbox_command(confined, *, shared=None, packages=True):
    """The command line up to the interpreter and its options.

    Parameters
    ----------
    confined : bool; False: the interpreter alone, without bubblewrap
    shared : {folder: its mount point inside}, folders that can be written to: an ipykernel's sockets
    packages : bool, False: without installed packages and the course, which take longer than all the rest

    Returns
    -------
    list of str
    """
    if not confined:
        return [sys.executable, *_PYTHON_OPTIONS]
    base, mount_point = python_folder()
    command = [shutil.which("bwrap") or "bwrap", "--die-with-parent", "--new-session", "--clearenv"]
    command += [*_namespace_options(), *_environment_options()]
    command += [*_bind("/usr"), *_system_folders(), *_system_commands(), *_image_libraries()]
    command += ["--proc", "/proc", "--dev", "/dev", "--perms", "1777", "--tmpfs", "/dev/shm"]
    command += [
        "--perms",
        "1777",
        "--tmpfs",
        "/tmp",
        *_new_folder("/course"),
        *_new_folder("/course/nothing"),
        *_new_folder(EXTRA),
        *_new_folder(ALLOWED),
    ]
    if mount_point != base:
        command += _bind(str(base), str(mount_point))
    for path in _outermost([*_foreign_folders(), *_foreign_package_folders()]):
        command += _empty_folder(str(path))
    if packages:
        command += [*_site_packages(), *_course_packages()]
    for folder, shared_mount_point in (shared or {}).items():
        command += ["--bind", folder, shared_mount_point]
    # If the user does not really change, kernels own these folders: the next kernel would find what one
    # wrote.
    command += ["--remount-ro", "/dev", "--remount-ro", "/"]
    command += ["--chdir", "/tmp", _interpreter(), *_PYTHON_OPTIONS]
    return command


def _namespace_options():
    options = ["--unshare-pid", "--unshare-net", "--unshare-ipc", "--unshare-uts", "--unshare-cgroup-try"]
    options += ["--hostname", "course", "--cap-drop", "ALL"]
    if os.geteuid() != 0:
        options += ["--unshare-user", "--uid", "0", "--gid", "0"]
    for name in _CAPABILITIES:
        options += ["--cap-add", f"CAP_{name}"]
    return options


def _environment_options():
    return [option for name, value in environment().items() for option in ("--setenv", name, value)]


def _bind(source, mount_point=None):
    return ["--ro-bind", source, mount_point or source]


def _new_folder(path):
    return ["--perms", "0755", "--dir", path]


def _empty_folder(path):
    return ["--tmpfs", path, "--remount-ro", path]


def _system_folders():
    options = []
    for name in ("bin", "sbin", "lib", "lib32", "lib64"):
        path = Path("/", name)
        if path.is_symlink():
            options += ["--symlink", str(path.readlink()), str(path)]
        elif path.is_dir():
            options += _bind(str(path))
    options += _new_folder("/etc")
    for name in _ETC:
        options += ["--ro-bind-try", f"/etc/{name}", f"/etc/{name}"]
    return options


def _system_commands():
    """Of the system's commands, those for a line such as `!ls`: ImageMagick would solve exercises.

    What lies beside the libraries (below /usr/lib) can still be run, if `_PROGRAM_FOLDERS` does not name it:
    Python needs that folder.
    """
    options, interpreter = [], Path(sys.executable).resolve()
    for path in filter(Path.is_dir, map(Path, _COMMAND_FOLDERS)):
        if not path.is_symlink():
            options += ["--perms", "0755", "--tmpfs", str(path)]
            commands = [*(path / name for name in _COMMANDS), *([interpreter] * (interpreter.parent == path))]
            options += [option for command in commands if command.is_file() for option in _bind(str(command))]
            options += ["--remount-ro", str(path)]
    return options


def _image_libraries():
    """Put nothing in the place of the system's image libraries; what an exercise allows is in wheels."""
    folders = {folder.resolve() for name in _LIBRARY_FOLDERS for folder in Path("/usr").glob(name)}
    entries = [entry for folder in folders if folder.is_dir() for entry in os.scandir(folder)]
    files = {Path(entry).resolve() for entry in entries if _IMAGE_LIBRARIES.match(entry.name)}
    programs = [entry.path for entry in entries if _PROGRAM_FOLDERS.fullmatch(entry.name)]
    options = [
        option for path in sorted(programs) if _is_plain_folder(Path(path)) for option in _empty_folder(path)
    ]
    return options + [
        option for path in sorted(files) if path.is_file() for option in _bind(os.devnull, str(path))
    ]


def _site_packages():
    from imgproc_course.classroom.autograder.sandbox.allowed_modules import base_paths

    options = _new_folder(SITE)
    for path in base_paths():
        options += _bind(str(path), f"{SITE}/{path.name}")
    options += _bind(str(INSIDE / "PIL"), f"{SITE}/PIL")
    for folder in site_folders():
        options += _bind(str(folder), extra_path(folder))
    # An installed copy of the course would contain the autograder, and a link to the checkout its path.
    for path in sorted(site_folders()[0].glob(f"*{course.NAME}*")):
        options += _empty_folder(extra_path(path)) if path.is_dir() else _bind(os.devnull, extra_path(path))
    return options


def extra_path(path):
    """Where an installed file or folder is inside the sandbox, out of reach of every kernel."""
    for number, folder in enumerate(site_folders()):
        if path.is_relative_to(folder):
            return str(Path(f"{EXTRA}/site-{number}", path.relative_to(folder)))
    raise ValueError(f"{path} is in no folder of installed packages")


def course_package_paths(package):
    """Where a package of the course is inside the sandbox, and where in a kernel that may use it."""
    return f"{EXTRA}/course/{package}", f"{COURSE}/{course.NAME}/{package}"


def _course_packages():
    root = f"{COURSE}/{course.NAME}"
    options = [*_new_folder(COURSE), *_new_folder(root), *_new_folder(f"{EXTRA}/course")]
    options += _bind(str(SOURCE / "__init__.py"), f"{root}/__init__.py")
    for package in course.PACKAGES:
        if (SOURCE / package).is_dir():
            extra, mount_point = course_package_paths(package)
            options += [*_bind(str(SOURCE / package), extra), *_new_folder(mount_point)]
    for package in ("exercises", "display"):
        options += _new_folder(f"{root}/{package}")
        options += _bind(str(INSIDE / f"{package}_stub.py"), f"{root}/{package}/__init__.py")
    for name in ("", "/exercises", "/autograder", "/autograder/sandbox"):
        options += _new_folder(f"{CLASSROOM}{name}")
    names = ["__init__.py", "course.py", *(f"exercises/{module}.py" for module in EXERCISES_MODULES)]
    names += [f"autograder/{name}" for name in ("__init__.py", "sandbox/__init__.py", "sandbox/inside")]
    for name in names:
        options += _bind(str(SOURCE / "classroom" / name), f"{CLASSROOM}/{name}")
    return options


# ---------------------------------------------------------------- folders, environment, user


def site_folders():
    """The folders of installed packages, outside the sandbox."""
    folders = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    return [Path(folder) for folder in sorted(folders) if Path(folder).is_dir()]


def python_folder():
    """(folder of Python itself, where it is inside the sandbox): the system's stays, another is /python."""
    base = Path(sys.base_prefix).resolve()
    return base, base if base in (Path("/usr"), Path("/usr/local")) else Path(PYTHON)


def _interpreter():
    base, mount_point = python_folder()
    return str(mount_point / Path(sys.executable).resolve().relative_to(base))


def _foreign_folders():
    """What lies below /usr and in Python's folder and is not the system's, as seen inside: it is emptied."""
    mount_points = {path: path for path in (Path("/usr"), Path("/usr/local"))} | dict([python_folder()])
    folders = [
        mount_point / entry.name
        for root, mount_point in mount_points.items()
        for entry in (root.iterdir() if root.is_dir() else ())
        if entry not in mount_points and entry.name not in _SYSTEM_FOLDERS and _is_plain_folder(entry)
    ]
    own = {path for path in (SOURCE.parent, *site_folders()) if path.is_relative_to("/usr")}
    return [*folders, *filter(_is_plain_folder, own)]


def _is_plain_folder(path):
    return path.is_dir() and not path.is_symlink()


def _outermost(paths):
    """Paths without those that lie in another one of them; sorted."""
    paths = set(paths)
    return sorted(path for path in paths if not paths.intersection(path.parents))


def _foreign_package_folders():
    """Package folders of the system and of Python itself, as seen inside: they are emptied."""
    base, mount_point = python_folder()
    paths = [path for lib in ("lib", "local/lib") for path in Path("/usr", lib).glob("python3*/*-packages")]
    paths += [
        mount_point / path.relative_to(base)
        for pattern in ("lib/python3*/site-packages", "lib/python3*/dist-packages")
        for path in base.glob(pattern)
    ]
    return paths


def environment():
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
        "OPENCV_LOG_LEVEL": "ERROR",
        "OPENBLAS_NUM_THREADS": "1",
        "OMP_NUM_THREADS": "1",
        "LD_LIBRARY_PATH": str(mount_point / "lib") if mount_point != Path("/usr") else "",
    }


def search_path(confined):
    """Where Python looks for modules inside, after its own library."""
    return [COURSE, ALLOWED, SITE] if confined else [str(SOURCE.parent)]


def kernel_user():
    """The first of the unused user ids of this process's kernels; None if not root.

    Each kernel has the next one, because limits and priorities count by user.
    """
    return 2_000_000 + os.getpid() * confine.USERS_OF_SERVER if os.geteuid() == 0 else None
