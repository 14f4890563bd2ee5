"""What arrives as one person's replaces nobody else's, and one submission costs only its sender."""

import json
import os
import shutil
import tempfile
import zipfile
from datetime import datetime
from pathlib import Path

import pytest
from submissions import answers_of, make_zip, notebook, write

from imgproc_course.classroom.gradebook import learners as learners_module
from imgproc_course.classroom.gradebook.archives import CollectError
from imgproc_course.classroom.gradebook.collect import collect, local_time
from imgproc_course.classroom.gradebook.csv_table import TableError
from imgproc_course.classroom.gradebook.learners import read_all, require_one_person_each, unproven_dates
from imgproc_course.classroom.gradebook.result_store import ResultStore
from imgproc_course.classroom.gradebook.roster import names_in_roster, read_roster, roster_report
from imgproc_course.classroom.gradebook.teacher_tables import Deadlines

LESSONS = ("light", "sound")
BOB_IN_MOODLE = "Bob Ray_7_assignsubmission_file_/20_light.ipynb"


@pytest.fixture
def read(answer_keys, tmp_path):
    """Reads a folder without grading it; returns (collection, {name: Learner})."""
    (tmp_path / "results").mkdir()

    def learners_of(submissions, **options):
        store = ResultStore(tmp_path / "results", {})
        with collect(submissions, LESSONS) as collection:
            learners = read_all(collection, answer_keys, store, quiet=True, **options)
        return collection, {learner.name: learner for learner in learners}

    return learners_of


def counting(learner):
    return learner.submissions["light"].file.source


def findings(collection, kind="sender"):
    return [(finding.learner, finding.text) for finding in collection.findings if finding.kind == kind]


def test_a_learners_zip_is_the_learners_whatever_it_names(read, light, submissions):
    data = json.dumps(notebook(light))
    write(submissions / "bob" / "20_light.ipynb", data)
    names = ["bob/20_light.ipynb", "bob.ipynb", BOB_IN_MOODLE]
    make_zip(submissions / "eve.zip", [(name, data) for name in names], datetime(2099, 1, 1))
    collection, learners = read(submissions)
    assert sorted(learners) == ["bob", "eve"]
    assert counting(learners["bob"]) == "bob/20_light.ipynb" and learners["bob"].earlier == {}
    assert learners["eve"].submissions["light"].file.submitted_at.year == 2026
    ((sender, text),) = findings(collection)
    assert sender == "eve" and "all of it counts as eve's" in text and "unpack it" in text


SEVERAL_PEOPLE = [
    ["GroupA/ada.ipynb", "GroupA/bob.ipynb"],
    ["course/section 1/ada/20_light.ipynb", "course/section 2/cy/sound.ipynb"],
    ["GroupA/ada.ipynb", "GroupA/bob sound.ipynb"],
    ["GroupA/student1.ipynb", "GroupA/student2.ipynb"],
    [
        "ilias.zip/Abgaben/Lovelace_Ada_ada_17/20_light.ipynb",
        "ilias.zip/Abgaben/Ray_Bob_bob_18/20_light.ipynb",
    ],
]
ONE_PERSON = [
    ["ada/20_light.ipynb", "ada/20_light-1.ipynb", "ada/old/20_light (2).ipynb", "ada/sound.ipynb"],
    ["ada/imgproc-course/my_lessons/20_light.ipynb", "ada/imgproc-course/notebooks/20_light.ipynb"],
    ["Ada Lovelace/lovelace_20_light.ipynb", "Ada Lovelace/Ada-L sound.ipynb"],
    ["group 7/ada.ipynb", "group 7/ada and bob sound.ipynb"],
    ["ada/week 1/20_light.ipynb", "ada/week 2/21_sound.ipynb", "ada/Homework 3.ipynb"],
    ["ada.zip/20_light.ipynb", "ada.zip/Downloads/20_light (1).ipynb", "ada/-rf.ipynb", "ada/a\nb.ipynb"],
    ["Ada_1_assignsubmission_file_/mine.ipynb", "Ada_1_assignsubmission_file_/better.ipynb"],
    ["20_light/ada.ipynb", "20_light/bob.ipynb", "21_sound/ada.ipynb", "cy.ipynb", "dora_20_light-1.ipynb"],
]


@pytest.mark.parametrize("names", [*SEVERAL_PEOPLE, *ONE_PERSON])
def test_files_that_name_several_people_are_not_one_learners(read, masters, submissions, names):
    """The table of a class that has the name of the folder says that it is a learner's, or a group's."""
    for name in names:
        lesson = notebook(masters["sound" if "sound" in name else "light"])
        archive, is_zip, member = name.partition(".zip/")
        if not is_zip:
            write(submissions / name, lesson)
            continue
        with zipfile.ZipFile(submissions / f"{archive}.zip", "a") as opened:
            opened.writestr(member, json.dumps(lesson))
    learners = list(read(submissions)[1].values())
    require_one_person_each(learners, LESSONS, {learner.name for learner in learners})
    if names in ONE_PERSON:
        return require_one_person_each(learners, LESSONS, set())
    with pytest.raises(CollectError, match="--roster") as refused:
        require_one_person_each(learners, LESSONS, set())
    assert [line.strip() for line in str(refused.value).splitlines()[1:-1]] == sorted(names)


def test_a_name_in_a_platforms_zip_does_not_replace_a_submission_of_its_own(read, light, submissions):
    data = json.dumps(notebook(light, answers_of(light, "right")))
    write(submissions / "Bob Ray" / "20_light.ipynb", json.dumps(notebook(light)))  # has no answers
    names = [BOB_IN_MOODLE, BOB_IN_MOODLE.replace("Bob Ray_7", "Cy_9")]
    make_zip(submissions / "all.zip", [(name, data) for name in names], datetime(2099, 1, 1))
    collection, learners = read(submissions)
    assert sorted(learners) == ["Bob Ray", "Cy"]
    assert counting(learners["Bob Ray"]) == "Bob Ray/20_light.ipynb"
    ((sender, text),) = findings(collection)
    assert sender == "all.zip" and "whose own submission of light counts" in text
    assert learners["Bob Ray"].submissions["light"].content.findings == []


def test_a_folder_with_a_number_hides_no_submission_of_another(read, light, submissions):
    write(submissions / "bob" / "20_light.ipynb", notebook(light), datetime(2026, 11, 1))
    write(submissions / "07_eve" / "bob.ipynb", notebook(light), datetime(2026, 11, 30))
    collection, learners = read(submissions)
    assert counting(learners["bob"]) == "bob/20_light.ipynb"
    assert [sender for sender, _ in findings(collection)] == ["07_eve"]


def test_dates_in_a_platforms_zip_are_shown_and_reported_if_they_decide(read, light, submissions):
    make_zip(
        submissions / "class.zip",
        [(BOB_IN_MOODLE, json.dumps(notebook(light)))],
        when=datetime(2026, 11, 1, 8),
        modified=datetime(2026, 12, 5),
    )
    deadlines = Deadlines(datetime(2026, 12, 1))
    collection, learners = read(submissions)
    file = learners["Bob Ray"].submissions["light"].file
    assert file.submitted_at == datetime(2026, 11, 1, 8)
    assert not deadlines.is_late("Bob Ray", "light", file)
    (finding,) = unproven_dates(collection.files, deadlines.deadline)
    assert (finding.kind, finding.file) == ("date", "class.zip")
    assert "1 of its files are in time only by the dates in this zip" in finding.text
    assert list(unproven_dates(collection.files, datetime(2026, 12, 6))) == []


def test_a_date_in_a_learners_zip_is_not_believed(read, light, submissions):
    members = [("20_light.ipynb", json.dumps(notebook(light)))]
    make_zip(submissions / "bob.zip", members, datetime(2020, 1, 1), modified=datetime(2026, 12, 5))
    file = read(submissions)[1]["bob"].submissions["light"].file
    assert Deadlines(datetime(2026, 12, 1)).is_late("bob", "light", file)


def test_a_folder_that_cannot_be_read_costs_nobody_else(light):
    folder = Path(tempfile.mkdtemp(prefix="intake-"))
    folder.chmod(0o755)
    try:
        write(folder / "ada" / "20_light.ipynb", notebook(light))
        write(folder / "bob" / "inner" / "20_light.ipynb", notebook(light))
        write(folder / "bob" / "x.ipynb", notebook(light))
        write(folder / "cy" / "20_light.ipynb", notebook(light))
        write(folder / "dora" / "x.ipynb", b"")
        write(folder / "dora" / "x.txt", b"")
        for path in (folder / "cy", folder / "bob" / "inner"):
            path.chmod(0)
        (folder / "dora").chmod(0o444)  # its names can be listed, and no more
        if os.geteuid() == 0:  # the superuser reads every folder
            os.seteuid(65534)
        with collect(folder, LESSONS) as collection:
            reasons = {(file.learner, file.source): file.reason for file in collection.files}
    finally:
        if os.getuid() == 0:
            os.seteuid(0)
        for path in (folder / "cy", folder / "bob" / "inner", folder / "dora"):
            path.chmod(0o755)
        shutil.rmtree(folder)
    unreadable = "the folder cannot be read (Permission denied)"
    assert reasons == {
        ("ada", "ada/20_light.ipynb"): "",
        ("bob", "bob/inner"): unreadable,
        ("bob", "bob/x.ipynb"): "",
        ("cy", "cy"): unreadable,
        ("dora", "dora/x.ipynb"): "it cannot be read (Permission denied)",
    }


def test_a_sender_has_a_budget_of_bytes_and_of_other_files(read, light, submissions):
    for number in range(5):
        with write(submissions / "eve" / f"{number}.ipynb", b"").open("wb") as file:
            file.truncate(45_000_000)
    for number in range(40):
        write(submissions / "eve" / f"{number}.txt", b"")
    write(submissions / "fay" / "essay.pdf", b"")
    with collect(submissions, LESSONS) as collection:
        reasons = [file.reason for file in collection.files]
    assert reasons[:4] == [""] * 4 and "more than 200 MB" in reasons[4]
    assert len(collection.ignored) == 22 and "eve: 20 more files" in collection.ignored
    assert "no notebook (*.ipynb) and no zip" in reasons[5] and len(reasons) == 6


def test_who_sends_no_notebook_is_told_so(light, submissions):
    """A learner, or a lesson, that is in no table is seen by nobody."""
    for name in ("essay.7z", "notes.txt"):
        write(submissions / "fay" / name, b"")
    for name in ("20_light.ipynb", "20_light.py", "light.json", "21_shade.ipynb.download", "my_shade.py"):
        write(submissions / "eve" / name, notebook(light))
    write(submissions / "bob" / ".DS_Store", b"")
    write(submissions / "roster.csv", b"")
    with collect(submissions, ("light", "shade")) as collection:
        reasons = {file.source: file.reason for file in collection.files if file.reason}
    text = "it is no notebook (*.ipynb) and no zip; submit the notebook itself"
    assert reasons == {"eve/21_shade.ipynb.download": text, "fay/essay.7z": text}
    assert ("bob", "no notebook and no zip") in findings(collection, "file")


def test_the_time_for_reading_belongs_to_the_sender(read, light, submissions, monkeypatch):
    monkeypatch.setattr(learners_module, "READING_SECONDS", 0)
    for number in range(2):
        write(submissions / "eve" / f"{number}.ipynb", notebook(light))
    write(submissions / "bob.ipynb", notebook(light))
    learners = read(submissions)[1]
    assert counting(learners["eve"]) == "eve/0.ipynb"
    (unread,) = learners["eve"].unidentified
    assert "took too much time" in unread.content.reason
    assert learners["bob"].submissions["light"].content.reason == ""


def test_without_notebooks_nothing_is_written(key_path, submissions, grade, tmp_path):
    with pytest.raises(CollectError, match="no notebooks"):
        grade(submissions)
    assert not (tmp_path / "grades").exists()
    with pytest.raises(
        CollectError, match=r"does not exist; give the folder or the zip with the submissions$"
    ):
        grade(submissions / "nowhere")


ROSTERS = {
    "canvas": (
        "Student,ID,SIS User ID,SIS Login ID,Section,light (1)\n,,,,,\n    Points Possible,,,,,6\n"
        '"Lovelace, Ada",12,,al1,One,\n'
        '"Ray, Bob",7,,br1,One,\n"Student, Test",99,,x,One,\n"Ray, Cy",8,,cr1,One,\n'
    ),
    "worksheet": (
        "Identifier,Full name,Email address,Status,Grade\nParticipant 12,Ada Lovelace,ada@x.org,,\n"
        "Participant 7,Bob Ray,bob@x.org,,\nParticipant 8,Cy Ray,cy@x.org,,\n"
    ),
    "participants": (
        "\ufeffFirst name;Last name;ID number;Email address\nAda;Lovelace;1;ada@x.org\n"
        "Bob;Ray;2;bob@x.org\nCy;Ray;3;cy@x.org\n"
    ),
    "by hand": "name\nAda Lovelace\nBob Ray\nCy Ray\n",
}


@pytest.mark.parametrize("name", ROSTERS)
@pytest.mark.parametrize(
    "ada",
    ["Ada Lovelace.ipynb", "Ada Lovelace_12_assignsubmission_file_/x.ipynb", "lovelaceada_12_3_x.ipynb"],
)
def test_a_roster_shows_who_handed_in_nothing(read, light, submissions, tmp_path, name, ada):
    roster = tmp_path / "roster.csv"
    roster.write_text(ROSTERS[name], encoding="utf-8")
    for source in (ada, "bobray/20_light.ipynb", "dora.ipynb"):
        write(submissions / source, notebook(light))
    learners = list(read(submissions)[1].values())
    report = roster_report(read_roster(roster), learners)
    assert report["count"] == 3
    assert [squeezed.replace(",", "").split() for squeezed in report["missing"]] in (
        [["Cy", "Ray"]],
        [["Ray", "Cy"]],
    )
    assert report["unknown"] == ["dora"]


def test_the_numbers_of_a_class_list_are_no_part_of_the_name(read, light, submissions, tmp_path):
    roster = tmp_path / "roster.csv"
    roster.write_text("name\nAda\nBob\nCy\nDora\n", encoding="utf-8")
    for folder in ("01_ada", "02_bob", "bob", "03_cy", "04_cy", "Dora 2"):
        write(submissions / folder / "20_light.ipynb", notebook(light))
    learners = list(read(submissions)[1].values())
    report = roster_report(read_roster(roster), learners)
    assert report["missing"] == ["Cy", "Dora"]
    assert report["unknown"] == ["02_bob", "03_cy", "04_cy", "Dora 2"]
    names = names_in_roster(read_roster(roster), learners)
    assert names == {"Ada": "01_ada", "Bob": "bob", "Cy": None, "Dora": None}


def test_a_canvas_number_decides_between_people_of_one_name(read, light, submissions, tmp_path):
    roster = tmp_path / "roster.csv"
    roster.write_text('Student,ID,Section\n"Ray, Bob",7,One\n"Ray, Bob",8,One\n', encoding="utf-8")
    write(submissions / "raybob_8_3_x.ipynb", notebook(light))
    report = roster_report(read_roster(roster), list(read(submissions)[1].values()))
    assert report == {"count": 2, "missing": ["Ray, Bob"], "unknown": []}


def test_a_table_without_names_is_no_roster(tmp_path):
    path = tmp_path / "roster.csv"
    path.write_text("Section,Grade\nOne,3\n", encoding="utf-8")
    with pytest.raises(TableError, match="its columns are section, grade; expected one that names people"):
        read_roster(path)


@pytest.mark.parametrize(
    ("names", "shown"),
    [
        (("Ada", "Ada "), "Ada"),
        (("l\u00e9a", "le\u0301a"), "l\u00e9a"),
        (("x" * 130, "x" * 131), "x" * 119 + "…"),
        (("a\u200b", "a\\u200b"), "a\\u200b"),
    ],
)
def test_names_that_look_alike_are_two_people(submissions, names, shown):
    for name in names:
        write(submissions / name / "20_light.ipynb", b"{}")
    with collect(submissions, LESSONS) as collection:
        learners = [file.learner for file in collection.files]
    first, other = sorted(learners, key=len)
    assert first == shown
    assert other.startswith(f"{shown} [") and len(other) == len(f"{shown} [3f9a01]")
    text = f"its name looks like {shown}, but is another one; the two are graded apart"
    assert findings(collection) == [(other, text)]


def test_a_name_that_looks_like_one_of_ours_is_another_one(submissions):
    for name in ("Ada", "Ada "):
        write(submissions / name / "20_light.ipynb", b"{}")
    with collect(submissions, LESSONS) as collection:
        ours = max((file.learner for file in collection.files), key=len)
    write(submissions / ours / "20_light.ipynb", b"{}")
    with collect(submissions, LESSONS) as collection:
        assert sorted(file.learner for file in collection.files) == ["Ada", ours, f"{ours}'"]


@pytest.mark.parametrize(
    "names",
    [("ada", "Ada"), ("ada l", "ada  l"), ("ada", "\u0430da"), ("ada.ipynb", "ada .ipynb"), ("ada", "ada ")],
)
def test_names_that_differ_by_a_space_the_case_or_a_letter_replace_nobody(read, light, submissions, names):
    for year, name in enumerate(names, 2026):
        path = submissions / name / "20_light.ipynb" if ".ipynb" not in name else submissions / name
        write(path, notebook(light), datetime(year, 1, 1))
    _, learners = read(submissions)
    assert len(learners) == 2 and not any(learner.earlier for learner in learners.values())


@pytest.mark.parametrize("other", ["ada _20_light.ipynb", "ada-20_light.ipynb", "ada  20_light.ipynb"])
def test_a_file_that_gives_one_name_in_another_spelling_is_reported(read, light, submissions, other):
    write(submissions / "ada_20_light.ipynb", notebook(light), datetime(2026, 1, 1))
    write(submissions / "ada_20_light-1.ipynb", notebook(light), datetime(2026, 1, 2))
    write(submissions / other, notebook(light), datetime(2027, 1, 1))
    write(submissions / "ada-21_sound.ipynb", b"{}")
    collection, _ = read(submissions)
    ((learner, text),) = findings(collection)
    assert learner == "ada" and "with ada_20_light.ipynb it gives one name" in text


def test_two_forms_of_one_letter_in_different_folders_are_one_person(submissions):
    write(submissions / "light" / "l\u00e9a.ipynb", b"{}")
    write(submissions / "sound" / "le\u0301a.ipynb", b"{}")
    with collect(submissions, LESSONS) as collection:
        assert [file.learner for file in collection.files] == ["l\u00e9a", "l\u00e9a"]
    assert findings(collection) == []


def test_a_folder_named_like_a_lesson_replaces_nobodys_own_submission(read, light, submissions):
    write(submissions / "bob" / "20_light.ipynb", notebook(light))
    late = datetime(2099, 1, 1)
    write(submissions / "light" / "bob" / "20_light.ipynb", notebook(light, answers_of(light, 0)), late)
    write(submissions / "light" / "cy.ipynb", notebook(light), late)
    collection, learners = read(submissions)
    assert sorted(learners) == ["bob", "bob (light)", "cy"]
    assert counting(learners["bob"]) == "bob/20_light.ipynb"
    text = "it names bob, whose own submission of light counts: bob/20_light.ipynb"
    text += "; decisions and extensions for bob are for that one"
    assert findings(collection) == [("light", text)]


def test_a_name_chosen_on_a_platform_replaces_nobodys_own_submission(read, light, submissions):
    write(submissions / "Bob Ray" / "20_light.ipynb", notebook(light))
    write(submissions / BOB_IN_MOODLE, notebook(light), datetime(2099, 1, 1))
    collection, learners = read(submissions)
    assert {name: counting(learner) for name, learner in learners.items()} == {
        "Bob Ray": "Bob Ray/20_light.ipynb",
        "Bob Ray (7)": BOB_IN_MOODLE,
    }
    assert len(findings(collection)) == 1


def test_somebody_can_be_called_like_a_numbered_namesake(read, light, submissions):
    for name in ("Bob Ray_7", "Bob Ray_8", "Bob Ray (7)_9"):
        write(submissions / f"{name}_assignsubmission_file_" / "20_light.ipynb", notebook(light))
    _, learners = read(submissions)
    assert sorted(learners) == ["Bob Ray (7)", "Bob Ray (7) (so named)", "Bob Ray (8)"]


@pytest.mark.parametrize(
    ("seconds", "moment"),
    [
        (2**40, datetime(9999, 12, 31, 23, 59, 59)),
        (-(2**40), datetime(1, 1, 1)),
        (0, datetime.fromtimestamp(0)),
    ],
)
def test_a_date_beyond_the_calendar_ends_nothing(seconds, moment):
    """Some file systems store years after 9999."""
    assert local_time(seconds) == moment


def test_of_two_with_nearly_one_name_the_tables_mean_the_exact_one(read, light, submissions, tmp_path):
    for name in ("Bob Ray", "bob-ray"):
        write(submissions / name / "20_light.ipynb", notebook(light))
    (tmp_path / "roster.csv").write_text("name\nBob Ray\n", encoding="utf-8")
    names = names_in_roster(read_roster(tmp_path / "roster.csv"), list(read(submissions)[1].values()))
    assert names["Bob Ray"] == "Bob Ray"
