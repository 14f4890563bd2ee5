"""The cheat sheet is built from its source, which computes each number beside its line of Python."""

import html
import re
from pathlib import Path

import pytest
from nbclassroom.authoring.build import build, cheat_sheet_page, compare_lessons
from nbclassroom.exercises.declaration import MasterError

NOTEBOOKS = Path(__file__).parents[3] / "notebooks"
TEMPLATE = NOTEBOOKS / "masters" / "cheat_sheet.html"


@pytest.fixture(scope="module")
def page():
    return cheat_sheet_page(TEMPLATE)


def rows_of(table):
    """The cells of a table, row by row, without tags; row and column numbers are left out."""
    rows = re.findall(r"<tr>(.*?)</tr>", table, re.S)
    cells = [re.findall(r"<td[^>]*>(.*?)</td>", row, re.S) for row in rows]
    return [[html.unescape(cell).strip() for cell in row] for row in cells if any(row)]


def grids(page):
    """{caption: rows of a grid}"""
    tables = re.findall(r'<table class="grid"><caption>(.*?)</caption>(.*?)</table>', page, re.S)
    return {html.unescape(re.sub(r"<[^>]+>", "", caption)): rows_of(table) for caption, table in tables}


def numbers(text):
    return [line.split() for line in text.strip().splitlines()]


def test_a_slice_marks_its_pixels(page):
    table = re.search(r"<caption><code>tiny\[1:3, 1:4\]</code>.*?</table>", page, re.S)[0]
    rows = [re.findall(r"<td( class=\"marked\")?>\d", row) for row in re.findall(r"<tr>.*?</tr>", table)[1:]]
    assert [[bool(mark) for mark in row] for row in rows] == [
        [row in (1, 2) and col in (1, 2, 3) for col in range(5)] for row in range(5)
    ]


def test_tables_of_dtypes_fields_and_encodings(page):
    tables = re.findall(r'<table class="list">.*?</table>', page, re.S)
    rows = {tuple(row) for table in tables for row in rows_of(table)}
    assert {
        ("0 to 255", "1"),
        ("0 to 65,535", "2"),
        ("−32,768 to 32,767", "2"),
        ("with decimals", "8"),
        ("rows, in pixels", "720"),
        ("columns, in pixels", "1280"),
        ("is the more significant byte first?", "0"),
        ("all rows, one after the other: height × step bytes", "2764800"),
        ("uint8, 1", "1", "gray image"),
        ("uint8, 3", "3", "colour; OpenCV's order of the channels"),
        ("uint16, 1", "2", "depth in millimetres"),
        ("float32, 1", "4", "depth in metres"),
    } <= rows  # fmt: skip
    assert "<td>3840</td>" in page  # 1280 pixels of 3 bytes


def test_the_stages_of_canny_are_those_of_opencv(page):
    import cv2
    import numpy as np

    shown = grids(page)
    gray = np.array(shown["stages.smoothed"], np.uint8)
    to_numbers = {name: [[int(text.replace("−", "-")) for text in row] for row in shown[name]] for name in
                  ("stages.grad_col", "stages.grad_row", "stages.magnitude", "stages.edges")}  # fmt: skip
    grad_col = cv2.Sobel(gray, cv2.CV_16S, 1, 0, borderType=cv2.BORDER_REPLICATE)
    grad_row = cv2.Sobel(gray, cv2.CV_16S, 0, 1, borderType=cv2.BORDER_REPLICATE)
    assert to_numbers["stages.grad_col"] == grad_col.tolist()
    assert to_numbers["stages.grad_row"] == grad_row.tolist()
    assert to_numbers["stages.magnitude"] == (abs(grad_col) + abs(grad_row)).tolist()
    assert to_numbers["stages.edges"] == cv2.Canny(gray, 50, 150).tolist()
    # Every case is there: strong, weak and connected, weak and alone, and 50, which is not above 50.
    assert shown["stages.weak, .strong"] == numbers("· · S · w\n· · S · ·\n· · S S w\n· · · · ·\n· · · · ·")
    assert shown["stages.thinned"][4][2] == "50"
    assert shown["stages.edges"][0][4] == "0" and shown["stages.edges"][2][4] == "255"


def test_the_code_is_python_and_the_policies_are_those_of_sensor_data(page):
    qos = pytest.importorskip("rclpy.qos")
    blocks = [html.unescape(block) for block in re.findall(r'<pre class="python">(.*?)</pre>', page, re.S)]
    for block in blocks:
        compile(block, "cheat sheet", "exec")
    names = dict(vars(qos))
    exec(next(block for block in blocks if block.startswith("camera_qos")), names)
    for policy in ("reliability", "durability", "history", "depth"):
        assert getattr(names["camera_qos"], policy) == getattr(qos.qos_profile_sensor_data, policy)


def test_every_block_names_its_lesson_and_nothing_comes_from_a_network(page):
    lessons = re.findall(r'<p class="lesson">(?:section \d+ of )?lesson (\d\d)</p>', page)
    assert len(lessons) == page.count('class="block"') >= 18
    assert set(lessons) <= {path.stem[:2] for path in TEMPLATE.parent.glob("[0-9]*.py")}
    assert "[[" not in page and not re.search('https?:|src=|href=(?!"data:,")|url\\(', page)


SOURCE = '<p>{{ run("number + 1") }} [[blur]] [[blur|a text]]</p>'


@pytest.fixture
def source(tmp_path):
    def write(text=SOURCE, names="number = 41\n"):
        masters = tmp_path / "masters"
        masters.mkdir(exist_ok=True)
        (masters / "01_blur.py").write_text("#     title: Doubling\n")
        (masters / "cheat_sheet.py").write_text(names)
        (masters / "cheat_sheet.html").write_text(text)
        return masters / "cheat_sheet.html"

    return write


@pytest.mark.parametrize(
    ("text", "names", "message"),
    [
        ('{{ run("numbr") }}', "number = 1", "in 'numbr': NameError: name 'numbr' is not defined"),
        ('{{ run("a b") }}', "", "SyntaxError"),
        ("{{ other }}", "", "'other' is undefined"),
        ("{% if %}", "", "TemplateSyntaxError"),
        ("x", "import no_such_module", "No module named 'no_such_module'"),
        ("[[sharpen]]", "", "[[sharpen]] names no lesson"),
    ],
)
def test_an_error_in_the_source_is_refused(source, text, names, message):
    with pytest.raises(MasterError) as error:
        cheat_sheet_page(source(text, names))
    assert str(error.value).startswith("cheat_sheet.html") and message in str(error.value)
    assert "\n" not in str(error.value)


def test_build_writes_the_page_and_reports_a_difference(source, tmp_path):
    masters, lessons = source().parent, tmp_path / "lessons"
    lessons.mkdir()
    build(masters, lessons, tmp_path / "solved")
    written = (lessons / "cheat_sheet.html").read_text()
    assert written == "<p>42 lesson 01 a text</p>\n"
    assert not any("cheat_sheet" in problem for problem in compare_lessons(masters, lessons).problems)
    source(names="number = 1\n")
    difference = "cheat_sheet.html: differs from the master; run imgproc-course build"
    assert difference in compare_lessons(masters, lessons).problems
    (masters / "cheat_sheet.html").unlink()
    problems = compare_lessons(masters, lessons).problems
    assert "cheat_sheet.html: it has no master; delete it, or restore its master" in problems


def test_the_stored_page_is_the_built_one(page):
    assert (NOTEBOOKS / "cheat_sheet.html").read_text(encoding="utf-8") == page
