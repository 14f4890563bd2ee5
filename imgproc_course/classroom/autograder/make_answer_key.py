"""Make an answer key: run each solution on inputs drawn from a secret seed, in the sandbox that grades.

`answer_key` describes what a key contains, and reads it.
"""

import contextlib
import hashlib
import json
import shutil
from dataclasses import asdict
from importlib.metadata import version
from pathlib import Path

import nbformat
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output
from tqdm import tqdm

from ..authoring.masters import find_masters, read_master
from ..exercises import running
from ..exercises.atomic_write import write_file, write_folder
from ..exercises.check_data import shared_fields
from ..exercises.declaration import MasterError
from ..exercises.drive import LOOK_SECONDS, MEAN_LOOK_SECONDS, looks_of
from ..exercises.input_encoding import decode, encode
from . import answer_key
from .answer_forms import read_answer
from .draw_scenarios import draw_scenario, public_drives
from .drives import CHECK, GradedDrive
from .sandbox import bubblewrap
from .sandbox.inside.answer_mime import MIME
from .sandbox.inside.check_cell import call_to_json
from .sandbox.kernel_factory import KernelFactory
from .verdict import verdict_on

_EMIT_IMPORT = "from imgproc_course.classroom.autograder.sandbox.inside.check_cell import emit"
_PLACEHOLDER = "# the learner's answer"
_SECONDS_PER_EXERCISE, _SECONDS_PER_DRIVE = 2.5, 2.2  # fitted to the course's own lessons


def make_key(masters_dir, seed, out, names=(), *, unsafe=False, replace=False, say=str):
    """Make a Key: run each solution on inputs drawn from the seed, in the sandbox that grades.

    The folder is written whole at the end: an error or Ctrl-C leaves the old key unchanged, and the next call
    with the same seed goes on after the exercises that are finished. The key does not contain the seed.
    `names` are lessons, as `find_masters` takes them, all if empty; `unsafe` runs without a sandbox;
    `replace` replaces an existing key; `say` takes a line that tells how long it takes.

    MasterError: a solution fails, or inputs cannot be sent to a kernel as data; names lesson and case.
    KeyFolderError: there is a key already, or the folder cannot be written. SandboxError: no sandbox here.
    """
    out = Path(out)
    if out.exists() and not replace and (not out.is_dir() or any(out.iterdir())):
        raise answer_key.KeyFolderError(
            f"{out}: it exists already, and grades may depend on it: choose another folder, or use --replace"
        )
    if not unsafe:
        bubblewrap.require_sandbox()
    masters = [read_master(path) for path in find_masters(masters_dir, names)]
    solutions = {exercise.id: exercise.solution for master in masters for exercise in master.exercises}
    files = {
        answer_key.HANDED_OUT: _dumps({master.name: master.handed_out for master in masters}),
        answer_key.SOLUTIONS: json.dumps(solutions, indent=1, sort_keys=True),
    }
    unfinished = out.with_name(f"{out.name}.unfinished")
    jobs = _jobs(masters, seed, unfinished, unsafe)
    seconds = [_seconds_of(exercise) for path, (_, exercise, _) in jobs.values() if not path.exists()]
    minutes = max(1, round(sum(seconds) / 60))
    say(f"{len(seconds)} of {len(jobs)} exercises to run, about {minutes} min on two quiet cores.")
    unfinished.mkdir(mode=0o700, parents=True, exist_ok=True)
    with KernelFactory(unsafe=unsafe) as kernel_factory:
        files |= _key_files(masters, jobs, kernel_factory)
    try:
        write_folder(out, files, permissions=0o700)
    except OSError as error:
        raise answer_key.KeyFolderError(f"{out}: cannot be written ({error})") from error
    shutil.rmtree(unfinished)
    return answer_key.load_key(out)


def _jobs(masters, seed, folder, unsafe):
    """{exercise id: (the file that keeps its part of the key, the arguments of what makes it)}."""
    jobs, own_seed = {}, _numpy_seed(seed)
    for master in masters:
        text = master.path.read_text(encoding="utf-8")
        for exercise in master.exercises:
            about = repr([text, exercise.id, exercise.mistakes, own_seed, unsafe, version("imgproc-course")])
            path = folder / f"{hashlib.sha256(about.encode()).hexdigest()}.json"
            jobs[exercise.id] = path, (master, exercise, own_seed)
    return jobs


def _seconds_of(exercise):
    """About how long an exercise takes on two quiet cores."""
    drives = len(exercise.cases) * (1 + len(exercise.mistakes)) if exercise.subject == "drive" else 0
    return 0 if exercise.practice else _SECONDS_PER_EXERCISE + _SECONDS_PER_DRIVE * drives


def _key_files(masters, jobs, kernel_factory):
    """{relative name: text} of the exercises, and of key.json."""
    missing = [job for job in jobs.values() if not job[0].exists()]
    # Each one as often as it takes seconds: so the bar knows how much time is left.
    seconds = [job for job in missing for _ in range(1 + round(_seconds_of(job[1][1])))]
    for path, job in tqdm(seconds, desc="key", unit=" s", smoothing=0, delay=2, leave=False):
        if not path.exists():
            write_file(path, json.dumps(_ExerciseKeyMaker(*job, kernel_factory).part()), permissions=0o600)
    parts = {id: json.loads(path.read_text(encoding="utf-8")) for id, (path, _) in jobs.items()}
    files = {name: text for part in parts.values() for name, text in part["files"].items()}
    lessons = [_lesson_entry(master, parts) for master in masters]
    return files | {"key.json": _dumps({"format": answer_key.FORMAT, "lessons": lessons})}


def _dumps(content):
    return json.dumps(content, indent=1, sort_keys=True) + "\n"


def _numpy_seed(seed):
    """A seed for NumPy: a phrase is as good as a number, and harder to guess."""
    return int.from_bytes(hashlib.sha256(f"imgproc-course {seed}".encode()).digest()[:16])


def _lesson_entry(master, parts):
    return shared_fields(master, answer_key.KeyLesson) | {
        "version": version("imgproc-course"),
        "digest": hashlib.sha256(master.path.read_bytes()).hexdigest(),
        "exercises": [parts[exercise.id]["entry"] for exercise in master.exercises],
    }


class _ExerciseKeyMaker:
    """Makes the key's part of one exercise."""

    def __init__(self, master, exercise, seed, kernel_factory):
        self._master, self._exercise = master, exercise
        self._seed, self._kernel_factory = seed, kernel_factory
        self._cases = () if exercise.practice else exercise.cases
        self._drawn = dict(self._drawn_scenarios()) if exercise.subject == "drive" else {}
        self._inputs = {case.id: self._encoded_inputs(case) for case in self._cases}

    def _drawn_scenarios(self):
        """(id of a case, its DrawnScenario) of an exercise that drives."""
        exercise, cases, drive = self._exercise, self._cases, self._drive_solution
        least = len(cases) * (1 + len(exercise.mistakes))
        with tqdm(total=least, desc=exercise.id, unit=" drives", delay=2, leave=False) as bar:
            public = list(public_drives(exercise)) if cases else []
            for case in cases:
                yield case.id, draw_scenario(exercise, case, self._seed, drive, public, bar.update)

    def _drive_solution(self, scenario):
        """The record of the solution's drive, in a kernel like those that grade."""
        exercise = self._exercise
        robot = GradedDrive(exercise.sensors, scenario)
        seconds = MEAN_LOOK_SECONDS * looks_of(scenario)
        subject = f"{exercise.master.name}: the solution of {exercise.id}"
        with self._kernel_after_solution(seconds, subject) as (kernel, check):
            _require_run(kernel.run_drive(check, robot, seconds, LOOK_SECONDS), subject)
        return robot.verdict().record

    @contextlib.contextmanager
    def _kernel_after_solution(self, seconds, subject):
        """A kernel like those that grade, which has run the solution, and the source of the check cell."""
        exercise = self._exercise
        kernel = self._kernel_factory.start(exercise.allowed, seconds)
        try:
            for source in (*exercise.given, exercise.solution):
                _require_run(kernel.run(source), subject)
            yield kernel, check_source(exercise)
        finally:
            kernel.stop()

    def part(self):
        """The key's part of the exercise, plain data."""
        return {"entry": self._entry(), "files": {} if self._exercise.practice else self._files()}

    def _entry(self):
        """The exercise's entry in key.json; a practice exercise has no cases there."""
        exercise = self._exercise
        mistakes = () if exercise.practice else exercise.mistakes
        solution = exercise.function_of(exercise.solution, "solution")
        own_fields = {
            "points": sum(case.points for case in self._cases),
            "arguments": tuple(running.argument_names(solution, exercise.subject)),
            "cases": tuple(map(self._key_case, self._cases)),
            "mistakes": tuple(answer_key.KeyMistake(mistake.name, mistake.says) for mistake in mistakes),
        }
        return asdict(answer_key.KeyExercise(**shared_fields(exercise, answer_key.KeyExercise) | own_fields))

    def _files(self):
        """{relative name: text} of a graded exercise's files."""
        exercise = self._exercise
        payloads = {case.id: self._solution_payload(case) for case in exercise.cases}
        mistakes = {
            mistake.name: {case.id: self._calls_of(mistake, case) for case in exercise.cases}
            for mistake in exercise.mistakes
        }
        prefix = f"{self._master.name}/{exercise.id}"
        return {
            f"{prefix}.ipynb": nbformat.writes(self._notebook(payloads)) + "\n",
            f"{prefix}.inputs.json": json.dumps(self._inputs, sort_keys=True) + "\n",
            f"{prefix}.mistakes.json": json.dumps(mistakes, sort_keys=True) + "\n",
        }

    def _key_case(self, case):
        drawn = self._drawn.get(case.id)
        calls = looks_of(drawn.scenario) if drawn else len(self._inputs[case.id])
        return answer_key.KeyCase(**shared_fields(case, answer_key.KeyCase) | {"calls": calls})

    def _encoded_inputs(self, case):
        exercise = self._exercise
        if case.id in self._drawn:
            return [encode((self._drawn[case.id].scenario,))]
        try:
            return [encode(arguments) for arguments in exercise.arguments(case, self._seed)]
        except TypeError as error:
            raise MasterError(
                f"{exercise.master.name}, line {case.line}: {case.id}: {error}; or make the exercise"
                " practice=True"
            ) from error

    def _solution_payload(self, case):
        """What the solution's check cell shows, in a kernel like those that grade."""
        if case.id in self._drawn:
            return {"calls": [], "metrics": self._drawn[case.id].record["metrics"]}
        exercise, inputs = self._exercise, self._inputs[case.id]
        subject = f"{exercise.master.name}, {case.id}: the solution"
        with self._kernel_after_solution(exercise.time_limit * len(inputs), subject) as (kernel, check):
            run = kernel.run_check(check, inputs, exercise.time_limit)
            _require_run(run, subject)
        calls = read_answer(run.answers)
        if calls is None:
            raise MasterError(f"{subject} shows no values")
        for call in calls:
            problem = _comparison_problem(call)
            if problem:
                raise MasterError(f"{subject} returns nothing that can be compared: {problem}")
        expected = [call.value for call in calls]
        if not verdict_on(run.answers, expected, case.tolerance, exact_type=True).passed:
            raise MasterError(f"{subject} does not equal itself")
        return {"calls": [call_to_json(call) for call in calls]}

    def _calls_of(self, mistake, case):
        exercise = self._exercise
        if case.id in self._drawn:
            return [call_to_json(self._drawn[case.id].mistakes[mistake.name])]
        function = exercise.function_of_mistake(mistake)
        names = running.argument_names(function, exercise.subject)
        how = exercise.time_limit, exercise.subject
        inputs = map(decode, self._inputs[case.id])
        return [call_to_json(running.call(function, arguments, names, *how)) for arguments in inputs]

    def _notebook(self, payloads):
        exercise = self._exercise
        cells = [new_markdown_cell(f"# {exercise.title}", id=f"{exercise.id}-title"[:64])]
        for number, source in enumerate(exercise.given, 1):
            cells.append(_code_cell(f"given-{exercise.id}-{number}", source, len(cells), compared=False))
        cells.append(_code_cell(f"answer-{exercise.id}", _PLACEHOLDER, len(cells), compared=False))
        for case in exercise.cases:
            cell = _code_cell(case.id, check_source(exercise), len(cells))
            cell.outputs = [new_output("display_data", {MIME: payloads[case.id]})]
            cells.append(cell)
        kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
        origin = {"exercise": exercise.id, "version": version("imgproc-course")}
        return new_notebook(cells=cells, metadata={"kernelspec": kernel, "imgproc_course": origin})


def _require_run(run, subject):
    if run.ended or run.error[0]:
        raise MasterError(f"{subject} fails in grading: {run.ended} {': '.join(run.error)}".strip())


def check_source(exercise):
    """The source of an exercise's check cells."""
    if exercise.subject == "drive":
        return CHECK.format(function=exercise.function)
    subject = "" if exercise.subject == "function" else f', "{exercise.subject}"'
    return f"{_EMIT_IMPORT}\n\nemit({exercise.function}{subject})"


def _code_cell(id, source, count, *, compared=True):
    """A cell that has been run; nbval never compares a cell that is run only for what it defines."""
    tags = [] if compared else ["nbval-ignore-output", "nbval-raises-exception"]
    return new_code_cell(source, id=id, execution_count=count, metadata={"tags": tags} if tags else {})


def _comparison_problem(call):
    """Why a call of the solution gives nothing to compare with, "" if it does."""
    if call.timed_out:
        return "it does not finish in time"
    if call.error:
        return f"{call.error}: {call.message}" if call.message else call.error
    if call.changed:
        return f"it changes its input {', '.join(call.changed)}"
    return "" if _is_whole(call.value) else f"a value of type {call.value['type']}"


def _is_whole(form):
    """Whether a form holds the whole value, not only its type."""
    entries = [*form.get("items", ()), *form.get("fields", {}).values()]
    parts = [part for entry in entries for part in (entry if isinstance(entry, list) else [entry])]
    return not form.get("opaque") and not form.get("too_large") and all(map(_is_whole, parts))
