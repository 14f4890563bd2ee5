"""What a check cell calls: it gives the learner's function its inputs, and shows what came back.

Values, never verdicts. The inputs of one case are delivered just before its cell runs; the expected values
are elsewhere.
"""

import base64
import builtins
import hashlib
import importlib.machinery
import inspect
import json
import signal
import sys
import types

from imgproc_course.autograder.sandbox.inside.input_encoding import decode
from imgproc_course.exercises import running
from imgproc_course.exercises.dependencies import find_dependencies

MIME = "application/vnd.imgproc-course.answer+json"
LARGEST = 1_000_000  # bytes of one array; a larger one is shown by its digest
_case = {}  # "calls", "seconds", "refused"


class RefusedModule(ImportError):
    """The answer uses a module that its exercise refuses."""


def deliver(case):
    """Take the inputs of the next check.

    Parameters
    ----------
    case : dict, or its JSON: "calls", one list of `values.encode`d arguments each; "seconds" that a call may
        take; "refused", modules
    """
    global _case
    _case = json.loads(case) if isinstance(case, str) else case


def emit(function):
    """Call a function with the inputs of this case, and show what came back, as data."""
    from IPython.display import display

    refused = tuple(_case["refused"])
    told = []
    for arguments in _case["calls"]:
        arguments = decode(arguments)
        outcome = _called(function, arguments, _case["seconds"])
        told.append(told_of(outcome))
        if outcome.timed_out:
            break
    dependencies = find_dependencies(function, refused, set())
    display({MIME: {"calls": told, "refused": list(dependencies.refused)}}, raw=True)


def _called(function, arguments, seconds):
    """As `check` calls it, but on the processor's clock: a busy machine takes no time from anybody."""

    def ring(_signal, _frame):
        raise running.TimeUp

    signal.signal(signal.SIGPROF, ring)
    signal.setitimer(signal.ITIMER_PROF, seconds, 0.1)
    try:
        return running.call(function, arguments, argument_names(function, arguments), 1e6)
    except running.TimeUp:  # it rang between the call's end and here
        return running.CallResult(timed_out=True)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)


def argument_names(function, arguments=()):
    """The names of a function's arguments; those that it has no name for are numbered."""
    try:
        names = list(inspect.signature(function).parameters)
    except (TypeError, ValueError):
        names = []
    if not arguments:
        return names
    return [*names[: len(arguments)], *(f"argument {k + 1}" for k in range(len(names), len(arguments)))]


def told_of(outcome):
    """An CallResult as JSON."""
    if outcome.timed_out:
        return {"timed_out": True}
    told = {"changed": list(outcome.changed), "printed": outcome.printed}
    if outcome.error:
        return told | {"error": outcome.error, "message": outcome.message, "line": outcome.line}
    return told | {"value": shortened(outcome.value)}


def shortened(form):
    """A canonical form with its large arrays and bytes given by digest."""
    if isinstance(form, list):
        return [shortened(item) for item in form]
    if not isinstance(form, dict):
        return form
    if len(form.get("data", "")) > LARGEST * 4 // 3:
        raw = base64.b64decode(form["data"])
        kept = {name: value for name, value in form.items() if name != "data"}
        return kept | {"digest": hashlib.sha256(raw).hexdigest()}
    return {name: shortened(value) for name, value in form.items()}


# ---------------------------------------------------------------- the lesson's surroundings


def surround(refused):
    """Make this process what an answer expects around it.

    Parameters
    ----------
    refused : sequence of str, modules; importing one gives an empty module that says so when it is used, so
        that an import which nothing needs costs nothing
    """
    # Looked up, not gone through: reading every name would copy the pages that this fork shares.
    if any(name in sys.modules for name in refused):
        for name in [name for name in sys.modules if _is_refused(name, refused)]:
            del sys.modules[name]
    sys.meta_path.insert(0, _Refusing(tuple(refused)))
    builtins.input = _no_input


def _is_refused(name, refused):
    return any(name == each or name.startswith(each + ".") for each in refused)


class _Refusing:
    def __init__(self, refused):
        self._refused = refused

    def find_spec(self, name, path=None, target=None):
        if not _is_refused(name, self._refused):
            return None
        return importlib.machinery.ModuleSpec(name, self, is_package=True)

    def create_module(self, spec):
        return _RefusedName(spec.name)

    def exec_module(self, module):
        pass


class _RefusedName(types.ModuleType):
    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        raise RefusedModule(f"this exercise is to be written without {self.__name__}")


def _no_input(prompt=""):
    raise RuntimeError("input() waits for a person; grading has none. Give the value as an argument")
