"""Grade the same submissions with our command and with nbgrader's, each as a teacher types it, in one run.

One worker is compared with one nbgrader process, and two workers with two processes that share the
submissions. `imgproc-course grade --fresh` always writes the pages of feedback; so it is compared with
`nbgrader autograde` alone, and with `autograde` and `generate_feedback`. The time is that of whole commands,
with their start; ours runs before, between and after nbgrader's, and the median counts, because a machine is
not equally busy all the time. Beside it stands the processor time of all processes, which other programs
disturb less; it needs root and control groups of version 1. No two submissions are alike. nbgrader has an
environment of its own (environment/requirements-nbgrader.txt; the first run makes it in ~/.cache or
$NBGRADER_VENV). With `--growth 1000` the benchmark then grades so many submissions and prints time and memory
on the way.

    .venv/bin/python tests/benchmarks/bench_grading.py [--lesson NAME] [--submissions 20] [--workers 1]
        [--growth 1000]
"""

import atexit
import contextlib
import json
import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import click
import nbformat
import numpy as np
import psutil
from nbclassroom.authoring.masters import find_masters, read_master
from nbclassroom.autograder.make_answer_key import make_key
from nbclassroom.autograder.pool import autograde, usual_workers
from nbclassroom.exercises import array_of, read_exercises
from platformdirs import user_cache_path
from rich.console import Console
from rich.table import Table

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests" / "classroom" / "gradebook"))
from submissions import notebook, sample_answers, write  # noqa: E402

MASTERS = ROOT / "notebooks" / "masters"
BUDGET = 10.0  # times faster than nbgrader: one worker against one process, autograde alone


def nbgrader_venv():
    """The folder of nbgrader's environment; it is made if it is missing."""
    folder = Path(os.environ.get("NBGRADER_VENV") or user_cache_path("imgproc-course") / "nbgrader")
    if not (folder / "bin" / "nbgrader").exists():
        print(f"Making nbgrader's environment in {folder} ...")
        subprocess.run([sys.executable, "-m", "venv", str(folder)], check=True)
        requirements = ROOT / "environment" / "requirements-nbgrader.txt"
        pip = [str(folder / "bin" / "python"), "-m", "pip", "install", "-q", "--require-hashes"]
        subprocess.run([*pip, "-r", str(requirements)], check=True)
    return folder


def answers_of(lesson, count):
    """Generated submissions: the k-th one answers each exercise with the k-th of its sample answers."""
    (path,) = find_masters(MASTERS, [lesson])
    exercises = [exercise for exercise in read_exercises(path) if not exercise.practice]
    samples = {exercise.id: list(sample_answers(exercise).values()) for exercise in exercises}
    for k in range(count):
        answers = {
            id: f"{sources[0 if k % 2 else (k // 2 + shift) % len(sources)]}\n# student{k:04d}"
            for shift, (id, sources) in enumerate(samples.items())
        }
        yield f"student{k:04d}", lesson, answers


# ---------------------------------------------------------------- the same work for nbgrader


def _cell(source, name, **options):
    metadata = {"schema_version": 3, "grade_id": name, "grade": False, "solution": False, "locked": False}
    metadata |= {"task": False} | options
    return nbformat.v4.new_code_cell(source, metadata={"nbgrader": metadata})


def nbgrader_notebook(key, lesson, answers=None):
    """The lesson's exercises as an nbgrader assignment; the checks contain inputs and expected values."""
    cells = [nbformat.v4.new_code_cell("import numpy as np\nfrom types import SimpleNamespace")]
    for exercise in key.lessons[lesson].exercises:
        if exercise.practice:
            continue
        cells += map(nbformat.v4.new_code_cell, exercise.given)
        source = answers[exercise.id] if answers else exercise.stub
        # nbgrader also runs what is beside a declaration, but its environment has no course installed.
        source = source.replace(
            "from imgproc_course.exercises import exercise", "exercise = lambda *a, **k: 0"
        )
        cells.append(_cell(source, f"answer-{exercise.id}", solution=True))
        for case in exercise.cases:
            tests = [
                f"_same({exercise.function}(*{_literal(call.arguments)}),"
                f" {_literal(_value(call.result.value))}, {case.tolerance}, {exercise.exact_type})"
                for call in case.calls
            ]
            cells.append(
                _cell("\n".join([_SAME, *tests]), case.id, grade=True, locked=True, points=case.points)
            )
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return nbformat.v4.new_notebook(cells=cells, metadata={"kernelspec": kernel})


# nbgrader's tests accept what `exercises.compare` accepts of numbers and arrays, so that points agree.
_SAME = """def _same(actual, expected, tolerance, exact_type):
    if isinstance(expected, (tuple, list)):
        kinds = (type(expected),) if exact_type else (tuple, list)
        if not exact_type and not any(isinstance(item, np.ndarray) for item in expected):
            kinds += (np.ndarray,)
        assert isinstance(actual, kinds) and len(actual) == len(expected)
        for one, other in zip(actual, expected):
            _same(one, other, tolerance, exact_type)
        return
    kind = np.asarray(actual).dtype
    assert (kind == bool) == (np.asarray(expected).dtype == bool)
    if exact_type:
        assert isinstance(actual, np.ndarray) == isinstance(expected, np.ndarray)
        assert not isinstance(expected, np.ndarray) or kind == expected.dtype
    elif np.ndim(expected) == 0 and isinstance(actual, np.ndarray):
        actual = actual.item()
    assert np.shape(actual) == np.shape(expected)
    rounding = 1e-5 if kind == np.float32 else 1e-9
    np.testing.assert_allclose(actual, expected, rtol=rounding, atol=tolerance)
"""


def _value(form):
    array = array_of(form)
    if array is not None:
        return array
    if "items" in form:
        items = [_value(item) for item in form["items"]]
        return tuple(items) if form["type"] == "tuple" else items
    value = form["value"]
    return float(value) if form["type"].endswith(("float", "float64")) else value


def _literal(value):
    """Source for a value; a tuple of arguments too."""
    if isinstance(value, np.ndarray):
        return f"np.array({value.tolist()!r}, dtype='{value.dtype.str}').reshape({value.shape})"
    if isinstance(value, (tuple, list)):
        inner = "".join(f"{_literal(item)}, " for item in value)
        return f"({inner})" if isinstance(value, tuple) else f"[{inner}]"
    if isinstance(value, np.generic):
        return f"np.{value.dtype.name}({value.item()!r})"
    if isinstance(value, float):
        return f"float('{value!r}')"
    return repr(value) if not hasattr(value, "__dict__") else _namespace(value)


def _namespace(value):
    return f"SimpleNamespace({', '.join(f'{name}={_literal(item)}' for name, item in vars(value).items())})"


def prepare_nbgrader(venv, folder, key, lesson, submissions):
    """Make a course with the released assignment and the submissions."""
    source = folder / "source" / "ps1"
    source.mkdir(parents=True)
    nbformat.write(nbgrader_notebook(key, lesson), source / "lesson.ipynb")
    (folder / "nbgrader_config.py").write_text(
        f"c = get_config()\nc.CourseDirectory.root = {str(folder)!r}\nc.Execute.timeout = 60\n",
        encoding="utf-8",
    )
    run_nbgrader(venv, folder, "generate_assignment", "ps1")
    released = nbformat.read(folder / "release" / "ps1" / "lesson.ipynb", as_version=4)
    for name, _, answers in submissions:
        notebook = nbgrader_notebook(key, lesson, answers)
        for cell, released_cell in zip(notebook.cells, released.cells, strict=True):
            if not cell.metadata.get("nbgrader", {}).get("solution"):
                cell.source = released_cell.source
            cell.metadata, cell.id = released_cell.metadata, released_cell.id
        submission = folder / "submitted" / name / "ps1"
        submission.mkdir(parents=True)
        nbformat.write(notebook, submission / "lesson.ipynb")


def run_nbgrader(venv, folder, *arguments):
    """Run one nbgrader command; nbgrader calls alembic by its bare name, so it needs the PATH."""
    environment = os.environ | {"PATH": f"{venv / 'bin'}{os.pathsep}{os.environ['PATH']}", "PYTHONPATH": ""}
    completed = subprocess.run(
        [str(venv / "bin" / "nbgrader"), *arguments],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        preexec_fn=PROCESSOR_TIME.enter,
    )
    if completed.returncode:
        raise SystemExit(f"nbgrader {' '.join(arguments)} failed:\n{completed.stderr[-3000:]}")


def nbgrader_points(venv, folder):
    """{student: points}, from nbgrader's gradebook."""
    run_nbgrader(venv, folder, "export")
    lines = [line.split(",") for line in (folder / "grades.csv").read_text().splitlines()]
    student, score = lines[0].index("student_id"), lines[0].index("raw_score")
    return {line[student]: float(line[score]) for line in lines[1:]}


# ---------------------------------------------------------------- measuring


class ProcessorTime:
    """A control group that counts the processor time of the commands and of all that they start."""

    def __init__(self):
        self._folder = Path(f"/sys/fs/cgroup/cpuacct/bench-grading-{os.getpid()}")
        try:
            self._folder.mkdir()
        except OSError:
            self._folder = None

    def enter(self):
        """Put this process into the group."""
        if self._folder:
            (self._folder / "cgroup.procs").write_text(str(os.getpid()), encoding="ascii")

    def seconds(self):
        """Seconds until now; not a number without a group."""
        return int((self._folder / "cpuacct.usage").read_text()) / 1e9 if self._folder else float("nan")

    def remove(self):
        """Remove the group; processes that a command left may be ending."""
        if self._folder:
            with contextlib.suppress(OSError):
                self._folder.rmdir()


PROCESSOR_TIME = ProcessorTime()
atexit.register(PROCESSOR_TIME.remove)


def measured(function):
    """Wall seconds and processor seconds of a call that runs commands, as an array."""
    start = np.array([time.perf_counter(), PROCESSOR_TIME.seconds()])
    function()
    return np.array([time.perf_counter(), PROCESSOR_TIME.seconds()]) - start


def write_submissions(folder, lesson, submissions):
    """Write the submissions as learners hand them in: one folder each, with the lesson."""
    (path,) = find_masters(MASTERS, [lesson])
    master = read_master(path)
    for name, _, answers in submissions:
        write(folder / name / f"{path.stem}.ipynb", notebook(master, answers))


def grade_with_ours(folder, key, workers):
    """Run our command; returns {student: points}."""
    command = [str(Path(sys.executable).with_name("imgproc-course")), "grade", str(folder / "submissions")]
    command += ["--key", str(key.path), "--out", str(folder / "grades"), "--workers", str(workers), "--fresh"]
    completed = subprocess.run(command, capture_output=True, text=True, preexec_fn=PROCESSOR_TIME.enter)
    if completed.returncode not in (0, 3):
        raise SystemExit(completed.stderr)
    grades = json.loads((folder / "grades" / "grades.json").read_text(encoding="utf-8"))
    return {learner["name"]: learner["points"] for learner in grades["learners"]}


def in_parallel(venv, courses, *arguments):
    """Run one nbgrader command in several courses at once."""
    with ThreadPoolExecutor(len(courses)) as threads:
        list(threads.map(lambda course: run_nbgrader(venv, course, *arguments), courses))


def side_by_side(venv, folder, key, lesson, count, workers):
    """Grade the same submissions with both, whole commands after another.

    Returns
    -------
    ({name of the command: (wall, processor) seconds}, our points, nbgrader's points)
    """
    submissions = list(answers_of(lesson, count))
    write_submissions(folder / "submissions", lesson, submissions)
    courses = [folder / f"course-{number}" for number in range(workers)]
    for number, course in enumerate(courses):
        prepare_nbgrader(venv, course, key, lesson, submissions[number::workers])
    points = {}

    def ours():
        return measured(lambda: points.update(grade_with_ours(folder, key, workers)))

    def theirs(command):
        return measured(lambda: in_parallel(venv, courses, command, "ps1"))

    turns = [ours(), theirs("autograde"), ours(), theirs("generate_feedback"), ours()]
    seconds = {"grade": np.median(turns[::2], axis=0), "autograde": turns[1], "feedback": turns[1] + turns[3]}
    nbgrader = {}
    for course in courses:
        nbgrader |= nbgrader_points(venv, course)
    return seconds, points, nbgrader


def growth(key, lesson, count):
    """Print time and memory while many submissions are graded, with as many workers as `grade` takes."""
    table = Table("submissions", "s", "ms each", "MB, all processes", title="growth", title_justify="left")
    marks = sorted({count // 10, count // 4, count // 2, count})
    start = time.perf_counter()
    workers = usual_workers(key.lessons.values())
    for number, _ in enumerate(autograde(answers_of(lesson, count), key, workers=workers), 1):
        if number in marks:
            seconds = time.perf_counter() - start
            table.add_row(str(number), f"{seconds:.1f}", f"{seconds / number * 1000:.0f}", f"{_memory():.0f}")
    Console(width=110).print(table)


def _memory():
    this_process = psutil.Process()
    total = 0
    for process in [this_process, *this_process.children(recursive=True)]:
        try:
            total += process.memory_full_info().pss
        except psutil.Error:
            continue  # a kernel that has just ended
    return total / 1e6


@click.command()
@click.option("--lesson", default="canny_stages", help="Which lesson's exercises.")
@click.option("--submissions", default=20, help="How many are compared; 0: none.")
@click.option("--workers", multiple=True, default=(1, 2), help="Of ours, and as many nbgrader processes.")
@click.option("--growth", "many", default=0, help="Then grade so many, and show time and memory.")
def main(lesson, submissions, workers, many):
    with tempfile.TemporaryDirectory(prefix="bench-") as folder:
        folder = Path(folder)
        key = make_key(MASTERS, "benchmark", folder / "key", [lesson])
        (name,) = key.lessons
        ratios = [
            compare_speed(folder / str(count), key, name, submissions, count)
            for count in workers
            if submissions
        ]
        if many:
            growth(key, name, many)
    if ratios:
        print(f"budget {BUDGET:g}: {'met' if ratios[0] >= BUDGET else 'MISSED'}")
    raise SystemExit(0 if not ratios or ratios[0] >= BUDGET else 1)


def compare_speed(folder, key, name, count, workers):
    """Print both side by side; returns how many times as fast as `nbgrader autograde` our command is."""
    seconds, points, nbgrader = side_by_side(nbgrader_venv(), folder, key, name, count, workers)
    differing = sorted(student for student in points if points[student] != nbgrader.get(student))
    title = f"{name}, {count} submissions, {workers} at once"
    columns = ["whole command", "s", "ours is faster ×", "processor s", "ours needs less ×"]
    table = Table(*columns, title=title)
    rows = {
        "nbgrader autograde": "autograde",
        "nbgrader autograde + generate_feedback": "feedback",
        f"imgproc-course grade --workers {workers}, with pages": "grade",
    }
    ours = seconds["grade"]
    for label, command in rows.items():
        (wall, processor), (ratio, processor_ratio) = seconds[command], seconds[command] / ours
        table.add_row(label, *(f"{value:.1f}" for value in (wall, ratio, processor, processor_ratio)))
    Console(width=110).print(table)
    print(f"points agree for {count - len(differing)} of {count}; differ: {differing}")
    return seconds["autograde"][0] / ours[0]


if __name__ == "__main__":
    main()
