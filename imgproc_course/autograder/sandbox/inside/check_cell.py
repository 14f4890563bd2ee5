"""What a check cell calls: it gives the learner's function its inputs and shows what the function returned.

It shows values, never verdicts. The inputs of one case are delivered just before its cell runs. The expected
values are outside the sandbox.
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

from imgproc_course.exercises import running
from imgproc_course.exercises.dependencies import find_dependencies
from imgproc_course.exercises.input_encoding import decode

MIME = "application/vnd.imgproc-course.answer+json"
MAX_DATA = 1_000_000  # bytes of one array; a larger one is replaced by its digest
_case = {}  # "calls", "seconds", "refused"


class RefusedModule(ImportError):
    """The answer uses a module that its exercise refuses."""


def deliver(case):
    """Take the inputs of the next check.

    Parameters
    ----------
    case : dict, or its JSON: "calls", a list of arguments for each call, written by `input_encoding.encode`;
        "seconds" that a call may take; "refused", modules
    """
    global _case
    _case = json.loads(case) if isinstance(case, str) else case


def emit(function):
    """Call a function with the inputs of this case, and show what it returned, as data."""
    from IPython.display import display

    refused = tuple(_case["refused"])
    calls = []
    for encoded in _case["calls"]:
        result = _call(function, decode(encoded), _case["seconds"])
        calls.append(call_to_json(result))
        if result.timed_out:
            break
    dependencies = find_dependencies(function, refused, set())
    display({MIME: {"calls": calls, "refused": list(dependencies.refused)}}, raw=True)


def _call(function, arguments, seconds):
    """Call it as `check` does, but measure processor time: a busy machine costs nobody any time."""

    def raise_time_up(_signal, _frame):
        raise running.TimeUp

    signal.signal(signal.SIGPROF, raise_time_up)
    signal.setitimer(signal.ITIMER_PROF, seconds, 0.1)
    try:
        return running.call(function, arguments, argument_names(function, arguments), 1e6)
    except running.TimeUp:  # raised between the call's end and here
        return running.CallResult(timed_out=True)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)


def argument_names(function, arguments=()):
    """The names of a function's arguments; arguments without a name are numbered."""
    try:
        names = list(inspect.signature(function).parameters)
    except (TypeError, ValueError):
        names = []
    if not arguments:
        return names
    return [*names[: len(arguments)], *(f"argument {k + 1}" for k in range(len(names), len(arguments)))]


def call_to_json(result):
    """A CallResult as data for json.dumps; `answer_forms.read_answer` reads it."""
    if result.timed_out:
        return {"timed_out": True}
    data = {"changed": list(result.changed), "printed": result.printed}
    if result.error:
        return data | {"error": result.error, "message": result.message, "line": result.line}
    return data | {"value": shorten_form(result.value)}


def shorten_form(form):
    """A canonical form in which digests replace large arrays and bytes."""
    if isinstance(form, list):
        return [shorten_form(item) for item in form]
    if not isinstance(form, dict):
        return form
    if len(form.get("data", "")) > MAX_DATA * 4 // 3:
        data = base64.b64decode(form["data"])
        description = {name: value for name, value in form.items() if name != "data"}
        return description | {"digest": hashlib.sha256(data).hexdigest()}
    return {name: shorten_form(value) for name, value in form.items()}


# ---------------------------------------------------------------- the process around an answer


def prepare_process(refused):
    """Prepare this process for an answer: refused modules are empty, and input() raises.

    Parameters
    ----------
    refused : sequence of str, modules. Importing one gives an empty module that raises RefusedModule when it
        is used, so an unused import costs nothing
    """
    # Look names up first: going through sys.modules would copy the memory pages that this fork shares.
    if any(name in sys.modules for name in refused):
        for name in [name for name in sys.modules if _is_refused(name, refused)]:
            del sys.modules[name]
    sys.meta_path.insert(0, _RefusingFinder(tuple(refused)))
    builtins.input = _input


def _is_refused(name, refused):
    return any(name == module or name.startswith(module + ".") for module in refused)


class _RefusingFinder:
    def __init__(self, refused):
        self._refused = refused

    def find_spec(self, name, path=None, target=None):
        if not _is_refused(name, self._refused):
            return None
        return importlib.machinery.ModuleSpec(name, self, is_package=True)

    def create_module(self, spec):
        return _EmptyModule(spec.name)

    def exec_module(self, module):
        pass


class _EmptyModule(types.ModuleType):
    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        raise RefusedModule(f"write this exercise without {self.__name__}")


def _input(prompt=""):
    raise RuntimeError("input() waits for a person, and there is none here. Pass the value as an argument")
