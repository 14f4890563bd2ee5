"""An IPython shell without ZMQ: it reads cells from a socket and writes messages, as lines of JSON.

In:  {"n": 3, "code": "..."}; a check cell has also "case": {...}, its inputs; or
     {"n": 3, "cells": [{"code": "...", "apart": true}]}; if "apart", a statement that fails ends only itself
Out: {"n": 3, "type": "stream" | "display_data" | "execute_result" | "update_display_data" | "clear_output" |
      "error" | "idle", "content": {...}}, with the content of Jupyter's messages
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
from traitlets.config import Config

from imgproc_course.classroom.autograder.sandbox.inside.answer_mime import MIME

_BUFFER_SIZE = 8_192  # characters of a stream that are collected before they are sent
_MOST_OUTPUT = 1_000_000  # bytes of what a cell prints and draws; nobody reads more, and more costs nothing


_OUTPUTS = ("stream", "display_data", "update_display_data", "execute_result")


class MessageWriter:
    """Writes each message as one line to the kernel's socket."""

    def __init__(self):
        self.descriptor = -1
        self.cell = 0
        self.output_left = 0
        self._lock = threading.RLock()

    def send(self, kind, **content):
        text = json.dumps({"n": self.cell, "type": kind, "content": content}, default=str) + "\n"
        data = memoryview(text.encode("ascii"))
        if kind in _OUTPUTS and MIME not in content.get("data", ()):
            self.output_left -= len(data)
            if self.output_left < 0:
                return
        with self._lock:
            while data:
                data = data[os.write(self.descriptor, data) :]


WRITER = MessageWriter()


class OutputStream:
    """sys.stdout and sys.stderr of a cell."""

    encoding, errors, newlines, closed = "utf-8", "replace", None, False

    def __init__(self, name):
        self.name = name
        self._texts, self._length = [], 0

    def write(self, text):
        if not isinstance(text, str):
            raise TypeError(f"write() argument must be str, not {type(text).__name__}")
        self._texts.append(text)
        self._length += len(text)
        if self._length > _BUFFER_SIZE:
            self.flush()
        return len(text)

    def writelines(self, lines):
        for line in lines:
            self.write(line)

    def flush(self):
        text, self._texts, self._length = "".join(self._texts), [], 0
        if text:
            WRITER.send("stream", name=self.name, text=text)

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


class MessagePublisher(DisplayPublisher):
    """Sends rich display as messages."""

    def publish(self, data, metadata=None, *, transient=None, update=False, **_ignored):
        _flush()
        kind = "update_display_data" if update else "display_data"
        WRITER.send(kind, data=data, metadata=metadata or {}, transient=transient or {})

    def clear_output(self, wait=False):
        _flush()
        WRITER.send("clear_output", wait=bool(wait))


class MessageDisplayHook(DisplayHook):
    """Sends the value of a cell's last expression as a message."""

    def write_output_prompt(self):
        pass

    def write_format_data(self, format_dict, md_dict=None):
        _flush()
        WRITER.send(
            "execute_result", data=format_dict, metadata=md_dict or {}, execution_count=self.prompt_count
        )

    def finish_displayhook(self):
        self._is_active = False


# Without one of these characters there is no magic, no shell command and no question for help.
_ESCAPES = re.compile(r"[%!?]|^[ \t\f]*[,;/]", re.M)


class FastTransformer(TransformerManager):
    """IPython's transformer, but faster: it searches for magics only in cells that are not plain Python.

    Magics and shell commands are never valid Python, and IPython splits every cell into tokens to find them.
    """

    def do_token_transforms(self, lines):
        source = "".join(lines)
        if not _ESCAPES.search(source) or _is_python(source):
            return lines
        return super().do_token_transforms(lines)


def _is_python(source):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # running the cell shows them
        try:
            ast.parse(source)
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            return False
    return True


class CellShell(InteractiveShell):
    """The shell that runs cells: it does what ipykernel's shell does, without sockets."""

    displayhook_class = Type(MessageDisplayHook)
    display_pub_class = Type(MessagePublisher)
    input_transformer_manager = Instance(FastTransformer, ())
    system = InteractiveShell.system_piped
    readline_use = False
    statements_apart = False  # whether a statement that fails ends only itself, and not its cell

    def init_history(self):
        super().init_history()
        self.history_manager.enabled = False

    def should_run_async(self, raw_cell, **options):
        # IPython compiles the cell to find out; for most cells a look at the text is enough.
        return ("await" in raw_cell or "async" in raw_cell) and super().should_run_async(raw_cell, **options)

    async def run_ast_nodes(self, nodelist, cell_name, **options):
        if not self.statements_apart:
            return await super().run_ast_nodes(nodelist, cell_name, **options)
        has_failed = False
        for node in nodelist:
            has_failed |= bool(await super().run_ast_nodes([node], cell_name, **options))
        return has_failed

    def enable_gui(self, gui=None):
        pass

    def ask_exit(self):
        pass

    def init_virtualenv(self):
        pass

    def showtraceback(self, exc_tuple=None, *_arguments, **_options):
        """Send the exception without its traceback: nobody reads it, and IPython takes long to make it."""
        etype, evalue, _ = self._get_exc_info(exc_tuple)
        _flush()
        WRITER.send("error", ename=etype.__name__, evalue=_text_of(evalue), traceback=[])

    def showsyntaxerror(self, *_arguments, **_options):
        self.showtraceback()


def _text_of(error):
    """The exception's text; a learner's exception class may have a __str__ that fails."""
    try:
        return str(error)
    except (ArithmeticError, AttributeError, LookupError, RuntimeError, TypeError, ValueError):
        return ""


def make_shell():
    """The one shell of the fork server; each fork continues with its copy."""
    # A database would be one open file that all forks share.
    shell = CellShell.instance(config=Config({"HistoryManager": {"enabled": False, "hist_file": ":memory:"}}))
    shell.colors = "nocolor"
    shell.user_ns["__name__"] = "__main__"
    return shell


def serve(shell, descriptor, deliver):
    """Run cells from a connected socket until it is closed; `deliver` takes the inputs of each check."""
    WRITER.descriptor = descriptor
    sys.stdout, sys.stderr = OutputStream("stdout"), OutputStream("stderr")
    runner = _CellRunner(shell)
    for request in _requests(descriptor):
        WRITER.cell, WRITER.output_left = request["n"], _MOST_OUTPUT
        if "case" in request:
            deliver(request["case"])
        error = None
        for cell in request.get("cells") or [{"code": request.get("code"), "apart": False}]:
            if cell["code"]:
                shell.statements_apart = cell["apart"]
                error_of_cell = runner.run(cell["code"])
                error = error_of_cell if error is None else error
                _flush()
        name = "" if error is None else type(error).__name__
        WRITER.send("idle", ename=name, evalue="" if error is None else _text_of(error))


class _CellRunner:
    """Runs cells. After the first cell that uses asyncio, an event loop is running, as in JupyterLab."""

    def __init__(self, shell):
        self._shell, self._loop = shell, None

    def run(self, code):
        """Run a cell; returns the exception that ended it, or None."""
        result = self._run(code)
        return result.error_before_exec or result.error_in_exec

    def _run(self, code):
        if self._loop is None and "async" not in code and "await" not in code:
            return self._shell.run_cell(code, store_history=False)
        if self._loop is None:
            self._loop = asyncio.new_event_loop()
            asyncio.set_event_loop(self._loop)
            self._shell.loop_runner = self._loop.run_until_complete
        if re.search(r"\b(await|async)\b", code):
            return self._shell.run_cell(code, store_history=False)
        return self._loop.run_until_complete(self._run_in_loop(code))

    async def _run_in_loop(self, code):
        return self._shell.run_cell(code, store_history=False)


def _requests(descriptor):
    buffer = b""
    while True:
        *lines, buffer = buffer.split(b"\n")
        yield from (json.loads(line) for line in lines)
        data = os.read(descriptor, 1 << 16)
        if not data:
            return
        buffer += data
        while b"\n" not in data:
            data = os.read(descriptor, 1 << 20)
            if not data:
                return
            buffer += data
