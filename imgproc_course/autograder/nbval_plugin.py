"""nbval as the judge: the pytest plugin that feeds it one exercise after another.

Loaded by name into the pytest of `judge`. It changes nothing of nbval's: nbval collects each notebook, runs
its cells and compares their outputs with the stored ones. Three of its surroundings are ours: the kernel
behind `nbval.plugin.RunningKernel`, the stored outputs (`Reference`, which compares with a tolerance), and
the loop, which takes submissions from a socket as long as there are any.
"""

import json
import os
import re
import socket
from pathlib import Path

import nbval.plugin
import pytest

from imgproc_course.autograder.answer_key import MIME, load_key
from imgproc_course.autograder.reference import Reference, failing_call, read_answer
from imgproc_course.autograder.results import (
    CaseRun,
    exercise_result,
    is_stub,
    refused_result,
    submission_result,
)
from imgproc_course.autograder.sandbox.bubblewrap import Limits
from imgproc_course.autograder.sandbox.kernels import Kernels

DESCRIPTOR = "IMGPROC_JUDGE_SOCKET"
LONGEST = 200_000  # characters of one answer
_ORDER = re.compile(r"^(\s*#+\s*)(NBVAL_\w+|PYTEST_VALIDATE_\w+)(\s*)$", re.M)


class ExerciseKernel:
    """What nbval takes for its kernel, for one exercise.

    Of what a check cell shows nbval gets the values alone: what the function printed or drew beside them
    costs nothing, as in a lesson.
    """

    current = None  # the Session whose notebook nbval runs now

    def __init__(self, kernel_name, cwd=None, startup_timeout=60):
        self._work = ExerciseKernel.current
        self._before, self._messages, self._count = [], [], 0
        self.language = "python"

    def is_alive(self):
        return True

    def execute_cell_input(self, cell_input, allow_stdin=None):
        self._count += 1
        name = f"cell-{self._count}"
        case = self._work.case_of(cell_input, self._count)
        if case is None:
            self._before.append(cell_input)
        else:
            self._check(case, cell_input, name)
        self._say(name, "status", execution_state="idle")
        return name

    def _check(self, case, source, name):
        run = self._work.run(case, [*self._before], source)
        for answer in run.check.answers:
            self._say(name, "display_data", data={MIME: answer}, metadata={})
        if run.ended:
            self._say(name, "error", ename=run.ended, evalue="", traceback=[])
        elif run.check.error[0]:
            self._say(name, "error", ename=run.check.error[0], evalue=run.check.error[1], traceback=[])

    def _say(self, name, kind, **content):
        self._messages.append({"msg_type": kind, "content": content, "parent_header": {"msg_id": name}})

    def await_reply(self, msg_id, timeout=None):
        pass

    def await_idle(self, parent_id, timeout):
        self._messages.clear()

    def get_message(self, stream, timeout=None):
        return self._messages.pop(0)

    def interrupt(self):
        pass

    restart = stop = interrupt


class Session:
    """One exercise of one submission on its way through nbval.

    Its checks run one after another in one kernel, as in JupyterLab, for as long as they pass. One that does
    not is run in a new kernel, after the given cells and the answer, and what it does there counts: a patch,
    a crash or a thread in one check costs no other.
    """

    def __init__(self, exercise, content, kernels, then):
        self._exercise, self._content, self._kernels, self._then = exercise, content, kernels, then
        self._cases = {}
        self._kernel, self._answer = None, None
        self.runs, self.passed = {}, set()
        code = [cell for cell in content.notebook["cells"] if cell["cell_type"] == "code"]
        known = {case.id: case for case in exercise.cases}
        for number, cell in enumerate(code, 1):
            self._cases[number] = known.get(cell["id"])

    def case_of(self, source, number):
        """The case that the notebook's n-th code cell checks, or None."""
        return self._cases[number]

    def run(self, case, before, check):
        """Run one case, its check cell after the cells before it; returns its CaseRun."""
        run = self._in_the_same_kernel(case, check)
        for _ in range(2):  # again where the process that forks kernels was ended
            if run is None or run.ended == "gone":
                run = self._in_a_new_kernel(case, before, check)
        self.runs[case.id] = run
        return run

    def _in_the_same_kernel(self, case, check):
        """A CaseRun that passed, or None; of a kernel that lets a case use no more than its own would."""
        if self._kernel is None or self._seconds > seconds_of(self._exercise, case):
            return None
        run = CaseRun(answer=self._answer)
        self._check(run, case, check)
        return run if self._has_passed(run, case) else None

    def _in_a_new_kernel(self, case, before, check):
        self.close()
        self._seconds = seconds_of(self._exercise, case)
        self._kernel = self._kernels.start(self._exercise.refused, self._seconds, self._then)
        run = CaseRun()
        for source in before:
            run.answer = self._kernel.run(source)
            if run.ended:
                break
        else:
            self._check(run, case, check)
        self._answer = run.answer
        if not self._has_passed(run, case):
            self.close()
        return run

    def _check(self, run, case, check):
        exercise = self._exercise
        run.check = self._kernel.deliver(self._content.inputs[case.id], exercise.time_limit, exercise.refused)
        if not run.ended:
            run.check = self._kernel.run(check)

    def _has_passed(self, run, case):
        if run.ended or run.check.error[0] or len(run.check.answers) != 1:
            return False
        read = read_answer(run.check.answers[0])
        if read is None or read[1]:
            return False
        return failing_call(self._content.expected[case.id], read[0], case.tolerance) is None

    def close(self):
        """End its kernel, if it has one."""
        if self._kernel is not None:
            self._kernel.stop()
        self._kernel = None


def seconds_of(exercise, case):
    """Processor time of a case: the exercise's limit for each of its calls."""
    return exercise.time_limit * case.calls


class Judge:
    """The plugin's state: the key, where kernels come from, the way to `judge`."""

    def __init__(self, connection):
        self._lines = connection.makefile("r", encoding="utf-8")
        self._connection = connection
        first = json.loads(self._lines.readline())
        limits = Limits(**first["limits"]) if first["limits"] else None
        self._kernels = Kernels(first["kernel"], unsafe=first["unsafe"], limits=limits)
        self._key = load_key(first["key"])
        self._folder = Path(first["folder"])
        self._session = None

    def serve(self, session):
        """Judge submissions until there are no more, then end this process."""
        self._session = session
        self._send({"ready": True})
        with self._kernels:
            for line in self._lines:
                job = json.loads(line)
                self._send(self._judge(job))
        os._exit(0)  # somebody waits, and nothing that pytest would still do is of use to anybody

    def _send(self, message):
        self._connection.sendall((json.dumps(message) + "\n").encode("ascii"))

    def _judge(self, job):
        lesson = self._key.lessons[job["lesson"]]
        graded = [each for each in lesson.exercises if not each.practice]
        plan = [(each, job["answers"].get(each.id)) for each in graded]
        reasons = {each.id: reason_not_to_run(each, source) for each, source in plan}
        running = [each for each in graded if not reasons[each.id]]
        results = []
        for each, source in plan:
            if reasons[each.id]:
                results.append(refused_result(each, *reasons[each.id]))
                continue
            after = running[running.index(each) + 1 :] or running[:1]
            then = (after[0].refused, seconds_of(after[0], after[0].cases[0]))
            results.append(self._judge_exercise(each, source, then))
        return submission_result(job, lesson, results)

    def _judge_exercise(self, exercise, source, then):
        content = self._key.content(exercise.id)
        work = ExerciseKernel.current = Session(exercise, content, self._kernels, then)
        path = self._folder / "exercise.ipynb"
        path.write_text(json.dumps(_with_answer(content.notebook, exercise, source)), encoding="utf-8")
        try:
            self._let_nbval_judge(path, work)
        finally:
            work.close()
        return exercise_result(exercise, content, work)

    def _let_nbval_judge(self, path, work):
        (notebook,) = self._session.config.hook.pytest_collect_file(file_path=path, parent=self._session)
        cells = list(notebook.collect())
        for cell in cells:
            _put_reference(cell, work)
        for cell, following in zip(cells, [*cells[1:], None], strict=True):
            self.cell, self.verdict = cell, []
            cell.ihook.pytest_runtest_protocol(item=cell, nextitem=following)
            if self.verdict == ["setup passed", "call passed", "teardown passed"]:
                work.passed.add(cell.cell.id)
            cell.cell = None
        notebook.nb = None

    @pytest.hookimpl
    def pytest_runtest_logreport(self, report):
        self.verdict.append(f"{report.when} {report.outcome}")

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session):
        self.serve(session)
        return True

    @pytest.hookimpl
    def pytest_assertrepr_compare(self, config, op, left, right):
        return ["the values differ"]  # nbval would print both

    @pytest.hookimpl
    def pytest_sessionstart(self, session):
        reporter = session.config.pluginmanager.get_plugin("terminalreporter")
        session.config.pluginmanager.unregister(reporter)  # it keeps a report of every cell


def _with_answer(notebook, exercise, source):
    cells = [dict(cell) for cell in notebook["cells"]]
    for cell in cells:
        if cell["id"] == f"answer-{exercise.id}":
            cell["source"] = _ORDER.sub(r"\1-\3", source)  # a comment by which nbval takes orders
    return notebook | {"cells": cells}


def _put_reference(cell, work):
    case = next((case for case in work._exercise.cases if case.id == cell.cell.id), None)
    if case is not None:
        expected = work._content.expected[case.id]
        cell.cell.outputs[0].data[MIME] = Reference(expected, case.tolerance)


def reason_not_to_run(exercise, source):
    """Why an answer is not run, as (outcome, words); () where it is."""
    if not isinstance(source, str):
        return "missing", "its answer cell is missing"
    if len(source) > LONGEST:
        return "hostile", f"its answer is {len(source)} characters long; at most {LONGEST} are graded"
    if is_stub(source, exercise.stub):
        return "not attempted", ""
    return ()


def pytest_configure(config):
    nbval.plugin.RunningKernel = ExerciseKernel
    connection = socket.socket(fileno=int(os.environ.pop(DESCRIPTOR)))
    config.pluginmanager.register(Judge(connection), "imgproc_course_judge")
