"""The course at a glance: its lessons, what each needs, what the learner has passed; and a certificate."""

import contextlib
import datetime as dt
import html
import json
import re
from dataclasses import dataclass
from pathlib import Path

from .. import course
from .check_files import DAMAGED, CheckFileError, checks_folders, read_check_file
from .help_steps import Help
from .kinds import kind_of
from .progress import read_progress

_LESSON_FILE = re.compile(r"(\d\d)_[a-z0-9_]+\.ipynb")
_NEEDS = re.compile(r"\*\*You need\*\*(.*?)(?:\n|$)")
_LINKED_NUMBER = re.compile(r"\]\((\d\d)_[a-z0-9_]+\.ipynb")
CERTIFICATE = "certificate.html"


@dataclass(frozen=True)
class LessonProgress:
    """One lesson of a folder, with the ids of its exercises."""

    file: str  # "04_grayscale.ipynb"
    title: str
    minutes: int
    core_minutes: int
    needs: tuple[str, ...]  # numbers of lessons: ("03",)
    exercises: tuple[str, ...]
    deeper: tuple[str, ...]  # those that can be left out
    passed: tuple[str, ...]
    points: int = 0  # of those that have passed, without hidden checks
    is_counted: bool = True  # in the hours: it is in the course, and not optional
    written: tuple[bool, ...] = ()  # of each written answer, whether its learner has compared it

    @property
    def number(self):
        return self.file[:2]

    @property
    def core(self):
        """The exercises of its core, a set."""
        return {*self.exercises} - {*self.deeper}

    @property
    def is_done(self):
        """Whether every exercise of the core has passed; a core without exercises is never done."""
        return bool(self.core) and self.core <= {*self.passed}

    @property
    def tick(self):
        return "✓ " if self.is_done else ""

    @property
    def count(self):
        passed = {*self.passed} & self.core
        text = f"{len(passed)} of {len(self.core)}" if self.core else "none in the core"
        if self.deeper:
            text += f", deeper {len({*self.passed} - passed)} of {len(self.deeper)}"
        return text


@dataclass(frozen=True)
class Overview:
    """All lessons of a folder. A notebook shows it as a table with links; `print` gives the same as text."""

    lessons: tuple[LessonProgress, ...]

    @property
    def passed(self) -> int:
        return sum(len(lesson.passed) for lesson in self.lessons)

    @property
    def exercises(self) -> int:
        return sum(len(lesson.exercises) for lesson in self.lessons)

    @property
    def next_lesson(self) -> LessonProgress | None:
        """The first lesson that is not done, and is not a core without exercises before one that is begun."""
        begun = [k for k, lesson in enumerate(self.lessons) if lesson.passed]
        last = max(begun, default=-1)
        rest = (lesson for k, lesson in enumerate(self.lessons) if k > last or lesson.core)
        return next((lesson for lesson in rest if lesson.is_counted and not lesson.is_done), None)

    def _summary(self):
        counted = [lesson for lesson in self.lessons if lesson.is_counted]
        whole = _time(sum(lesson.minutes for lesson in counted))
        core = _time(sum(lesson.core_minutes for lesson in counted))
        passed = f"{self.passed} of {self.exercises} exercises passed"
        if written := [is_compared for lesson in self.lessons for is_compared in lesson.written]:
            passed += f", {sum(written)} of {len(written)} written answers compared"
        return f"{passed} · all lessons: {whole}; their cores: {core}"

    def __repr__(self):
        return "\n".join([self._summary(), *map(self._line, self.lessons)])

    def _line(self, lesson):
        needs = f", needs {', '.join(lesson.needs)}" if lesson.needs else ""
        mark = lesson.tick or ("→ " if lesson == self.next_lesson else "  ")
        time = f"core {lesson.core_minutes}, whole {lesson.minutes} minutes"
        return f"{mark}{lesson.number} {lesson.title}: {time}{needs}; {lesson.count} exercises"

    def _repr_html_(self):
        head = _row('th scope="col"', ("Lesson", "Minutes: core", "whole", "Needs", "Exercises passed"))
        rows = "".join(_row("td", self._cells(lesson)) for lesson in self.lessons)
        bar = (
            f'<progress value="{self.passed}" max="{max(self.exercises, 1)}" aria-label="exercises passed"'
            ' style="width: 100%; max-width: 480px"></progress>'
        )
        table = f"<table><thead>{head}</thead><tbody>{rows}</tbody></table>"
        return f"<div>{bar}</div><div>{self._summary()}</div>{table}"

    def _cells(self, lesson):
        label = html.escape(f"{lesson.number} · {lesson.title}")
        link = f'<a href="{html.escape(lesson.file)}">{label}</a>'
        if lesson == self.next_lesson:
            link += f" <b>{'begin' if self.passed == 0 else 'continue'} here</b>"
        needs = ", ".join(lesson.needs) or "–"
        return link, lesson.core_minutes, lesson.minutes, needs, f"{lesson.tick}{lesson.count}"


def _time(minutes):
    return f"{minutes} minutes" if minutes < 120 else f"about {minutes / 60:.0f} hours"


def _row(tag, cells):
    cells = "".join(f'<{tag} style="text-align: left">{cell}</{tag[:2]}>' for cell in cells)
    return f"<tr>{cells}</tr>"


def overview(folder: Path | str | None = None) -> Overview:
    """The lessons of a folder, with what the learner has passed.

    Parameters
    ----------
    folder : Path or str; if omitted, the current folder, or the course's notebooks if it has no lessons

    Returns
    -------
    Overview, which a notebook shows; ValueError: the folder has no lessons
    """
    folders = [Path(folder)] if folder else [Path.cwd(), *course.folders_of_lessons()]
    for place in folders:
        paths = sorted(path for path in place.glob("*.ipynb") if _LESSON_FILE.fullmatch(path.name))
        if paths:
            progress = read_progress(place)
            lessons = (_lesson(path, progress) for path in paths)
            return Overview(tuple(lesson for lesson in lessons if lesson))
    raise ValueError(
        f"{folders[0]} has no lessons, expected files like 04_grayscale.ipynb; open the lessons with"
        f" {course.lab_command}"
    )


def _lesson(path, progress):
    """The LessonProgress of a notebook; None if it is no lesson, or cannot be read."""
    try:
        text_of_file = path.read_text(encoding="utf-8")
        notebook = json.loads(text_of_file)
        about = notebook["metadata"][course.name]
        name, title, whole = str(about["lesson"]), str(about["title"]), int(about["minutes"])
        core, deeper = int(about.get("core_minutes", whole)), tuple(about.get("deeper", ()))
        text = "".join(notebook["cells"][0]["source"])
    except (OSError, *DAMAGED):
        return None
    needs = _NEEDS.search(text)
    exercises = _exercises_of(name, path.parent)
    is_counted = exercises is not None and not about.get("optional")
    if exercises is None:  # a copy of a lesson that the course no longer has: its points are not known
        answers = re.findall(r'"answer-([a-z0-9-]+)"', text_of_file)
        exercises, title = dict.fromkeys(answers, 0), f"{title} (no longer in the course)"
    by_person = [id for id, points in exercises.items() if points is None]
    written = tuple(id in progress and progress[id].ticks is not None for id in by_person)
    exercises = {id: points for id, points in exercises.items() if points is not None}
    passed = tuple(id for id in exercises if id in progress and progress[id].passed)
    numbers = tuple(dict.fromkeys(_LINKED_NUMBER.findall(needs[1]))) if needs else ()
    deeper = tuple(id for id in exercises if id in deeper)
    points = sum(exercises[id] for id in passed)
    parts = tuple(exercises), deeper, passed, points, is_counted, written
    return LessonProgress(path.name, title, whole, core, numbers, *parts)


def _exercises_of(lesson, folder):
    """{exercise id: points of its checks, None if a person grades it}.

    None if other lessons have checks, and it has none.
    """
    paths = [checks / f"{lesson}.json" for checks in checks_folders(folder)]
    path = next(filter(Path.is_file, paths), None)
    if paths and not path:
        return None
    with contextlib.suppress(CheckFileError):
        entries = read_check_file(path).entries if path else {}
        return {id: _points_of_checks(entry) for id, entry in entries.items()}
    return {}


def _points_of_checks(entry):
    is_by_person = kind_of(entry.get("subject", "function")).graded_by_person
    return None if is_by_person else sum(case["points"] for case in entry["cases"])


def certificate(name: str, folder: Path | str | None = None) -> Help:
    """Writes certificate.html beside the lessons: lessons with exercises that passed, points and date.

    Parameters
    ----------
    name : str, the learner's name as the page shows it
    folder : Path or str, with lessons and progress; if omitted, as in `overview`

    Returns
    -------
    Help, which says where it is. ValueError: no name, no lessons, or nothing has passed
    """
    if not isinstance(name, str) or not name.strip():
        raise ValueError(f'name is {name!r}, expected your name as a text: certificate("Ada Lovelace")')
    lessons = [lesson for lesson in overview(folder).lessons if lesson.passed]
    if not lessons:
        raise ValueError("nothing has passed yet; run the checks of a lesson, then call certificate again")
    import jinja2  # only here: an import of 50 ms that no other cell needs

    template = Path(__file__).with_name(CERTIFICATE).read_text(encoding="utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    facts = {"title": course.title, "name": name.strip(), "lessons": lessons}
    page = environment.from_string(template).render(facts, date=f"{dt.date.today():%d %B %Y}")
    path = Path(folder or Path.cwd()) / CERTIFICATE
    path.write_text(page, encoding="utf-8")
    return Help(f"{path.name} is written", "Open it in a browser, and print it there (Ctrl+P).")
