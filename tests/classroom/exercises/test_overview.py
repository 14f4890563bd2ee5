"""The overview: lessons of a folder with links, minutes, needs and progress."""

import json

import pytest
from nbclassroom.exercises.overview import certificate, overview

EXERCISES = {"one": ["one-a", "one-b"], "two": ["two-a"]}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Two lessons with their checks; the second needs the first."""
    monkeypatch.delenv("NBCLASSROOM_CHECKS", raising=False)
    (tmp_path / "checks").mkdir()
    for number, name, needs in (("07", "one", ""), ("08", "two", "**You need** [x](07_one.ipynb).")):
        cells = [{"cell_type": "markdown", "source": f"# {name}\n**Time** about 30 minutes. {needs}"}]
        about = {"lesson": name, "title": f"Lesson <{name}>", "minutes": 30, "core_minutes": 20}
        about["deeper"] = ["one-b"] if name == "one" else []
        text = json.dumps({"cells": cells, "metadata": {"imgproc_course": about}})
        (tmp_path / f"{number}_{name}.ipynb").write_text(text)
        checks = {"format": 1, "lesson": name, "version": "1", "cells": {}, "values": {}}
        checks["exercises"] = {id: {"cases": [{"points": 1}, {"points": 2}]} for id in EXERCISES[name]}
        (tmp_path / "checks" / f"{name}.json").write_text(json.dumps(checks))
    (tmp_path / "08_two (version 2).ipynb").write_text("{}")
    (tmp_path / "notes.ipynb").write_text("{}")
    return tmp_path


def change_first(folder, **about):
    """Change what the notebook of the first lesson says about itself."""
    path = folder / "07_one.ipynb"
    notebook = json.loads(path.read_text())
    notebook["metadata"]["imgproc_course"] |= about
    path.write_text(json.dumps(notebook))


def pass_exercises(folder, *ids):
    entries = {id: {"passed": True, "tries": [], "hints": 0} for id in ids}
    (folder / ".progress.json").write_text(json.dumps({"format": 1, "exercises": entries}))


def test_without_progress_the_first_lesson_is_the_next(folder):
    result = overview(folder)
    needs = {lesson.file: lesson.needs for lesson in result.lessons}
    assert needs == {"07_one.ipynb": (), "08_two.ipynb": ("07",)}
    assert (result.passed, result.exercises) == (0, 3)
    assert repr(result) == (
        "0 of 3 exercises passed · all lessons: 60 minutes; their cores: 40 minutes\n"
        "→ 07 Lesson <one>: core 20, whole 30 minutes; 0 of 1, deeper 0 of 1 exercises\n"
        "  08 Lesson <two>: core 20, whole 30 minutes, needs 07; 0 of 1 exercises"
    )
    assert '<a href="07_one.ipynb">07 · Lesson &lt;one&gt;</a> <b>begin here</b>' in result._repr_html_()


def test_a_lesson_is_done_when_the_exercises_of_its_core_pass(folder):
    pass_exercises(folder, "one-a", "other-course")
    result = overview(folder)
    assert (result.passed, result.next_lesson.file) == (1, "08_two.ipynb")
    assert "✓ 07 Lesson <one>" in repr(result) and "→ 08" in repr(result)
    page = result._repr_html_()
    assert "✓ 1 of 1, deeper 0 of 1" in page
    assert '<progress value="1" max="3"' in page and "<b>continue here</b>" in page


def test_when_everything_passes_nothing_is_next(folder):
    pass_exercises(folder, "one-a", "one-b", "two-a")
    result = overview(folder)
    assert result.next_lesson is None and "here</b>" not in result._repr_html_()


def test_damaged_files_cost_only_themselves(folder):
    (folder / "07_one.ipynb").write_text("{")
    (folder / "checks" / "two.json").write_text("{")
    (folder / ".progress.json").write_text("[")
    (lesson,) = overview(folder).lessons
    assert (lesson.file, lesson.exercises, lesson.is_done) == ("08_two.ipynb", (), False)


def test_a_folder_without_lessons_is_told(tmp_path, monkeypatch):
    with pytest.raises(ValueError, match="has no lessons, expected files like"):
        overview(tmp_path)
    monkeypatch.chdir(tmp_path)
    assert overview().lessons[0].file == "00_start_here.ipynb"


def test_a_core_without_exercises_has_no_tick_and_is_next_until_a_later_lesson_is_begun(folder):
    change_first(folder, deeper=["one-a", "one-b"])
    result = overview(folder)
    assert result.next_lesson.file == "07_one.ipynb"
    assert "→ 07 Lesson <one>: core 20, whole 30 minutes; none in the core, deeper 0 of 2" in repr(result)
    pass_exercises(folder, "two-a")
    assert overview(folder).next_lesson is None
    assert "  07 Lesson <one>" in repr(overview(folder))


def test_a_lesson_that_the_course_no_longer_has_keeps_its_progress_and_counts_no_hours(folder):
    path = folder / "07_one.ipynb"
    notebook = json.loads(path.read_text())
    notebook["cells"] += [
        {"cell_type": "code", "id": f"answer-{id}", "source": ""} for id in EXERCISES["one"]
    ]
    path.write_text(json.dumps(notebook))
    (folder / "checks" / "one.json").unlink()
    pass_exercises(folder, "one-b")
    result = overview(folder)
    assert (result.passed, result.next_lesson.file) == (1, "08_two.ipynb")
    assert "all lessons: 30 minutes; their cores: 20 minutes" in repr(result)
    text = "07 Lesson <one> (no longer in the course): core 20, whole 30 minutes; 0 of 1, deeper 1 of 1"
    assert text in repr(result)
    certificate("Ada", folder)
    page = (folder / "certificate.html").read_text(encoding="utf-8")
    assert "<td>Lesson &lt;one&gt; (no longer in the course)</td><td>1 of 2</td><td>–</td>" in page


def test_an_optional_lesson_is_not_next_and_counts_no_hours(folder):
    change_first(folder, optional=True)  # its title says so
    result = overview(folder)
    assert result.next_lesson.file == "08_two.ipynb"
    assert "all lessons: 30 minutes; their cores: 20 minutes" in repr(result)


def test_a_certificate_lists_what_has_passed(folder):
    pass_exercises(folder, "one-a", "one-b")
    assert repr(certificate("  Ada <b>", folder)).startswith("certificate.html is written")
    page = (folder / "certificate.html").read_text(encoding="utf-8")
    assert '<p class="name">Ada &lt;b&gt;</p>' in page
    assert "has solved 2 exercises, with 6 points" in page
    assert "<td>Lesson &lt;one&gt;</td><td>2 of 2</td><td>6</td>" in page
    assert "Lesson &lt;two&gt;" not in page


@pytest.mark.parametrize(
    "name, passed, message",
    [(None, ["one-a"], "name is None"), (" ", ["one-a"], "name is ' '"), ("Ada", [], "nothing has passed")],
)
def test_a_certificate_needs_a_name_and_something_that_passed(folder, name, passed, message):
    pass_exercises(folder, *passed)
    with pytest.raises(ValueError, match=message):
        certificate(name, folder)
    assert not (folder / "certificate.html").exists()
