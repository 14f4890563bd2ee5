"""Make an answer key; `answer_key` describes what a key contains, and reads it."""

import contextlib
import hashlib
import json
import multiprocessing
import shutil
import signal
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from functools import partial
from multiprocessing.util import Finalize
from pathlib import Path
from typing import Any

from tqdm import tqdm

from .. import course
from ..authoring.lesson_files import exercise_files, stored_exercise
from ..authoring.masters import find_masters, read_master
from ..exercises.atomic_write import write_file, write_folder
from ..exercises.canonical import encode
from ..exercises.lesson import ExpectedCall, with_results
from ..exercises.percent_script import MasterError
from ..exercises.running import explain_call
from . import answer_key
from .sandbox import bubblewrap
from .sandbox.fork_server_client import KernelFactory
from .sandbox.inside.check_cell import call_to_json
from .verdict import read_answer, read_call

_SECONDS_PER_EXERCISE = 1.6  # while two run, fitted to the course's own lessons
_AT_A_TIME = 2
_process: dict[str, Any] = {}  # what `_begin` gives a process that runs exercises


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
        problem = "it exists already, and grades may depend on it"
        raise answer_key.KeyFolderError(f"{out}: {problem}: choose another folder, or use --replace")
    if not unsafe:
        bubblewrap.require_sandbox()
    masters = [read_master(path) for path in find_masters(masters_dir, names)]
    unfinished = out.with_name(f"{out.name}.unfinished")
    jobs = _jobs(masters, seed, unfinished, unsafe)
    missing = sorted((job for job in jobs if not job[1].exists()), key=lambda job: -_seconds_of(job[0]))
    minutes = max(1, round(sum(_seconds_of(exercise) for exercise, _ in missing) / 60))
    say(f"{len(missing)} of {len(jobs)} exercises to run, about {minutes} min on two quiet cores.")
    unfinished.mkdir(mode=0o700, parents=True, exist_ok=True)
    _run(missing, _numpy_seed(seed), unsafe)
    stored = {exercise.id: json.loads(path.read_text(encoding="utf-8")) for exercise, path in jobs}
    files: dict = {}
    for master in masters:
        own = {exercise.id: stored[exercise.id] for exercise in master.exercises}
        code = [cell.source for cell in master.cells if cell.kind == "code"]
        files |= exercise_files(master, own, number=master.number, title=master.title, code=code)
    try:
        write_folder(out, files, permissions=0o700)
    except OSError as error:
        raise answer_key.KeyFolderError(f"{out}: cannot be written ({error})") from error
    shutil.rmtree(unfinished)
    return answer_key.load_key(out)


def _jobs(masters, seed, folder, unsafe):
    """[(an Exercise, the file that keeps its stored form)]."""
    jobs = []
    for master in masters:
        text = master.path.read_text(encoding="utf-8")
        for exercise in master.exercises:
            about = [text, exercise.id, exercise.mistakes, _numpy_seed(seed), unsafe]
            digest = hashlib.sha256(repr([*about, course.release()]).encode())
            jobs.append((exercise, folder / f"{digest.hexdigest()}.exercise.json"))
    return jobs


def _seconds_of(exercise):
    """About how long an exercise takes on two quiet cores."""
    return 0 if exercise.practice else _SECONDS_PER_EXERCISE + exercise.kind.seconds_for_key(exercise)


def _run(missing, *begin_arguments):
    """Keep the stored form of each exercise whose file is missing; two at a time, in this order."""
    # Forked, because an exercise has functions, which cannot be sent to a process.
    context = multiprocessing.get_context("fork")
    with ProcessPoolExecutor(_AT_A_TIME, context, _begin, (missing, *begin_arguments)) as executor:
        seconds = {executor.submit(_keep, n): 1 + _seconds_of(job[0]) for n, job in enumerate(missing)}
        form = "key: {percentage:3.0f}%|{bar}| {elapsed}, {remaining} left"
        try:
            with tqdm(total=sum(seconds.values()), bar_format=form, smoothing=0, leave=False) as bar:
                running = set(seconds)
                while running:
                    done, running = wait(running, timeout=1, return_when=FIRST_COMPLETED)
                    bar.update(sum(seconds[future] for future in done if future.result() is None))
                    bar.refresh()  # the time
        except BaseException as error:
            for process in multiprocessing.active_children():
                process.terminate()
            if isinstance(error, BrokenProcessPool):
                raise MasterError("a process was killed (no memory?); run the command again") from error
            raise


def _begin(missing, seed, unsafe):
    """In a process that runs exercises; Ctrl-C ends it without a word."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    stack = contextlib.ExitStack()
    Finalize(None, stack.close, exitpriority=1)
    kernel_factory = stack.enter_context(KernelFactory(unsafe=unsafe))
    _process.update(missing=missing, seed=seed, kernel_factory=kernel_factory)


def _keep(number):
    exercise, path = _process["missing"][number]
    if exercise.practice:
        exercise = replace(exercise, cases=(), mistakes=())
    drawn = exercise.kind.draw_for_key(exercise, _process["seed"], partial(_record_with, exercise))
    solved = with_results(exercise, exercise.cases, partial(_solve, drawn), _results_of)
    write_file(path, json.dumps(stored_exercise(solved)), permissions=0o600)


def _numpy_seed(seed):
    """A seed for NumPy: a phrase is as good as a number, and harder to guess."""
    return int.from_bytes(hashlib.sha256(f"{course.command} {seed}".encode()).digest()[:16])


def _record_with(exercise, partner):
    """The record of what the solution's check talks to, in a kernel like those that grade."""
    about = f"{exercise.master.name}: the solution of {exercise.id}"
    with _kernel_after_solution(exercise, partner.cpu_seconds, about) as kernel:
        _require_run(kernel.run_with(exercise.kind.check_source(exercise), partner), about)
    return partner.record()


@contextlib.contextmanager
def _kernel_after_solution(exercise, seconds, about):
    """A kernel like those that grade, which has run the solution."""
    kernel = _process["kernel_factory"].start(exercise.allowed, seconds)
    try:
        for source in (*exercise.given, exercise.solution):
            _require_run(kernel.run(source), about)
        yield kernel
    finally:
        kernel.stop()


def _solve(known, exercise, case):
    """The ExpectedCalls of a case, known or as the solution's check cell shows them in such a kernel."""
    if case.id in known:
        return known[case.id]
    drawn = exercise.arguments(case, _process["seed"])
    about = f"{exercise.master.name}, {case.id}: the solution"
    try:
        inputs = [encode(arguments) for arguments in drawn]
    except TypeError as error:
        place = f"{exercise.master.name}, line {case.line}: {case.id}"
        raise MasterError(f"{place}: {error}; or make the exercise practice=True") from error
    with _kernel_after_solution(exercise, exercise.time_limit * len(inputs), about) as kernel:
        run = kernel.run_check(exercise.kind.check_source(exercise), inputs, exercise.time_limit)
        _require_run(run, about)
    calls = read_answer(run.answers)
    if calls is None:
        raise MasterError(f"{about} shows no values")
    for call in calls:
        if not call.finished or call.changed:
            raise MasterError(f"{about} fails. {explain_call(call, None, exercise.answer_name)}")
        if not _is_whole(call.value):
            kind = call.value["type"]
            raise MasterError(f"{about} returns nothing that can be compared: a value of type {kind}")
    expected = [*map(ExpectedCall, drawn, calls)]
    if not all(exercise.judge(case, one, one.result).passed for one in expected):
        raise MasterError(f"{about} does not equal itself")
    return expected


def _results_of(exercise, mistake, cases):
    results = {case.id: exercise.results_of_mistake(mistake, case) for case in cases}
    # As a check cell would show them: answers are compared with them.
    return {id: [read_call(call_to_json(call)) for call in calls] for id, calls in results.items()}


def _require_run(run, about):
    if run.ended or run.error[0]:
        raise MasterError(f"{about} fails in grading: {run.ended} {': '.join(run.error)}".strip())


def _is_whole(form):
    """Whether a form holds the whole value, not only its type."""
    entries = [*form.get("items", ()), *form.get("fields", {}).values()]
    parts = [part for entry in entries for part in (entry if isinstance(entry, list) else [entry])]
    return not form.get("opaque") and not form.get("too_large") and all(map(_is_whole, parts))
