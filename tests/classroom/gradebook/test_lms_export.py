"""The tables of points, as other programs read them; no cell is a formula."""

import csv
import io

import pytest
from nbclassroom.gradebook.grade import grade_submissions
from submissions import answers_of, notebook, write

pytestmark = pytest.mark.sandbox


@pytest.fixture(scope="module")
def table(light, key_path, tmp_path_factory):
    folder = tmp_path_factory.mktemp("tables")
    submissions = folder / "submissions"
    right, untouched = notebook(light, answers_of(light, "right")), notebook(light)
    write(submissions / "Ada, Lovelace_12345_assignsubmission_file_" / "x.ipynb", right)
    write(submissions / "Bob_678_assignsubmission_file_" / "20_light.ipynb", b"{")
    write(submissions / "eveadam_LATE_42_900_20_light.ipynb", untouched)
    write(submissions / '=cmd|" ,x\n;y' / "x.ipynb", right)
    out = folder / "grades"
    layouts = ("Moodle", "Canvas", "{learner}")
    grade_submissions(submissions, [key_path], out, workers=1, layouts=layouts)
    return (out / "grades.csv").read_bytes()


def rows(data, encoding="utf-8"):
    return list(csv.DictReader(io.StringIO(data.decode(encoding), newline="")))


def test_the_table_for_a_spreadsheet(table):
    assert table.startswith(b"\xef\xbb\xbf")
    by_learner = {row["learner"]: row for row in rows(table, "utf-8-sig")}
    assert set(by_learner) == {"Ada, Lovelace", "Bob", "eveadam", "'=cmd|\" ,x\\n;y"}
    ada = by_learner["Ada, Lovelace"]
    assert (ada["points"], ada["max_points"], ada["percent"], ada["late"]) == ("6", "6", "100.0", "")
    assert by_learner["eveadam"]["late"] == "late"
    assert by_learner["Bob"]["status"] == "not graded" and "not a notebook" in by_learner["Bob"]["findings"]
    assert by_learner["'=cmd|\" ,x\\n;y"]["points"] == "6"


def test_no_cell_of_the_table_is_a_formula(table):
    for row in csv.reader(io.StringIO(table.decode("utf-8-sig"), newline="")):
        assert not [cell for cell in row if cell.startswith(("=", "+", "-", "@", "\t", "\r"))]
