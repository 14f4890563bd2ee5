"""Tables: what stands in them, as their readers read them, and no formula among it."""

import csv
import io

import pytest
from submissions import answers_of, notebook, write

from imgproc_course.gradebook.grade import grade_submissions

pytestmark = pytest.mark.sandbox


@pytest.fixture(scope="module")
def tables(light, key_path, tmp_path_factory):
    folder = tmp_path_factory.mktemp("tables")
    submissions = folder / "submissions"
    right, untouched = notebook(light, answers_of(light, "right")), notebook(light)
    write(submissions / "Ada, Lovelace_12345_assignsubmission_file_" / "x.ipynb", right)
    write(submissions / "Bob_678_assignsubmission_file_" / "20_light.ipynb", b"{")
    write(submissions / "eveadam_LATE_42_900_20_light.ipynb", untouched)
    write(submissions / '=cmd|" ,x\n;y' / "x.ipynb", right)
    out = folder / "grades"
    grade_submissions(submissions, [key_path], out, workers=1, quiet=True)
    return {path.name: path.read_bytes() for path in [out / "grades.csv", *(out / "exports").iterdir()]}


def rows(data, encoding="utf-8"):
    return list(csv.DictReader(io.StringIO(data.decode(encoding), newline="")))


def test_the_table_for_a_spreadsheet(tables):
    assert tables["grades.csv"].startswith(b"\xef\xbb\xbf")
    found = {row["learner"]: row for row in rows(tables["grades.csv"], "utf-8-sig")}
    assert set(found) == {"Ada, Lovelace", "Bob", "eveadam", "'=cmd|\" ,x\\n;y"}
    ada = found["Ada, Lovelace"]
    assert (ada["points"], ada["max_points"], ada["percent"], ada["late"]) == ("6", "6", "100.0", "")
    assert found["eveadam"]["late"] == "late"
    assert found["Bob"]["status"] == "not graded" and "not a notebook" in found["Bob"]["findings"]
    assert found["'=cmd|\" ,x\\n;y"]["points"] == "6"


def test_no_cell_of_any_table_is_a_formula(tables):
    for data in tables.values():
        for row in csv.reader(io.StringIO(data.decode("utf-8-sig"), newline="")):
            assert not [cell for cell in row if cell.startswith(("=", "+", "-", "@", "\t", "\r"))]


def test_moodles_worksheet(tables):
    found = rows(tables["moodle-20_light.csv"])
    assert list(found[0]) == [
        "Identifier",
        "Full name",
        "Grade",
        "Last modified (grade)",
        "Feedback comments",
    ]
    assert [(row["Identifier"], row["Grade"]) for row in found] == [
        ("Participant 12345", "6"),
        ("Participant 678", "0"),
    ]
    assert "moodle-21_sound.csv" not in tables


def test_canvas_gradebook(tables):
    points, eve = rows(tables["canvas.csv"])
    assert list(points)[:5] == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section"]
    assert (points["Student"].strip(), points["20_light"]) == ("Points Possible", "6")
    assert (eve["Student"], eve["ID"], eve["20_light"]) == ("eveadam", "42", "0")
    assert "21_sound" not in eve  # nobody handed it in: its column would take grades away


def test_nbgraders_columns(tables):
    found = rows(tables["nbgrader.csv"])
    first = ["assignment", "duedate", "timestamp", "student_id", "last_name", "first_name", "email"]
    assert list(found[0]) == [*first, "raw_score", "late_submission_penalty", "score", "max_score"]
    ada = next(
        row for row in found if row["student_id"] == "Ada, Lovelace" and row["assignment"] == "20_light"
    )
    assert (float(ada["score"]), float(ada["max_score"])) == (6.0, 6.0)
    assert ada["timestamp"] == "2026-11-30 12:00:00"
    assert len(found) == 2 * 4
