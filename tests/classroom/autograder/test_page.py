"""What a page's own cells do, honest or not, costs the checks nothing: each is beside right answers."""

from unittest.mock import patch

import pytest
from attacks import LESSON, SHORT, page_with
from nbclassroom.autograder.nbval_plugin import PageKernels
from nbclassroom.autograder.pool import autograde
from nbclassroom.autograder.sandbox import fork_server_client
from nbclassroom.autograder.sandbox.fork_server_client import ForkedKernel, KernelFactory
from nbclassroom.exercises import page_run
from nbclassroom.exercises.page import page_of

pytestmark = pytest.mark.sandbox
OWN_CELLS = {
    "a copy of the process goes on": "import os\nchild = os.fork()\nx = 1",
    "a thread": "import threading, time\nthreading.Thread(target=time.sleep, args=(9,), daemon=True).start()",
    "a pool of threads": "from concurrent.futures import ThreadPoolExecutor\n"
    "pool = ThreadPoolExecutor(2)\nprint(list(pool.map(abs, range(4))))",
    "a process": "import subprocess\nsleeping = subprocess.Popen(['sleep', '30'])",
    "it ends the process": "import os\nos._exit(3)",
    "it fails": "1 / 0\nraise KeyboardInterrupt",
    "it leaves Python": "import sys\nsys.exit()\nquit()",
    "it prints much": "print('x' * 100_000_000)",
    "it changes the folder": "import os\nos.chdir('/')",
    "it plots": "import matplotlib.pyplot as plt\nplt.plot([1, 2])\nplt.show()",
    "it awaits": "import asyncio\nawait asyncio.sleep(0.01)",
    "seeds and print options": "np.random.seed(3)\nnp.set_printoptions(precision=1)",
    "it is not Python": "def f(:\n",
}


def test_own_cells_cost_the_checks_nothing(key, right):
    pages = [(name, LESSON, page_with(key, own, right)) for name, own in OWN_CELLS.items()]
    points = {result.name: result.points for result in autograde(pages, key, workers=2)}
    assert points == dict.fromkeys(OWN_CELLS, 10)


def test_a_key_has_the_cells_as_handed_out_and_kernels_find_them_compiled(key, monkeypatch):
    page_run.compiled("x = 1")
    monkeypatch.setattr(page_run, "_compile", None)
    names: dict = {}
    cell = {"kind": "own", "source": "x = 1", "exercise": "", "file": ""}
    page_run.PageRun({"cells": [cell], "left_out": []}, names).run_to(1)
    assert names["x"] == 1 and any("check(" in source for source in key.lessons[LESSON].code)


def test_a_statement_that_cannot_be_stopped_is_left_out_of_a_second_run(key, right):
    own = "for _ in iter(int, 1):\n    try:\n        while True: pass\n    except BaseException: pass\nx = 2"
    exercise = key.lessons[LESSON].exercises[0]
    with patch.object(fork_server_client, "_STATEMENT_SECONDS", 0.5), KernelFactory(limits=SHORT) as factory:
        kernels = PageKernels(page_with(key, own, right), factory)
        process, answer = kernels.open_check(exercise, 1.0)
        assert (answer.ended, answer.error) == ("", ("", ""))
        assert process.run("assert x == 2").error == ("", "")
        process.stop()
        kernels.close()


def test_a_kernel_that_somebody_else_ends_costs_no_statement(key, right):
    exercise, run_page, ends = (
        key.lessons[LESSON].exercises[0],
        ForkedKernel.run_page,
        [(0, 0), (1, 0), (1, 0)],
    )

    def end_first(kernel, place):
        run = run_page(kernel, place)
        if ends:
            run.ended, run.place = "crashed", ends.pop(0)
        return run

    with patch.object(ForkedKernel, "run_page", end_first), KernelFactory(limits=SHORT) as factory:
        kernels = PageKernels(page_with(key, "x = 2", right), factory)
        process, _ = kernels.open_check(exercise, 1.0)
        assert process.run("assert x == 2").error == ("", "")
        assert kernels._skip == [(1, 0)] and not ends  # it ended a process twice
        process.stop()
        kernels.close()


def test_a_name_whose_statement_failed_raises_where_it_is_used(key, right):
    uses = "TABLE = missing + [1]\ndef mean(values, table=TABLE):\n    return sum(values) / len(table)"
    answers = right | {"attacked-mean": uses}
    (result,) = autograde([("one", LESSON, page_of(answers, key.lessons[LESSON]))], key, workers=1)
    double, mean = result.exercises
    assert (double.points, mean.points) == (3, 0)
    assert mean.message == "a statement in its cell fails: NameError: name 'missing' is not defined"
    assert mean.cases[0].message.startswith(
        "NameError: TABLE is not there, because the statement that defines it fails (NameError: name"
    )


def test_a_cell_below_runs_only_for_a_name_that_is_missing(key, right):
    lesson = key.lessons[LESSON]
    page = page_of(
        right | {"attacked-mean": "def mean(values):\n    return total(values) / len(values)"}, lesson
    )
    cells = ["def total(values):\n    return sum(values)", "def double(pixels):\n    return pixels"]
    page["cells"] += [{"kind": "own", "source": cell, "exercise": "", "file": ""} for cell in cells]
    (result,) = autograde([("one", LESSON, page)], key, workers=1)
    assert [exercise.points for exercise in result.exercises] == [3, 7]
