"""The pages for instructors: minutes, exercises and points come from the masters of the lessons.

- A lesson's page gets a first line with its facts, and the index of these pages a table.
- In the other pages, `[[arrays]]` is a link, and `[[core: arrays, grayscale]]` the hours of their cores.
  `[[whole: arrays, grayscale]]` counts the deeper sections, too.
"""

import re
from pathlib import Path

from nbclassroom.authoring.masters import find_masters, read_master

MASTERS = Path(__file__).resolve().parents[2] / "notebooks" / "masters"


def exercise_list(exercises):
    """The exercises with their points, in one line."""
    return ", ".join(f"`{exercise.id}` ({exercise.points or 'practice'})" for exercise in exercises)


def lesson_facts(master):
    """What an instructor's page says first: the lesson, its minutes, its exercises with their points."""
    deeper = [exercise for exercise in master.exercises if exercise.id in master.deeper_exercises]
    core = [exercise for exercise in master.exercises if exercise not in deeper]
    time = f"{master.core_minutes} minutes for the core, {master.minutes} for all of it."
    parts = [f"Lesson [{master.number} {master.title}](/lessons/{master.path.stem}.ipynb): {time}"]
    parts += [f"Exercises in the core, with points: {exercise_list(core)}."] if core else []
    parts += [f"Exercises in deeper sections: {exercise_list(deeper)}."] if deeper else []
    return " ".join(parts)


def write_instructor_pages(folder, masters):
    """Puts the facts under the title of each page, and all pages into the index of the folder."""
    rows = ["| no. | lesson | minutes: core | whole | points |", "|---|---|---|---|---|"]
    for master in masters:
        page = folder / f"{master.name}.md"
        title, text = page.read_text("utf-8").removeprefix("# ").split("\n", 1)
        page.write_text(f"# For teachers: {title}\n\n{lesson_facts(master)}\n{text}", "utf-8")
        points = sum(exercise.points for exercise in master.exercises)
        minutes = f"{master.core_minutes} | {master.minutes}"
        rows.append(f"| {master.number} | [{master.title}]({page.name}) | {minutes} | {points} |")
    order = "\n".join(master.name for master in masters)
    with (folder / "index.md").open("a", encoding="utf-8") as index:
        index.write("\n".join(["", *rows, "", "```{toctree}", ":hidden:", "", order, "```", ""]))


def fill_in(text, masters, html_folder=None):
    """A page with links for [[arrays]], not in code, and the hours of [[core: arrays, grayscale]].

    html_folder: the links are elements <a> to pages of this folder, for captions in HTML.
    """
    by_name = {master.name: master for master in masters}

    def link(match):
        master = by_name[match[1]]
        if html_folder:
            return f'<a href="{html_folder}/{master.path.stem}.html">{master.number} {master.title}</a>'
        return f"[{master.number} {master.title}](/lessons/{master.path.stem}.ipynb)"

    def hours(match):
        lessons = [by_name[name] for name in match[2].split(", ")]
        minutes = sum(lesson.core_minutes if match[1] == "core" else lesson.minutes for lesson in lessons)
        return f"{minutes / 60:.1f} hours"

    text = re.sub(r"\[\[(core|whole): ([^]]+)\]\]", hours, text)
    return re.sub(r"(?<!`)\[\[(\w+)\]\](?!`)", link, text)


def read_masters():
    return [read_master(path) for path in find_masters(MASTERS)]


def write_teach(folder, masters):
    write_instructor_pages(folder / "lessons", masters)
    for page in folder.glob("*.md"):
        page.write_text(fill_in(page.read_text("utf-8"), masters), "utf-8")
