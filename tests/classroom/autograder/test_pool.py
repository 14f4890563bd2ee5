"""The same answers get the same results, whatever else happens."""

import itertools
import json
import shutil
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import suppress

import psutil
import pytest
from nbclassroom.autograder import pool
from nbclassroom.autograder.nbval_plugin import ExerciseRun, PageKernels
from nbclassroom.autograder.outcomes import PHRASES, Outcome
from nbclassroom.autograder.pool import (
    Limits,
    NbvalProcessNotStarted,
    SandboxError,
    autograde,
    grade_one,
    nbval_process_of_thread,
    open_worker_threads,
)
from nbclassroom.autograder.results import from_json, to_json
from nbclassroom.autograder.sandbox import bubblewrap
from nbclassroom.autograder.sandbox.fork_server_client import KernelFactory
from nbclassroom.exercises.page import page_of

pytestmark = pytest.mark.sandbox
LESSON = "attacked"
DOUBLED = "np.minimum(pixels.astype(int) * 2, 255).astype(np.uint8)"
DOUBLES = f"def double(pixels):\n    return {DOUBLED}\n"
SAMPLES = {
    "right": "def double(pixels):\n    return np.minimum(pixels.astype(int) * 2, LIMIT).astype(np.uint8)",
    "untouched": 'def double(pixels):\n    # not yet\n    raise NotImplementedError("your turn")',
    "begun": 'def double(pixels):\n    print("begun")\n    raise NotImplementedError("later")',
    "wraps": "def double(pixels):\n    return pixels * 2",
    "one off": "def double(pixels):\n    return np.minimum(pixels.astype(int) * 2 + 1, 255).astype(np.uint8)",
    "raises": "def double(pixels):\n    return pixels.nothing",
    "other type": "def double(pixels):\n    return pixels.tolist()",
    "none": "def double(pixels):\n    pixels * 2",
    "changes": "def double(pixels):\n    pixels[0, 0] = 1\n    return pixels",
    "prints": 'def double(pixels):\n    print("hello", pixels.shape)\n    return pixels',
    "random": "def double(pixels):\n    return np.random.randint(0, 9, pixels.shape).astype(np.uint8)",
    "no function": "x = 1",
    "another name": "def treble(pixels):\n    return pixels",
    "a syntax error": "def double(pixels):\nreturn pixels",
    "uses cv2": "import cv2\ndef double(pixels):\n    return cv2.add(pixels, pixels)",
    "imports cv2 for nothing": f"import cv2\n{DOUBLES}",
    "right, and shows it": f"{DOUBLES}\n\ndouble(frame)",
    "right, and checks it": "from imgproc_course.exercises import check\n"
    f"{DOUBLES}\ncheck('attacked-double', double)",
    "prints beside": "import os\ndef double(pixels):\n    os.write(1, b'raw')\n    print('x' * 5000)\n"
    f"    return {DOUBLED}",
    "draws": "import matplotlib.pyplot as plt\ndef double(pixels):\n    plt.imshow(pixels)\n    plt.show()\n"
    f"    return {DOUBLED}",
    "warns": f"def double(pixels):\n    np.log(pixels * 0)\n    return {DOUBLED}",
    "ends": "import os\ndef double(pixels):\n    os._exit(1)",
    "top-level await": f"import asyncio\nawait asyncio.sleep(0)\n{DOUBLES}",
    "magics": f"%time x = 1\n!true\n{DOUBLES}",
    "half": f"def double(pixels):\n    return {DOUBLED} // 4",
}
OUTCOMES = {
    "right": ("passed", "passed"),
    "untouched": ("not attempted", "not attempted"),
    "begun": ("not attempted", "not attempted"),
    "raises": ("raised", "raised"),
    "no function": ("missing", "missing"),
    "another name": ("missing", "missing"),
    "a syntax error": ("raised", "raised"),
    "uses cv2": ("refused module", "refused module"),
    "imports cv2 for nothing": ("passed", "passed"),
    "right, and shows it": ("passed", "passed"),
    "right, and checks it": ("passed", "passed"),
    "prints beside": ("passed", "passed"),
    "draws": ("passed", "passed"),
    "warns": ("passed", "passed"),
    "ends": ("crashed", "crashed"),
    "top-level await": ("passed", "passed"),
    "magics": ("passed", "passed"),
}
PATIENT = Limits(grace=4.0)


def submissions_of(right, names=SAMPLES):
    return [(name, LESSON, right | {"attacked-double": SAMPLES[name]}) for name in names]


def by_name(results):
    return {result.name: result for result in results}


def doubles(result):
    return next(exercise for exercise in result.exercises if exercise.id == "attacked-double")


@pytest.fixture(scope="module")
def results(key, right):
    return by_name(autograde(submissions_of(right), key, workers=2, limits=PATIENT))


@pytest.mark.parametrize("name", SAMPLES)
def test_each_sample_gets_its_outcome(results, name):
    exercise = doubles(results[name])
    outcomes = OUTCOMES.get(name, ("wrong", "wrong"))
    assert tuple(case.outcome for case in exercise.cases) == outcomes
    points = sum(points for points, outcome in zip((1, 2), outcomes, strict=True) if outcome == "passed")
    assert (exercise.points, exercise.max_points) == (points, 3)
    assert results[name].points == 7 + points


def test_a_result_is_read_back_from_its_json(results):
    for result in results.values():
        assert from_json(json.loads(json.dumps(to_json(result)))) == result


def test_json_that_is_no_result_is_refused(results):
    data = to_json(results["one off"])
    for damaged in (
        {name: value for name, value in data.items() if name != "lesson"},
        data | {"exercises": [data["exercises"][0] | {"cases": [{"id": "x"}]}]},
        data | {"exercises": [data["exercises"][0] | {"unknown": 1}]},
        [],
    ):
        with pytest.raises((KeyError, TypeError, ValueError)):
            from_json(damaged)


def test_results_reveal_nothing_of_the_key_and_the_machine(results, key):
    text = json.dumps([to_json(result) for result in results.values()])
    for trace in (str(key.path), "/tmp", "8675309", "expected_answer", "0x7f"):
        assert trace not in text


def test_a_hidden_check_says_that_the_cell_does_not_run_or_which_exception_was_raised(results):
    messages = {name: doubles(results[name]).cases[1].message for name in ("a syntax error", "raises")}
    assert messages == {"a syntax error": "its cell does not run", "raises": "AttributeError"}


def test_every_outcome_has_its_texts():
    assert all(PHRASES[outcome] for outcome in Outcome)


def test_a_failed_public_case_shows_what_it_printed(results):
    assert "Your function printed:\nhello (3, 4)</div>" in doubles(results["prints"]).body


def test_known_mistakes_are_named(results):
    wraps = doubles(results["wraps"])
    assert (wraps.mistake, wraps.mistake_explanation) == ("uint8 wraps", "Widen first.")
    assert doubles(results["half"]).mistake == "half"
    assert doubles(results["one off"]).mistake == doubles(results["right"]).mistake == ""


def test_an_error_after_the_function_is_reported_and_costs_nothing(results):
    assert doubles(results["right, and shows it"]).message.startswith(
        "a statement in its cell fails: NameError: name 'frame'"
    )


def test_an_honest_wrong_answer_says_why(results):
    messages = {name: doubles(results[name]).cases[0].message for name in SAMPLES}
    assert messages["changes"].startswith("double() changed its input pixels. Leave")
    assert messages["none"].startswith("Expected an array of shape")
    assert messages["none"].endswith(", got None.")
    assert messages["raises"].startswith(
        "AttributeError: 'numpy.ndarray' object has no attribute 'nothing' (line 2: "
    )
    assert messages["a syntax error"].startswith("its cell does not run: IndentationError")
    assert messages["no function"] == "its cell does not define double()"


@pytest.mark.parametrize(
    "name", ["../../etc", "a::b", "-p no:x", "s[1]", "=cmd|' ,x", "x\ny", "\ud800", "", "ä" * 3000, "<b>"]
)
def test_a_submission_may_have_any_name(key, right, name):
    (result,) = autograde([(name, LESSON, right)], key, workers=1)
    assert (result.name, result.points) == (name, 10)


def test_missing_and_unknown_answers(key, right):
    (result,) = autograde(
        [("a", LESSON, {"nonsense": "x", "attacked-mean": right["attacked-mean"]})], key, workers=1
    )
    assert [case.outcome for case in doubles(result).cases] == ["missing", "missing"]
    assert doubles(result).message == "its answer cell is missing"
    assert result.points == 7


def test_a_lesson_that_is_not_in_the_key_is_refused(key, right):
    with pytest.raises(ValueError, match="'99_x' is not in the key, which has attacked"):
        list(autograde([("a", "99_x", right)], key))


def test_submissions_are_read_as_results_are_taken(key, right):
    counter = itertools.count()
    endless = ((f"s{next(counter)}", LESSON, right) for _ in itertools.count())
    graded = autograde(endless, key, workers=1)
    assert [result.name for result in itertools.islice(graded, 3)] == ["s0", "s1", "s2"]
    graded.close()
    assert next(counter) < 20
    assert children("nbval_plugin.main") == []


def test_another_key_in_the_same_place_is_noticed(key, right):
    with pytest.raises(ValueError, match="this is another key than the one"):
        grade_one(("a", LESSON, page_of(right, key.lessons[LESSON])), key.path, "0" * 64)
    pool.stop_nbval_processes()


def test_grade_one_runs_over_any_executor(results, key, right):
    names = ["right", "wraps", "ends", "untouched"]
    with ProcessPoolExecutor(2, mp_context=__import__("multiprocessing").get_context("spawn")) as executor:
        graded = by_name(
            autograde(submissions_of(right, names), key, workers=2, executor=executor, limits=PATIENT)
        )
    assert graded == {name: results[name] for name in names}


def children(word):
    """The processes below this one whose command contains a word."""
    matching = []
    for process in psutil.Process().children(recursive=True):
        try:
            if word in " ".join(process.cmdline()):
                matching.append(process)
        except psutil.Error:
            continue
    return matching


@pytest.mark.parametrize("word", ["nbval_plugin.main", "fork_server.main"])
def test_a_crash_of_our_own_processes_loses_nothing(results, key, right, word):
    names = [name for name in SAMPLES if OUTCOMES.get(name) == ("passed", "passed")] * 2
    graded, kill_count = [], 0
    for number, result in enumerate(autograde(submissions_of(right, names), key, workers=1, limits=PATIENT)):
        graded.append(result)
        if number % 5 == 2:
            for process in children(word):
                with suppress(psutil.Error, AttributeError):  # it has ended, and so has its parent
                    if word == "nbval_plugin.main" or process.parent().name() == "bwrap" != process.name():
                        process.send_signal(signal.SIGKILL)
                        kill_count += 1
    assert kill_count >= 2
    assert graded == [results[name] for name in names]


def test_nothing_is_left_behind(key, right):
    list(autograde(submissions_of(right, ["right", "ends"]), key, workers=2))
    deadline = time.monotonic() + 60
    while (children("fork_server") or children("nbval_plugin.main")) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert children("fork_server") == children("nbval_plugin.main") == []
    assert not any(thread.name.startswith("autograde-") for thread in threading.enumerate())


def test_without_a_sandbox_nothing_runs(key, right, monkeypatch):
    monkeypatch.setattr(bubblewrap, "sandbox_problem", lambda: "bubblewrap is not installed: sudo ...")
    with pytest.raises(SandboxError, match=r"bubblewrap is not installed: sudo .*--unsafe"):
        list(autograde([("a", LESSON, right)], key))


def test_unsafe_gives_the_same_results(results, key, right):
    names = ["right", "wraps", "uses cv2", "ends", "raises"]
    assert by_name(autograde(submissions_of(right, names), key, unsafe=True, workers=1)) == {
        name: results[name] for name in names
    }


def test_nothing_in_the_users_environment_configures_nbval(key, right, tmp_path, monkeypatch):
    (tmp_path / "conftest.py").write_text("raise SystemExit(3)")
    (tmp_path / "pytest.ini").write_text("[pytest]\naddopts = --deselect .")
    (tmp_path / "nbval.py").write_text("raise SystemExit(3)")
    (tmp_path / "sitecustomize.py").write_text("raise SystemExit(3)")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTEST_ADDOPTS", "--collect-only")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    monkeypatch.setenv("PYTEST_PLUGINS", "conftest")
    (result,) = autograde([("a", LESSON, right)], key, workers=1)
    assert result.points == 10


def test_an_nbval_process_that_does_not_start_reports_why(key, right, monkeypatch, tmp_path):
    broken = tmp_path / "python"
    broken.write_text("#!/bin/sh\necho 'no such plugin' >&2\nexit 3\n")
    broken.chmod(0o755)
    monkeypatch.setattr(pool.sys, "executable", str(broken))
    with pytest.raises(SandboxError, match="the nbval process did not start: no such plugin"):
        grade_one(("a", LESSON, page_of(right, key.lessons[LESSON])), key.path, key.digest, unsafe=True)


def mortal(path, program, deaths):
    """A command that runs the program, and is killed instead the first times that it starts."""
    path.write_text(
        f'#!/bin/sh\necho >>"{path}.starts"\n[ $(wc -l <"{path}.starts") -le {deaths} ] && kill -9 $$\n'
        f'exec "{program}" "$@"\n'
    )
    path.chmod(0o755)
    return str(path)


@pytest.mark.parametrize("deaths", [5, 100])
def test_an_nbval_process_that_is_killed_while_it_starts_is_started_again(
    key, right, monkeypatch, tmp_path, deaths
):
    monkeypatch.setattr(pool.sys, "executable", mortal(tmp_path / "python", sys.executable, deaths))
    result = grade_one(("a", LESSON, page_of(right, key.lessons[LESSON])), key.path, key.digest, unsafe=True)
    pool.stop_nbval_processes()
    if deaths == 5:
        assert result.points == 10
    else:
        assert result.exercises_with(Outcome.NOT_GRADED) == {"attacked-double", "attacked-mean"}
        message = "the autograder failed: the nbval process was killed 10 times: signal 9 ended it"
        assert {exercise.message for exercise in result.exercises} == {message}


def test_a_sandbox_that_is_killed_while_it_starts_is_started_again(monkeypatch, tmp_path):
    mortal(tmp_path / "bwrap", shutil.which("bwrap"), 2)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    assert bubblewrap.sandbox_problem.__wrapped__() == ""
    (tmp_path / "bwrap.starts").unlink()
    with KernelFactory() as kernels:
        kernel = kernels.start((), 5.0)
        assert not kernel.run("1 + 1").ended
        kernel.stop()
    mortal(tmp_path / "bwrap", shutil.which("bwrap"), 100)
    assert "cannot make a sandbox here (exit code -9)" in bubblewrap.sandbox_problem.__wrapped__()


def test_a_fork_server_that_has_ended_is_closed_and_started_again():
    """What it leaves open would be a ResourceWarning, which is an error here."""
    with KernelFactory() as kernels:
        kernels.start((), 5.0).stop()
        process = kernels._process
        process.kill()
        process.wait()
        del process  # nothing here may keep it alive
        kernel = kernels.start((), 5.0, alone=True)  # the kernel that waited has ended with it
        assert not kernel.run("1 + 1").ended
        kernel.stop()


class KillsKernels(KernelFactory):
    """Kills the first kernels that it starts."""

    kills_left = 2

    def start(self, *request, **options):
        kernel = super().start(*request, **options)
        while self.kills_left and not (running := kernels_running()):
            time.sleep(0.01)
        if self.kills_left:
            running[0].kill()
            self.kills_left -= 1
        return kernel


def kernels_running():
    kernels = []
    for process in children("fork_server.main"):
        with suppress(psutil.Error, AttributeError):
            if process.parent().name() != "bwrap" != process.name():
                kernels.append(process)
    return kernels


def test_a_kernel_that_is_killed_twice_costs_nobody_a_point(key, right):
    exercise = key.exercise("attacked-double")
    with KillsKernels() as kernels:
        page = page_of({exercise.id: right[exercise.id]}, key.lessons[LESSON])
        exercise_run = ExerciseRun(exercise, PageKernels(page, kernels))
        run = exercise_run.run(exercise.cases[0], exercise.kind.check_source(exercise))
        exercise_run.close()
        assert kernels.kills_left == 0
    assert (run.ended, run.passed) == ("", True)


def test_an_nbval_process_loads_nothing_that_only_teachers_tools_need():
    first_imports, *_ = pool._PROGRAM.partition("confine.")
    code = first_imports + (
        "print([name for name in ('numpy', 'pytest') if name in sys.modules]); "  # they come later
        "import nbclassroom.autograder.blocked_imports; "
        "from nbclassroom.autograder import nbval_plugin; "
        "nbval_plugin._leave_out_kernels_of_nbval(); import nbval.plugin; "
        "heavy = ('jupytext', 'rfc3987_syntax', 'isoduration', 'arrow', 'cv2', 'matplotlib', 'coverage'); "
        "heavy += ('zmq', 'rfc3986_validator', 'webcolors'); "
        "print([name for name in heavy if sys.modules.get(name)])"
    )
    done = subprocess.run([sys.executable, "-I", "-c", code], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("[]\n[]\n", "")


def test_a_thread_of_a_stopped_pool_starts_no_process_again():
    """Else a submission that runs while the pool is stopped starts one, and the command waits."""
    with open_worker_threads(1) as executor:
        name = executor.submit(lambda: threading.current_thread().name).result()
    with ThreadPoolExecutor(1, thread_name_prefix=name.removesuffix("_0")) as again:
        future = again.submit(nbval_process_of_thread, False, None)
        with pytest.raises(NbvalProcessNotStarted, match="the run was stopped"):
            future.result()


OWN = "class {name}(Exception):\n    pass\n\n"
IMPORTED = "from nbclassroom.exercises.running import {name}\n\n"
KNOWN_NAMES = (
    "NotGradedError",
    "NodeError",
    "RefusedModule",
    "NotImplementedError",
    "MemoryError",
    "TimeoutError",
)


def test_the_name_of_an_exception_decides_nothing(key):
    binds = [*((OWN, name) for name in KNOWN_NAMES), (IMPORTED, "NotGradedError")]
    raises = ["raise {name}('mine')", "def double(pixels):\n    raise {name}('mine')"]
    sources = [(name, (bind + end).format(name=name)) for bind, name in binds for end in raises]
    submissions = [(name, LESSON, {"attacked-double": source}) for name, source in sources]
    for result in autograde(submissions, key, workers=1):
        cases = result.exercises[0].cases
        assert {case.outcome for case in cases} == {Outcome.RAISED}, result.name
        assert result.name in cases[0].message and "mine" in cases[0].message
