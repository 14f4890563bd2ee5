"""The sandbox around learners' code: bubblewrap, what it shows, and what is missing where it cannot be made.

Inside stand the system's libraries, Python, the installed packages, the course's own rooms that a lesson
teaches, and `inside/`, all read-only; no network, no home folder, no environment, no key, no submission. See
`inside/confine.py` for what each kernel is shut in with once more.
"""

import json
import os
import shutil
import subprocess
import sys
import sysconfig
from dataclasses import asdict, dataclass
from functools import lru_cache
from importlib import metadata, util
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2]
INSIDE = Path(__file__).resolve().parent / "inside"
ROOMS = ("messages", "imaging", "recording", "display", "ros")  # what lessons teach with
ANSWER_FORMS = (
    "canonical",
    "comparison",
    "dependencies",
    "running",
)  # modules of `exercises` that check cells need
SITE, OURS, PYTHON = "/course/site-packages", "/course/rooms", "/python"
GRADER = f"{OURS}/imgproc_course/autograder"
_OPTIONS = ("-s", "-P", "-B")  # not -I: it would forget PYTHONHASHSEED
_CAPABILITIES = ("SYS_ADMIN", "SETUID", "SETGID", "SETPCAP", "KILL", "CHOWN")


class SandboxError(RuntimeError):
    """There is no sandbox on this machine; the message says what is missing and what to do."""


@dataclass(frozen=True)
class Limits:
    """What one kernel may use. A case's processor time is its exercise's time limit for each call, and
    `grace`.

    memory, scratch, file, output are bytes; grace, wall_grace are seconds, wall_factor a factor on the
    processor time
    """

    memory: int = 2 << 30
    scratch: int = 32 << 20
    file: int = 16 << 20
    output: int = 8 << 20
    processes: int = 64
    grace: float = 2.0
    wall_factor: float = 4.0
    wall_grace: float = 8.0

    def of_system(self, seconds):
        """The limits that the system holds for a kernel that may use so many seconds."""
        return asdict(self) | {"cpu": int(-(-(seconds + self.grace) // 1))}

    def deadline(self, seconds):
        """Seconds on the clock after which a kernel is ended from outside, whatever it does."""
        return (seconds + self.grace) * self.wall_factor + self.wall_grace


@lru_cache(maxsize=1)
def why_not():
    """Why there is no sandbox here, with the remedy; "" where there is one."""
    if not sys.platform.startswith("linux"):
        return (
            f"grading needs Linux, this is {sys.platform}: grade in the course's container"
            " (environment/Dockerfile), in WSL or on a Linux machine"
        )
    program = shutil.which("bwrap")
    if program is None:
        return (
            "bubblewrap is not installed: sudo apt-get install bubblewrap"
            " (Fedora: sudo dnf install bubblewrap; Arch: sudo pacman -S bubblewrap)"
        )
    trial = subprocess.run(
        [*command({"confined": True}), "-c", "print('in')"],
        env={},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    if trial.returncode == 0 and trial.stdout.strip() == "in":
        return ""
    said = " ".join(trial.stderr.split())[:300] or f"exit code {trial.returncode}"
    return (
        f"bubblewrap cannot make a sandbox here ({said}). Allow user namespaces"
        " (sudo sysctl -w kernel.unprivileged_userns_clone=1; on Ubuntu 24.04 also"
        " sudo sysctl -w kernel.apparmor_restrict_unprivileged_userns=0), or grade as root in a container"
        " that was started with --privileged"
    )


def demand():
    """Do nothing where there is a sandbox.

    Raises
    ------
    SandboxError : there is none; one line with the remedy
    """
    reason = why_not()
    if reason:
        raise SandboxError(
            f"{reason}. Without a sandbox learners' code would run as you, with your files: --unsafe if you"
            " accept that"
        )


# ---------------------------------------------------------------- what stands inside


def _site_folders():
    here = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    return [Path(folder) for folder in sorted(here) if Path(folder).is_dir()]


def _base():
    """Python's own folder, and where it stands inside: where it is, or at /python."""
    base = Path(sys.base_prefix).resolve()
    return base, base if base.is_relative_to("/usr") else Path(PYTHON)


def _interpreter():
    base, inside = _base()
    return str(inside / Path(sys.executable).resolve().relative_to(base))


def _other_packages():
    """Folders of packages that belong to the system or to Python itself, as seen inside: emptied."""
    base, inside = _base()
    found = [
        path for place in ("lib", "local/lib") for path in Path("/usr", place).glob("python3*/*-packages")
    ]
    found += [
        inside / path.relative_to(base)
        for pattern in ("lib/python3*/site-packages", "lib/python3*/dist-packages")
        for path in base.glob(pattern)
    ]
    return sorted({str(path) for path in found})


def command(settings, *, shared=None):
    """bubblewrap's command line, up to and with the interpreter and its options.

    Parameters
    ----------
    settings : dict with "confined"; where it is False there is no bubblewrap, the interpreter alone
    shared : {folder: its place inside}, folders that may be written: an ipykernel's sockets

    Returns
    -------
    list of str
    """
    if not settings["confined"]:
        return [sys.executable, *_OPTIONS]
    base, inside = _base()
    words = [shutil.which("bwrap") or "bwrap", "--die-with-parent", "--new-session", "--clearenv"]
    words += ["--unshare-pid", "--unshare-net", "--unshare-ipc", "--unshare-uts", "--unshare-cgroup-try"]
    words += ["--hostname", "course", "--cap-drop", "ALL"]
    if os.geteuid() != 0:
        words += ["--unshare-user", "--uid", "0", "--gid", "0"]
    for name in _CAPABILITIES:
        words += ["--cap-add", f"CAP_{name}"]
    for name, value in environment().items():
        words += ["--setenv", name, value]
    words += [*_folder("/usr"), *_system_folders()]
    words += ["--proc", "/proc", "--dev", "/dev", "--perms", "1777", "--tmpfs", "/dev/shm"]
    words += ["--perms", "1777", "--tmpfs", "/tmp", "--perms", "0755", "--dir", "/course"]
    words += ["--perms", "0755", "--dir", "/course/nothing"]
    if inside != base:
        words += _folder(str(base), str(inside))
    for path in _other_packages():
        words += _emptied(path)
    words += _packages()
    for folder, place in (shared or {}).items():
        words += ["--bind", folder, place]
    # Without a real change of user, kernels own what stands here: what one wrote the next would find.
    words += ["--remount-ro", "/dev", "--remount-ro", "/"]
    words += ["--chdir", "/tmp", _interpreter(), *_OPTIONS]
    return words


def _folder(source, inside=None):
    return ["--ro-bind", source, inside or source]


def _emptied(path):
    return ["--tmpfs", path, "--remount-ro", path]


def _system_folders():
    words = []
    for name in ("bin", "sbin", "lib", "lib32", "lib64"):
        path = Path("/", name)
        if path.is_symlink():
            words += ["--symlink", str(path.readlink()), str(path)]
        elif path.is_dir():
            words += _folder(str(path))
    words += ["--perms", "0755", "--dir", "/etc"]
    for name in (
        "ld.so.cache",
        "ld.so.conf",
        "ld.so.conf.d",
        "alternatives",
        "localtime",
        "nsswitch.conf",
        "fonts",
    ):
        words += ["--ro-bind-try", f"/etc/{name}", f"/etc/{name}"]
    return words


def _packages():
    words = []
    (folder, *others) = _site_folders()
    words += _folder(str(folder), SITE)
    for number, other in enumerate(others, 2):
        words += _folder(str(other), f"{SITE}-{number}")
    # The course itself: an installed copy would hold the grader, and a link to the checkout its path.
    for path in sorted(folder.glob("*imgproc_course*")):
        inside = f"{SITE}/{path.name}"
        words += _emptied(inside) if path.is_dir() else ["--ro-bind", os.devnull, inside]
    words += ["--perms", "0755", "--dir", OURS, "--perms", "0755", "--dir", f"{OURS}/imgproc_course"]
    words += _folder(str(PACKAGE / "__init__.py"), f"{OURS}/imgproc_course/__init__.py")
    for room in ROOMS:
        if (PACKAGE / room).is_dir():
            words += _folder(str(PACKAGE / room), f"{OURS}/imgproc_course/{room}")
    exercises = f"{OURS}/imgproc_course/exercises"
    words += ["--perms", "0755", "--dir", exercises]
    words += _folder(str(INSIDE / "exercises_init.py"), f"{exercises}/__init__.py")
    for name in ANSWER_FORMS:
        words += _folder(str(PACKAGE / "exercises" / f"{name}.py"), f"{exercises}/{name}.py")
    words += ["--perms", "0755", "--dir", GRADER, "--perms", "0755", "--dir", f"{GRADER}/sandbox"]
    for name in ("__init__.py", "sandbox/__init__.py", "sandbox/inside"):
        words += _folder(str(PACKAGE / "autograder" / name), f"{GRADER}/{name}")
    return words


def environment():
    """The environment of every kernel: nothing of the teacher's."""
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
        "LD_LIBRARY_PATH": str(_base()[1] / "lib") if _base()[1] != Path("/usr") else "",
    }


def search_path(confined):
    """Where Python looks inside, after its own library."""
    if not confined:
        return [str(PACKAGE.parent)]
    others = [f"{SITE}-{number}" for number in range(2, 1 + len(_site_folders()))]
    return [OURS, SITE, *others]


# ---------------------------------------------------------------- refused modules


@lru_cache(maxsize=256)
def places_of(module):
    """Where a module stands inside, so that a kernel can be made without it.

    Parameters
    ----------
    module : str, "cv2" or "imgproc_course.imaging"

    Returns
    -------
    tuple of str, paths as seen inside; of a distribution everything that it installed at the top
    """
    if module.startswith("imgproc_course."):
        inner = module.split(".", 1)[1].replace(".", "/")
        return (f"{OURS}/imgproc_course/{inner}", f"{OURS}/imgproc_course/{inner}.py")
    top, _, inner = module.partition(".")
    names = {top}
    if not inner:
        for files in _installed_with(top):
            names |= {file.parts[0] for file in files if file.parts[0] not in ("..", "__pycache__")}
    found = [_inside_site(path) for name in names for path in _entries(name, inner)]
    return tuple(sorted({*found, *_in_standard_library(module)}))


def _installed_with(top):
    """The files of each distribution that installs a top-level module.

    As metadata.packages_distributions() finds them, without taking apart what 250 distributions say of
    themselves, which takes a third of a second.
    """
    begins = (f"\n{top}".encode(), f'\n"{top}'.encode())
    for folder, rows in _records():
        if any(each in rows for each in begins):
            files = metadata.PathDistribution(folder).files or ()
            if any(file.parts[0].partition(".")[0] == top for file in files):
                yield files


@lru_cache(maxsize=1)
def _records():
    """The folder of each distribution, and its list of files as it stands there, after a line's end."""
    found = [path for folder in _site_folders() for path in folder.glob("*.dist-info/RECORD")]
    return [(path.parent, b"\n" + path.read_bytes()) for path in found]


def _entries(name, inner):
    for folder in _site_folders():
        path = folder / name / inner.replace(".", "/") if inner else folder / name
        yield from (found for found in (path, path.with_name(f"{path.name}.py")) if found.exists())
        yield from path.parent.glob(f"{path.name}.*.so")


def _inside_site(path):
    for number, folder in enumerate(_site_folders(), 1):
        if path.is_relative_to(folder):
            return str(Path(SITE if number == 1 else f"{SITE}-{number}") / path.relative_to(folder))
    raise ValueError(f"{path} is in no folder of packages")


def _in_standard_library(module):
    top = module.partition(".")[0]
    if top not in sys.stdlib_module_names:
        return
    found = util.find_spec(top)
    base, inside = _base()
    if found is None or not found.origin or not Path(found.origin).is_absolute():
        return
    path = Path(found.origin).resolve()
    if not path.is_relative_to(base):
        return
    path = path.parent if path.name == "__init__.py" else path
    for each in (path, *path.parent.glob(f"__pycache__/{path.stem}.*.pyc")):
        yield str(inside / each.relative_to(base))


def start_zygote(control, group, *, confined):
    """Start the process that forks kernels.

    Parameters
    ----------
    control : socket, its end of a SOCK_SEQPACKET pair
    group : Group that it is to be in
    confined : bool; False is --unsafe

    Returns
    -------
    subprocess.Popen
    """
    settings = {"confined": confined, "user": user() if confined else None, "control": control.fileno()}
    start = f"import sys; sys.path += {search_path(confined)!r}; "
    start += "from imgproc_course.autograder.sandbox.inside import fork_server; fork_server.main()"
    words = [*command(settings), "-c", start, json.dumps(settings)]
    return subprocess.Popen(
        words,
        env={} if confined else environment(),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        pass_fds=[control.fileno()],
        preexec_fn=group.enter,
        start_new_session=True,
    )


def user():
    """A user of nobody's for this process's kernels: limits on processes count by user."""
    return 2_000_000 + os.getpid() if os.geteuid() == 0 else None
