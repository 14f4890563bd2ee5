"""Look at a lesson before it is handed in: is every answer where grading will look for it?"""

import ast
import json
from dataclasses import dataclass, field
from pathlib import Path

from imgproc_course.authoring.masters import find_masters, read_master
from imgproc_course.exercises.checking import run_cases
from imgproc_course.exercises.declaration import MasterError, masters_folders
from imgproc_course.exercises.dependencies import bound_names
from imgproc_course.exercises.feedback import explain_call

LARGEST = 50_000_000  # bytes; a lesson full of pictures has a tenth of it
ANSWERED, UNTOUCHED, BROKEN = "answered", "not attempted", "needs your attention"


@dataclass
class Entry:
    """What was found of one exercise: state is ANSWERED, UNTOUCHED or BROKEN; notes are for the learner."""

    exercise: object
    state: str = ANSWERED
    notes: list = field(default_factory=list)
    source: str = ""
    result: object = None

    def broken(self, note):
        self.state = BROKEN
        self.notes.append(note)


@dataclass
class HandIn:
    """What was found in a learner's notebook.

    entries  one an exercise
    notes    about the whole
    ran      whether the answers were run against their checks
    """

    path: Path
    lesson: str
    entries: list = field(default_factory=list)
    notes: list = field(default_factory=list)
    ran: bool = False

    @property
    def ready(self):
        """True when grading will find every answer, and all are attempted."""
        return all(entry.state == ANSWERED for entry in self.entries if not entry.exercise.practice)


class HandInError(ValueError):
    """A file that is no lesson; the message says why and what to do."""


def look_at(path, folders=None):
    """Look at a learner's notebook, without running anything of it.

    Parameters
    ----------
    path : Path of the notebook
    folders : list of Path, where its master is looked for; as `check` looks for it where left out

    Returns
    -------
    HandIn

    Raises
    ------
    HandInError : no such file, no notebook, or no lesson of any master
    """
    path = Path(path)
    notebook = _read(path)
    master = _master_of(notebook, path, masters_folders() if folders is None else folders)
    cells = [cell for cell in notebook["cells"] if isinstance(cell, dict)]
    found = HandIn(path, master.name)
    _note_version(found, notebook)
    for declared in master.exercises:
        entry = Entry(declared)
        _look_at_answer(entry, cells, master)
        _look_at_shown(entry, cells, master)
        found.entries.append(entry)
    return found


def run_answers(handin):
    """Run the answers against their public cases, each in a namespace of its own, as grading will.

    Parameters
    ----------
    handin : HandIn; each attempted entry gets its `result`
    """
    handin.ran = True
    for entry in handin.entries:
        if entry.state != ANSWERED:
            continue
        declared = entry.exercise
        try:
            function = declared.function_of(entry.source, "your answer")
        except MasterError as error:
            entry.broken(f"its cell does not run by itself: {str(error).split(': ', 1)[1]}")
            continue
        result = run_cases(declared, function)
        if not result.attempted:
            entry.state = UNTOUCHED
            continue
        entry.result = result
        # What is refused comes first: without it, the errors below may not come up at all.
        entry.notes += [
            f"it uses {name}, which this exercise refuses" for name in result.dependencies.refused
        ]
        wrong = [each for each in entry.result.results if not each.passed]
        if wrong:
            story = explain_call(
                wrong[0].failed_call.result, wrong[0].failed_call.difference, declared.function
            )
            entry.notes.append(
                f"{len(wrong)} of {len(entry.result.results)} checks fail: {wrong[0].case.title}: {story}"
            )


def _read(path):
    if path.is_dir():
        lessons = sorted(path.glob("*.ipynb"))
        example = lessons[0] if lessons else "my_lessons/02_images_as_messages.ipynb"
        raise HandInError(f"{path} is a folder; give the lesson itself, such as {example}")
    if not path.is_file():
        raise HandInError(
            f"{path}: no such file; give the lesson that you want to hand in, such as"
            " my_lessons/02_images_as_messages.ipynb"
        )
    if path.stat().st_size > LARGEST:
        megabytes = path.stat().st_size // 1_000_000
        raise HandInError(f"{path}: {megabytes} MB; clear its outputs (Kernel > Restart and Clear), save it")
    if path.suffix != ".ipynb":
        raise HandInError(
            f"{path} is no notebook: its name does not end in .ipynb; give the lesson's own file"
        )
    try:
        notebook = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise HandInError(f"{path} cannot be read: {error.strerror}; change its rights") from error
    except (ValueError, RecursionError) as error:
        what = "the file is empty" if path.stat().st_size == 0 else "its content is no JSON"
        raise HandInError(f"{path} is no notebook: {what}; save it again in JupyterLab") from error
    if not isinstance(notebook, dict) or not isinstance(notebook.get("cells"), list):
        raise HandInError(
            f"{path} is no notebook: it has no list of cells (format 4);"
            " open it in JupyterLab and save it again"
        )
    return notebook


def _master_of(notebook, path, folders):
    about = notebook.get("metadata", {}).get("imgproc_course", {})
    name = about.get("lesson") if isinstance(about, dict) else None
    paths = {found.stem: found for folder in reversed(folders) for found in find_masters(folder)}
    if name not in paths:
        # The file's name is second best: a lesson saved by another program may have lost its metadata.
        name = next((known for known in paths if path.stem.startswith(known)), None)
    if name is None:
        raise HandInError(
            f"{path}: no lesson of this course; the lessons are {', '.join(sorted(paths)) or 'nowhere'}"
        )
    return read_master(paths[name])


def _note_version(found, notebook):
    from importlib.metadata import version

    about = notebook.get("metadata", {}).get("imgproc_course", {})
    made = about.get("version") if isinstance(about, dict) else None
    if made != version("imgproc-course"):
        found.notes.append(
            f"made for version {made or 'unknown'} of the course, this is {version('imgproc-course')}"
        )


def _source(cell):
    source = cell.get("source", "")
    return (
        "".join(source)
        if isinstance(source, list) and all(isinstance(line, str) for line in source)
        else str(source)
    )


def _look_at_answer(entry, cells, master):
    declared = entry.exercise
    id = f"answer-{declared.id}"
    answers = [cell for cell in cells if cell.get("id") == id]
    if not answers:
        where = _defined_elsewhere(declared.function, cells, master)
        hint = (
            f"; {declared.function}() stands in another cell ({where}), which is not graded" if where else ""
        )
        entry.broken(
            f"its answer cell ({id}) is missing{hint}. Take the lesson afresh and copy your function there"
        )
        return
    if len(answers) > 1:
        entry.broken(f"its answer cell ({id}) stands there {len(answers)} times; keep the one that counts")
    cell = answers[0]
    entry.source = _source(cell)
    if cell.get("cell_type") != "code":
        entry.broken(
            f"its answer cell is a {cell.get('cell_type')} cell; make it code again (key Y in command mode)"
        )
    elif not _code_in(entry.source):
        entry.broken("its answer cell is empty")
    elif _is_stub(entry.source, declared):
        entry.state = UNTOUCHED
    else:
        _look_at_source(entry, cells, master)


def _look_at_source(entry, cells, master):
    declared = entry.exercise
    try:
        ast.parse(entry.source)
    except SyntaxError as error:
        text = (error.text or "").strip()
        entry.broken(f"line {error.lineno} of its answer cell is no Python: {text} ({error.msg})")
        return
    if declared.function not in bound_names(entry.source):
        where = _defined_elsewhere(declared.function, cells, master)
        place = f", but cell {where} does, and it is not graded" if where else ""
        entry.broken(f"its answer cell does not define {declared.function}(){place}")


def _look_at_shown(entry, cells, master):
    shown = {cell.get("id"): cell for cell in cells}
    for cell in master.cells:
        if cell.exercise != entry.exercise.id or cell.role not in ("check", "given"):
            continue
        what = "check cell" if cell.role == "check" else "given cell"
        if cell.id not in shown:
            entry.notes.append(f"its {what} ({cell.id}) is missing; grading uses its own")
        elif _source(shown[cell.id]).strip() != cell.source.strip():
            entry.notes.append(f"its {what} ({cell.id}) was changed; grading uses its own")


def _defined_elsewhere(function, cells, master):
    """The id of a learner's cell that defines the function; "" where none does.

    The lesson itself may define a function of the same name, or give another value that name.
    """
    ours = {cell.id for cell in master.cells if _has_def(function, cell.source)}
    for cell in cells:
        id = str(cell.get("id") or "without an id")
        is_code = cell.get("cell_type") == "code"
        if is_code and id not in ours and not id.startswith("answer-") and _has_def(function, _source(cell)):
            return id
    return ""


def _has_def(function, source):
    try:
        statements = ast.parse(source).body
    except SyntaxError:
        return False
    return any(isinstance(each, ast.FunctionDef) and each.name == function for each in statements)


def _code_in(source):
    return any(line.strip() and not line.strip().startswith("#") for line in source.splitlines())


def _is_stub(source, declared):
    if source.strip() == declared.stub.strip():
        return True
    try:
        return ast.dump(ast.parse(source)) == ast.dump(ast.parse(declared.stub))
    except SyntaxError:
        return False


def report_lines(handin):
    """What was found, as lines for a terminal."""
    yield f"{handin.path.name}: {handin.lesson}"
    yield from (f"  note: {note}" for note in handin.notes)
    for entry in handin.entries:
        state = entry.state
        if entry.result is not None:
            passed = sum(each.passed for each in entry.result.results)
            state = f"{passed} of {len(entry.result.results)} checks pass"
        practice = " (practice)" if entry.exercise.practice else ""
        yield f"  {entry.exercise.id}{practice}: {state}"
        yield from (f"      {' '.join(note.split())}" for note in entry.notes)
    failing = any(entry.result is not None and not entry.result.passed for entry in handin.entries)
    if not handin.ready:
        yield "Not ready yet: see above."
    elif failing:
        yield "Complete, but grading would not give every point yet: see above."
    elif handin.ran:
        yield "Ready to hand in: every check passes."
    else:
        yield (
            "Complete: every answer cell is there and filled in. This does not run them;"
            f" `imgproc-course check --run {handin.path}` does."
        )
