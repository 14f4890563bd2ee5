"""The course at a glance: its lessons, what each needs, and what the learner has passed."""

import html
import json
import re
from dataclasses import dataclass
from pathlib import Path

from imgproc_course.classroom.exercises.check_files import (
    DAMAGED,
    CheckFileError,
    checks_folders,
    read_check_file,
)
from imgproc_course.classroom.exercises.progress import read_progress

_LESSON_FILE = re.compile(r"(\d\d)_[a-z0-9_]+\.ipynb")
_NEEDS = re.compile(r"\*\*You need\*\*(.*?)(?:\n|$)")
_LINKED_NUMBER = re.compile(r"\]\((\d\d)_[a-z0-9_]+\.ipynb")
_BAR_CHARACTERS = 20


@dataclass(frozen=True)
class LessonProgress:
    """One lesson of a folder.

    file       name of its notebook, "04_grayscale.ipynb"
    needs      numbers of the lessons that it needs, ("03",)
    exercises  ids of its exercises
    passed     those of them that have passed
    """

    file: str
    title: str
    minutes: int
    needs: tuple
    exercises: tuple
    passed: tuple

    @property
    def number(self):
        return self.file[:2]

    @property
    def is_done(self):
        return len(self.passed) == len(self.exercises)


@dataclass(frozen=True)
class Overview:
    """All lessons of a folder. A notebook shows it as a table with links; `print` gives the same as text."""

    lessons: tuple

    @property
    def passed(self):
        """Number of exercises that have passed."""
        return sum(len(lesson.passed) for lesson in self.lessons)

    @property
    def exercises(self):
        """Number of all exercises."""
        return sum(len(lesson.exercises) for lesson in self.lessons)

    @property
    def next_lesson(self):
        """The first lesson with an exercise that has not passed; None if there is none."""
        return next((lesson for lesson in self.lessons if not lesson.is_done), None)

    def _summary(self):
        minutes = sum(lesson.minutes for lesson in self.lessons)
        time = f"{minutes} minutes" if minutes < 120 else f"about {minutes / 60:.0f} hours"
        return f"{self.passed} of {self.exercises} exercises passed · all lessons: {time}"

    def __repr__(self):
        filled = round(_BAR_CHARACTERS * self.passed / max(self.exercises, 1))
        bar = "█" * filled + "░" * (_BAR_CHARACTERS - filled)
        return "\n".join([f"{bar} {self._summary()}", *map(self._line, self.lessons)])

    def _line(self, lesson):
        needs = f", needs {', '.join(lesson.needs)}" if lesson.needs else ""
        mark = "✓ " if lesson.exercises and lesson.is_done else "→ " if lesson == self.next_lesson else "  "
        return (
            f"{mark}{lesson.number} {lesson.title}: {lesson.minutes} minutes{needs};"
            f" {len(lesson.passed)} of {len(lesson.exercises)} exercises"
        )

    def _repr_html_(self):
        rows = "".join(map(self._row, self.lessons))
        head = "".join(
            f'<th scope="col" style="text-align: left">{name}</th>'
            for name in ("Lesson", "Minutes", "Needs", "Exercises passed")
        )
        bar = (
            f'<progress value="{self.passed}" max="{max(self.exercises, 1)}" aria-label="exercises passed"'
            ' style="width: 100%; max-width: 480px"></progress>'
        )
        return (
            f"<div>{bar}</div><div>{self._summary()}</div>"
            f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"
        )

    def _row(self, lesson):
        label = html.escape(f"{lesson.number} · {lesson.title}")
        link = f'<a href="{html.escape(lesson.file)}">{label}</a>'
        is_next = lesson == self.next_lesson
        name = f"{link} <b>{'begin' if self.passed == 0 else 'continue'} here</b>" if is_next else link
        tick = "✓ " if lesson.exercises and lesson.is_done else ""
        cells = (
            name,
            str(lesson.minutes),
            ", ".join(lesson.needs) or "–",
            f"{tick}{len(lesson.passed)} of {len(lesson.exercises)}",
        )
        return "<tr>" + "".join(f'<td style="text-align: left">{cell}</td>' for cell in cells) + "</tr>"


def overview(folder=None):
    """The lessons of a folder, with what the learner has passed.

    Parameters
    ----------
    folder : Path or str; if omitted, the current folder, or the course's notebooks if it has no lessons

    Returns
    -------
    Overview, which a notebook shows

    Raises
    ------
    ValueError : the folder has no lessons
    """
    folders = [Path(folder)] if folder else [Path.cwd(), Path(__file__).resolve().parents[3] / "notebooks"]
    for place in folders:
        paths = sorted(path for path in place.glob("*.ipynb") if _LESSON_FILE.fullmatch(path.name))
        if paths:
            progress = read_progress(place)
            lessons = (_lesson(path, progress) for path in paths)
            return Overview(tuple(lesson for lesson in lessons if lesson))
    raise ValueError(
        f"{folders[0]} has no lessons, expected files like 04_grayscale.ipynb; open the lessons with"
        " environment/lab"
    )


def _lesson(path, progress):
    """The LessonProgress of a notebook; None if it is no lesson, or cannot be read."""
    try:
        notebook = json.loads(path.read_text(encoding="utf-8"))
        about = notebook["metadata"]["imgproc_course"]
        name, title, minutes = str(about["lesson"]), str(about["title"]), int(about["minutes"])
        text = "".join(notebook["cells"][0]["source"])
    except (OSError, *DAMAGED):
        return None
    needs = _NEEDS.search(text)
    exercises = _exercises_of(name, path.parent)
    passed = tuple(id for id in exercises if id in progress and progress[id].passed)
    numbers = tuple(dict.fromkeys(_LINKED_NUMBER.findall(needs[1]))) if needs else ()
    return LessonProgress(path.name, title, minutes, numbers, exercises, passed)


def _exercises_of(lesson, folder):
    for checks in checks_folders(folder):
        path = checks / f"{lesson}.json"
        if path.is_file():
            try:
                return tuple(read_check_file(path).exercises)
            except CheckFileError:
                return ()
    return ()
