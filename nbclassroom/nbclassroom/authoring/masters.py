"""Read masters: a master is the one source of a lesson, its solved twin and its grading.

It is a percent script, `notebooks/masters/NN_name.py`: ordinary Python, with *roles* in the headers of its
cells. docs/teach/masters.md describes the format, and `new_lesson.py.txt` beside this module is a whole one.
questions.toml beside the masters has questions that come back, with which lessons open.
"""

import ast
import re
from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path

from .. import course
from ..exercises.declaration import MasterError, read_exercises
from ..exercises.percent_script import DROPPED_ROLES, MISTAKES_SUFFIX, ScriptCell, read_script
from .lesson_names import LESSON_FILE, lesson_name
from .minutes import timed_script
from .references import References, read_toml
from .rules import CHECK_LINE, VARYING_TAG, master_problems

# Fields of an Exercise and its parts that are Python, and those that are texts.
_SOURCES = ("stub", "solution", "preparation", "helpers", "given")
_TEXTS = ("title", "hint", "border_hint", "hints", "explanation", "another_way", "says")
QUESTIONS = "questions.toml"
TEMPLATE = Path(__file__).with_name("new_lesson.py.txt")
OF_QUESTIONS = ("question", "ask")  # the roles of their cells: a text, and a call of `ask`
_KEYS = {"section", "asked", "question", "answer", "replies"}
_INTRODUCTION = """\
## Two questions from earlier lessons ([[minutes]])

No points: write your answer in place of `None`, and run the cell."""


@dataclass(frozen=True)
class Cell:
    id: str  # "answer-<exercise>", "check-<exercise>-<n>", "predict-<lesson>-<n>", "<lesson>-<n>", …
    kind: str  # "markdown" or "code"
    source: str  # in the lesson
    solved_source: str  # in the solved twin
    role: str = ""  # "given", "answer", "check", "predict", "question", "ask" or ""
    exercise: str = ""  # the id of its exercise
    tags: tuple = ()
    deeper: bool = False  # whether it can be left out: it is in a deeper section

    @property
    def varies(self):
        return VARYING_TAG in self.tags

    @property
    def folded(self):
        """Whether JupyterLab shows only its first line."""
        return self.kind == "code" and self.source.startswith(CHECK_LINE)


@dataclass(frozen=True)
class Master:
    """A master: `cells` are the lesson's, `exercises` are the declarations that grading needs."""

    path: Path
    title: str  # of an optional one it says so
    minutes: int  # of the whole lesson
    core_minutes: int
    optional: bool  # whether no route and no stated hours count it
    cells: tuple
    exercises: tuple
    texts: dict  # {name of a figure: (caption, alternative text)}
    questions: dict  # {name of a question from an earlier lesson: its answer and replies}

    @property
    def name(self):
        """The lesson's identity: "images_as_messages"."""
        return lesson_name(self.path.stem)

    @property
    def number(self):
        """Its place in the course: "03"."""
        match = LESSON_FILE.fullmatch(self.path.stem)
        return match["number"] if match else ""  # the index has none

    @property
    def deeper_exercises(self):
        """The ids of the exercises that can be left out."""
        return tuple(cell.exercise for cell in self.cells if cell.role == "answer" and cell.deeper)


def find_masters(folder, names=()):
    """The paths of the masters in a folder, in the order of the course; of all, or of those that are named.

    "03", "images_as_messages", "images" and "03_images_as_messages" name images_as_messages; of a number
    and a name, the name decides. MasterError: a name of no lesson or of several, no master, two of one name,
    or known mistakes without their master.
    """
    for path in sorted(Path(folder).glob(f"*{MISTAKES_SUFFIX}")):
        master = path.with_name(path.name.removesuffix(MISTAKES_SUFFIX) + ".py")
        if not master.exists():
            raise MasterError(f"{path}: there is no {master.name}; rename it like its master, or delete it")
    return _find(folder, names, "masters", "a master", ".py")


def find_lessons(folder, names=()):
    """The built lessons in a folder, in the order of the course; otherwise as `find_masters`."""
    return _find(folder, names, "notebooks", "a lesson", ".ipynb")


def _find(folder, names, plural, singular, suffix):
    paths = sorted(path for path in Path(folder).glob(f"*{suffix}") if LESSON_FILE.fullmatch(path.stem))
    if not paths:
        raise MasterError(f"no {plural} in {folder}; {singular} is named like 03_images_as_messages{suffix}")
    lessons = [lesson_name(path.stem) for path in paths]
    for name in lessons:
        if lessons.count(name) > 1:
            raise MasterError(f"{folder} has two {plural} of the lesson {name}; rename one of them")
    if not names:
        return paths
    return sorted({_find_master(paths, name) for name in names})


def _find_master(paths, name):
    stem = Path(name).stem
    name_part = lesson_name(stem)
    matches = [path for path in paths if name_part in (path.name[:2], lesson_name(path.stem))]
    matches = matches or [
        path for path in paths if stem in path.stem[:2] or lesson_name(path.stem).startswith(name_part)
    ]
    if len(matches) != 1:
        lessons = ", ".join(path.stem for path in matches or paths)
        raise MasterError(f"{name!r} names {'several lessons' if matches else 'no lesson'}: {lessons}")
    return matches[0]


def read_master(path):
    """Read a whole Master; MasterError has a line for each rule of the format that it breaks."""
    path = Path(path)
    script, references = read_script(path), References(path)
    exercises = tuple(_resolved(exercise, references) for exercise in read_exercises(path))
    optional = bool(script.front_matter.get("optional"))
    title = str(script.front_matter.get("title", "")) + " (optional)" * optional
    match = LESSON_FILE.fullmatch(path.stem)
    with_asks, questions = with_questions(script.cells, path, references)
    timed, deeper, minutes, core_minutes = timed_script(replace(script, cells=with_asks))
    cells = list(_lesson_cells(path, zip(timed, deeper, strict=True), exercises, references))
    if match and cells and cells[0].kind == "markdown" and cells[0].source.startswith("# "):
        heading, line_end, text = cells[0].source[2:].partition("\n")
        source = f"# {match['number']} · {heading}{' (optional)' * optional}{line_end}{text}"
        cells[0] = replace(cells[0], source=source, solved_source=source)
    parts = tuple(cells), exercises, _texts(script, references), questions
    master = Master(path, title, minutes, core_minutes, optional, *parts)
    problems = master_problems(master)
    if problems:
        raise MasterError("\n".join(f"{path.name}: {problem}" for problem in problems))
    return master


def _texts(script, references):
    """The texts of the figures; MasterError: they are no literal dict of pairs."""
    texts: dict[str, tuple[str, str]] = {}
    for cell in script.cells:
        if cell.role == "texts":
            try:
                texts |= ast.literal_eval(ast.parse(references.in_code(cell.source)).body[0].value)
                pairs = [pair for pair in texts.values() if isinstance(pair, tuple) and len(pair) == 2]
                is_right = len(pairs) == len(texts) and all(all(map(str.strip, pair)) for pair in pairs)
            except (SyntaxError, ValueError, TypeError, AttributeError):
                is_right = False
            if not is_right:
                expected = 'figure_texts = {"name": ("caption", "alt"), ...}'
                raise MasterError(f"{cell.place}: expected {expected}")
    return texts


def _resolved(record, references):
    """An Exercise, Case or Mistake with the references in its texts and sources resolved."""
    changes = {}
    for name, value in vars(record).items():
        resolve = references.in_text if name in _TEXTS else references.in_code
        if name in ("cases", "mistakes"):
            changes[name] = tuple(_resolved(part, references) for part in value)
        elif name in _TEXTS or name in _SOURCES:
            changes[name] = resolve(value) if isinstance(value, str) else tuple(map(resolve, value))
    return replace(record, **changes)


def _lesson_cells(path, timed, exercises, references):
    counts: Counter[tuple] = Counter()
    latest = ""
    declared = iter(exercises)
    solutions = {exercise.id: exercise.solution for exercise in exercises}
    varying = {exercise.id for exercise in exercises if not exercise.kind.expects_values}
    position = 0
    for cell, deeper in timed:
        role = cell.role
        if role == "exercise":
            latest = next(declared).id
        if role in DROPPED_ROLES:
            continue
        position += role not in OF_QUESTIONS
        owners = cell.options.get("exercise", latest)
        owner = (owners if isinstance(owners, str) else owners[0]) if role else ""
        if role in ("predict", *OF_QUESTIONS):
            owner = lesson_name(path.stem)
        tags = tuple(cell.options.get("tags", ()))
        if role == "check" and owner in varying:  # a path depends on the processor
            tags = (*tags, VARYING_TAG)
        id = f"{lesson_name(path.stem)}-{position}"
        if role == "answer":
            id = f"answer-{owner}"
        elif role:
            counts[role, owner] += 1
            id = f"{role}-{owner}-{counts[role, owner]}"
        resolve = references.in_prose if cell.kind == "markdown" else references.in_code
        source = resolve(cell.source)
        solved_source = solutions[owner] if role == "answer" else source
        exercise = "" if role in ("predict", *OF_QUESTIONS) else owner
        yield Cell(id, cell.kind, source, solved_source, role, exercise, tags, deeper)


def read_questions(path):
    """{name: entry} of a questions.toml; none without the file. MasterError names faults."""
    entries = read_toml(path)
    for name, entry in entries.items():
        replies = {str(entry.get("answer")), *entry.get("options", ("less", "more"))}
        missing = (_KEYS - set(entry)) or (replies - set(entry["replies"]))
        if missing:
            raise MasterError(f'{path.name}: ["{name}"] has no {", ".join(sorted(missing))}; add it')
    return entries


def with_questions(cells, path, references):
    """A master's cells, with questions before the first section; and what is stored of these."""
    lesson, asked, stored, text = lesson_name(path.stem), [], {}, _INTRODUCTION
    for name, entry in read_questions(path.with_name(QUESTIONS)).items():
        if lesson not in entry["asked"]:
            continue
        replies = {given: references.in_text(reply) for given, reply in entry["replies"].items()}
        again = references.in_text(f"Read [[{entry['section']}]] again.")
        stored[name] = {"answer": entry["answer"], "replies": replies, "again": again}
        options = entry.get("options", {})
        text += f"\n\n**{len(stored)}.** {entry['question']}\n"
        text += "".join(f"\n- **{letter}** {option}" for letter, option in options.items())
        expected = " or ".join(f'"{letter}"' for letter in options) or "a number"
        call = f'ask("{lesson}/{name}", None)  # your answer: {expected}'
        source = f"from {course.face} import ask\n\n{call}"
        asked.append(ScriptCell("markdown", "question", {}, text.strip(), 0, QUESTIONS))
        asked.append(ScriptCell("code", "ask", {}, source, 0, QUESTIONS))
        text = ""
    texts = [place for place, cell in enumerate(cells) if cell.kind == "markdown"]
    place = [*texts, len(cells), len(cells)][1]
    return (*cells[:place], *asked, *cells[place:]), stored


def new_lesson(name, folder):
    """Write a template master, and return its path; MasterError for a name that is taken or impossible.

    It builds and grades as it is. A name without a number gets the next free one from 30 on, above the
    course's own lessons.
    """
    folder = Path(folder)
    stem = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")
    if stem and not LESSON_FILE.fullmatch(stem):
        used = {int(path.name[:2]) for path in folder.glob("*.py") if LESSON_FILE.fullmatch(path.stem)}
        stem = f"{min({*range(30, 100)} - used, default=99):02d}_{stem}"
    if not LESSON_FILE.fullmatch(stem):
        remedy = "use letters and digits, as in brightness or 30_brightness"
        raise MasterError(f"{name!r} cannot name a lesson; {remedy}")
    path, name_part = folder / f"{stem}.py", stem[3:]
    for other in sorted(folder.glob(f"[0-9][0-9]_{name_part}.*py")):  # the number is only its place
        raise MasterError(f"{other}: a lesson with that name exists; choose another name")
    text = TEMPLATE.read_text(encoding="utf-8")
    text = text.replace("LESSON-TITLE", name_part.replace("_", " ").capitalize())
    text = text.replace("COURSE-NAME", course.name).replace("COURSE-FACE", course.face)
    text = text.replace("LESSON-ID", name_part.replace("_", "-"))
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with path.open("x", encoding="utf-8") as file:
            file.write(text)
    except OSError as error:
        raise MasterError(f"{path}: cannot be written ({error.strerror})") from error
    return path
