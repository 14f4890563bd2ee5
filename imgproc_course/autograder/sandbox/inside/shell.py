"""An IPython shell without ZMQ: cells come in over a socket, messages go out, as lines of JSON.

In:  {"n": 3, "code": "..."}, or {"n": 3, "case": {...}}: the inputs of the next check
Out: {"n": 3, "type": "stream" | "display_data" | "execute_result" | "update_display_data" | "clear_output" |
      "error" | "idle", "content": {...}}, the content as Jupyter's messaging has it.
"""

import ast
import asyncio
import json
import os
import re
import sys
import threading
import warnings

from IPython.core.displayhook import DisplayHook
from IPython.core.displaypub import DisplayPublisher
from IPython.core.inputtransformer2 import TransformerManager
from IPython.core.interactiveshell import InteractiveShell
from traitlets import Instance, Type

_TEXT_KEPT = 8_192  # characters of a stream that are gathered before they are sent


class Line:
    """The way out: one message, one line."""

    def __init__(self):
        self.descriptor = -1
        self.cell = 0
        self._lock = threading.RLock()

    def send(self, kind, **content):
        text = json.dumps({"n": self.cell, "type": kind, "content": content}, default=str) + "\n"
        raw = memoryview(text.encode("ascii"))
        with self._lock:
            while raw:
                raw = raw[os.write(self.descriptor, raw) :]


LINE = Line()


class Stream:
    """sys.stdout and sys.stderr of a cell."""

    encoding, errors, newlines, closed = "utf-8", "replace", None, False

    def __init__(self, name):
        self.name = name
        self._kept, self._length = [], 0

    def write(self, text):
        if not isinstance(text, str):
            raise TypeError(f"write() argument must be str, not {type(text).__name__}")
        self._kept.append(text)
        self._length += len(text)
        if self._length > _TEXT_KEPT:
            self.flush()
        return len(text)

    def writelines(self, lines):
        for line in lines:
            self.write(line)

    def flush(self):
        kept, self._kept, self._length = "".join(self._kept), [], 0
        if kept:
            LINE.send("stream", name=self.name, text=kept)

    def isatty(self):
        return False

    def writable(self):
        return True

    def readable(self):
        return False

    seekable = readable

    def fileno(self):
        return 1 if self.name == "stdout" else 2


def _flush():
    sys.stdout.flush()
    sys.stderr.flush()


class Publisher(DisplayPublisher):
    """Rich display, as messages."""

    def publish(self, data, metadata=None, *, transient=None, update=False, **_ignored):
        _flush()
        kind = "update_display_data" if update else "display_data"
        LINE.send(kind, data=data, metadata=metadata or {}, transient=transient or {})

    def clear_output(self, wait=False):
        _flush()
        LINE.send("clear_output", wait=bool(wait))


class Hook(DisplayHook):
    """The value of a cell's last expression, as a message."""

    def write_output_prompt(self):
        pass

    def write_format_data(self, format_dict, md_dict=None):
        _flush()
        LINE.send(
            "execute_result", data=format_dict, metadata=md_dict or {}, execution_count=self.prompt_count
        )

    def finish_displayhook(self):
        self._is_active = False


class Translation(TransformerManager):
    """IPython's, and quicker: it looks for magics and commands only where the cell is not Python as it is.

    Neither is ever Python, and IPython takes a cell apart token by token to see that there is none.
    """

    def do_token_transforms(self, lines):
        return lines if _is_python("".join(lines)) else super().do_token_transforms(lines)


def _is_python(source):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the cell's own run tells them
        try:
            ast.parse(source)
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            return False
    return True


class Shell(InteractiveShell):
    """The shell that runs cells: what ipykernel's does, without its sockets."""

    displayhook_class = Type(Hook)
    display_pub_class = Type(Publisher)
    input_transformer_manager = Instance(Translation, ())
    system = InteractiveShell.system_piped
    readline_use = False

    def init_history(self):
        super().init_history()
        self.history_manager.enabled = False

    def should_run_async(self, raw_cell, **translated):
        # IPython compiles the cell to see it; most can be seen not to wait for anything.
        return ("await" in raw_cell or "async" in raw_cell) and super().should_run_async(
            raw_cell, **translated
        )

    def enable_gui(self, gui=None):
        pass

    def ask_exit(self):
        pass

    def init_virtualenv(self):
        pass

    def _showtraceback(self, etype, evalue, stb):
        _flush()
        LINE.send("error", ename=etype.__name__, evalue=_text_of(evalue), traceback=list(stb))


def _text_of(error):
    """An exception in words; a class of the learner's may have a __str__ that fails."""
    try:
        return str(error)
    except (ArithmeticError, AttributeError, LookupError, RuntimeError, TypeError, ValueError):
        return ""


def make_shell():
    """The one shell of the forking process; each fork goes on with its copy."""
    shell = Shell.instance()
    shell.colors = "nocolor"
    shell.user_ns["__name__"] = "__main__"
    return shell


def serve(shell, descriptor, deliver):
    """Run cells from a socket until it is closed.

    Parameters
    ----------
    shell : Shell
    descriptor : int, a connected stream socket
    deliver : function that takes the inputs of the next check
    """
    LINE.descriptor = descriptor
    sys.stdout, sys.stderr = Stream("stdout"), Stream("stderr")
    runner = _Runner(shell)
    for request in _requests(descriptor):
        LINE.cell = request["n"]
        if "case" in request:
            deliver(request["case"])
        if not request.get("code"):  # a delivery, or asked whether it is there
            LINE.send("idle", ename="", evalue="")
            continue
        result = runner.run(request["code"])
        _flush()
        error = result.error_before_exec or result.error_in_exec
        name = "" if error is None else type(error).__name__
        LINE.send("idle", ename=name, evalue="" if error is None else _text_of(error))


class _Runner:
    """Runs cells; once one of them speaks of asyncio, inside a running event loop as in JupyterLab."""

    def __init__(self, shell):
        self._shell, self._loop = shell, None

    def run(self, code):
        if self._loop is None and "async" not in code and "await" not in code:
            return self._shell.run_cell(code, store_history=False)
        if self._loop is None:
            self._loop = asyncio.new_event_loop()
            asyncio.set_event_loop(self._loop)
            self._shell.loop_runner = self._loop.run_until_complete
        if re.search(r"\b(await|async)\b", code):
            return self._shell.run_cell(code, store_history=False)
        return self._loop.run_until_complete(self._inside(code))

    async def _inside(self, code):
        return self._shell.run_cell(code, store_history=False)


def _requests(descriptor):
    kept = b""
    while True:
        *lines, kept = kept.split(b"\n")
        yield from (json.loads(line) for line in lines)
        more = os.read(descriptor, 1 << 16)
        if not more:
            return
        kept += more
        while b"\n" not in more:
            more = os.read(descriptor, 1 << 20)
            if not more:
                return
            kept += more
