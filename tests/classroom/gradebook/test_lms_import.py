"""Tables that platforms exported are filled with points; every other cell stays as it was."""

import csv
import io

import pytest
from nbclassroom.gradebook.csv_table import TableError
from nbclassroom.gradebook.grade import grade_submissions
from nbclassroom.gradebook.platforms import fill_table, read_tables
from submissions import answers_of, notebook, write

pytestmark = pytest.mark.sandbox
MIXED = ("Moodle", "Canvas", "{learner}")

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
def submitted(light, submissions):
    right, wrong = notebook(light, answers_of(light, "right")), notebook(light, answers_of(light, 0))
    write(submissions / "eveadam_42_900_20_light.ipynb", right)
    write(submissions / "ada@school.example" / "x.ipynb", wrong)
    write(submissions / "Ada, Lovelace_12345_assignsubmission_file_" / "x.ipynb", right)
    write(submissions / "Bob_678_assignsubmission_file_" / "20_light.ipynb", b"{")
    write(submissions / "nobody_77_901_20_light.ipynb", right)
    return submissions


@pytest.fixture
def table(tmp_path):
    """Writes a table as exported, and returns its path."""

    def write_table(name, text):
        path = tmp_path / name
        path.write_bytes(text.encode("utf-8"))
        return path

    return write_table


def cells(text, delimiter=","):
    return list(csv.reader(io.StringIO(text, newline=""), delimiter=delimiter))


def filled(path, grades):
    (table,) = read_tables([path])
    return fill_table(table, grades)


def test_canvas_gradebook_is_filled_and_nothing_else_changes(submitted, grade, table):
    text, lines = filled(table("gradebook.csv", CANVAS), grade(submitted, layouts=MIXED))
    expected = cells(CANVAS)
    expected[3][5], expected[4][5] = "6", "0"  # by the number; by the login that is the folder's name
    assert cells(text) == expected
    assert lines == [
        "gradebook.csv: 2 points filled in.",
        "  graded, but in no row of the table: Ada, Lovelace, nobody",
    ]


def test_what_a_spreadsheet_would_take_for_a_formula_gets_an_apostrophe(submitted, grade, table):
    evil = CANVAS.replace('"Crane, Ichabod",44,s3', '"=HYPERLINK(1)",44,+A1').replace(",9.00,90.0", ",-9.0,-")
    text, _ = filled(
        table("gradebook.csv", evil.replace("Mo,5.00,N/A,", "@SUM(1),5.00,x;-y,")),
        grade(submitted, layouts=MIXED),
    )
    rows = cells(text)
    assert rows[5] == [
        "'=HYPERLINK(1)",
        "44",
        "'+A1",
        "ichabod@school.example",
        "'@SUM(1)",
        "5.00",
        "x;'-y",
        "",
    ]
    assert rows[3][6:] == ["-9.0", "-"]


def test_a_row_is_found_by_its_name_if_nobody_else_has_it(light, submissions, grade, table):
    right = notebook(light, answers_of(light, "right"))
    for name in ("Ada Lovelace", "Bob", "Cy"):
        write(submissions / name / "20_light.ipynb", right)
    rows = "Participant 1,Ada Lovelace,a@x,,,\nParticipant 2,Bob,b@x,,,\nParticipant 3,bob,c@x,,,\n"
    head = "Identifier,Full name,Email address,Status,Grade,Maximum grade\n"
    text, lines = fill_table(
        read_tables([table("20_light.csv", head + rows)])[0], grade(submissions, layouts=MIXED)
    )
    assert [row[4] for row in cells(text)] == ["Grade", "6", "", ""]
    assert lines == ["20_light.csv: 1 points filled in.", "  graded, but in no row of the table: Bob, Cy"]


def test_a_row_that_two_learners_could_have_is_nobodys(light, submissions, grade, table):
    """Of a login that is one learner's name, and a full name that is another's."""
    right, wrong = notebook(light, answers_of(light, "right")), notebook(light, answers_of(light, 0))
    write(submissions / "Ada Lovelace" / "20_light.ipynb", right)
    for name in ("a@x.ipynb", "c@x.ipynb", "Cy_3_assignsubmission_file_/20_light.ipynb"):
        write(submissions / name, wrong if "x" in name else right)
    head = "Identifier,Full name,Email address,Status,Grade,Maximum grade\n"
    rows = "Participant 1,Ada Lovelace,a@x,,,\nParticipant 2,Cyd,c@x,,,\nParticipant 3,Cy,d@x,,,\n"
    text, lines = fill_table(
        read_tables([table("20_light.csv", head + rows)])[0], grade(submissions, layouts=MIXED)
    )
    assert [row[4] for row in cells(text)] == ["Grade", "", "0", "6"]
    assert lines[1:] == ["  graded, but in no row of the table: a@x, Ada Lovelace"]


def test_empty_lines_of_a_table_stay(submitted, grade, table):
    grades = grade(submitted, layouts=MIXED)
    text, lines = filled(table("gradebook.csv", CANVAS), grades)
    assert filled(table("with empty lines.csv", CANVAS.replace("\r\n", "\r\n\r\n", 1) + "\r\n"), grades) == (
        text.replace("\r\n", "\r\n\r\n", 1) + "\r\n",
        [lines[0].replace("gradebook", "with empty lines"), lines[1]],
    )


def test_moodles_worksheet_is_filled_and_other_grades_stay(submitted, grade, table):
    text, lines = filled(table("Grades-20_light.csv", MOODLE), grade(submitted, layouts=MIXED))
    expected = cells(MOODLE)
    expected[1][4] = "6"
    assert cells(text) == expected and text.startswith("\ufeffIdentifier")
    assert "light is worth 100 points on the platform and 6 here" in lines[-1]


def test_a_table_with_semicolons_and_other_languages_numbers(submitted, grade, table):
    other = MOODLE.replace("Participant ", "Teilnehmer/in").replace('"Ada, Lovelace"', "Ada")
    other = other.replace('"Monday, 30 November 2026, 12:00 PM"', "30.11.2026").replace(",", ";")
    text, _ = filled(table("20_light.csv", other), grade(submitted, layouts=MIXED))
    assert cells(text, ";")[1][:5] == [
        "Teilnehmer/in12345",
        "Ada",
        "ada@school.example",
        "Submitted for grading",
        "6",
    ]


def test_a_column_can_have_the_title_of_the_lesson(submitted, grade, table, light):
    text, _ = filled(
        table("g.csv", CANVAS.replace("20_light (901)", f"{light.title} (901)")),
        grade(submitted, layouts=MIXED),
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
    text, reason, submitted, key_path, table, tmp_path
):
    path = table("any.csv", text)
    with pytest.raises(TableError, match=reason):
        grade_submissions(submitted, [key_path], tmp_path / "grades", platform_tables=[path])
    assert not (tmp_path / "grades").exists()


def test_a_table_that_cannot_be_read(table, tmp_path):
    latin = tmp_path / "latin.csv"
    latin.write_bytes(b"Student,ID,Section\r\n\xe4,1,\r\n")
    with pytest.raises(TableError, match="it is not UTF-8"):
        read_tables([latin])
    with pytest.raises(TableError, match="it cannot be read"):
        read_tables([tmp_path / "none.csv"])
    with pytest.raises(TableError, match=r"two tables have the name a\.csv"):
        read_tables([tmp_path / "a.csv", tmp_path / "b" / "a.csv"])


def test_a_worksheet_of_an_unknown_lesson_is_reported_and_the_others_are_filled(
    submitted, masters, key_path, table, tmp_path
):
    write(submitted / "carol" / "y.ipynb", notebook(masters["sound"]))
    out = tmp_path / "grades"
    tables = [table("worksheet.csv", MOODLE), table("canvas.csv", CANVAS.replace("20_light", "First"))]
    tables += [table("20_light.csv", MOODLE)]
    lines = grade_submissions(
        submitted, [key_path], out, workers=1, platform_tables=tables, layouts=MIXED
    ).text
    assert (
        "worksheet.csv: a worksheet belongs to one lesson, but this one can belong to light, sound" in lines
    )
    assert "canvas.csv: no assignment in it has the name of a lesson (light, sound)" in lines
    assert sorted(path.name for path in (out / "exports").iterdir() if "filled" in path.name) == [
        "filled-20_light.csv"
    ]
