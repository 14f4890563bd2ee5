"""Cells behave as in JupyterLab."""

from functools import partial

import pytest
from nbclassroom.autograder.sandbox.bubblewrap import Limits
from nbclassroom.autograder.sandbox.fork_server_client import KernelFactory
from nbclassroom.exercises.cell_syntax import plain_python
from printed import run_printing

pytestmark = pytest.mark.sandbox


@pytest.fixture(scope="module")
def kernel():
    with KernelFactory() as kernel_factory:
        kernel = kernel_factory.start((), 60)
        yield kernel
        kernel.stop()


# Each cell imports and defines what it reads: two workers may share these cells out in any way.
ASYNC_FUNCTION = "import asyncio\nasync def g():\n    await asyncio.sleep(0.001)\n    return 5\n"
CELLS = [
    ("print('a'); print('b')", "a\nb\n", ("", "")),
    ("print(np.arange(3))", "[0 1 2]\n", ("", "")),
    ("In [1]: x = 4\n\nIn [2]: print(x)", "4\n", ("", "")),
    ("1 / 0", "", ("ZeroDivisionError", "division by zero")),
    ("raise KeyError('k')", "", ("KeyError", "'k'")),
    ("def f(:\n    pass", "", ("SyntaxError", None)),
    ("%time x = 3\nx", None, ("", "")),
    (ASYNC_FUNCTION, "", ("", "")),
    (f"{ASYNC_FUNCTION}print(await g())", "5\n", ("", "")),
    (
        # Closed, else Python warns some cells later that it was never awaited.
        "import asyncio\nlate = asyncio.sleep(0)\ntry:\n    asyncio.run(late)\nfinally:\n    late.close()",
        "",
        ("RuntimeError", "asyncio.run() cannot be called from a running event loop"),
    ),
    ("from IPython.display import HTML, display\ndisplay(HTML('<b>x</b>'))\n'last'", "", ("", "")),
    ("x = 3\nx?", None, ("", "")),
    ("%matplotlib inline\nimport matplotlib.pyplot as plt\nplt.plot([1]);\nplt.show()", None, ("", "")),
    ("print(get_ipython().__class__.__mro__[1].__name__)", "InteractiveShell\n", ("", "")),
    ("print(__name__)", "__main__\n", ("", "")),
    ("print('\\ud800', file=sys.__stdout__)", "", ("", "")),
    ("import cv2\nfrom imgproc_course.imaging import to_gray\nprint('imported')", "imported\n", ("", "")),
    ("try:\n    import scipy\nexcept ImportError:\n    print('without')", "without\n", ("", "")),
    ("from imgproc_course.display import show\nshow(np.ones((2, 2)), caption='a', alt='b')", "", ("", "")),
    ("from imgproc_course.exercises import check\ncheck('x', print)", "", ("", "")),
    ("from imgproc_course.exercises import hint, solution\nhint('x'), solution('x')", None, ("", "")),
    ("import random\nprint(random.random())", "0.8444218515250481\n", ("", "")),
    ("print(np.random.rand())", "0.5488135039273248\n", ("", "")),
]


def run_cell(kernel, code):
    """The CellRun of one cell, of a page that has no other cell."""
    cell = {"kind": "own", "source": plain_python(code), "exercise": "", "file": ""}
    kernel.open_page({"answers": {}, "cells": [cell], "checks": {}, "left_out": []}, [])
    run = kernel.run_page(1)
    run.error = run.errors[0][1:] if run.errors else ("", "")
    return run


@pytest.mark.parametrize(
    ("code", "printed", "error"), CELLS, ids=[cell[0].splitlines()[-1] for cell in CELLS]
)
def test_a_cell_does_what_it_does_in_jupyterlab(kernel, code, printed, error):
    run, told = run_printing(kernel, code, partial(run_cell, kernel))
    assert run.ended == ""
    assert run.error[0] == error[0]
    assert error[1] is None or run.error[1] == error[1]
    assert printed is None or told.replace("\r\n", "\n") == printed


def test_an_exception_is_sent_without_a_traceback_that_nobody_reads():
    with KernelFactory() as kernel_factory:
        kernel = kernel_factory.start((), 10)
        code = "import sys\nassert not {'stack_data', 'executing'} & {*sys.modules}"
        assert kernel.run("def f(:").error[0] == "SyntaxError"
        assert kernel.run("def f():\n    f()\nf()").error[0] == "RecursionError"
        assert kernel.run(code).error == ("", "")
        kernel.stop()


def test_input_is_refused_with_an_explanation(kernel):
    run = kernel.run("input('name?')")
    assert run.error[0] == "RuntimeError" and "input() waits for a person" in run.error[1]


def test_python_hashes_are_the_same_in_every_kernel():
    hashes = []
    for _ in range(2):
        with KernelFactory() as kernel_factory:
            kernel = kernel_factory.start((), 30)
            hashes.append(kernel.run("raise ValueError(hash('course'))").error)
            kernel.stop()
    assert hashes[0] == hashes[1] != ("ValueError", "")


def test_a_kernel_gets_no_more_time_than_its_limit():
    with KernelFactory(limits=Limits(grace=0.0, wall_factor=1, wall_grace=1)) as kernel_factory:
        kernel = kernel_factory.start((), 1)
        assert kernel.run("while True: pass").ended == "time"
        assert kernel.run("1").ended != ""
        kernel.stop()
        after = kernel_factory.start((), 1)
        assert after.run("1 / 0").error[0] == "ZeroDivisionError"
        after.stop()
