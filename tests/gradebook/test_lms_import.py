"""Tables that platforms exported, filled with points: every other cell as it was."""

import csv
import io

import pytest
from submissions import answers_of, notebook, write

from imgproc_course.gradebook.grade import grade_submissions
from imgproc_course.gradebook.lms_import import TableError, fill, read_tables

pytestmark = pytest.mark.sandbox

# As lib/gradebook_exporter.rb of Canvas and the grading table of Moodle's assignments write them.
CANVAS = (
    "Student,ID,SIS User ID,SIS Login ID,Section,20_light (901),Essay (902),Current Score\r\n"
    ",,,,,Manual Posting,,\r\n"
    '"    Points Possible",,,,,6.00,10.00,(read only)\r\n'
    '"Adam, Eve",42,s1,eve@school.example,"Mo, We",3.00,9.00,90.0\r\n'
    '"Byron, Ada",43,s2,ada@school.example,Mo,,7.00,70.0\r\n'
    '"Crane, Ichabod",44,s3,ichabod@school.example,Mo,5.00,N/A,\r\n'
    '"Student, Test",45,,,Mo,,,\r\n'
)
MOODLE = (
    "\ufeffIdentifier,Full name,Email address,Status,Grade,Maximum grade,Grade can be changed,"
    "Last modified (submission),Last modified (grade),Feedback comments\r\n"
    'Participant 12345,"Ada, Lovelace",ada@school.example,Submitted for grading,,100.00,Yes,'
    '"Monday, 30 November 2026, 12:00 PM",-,\r\n'
    "Participant 678,Bob,bob@school.example,Submitted for grading,2.00,100.00,Yes,-,-,See me\r\n"
    "Participant 9,Carol,carol@school.example,No submission,,100.00,Yes,-,-,\r\n"
)


@pytest.fixture
def handed_in(light, submissions):
    right, wrong = notebook(light, answers_of(light, "right")), notebook(light, answers_of(light, 0))
    write(submissions / "eveadam_42_900_20_light.ipynb", right)
    write(submissions / "ada@school.example" / "x.ipynb", wrong)
    write(submissions / "Ada, Lovelace_12345_assignsubmission_file_" / "x.ipynb", right)
    write(submissions / "Bob_678_assignsubmission_file_" / "20_light.ipynb", b"{")
    write(submissions / "nobody_77_901_20_light.ipynb", right)
    return submissions


@pytest.fixture
def table(tmp_path):
    """Write a table as exported; gives its path."""

    def written(name, text):
        path = tmp_path / name
        path.write_bytes(text.encode("utf-8"))
        return path

    return written


def cells(text, delimiter=","):
    return list(csv.reader(io.StringIO(text, newline=""), delimiter=delimiter))


def filled(path, grades):
    (table,) = read_tables([path])
    return fill(table, grades)


def test_canvas_gradebook_is_filled_and_nothing_else_of_it_changes(handed_in, grade, table):
    text, told = filled(table("gradebook.csv", CANVAS), grade(handed_in))
    expected = cells(CANVAS)
    expected[3][5], expected[4][5] = "6", "0"  # by the number; by the login that is the folder's name
    assert cells(text) == expected
    assert told == [
        "gradebook.csv: 2 points filled in.",
        "  graded, and in no row of it: Ada, Lovelace, nobody",
    ]


def test_moodles_worksheet_is_filled_and_what_could_not_be_graded_stays(handed_in, grade, table):
    text, told = filled(table("Grades-20_light.csv", MOODLE), grade(handed_in))
    expected = cells(MOODLE)
    expected[1][4] = "6"
    assert cells(text) == expected and text.startswith("\ufeffIdentifier")
    assert "20_light is worth 100 points there and 6 here" in told[-1]


def test_a_table_with_semicolons_and_other_languages_numbers(handed_in, grade, table):
    other = MOODLE.replace("Participant ", "Teilnehmer/in").replace('"Ada, Lovelace"', "Ada")
    other = other.replace('"Monday, 30 November 2026, 12:00 PM"', "30.11.2026").replace(",", ";")
    text, _ = filled(table("20_light.csv", other), grade(handed_in))
    assert cells(text, ";")[1][:5] == [
        "Teilnehmer/in12345",
        "Ada",
        "ada@school.example",
        "Submitted for grading",
        "6",
    ]


def test_a_lesson_may_be_named_by_its_title(handed_in, grade, table, light):
    text, _ = filled(
        table("g.csv", CANVAS.replace("20_light (901)", f"{light.title} (901)")), grade(handed_in)
    )
    assert cells(text)[3][5] == "6"


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "its columns are nothing"),
        ("name,points\r\nada,3\r\n", "its columns are name, points; expected Canvas's gradebook export"),
        ("Student,ID,Group\r\n", "expected Canvas's gradebook export"),
    ],
)
def test_another_table_is_refused_before_anything_is_graded(
    text, reason, handed_in, key_path, table, tmp_path
):
    path = table("any.csv", text)
    with pytest.raises(TableError, match=reason):
        grade_submissions(handed_in, [key_path], tmp_path / "grades", quiet=True, platform_tables=[path])
    assert not (tmp_path / "grades").exists()


def test_what_cannot_be_read_says_why(table, tmp_path):
    latin = tmp_path / "latin.csv"
    latin.write_bytes(b"Student,ID,Section\r\n\xe4,1,\r\n")
    with pytest.raises(TableError, match="it is not UTF-8"):
        read_tables([latin])
    with pytest.raises(TableError, match="it cannot be read"):
        read_tables([tmp_path / "none.csv"])
    with pytest.raises(TableError, match=r"two tables are called a\.csv"):
        read_tables([tmp_path / "a.csv", tmp_path / "b" / "a.csv"])


def test_a_worksheet_of_which_nobody_knows_the_lesson_is_told_and_the_rest_is_there(
    handed_in, masters, key_path, table, tmp_path
):
    write(handed_in / "carol" / "y.ipynb", notebook(masters["21_sound"]))
    out = tmp_path / "grades"
    tables = [table("worksheet.csv", MOODLE), table("canvas.csv", CANVAS.replace("20_light", "First"))]
    tables += [table("20_light.csv", MOODLE)]
    told = grade_submissions(handed_in, [key_path], out, workers=1, quiet=True, platform_tables=tables).text
    assert "worksheet.csv: a worksheet is of one lesson, and it may be of 20_light, 21_sound" in told
    assert "canvas.csv: none of its assignments is called like a lesson (20_light, 21_sound)" in told
    assert sorted(path.name for path in (out / "exports").iterdir() if "filled" in path.name) == [
        "filled-20_light.csv"
    ]
