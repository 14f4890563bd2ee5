"""The pages: all text is escaped, nothing is loaded, and no page shows another learner; also in a browser."""

import html.parser
import io
import re
from types import SimpleNamespace

import numpy as np
import pytest
from accessibility import violations
from nbclassroom.autograder.outcomes import Outcome
from nbclassroom.autograder.sanitize import sanitize_line, sanitize_text, spreadsheet_text
from nbclassroom.autograder.shown_answer import PageHtml, _advice
from nbclassroom.exercises.answer_images import answer_images
from nbclassroom.exercises.canonical import canonical, encode
from nbclassroom.exercises.values import describe_value, differing_elements
from nbclassroom.gradebook import grade
from nbclassroom.gradebook.grade import grade_submissions
from PIL import Image
from submissions import SEED, answers_of, notebook, write

pytestmark = pytest.mark.sandbox
EVIL = "<script>alert(1)</script>"
SHOUTS = f"""
def double(pixels):
    print({EVIL!r}, '\\u202e', '\\x1b[31m')
    return pixels[::-1] * 1
"""
NAME = "<img src=x onerror=alert(1)>\u202e {{ 7*7 }}"


@pytest.fixture(scope="module")
def pages(masters, key_path, tmp_path_factory):
    """{first word of the learner's name: path of the page}, and "summary": the teacher's page."""
    folder = tmp_path_factory.mktemp("pages")
    submissions, light, sound = folder / "submissions", masters["light"], masters["sound"]
    write(submissions / "ada" / "light.ipynb", notebook(light, answers_of(light, 0)))
    write(submissions / "ada" / "b.ipynb", notebook(sound, answers_of(sound, "right")))
    raising = f"def halves(pixels):\n    raise ValueError({EVIL!r} + str(pixels.tolist()))"
    write(
        submissions / NAME / f"{EVIL[:8]}.ipynb",
        notebook(light, {"light-double": SHOUTS, "light-halves": raising}),
    )
    write(submissions / "zoe" / "notes.ipynb", b"{")
    out = folder / "grades"
    grade_submissions(submissions, [key_path], out, workers=1)
    found = {path.name.split("-")[0]: path for path in (out / "learners").iterdir()}
    return found | {"summary": out / "summary.html"}


class Tags(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.found, self.attributes = set(), []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.found.add(tag)
        self.attributes += attrs


def test_no_page_contains_anything_that_runs_or_loads(pages):
    for path in pages.values():
        text = path.read_text(encoding="utf-8")
        tags = Tags(text)
        assert not tags.found & {"script", "iframe", "object", "embed", "link", "form", "base", "video"}
        assert not [name for name, _ in tags.attributes if name.startswith("on") or name == "style"]
        sources = [value for name, value in tags.attributes if name == "src"]
        assert all(re.fullmatch(r"data:image/png;base64,[A-Za-z0-9+/=]+", value) for value in sources)
        links = [value for name, value in tags.attributes if name == "href"]
        assert all(re.fullmatch(r"(review|learners/[a-z0-9-]+)\.html", value) for value in links)
        (policy,) = [value for name, value in tags.attributes if name == "content" and "default-src" in value]
        assert re.fullmatch(r"default-src 'none'; style-src 'sha256-[A-Za-z0-9+/=]+'; img-src data:", policy)


def test_what_a_learner_writes_is_shown_as_text(pages):
    text = pages["img"].read_text(encoding="utf-8")
    assert "&lt;script&gt;alert(1)&lt;/script&gt; \\u202e" in text
    assert "{{ 7*7 }}" in text and "\u202e" not in text and "\x1b" not in text
    assert "<script" not in text and "<img src=x" not in text
    assert "&lt;img src=x onerror=alert(1)&gt;\\u202e" in pages["summary"].read_text(encoding="utf-8")


def test_a_learners_page_names_the_mistake_and_shows_the_public_check(pages):
    text = pages["ada"].read_text(encoding="utf-8")
    assert "uint8 ends at 255: widen first." in text
    assert "given pixels" in text and "returned [0]" in text and "expected [1]" in text
    assert text.count("data:image/png") == 4  # given, returned, expected, and where they differ
    assert "4 <small>of 10 points" in text


def test_a_hidden_check_shows_only_its_title_and_hint(pages):
    text = pages["img"].read_text(encoding="utf-8")
    after = text.partition("Four rows more")[2].partition('<div class="exercise">')[0]
    assert "Return both halves." in after and "ValueError" in after
    assert "script" not in after and "[[" not in after and "given" not in after


def test_a_page_contains_nothing_of_other_learners_or_the_key(pages, key_path, answer_keys):
    text = pages["ada"].read_text(encoding="utf-8")
    for secret in (
        SEED,
        answer_keys.keys[0].digest,
        str(key_path),
        "zoe",
        "img src=x",
        "astype(np.uint16)",
        "rng",
    ):
        assert secret not in text
    hidden = [
        form["data"] if "data" in form else form["array"]
        for lesson in answer_keys.lessons.values()
        for exercise in lesson.exercises
        for case in exercise.hidden
        for call in case.calls
        for form in (call.result.value, *map(encode, call.arguments))
        if "data" in form or "array" in form
    ]
    assert len(hidden) > 3
    assert not [data for data in hidden if data in text]


def test_the_teachers_page_has_the_totals_and_the_mistakes(pages):
    text = pages["summary"].read_text(encoding="utf-8")
    for expected in (
        "<b>3</b>learners",
        "<b>3</b>of 4 submissions graded",
        "<li>could not be graded: ",
        "uint8 wraps",
    ):
        assert expected in text
    row = text.partition("An image")[2].partition("</tr>")[0]
    assert "0 %" in row and "2 of 2" in row
    row = text.partition("Fifty numbers")[2].partition("</tr>")[0]
    assert "100 %" in row and "1 of 1" in row


def test_a_file_that_could_not_be_read_has_no_points_on_the_page(pages):
    text = pages["zoe"].read_text(encoding="utf-8")
    assert "<title>zoe</title>" in text and "0 of 0" not in text and "fresh Python" not in text
    assert text.count("notes.ipynb") == 1 and "its JSON is broken" in text
    row = pages["summary"].read_text(encoding="utf-8").rpartition("<bdi>zoe</bdi>")[2].partition("</tr>")[0]
    assert "not graded" in row


# ---------------------------------------------------------------- a page that cannot be written


def test_a_page_that_cannot_be_written_has_the_points_and_costs_nobody_else_anything(
    light, key_path, submissions, tmp_path, monkeypatch
):
    for name in ("ada", "bob", "zoe"):
        write(submissions / f"{name}.ipynb", notebook(light, answers_of(light, 0)))
    out, write_page = tmp_path / "grades", grade.learner_page
    grade_submissions(submissions, [key_path], out, workers=1)
    before = {path.name.split("-")[0]: path.read_text() for path in (out / "learners").iterdir()}

    def fails_for_ada(entry, results, *arguments, **options):
        if entry["name"] == "ada" and results:
            raise ValueError("nonsense")
        return write_page(entry, results, *arguments, **options)

    monkeypatch.setattr(grade, "learner_page", fails_for_ada)
    summary = grade_submissions(submissions, [key_path], out, workers=1)
    assert (summary.failed_pages, summary.not_graded) == (1, 0)
    assert "The page of ada is incomplete (ValueError: nonsense)" in summary.text
    after = {path.name.split("-")[0]: path.read_text() for path in (out / "learners").iterdir()}
    assert (after["bob"], after["zoe"]) == (before["bob"], before["zoe"])
    assert "details of this page could not be written" in after["ada"] and "of 6</small>" in after["ada"]
    assert "The page of <b><bdi>ada</bdi></b>" in (out / "summary.html").read_text()


# ---------------------------------------------------------------- one cause for every check

ALIKE = {
    "syntax": "def double(pixels)\n    return pixels",
    "refused": "import cv2\n\ndef double(pixels):\n    return cv2.add(pixels, pixels)",
    "endless": "def double(pixels):\n    while True:\n        pass",
    "ending": "import os\n\ndef double(pixels):\n    os._exit(0)",
    "overflow": "def double(pixels):\n    return (pixels * 300) // 150",
    "slip": "def double(pixels):\n    retrun (pixels * 2)",
    "mistyped": "def double(pixels):\n    result = pixels * 2\n    return reslut",
    "nameless": "def double(pixels):\n    return cv9.add(pixels, pixels)",
    "at-times": "def double(pixels):\n    assert len(pixels) < 9\n    return pixels",
    "quotes": "def double(pixels):\n    I don\u2019t know",
    "unknown": "@cv.fast\ndef double(pixels):\n    return pixels",
    "deleted": None,
    "behind": "def double(pixels):\n    raise NotImplementedError('your turn')",
}


@pytest.fixture(scope="module")
def alike(light, key_path, tmp_path_factory):
    """{learner: the part of their page about light-double}, and "summary": the teacher's page."""
    folder = tmp_path_factory.mktemp("alike")
    for name, source in ALIKE.items():
        made = notebook(light, {"light-double": source, "light-halves": answers_of(light, 0)["light-halves"]})
        place = [cell["id"] for cell in made["cells"]].index("answer-light-double")
        if source is None:
            del made["cells"][place]
        if name == "behind":
            other = {"id": "mine", "source": answers_of(light, "right")["light-double"]}
            made["cells"].insert(place + 1, made["cells"][place] | other)
        write(folder / "submissions" / name / "20_light.ipynb", made)
    out = folder / "grades"
    grade_submissions(folder / "submissions", [key_path], out, workers=1)
    found = {"summary": (out / "summary.html").read_text(encoding="utf-8")}
    for path in (out / "learners").iterdir():
        text = html.unescape(path.read_text(encoding="utf-8"))
        found[path.stem.rpartition("-")[0]] = text.partition("Twice as bright")[2].partition("Two halves")[0]
    return found


@pytest.mark.parametrize(
    ("name", "cause", "advice"),
    [
        ("syntax", "statement in its cell fails: SyntaxError: expected ':'", "run the cell in the lesson"),
        ("quotes", "SyntaxError: invalid character '\u2019' (U+2019)", "Type \" or ' there."),
        ("unknown", "statement in its cell fails: NameError: name 'cv'", "Nothing has the name cv here."),
        ("refused", "Write this exercise without cv2", "write it by hand"),
        ("endless", "double() used more than 1 s of processor time.", "loop whose condition stays true"),
        (
            "overflow",
            "OverflowError: Python integer 300 out of bounds for uint8\nin your line 2: return",
            "300 does not fit into uint8. So the values would overflow",
        ),
        ("ending", "", "no os._exit()"),
        ("deleted", "Its answer cell (answer-light-double) is missing.", "<code>imgproc-course check</code>"),
    ],
)
def test_one_cause_of_every_failure_replaces_the_hints(alike, name, cause, advice):
    text = alike[name]
    assert text.count(cause) == 1 or not cause
    assert text.count(advice) == 1 and "Hint:" not in text
    assert text.count('class="failed">✗') == 2
    assert "Double()" not in text and "answer cell is missing" not in text


RULE = "Grading runs your notebook as Restart & Run All does, from its top to the check"


@pytest.mark.parametrize(
    ("name", "meant"),
    [("slip", "is not defined. Did you mean return?"), ("mistyped", "Did you mean result?")],
)
def test_a_misspelled_name_is_said_with_the_right_one(alike, name, meant):
    assert meant in alike[name] and RULE in alike[name]
    _, _, looked_at = alike["summary"].partition("<h2>May have lost points unfairly</h2>")
    (row,) = [
        row for row in looked_at.partition("</section>")[0].split("<tr>") if f"<bdi>{name}</bdi>" in row
    ]
    assert meant in row


def test_an_undefined_name_shows_what_grading_runs(alike):
    assert alike["nameless"].count(RULE) == 1
    assert "Did you mean" not in alike["nameless"] and "Hint:" not in alike["nameless"]


def test_checks_with_different_outcomes_keep_their_hints(alike):
    assert alike["at-times"].count("Hint:") == 1 and "AssertionError" in alike["at-times"]


def test_an_answer_in_another_cell_is_listed_for_the_teacher(alike):
    _, _, looked_at = alike["summary"].partition("<h2>May have lost points unfairly</h2>")
    rows = looked_at.partition("</section>")[0].split("<tr>")
    assert not [row for row in rows if "<bdi>behind</bdi>" in row]  # it lost no points
    _, _, unusual = alike["summary"].partition("<h2>Also unusual</h2>")
    (row,) = [row for row in unusual.split("<tr>") if "<bdi>behind</bdi>" in row]
    assert "graded from cell number" in row and "defines double()" in row
    assert not [row for row in rows if "<bdi>quotes</bdi>" in row]  # no slip


@pytest.mark.browser
def test_the_pages_in_a_browser(pages, chromium):
    page = chromium.new_page(viewport={"width": 1000, "height": 900})
    complaints = []
    page.on("console", lambda message: complaints.append(message.text))
    page.on("dialog", lambda dialog: complaints.append("a dialog"))
    for path in pages.values():
        page.goto(path.as_uri())
        page.eval_on_selector_all("details", "all => all.forEach(each => each.open = true)")
        assert page.evaluate("document.documentElement.scrollWidth") <= 1000
        assert page.evaluate("getComputedStyle(document.querySelector('main')).maxWidth") == "992px"
        for theme in ("light", "dark"):
            page.emulate_media(color_scheme=theme)
            assert violations(page) == []
    page.set_viewport_size({"width": 400, "height": 900})
    for path in pages.values():
        page.goto(path.as_uri())
        assert page.evaluate("document.documentElement.scrollWidth") <= 400
        apart = "all => all.map(each => [each.firstElementChild, each.lastElementChild])"
        apart += ".filter(([title, points]) => points.textContent.trim() && "
        apart += "points.getBoundingClientRect().top > title.getBoundingClientRect().top + 20).length"
        assert page.eval_on_selector_all(".line", apart) == 0  # points stand beside their title
        displays = "all => [...new Set(all.map(each => getComputedStyle(each).display))]"
        assert page.eval_on_selector_all("table.stack td:not(.drawn)", displays) in ([], ["block"])
    page.goto(pages["ada"].as_uri())
    widths = page.eval_on_selector_all("figure img", "all => all.map(each => each.naturalWidth)")
    assert widths == [192, 192, 192, 192]
    page.close()
    assert complaints == []


# ---------------------------------------------------------------- values and images


def pixels_of(image):
    return np.asarray(Image.open(io.BytesIO(image.png)))


def test_images_are_drawn_from_pixels_blue_first():
    bgr = np.zeros((20, 20, 3), np.uint8)
    bgr[..., 0] = 200
    other = bgr.copy()
    other[0, 0, 1] = 9
    form, expected = canonical(bgr), canonical(other)
    given, back, wanted, differs = answer_images(
        form, "", expected, form, differing_elements(expected, form, 0)
    )
    assert pixels_of(given)[0, 0].tolist() == pixels_of(back)[0, 0].tolist() == [0, 0, 200]
    assert pixels_of(wanted)[0, 0].tolist() == [0, 9, 200]
    assert pixels_of(differs)[0, 0].tolist() == [200, 40, 40]
    assert pixels_of(differs)[-1, -1].tolist() == [238, 240, 243]
    assert (back.width, back.height) == (200, 200)
    assert "1 of 400 pixels differ, the first at row 0, col 0" in differs.alt


def test_images_of_floats_share_their_limits_and_allow_nan_and_infinity():
    actual = np.full((20, 20), np.nan)
    actual[0] = [-1.0] * 10 + [np.inf] * 10
    expected = np.linspace(0, 3, 400).reshape(20, 20)
    _, back, wanted, _ = answer_images(
        canonical(expected), "", canonical(expected), canonical(actual), np.ones((20, 20), bool)
    )
    assert "black -1, white 3" in back.caption and "black -1, white 3" in wanted.caption
    assert pixels_of(wanted)[0, 0] == 64 and pixels_of(back)[0, -1] == 255 and pixels_of(back)[5, 5] == 0


@pytest.mark.parametrize(
    "value", [np.zeros((0, 9)), np.zeros((500, 1)), np.zeros((3, 3, 3, 50)), "x", None, 3]
)
def test_a_value_that_is_no_image_is_not_drawn(value):
    form = canonical(value)
    assert answer_images(form, "", form, form, None) == []
    assert describe_value(form)


def test_hostile_forms_are_shown_as_text():
    nested = describe_value(canonical(["<b>\u202e"]))
    assert "<b>" in nested and PageHtml().text(nested).isprintable() and "<" not in PageHtml().text(nested)
    assert PageHtml().text(describe_value(canonical({"a": {"b": "\ud800"}}))).encode("utf-8")


# ---------------------------------------------------------------- text


def test_invisible_characters_are_escaped():
    assert sanitize_text("a\u202eb\x1b[0m\n\ud800é") == "a\\u202eb\\x1b[0m\n\\ud800é".replace(
        "\\x1b", "\\u001b"
    )
    assert sanitize_line("a\nb\tc") == "a\\nb\\tc"
    assert sanitize_text("x" * 400, 10) == "x" * 9 + "…"


@pytest.mark.parametrize(
    "text", ["=1+1", "+1", "-1", "@SUM(A1)", "\t=1", "\r=1", " =1", "＝1", '"=1', "'=1", "\n-1"]
)
def test_no_table_cell_looks_like_a_formula(text):
    assert spreadsheet_text(text).startswith("'")


def test_what_follows_a_semicolon_is_no_formula_either():
    """A spreadsheet whose cells are separated by semicolons splits a text of ours there."""
    assert spreadsheet_text("x;=1+1;y") == "x;'=1+1;y"
    assert spreadsheet_text('x; "-1') == "x; \"'-1"


def test_other_table_cells_are_unchanged():
    assert spreadsheet_text("Ada = Lovelace") == "Ada = Lovelace"
    assert spreadsheet_text(-3.5) == -3.5 and spreadsheet_text("") == ""


def test_a_value_that_another_cell_makes_with_a_module_is_explained():
    """In the lesson this works, so "fix what Python reports there" would not help."""
    message = (
        "a statement in its cell fails: RefusedModule: write this exercise without imgproc_course.recording"
    )
    text = _advice([SimpleNamespace(outcome=Outcome.RAISED)], message)
    assert "In the lesson it works" in text and "Compute with the arguments of your function" in text
