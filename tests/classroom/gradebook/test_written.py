"""Answers that a person grades: from the master to the exports, with an attack in the text."""

import base64
import csv
import io
import json
import random
import re
import subprocess
import sys
import threading
import time

import pytest
from accessibility import violations
from nbclassroom.authoring.masters import read_master
from nbclassroom.autograder.make_answer_key import make_key
from nbclassroom.autograder.shown_answer import rendered_text
from nbclassroom.gradebook.answer_keys import AnswerKeys
from nbclassroom.gradebook.grade import grade_submissions
from nbclassroom.gradebook.review_server import ConflictError, ReviewServer, save_decisions
from PIL import Image
from submissions import SEED, notebook, write
from template_master import TEMPLATE

pytestmark = pytest.mark.sandbox
WRITTEN = """
# %% role="exercise"
exercise(
    "words-noise",
    title="Which noise?",
    subject="written",
    points=3,
    rubric=(("names the noise", 2), ("says why", 2), ("names a filter that blurs", -1)),
)

# %% [markdown] role="answer"
# *Your answer:*

# %% [markdown] role="solution"
# It is **salt and pepper**, because single pixels are black or white.

# %% role="check"
check("words-noise")
"""
FIGURE = """
# %% role="exercise"
exercise("words-plot", subject="written", points=1, rubric=(("labels both axes", 1),))

# %% role="answer"
figure = None  # your turn

# %% role="solution"
from matplotlib.figure import Figure

figure = Figure((4, 3))
figure.add_subplot().plot(range(LIMIT))

# %% role="check"
check("words-plot")
"""
MASTER = TEMPLATE.replace("template-double", "words-double") + WRITTEN
EVIL = "**bold** <script>alert(1)</script> [x](javascript:alert(2)) ![i](http://a/b.png) <b onclick=y>z</b>"
TEXTS = {"Ada": EVIL, "Bob": "It is Gaussian noise.", "Cy": None, "Dora": "   "}
RIGHT = (
    "import numpy as np\ndef double(pixels):\n    return np.minimum(pixels.astype(int) * 2, 255).astype('u1')"
)


@pytest.fixture(scope="module")
def words(tmp_path_factory):
    """The folder with masters, key and submissions of four learners."""
    folder = tmp_path_factory.mktemp("words")
    path = write(folder / "masters" / "22_words.py", MASTER)
    master = read_master(path)
    make_key(folder / "masters", SEED, folder / "key")
    for name, text in TEXTS.items():
        made = notebook(master, {"words-double": RIGHT, "words-noise": text if name != "Ada" else None})
        below = {"id": "x", "cell_type": "markdown" if text else "code", "source": text or "1"}
        made["cells"].insert(-1 if name in ("Ada", "Cy") else 0, below)  # an answer, and what is none
        for cell in made["cells"] if name == "Bob" else ():
            del cell["id"]  # by an editor that knows none
        write(folder / "in" / name / "22_words.ipynb", made)
    return folder


@pytest.fixture
def grade(words, tmp_path):
    """Grades the submissions; gives {learner: the entry of the written exercise} and all grades."""

    def graded(**options):
        options = {"workers": 1} | options
        summary = grade_submissions(words / "in", [words / "key"], tmp_path / "out", **options)
        grades = json.loads((tmp_path / "out/grades.json").read_text("utf-8"))
        learners = {learner["name"]: learner for learner in grades["learners"]}
        exercises = {name: learner["lessons"][0]["exercises"][1] for name, learner in learners.items()}
        return summary.text, learners, exercises

    return graded


def rows(path):
    return list(csv.DictReader(path.read_text("utf-8-sig").splitlines()))


def test_what_nobody_has_graded_is_open_and_never_zero(grade, tmp_path):
    text, learners, exercises = grade()
    assert "raded from the cell above its check" in (tmp_path / "out" / learners["Bob"]["page"]).read_text()
    assert "2 answers still to be graded by a person: --review." in text
    opened = {name: (one["points"], one["max_points"], one["open_points"]) for name, one in learners.items()}
    assert opened == {"Ada": (3, 6, 3), "Bob": (3, 6, 3), "Cy": (3, 6, 0), "Dora": (3, 6, 0)}
    outcomes = [one["cases"][0]["outcome"] for one in exercises.values()]
    assert outcomes == ["open", "open", "not attempted", "not attempted"]
    table = rows(tmp_path / "out/grades.csv")
    points = {row["learner"]: (row["points"], row["open_points"]) for row in table}
    assert points == {"Ada": ("", "3"), "Bob": ("", "3"), "Cy": ("3", "0"), "Dora": ("3", "0")}
    summary = (tmp_path / "out/summary.html").read_text("utf-8")
    assert "3 of 6, 3 points not graded yet" in summary and "graded by a person</th>" not in summary
    page = (tmp_path / "out/review/words-noise.html").read_text("utf-8")
    assert '<span id="graded">0</span> of 2 answers graded' in page
    grade(open_as_zero=True)
    assert [row["points"] for row in rows(tmp_path / "out/grades.csv")] == ["3"] * 4


def decide(folder, out, *lines):
    save_decisions(out / "decisions.csv", "\n".join(lines), AnswerKeys([folder / "key"]))


def test_the_lines_of_a_rubric_give_the_points_and_count_again_when_their_points_change(
    grade, words, tmp_path
):
    out = tmp_path / "out"
    marks = {name: one["mark"] for name, one in grade()[2].items()}
    decide(
        words,
        out,
        f"Ada,words,words-noise,lines 1 2 of {marks['Ada']},fine",
        f"Bob,words,words-noise,lines 1 3 of {marks['Bob']},",
    )
    text, learners, exercises = grade()
    assert "still to be graded" not in text
    assert [exercises[name]["points"] for name in ("Ada", "Bob")] == [3, 1]  # 4 is more than the exercise has
    assert rows(out / "grades.csv")[1]["points"] == "4"
    page = (out / learners["Bob"]["page"]).read_text("utf-8")
    assert "names the noise: 2 points" in page and "says why" not in page
    decide(words, out, "(all),words,words-noise,points 1 1 -3,")
    assert [one["points"] for one in grade()[2].values()] == [2, 0, 0, 0]
    decide(words, out, f"Bob,words,words-noise,lines 0 of {marks['Bob']},no")
    assert grade()[2]["Bob"]["decision"]["lines"] == [0]


def test_a_decision_on_another_text_does_not_count(grade, words, tmp_path):
    grade()
    decide(words, tmp_path / "out", "Bob,words,words-noise,lines 1 of 00000000,old")
    _, learners, exercises = grade()
    assert exercises["Bob"]["decision"]["is_outdated"] and learners["Bob"]["open_points"] == 3
    assert "changed since it was graded" in (tmp_path / "out/review/words-noise.html").read_text("utf-8")


@pytest.mark.parametrize("points", ["lines 4 of 00000000", "lines of 00000000", "points 1 1 1", "lines 1"])
def test_lines_that_the_rubric_does_not_have_are_refused(grade, words, tmp_path, points):
    grade()
    with pytest.raises(ValueError, match="expected 0 to 3"):
        decide(words, tmp_path / "out", f"Bob,words,words-noise,{points},")


def test_two_pages_do_not_overwrite_each_other_in_silence(grade, words, tmp_path):
    grade()
    decide(words, tmp_path / "out", "Bob,words,words-noise,1,from here,,")
    with pytest.raises(ConflictError, match="Bob has got '1, from here' from another page; reload this one"):
        decide(words, tmp_path / "out", "Ada,words,words-noise,3,,,", "Bob,words,words-noise,2,,,")
    assert [row["points"] for row in rows(tmp_path / "out/decisions.csv") if row["exercise"]] == ["1"]
    decide(words, tmp_path / "out", "Bob,words,words-noise,2,,1,from here")
    assert grade()[2]["Bob"]["points"] == 2


def test_a_text_is_shown_without_anything_that_acts(grade, words, tmp_path):
    learners = grade()[1]
    for page in ("review/words-noise.html", learners["Ada"]["page"]):
        html = (tmp_path / "out" / page).read_text("utf-8")
        shown = html[html.index("<strong>bold</strong>") :].partition("</p>")[0]
        assert shown == (
            "<strong>bold</strong> &lt;script&gt;alert(1)&lt;/script&gt; x  &lt;b onclick=y&gt;z&lt;/b&gt;"
        )


ACTIVE = {
    "[a](data:text/html,x)": "<p>a</p>",
    "<javascript:alert(1)>": "<p>javascript:alert(1)</p>",
    '![x](x" onerror="y)': "<p>![x](x&quot; onerror=&quot;y)</p>",
    "<style>p{}</style>": "<p>&lt;style&gt;p{}&lt;/style&gt;</p>",
    '```a" onload="b\nx\n```': "<pre><code>x\n</code></pre>",
    "|a|\n|:-:|\n|c|": "<table><thead><tr><th>a</th></tr></thead><tbody><tr><td>c</td></tr></tbody></table>",
    "a\u202eb": "<p>a\\u202eb</p>",
}


@pytest.mark.parametrize(("text", "shown"), ACTIVE.items())
def test_no_attribute_and_no_element_that_acts_is_left(text, shown):
    assert re.sub(">\\s+<", "><", rendered_text(text).strip()) == shown


def test_a_platform_gets_no_points_for_what_is_graded_in_part(grade, tmp_path):
    table = write(tmp_path / "words.csv", "Identifier,Full name,Grade\n,Ada,\n,Bob,1\n,Cy,\n")
    text, _, _ = grade(platform_tables=[table])
    assert "1 points filled in" in text
    filled = tmp_path / "out/exports/filled-words.csv"
    assert [row["Grade"] for row in rows(filled)] == ["", "1", "3"]
    grade(platform_tables=[table], open_as_zero=True)
    assert [row["Grade"] for row in rows(filled)] == ["3", "3", "3"]


# ---------------------------------------------------------------- in a browser


@pytest.fixture
def served(grade, words, tmp_path):
    """The address of the page of the exercise, as `grade --review` serves it."""
    grade()
    out = tmp_path / "out"
    with ReviewServer(out, out / "decisions.csv", AnswerKeys([words / "key"])) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield server.url.replace("review.html", "review/words-noise.html")
        server.shutdown()
        thread.join()


def open_tab(browser, url):
    tab = browser.new_page()
    with tab.expect_response("**/decisions"):
        tab.goto(url)
    return tab


def press(tab, *keys):
    for key in keys:
        tab.keyboard.press(key)


@pytest.mark.browser
def test_a_person_grades_by_keyboard_alone_and_uses_a_comment_again(chromium, served, grade):
    tab = open_tab(chromium, served)
    press(tab, "2", "1", "3", "c")  # the first key only shows whom it is about
    tab.keyboard.type("Say why: 1")
    press(tab, "Escape", "n", "2", "0", "2")
    with tab.expect_response("**/decisions"):
        tab.locator("article .again").nth(1).focus()
        tab.locator("article .again").nth(1).select_option("Say why: 1")
    tab.get_by_text("No lines to save").wait_for()
    assert tab.locator("article .points").all_inner_texts()[:2] == ["1 of 3", "2 of 3"]
    assert tab.locator("#graded").inner_text() == "2"
    _, _, exercises = grade()
    decided = {
        name: (one["points"], (one["decision"] or {}).get("comment")) for name, one in exercises.items()
    }
    assert decided == {"Ada": (1, "Say why: 1"), "Bob": (2, "Say why: 1"), "Cy": (0, None), "Dora": (0, None)}
    tab.close()


@pytest.mark.browser
def test_a_line_that_gives_other_points_counts_again_for_all(chromium, served, grade):
    tab = open_tab(chromium, served)
    press(tab, "n", "1", "n", "1", "2")
    tab.get_by_text("Other points for a line").press("Enter")
    with tab.expect_response("**/decisions"):
        tab.locator(".worth").first.fill("1")
    assert tab.locator("article output").all_inner_texts()[:2] == ["1 of 3", "3 of 3"]
    assert tab.locator("article .worth-now").first.inner_text() == "1"
    assert not tab.locator("#worths input[name=points]").is_visible()
    tab.reload()
    tab.locator("output", has_text="1 of 3").wait_for()
    assert tab.locator(".worth").first.input_value() == "1"
    assert [one["points"] for one in grade()[2].values()] == [1, 3, 0, 0]
    tab.close()


@pytest.mark.browser
def test_the_second_of_two_tabs_is_told_and_overwrites_nothing(chromium, served, grade):
    first, second = (open_tab(chromium, served) for _ in range(2))
    for tab, line, text in ((first, "1", "1 line saved."), (second, "2", "Ada has got 'lines 1 of ")):
        press(tab, "n", line)
        tab.get_by_text(text).wait_for()
    assert grade()[2]["Ada"]["points"] == 2
    first.close()
    second.close()


@pytest.mark.browser
def test_everybody_can_read_the_page_in_both_themes(chromium, served):
    tab = open_tab(chromium, served)
    for theme in ("light", "dark"):
        tab.emulate_media(color_scheme=theme)
        tab.evaluate("document.querySelectorAll('details').forEach(node => node.open = true)")
        assert violations(tab, impacts=None) == []
    tab.close()


# ---------------------------------------------------------------- killed

SAVER = """
import sys
from pathlib import Path
from nbclassroom.gradebook.answer_keys import AnswerKeys
from nbclassroom.gradebook.review_server import save_decisions

keys = AnswerKeys([sys.argv[2]])
print(flush=True)
for number in range(10_000):
    save_decisions(Path(sys.argv[1]), f"Bob,words,words-noise,2,{'x' * 1000}{number}", keys)
"""


def test_a_kill_leaves_a_whole_table_with_the_old_or_the_new_decision(words, tmp_path):
    table = write(
        tmp_path / "decisions.csv", "learner,lesson,exercise,points,comment\nAda,words,words-noise,1,\n"
    )
    for _ in range(8):
        command = [sys.executable, "-c", SAVER, table, words / "key"]
        with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
            process.stdout.readline()
            time.sleep(random.uniform(0.02, 0.2))
            process.kill()
        assert [row["points"] for row in rows(table)] in (["1"], ["1", "2"])
        assert save_decisions(table, "Ada,words,words-noise,1,", AnswerKeys([words / "key"])) == 1


# ---------------------------------------------------------------- figures

RED = "figure = Figure((4, 3), facecolor='red')"
FIGURES = {
    "own": f"from matplotlib.figure import Figure\nfirst = Figure((9, 9))\n{RED}",
    "pyplot": "%matplotlib inline\nimport matplotlib.pyplot as plt\n"
    "plt.figure(figsize=(4, 3), facecolor=colour)\nplt.show()",
    "bare": "import matplotlib.pyplot as plt\nplt.rcParams['figure.facecolor'] = colour\nplt.plot([1, 2])",
    "huge": "import matplotlib.pyplot as plt\nplt.figure(figsize=(400, 300), facecolor='red')",
    "none": "figure = 3 / 0",
    "forged": "import nbclassroom.autograder.sandbox.inside.check_cell as f\nf._pixels = lambda _: '<b>'\n"
    f"from matplotlib.figure import Figure\n{RED}",
    "endless": "while True: pass",
    "text": "I draw it by hand.",
    "twice": RED,
    "long": f"{RED}{'#' * 200_000}",
    "stub": None,
}


def test_a_figure_is_made_in_the_sandbox_from_the_cells_and_never_taken_from_the_output(tmp_path):
    path = write(tmp_path / "masters" / "22_words.py", MASTER + FIGURE)
    master = read_master(path)
    make_key(tmp_path / "masters", SEED, tmp_path / "key")
    for name, answer in FIGURES.items():
        made = notebook(master, {"words-plot": answer})
        (cell,) = [cell for cell in made["cells"] if cell["id"] == "answer-words-plot"]
        cell["cell_type"] = "markdown" if name == "text" else "code"
        data = {"image/png": "AAAA", "text/html": "<script>x</script>"}
        cell["outputs"] = [{"output_type": "display_data", "data": data, "metadata": {}}]
        above = {"id": "mine", "cell_type": "code", "metadata": {}, "source": "colour = 'red'", "outputs": []}
        made["cells"].insert(1, above)
        made["cells"] += made["cells"][-1:] * (name == "twice")  # which check is below it?
        for cell in made["cells"] if name in ("bare", "twice") else ():
            cell["id"] = ""
        write(tmp_path / "in" / name / "22_words.ipynb", made)
    grade_submissions(tmp_path / "in", [tmp_path / "key"], tmp_path / "out", workers=1)
    waiting, *parts = (tmp_path / "out/review/words-plot.html").read_text("utf-8").split("<article")
    assert waiting.count(">figure</span>") == 4
    pages = {re.search("<bdi>(.*?)</bdi>", part)[1]: part for part in parts}
    shown = {name: re.search(r'png;base64,([^"]+)" alt="The figure', page) for name, page in pages.items()}
    images = {name: Image.open(io.BytesIO(base64.b64decode(url[1]))) for name, url in shown.items() if url}
    assert {name: image.getpixel((9, 9)) for name, image in images.items()} == dict.fromkeys(
        ("own", "pyplot", "bare", "huge"), (255, 0, 0)
    )
    assert images["own"].size == images["pyplot"].size == (400, 300) and images["huge"].size == (632, 474)
    assert "Its cell makes no figure (ZeroDivisionError: division by zero)." in pages["none"]
    assert "Its cell makes no figure (time)." in pages["endless"], pages["endless"][:3000]
    assert "Its cell makes no figure (it is no code cell)." in pages["text"]
    assert "Its cell makes no figure." in pages["forged"]
    assert pages["long"].count("longer than 200000 characters") == 1
    assert "<output>" in pages["none"] and "<output>" not in pages["stub"] + pages["twice"] + pages["long"]
