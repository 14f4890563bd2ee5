"""Checks of one exercise, one after another: what one leaves behind costs no other, and lends it nothing."""

import pytest
from attacks import LESSON, SHORT

from imgproc_course.autograder.nbval_plugin import Session
from imgproc_course.autograder.pool import autograde
from imgproc_course.autograder.sandbox.kernels import Kernels

pytestmark = [pytest.mark.sandbox, pytest.mark.xdist_group("isolation")]
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
    "works once": ["passed", "passed"],
    "patches numpy": ["passed", "passed"],
    "ends soon": ["passed", "passed"],
    "spoils from beside": ["passed", "passed"],
    "begins late": ["wrong", "wrong"],
    "spins later": ["passed", "time"],
    "ends later": ["passed", "crashed"],
}


@pytest.mark.parametrize("kernel", ["fast", "ipykernel"])
def test_what_one_check_leaves_behind_costs_no_other_and_lends_it_nothing(key, right, kernel):
    handed = [(name, LESSON, right | {"attacked-mean": ANSWERS[name]}) for name in OUTCOMES]
    found = {}
    for result in autograde(handed, key, kernel=kernel, workers=2, limits=SHORT):
        (mean,) = [each for each in result["exercises"] if each["id"] == "attacked-mean"]
        found[result["submission"]] = [case["outcome"] for case in mean["cases"]]
    assert found == OUTCOMES


def kernels_for(key, source, names):
    """How many kernels the cases of `mean` take, in that order; and which passed."""
    (exercise,) = [each for each in key.lessons[LESSON].exercises if each.id == "attacked-mean"]
    content = key.content(exercise.id)
    cells = {cell["id"]: "".join(cell["source"]) for cell in content.notebook["cells"]}
    before = [*(text for name, text in cells.items() if name.startswith("given")), source]
    cases = {case.title: case for case in exercise.cases}
    with Kernels("fast") as kernels:
        session = Session(exercise, content, kernels, None)
        runs = [session.run(cases[name], before, cells[cases[name].id]) for name in names]
        session.close()
        return kernels._zygote._count, [
            session._has_passed(run, cases[name]) for run, name in zip(runs, names, strict=True)
        ]


def test_checks_share_a_kernel_as_long_as_they_pass(key, right):
    names = ["Five numbers", "Fifty numbers", "Five numbers"]
    assert kernels_for(key, right["attacked-mean"], names) == (1, [True] * 3)
    assert kernels_for(key, "def mean(values):\n    return 0.0", names) == (3, [False] * 3)
    assert kernels_for(key, ANSWERS["works once"], names) == (3, [True] * 3)
    late = f"def mean(values):\n    return {MEAN} if len(values) > 5 else 0.0"
    assert kernels_for(key, late, names) == (3, [False, True, False])
