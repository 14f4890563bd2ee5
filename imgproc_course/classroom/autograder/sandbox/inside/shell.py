"""An IPython shell without ZMQ: it reads cells from a socket and writes messages, as lines of JSON.

In:  {"cells": ["..."]}; one that fails ends only itself. A check has also "case": {...}, its inputs
Out: {"type": "stream" | "display_data" | "error" | "idle", "content": {...}}, as Jupyter's messages. What a
     cell draws is not sent, but for what a check cell shows.
"""

import ast
import asyncio
import io
import json
import os
import re
import sys
import threading

from IPython.core.async_helpers import _pseudo_sync_runner
from IPython.core.displayhook import DisplayHook
from IPython.core.displaypub import DisplayPublisher
from IPython.core.interactiveshell import ExecutionResult, InteractiveShell
from traitlets import Type
from traitlets.config import Config

from imgproc_course.classroom.autograder.sandbox.inside.answer_mime import MIME
from imgproc_course.classroom.exercises.running import error_name

_BUFFER_SIZE = 8_192  # characters of a stream that are collected before they are sent
_MOST_PRINTED = 1_000_000  # characters that are sent of what a request prints; the rest costs nothing


class MessageWriter:
    """Writes each message as one line to the kernel's socket."""

    def __init__(self):
        self.descriptor = -1
        self.printed = 0
        self._lock = threading.RLock()

    def send(self, kind, **content):
        text = json.dumps({"type": kind, "content": content}, default=str) + "\n"
        data = memoryview(text.encode("ascii"))
        with self._lock:
            while data:
                data = data[os.write(self.descriptor, data) :]

    def send_answer(self, data):
        """Send what a check cell shows, of what a cell displays."""
        if MIME in data:
            self.send("display_data", data={MIME: data[MIME]})


WRITER = MessageWriter()


class OutputStream(io.TextIOBase):
    """sys.stdout and sys.stderr of a cell."""

    encoding, errors = "utf-8", "replace"

    def __init__(self, name):
        self.name, self._text = name, ""

    def write(self, text):
        if not isinstance(text, str):
            raise TypeError(f"write() argument must be str, not {type(text).__name__}")
        self._text += text
        if len(self._text) > _BUFFER_SIZE:
            self.flush()
        return len(text)

    def flush(self):
        text, self._text = self._text, ""
        if text and WRITER.printed < _MOST_PRINTED:
            WRITER.printed += len(text)
            WRITER.send("stream", text=text[:_MOST_PRINTED])

    def writable(self):
        return True

    def fileno(self):
        return 1 if self.name == "stdout" else 2


def flush():
    sys.stdout.flush()
    sys.stderr.flush()


class AnswerPublisher(DisplayPublisher):
    """Sends what a check cell displays."""

    def publish(self, data, metadata=None, **_ignored):
        WRITER.send_answer(data)


class AnswerDisplayHook(DisplayHook):
    """Makes the value of a cell's last expression ready to show, and sends it if it is an answer."""

    def write_output_prompt(self):
        pass

    def write_format_data(self, format_dict, md_dict=None):
        WRITER.send_answer(format_dict)


# In what parses as Python all the same: an event loop is needed, or there are prompts, or blank lines first.
_CHANGED_BY_IPYTHON = re.compile(r"await|async|^In \[\d+\]: |\A[^\S\n]*\n", re.M)


class CellShell(InteractiveShell):
    """The shell that runs cells: it does what ipykernel's shell does, without sockets."""

    displayhook_class = Type(AnswerDisplayHook)
    display_pub_class = Type(AnswerPublisher)

    def run_cell(self, raw_cell, **options):
        """Run a cell; if it is plain Python, without the search for magics and the rest of IPython's work.

        That takes most of the time of a short cell, because a fork first copies the memory that it uses.
        """
        body = plain_statements(raw_cell)
        if not body:
            return super().run_cell(raw_cell, **options)
        result = self.displayhook.exec_result = ExecutionResult(None)
        name = self.compile.cache(raw_cell, self.execution_count)
        with self.builtin_trap, self.display_trap:
            run = self.run_ast_nodes(body, name, self.ast_node_interactivity, self.compile, result)
            _pseudo_sync_runner(run)
        return result

    def enable_gui(self, gui=None):
        pass

    def ask_exit(self):
        pass

    def showtraceback(self, exc_tuple=None, *_arguments, **_options):
        """Send the exception without its traceback: nobody reads it, and IPython takes long to make it."""
        _, evalue, _ = self._get_exc_info(exc_tuple)
        flush()
        WRITER.send("error", ename=error_name(evalue), evalue=_text_of(evalue))

    def showsyntaxerror(self, *_arguments, **_options):
        self.showtraceback()


def plain_statements(source):
    """The statements of a cell that IPython runs as they stand; [] for another cell, or an empty one."""
    try:
        return [] if _CHANGED_BY_IPYTHON.search(source) else ast.parse(source).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []


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


def run_unseen(shell, cells):
    """Run cells whose output nobody reads."""
    WRITER.descriptor = os.open(os.devnull, os.O_WRONLY)
    streams = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = OutputStream("stdout"), OutputStream("stderr")
    for code in cells:
        shell.run_cell(code, store_history=False)
    sys.stdout, sys.stderr = streams
    os.close(WRITER.descriptor)


def serve(shell, requests, descriptor, deliver):
    """Run the cells of each request until there are no more; `deliver` takes the inputs of each check."""
    WRITER.descriptor = descriptor
    sys.stdout, sys.stderr = OutputStream("stdout"), OutputStream("stderr")
    runner = _CellRunner(shell)
    for request in map(json.loads, requests):
        WRITER.printed = 0
        if "case" in request:
            deliver(request["case"])
        errors = [runner.run(code) for code in request["cells"]]
        flush()
        error = next((error for error in errors if error is not None), None)
        name = "" if error is None else error_name(error)
        WRITER.send("idle", ename=name, evalue="" if error is None else _text_of(error))


class _CellRunner:
    """Runs cells. After the first cell that uses asyncio, an event loop is running, as in JupyterLab."""

    def __init__(self, shell):
        self._shell, self._loop = shell, None

    def run(self, code):
        """Run a cell; returns the exception that ended it, or None."""
        if self._loop is None and ("async" in code or "await" in code):
            self._loop = asyncio.new_event_loop()
            asyncio.set_event_loop(self._loop)
            self._shell.loop_runner = self._loop.run_until_complete
        if self._loop is None or re.search(r"\b(await|async)\b", code):
            result = self._shell.run_cell(code, store_history=False)
        else:
            result = self._loop.run_until_complete(self._run_in_loop(code))
        return result.error_before_exec or result.error_in_exec

    async def _run_in_loop(self, code):
        return self._shell.run_cell(code, store_history=False)
