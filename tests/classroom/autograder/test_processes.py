"""Which process knows what: the key's values are in the nbval process, and in none that runs answers."""

import re
import struct
from pathlib import Path

import psutil
import pytest
from attacks import LESSON, page_with
from nbclassroom.autograder.nbval_plugin import PageKernels
from nbclassroom.autograder.pool import NbvalProcess
from nbclassroom.autograder.sandbox.fork_server_client import KernelFactory
from nbclassroom.exercises.canonical import encode
from nbclassroom.exercises.page import page_of

pytestmark = pytest.mark.sandbox
REPLACED = """
import json, os, signal, time
def forged(*_arguments, **_options):
    raise SystemExit("replaced")
for module, names in {
    os: "fork _exit kill wait4 waitpid write",
    json: "dumps loads",
    signal: "signal setitimer",
    time: "monotonic thread_time",
}.items():
    for name in names.split():
        setattr(module, name, forged)
"""


def holds(process, data):
    """Whether the memory of a process has these bytes."""
    with (
        Path(f"/proc/{process.pid}/maps").open() as maps,
        Path(f"/proc/{process.pid}/mem").open("rb") as memory,
    ):
        for line in maps:
            start, end, rights = re.match(r"(\w+)-(\w+) (\S+)", line).groups()
            if not rights.startswith("rw") or "[v" in line:
                continue
            memory.seek(int(start, 16))
            if data in memory.read(int(end, 16) - int(start, 16)):
                return True
    return False


def test_only_the_nbval_process_has_seen_the_key(key, right):
    hidden = next(case for case in key.lessons[LESSON].exercises[1].cases if case.hidden)
    value = struct.pack("<d", hidden.calls[-1].result.value["value"])
    answers = right | {"attacked-mean": "def mean(values):\n    return 0.0"}
    process = NbvalProcess(unsafe=False, limits=None)
    try:
        process.grade(key, "one", LESSON, page_of(answers, key.lessons[LESSON]))
        worker = psutil.Process(process._process.pid)
        below = worker.children(recursive=True)
        below = [each for each in below if each.status() != psutil.STATUS_ZOMBIE]
        runs_answers = [each for each in below if "fork_server.main" in " ".join(each.cmdline())]
        assert holds(worker, value) and len(runs_answers) >= 3  # bubblewrap twice, and the fork server
        assert [each.pid for each in runs_answers if holds(each, value)] == []
        for each in runs_answers:
            told = " ".join([*each.cmdline(), *map("=".join, each.environ().items())])
            assert str(key.path) not in told
            assert [file.path for file in each.open_files() if Path(file.path).is_relative_to(key.path)] == []
    finally:
        process.stop()


def test_a_page_has_no_inputs_of_a_check(key, right):
    source = "from nbclassroom.autograder.sandbox.inside import check_cell\nseen = str(check_cell.CASE)"
    exercise = key.lessons[LESSON].exercises[0]
    with KernelFactory() as factory:
        kernels = PageKernels(page_with(key, source, right), factory)
        process, _ = kernels.open_check(exercise, 1.0)
        seen = process.run("raise ValueError(seen)").error[1]
        process.stop()
        kernels.close()
    assert seen == "{'calls': [{'tuple': [1.5]}], 'seconds': 5}"  # of the warm-up


def test_what_the_kernel_itself_calls_was_looked_up_before_a_learners_code(key, right):
    exercise = key.lessons[LESSON].exercises[0]
    inputs = [encode(call.arguments) for call in exercise.cases[0].calls]
    with KernelFactory() as factory:
        kernels = PageKernels(page_with(key, REPLACED, right), factory)
        process, answer = kernels.open_check(exercise, 1.0)
        assert (answer.ended, answer.error) == ("", ("", ""))
        check = "from nbclassroom.autograder.sandbox.inside.check_cell import emit\n\nemit(double)"
        run = process.run_check(check, inputs, 5.0)
        assert process.run("assert os.fork is time.monotonic is forged").error == ("", "")
        process.stop()
        kernels.close()
    (shown,) = run.answers
    assert len(shown["calls"]) == len(inputs)
