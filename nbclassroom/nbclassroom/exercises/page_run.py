"""Run a page (see `page`) from its top, statement by statement: each under a limit, each failing alone.

What a statement would have bound, had it not failed, raises its error when it is used. The statements that a
check needs to have run are those above it; those below it run if a name is missing.
"""

import __future__

import ast
import asyncio
import builtins
import linecache
import math
import os
import sys
import time
import zlib
from collections import defaultdict, deque
from functools import lru_cache, partial
from pathlib import Path
from types import CodeType

import numpy as np

from . import running
from .cell_syntax import names_in

STATEMENT_SECONDS = 5.0  # that one statement may take
TOGETHER_SECONDS = {"given": 20.0, "own": 10.0, "answer": 20.0}  # that all cells of a kind may take
# Annotations are not computed: they cost nobody a point.
_FLAGS = ast.PyCF_ALLOW_TOP_LEVEL_AWAIT | __future__.annotations.compiler_flag
_compile = partial(compile, mode="exec", flags=_FLAGS, dont_inherit=True)
# Looked up before any code of a learner's runs.
_process, _end_process, _monotonic = os.getpid, os._exit, time.monotonic


class Missing:
    """Stands for a name whose statement failed: using it raises."""

    __module__, __qualname__ = "notebook", "NameWhoseStatementFailed"  # what messages say of it

    def __init__(self, error):
        object.__setattr__(self, "_error", error)

    def _refuse(self, *_arguments, **_options):
        raise object.__getattribute__(self, "_error")

    def __getattribute__(self, name):
        if name == "__wrapped__":  # doctest asks every name of a module for it
            raise AttributeError(name)
        return Missing if name == "__class__" else object.__getattribute__(self, "_refuse")()

    __repr__ = __str__ = lambda self: "<missing>"


# Python looks up in the class what operators, calls and NumPy use.
_SPECIAL = {*dir(int), *dir(np.ndarray), "__call__", "__next__", "__enter__", "__exit__"}
for _name in _SPECIAL - {*vars(Missing), "__class__", "__hash__", "__new__"}:
    setattr(Missing, _name, Missing._refuse)


class PageRun:
    """A page (see `page`) that runs in a namespace, that of the module __main__.

    `skip` are places, [number of a cell, number of a statement], that ended the process in an earlier run;
    `tell` is called with the two numbers before each statement.
    """

    def __init__(self, page, names, skip=(), tell=lambda cell, statement: None):
        cells, self._names, self._tell = page["cells"], names, tell
        self._skip = {tuple(place) for place in skip}
        self.errors = []  # of statements: (number of the cell, type and text of the exception)
        self._seconds: dict = defaultdict(float)  # {kind of cells: what they have taken}
        self._left_out = {tuple(place) for place in page["left_out"]}
        self._waiting = deque(enumerate(cells))
        # After the first cell that uses asyncio, an event loop is running, as in JupyterLab.
        self._uses_loop = any("async" in cell["source"] or "await" in cell["source"] for cell in cells)
        self.adopt_process()

    def adopt_process(self):
        """Go on in this process, a fork of the one that has run the page until now."""
        self._process, self._loop = _process(), None

    def run_to(self, number=math.inf, is_found=lambda: False):
        """Run on, as far as the cell of this number, or until what the cells below may make is there."""
        while self._waiting and self._waiting[0][0] < number and not is_found():
            self._run(*self._waiting.popleft())

    def run_beside(self, source):
        """Run a source that is no part of the page, such as a check; the exception that ended it, or None."""
        return _attempt(lambda: self._evaluate(_compile(source, "<check>")))

    def _run(self, number, cell):
        """Run a cell, each of its statements alone."""
        kind = "answer" if cell["exercise"] else cell["kind"]
        for position, code in enumerate([cell] if cell["file"] else compiled(cell["source"])):
            if (number, position) in self._left_out:
                continue
            began = _monotonic()
            error = _attempt(self._try, (number, position), code, kind)
            if _process() != self._process:
                _end_process(0)  # a copy of this process, which the learner's code made
            self._seconds[kind] += _monotonic() - began
            if error is not None:
                self._note(number, code, error)

    def _try(self, place, code, kind):
        """Run a statement of a cell, if there is time left for cells of its kind."""
        if isinstance(code, Exception):  # Python does not compile it
            raise code
        if place in self._skip:
            raise RuntimeError("it ended the process, or did not end in time")
        if self._seconds[kind] > TOGETHER_SECONDS[kind]:
            raise TimeoutError("the cells above took all the time that they may take")
        self._tell(*place)
        run = _write if isinstance(code, dict) else self._evaluate
        running.call_within(lambda: run(code), STATEMENT_SECONDS)

    def _evaluate(self, code):
        if not self._uses_loop:
            return eval(code, self._names)
        self._loop = self._loop or asyncio.new_event_loop()
        return self._loop.run_until_complete(self._evaluate_in_loop(code))

    async def _evaluate_in_loop(self, code):
        value = eval(code, self._names)
        return await value if asyncio.iscoroutine(value) else value

    def _note(self, number, code, error):
        """Note the error of a statement; the names that it has not bound stand for it."""
        name = running.error_name(error)
        text = running.attempt(lambda: str(error), "")[:2_000]
        self.errors.append((number, name, text))
        binds = names_in(code).binds if isinstance(code, CodeType) else set()
        for bound in binds - {"*"} - self._names.keys() - vars(builtins).keys():
            if name not in ("RefusedModule", "NotGradedError"):  # ours keep their class
                why = f"{name}: {text}" if text else name
                said = f"{bound} is not there, because the statement that defines it fails ({why[:300]})"
                error = NameError(said, name=bound)
            self._names[bound] = Missing(error)


@lru_cache(maxsize=10_000)
def compiled(source):
    """The code of each statement of a cell, kept for forks, or the error in its place."""
    file = f"<cell {zlib.crc32(source.encode('utf-8', 'replace'))}>"  # the same in each page
    linecache.cache[file] = (len(source), None, source.splitlines(keepends=True), file)
    tree = _attempt(ast.parse, source, "<cell>")
    if isinstance(tree, Exception):
        return [tree]
    return [_attempt(_compile, ast.Module([node], []), file) for node in tree.body]


def _attempt(function, *arguments):
    """What a function returns, or the exception that ends it."""
    try:
        return function(*arguments)
    except running.TimeUp:
        return TimeoutError("it did not end in time")
    except BaseException as error:  # noqa: BLE001 - the learner's code may raise anything
        return error


def _write(cell):
    """Write the file of a cell, under its name alone where its path leads elsewhere."""
    path = Path(cell["file"])
    path = Path(path.name) if path.is_absolute() or ".." in path.parts else path
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open(cell["mode"], encoding="utf-8") as file:
        file.write(f"{cell['source']}\n")
    sys.path[:] = dict.fromkeys([*sys.path, ""])
