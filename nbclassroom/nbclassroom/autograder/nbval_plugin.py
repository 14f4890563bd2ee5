"""The program and the pytest plugin of an nbval process: it makes nbval grade one exercise after another.

What nbval does: it collects each exercise's notebook, whose stored outputs are the values of the answer key,
sends the cells to what it takes for its kernel, reads the messages that come back, and compares each output
with the stored one. A wrong answer is a cell that nbval lets fail, and costs its points for that reason.
What ours does: `ExerciseKernel` takes the place of nbval's kernel and runs the cells in the sandbox; and
where nbval compares (`stored != shown`), a CaseRun is what was shown, and `==` is our comparison.
"""

import json
import math
import os
import socket
import sys
import time
import types
from pathlib import Path

import pytest

from ..exercises.canonical import encode
from ..exercises.cell_syntax import is_part_of
from . import results
from .answer_key import expected_key
from .outcomes import Outcome
from .sandbox.fork_server_client import MIME, CellRun
from .sanitize import reproducible_text
from .shown_answer import figure_html
from .verdict import CaseRun, verdict_on

# A kernel that ended like this may have been ended by something else than the answer. It is run again, alone:
# after "memory" once, after "gone" up to twice, after "crashed" up to three times. One pair for each try.
_RUN_AGAIN_AFTER = (("crashed", "memory"), ("crashed", "gone"), ("crashed", "gone"))
_PAGE_SECONDS = 60.0  # of processor time, that a page may take beside its checks; see `exercises.page_run`
_MOST_ENDS = 10  # of kernels by statements of one page
_MOST_ATTEMPTS = 40
_MESSAGE_ID = "a cell's run"
MAX_ANSWER = 200_000  # characters
_KERNEL = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}


class ExerciseKernel:
    """What nbval takes for its kernel, for one exercise.

    For each cell nbval calls execute_cell_input, await_reply and then get_message until "idle"; after an
    error also await_idle. The cells before the first check are not run here: the page has them.
    Of a check, nbval gets what the function returned. What it printed or drew costs nothing, as in a lesson.
    """

    def __init__(self, exercise_run):
        self._exercise_run = exercise_run
        self._messages = []
        self.case = None  # the Case that the next cell checks

    def is_alive(self):
        return True

    def execute_cell_input(self, cell_input, allow_stdin=None):
        if self.case is not None:
            run = self._exercise_run.run(self.case, cell_input)
            self._add_message("display_data", data={MIME: run}, metadata={})
            name, text = (run.ended, "") if run.ended else run.check.error
            if name:
                self._add_message("error", ename=name, evalue=text, traceback=[])
        self._add_message("status", execution_state="idle")
        return _MESSAGE_ID

    def _add_message(self, kind, **content):
        parent = {"msg_id": _MESSAGE_ID}
        self._messages.append({"msg_type": kind, "content": content, "parent_header": parent})

    def await_idle(self, parent_id, timeout):
        self._messages.clear()

    def get_message(self, stream, timeout=None):
        return self._messages.pop(0)

    def interrupt(self, *_arguments, **_options):
        pass

    await_reply = stop = interrupt


class PageKernels:
    """Kernels that run a page (see `exercises.page`) up to one check after another.

    Exercises that allow the same modules share a kernel, and each of them has a process that is forked from
    it: what one check leaves behind does not reach the next one. Each drive has a kernel of its own.
    """

    def __init__(self, page, kernel_factory):
        self._page, self._kernel_factory = page, kernel_factory
        self._kernel, self._allowed, self._place = None, (), 0
        # Statements that end the process; those at which one ended once
        self._skip, self._ended_at = [], set()
        self.tried = {}  # {(exercise id or "", what its code tried): None}

    def in_order(self, exercises):
        """Exercises in the order in which their checks are to run."""
        allowed = list(dict.fromkeys(exercise.allowed for exercise in exercises))
        checks = self._page["checks"]
        return sorted(exercises, key=lambda one: (allowed.index(one.allowed), checks.get(one.id, 0), one.id))

    def open_check(self, exercise, seconds, *, alone=False):
        """(the Connection to a process in which the page has run up to the check, the CellRun of the answer).

        `seconds` of processor time are the first case's. `alone`: while no other kernel waits, which could
        use memory that this one needs.
        """
        place = self._page["checks"][exercise.id]
        if not alone and exercise.kind.shares_kernel:
            kernel, run = self._run_to(place, exercise.allowed)
            check = None if run.ended else kernel.fork_check(seconds)
            if check is not None:
                return check, self._about(exercise, run, check.run_below(exercise.function))
        self.close()
        kernel, run = self._start(place, exercise.allowed, seconds, alone=alone)
        return kernel, self._about(exercise, run, run if run.ended else kernel.run_below(exercise.function))

    def _run_to(self, place, allowed):
        """(the kernel that the exercises share, the CellRun of the page, which runs on to a place in it)."""
        if self._kernel is not None and self._allowed == allowed and self._place <= place:
            run = self._kernel.run_page(place)
            self._place = place
            if not run.ended:
                return self._kernel, run
        self.close()
        self._kernel, run = self._start(place, allowed, 0.0)
        self._allowed, self._place = allowed, place
        return self._kernel, run

    def _start(self, place, allowed, seconds, *, alone=False):
        """(a kernel, the CellRun of the page up to a place in it), without what ends the process."""
        for _ in range(_MOST_ENDS):
            kernel = self._kernel_factory.start(allowed, _PAGE_SECONDS + seconds, alone=alone)
            run = kernel.open_page(self._page, self._skip)
            run = run if run.ended else kernel.run_page(place)
            if not run.ended or (not run.place and run.ended != "gone"):
                break
            self._note_end(run)
            kernel.stop()
        return kernel, run

    def _note_end(self, run):
        """Leave out the statement that ended a process; after an end of another kind only the second time.

        Somebody else may have ended it, for example the system, which had no memory left.
        """
        self.note_attempts(run)
        if run.ended == "time" or run.place in self._ended_at:
            self._skip.append(run.place)
        elif run.ended != "gone":
            self._ended_at.add(run.place)

    def _about(self, exercise, run, below):
        """The CellRun of an exercise's answer: its first error, and how it ended."""
        errors, cells = below.errors or run.errors, self._page["cells"]
        self.note_attempts(run)
        self.note_attempts(below)
        own = [
            error
            for number, *error in errors
            if number < len(cells) and cells[number]["exercise"] == exercise.id
        ]
        error = tuple(own[0]) if own else ("", "")
        return CellRun(ended=run.ended or below.ended, error=error, errors=errors)

    def note_attempts(self, run, exercise=""):
        """Note what a CellRun tried: that of a cell of the page, or of the check of an exercise."""
        cells = self._page["cells"]
        for number, text in run.tried[:_MOST_ATTEMPTS]:
            is_of_page = number is not None and number < len(cells)
            attempt = cells[number]["exercise"] if is_of_page else exercise, reproducible_text(text)
            if len(self.tried) < _MOST_ATTEMPTS:
                self.tried[attempt] = None

    def close(self):
        """End the kernel that exercises share."""
        if self._kernel is not None:
            self._kernel.stop()
        self._kernel = None


class ExerciseRun:
    """One exercise of one submission.

    Its checks run one after another in one process, as in JupyterLab. One that ends the process or takes too
    long costs no other check anything: a new process, in which the page has run, takes its place. Each drive
    has a new kernel.
    """

    def __init__(self, exercise, kernels, stop_at=math.inf):
        self.exercise, self._kernels = exercise, kernels  # PageKernels
        self._process, self._seconds, self._answer_run = None, 0.0, CellRun()
        self._drives_too_long = False
        self.stop_at = stop_at  # on time.monotonic(): then no further case is run; robots' time is added
        self.runs = {}  # {case id: CaseRun}
        self.faults = {}  # {case id: text} of the cases that the autograder itself failed to run

    def run(self, case, source):
        if time.monotonic() > self.stop_at or self._drives_too_long:
            run = CaseRun(check=CellRun(ended="budget"))
        else:
            kind = self.exercise.kind
            if not kind.shares_kernel or self._seconds > kind.seconds_of(self.exercise, case):
                self.close()  # the process would have more time than a new one
            was_open = self._process is not None
            run = self._run_once(case, source)
            if run.ended and was_open:
                run = self._run_once(case, source)
            for endings in _RUN_AGAIN_AFTER:
                if run.ended in endings:
                    run = self._run_once(case, source, alone=True)
        if run.ended == "gone":
            self.faults[case.id] = "the process that starts kernels ended, three times"
        else:
            self.runs[case.id] = run
        return run

    def _run_once(self, case, source, *, alone=False):
        """A CaseRun, in a new process if none is open; `alone` is as in `PageKernels.open_check`.

        Only where a name is missing, the cells below count, and the check runs again.
        """
        if self._process is None:
            self._seconds = self.exercise.kind.seconds_of(self.exercise, case)
            opened = self._kernels.open_check(self.exercise, self._seconds, alone=alone)
            self._process, self._answer_run = opened
        process, run = self._process, CaseRun(answer=self._answer_run)
        if not run.ended:
            self._run_check(process, run, case, source)
        if not run.ended and not run.passed and results.missing_name(run)[0]:
            process.run_below("")
            self._run_check(process, run, case, source)
        if run.ended or run.verdict.result.timed_out:
            self.close()
        return run

    def _run_check(self, process, run, case, source):
        """Run a check, perhaps with a partner. What fails in the partner is raised: no answer causes it."""
        exercise = self.exercise
        partner = exercise.kind.partner(exercise, case)
        if partner is None:
            inputs = [encode(call.arguments) for call in case.calls]
            run.check = process.run_check(source, inputs, exercise.time_limit)
            if not run.ended:
                run.verdict = verdict_on(exercise, case, run.check.answers)
        else:
            run.check = process.run_with(source, partner)
            run.told, run.check.answers = run.check.answers, []  # what the kernel showed decides nothing
            self._drives_too_long = run.check.ended == "time" or partner.is_slow
            self.stop_at += partner.seconds
            run.verdict = partner.verdict(case)
        self._kernels.note_attempts(run.check, exercise.id)

    def close(self):
        if self._process is not None:
            self._process.stop()
        self._process = None


def main(descriptor, folder, kernel_factory):
    """The program of an nbval process; the arguments of its command are pytest's."""
    _leave_out_kernels_of_nbval()
    sys.exit(pytest.main(sys.argv[1:], plugins=[GradingPlugin(descriptor, folder, kernel_factory)]))


def _leave_out_kernels_of_nbval():
    """Spare nbval the import of Jupyter's client and of coverage: `ExerciseKernel` replaces its kernel."""
    kernel, cover = types.ModuleType("nbval.kernel"), types.ModuleType("nbval.cover")
    vars(kernel).update(RunningKernel=None, CURRENT_ENV_KERNEL_NAME=None)
    vars(cover).update(setup_coverage=None, teardown_coverage=None)
    sys.modules |= {"nbval.kernel": kernel, "nbval.cover": cover}


class GradingPlugin:
    """The plugin's state: the keys, the kernels, and the socket to `pool.NbvalProcess`."""

    def __init__(self, descriptor, folder, kernel_factory):
        self._connection, self._kernel_factory = socket.socket(fileno=descriptor), kernel_factory
        self._folder = Path(folder)
        self._phases, self._exception = [], None

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session):
        """Grade submissions until the socket is closed, then end this process."""
        self._session = session
        import nbformat  # after `blocked_imports`

        self._send({"ready": True})
        nbformat.validate(nbformat.v4.new_notebook())  # compiles the schema while submissions are read
        with self._kernel_factory:
            for line in self._connection.makefile("r", 1 << 20, encoding="ascii"):
                self._send(results.to_json(self._grade(json.loads(line))))
        os._exit(0)  # the other side waits, and nobody needs what pytest would still do

    def _send(self, message):
        self._connection.sendall((json.dumps(message) + "\n").encode("ascii"))

    def _grade(self, job):
        key = expected_key(job["key"], job["digest"])
        lesson, page = key.lessons[job["lesson"]], job["page"]
        draws = any("matplotlib" in cell["source"] for cell in page["cells"])
        self._kernel_factory.prepare(lesson.code, draws=draws)
        kernels = PageKernels(page, self._kernel_factory)
        graded = [exercise for exercise in lesson.exercises if not exercise.practice]
        found, runs, stop_at = {}, {}, time.monotonic() + self._kernel_factory.limits.submission
        for exercise in kernels.in_order(graded):
            source = page["answers"].get(exercise.id)
            reason = _reason_not_to_run(exercise, source)
            if reason is None and exercise.kind.graded_by_person:
                figure = figure_html(exercise, page, kernels) if exercise.figure else ""
                found[exercise.id] = results.open_exercise(exercise, source, figure)
            elif reason is None:
                runs[exercise.id] = ExerciseRun(exercise, kernels, stop_at)
                self._run_exercise(exercise, source, runs[exercise.id])
                stop_at = runs[exercise.id].stop_at
            else:
                found[exercise.id] = results.ungraded_exercise(exercise, *reason)
        kernels.close()
        runs = {one.id: runs[one.id] for one in graded if one.id in runs}  # in the lesson's order
        found |= results.graded_exercises(runs, page, kernels.tried)
        ordered = tuple(found[one.id] for one in graded)
        return results.GradedSubmission(job["submission"], lesson.name, ordered, tuple(sorted(kernels.tried)))

    def _run_exercise(self, exercise, source, exercise_run):
        self._exercise_kernel = ExerciseKernel(exercise_run)
        path = self._folder / "exercise.ipynb"
        path.write_text(json.dumps(notebook_of(exercise, source)), encoding="utf-8")
        cases = {case.id: case for case in exercise.cases}
        (notebook,) = self._session.config.hook.pytest_collect_file(file_path=path, parent=self._session)
        items = list(notebook.collect())
        for item, next_item in zip(items, [*items[1:], None], strict=True):
            self._exercise_kernel.case = cases.get(item.cell.id)
            self._phases, self._exception = [], None
            item.ihook.pytest_runtest_protocol(item=item, nextitem=next_item)
            let_pass = self._phases == ["setup passed", "call passed", "teardown passed"]
            if item.cell.id in exercise_run.runs:
                exercise_run.runs[item.cell.id].let_fail = not let_pass
            elif item.cell.id in cases:
                exercise_run.faults.setdefault(item.cell.id, self._exception or "nbval did not run it")
            item.cell = None
        notebook.nb = None
        exercise_run.close()

    def pytest_configure(self):
        import nbval.plugin

        nbval.plugin.RunningKernel = lambda *_arguments, **_options: self._exercise_kernel

    def pytest_runtest_logreport(self, report):
        self._phases.append(f"{report.when} {report.outcome}")

    def pytest_assertrepr_compare(self):
        """How nbval describes a difference: nobody reads it, and to show the values takes time."""
        return ["it is not what the solution gives"]

    def pytest_exception_interact(self, call):
        self._exception = f"{call.excinfo.typename}: {call.excinfo.value}"

    def pytest_sessionstart(self, session):
        reporter = session.config.pluginmanager.get_plugin("terminalreporter")
        session.config.pluginmanager.unregister(reporter)  # it keeps a report of every cell


def notebook_of(exercise, answer):
    """An Exercise with an answer as a notebook, plain data of nbformat 4, with a check cell for each case."""
    given = [(f"given-{exercise.id}-{number}", source) for number, source in enumerate(exercise.given, 1)]
    before = [*given, (f"answer-{exercise.id}", answer)]
    cells = [_cell(*parts, ["nbval-ignore-output", "nbval-raises-exception"]) for parts in before]
    check = exercise.kind.check_source(exercise)
    cells += [_cell(case.id, check, [], _stored_outputs(case)) for case in exercise.cases]
    for count, cell in enumerate(cells, 1):
        cell["execution_count"] = count  # nbval never compares a cell without one
    return {"cells": cells, "metadata": {"kernelspec": _KERNEL}, "nbformat": 4, "nbformat_minor": 5}


def _cell(id, source, tags, outputs=()):
    """A code cell; nbval never compares one that is run only for what it defines, by its tags."""
    about = {"cell_type": "code", "id": id, "metadata": {"tags": tags}}
    return about | {"source": source, "outputs": list(outputs)}


def _stored_outputs(case):
    """The output of a check cell, as the solution's; nothing of a drive, which thresholds judge."""
    values = [call.result.value for call in case.calls]
    calls = [{"changed": [], "printed": "", "value": value} for value in values if value is not None]
    return [{"output_type": "display_data", "metadata": {}, "data": {MIME: {"calls": calls}}}]


def _reason_not_to_run(exercise, source):
    """Why an answer is not run, as (Outcome, message); None if it has to run. Its source may be missing."""
    if not isinstance(source, str):
        return Outcome.MISSING, "its answer cell is missing"
    if len(source) > MAX_ANSWER:
        return Outcome.RAISED, ""  # a finding says it
    if source.strip() == exercise.stub.strip() or is_part_of(source, exercise.stub):
        return Outcome.NOT_ATTEMPTED, ""
    return None
