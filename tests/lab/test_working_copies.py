"""Working copies: an update never overwrites the learner's work; it adds the new lesson beside it."""

import errno
import json
import subprocess
import sys

import pytest
from nbclassroom.lab import working_copies
from nbclassroom.lab.working_copies import update_lessons


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
    """A small checkout: `ship` writes lessons as an update does, `start` copies them."""

    def __init__(self, folder):
        self.notebooks = folder / "notebooks"
        self.copies = folder / "my_lessons"
        self.notebooks.mkdir()

    def ship(self, **lessons):
        for name, text in lessons.items():
            (self.notebooks / f"{name}.ipynb").write_text(text)

    def start(self, version="0.2.0"):
        return update_lessons(self.notebooks, self.copies, version)

    def read(self, name):
        return (self.copies / f"{name}.ipynb").read_text()

    def write(self, name, text):
        (self.copies / f"{name}.ipynb").write_text(text)

    def files(self):
        return sorted(path.name for path in self.copies.iterdir() if not path.name.startswith("."))

    def all_files(self):
        return (
            {path.name: path.read_bytes() for path in self.copies.iterdir()} if self.copies.exists() else None
        )


@pytest.fixture
def course(tmp_path):
    course = Course(tmp_path)
    course.ship(a=notebook("1"), b=notebook("2"))
    return course


def test_the_first_start_copies_every_lesson(course):
    changes = course.start()
    assert course.files() == ["a.ipynb", "b.ipynb"]
    assert course.read("a") == notebook("1")
    assert list(changes.lines()) == ["New in my_lessons/: a.ipynb, b.ipynb"]


OUTPUT = {"output_type": "stream", "name": "stdout", "text": "36 %"}


def test_a_copy_has_no_outputs_and_no_counters(course):
    course.ship(a=notebook("1", outputs=[OUTPUT]))
    course.start()
    copy, lesson = json.loads(course.read("a")), json.loads(notebook("1"))
    assert copy == lesson
    assert (copy["cells"][0]["outputs"], copy["cells"][0]["execution_count"]) == ([], None)


def test_checks_and_solutions_stay_in_the_course(course):
    for name in ("checks/a.json", "solutions/a.json"):
        (course.notebooks / name).parent.mkdir()
        (course.notebooks / name).write_text("{}")
    course.start()
    assert course.files() == ["a.ipynb", "b.ipynb"]


def test_the_texts_of_figures_are_the_newest_and_no_work_of_a_learner(course):
    texts = [course.notebooks / "texts" / "a.json", course.copies / "texts" / "a.json"]
    texts[0].parent.mkdir()
    for text in ("old", "new"):
        texts[0].write_text(text)
        changes = course.start()
        assert (texts[1].read_text(), changes.new) == (text, ["a.ipynb", "b.ipynb"] * (text == "old"))
    assert list(changes.lines()) == ["my_lessons/ is up to date; nothing was changed."]


def test_a_second_start_changes_nothing(course):
    course.start()
    course.write("a", notebook("my work"))
    course.write("b", notebook("2", outputs=[OUTPUT]))
    files_before = course.all_files()
    changes = course.start()
    assert course.all_files() == files_before
    assert list(changes.lines()) == ["my_lessons/ is up to date; nothing was changed."]


def test_masters_and_hidden_files_are_not_for_learners(course):
    for name in ("masters/a.py", ".ipynb_checkpoints/a.ipynb", "masters/deep/b.py"):
        path = course.notebooks / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("x")
    course.start()
    assert sorted(course.all_files()) == [".course.json", ".course.lock", "a.ipynb", "b.ipynb"]


def test_data_files_and_folders_are_copied_too(course):
    (course.notebooks / "figures").mkdir()
    (course.notebooks / "figures" / "robot.png").write_bytes(b"\x89PNG")
    course.start()
    assert (course.copies / "figures" / "robot.png").read_bytes() == b"\x89PNG"
    (course.copies / "figures" / "robot.png").write_bytes(b"scribbled over")
    (course.notebooks / "figures" / "robot.png").write_bytes(b"\x89PNG2")
    changes = course.start("0.3.0")
    assert changes.added_beside == [("figures/robot.png", "figures/robot (version 0.3.0).png")]
    assert (course.copies / "figures" / "robot.png").read_bytes() == b"scribbled over"


def test_an_update_replaces_a_copy_without_work(course):
    course.start()
    course.ship(a=notebook("1 corrected"))
    changes = course.start()
    assert course.read("a") == notebook("1 corrected")
    assert course.files() == ["a.ipynb", "b.ipynb"]
    assert list(changes.lines()) == ["Updated, because you had not changed them: a.ipynb"]


def test_a_notebook_that_jupyterlab_saved_does_not_count_as_work(course):
    course.start()
    saved = json.loads(course.read("a"))
    saved["cells"][0]["source"] = ["1"]  # as a list of lines
    saved["cells"][0]["outputs"] = [OUTPUT]
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
        '{"cells": 3}',
    ],
)
def test_work_stays_and_the_update_is_added_beside_it(course, work):
    course.start()
    course.write("a", work)
    course.ship(a=notebook("1 corrected"))
    changes = course.start("0.2.0")
    assert course.read("a") == work
    assert course.read("a (version 0.2.0)") == notebook("1 corrected")
    assert course.files() == ["a (version 0.2.0).ipynb", "a.ipynb", "b.ipynb"]
    assert list(changes.lines()) == [
        "Updated in the course: a.ipynb. Your file is unchanged; the new one is a (version 0.2.0).ipynb"
    ]


def test_an_update_is_added_once(course):
    course.start()
    course.write("a", notebook("my work"))
    course.ship(a=notebook("1 corrected"))
    course.start()
    course.write("a (version 0.2.0)", notebook("I went on here"))
    files_before = course.all_files()
    assert course.start().added_beside == []
    assert course.all_files() == files_before
    (course.copies / "a (version 0.2.0).ipynb").unlink()
    assert course.start().added_beside == []
    assert course.files() == ["a.ipynb", "b.ipynb"]


def test_a_second_update_has_its_own_name(course):
    course.start()
    course.write("a", notebook("my work"))
    for number, version in enumerate(("0.2.0", "0.2.0", "0.3.0")):
        course.ship(a=notebook(f"correction {number}"))
        course.start(version)
    assert course.read("a") == notebook("my work")
    assert course.read("a (version 0.2.0)") == notebook("correction 0")
    assert course.read("a (version 0.2.0, 2)") == notebook("correction 1")
    assert course.read("a (version 0.3.0)") == notebook("correction 2")


def test_an_update_that_the_learner_copied_by_hand_is_not_reported(course):
    course.start()
    course.ship(a=notebook("1", version="0.2.0"))
    course.write("a", notebook("1", version="0.2.0"))
    assert list(course.start().lines()) == ["my_lessons/ is up to date; nothing was changed."]


def test_an_update_of_the_version_number_alone_is_not_added_beside_work(course):
    course.start()
    course.write("a", notebook("my work"))
    course.ship(a=notebook("1", version="0.2.0"), b=notebook("2", version="0.2.0"))
    changes = course.start()
    assert (changes.added_beside, changes.updated) == ([], ["b.ipynb"])
    assert course.read("a") == notebook("my work")
    assert course.read("b") == notebook("2", version="0.2.0")


def test_an_update_replaces_a_copy_whose_changes_were_undone(course):
    course.start()
    course.write("a", notebook("my work"))
    course.ship(a=notebook("1 corrected"))
    course.start()
    course.write("a", notebook("1"))
    assert course.start().updated == ["a.ipynb"]
    assert course.read("a") == notebook("1 corrected")


def test_a_deleted_copy_is_created_again(course):
    course.start()
    (course.copies / "a.ipynb").unlink()
    assert course.start().new == ["a.ipynb"]
    assert course.read("a") == notebook("1")


def test_a_lesson_that_the_course_no_longer_has_stays(course):
    course.start()
    (course.notebooks / "a.ipynb").unlink()
    kept = "No longer in the course; your file and its progress are kept: a.ipynb"
    assert [kept in course.start().lines() for _ in range(2)] == [True, False]
    assert course.read("a") == notebook("1")


@pytest.mark.parametrize("damage", [None, "{", "[]", '{"lessons": []}', '{"lessons": {"a.ipynb": 3}}'])
def test_without_the_state_file_nothing_is_overwritten(course, damage):
    course.start()
    course.write("a", notebook("my work"))
    course.write("b", notebook("2", outputs=[OUTPUT]))
    state = course.copies / ".course.json"
    state.unlink() if damage is None else state.write_text(damage)
    files_before = {name: data for name, data in course.all_files().items() if not name.startswith(".")}
    changes = course.start()
    assert (changes.new, changes.updated) == ([], [])
    assert changes.added_beside == [("a.ipynb", "a (version 0.2.0).ipynb")]
    files_after = course.all_files()
    assert {name: files_after[name] for name in files_before} == files_before
    assert course.start().added_beside == []


def test_without_the_state_file_an_update_is_not_added_again(course):
    course.start()
    course.write("a", notebook("my work"))
    course.ship(a=notebook("1 corrected"))
    course.start()
    (course.copies / ".course.json").unlink()
    assert course.start().added_beside == []
    assert course.files() == ["a (version 0.2.0).ipynb", "a.ipynb", "b.ipynb"]


def test_the_learners_other_files_stay(course):
    course.copies.mkdir()
    (course.copies / "notes.txt").write_text("mine")
    course.write("a", notebook("mine from before"))
    changes = course.start()
    assert (course.copies / "notes.txt").read_text() == "mine"
    assert course.read("a") == notebook("mine from before")
    assert changes.added_beside == [("a.ipynb", "a (version 0.2.0).ipynb")]


def error_line(course):
    with pytest.raises(ValueError) as raised:
        course.start()
    line = str(raised.value)
    assert "\n" not in line
    return line


def test_a_folder_without_lessons_says_what_to_do(tmp_path):
    with pytest.raises(ValueError, match=r"^there are no lessons in notebooks/; run this from a clone"):
        update_lessons(tmp_path / "notebooks", tmp_path / "my_lessons")
    assert not (tmp_path / "my_lessons").exists()


def test_a_file_where_the_folder_should_be(course):
    course.copies.write_text("hello")
    assert (
        error_line(course)
        == "my_lessons is a file, but the lessons need a folder of this name; rename the file"
    )
    assert course.copies.read_text() == "hello"


@pytest.mark.parametrize("writes_until_full", [0, 1, 2])
@pytest.mark.parametrize("has_work", [False, True])
def test_a_full_disk_costs_no_work_and_the_next_start_completes_the_update(
    course, monkeypatch, writes_until_full, has_work
):
    if has_work:
        course.start()
        course.write("b", notebook("my work"))
        course.ship(a=notebook("1 corrected"), b=notebook("2 corrected"))
    writes, write = [], working_copies.write_file

    def write_until_full(path, data):
        if len(writes) == writes_until_full:
            raise OSError(errno.ENOSPC, "No space left on device")
        writes.append(path)
        write(path, data)

    monkeypatch.setattr(working_copies, "write_file", write_until_full)
    assert error_line(course) == (
        "not all lessons are in my_lessons/; your work there is unchanged (No space left on device); "
        "free 100 MB and start again"
    )
    monkeypatch.undo()
    course.start()
    if has_work:
        assert (course.read("a"), course.read("b")) == (notebook("1 corrected"), notebook("my work"))
        assert course.read("b (version 0.2.0)") == notebook("2 corrected")
    assert course.files() == ["a.ipynb", *["b (version 0.2.0).ipynb"] * has_work, "b.ipynb"]
    assert course.start().written == []


def test_a_folder_that_cannot_be_written(course, monkeypatch):
    def refuse(*_, **__):
        raise OSError(errno.EROFS, "Read-only file system")

    course.copies.mkdir()
    monkeypatch.setattr("pathlib.Path.open", refuse)
    line = error_line(course)
    assert "(Read-only file system)" in line
    assert line.endswith("clone the course to a folder of your own")


def test_a_folder_in_the_place_of_a_lesson(course):
    (course.copies / "a.ipynb").mkdir(parents=True)
    assert "make sure that it is an ordinary folder of yours" in error_line(course)


def test_two_starts_at_once_give_one_result(course):
    course.ship(**{f"lesson{i}": notebook(str(i)) for i in range(20)})
    code = (
        "import sys; from nbclassroom.lab.working_copies import update_lessons; "
        "changes = update_lessons(sys.argv[1], sys.argv[2], '0.2.0'); "
        "assert not changes.added_beside and not changes.updated; print(len(changes.new))"
    )
    command = [sys.executable, "-c", code, course.notebooks, course.copies]
    running = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(3)]
    counts = sorted(int(process.communicate()[0]) for process in running)
    assert counts == [0, 0, 22]
    assert len(course.files()) == 22
    assert [name for name in course.all_files() if name.endswith(".tmp")] == []


# ---------------------------------------------------------------- lessons with other numbers


def lesson(number, *words, name="blur"):
    """A lesson whose heading and links have numbers, as build writes them."""
    heading = f"# {number} · Blur\n[lesson {number}, Blur]({number}_{name}.ipynb)"
    content = json.loads(notebook("x = 1", *words))
    content["cells"].insert(
        0, {"cell_type": "markdown", "id": f"{name}-1", "source": heading, "metadata": {}}
    )
    content["metadata"] = {"imgproc_course": {"lesson": name}}
    return json.dumps(content)


@pytest.fixture
def renumbered(course):
    """A course with one lesson, copied as 03_blur; `renumber` ships it as 04_blur."""
    for path in course.notebooks.iterdir():
        path.unlink()
    course.ship(**{"03_blur": lesson("03")})
    course.start()

    def renumber(*words):
        (course.notebooks / "03_blur.ipynb").unlink()
        course.ship(**{"04_blur": lesson("04", *words)})

    course.renumber = renumber
    return course


def test_a_copy_without_work_gets_the_new_number_and_the_new_content(renumbered):
    renumbered.renumber("y = 2")
    changes = renumbered.start()
    assert renumbered.files() == ["04_blur.ipynb"]
    assert renumbered.read("04_blur") == lesson("04", "y = 2")
    assert changes.renumbered == [("03_blur.ipynb", "04_blur.ipynb")]
    assert changes.updated == ["04_blur.ipynb"] and changes.new == []
    assert renumbered.start().written == []


def test_a_copy_with_work_gets_the_new_number_and_keeps_its_content(renumbered):
    work = lesson("03", "my answer")
    renumbered.write("03_blur", work)
    renumbered.renumber()
    changes = renumbered.start()
    assert renumbered.files() == [
        "04_blur.ipynb"
    ]  # the lesson itself has not changed: no second one beside it
    assert renumbered.read("04_blur") == work
    assert list(changes.lines()) == [
        "Lessons have new numbers, and your work in them is unchanged: 03_blur.ipynb is now 04_blur.ipynb"
    ]
    assert list(renumbered.start().lines()) == ["my_lessons/ is up to date; nothing was changed."]


def test_a_lesson_that_changed_as_well_is_added_beside_work_once(renumbered):
    work = lesson("03", "my answer")
    renumbered.write("03_blur", work)
    renumbered.renumber("y = 2")
    changes = renumbered.start()
    beside = "04_blur (version 0.2.0)"
    assert renumbered.files() == [f"{beside}.ipynb", "04_blur.ipynb"]
    assert (renumbered.read("04_blur"), renumbered.read(beside)) == (work, lesson("04", "y = 2"))
    assert len(list(changes.lines())) == 2
    assert renumbered.start().written == []


def test_nothing_is_overwritten_if_the_new_name_is_taken(renumbered):
    renumbered.write("03_blur", lesson("03", "my answer"))
    renumbered.write("04_blur", "mine as well")
    renumbered.renumber("y = 2")
    changes = renumbered.start()
    assert changes.renumbered == []
    assert renumbered.read("03_blur") == lesson("03", "my answer")
    assert renumbered.read("04_blur") == "mine as well"
    assert renumbered.files() == ["03_blur.ipynb", "04_blur (version 0.2.0).ipynb", "04_blur.ipynb"]
    assert renumbered.start().written == []


def test_without_the_state_file_the_metadata_name_the_lesson(renumbered):
    (renumbered.copies / ".course.json").unlink()
    renumbered.write("02_blur", notebook("not of this course"))
    renumbered.renumber()
    assert renumbered.start().renumbered == [("03_blur.ipynb", "04_blur.ipynb")]
    assert renumbered.read("02_blur") == notebook("not of this course")


def test_a_lesson_whose_number_another_one_gets_is_not_mixed_up_with_it(course):
    course.ship(**{"03_blur": lesson("03"), "04_sharpen": lesson("04", name="sharpen")})
    course.start()
    course.write("03_blur", lesson("03", "my answer"))
    for name in ("03_blur", "04_sharpen"):
        (course.notebooks / f"{name}.ipynb").unlink()
    course.ship(**{"04_blur": lesson("04"), "03_sharpen": lesson("03", name="sharpen")})
    course.start()
    assert course.files() == ["03_sharpen.ipynb", "04_blur.ipynb", "a.ipynb", "b.ipynb"]
    assert course.read("04_blur") == lesson("03", "my answer")
    assert course.read("03_sharpen") == lesson("03", name="sharpen")


def test_an_update_that_was_interrupted_after_the_renaming_is_completed(renumbered):
    renumbered.renumber("y = 2")
    (renumbered.copies / "03_blur.ipynb").rename(renumbered.copies / "04_blur.ipynb")
    changes = renumbered.start()
    assert (changes.updated, renumbered.files()) == (["04_blur.ipynb"], ["04_blur.ipynb"])
    assert renumbered.read("04_blur") == lesson("04", "y = 2")


def test_a_deleted_copy_is_created_under_the_new_number(renumbered):
    (renumbered.copies / "03_blur.ipynb").unlink()
    renumbered.renumber()
    changes = renumbered.start()
    assert (changes.new, changes.renumbered) == (["04_blur.ipynb"], [])
