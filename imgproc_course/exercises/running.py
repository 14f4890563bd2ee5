"""Call a function that somebody else wrote: on copies, within a time limit, whatever it does.

The one place in the room where `except Exception` is right.
"""

import contextlib
import copy
import ctypes
import io
import linecache
import re
import signal
import threading
import time
import traceback
import types
import warnings
from dataclasses import dataclass

from imgproc_course.exercises.canonical import canonical
from imgproc_course.exercises.comparison import compare

_PRINTED = 2_000  # characters of what the function printed that are kept
_ADDRESS = re.compile(r"0x[0-9a-fA-F]{6,}")
_REPEAT = 0.1  # seconds: an alarm swallowed by a bare `except:` rings again


class TimeUp(BaseException):
    """Raised inside the function when its time is over; no `except Exception` of its own catches it."""


@dataclass(frozen=True)
class CallResult:
    """What one call did.

    value      canonical form of what came back, None where nothing did
    error      type name of the exception, "" for none; message and line (the learner's own, with its number)
               beside it
    timed_out  the time limit ended the call; stuck: it could not be ended
    changed    names of the arguments that the function changed
    printed, warned   what it printed; the first warning
    """

    value: dict | None = None
    error: str = ""
    message: str = ""
    line: str = ""
    timed_out: bool = False
    stuck: bool = False
    changed: tuple = ()
    printed: str = ""
    warned: str = ""

    @property
    def finished(self):
        return not self.error and not self.timed_out

    def like(self, other, tolerance):
        """Whether two calls did the same, so that one is the other's mistake."""
        if (self.error, self.timed_out, self.changed) != (other.error, other.timed_out, other.changed):
            return False
        return not self.finished or compare(other.value, self.value, tolerance) is None


def call(function, arguments, names, time_limit):
    """Call a function on copies of its arguments, and tell what it did.

    Parameters
    ----------
    function : callable of the learner's
    arguments : tuple; never changed
    names : sequence of str, the arguments' names
    time_limit : float, seconds

    Returns
    -------
    CallResult
    """
    copies = copy.deepcopy(arguments)
    before = [canonical(value, limit=None) for value in copies]
    printed = _Printed()
    told = {}
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            try:
                told["value"] = canonical(_within(lambda: function(*copies), time_limit), limit=None)
            except TimeUp as ended:
                told = {"timed_out": True, "stuck": bool(ended.args)}
            except (Exception, SystemExit) as error:  # noqa: BLE001 - the learner's function may raise anything
                told = {
                    "error": type(error).__name__,
                    "message": _message(error),
                    "line": _own_line(error, function),
                }
    if not told.get("stuck"):
        pairs = zip(names, before, copies, strict=True)
        told["changed"] = tuple(name for name, old, now in pairs if old != canonical(now, limit=None))
    return CallResult(printed=printed.getvalue(), warned=str(warned[0].message) if warned else "", **told)


class _Printed(io.StringIO):
    """Keeps the first part of what is printed: a loop that prints must not fill the memory."""

    def write(self, text):
        room = _PRINTED - self.tell()
        if room > 0:
            super().write(text[:room])
        return len(text)


def _within(function, seconds):
    if hasattr(signal, "setitimer") and threading.current_thread() is threading.main_thread():
        return _with_alarm(function, seconds)
    return _in_thread(function, seconds)


def _with_alarm(function, seconds):
    armed = True

    def ring(_signal, _frame):
        if armed:
            raise TimeUp

    started = time.monotonic()
    handler = signal.signal(signal.SIGALRM, ring)
    # Somebody else may be using the alarm (pytest-timeout does): it gets the rest of its time back.
    left, interval = signal.setitimer(signal.ITIMER_REAL, seconds, _REPEAT)
    try:
        try:
            return function()
        finally:
            armed = False
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, handler)
        if left:
            signal.setitimer(signal.ITIMER_REAL, max(left - (time.monotonic() - started), 0.001), interval)


def _in_thread(function, seconds):
    """The same without signals: outside the main thread, and on Windows."""
    done = {}

    def run():
        try:
            done["value"] = function()
        except BaseException as error:  # noqa: BLE001 - carried to the caller
            done["error"] = error

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    thread.join(seconds)
    for _ in range(20):
        if not thread.is_alive():
            break
        ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident), ctypes.py_object(TimeUp))
        thread.join(_REPEAT)
    if thread.is_alive():
        raise TimeUp("stuck")
    if "error" in done:
        raise done["error"]
    return done["value"]


def _message(error):
    try:
        text = str(error)
    except Exception:  # noqa: BLE001 - an exception class of the learner's
        text = ""
    return _ADDRESS.sub("0x…", text)[:500]


def _own_line(error, function):
    """The innermost line of the learner's own code, `line 3: return a / 0`; "" where it is not known."""
    space = getattr(function, "__globals__", None)
    own = [
        (frame, line) for frame, line in traceback.walk_tb(error.__traceback__) if frame.f_globals is space
    ]
    if isinstance(error, SyntaxError) or not own:
        return ""
    frame, line = own[-1]
    source = linecache.getline(frame.f_code.co_filename, line, frame.f_globals).strip()
    return f"line {line}: {source}" if source else f"line {line}"


def code_of(function):
    """The code object behind a Python function, or None (a built-in, a class)."""
    function = getattr(function, "__func__", function)
    return function.__code__ if isinstance(function, types.FunctionType) else None
