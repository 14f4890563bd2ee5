"""Run a page (see `page`) from its top, statement by statement: each under a limit, each failing alone.

What a statement would have bound, had it not failed, raises its error when it is used. The statements that a
check needs to have run are those above it; those below it run if a name is missing.
"""

import __future__

import ast
import asyncio
import builtins
import contextlib
import linecache
import os
import sys
import time
import zlib
from collections import deque
from functools import lru_cache
from pathlib import Path

from . import running
from .cell_syntax import UNPARSABLE, names_in, plain_python

STATEMENT_SECONDS = 5.0  # that one statement may take
# Of all cells of a kind together.
TOGETHER_SECONDS = {"given": 20.0, "lesson": 10.0, "own": 10.0, "answer": 20.0}
# Annotations are not computed: they cost nobody a point.
_FLAGS = ast.PyCF_ALLOW_TOP_LEVEL_AWAIT | __future__.annotations.compiler_flag
_KNOWN = ("RefusedModule", "NotGradedError")  # errors of ours, which keep their class
# Looked up before any code of a learner's runs.
_process, _end_process, _monotonic = os.getpid, os._exit, time.monotonic


_PREPARED: dict[str, list] = {}  # {source of a cell: what _compiled gives}


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
    __hash__ = object.__hash__


_OPERATORS = """
    __call__ __iter__ __next__ __len__ __bool__ __index__ __int__ __float__ __contains__ __getitem__
    __setitem__ __setattr__ __enter__ __exit__ __format__ __array__ __array_ufunc__ __eq__ __ne__ __lt__
    __le__ __gt__ __ge__ __neg__ __pos__ __invert__ __abs__ __add__ __radd__ __sub__ __rsub__ __mul__
    __rmul__ __truediv__ __rtruediv__ __floordiv__ __rfloordiv__ __mod__ __rmod__ __pow__ __rpow__
    __matmul__ __rmatmul__ __and__ __rand__ __or__ __ror__ __xor__ __rxor__ __lshift__ __rlshift__
    __rshift__ __rrshift__
"""  # Python looks these up in the class
for _name in _OPERATORS.split():
    setattr(Missing, _name, Missing._refuse)


class PageRun:
    """A page (see `page`) that runs in a namespace, that of the module __main__.

    `skip` are places, [number of a cell, number of a statement], that ended the process in an earlier run;
    `tell` is called with the two numbers before each statement.
    """

    def __init__(self, page, names, skip=(), tell=lambda cell, statement: None):
        self._cells, self._names, self._tell = page["cells"], names, tell
        self._skip = {tuple(place) for place in skip}
        self.errors = []  # of statements: (number of the cell, type and text of the exception)
        self._seconds = dict.fromkeys(TOGETHER_SECONDS, 0.0)
        left_out = {tuple(place) for place in page["left_out"]}
        steps = [step for number, cell in enumerate(self._cells) for step in self._steps_of(number, cell)]
        self._steps = deque(step for step in steps if step[0] not in left_out)
        # After the first cell that uses asyncio, an event loop is running, as in JupyterLab.
        self._process, self._loop = _process(), None
        self.uses_loop = any("async" in cell["source"] or "await" in cell["source"] for cell in self._cells)

    def _steps_of(self, number, cell):
        """[(place, statement), ...] of a cell, or None for the file that it writes."""
        if cell["file"]:
            return [((number, 0), None)]
        try:
            statements = _PREPARED.get(cell["source"]) or _compiled(cell["source"], f"<cell {number + 1}>")
        except UNPARSABLE as error:
            self.errors.append((number, type(error).__name__, str(error)))
            return []
        return [((number, position), statement) for position, statement in enumerate(statements)]

    def adopt_process(self):
        """Go on in this process, a fork of the one that has run the page until now."""
        self._process, self._loop = _process(), None

    def run_to(self, place):
        """Run on, as far as a place: [number of a cell, number of a statement]."""
        while self._steps and self._steps[0][0] < tuple(place):
            self._run(*self._steps.popleft())

    def run_below(self, is_found):
        """Run the cells below, until a name is there."""
        while self._steps and not is_found():
            self.run_to((self._steps[0][0][0] + 1, 0))

    def run_beside(self, source):
        """Run a source that is no part of the page, such as a check; the exception that ended it, or None."""
        return _error_of(
            lambda: self._evaluate(compile(source, "<check>", "exec", _FLAGS, dont_inherit=True))
        )

    def _run(self, place, code):
        cell = self._cells[place[0]]
        if code is None:
            _write(cell)
            return
        kind = "answer" if cell["exercise"] else cell["kind"]
        began = _monotonic()
        error = code if isinstance(code, BaseException) else None
        if error is not None:  # Python does not compile it
            pass
        elif place in self._skip:
            error = RuntimeError("it ended the process, or did not end in time")
        elif self._seconds[kind] > TOGETHER_SECONDS[kind]:
            error = TimeoutError("the cells above took all the time that they may take")
        else:
            self._tell(*place)
            error = _error_of(lambda: running.call_within(lambda: self._evaluate(code), STATEMENT_SECONDS))
        if _process() != self._process:
            _end_process(0)  # a copy of this process, which the learner's code made
        self._seconds[kind] += _monotonic() - began
        if error is not None:
            self._note(place[0], code, error)

    def _evaluate(self, code):
        if not self.uses_loop:
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
        binds = set() if error is code else _binds(code)
        for bound in binds - {"*"} - self._names.keys() - vars(builtins).keys():
            if name not in _KNOWN:
                why = f"{name}: {text}" if text else name
                said = f"{bound} is not there, because the statement that defines it fails ({why[:300]})"
                error = NameError(said, name=bound)
            self._names[bound] = Missing(error)


def prepare(sources):
    """Compile cells that pages will have, so that forks of this process find them compiled."""
    for source in map(plain_python, sources):
        with contextlib.suppress(*UNPARSABLE):
            _PREPARED[source] = _compiled(source)
            for code in _PREPARED[source]:
                _binds(code)


def _compiled(source, name="<cell>"):
    """The code of each statement of a cell, or why Python does not compile it; `name` is for other errors."""
    file = f"<cell {zlib.crc32(source.encode('utf-8', 'replace'))}>"  # the same in each page
    linecache.cache[file] = (len(source), None, source.splitlines(keepends=True), file)
    return [_code_of(node, file) for node in ast.parse(source, name).body]


def _code_of(statement, file):
    try:
        return compile(ast.Module([statement], []), file, "exec", _FLAGS, dont_inherit=True)
    except UNPARSABLE as error:
        return error


@lru_cache(maxsize=10_000)
def _binds(code):
    return frozenset(names_in(code).binds)


def _error_of(function):
    """The exception that ends a function, or None."""
    try:
        function()
    except running.TimeUp:
        return TimeoutError("it did not end in time")
    except BaseException as error:  # noqa: BLE001 - the learner's code may raise anything
        return error
    return None


def _write(cell):
    """Write the file of a cell, under its name alone where its path leads elsewhere."""
    path = Path(cell["file"])
    if path.is_absolute() or ".." in path.parts:
        path = Path(path.name)
    with contextlib.suppress(OSError, UnicodeError):
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open(cell["mode"], encoding="utf-8") as file:
            file.write(f"{cell['source']}\n")
        if "" not in sys.path:
            sys.path.append("")


def is_missing(value):
    """Whether a value stands for a name whose statement failed."""
    return type(value) is Missing
