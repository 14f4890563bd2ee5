"""Modules that an exercise does not allow: importing one costs nothing as long as nothing uses it.

The files of such a module are not in the kernel's file system; this makes its absence kind. An unused import
gives an empty module. An import inside a try or a with statement fails, so that the answer's own way without
the module is taken. Using an empty module raises RefusedModule.
"""

import dis
import importlib.machinery
import sys
import types

from imgproc_course.classroom import course
from imgproc_course.classroom.autograder.sandbox.inside import confine


class RefusedModule(ModuleNotFoundError):
    """The answer uses a module that its exercise does not allow."""


class Unusable:
    """Stands for whatever a module that is not allowed would hold."""

    def __init__(self, module):
        object.__setattr__(self, "_module", module)

    def _refuse(self, *_arguments, **_options):
        module = object.__getattribute__(self, "_module")
        raise RefusedModule(f"write this exercise without {module}", name=module)

    __call__ = __getattr__ = __iter__ = __getitem__ = __array__ = __bool__ = __len__ = _refuse


class _EmptyModule(types.ModuleType):
    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return Unusable(self.__name__)


class _Finder:
    """Comes before all other finders; it finds what is not allowed."""

    def __init__(self, names):
        self._names = frozenset(names)

    def find_spec(self, name, path=None, target=None):
        if self._is_allowed(name):
            return None
        frame = _importing_frame()
        if frame.f_globals.get("__name__") != "__main__":
            return None  # a library looks for another one; nobody finds what is not there
        if _is_guarded(frame):
            raise RefusedModule(f"write this exercise without {name}", name=name)
        return importlib.machinery.ModuleSpec(name, self, is_package=True)

    def create_module(self, spec):
        return _EmptyModule(spec.name)

    def exec_module(self, module):
        pass

    def _is_allowed(self, name):
        top, *submodules = name.split(".")
        if top == course.NAME:
            return not submodules or f"{top}.{submodules[0]}" in self._names
        return top in self._names or top in sys.stdlib_module_names


def _importing_frame():
    frame = sys._getframe(2)
    while frame.f_back and frame.f_globals.get("__name__", "").startswith("importlib"):
        frame = frame.f_back
    return frame


def _is_guarded(frame):
    """Whether the frame is inside a try or a with statement now."""
    entries = dis.Bytecode(frame.f_code).exception_entries
    return any(entry.start <= frame.f_lasti < entry.end for entry in entries)


def allow_modules(names):
    """Let this process import the named modules and the standard library, and no other.

    Parameters
    ----------
    names : sequence of str, as `ModuleAccess.names`
    """
    # Nothing else is mounted after the fork server has loaded; to forget all folders takes longer.
    sys.path_importer_cache.pop(confine.ALLOWED, None)
    sys.meta_path.insert(0, _Finder(names))
