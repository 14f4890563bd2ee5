"""What a teacher adds to the autograder's points: decisions by hand, a late policy, extensions."""

import json
import re
from datetime import datetime, timedelta

import pytest
from nbclassroom.gradebook.csv_table import TableError
from nbclassroom.gradebook.grade import grade_submissions
from nbclassroom.gradebook.teacher_tables import read_late_policy
from submissions import answers_of, notebook, write

pytestmark = pytest.mark.sandbox
DEADLINE = datetime(2026, 12, 1, 23, 59)


@pytest.fixture(scope="module")
def class_folder(masters, key_path, tmp_path_factory):
    """A folder with submissions of four learners and their grades: the tests grade it again from results."""
    folder = tmp_path_factory.mktemp("class")
    light, sound = masters["light"], masters["sound"]
    right, half = notebook(light, answers_of(light, "right")), answers_of(light, "right")
    half["light-halves"] = answers_of(light, "raising")["light-halves"]
    write(folder / "in" / "Ada" / "20_light.ipynb", right, DEADLINE - timedelta(minutes=1))
    write(folder / "in" / "Bob" / "20_light.ipynb", notebook(light, half), DEADLINE + timedelta(minutes=1))
    write(folder / "in" / "Bob" / "21_sound.ipynb", notebook(sound, answers_of(sound, "right")), DEADLINE)
    write(folder / "in" / "=Eve" / "20_light.ipynb", right, DEADLINE + timedelta(days=2, hours=1))
    write(folder / "in" / "'=Eve" / "20_light.ipynb", right, DEADLINE)
    write(folder / "in" / "Zoe" / "20_light.ipynb", b"{", DEADLINE)
    grade_submissions(folder / "in", [key_path], folder / "out", workers=1)
    return folder


@pytest.fixture
def grade(class_folder, key_path, tmp_path):
    """Grades the class again with options; returns {learner: {lesson: entry}}."""

    def grade(decisions="", **options):
        if decisions:
            (tmp_path / "decisions.csv").write_text(decisions, encoding="utf-8")
            options["decisions"] = tmp_path / "decisions.csv"
        options = {"workers": 1} | options
        summary = grade_submissions(class_folder / "in", [key_path], class_folder / "out", **options)
        grades = json.loads((class_folder / "out" / "grades.json").read_text())
        learners = {entry["name"]: entry for entry in grades["learners"]}
        lessons = {
            name: {lesson["lesson"]: lesson for lesson in entry["lessons"]}
            for name, entry in learners.items()
        }
        return lessons, learners, summary

    return grade


HEADER = "learner,lesson,exercise,points,comment\n"


def test_a_decision_replaces_the_points_of_an_exercise(grade, class_folder):
    lessons, learners, _ = grade(HEADER + 'Bob,20_light,light-halves,1.5,"Half of it, in class"\n')
    light = lessons["Bob"]["light"]
    (halves,) = [exercise for exercise in light["exercises"] if exercise["id"] == "light-halves"]
    assert (halves["points"], halves["autograded_points"]) == (1.5, 0)
    assert halves["decision"] == {"points": 1.5, "excused": False, "comment": "Half of it, in class"}
    assert light["points"] == light["autograded_points"] + 1.5
    assert learners["Bob"]["points"] == light["points"] + 4
    page = (class_folder / "out" / learners["Bob"]["page"]).read_text()
    assert "Half of it, in class" in page


@pytest.mark.parametrize(("written", "name"), [("'=Eve", "=Eve"), ("''=Eve", "'=Eve"), ("=Eve", "=Eve")])
def test_a_decision_means_the_name_as_grades_csv_writes_it(grade, class_folder, written, name):
    lessons, _, _ = grade(HEADER + f"{written},light,,1,mine\n")
    assert [learner for learner, entries in lessons.items() if entries["light"]["decision"]] == [name]
    table = (class_folder / "out" / "grades.csv").read_text(encoding="utf-8-sig")
    assert '"\'=Eve"' in table and "\"''=Eve\"" in table


def test_a_bonus_is_written_with_a_plus_and_goes_above_the_maximum(grade):
    light = grade(HEADER + 'Bob,light,,"6+1,5",for the drawing\nAda,light,,6+0.5,\n')[0]["Bob"]["light"]
    assert (light["points"], light["max_points"], light["autograded_points"] < 6) == (7.5, 6, True)


def test_an_excused_exercise_counts_neither_for_nor_against(grade):
    before = grade()[0]["Bob"]["light"]
    light = grade(HEADER + "Bob,light,light-halves,excused,\n")[0]["Bob"]["light"]
    halves = next(exercise for exercise in before["exercises"] if exercise["id"] == "light-halves")
    assert halves["max_points"] > 0 == halves["points"]
    assert light["max_points"] == before["max_points"] - halves["max_points"] == light["points"]


def test_a_decision_on_a_lesson_is_final_and_grades_what_could_not_be_read(grade):
    rows = "Zoe;light;;5;on paper\n=Eve;light;;2;\nAda;sound;;excused;ill\n"
    lessons, _, summary = grade(HEADER.replace(",", ";") + rows, deadline=DEADLINE, late="50% a day")
    assert (lessons["Zoe"]["light"]["status"], lessons["Zoe"]["light"]["points"]) == ("graded", 5)
    assert summary.not_graded == 0
    assert (lessons["=Eve"]["light"]["points"], lessons["=Eve"]["light"]["late_deduction"]) == (2, 0)
    assert (lessons["Ada"]["sound"]["points"], lessons["Ada"]["sound"]["max_points"]) == (0, 0)


@pytest.mark.parametrize(
    ("row", "message"),
    [
        ("Bobb,light,,3,", "row 3: there is no learner 'Bobb'; did you mean 'Bob'?"),
        ("Bob,dark,,3,", "row 3: there is no lesson 'dark'; the key has light, sound"),
        ("Bob,light,sound-mean,3,", "row 3: light has no exercise 'sound-mean'; it has light-double"),
        ("Bob,light,,seven,", "row 3: the points are 'seven'; expected 0 to 6, 6+1 for a bonus, excused"),
        ("Bob,light,,nan,", "row 3: the points are 'nan'; expected 0 to 6"),
        ("Bob,light,,7,", "row 3: the points are '7'; expected 0 to 6"),
        ("Bob,light,,7+1,", "row 3: the points are '7+1'; expected 0 to 6"),
        ("Bob,light,,1+1+1,", "row 3: the points are '1+1+1'; expected 0 to 6"),
        ("Bob,light,,,", "row 3: it decides nothing"),
        ("Bob,light,,3,one,two", "row 3: 6 cells, expected 5; put a text with commas in quotes"),
        ("Ada,sound,sound-mean,1,", "row 3: Ada's sound was not submitted, so it has no exercises"),
        (",light,,3,", "row 3: the cell learner is empty"),
        ("Zoe,light,light-double,1,", "row 3: Zoe's light could not be graded"),
        ("Ada,sound,,1,twice", "row 3: the same as "),
    ],
)
def test_a_bad_row_is_one_line_with_its_number(grade, row, message):
    first = "Ada,sound,,1,once" if "twice" in row else "# a comment"
    with pytest.raises(TableError) as caught:
        grade(HEADER + first + "\n" + row + "\n")
    assert message in str(caught.value) and "\n" not in str(caught.value)


def test_a_row_for_a_name_that_two_have_names_both(light, submissions, key_path, tmp_path):
    for number in (11, 99):
        path = submissions / f"Ada A_{number}_assignsubmission_file_" / "20_light.ipynb"
        write(path, notebook(light, answers_of(light, "right")))
    (tmp_path / "decisions.csv").write_text(HEADER + "Ada A,light,,3,\n", encoding="utf-8")
    message = re.escape("no learner 'Ada A'; did you mean 'Ada A (11)' or 'Ada A (99)'?")
    with pytest.raises(TableError, match=message):
        options = {"workers": 1, "decisions": tmp_path / "decisions.csv"}
        grade_submissions(submissions, [key_path], tmp_path / "out", **options)


def test_decisions_in_the_folder_of_grades_survive_a_regrade_of_everything(class_folder, key_path, grade):
    path = class_folder / "out" / "decisions.csv"
    assert path.read_text(encoding="utf-8-sig").startswith(HEADER)  # the template
    template = path.read_bytes()
    path.write_bytes(template + b"'=Eve,light,light-double,1,talked\r\n")
    try:
        lessons, _, _ = grade(fresh=True)
        kept = path.read_bytes()
    finally:
        path.write_bytes(template)
    assert kept == template + b"'=Eve,light,light-double,1,talked\r\n"
    (double,) = [each for each in lessons["=Eve"]["light"]["exercises"] if each["id"] == "light-double"]
    assert (double["points"], double["decision"]["comment"]) == (1, "talked")


# ---------------------------------------------------------------- late


def test_lateness_costs_what_the_policy_says(grade, class_folder):
    lessons, learners, _ = grade(deadline=DEADLINE, late="10% a day, 2 days")
    ada, bob, eve = (lessons[name]["light"] for name in ("Ada", "Bob", "=Eve"))
    assert (ada["days_late"], ada["points"], ada["late_deduction"]) == (0, 6, 0)
    half = bob["autograded_points"]
    assert (bob["days_late"], bob["points"], bob["late_deduction"]) == (1, half * 0.9, round(half * 0.1, 2))
    assert lessons["Bob"]["sound"]["days_late"] == 0  # to the minute
    assert (eve["days_late"], eve["points"], eve["late_deduction"]) == (3, 0, 6)
    assert grade(deadline=DEADLINE, late="10% a day")[0]["=Eve"]["light"]["points"] == 4.2
    assert "3 days late" in (class_folder / "out" / learners["=Eve"]["page"]).read_text()


def test_an_extension_is_for_one_learner_and_one_lesson(grade, tmp_path):
    table = tmp_path / "extensions.csv"
    table.write_text("learner,lesson,deadline\nBob,,2026-12-02T12:00\n=Eve,light,2026-12-03 12:00\n")
    lessons, _, _ = grade(deadline=DEADLINE, late="10% a day", extensions=table)
    assert (lessons["Bob"]["light"]["late"], lessons["Bob"]["light"]["late_deduction"]) == (False, 0)
    assert (lessons["=Eve"]["light"]["days_late"], lessons["=Eve"]["light"]["points"]) == (1, 5.4)
    table.write_text("learner,lesson,deadline\nBob,light,tomorrow\n")
    with pytest.raises(TableError, match=r"row 2: the deadline is 'tomorrow'; write it like 2026-12"):
        grade(deadline=DEADLINE, extensions=table)


def test_a_row_about_somebody_of_the_roster_who_handed_in_nothing_waits(grade, tmp_path):
    (tmp_path / "roster.csv").write_text("name,email\nBob,bob7@uni.edu\nIlli,illi@uni.edu\nAda,ada@uni.edu\n")
    (tmp_path / "extensions.csv").write_text("learner,deadline\nIlli,2026-12-09\nbob7@uni.edu,2026-12-09\n")
    options = {"deadline": DEADLINE, "extensions": tmp_path / "extensions.csv"}
    decisions = HEADER + "Illi,sound,,excused,Ill that week\n"
    lessons, _, summary = grade(decisions, roster=tmp_path / "roster.csv", **options)
    assert "Illi" not in lessons
    assert not lessons["Bob"]["light"]["late"]  # by the address in the roster
    assert "Of 3 in the roster, 1 have not submitted. Not in it: 3 learners" in summary.text
    with pytest.raises(TableError, match=r"row 2: there is no learner 'Illi'; .* give the --roster"):
        grade(decisions, **options)


@pytest.mark.parametrize("text", ["10%", "ten % a day", "0% a day", "101% a day", "10% a day, soon", ""])
def test_another_late_policy_is_refused(text):
    with pytest.raises(ValueError, match="is no late policy; write"):
        read_late_policy(text)


def test_late_without_a_deadline_is_refused(grade):
    with pytest.raises(ValueError, match="--late needs the deadline"):
        grade(late="10% a day")
