"""What an answer may not do: modules that its exercise does not allow, and what the sandbox refuses.

Importing a module costs nothing as long as nothing uses it. They are refused by their names, and only where
the learner's own code imports them: libraries find each other. An unused import gives an empty module. An
import inside a try or a with statement fails, so that the answer's own way without the module is taken. Using
an empty module raises RefusedModule. In the place of a module that only shows something stands one that shows
nothing.

The teacher reads what the sandbox refused, and no verdict depends on it. Python's audit events tell it. Only
what the learner's code does counts, itself or through the standard library: NumPy and matplotlib read files
and start programs, too.
"""

import builtins
import dis
import importlib
import os
import sys
import types
from importlib.machinery import PathFinder

from nbclassroom import course
from nbclassroom.exercises.page_run import Missing
from nbclassroom.exercises.running import KNOWN_ERRORS

# Every answer may use these, and the standard library.
_ALWAYS = (
    *("numpy", "matplotlib", "mpl_toolkits", "matplotlib_inline", "IPython", "ipykernel", "traitlets"),
    *(course.package, "nbclassroom", *course.always_allowed),
)
_MOST, _MOST_CHARACTERS = 20, 80  # attempts that a process tells, and of each
_LIBRARY = os.path.dirname(os.__file__) + os.sep  # noqa: PTH120 - `os` only, see `confine`
_ABOUT_THE_MACHINE = ("/etc/os-release/", "/etc/hostname/", "/proc/cpuinfo/", "/proc/meminfo/")
_SUBMISSION, _SCRATCH = "/tmp/submission/", ("/tmp/", "/dev/", "/content/")  # /content/: Colab's, not here
_OPEN_TO_ALL = ("/tmp/", "/course/", "/usr/", "/python/", "/dev/", "/content/", _LIBRARY, *_ABOUT_THE_MACHINE)
_PROGRAM, _NETWORK, _END = "start a program", "open the network", "end Python"
_READ, _WRITE, _REMOVE = "read files", "write files", "remove files"
_absolute, _FOR_WRITING = os.path.abspath, os.O_WRONLY | os.O_RDWR | os.O_CREAT
_HARMLESS = f"{_PROGRAM} (uname -p)"  # by platform.processor()
# Where handlers begin that Python adds from 3.12 on, around a comprehension and in a generator.
_OWN_HANDLERS = ("SWAP", "CALL_INTRINSIC_1")
_own_modules: set[str] = set()  # files that the learner's cells write, and their folders
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


class RefusedModule(ModuleNotFoundError):
    """The answer uses a module that its exercise does not allow."""


KNOWN_ERRORS["RefusedModule"] = RefusedModule


class _Silent:
    """What a module that only shows something holds; called with values, as a progress bar, it gives them."""

    def __init__(self, values=()):
        self._values = values

    def __call__(self, values=(), *_arguments, **_options):
        return _Silent(values if hasattr(values, "__iter__") else ())

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return _SILENT.get(name) or _Silent()

    def __iter__(self):
        return iter(self._values)

    def __len__(self):
        return len(self._values)

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        return False


_SILENT = {"trange": range, "tnrange": range, "tenumerate": enumerate, "tzip": zip, "tmap": map}  # of tqdm


class _StandIn(types.ModuleType):
    """A silent module, or an empty one."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        if _only_shows(self.__name__):
            return getattr(_Silent(), name)
        return Missing(RefusedModule(f"write this exercise without {self.__name__}", name=self.__name__))


def _only_shows(module):
    return module.partition(".")[0] in course.display_only


def _stand_ins(name):
    """Modules that stand for a dotted name and its packages, the outermost first."""
    parts = name.split(".")
    modules = [_StandIn(".".join(parts[:count])) for count in range(1, len(parts) + 1)]
    for package, module, part in zip(modules, modules[1:], parts[1:], strict=False):
        setattr(package, part, module)
    return modules


def _is_guarded(frame):
    """Whether the frame is inside a try or a with statement now."""
    code = dis.Bytecode(frame.f_code)
    own = {step.offset for step in code if step.opname in _OWN_HANDLERS}
    entries = code.exception_entries  # type: ignore[attr-defined]  # it has no documentation and no type
    entries = (entry for entry in entries if entry.target not in own)
    return any(entry.start <= frame.f_lasti < entry.end for entry in entries)


def allow_files(files):
    """Let the learner's code import the modules that it writes, unless there is another one of that name."""
    names = {part for file in files if file.endswith(".py") for part in file.removesuffix(".py").split("/")}
    _own_modules.update(name for name in names if PathFinder.find_spec(name) is None)


def allow_modules(allowed):
    """Let the learner's code import these modules and those of every answer, and no others."""
    names = {*_ALWAYS, *allowed, *(name.partition(".")[0] for name in allowed)}
    real_import, real_import_module = builtins.__import__, importlib.import_module

    def is_allowed(name):
        parts = name.split(".")
        name = ".".join(parts[: 2 if parts[0] == course.package else 1])
        return name in names or name in sys.stdlib_module_names or name in _own_modules

    def refused(name, frame):
        """What stands for the module that this frame may not import, [] if it may."""
        if frame.f_globals.get("__name__") != "__main__" or is_allowed(name):
            return []
        if _is_guarded(frame) and not _only_shows(name):
            raise RefusedModule(f"write this exercise without {name}", name=name)
        return _stand_ins(name)

    def import_(name, globals=None, locals=None, fromlist=(), level=0):
        frame = sys._getframe(1)
        modules = refused(name, frame) if not level else []
        if modules:
            return modules[-1 if fromlist else 0]
        module = real_import(name, globals, locals, fromlist, level)
        for part in fromlist or ():
            if name == course.package and part in course.packages and refused(f"{name}.{part}", frame):
                return _StandIn(f"{name}.{part}")
        return module

    def import_module(name, package=None):
        modules = refused(name, sys._getframe(1))
        return modules[-1] if modules else real_import_module(name, package)

    builtins.__import__, importlib.import_module = import_, import_module


def tell_attempts(tell):
    """Call tell(text) with each attempt of this process from now on."""
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
            tell(text)

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
