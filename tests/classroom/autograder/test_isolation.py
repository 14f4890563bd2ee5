"""The checks of one exercise, one after another in one process, as in a notebook; and who ends it."""

import contextlib
from dataclasses import replace
from unittest.mock import patch

import pytest
from attacks import LESSON, SHORT
from nbclassroom.autograder.nbval_plugin import ExerciseRun, PageKernels
from nbclassroom.autograder.pool import Limits, SandboxError, autograde
from nbclassroom.autograder.sandbox.fork_server_client import ForkedKernel, KernelFactory
from nbclassroom.exercises.page import page_of
from printed import run_printing

pytestmark = pytest.mark.sandbox
MEAN = "float(np.mean(values))"
ANSWERS = {
    "works once": "done = []\ndef mean(values):\n    if done: raise RuntimeError\n    done.append(1)\n"
    f"    return {MEAN}",
    "patches numpy": f"def mean(values):\n    got = {MEAN}\n    np.mean = lambda values: 0\n    return got",
    "ends soon": "import os, threading\ndef mean(values):\n    threading.Timer(0.3, os._exit, [1]).start()\n"
    f"    return {MEAN}",
    "spoils from beside": f"import threading\ndef mean(values):\n    got = {MEAN}\n    def spoil():\n"
    "        while True:\n            np.mean = lambda values: 0\n"
    "    threading.Thread(target=spoil, daemon=True).start()\n    return got",
    "begins late": "seen = []\ndef mean(values):\n    seen.append(1)\n"
    f"    return {MEAN} if len(seen) > 1 else 0.0",
    "spins later": "import signal\ndef mean(values):\n    if len(values) > 5:\n"
    f"        signal.setitimer(signal.ITIMER_PROF, 0)\n        while True: pass\n    return {MEAN}",
    "ends later": "import os\ndef mean(values):\n    if len(values) > 5:\n        os._exit(1)\n"
    f"    return {MEAN}",
}
OUTCOMES = {
    "works once": ["passed", "raised"],
    "patches numpy": ["passed", "wrong"],
    "ends soon": ["passed", "passed"],
    "spoils from beside": ["passed", "wrong"],
    "begins late": ["wrong", "passed"],
    "spins later": ["passed", "time"],
    "ends later": ["passed", "crashed"],
}


def test_only_what_ends_the_process_costs_no_other_check_anything(key, right):
    submissions = [(name, LESSON, right | {"attacked-mean": answer}) for name, answer in ANSWERS.items()]
    outcomes = {}
    for result in autograde(submissions, key, workers=2, limits=SHORT):
        (mean,) = [exercise for exercise in result.exercises if exercise.id == "attacked-mean"]
        outcomes[result.name] = [case.outcome for case in mean.cases]
    assert outcomes == OUTCOMES


@contextlib.contextmanager
def sandbox_kernels(page):
    with KernelFactory() as kernel_factory:
        kernels = PageKernels(page, kernel_factory)
        yield kernels
        kernels.close()


@contextlib.contextmanager
def exercise_run_of(key, source):
    """(ExerciseRun of an answer, list of (Case, source of its check cell))."""
    exercise = key.exercise("attacked-mean")
    with sandbox_kernels(page_of({exercise.id: source}, key.lessons[LESSON])) as kernels:
        exercise_run = ExerciseRun(exercise, kernels)
        yield exercise_run, [(case, exercise.kind.check_source(exercise)) for case in exercise.cases]
        exercise_run.close()


@contextlib.contextmanager
def watched_forks():
    """The checks that are forked meanwhile, as a list."""
    forks, fork = [], ForkedKernel.fork_check

    def counted(kernel, seconds):
        forks.append(fork(kernel, seconds))
        return forks[-1]

    with patch.object(ForkedKernel, "fork_check", counted):
        yield forks


def kernels_for(key, source, titles):
    """How many processes the cases of `mean` need, in that order, and which cases passed."""
    with exercise_run_of(key, source) as (exercise_run, checks), watched_forks() as forks:
        checks_by_title = {case.title: (case, check) for case, check in checks}
        runs = []
        for title in titles:
            case, check = checks_by_title[title]
            runs.append(exercise_run.run(case, check))
        return len(forks), [run.passed for run in runs]


def test_checks_share_a_kernel_until_one_ends_it(key, right):
    names = ["Five numbers", "Fifty numbers", "Five numbers"]
    assert kernels_for(key, right["attacked-mean"], names) == (1, [True] * 3)
    assert kernels_for(key, "def mean(values):\n    return 0.0", names) == (1, [False] * 3)
    assert kernels_for(key, ANSWERS["works once"], names) == (1, [True, False, False])
    assert kernels_for(key, ANSWERS["ends later"], names) == (3, [True, False, True])


def test_an_answer_cannot_say_that_its_kernel_was_not_confined():
    with KernelFactory() as kernel_factory:
        kernel = kernel_factory.start((), 5.0)
        assert kernel.run("import os\nos._exit(70)").ended == "crashed"
        kernel.stop()


def test_a_kernel_that_could_not_be_confined_runs_nothing():
    no_room = replace(Limits(), scratch="no number")  # mount() refuses it
    with KernelFactory(limits=no_room) as kernel_factory:
        kernel = kernel_factory.start((), 5.0)
        with pytest.raises(SandboxError, match="a kernel could not be confined"):
            kernel.run("print(1)")
        kernel.stop()


BUSY = """
import os, time
def work(seconds):
    begun = time.process_time()
    while time.process_time() - begun < seconds: pass
def f(together):
    for _ in range(3):
        child = os.fork()
        if child == 0:
            work(together / 3)
            os._exit(0)
        os.waitpid(child, 0)
"""
CHECK = "from nbclassroom.autograder.sandbox.inside.check_cell import emit\nemit(f)"


def test_all_processes_of_a_check_share_its_time():
    with KernelFactory(limits=replace(SHORT, wall_grace=30.0)) as kernel_factory:
        kernel = kernel_factory.start((), 0.4)
        assert kernel.run(BUSY).error == ("", "")
        assert kernel.run_check(CHECK, [{"tuple": [0.3]}], 0.4).ended == ""
        assert kernel.run_check(CHECK, [{"tuple": [2.4]}], 0.4).ended == "time"
        kernel.stop()


def test_a_kernel_that_ended_while_it_waited_is_replaced(key, right):
    with exercise_run_of(key, right["attacked-mean"]) as (exercise_run, [(case, check), _]):
        factory = exercise_run._kernels._kernel_factory
        factory._spare = factory.start((), 5.0, alone=True)
        assert factory._spare.run("import os\nos._exit(3)").ended == "crashed"
        assert exercise_run.run(case, check).passed


STATE = """import random, signal, sys
print(sorted(name for name in globals() if not name.startswith("_")))
print(random.random(), np.random.random(), signal.getitimer(signal.ITIMER_PROF))
print(signal.getsignal(signal.SIGINT).__name__, sys.exc_info(), sys.__stdout__.name)
print(get_ipython().execution_count, _, __, sorted(get_ipython().user_ns_hidden)[:3], In, Out)"""


def test_a_kernel_that_has_waited_is_as_a_new_one():
    texts = []
    with KernelFactory() as kernel_factory:
        for _ in range(3):  # a new one, then two that have waited
            kernel = kernel_factory.start((), 5.0)
            run, printed = run_printing(kernel, STATE)
            texts.append((printed, run.error))
            kernel.stop()
    assert "random" in texts[0][0] and texts[0][1] == ("", "")
    assert texts[1:] == texts[:1] * 2
