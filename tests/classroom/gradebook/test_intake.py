"""What arrives as one person's replaces nobody else's, and one submission costs only its sender."""

import json
import os
import shutil
import tempfile
import zipfile
from datetime import datetime
from pathlib import Path

import pytest
from nbclassroom.gradebook import learners as learners_module
from nbclassroom.gradebook.archives import CollectError
from nbclassroom.gradebook.collect import Collection
from nbclassroom.gradebook.csv_table import TableError
from nbclassroom.gradebook.learners import read_all
from nbclassroom.gradebook.result_store import ResultStore
from nbclassroom.gradebook.roster import names_in_roster, read_roster, roster_report
from nbclassroom.gradebook.teacher_tables import TeacherRules
from submissions import answers_of, make_zip, notebook, write

LESSONS = ("light", "sound")


@pytest.fixture
def read(answer_keys, tmp_path):
    """Reads a folder without grading it; returns (collection, {name: Learner})."""
    (tmp_path / "results").mkdir()

    def learners_of(submissions, **options):
        store = ResultStore(tmp_path / "results", {})
        with Collection(submissions, LESSONS, **options) as collection:
            learners = read_all(collection, answer_keys, store)
        return collection, {learner.name: learner for learner in learners}

    return learners_of


def reason(file):
    try:
        return file.read() and ""
    except CollectError as error:
        return str(error)


def counting(learner):
    return learner.submissions["light"].file.source


def texts(learner):
    return learner.submissions["light"].texts_about("")


def test_a_learners_zip_is_the_learners_whatever_it_names(read, light, submissions):
    data = json.dumps(notebook(light))
    write(submissions / "bob" / "20_light.ipynb", data)
    names = ["bob/20_light.ipynb", "bob.ipynb", "Bob Ray_7_assignsubmission_file_/20_light.ipynb"]
    make_zip(submissions / "eve.zip", [(name, data) for name in names], datetime(2099, 1, 1))
    with pytest.raises(CollectError, match="nothing says whose these are; 1 others fit"):
        read(submissions)
    _, learners = read(submissions, layouts=["{learner}"])
    assert sorted(learners) == ["bob", "eve"]
    assert counting(learners["bob"]) == "bob/20_light.ipynb" and learners["bob"].earlier == {}
    assert learners["eve"].submissions["light"].file.submitted_at.year == 2026


MOODLE, CANVAS = "Ada_1_assignsubmission_file_", "ada_77"
ORDERED = [  # the later one is the last
    (f"{MOODLE}/20_light.ipynb", f"{MOODLE}/mine.ipynb"),  # by the dates
    (f"{CANVAS}_100_20_light-1.ipynb", f"{CANVAS}_99_20_light.ipynb"),
    ("Ada - 20_light.ipynb", "Ada - 20_light (1).ipynb"),
    ("Abgaben/L_Ada_al_7/20_light.ipynb", "Abgaben/L_Ada_al_7/20_light (2).ipynb"),
    ("ada/20_light.ipynb", "ada/20_light (1).ipynb"),
]
UNORDERED = [
    ("ada/20_light.ipynb", "ada/20_light-1.ipynb"),
    ("ada/20_light.ipynb", "ada/old/20_light.ipynb"),
    ("ada_20_light.ipynb", "ada_20_light (1).ipynb"),  # anybody can choose such a name
    ("ada.ipynb", "ada.zip/20_light.ipynb"),
    ("light/ada.ipynb", "sound/ada.ipynb"),
    ("Abgaben/Team 1/L_Ada_al_7/20_light.ipynb", "Abgaben/Team 1/R_Bob_br_8/20_light.ipynb"),
    (f"{CANVAS}_99_20_light.ipynb", f"{CANVAS}_100_mine.ipynb"),
    ("ada.zip/20_light.ipynb", "ada.zip/old/20_light.ipynb"),
]


def _send(submissions, name, made, when):
    archive, is_zip, member = name.partition(".zip/")
    if not is_zip:
        write(submissions / name, made, when)
        return
    with zipfile.ZipFile(submissions / f"{archive}.zip", "a") as opened:
        opened.writestr(member, json.dumps(made))


@pytest.mark.parametrize("first, second", [*ORDERED, *UNORDERED])
def test_of_a_learners_versions_the_platforms_latest_counts_or_the_run_stops(
    read, light, submissions, first, second
):
    is_canvas = first.startswith(f"{CANVAS}_100")
    for day, (name, kind) in enumerate([(first, "right"), (second, 0)], 1):
        _send(submissions, name, notebook(light, answers_of(light, kind)), datetime(2026, 11, day))
    if (first, second) in UNORDERED:
        with pytest.raises(
            CollectError, match="different answers to one lesson, and nothing orders"
        ) as stopped:
            read(submissions)
        assert stopped.value.exit_code == 3
        (line,) = [line for line in str(stopped.value).splitlines() if line.startswith("  ")]
        assert first.partition(".zip")[0] in line and "light: " in line
        return
    ((learner,),) = [read(submissions)[1].values()]
    latest, other = (first, second) if is_canvas else (second, first)
    assert counting(learner) == latest
    assert [one.file.source for one in learner.earlier["light"]] == [other]
    assert texts(learner) == [f"submitted 2 times; this one counts: {latest}"]


def test_equal_files_and_files_without_answers_are_no_doubt(read, light, submissions):
    right = notebook(light, answers_of(light, "right"))
    for name, made in {
        "20_light": right,
        "copy": right,
        "20_light-1": notebook(light),
        "final": b"{",
    }.items():
        write(submissions / "ada" / f"{name}.ipynb", made)
    ada = read(submissions)[1]["ada"]
    assert counting(ada) in ("ada/20_light.ipynb", "ada/copy.ipynb")
    assert ada.submissions["light"].answered == frozenset(answers_of(light, "right"))


def test_a_date_in_a_learners_zip_is_not_believed(read, light, submissions):
    members = [("20_light.ipynb", json.dumps(notebook(light)))]
    make_zip(submissions / "bob.zip", members, datetime(2020, 1, 1), modified=datetime(2026, 12, 5))
    file = read(submissions)[1]["bob"].submissions["light"].file
    assert TeacherRules(None, deadline=datetime(2026, 12, 1)).lateness("bob", "light", file)[0]


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
        with Collection(folder, LESSONS) as collection:
            reasons = {(file.learner, file.source): reason(file) for file in collection.files}
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


def test_a_learner_has_a_budget_of_files(submissions):
    for number in range(105):
        write(submissions / "eve" / f"20_light-{number}.ipynb", b"")
    for number in range(40):
        write(submissions / "eve" / f"{number}.txt", b"")
    with Collection(submissions, LESSONS) as collection:
        assert [file.source for file in collection.files if file.reason] == ["eve"]
        assert len(collection.files) == 101
        assert len(collection.ignored) == 21 and "eve: more files" in collection.ignored


def test_who_sends_no_notebook_is_told_so(light, submissions):
    """A learner who is in no table is seen by nobody."""
    for name in ("essay.7z", "notes.txt"):
        write(submissions / "fay" / name, b"")
    for name in ("20_light.ipynb", "20_light.py"):
        write(submissions / "eve" / name, notebook(light))
    write(submissions / "bob" / ".DS_Store", b"")
    write(submissions / "roster.csv", b"")
    with Collection(submissions, LESSONS) as collection:
        reasons = {file.source: file.reason for file in collection.files if file.reason}
    assert reasons == {"fay/essay.7z": "it is no notebook (*.ipynb) and no zip; submit the notebook itself"}
    assert len(collection.ignored) == 5


def test_the_time_for_reading_belongs_to_the_sender(read, light, submissions, monkeypatch):
    monkeypatch.setattr(learners_module, "READING_SECONDS", 0)
    for number in range(2):
        write(submissions / "eve" / f"{number}.ipynb", notebook(light))
    write(submissions / "bob.ipynb", notebook(light))
    learners = read(submissions)[1]
    assert counting(learners["eve"]) == "eve/0.ipynb"
    (unread,) = learners["eve"].unidentified
    assert "took too much time" in unread.reason
    assert learners["bob"].submissions["light"].reason == ""


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
    learners = list(read(submissions, layouts=("Moodle", "Canvas", "{learner}"))[1].values())
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
    "names",
    [
        *(("Ada", "Ada "), ("x" * 130, "x" * 131), ("a\u200b", "a\\u200b"), ("ada", "ada .ipynb")),
        *(("ada", "ada (1)"), ("ada.ipynb", "ada (2).ipynb")),
    ],
)
def test_names_that_look_alike_stop_the_run(submissions, names):
    for name in names:
        write(submissions / name if "ipynb" in name else submissions / name / "20_light.ipynb", b"{}")
    with pytest.raises(CollectError, match="these names look the same, and are different") as stopped:
        Collection(submissions, LESSONS)
    assert " and " in str(stopped.value).splitlines()[1]


@pytest.mark.parametrize("names", [("ada", "Ada"), ("ada l", "ada  l"), ("ada", "\u0430da")])
def test_names_that_differ_by_a_space_the_case_or_a_letter_are_two_people(submissions, names):
    for name in names:
        write(submissions / name / "20_light.ipynb", b"{}")
    with Collection(submissions, LESSONS) as collection:
        assert {file.learner for file in collection.files} == set(names)


def test_two_forms_of_one_letter_are_one_person(submissions):
    write(submissions / "light" / "l\u00e9a.ipynb", b"{}")
    write(submissions / "sound" / "le\u0301a.ipynb", b"{}")
    with Collection(submissions, LESSONS) as collection:
        assert [file.learner for file in collection.files] == ["l\u00e9a", "l\u00e9a"]


def test_namesakes_on_a_platform_have_its_number(read, light, submissions):
    for folder in ("1.zip/Anna_1", "1.zip/Anna_2", "2.zip/Anna_3", "1.zip/Bob_4", "2.zip/Bob_5"):
        _send(submissions, f"{folder}_assignsubmission_file_/x.ipynb", notebook(light), None)
    assert sorted(read(submissions)[1]) == ["Anna (1)", "Anna (2)", "Anna (3)", "Bob"]


def test_of_two_with_nearly_one_name_the_tables_mean_the_exact_one(read, light, submissions, tmp_path):
    for name in ("Bob Ray", "bob-ray"):
        write(submissions / name / "20_light.ipynb", notebook(light))
    (tmp_path / "roster.csv").write_text("name\nBob Ray\n", encoding="utf-8")
    names = names_in_roster(read_roster(tmp_path / "roster.csv"), list(read(submissions)[1].values()))
    assert names["Bob Ray"] == "Bob Ray"
