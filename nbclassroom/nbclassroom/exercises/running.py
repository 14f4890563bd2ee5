"""Call a function that somebody else wrote: on copies of its arguments, and within a time limit.

Such a function may raise anything, so `except Exception` is right here. In this package it stands only where
the code of a learner or of a master runs.
"""

import ast
import contextlib
import copy
import ctypes
import difflib
import functools
import inspect
import io
import keyword
import linecache
import math
import operator
import re
import signal
import sys
import textwrap
import threading
import time
import tokenize
import traceback
import types
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .canonical import array_of, canonical
from .comparison import Difference, compare, named_items

NONE = {"type": "None"}  # the canonical form
_MOST_OUTPUT = 2_000  # characters; the function's further prints are dropped
_MOST_BYTES = 200_000  # of a value, beside its share of the expected one: 8 for each element of an array
_ADDRESS = re.compile(r"0x[0-9a-fA-F]{6,}")
_BLOCKS = 16  # of one size: more than NumPy or malloc keep for reuse
_REPEAT = 0.1  # seconds: an alarm swallowed by a bare `except:` rings again
_PATIENCE = 2  # time limits that a function may wait in addition, for the processor or in a sleep
# Looked up before any code of a learner's runs; Windows has no timers: there it is None.
set_timer: Any = getattr(signal, "setitimer", None)
set_handler = signal.signal
_monotonic, _thread_time = time.monotonic, time.thread_time


class NotGradedError(BaseException):
    """An answer uses a part of ROS that the check does not have; no `except Exception` of it catches it."""


class NodeError(BaseException):
    """An answer does not make a node that can be driven; the message says what to do."""


# By these names grading knows how an answer ended, if the classes are these.
_ERRORS: tuple[type, ...] = (MemoryError, NotImplementedError, NodeError, NotGradedError)
KNOWN_ERRORS = {kind.__name__: kind for kind in _ERRORS} | {"_ArrayMemoryError": MemoryError}
MEANT = "Did you mean"  # before the name that is most like a misspelled one


class TimeUp(BaseException):
    """Raised inside the function at its time limit; an `except Exception` in it does not catch this."""


@dataclass(frozen=True)
class CallResult:
    """What one call did; a text is "" where there is none."""

    value: dict | None = None  # canonical form of the returned value; None if the call did not finish
    error: str = ""  # type name of the exception
    message: str = ""
    line: str = ""  # the learner's line that raised it, with its number
    closest: str = ""  # the name that is most like one that does not exist
    timed_out: bool = False  # the time limit stopped the call
    stuck: bool = False  # it could not be stopped
    changed: tuple = ()  # names of the arguments that the function changed
    printed: str = ""  # the beginning of what it printed
    warning: str = ""  # the first one, or the first of an overflow

    @property
    def finished(self):
        return not self.error and not self.timed_out

    def matches(self, other, tolerance, *, exact_type=True):
        """Whether two calls did the same: the same error with the same message, or equal values."""
        ends = [(call.error, call.message, call.timed_out, call.changed) for call in (self, other)]
        if ends[0] != ends[1]:
            return False
        return not self.finished or compare(other.value, self.value, tolerance, exact_type=exact_type) is None


@dataclass(frozen=True)
class CaseCall:
    """One call of a case: what was expected, what the answer did; of a drive the `drive.Drive.record`."""

    case: Any
    arguments: tuple
    expected: CallResult
    result: CallResult
    difference: Difference | None
    record: dict | None = None

    @property
    def passed(self) -> bool:
        return self.result.finished and not self.result.changed and self.difference is None

    @property
    def has_right_values(self):
        """Whether its values are right, in a type that may be wrong, also if that type has cut them."""
        if self.result.matches(self.expected, self.case.tolerance, exact_type=False):
            return True
        values, actual = array_of(self.expected.value), array_of(self.result.value)
        if values is None or actual is None:
            return False
        with np.errstate(all="ignore"):
            return np.array_equal(values.astype(actual.dtype), actual)


@dataclass(frozen=True)
class Verdict:
    """What a graded answer did in the calls of a case, each compared once with what is expected."""

    calls: Sequence[CaseCall] = ()
    # Why no honest check shows this, "" if one does.
    forged: str = "its check cell showed something else than what the function returned"
    # What a partner measures is told of hidden cases, too.
    when: str = ""
    measured: str = ""
    told_of_hidden: str = ""

    @property
    def passed(self):
        return not self.forged and all(call.passed for call in self.calls)

    @property
    def result(self):
        """The CallResult of the first call that failed, an empty one if none did."""
        return next((call.result for call in self.calls if not call.passed), CallResult())


def explain_call(result, difference, name):
    """What went wrong in one call of an answer of this name, in a sentence or two; "" if nothing did."""
    if result.timed_out:
        text = f"{name} did not finish in time and was stopped."
        return text + " It could not be stopped: restart the kernel before you go on." * result.stuck
    if result.error:
        text = f"{name} raised {result.error}" + (f": {result.message}" if result.message else "")
        return text + (f"\nin your {result.line}" if result.line else "")
    if result.changed:
        argument = result.changed[0]
        text = f"{name} changed its input {argument}."
        if not argument.isidentifier():
            return f"{text} Only read it, and store what you compute under new names."
        advice = f"write into something new, such as {argument}.copy(), and read from {argument}."
        return f"{text} Leave the input as it is: {advice}"
    if difference is None:
        return ""
    if result.value["type"] == "None" and result.printed:
        return f"{name} returned None. print only shows a value: write return in place of print."
    message = difference.message[0].upper() + difference.message[1:] + "."
    return f"In answer{difference.path}: {message}" if difference.path else message


def call(function, arguments, names, time_limit, run=operator.call, most_bytes=None):
    """Call a function on copies of its arguments; the CallResult says what it did.

    `names` are the arguments'; those without a name are numbered. The time limit is in seconds; on a busy
    machine up to three times as long. `run(function, *arguments)` gives the value.
    Arrays are given with their values up to `most_bytes` together, see `canonical`.
    """
    copies = copy.deepcopy(arguments)
    names = [*names[: len(copies)], *(f"argument {k + 1}" for k in range(len(names), len(copies)))]
    before = [canonical(value) for value in copies]
    output = LimitedOutput()
    texts: list[str] = []
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        warnings.showwarning = functools.partial(_keep_warning, texts)
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            fields = _call_fields(function, copies, time_limit, run, most_bytes)
    if not fields.get("stuck"):
        pairs = zip(names, before, copies, strict=True)
        fields["changed"] = tuple(
            name for name, old, new in pairs if old != canonical(new, most=bytes_allowed(old))
        )
    return CallResult(printed=output.getvalue(), warning="".join(texts), **fields)


def _keep_warning(texts, message, *_place):
    """Keep the first one, or the first of an overflow, which explains most: a loop may warn very often."""
    text = str(message)[:_MOST_OUTPUT]
    if "overflow" in text:
        texts[:] = [text]
        warnings.simplefilter("ignore")
    elif not texts:
        texts[:] = [text]
        warnings.filterwarnings("ignore", re.escape(text))


def _call_fields(function, arguments, time_limit, run, most_bytes):
    """The fields of CallResult that the call itself gives, as a dict."""
    try:
        value = call_within(lambda: run(function, *arguments), time_limit)
        return {"value": canonical(value, most=most_bytes)}
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # noqa: BLE001 - a learner's function may raise anything
        return failure_fields(error, function)


def failure_fields(error, function):
    """The fields of CallResult that say why a call did not finish, as a dict."""
    if isinstance(error, TimeUp):
        return {"timed_out": True, "stuck": bool(error.args)}
    closest = attempt(lambda: _closest(error, str(error.name or "")), "")
    text = attempt(lambda: str(error), "")  # its class may be the learner's
    message = _ADDRESS.sub("0x…", text[:2_000])[:500]
    fields = {"error": error_name(error), "message": message, "closest": closest}
    return fields | {"line": _own_line(error, function)}


def error_name(error):
    """The name of an exception's class, marked if grading knows another class by it."""
    name = type(error).__name__
    is_known = isinstance(error, KNOWN_ERRORS.get(name, BaseException))
    return name if is_known else f"{name} (a class of the answer)"


def overwrite_freed_memory(form):
    """Fill memory of the sizes of a value's arrays, and free it.

    Freed memory may still hold an expected result. An answer that fills only a part of np.empty_like() would
    find it there, and pass by chance.
    """
    sizes = {np.prod(part["shape"], dtype=int) * np.dtype(part["dtype"]).itemsize for part in _arrays(form)}
    blocks = [np.full(size, 0xA5, np.uint8) for size in sizes for _ in range(_BLOCKS)]
    del blocks


def bytes_allowed(form):
    """How many bytes the arrays and texts of a value may have that is compared with this form."""
    return _MOST_BYTES + _size(form)


def _size(form):
    if isinstance(form, list):
        return sum(map(_size, form))
    text = form.get("value")
    size = form.get("length", 0) + (len(text) if isinstance(text, str) else 0)
    size += 8 * math.prod(form.get("shape", (0,)))
    return size + _size(form.get("items", [])) + _size([*form.get("fields", {}).values()])


def _arrays(form):
    if form["type"] == "ndarray":
        yield form
    for _, part in named_items(form):
        yield from _arrays(part)


class LimitedOutput(io.StringIO):
    """Keeps the first part of the output: a loop that prints must not fill the memory."""

    def write(self, text):
        space = _MOST_OUTPUT - self.tell()
        if space > 0:
            super().write(text[:space])
        return len(text)


def call_within(function, seconds):
    """What a function of no arguments returns; TimeUp is raised in it at its time limit."""
    if set_timer and threading.current_thread() is threading.main_thread():
        return _with_alarm(function, seconds)
    return _in_thread(function, seconds)


def attempt(compute, otherwise, seconds=1):
    """What compute() returns, or `otherwise` if it raises or does not end in time: a remark is left out."""
    try:
        return call_within(compute, seconds)
    except (Exception, TimeUp):  # noqa: BLE001 - it reads what is a learner's, or is no more than a remark
        return otherwise


def _with_alarm(function, seconds):
    armed, rings = True, 0

    def ring(_signal, _frame):
        nonlocal rings
        rings += 1
        # A busy machine, or one that stood still, gives no processor time: that is no endless loop.
        has_computed = _thread_time() - computed_before > seconds / 2
        if armed and (has_computed or rings > _PATIENCE * seconds / _REPEAT):
            raise TimeUp

    # Python drops what is raised in a finalizer or the collector's hooks; the next alarm ends the function.
    tell, sys.unraisablehook = sys.unraisablehook, lambda dropped: dropped.exc_type is TimeUp or tell(dropped)
    started, computed_before = _monotonic(), _thread_time()
    handler = set_handler(signal.SIGALRM, ring)
    # Another program may be using the alarm (pytest-timeout does): it gets the rest of its time back.
    seconds_left, interval = set_timer(signal.ITIMER_REAL, seconds, _REPEAT)
    try:
        try:
            return function()
        finally:
            armed = False
    finally:
        set_timer(signal.ITIMER_REAL, 0)
        set_handler(signal.SIGALRM, handler)
        sys.unraisablehook = tell
        if seconds_left:
            seconds_left = max(seconds_left - (_monotonic() - started), 0.001)
            set_timer(signal.ITIMER_REAL, seconds_left, interval)


def _in_thread(function, seconds):
    """The same without signals: outside the main thread, and on Windows."""
    outcome = {}

    def run():
        try:
            outcome["value"] = function()
        except BaseException as error:  # noqa: BLE001 - raised again in the calling thread
            outcome["error"] = error

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    thread.join(seconds)
    ident = ctypes.c_ulong(thread.ident or 0)  # it has begun: it has a number
    for _ in range(20):
        if not thread.is_alive():
            break
        ctypes.pythonapi.PyThreadState_SetAsyncExc(ident, ctypes.py_object(TimeUp))
        thread.join(_REPEAT)
    if thread.is_alive():
        raise TimeUp("stuck")
    if "error" in outcome:
        raise outcome["error"]
    return outcome["value"]


def _closest(error, wanted):
    """The existing name that is most like the one that was not found; "" if none is."""
    names = []
    if isinstance(error, AttributeError) and wanted:
        names = dir(error.obj)
    elif isinstance(error, NameError) and wanted:
        frame = list(traceback.walk_tb(error.__traceback__))[-1][0]
        owner = frame.f_locals.get("self")
        parts = (part for kind in type(owner).__mro__ for part in vars(kind).values())
        own_codes = [part.__code__ for part in parts if getattr(part, "__globals__", None) is frame.f_globals]
        if wanted in dir(owner) or any(wanted in code.co_varnames for code in own_codes):
            return f"self.{wanted}"
        names = [*frame.f_locals, *frame.f_globals, *keyword.kwlist]  # retrun (x) is a call
    plain = {name.lower(): name for name in names if not name.startswith("_")}
    close = difflib.get_close_matches(wanted.lower(), plain, n=1, cutoff=0.78) if plain else []
    closest = plain[close[0]] if close else ""
    module = getattr(getattr(error, "obj", None), "__name__", "").replace("numpy", "np")
    return f"{module}.{closest}" if closest and module else closest


def _own_line(error, function):
    """The innermost line of the learner's own code, `line 3: return a / 0`; "" if it is not known."""
    namespace, code = globals_of(function), code_of(function)
    frames = traceback.walk_tb(error.__traceback__)
    own_frames = [(frame, line) for frame, line in frames if frame.f_globals is namespace]
    in_file = [own for own in own_frames if code and own[0].f_code.co_filename == code.co_filename]
    own_frames = in_file or own_frames
    if isinstance(error, SyntaxError) or not own_frames:
        return ""
    frame, line = own_frames[-1]
    source = linecache.getline(frame.f_code.co_filename, line, frame.f_globals).strip()[:_MOST_OUTPUT]
    return f"line {line}: {source}" if source else f"line {line}"


def functions_of(answer):
    """The Python functions of an answer, {name: function}: itself, or the methods of a class.

    A class has those of its bases, too, if they are of the same module: other bases are no answer. It is
    empty for a built-in.
    """
    found = {"": getattr(answer, "__func__", answer)}
    if isinstance(answer, type):
        own_bases = [base for base in reversed(answer.__mro__) if base.__module__ == answer.__module__]
        members = {name: value for base in own_bases for name, value in vars(base).items()}
        # Behind a static method, a class method or a property there is a function.
        found = {
            name: getattr(value, "__func__", None) or getattr(value, "fget", None) or value
            for name, value in members.items()
        }
    return {name: value for name, value in found.items() if isinstance(value, types.FunctionType)}


def codes_of(answer):
    """The code objects of an answer, {name: code}, see `functions_of`."""
    return {name: function.__code__ for name, function in functions_of(answer).items()}


def cells_of(answer):
    """The sources of the cells that define the functions of an answer, {name of the file: source}."""
    files = dict.fromkeys(code.co_filename for code in codes_of(answer).values())
    return {file: "".join(linecache.getlines(file)) for file in files}


def code_of(function):
    """The code object behind a Python function, or None (a built-in, a class)."""
    return codes_of(function).get("")


def globals_of(answer):
    """The namespace in which an answer was defined; {} if it is not known."""
    return next((function.__globals__ for function in functions_of(answer).values()), {})


def source_of(answer):
    """The source of a function or class, "" if it is not known.

    `inspect` finds no class of a notebook, reads a long literal for seconds, and from Python 3.12 on raises
    another error for each text that it cannot read: it is asked for lambdas only.
    """
    own = f"{answer.__qualname__}." if isinstance(answer, type) else ""  # not a method of its bases
    code = next((code for code in codes_of(answer).values() if code.co_qualname.startswith(own)), None)
    text = "".join(linecache.getlines(code.co_filename)) if code else ""
    try:
        node = _definition_in(text, code.co_firstlineno, answer) if code and text else None
        if node:
            lines = text.split("\n")[_first_line(node) - 1 : node.end_lineno]
            return textwrap.dedent("\n".join([*lines, ""]))
        return "" if isinstance(answer, type) else textwrap.dedent(inspect.getsource(answer))
    except (OSError, TypeError, ValueError, LookupError, SyntaxError, RecursionError, tokenize.TokenError):
        return ""


def _definition_in(text, line, answer):
    """The definition of a function that begins on a line of a text, or of a class that contains it."""
    kind = ast.ClassDef if isinstance(answer, type) else (ast.FunctionDef, ast.AsyncFunctionDef)
    for node in _definitions_in(text):
        last = node.end_lineno if isinstance(node, ast.ClassDef) else _first_line(node)
        if isinstance(node, kind) and _first_line(node) <= line <= last:
            return node
    return None


def _first_line(definition):
    return min([definition.lineno, *(decorator.lineno for decorator in definition.decorator_list)])


@functools.lru_cache(maxsize=4)
def _definitions_in(text):
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
    return [node for node in ast.walk(ast.parse(text)) if isinstance(node, kinds)]
