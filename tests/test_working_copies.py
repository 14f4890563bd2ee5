"""Working copies: an update brings lessons beside work already begun, never over it."""

import errno
import json
import os
import subprocess
import sys

import pytest

from imgproc_course import working_copies
from imgproc_course.working_copies import LessonsError, bring_lessons


def notebook(*sources, outputs=(), version="0.1.0", ids=None):
    cells = [
        {
            "cell_type": "code",
            "id": (ids or "abcdefgh")[i],
            "source": source,
            "outputs": list(outputs),
            "execution_count": len(outputs) or None,
            "metadata": {},
        }
        for i, source in enumerate(sources)
    ]
    metadata = {"imgproc_course": {"version": version}}
    return json.dumps({"cells": cells, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5})


class Course:
    """A small checkout: `ship` writes lessons as an update would, `start` brings them."""

    def __init__(self, folder):
        self.notebooks = folder / "notebooks"
        self.mine = folder / "my_lessons"
        self.notebooks.mkdir()

    def ship(self, **lessons):
        for name, text in lessons.items():
            (self.notebooks / f"{name}.ipynb").write_text(text)

    def start(self, version="0.2.0"):
        return bring_lessons(self.notebooks, self.mine, version)

    def read(self, name):
        return (self.mine / f"{name}.ipynb").read_text()

    def write(self, name, text):
        (self.mine / f"{name}.ipynb").write_text(text)

    def files(self):
        return sorted(path.name for path in self.mine.iterdir() if not path.name.startswith("."))

    def everything(self):
        return {path.name: path.read_bytes() for path in self.mine.iterdir()} if self.mine.exists() else None


@pytest.fixture
def course(tmp_path):
    course = Course(tmp_path)
    course.ship(a=notebook("1"), b=notebook("2"))
    return course


def test_the_first_start_brings_every_lesson(course):
    brought = course.start()
    assert course.files() == ["a.ipynb", "b.ipynb"]
    assert course.read("a") == notebook("1")
    assert list(brought.lines()) == ["New in my_lessons/: a.ipynb, b.ipynb"]


def test_a_second_start_touches_nothing(course):
    course.start()
    course.write("a", notebook("my work"))
    course.write("b", notebook("2", outputs=[{"output_type": "stream", "name": "stdout", "text": "2"}]))
    before = course.everything()
    brought = course.start()
    assert course.everything() == before
    assert list(brought.lines()) == ["my_lessons/ is up to date; nothing in it was touched."]


def test_masters_and_hidden_files_are_not_for_learners(course):
    for name in ("masters/a.py", ".ipynb_checkpoints/a.ipynb", "masters/deep/b.py"):
        path = course.notebooks / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("x")
    course.start()
    assert sorted(course.everything()) == [".course.json", ".course.lock", "a.ipynb", "b.ipynb"]


def test_data_files_and_folders_come_too(course):
    (course.notebooks / "figures").mkdir()
    (course.notebooks / "figures" / "robot.png").write_bytes(b"\x89PNG")
    course.start()
    assert (course.mine / "figures" / "robot.png").read_bytes() == b"\x89PNG"
    (course.mine / "figures" / "robot.png").write_bytes(b"scribbled over")
    (course.notebooks / "figures" / "robot.png").write_bytes(b"\x89PNG2")
    brought = course.start("0.3.0")
    assert brought.beside == [("figures/robot.png", "figures/robot (version 0.3.0).png")]
    assert (course.mine / "figures" / "robot.png").read_bytes() == b"scribbled over"


def test_a_new_lesson_comes_beside_work(course):
    course.start()
    course.write("a", notebook("my work"))
    course.ship(c=notebook("3"))
    brought = course.start()
    assert brought.new == ["c.ipynb"]
    assert (course.read("a"), course.read("c")) == (notebook("my work"), notebook("3"))


def test_a_copy_without_work_follows_the_update(course):
    course.start()
    course.ship(a=notebook("1 corrected"))
    brought = course.start()
    assert course.read("a") == notebook("1 corrected")
    assert course.files() == ["a.ipynb", "b.ipynb"]
    assert list(brought.lines()) == ["Brought up to date, as you had not changed them: a.ipynb"]


def test_a_copy_that_was_only_run_follows_the_update(course):
    course.start()
    course.write("a", notebook("1", outputs=[{"output_type": "stream", "name": "stdout", "text": "1"}]))
    course.ship(a=notebook("1 corrected"))
    course.start()
    assert course.read("a") == notebook("1 corrected")


def test_a_notebook_that_jupyterlab_saved_is_no_work(course):
    course.start()
    saved = json.loads(course.read("a"))
    saved["cells"][0]["source"] = ["1"]  # as a list of lines
    saved["cells"][0]["metadata"]["collapsed"] = True
    saved["metadata"]["language_info"] = {"name": "python"}
    course.write("a", json.dumps(saved, indent=1) + "\n")
    course.ship(a=notebook("1 corrected"))
    course.start()
    assert course.read("a") == notebook("1 corrected")


@pytest.mark.parametrize(
    "work",
    [
        notebook("1 changed"),
        notebook("1", "an added cell"),
        notebook(),
        notebook("1", ids="z"),
        notebook("1").replace('"cell_type": "code"', '"cell_type": "markdown"'),
        notebook("1").replace(
            '"metadata": {}', '"metadata": {}, "attachments": {"p.png": {"image/png": "AA=="}}'
        ),
        notebook("1")[:-20],
        "",
        "[]",
        '{"cells": 3}',
    ],
)
def test_work_stays_and_the_update_lies_beside_it(course, work):
    course.start()
    course.write("a", work)
    course.ship(a=notebook("1 corrected"))
    brought = course.start("0.2.0")
    assert course.read("a") == work
    assert course.read("a (version 0.2.0)") == notebook("1 corrected")
    assert course.files() == ["a (version 0.2.0).ipynb", "a.ipynb", "b.ipynb"]
    assert list(brought.lines()) == [
        "Changed in the course: a.ipynb. Yours is as you left it; the new one is a (version 0.2.0).ipynb"
    ]


def test_an_update_is_laid_beside_once(course):
    course.start()
    course.write("a", notebook("my work"))
    course.ship(a=notebook("1 corrected"))
    course.start()
    course.write("a (version 0.2.0)", notebook("I went on here"))
    before = course.everything()
    assert course.start().beside == []
    assert course.everything() == before
    (course.mine / "a (version 0.2.0).ipynb").unlink()
    assert course.start().beside == []
    assert course.files() == ["a.ipynb", "b.ipynb"]


def test_a_second_update_has_a_name_of_its_own(course):
    course.start()
    course.write("a", notebook("my work"))
    for number, version in enumerate(("0.2.0", "0.2.0", "0.3.0")):
        course.ship(a=notebook(f"correction {number}"))
        course.start(version)
    assert course.read("a") == notebook("my work")
    assert course.read("a (version 0.2.0)") == notebook("correction 0")
    assert course.read("a (version 0.2.0, 2)") == notebook("correction 1")
    assert course.read("a (version 0.3.0)") == notebook("correction 2")


def test_an_update_that_the_learner_took_over_by_hand_is_not_told_again(course):
    course.start()
    course.ship(a=notebook("1", version="0.2.0"))
    course.write("a", notebook("1", version="0.2.0"))
    assert list(course.start().lines()) == ["my_lessons/ is up to date; nothing in it was touched."]


def test_an_update_of_the_version_number_alone_is_not_laid_beside_work(course):
    course.start()
    course.write("a", notebook("my work"))
    course.ship(a=notebook("1", version="0.2.0"), b=notebook("2", version="0.2.0"))
    brought = course.start()
    assert (brought.beside, brought.corrected) == ([], ["b.ipynb"])
    assert course.read("a") == notebook("my work")
    assert course.read("b") == notebook("2", version="0.2.0")


def test_work_that_was_taken_back_follows_the_update_after_all(course):
    course.start()
    course.write("a", notebook("my work"))
    course.ship(a=notebook("1 corrected"))
    course.start()
    course.write("a", notebook("1"))
    assert course.start().corrected == ["a.ipynb"]
    assert course.read("a") == notebook("1 corrected")


def test_a_deleted_copy_comes_back_fresh(course):
    course.start()
    (course.mine / "a.ipynb").unlink()
    assert course.start().new == ["a.ipynb"]
    assert course.read("a") == notebook("1")


def test_a_lesson_that_the_course_no_longer_has_stays(course):
    course.start()
    (course.notebooks / "a.ipynb").unlink()
    course.start()
    assert course.read("a") == notebook("1")


@pytest.mark.parametrize(
    "damage", [None, "", "{", "[]", '{"lessons": []}', '{"lessons": {"a.ipynb": 3}}', "\x00"]
)
def test_without_its_memory_nothing_is_written_over(course, damage):
    course.start()
    course.write("a", notebook("my work"))
    course.write("b", notebook("2", outputs=[{"output_type": "stream", "name": "stdout", "text": "2"}]))
    state = course.mine / ".course.json"
    state.unlink() if damage is None else state.write_text(damage)
    before = {name: data for name, data in course.everything().items() if not name.startswith(".")}
    brought = course.start()
    assert (brought.new, brought.corrected) == ([], [])
    assert brought.beside == [("a.ipynb", "a (version 0.2.0).ipynb")]
    after = course.everything()
    assert {name: after[name] for name in before} == before
    assert course.start().beside == []


def test_without_its_memory_an_update_that_lies_there_is_not_laid_again(course):
    course.start()
    course.write("a", notebook("my work"))
    course.ship(a=notebook("1 corrected"))
    course.start()
    (course.mine / ".course.json").unlink()
    assert course.start().beside == []
    assert course.files() == ["a (version 0.2.0).ipynb", "a.ipynb", "b.ipynb"]


def test_other_files_of_the_learner_stay(course):
    course.mine.mkdir()
    (course.mine / "notes.txt").write_text("mine")
    course.write("a", notebook("mine from before"))
    brought = course.start()
    assert (course.mine / "notes.txt").read_text() == "mine"
    assert course.read("a") == notebook("mine from before")
    assert brought.beside == [("a.ipynb", "a (version 0.2.0).ipynb")]


def said(course):
    with pytest.raises(LessonsError) as caught:
        course.start()
    line = str(caught.value)
    assert "\n" not in line
    return line


def test_a_folder_without_lessons_says_what_to_do(tmp_path):
    with pytest.raises(LessonsError, match=r"^there are no lessons in notebooks/; run this from a clone"):
        bring_lessons(tmp_path / "notebooks", tmp_path / "my_lessons")
    assert not (tmp_path / "my_lessons").exists()


def test_a_file_where_the_folder_should_be(course):
    course.mine.write_text("hello")
    assert said(course) == "my_lessons is a file, and the lessons need a folder of that name; rename the file"
    assert course.mine.read_text() == "hello"


@pytest.mark.parametrize("writes_until_full", [0, 1, 2])
@pytest.mark.parametrize("begun", [False, True])
def test_a_full_disk_leaves_everything_as_it_was(course, monkeypatch, writes_until_full, begun):
    if begun:
        course.start()
        course.write("b", notebook("my work"))
        course.ship(a=notebook("1 corrected"), b=notebook("2 corrected"))
    before = course.everything() or {".course.lock": b""}
    written = []

    def sync(number):
        if len(written) == writes_until_full:
            raise OSError(errno.ENOSPC, "No space left on device")
        written.append(number)

    monkeypatch.setattr(os, "fsync", sync)
    assert said(course) == (
        "no lessons were brought into my_lessons/, and nothing in it was changed (No space left on device); "
        "free 100 MB and start again"
    )
    assert course.everything() == before
    monkeypatch.undo()
    brought = course.start()
    assert (brought.new or brought.corrected) and course.read("a") in (notebook("1"), notebook("1 corrected"))


def test_a_folder_that_cannot_be_written(course, monkeypatch):
    def refuse(*_, **__):
        raise OSError(errno.EROFS, "Read-only file system")

    course.mine.mkdir()
    monkeypatch.setattr("pathlib.Path.open", refuse)
    line = said(course)
    assert "(Read-only file system)" in line
    assert line.endswith("clone the course to a folder of your own")


def test_a_folder_in_the_place_of_a_lesson(course):
    (course.mine / "a.ipynb").mkdir(parents=True)
    assert "see that it is an ordinary folder of yours" in said(course)


def test_a_save_at_the_same_moment_is_not_lost(course, monkeypatch):
    course.start()
    course.ship(a=notebook("1 corrected"))
    bring_one = working_copies._bring_one

    def save_in_between(*arguments):
        origin = bring_one(*arguments)
        course.write("a", notebook("saved just now"))
        return origin

    monkeypatch.setattr(working_copies, "_bring_one", save_in_between)
    assert said(course) == "a.ipynb was saved while it was brought up to date; start again"
    assert course.read("a") == notebook("saved just now")
    monkeypatch.undo()
    assert course.start().beside == [("a.ipynb", "a (version 0.2.0).ipynb")]


def test_two_starts_at_once_give_one_result(course):
    course.ship(**{f"lesson{i}": notebook(str(i)) for i in range(20)})
    code = (
        "import sys; from imgproc_course.working_copies import bring_lessons; "
        "brought = bring_lessons(sys.argv[1], sys.argv[2], '0.2.0'); "
        "assert not brought.beside and not brought.corrected; print(len(brought.new))"
    )
    command = [sys.executable, "-c", code, course.notebooks, course.mine]
    running = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(3)]
    counts = sorted(int(process.communicate()[0]) for process in running)
    assert counts == [0, 0, 22]
    assert len(course.files()) == 22
    assert [name for name in course.everything() if name.endswith(".tmp")] == []
