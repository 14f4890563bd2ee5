"""The site as it is built: without a warning or a network, and what its lessons show, fold and leave out."""

import datetime as dt
import json
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest
import release
from all_masters import all_exercises, all_masters
from checkout import PLACEHOLDER, address_of, facts, with_address
from handed_out import HandedOut
from lessons import AGAIN, TEACHING

ROOT = Path(__file__).parents[2]
LESSONS = sorted((ROOT / "notebooks").glob("[0-9]*.ipynb"))
# Its solution is the beginning of a later exercise.
TAUGHT = "node-class"
VOID = {"area", "base", "br", "col", "hr", "img", "input", "link", "meta", "source", "track", "wbr"}


class Lesson(HTMLParser):
    """A page of the site: its texts, each with the classes of the elements around it."""

    def __init__(self, path):
        super().__init__()
        self._open, self.texts, self.pre, self.images = [], [], [], []
        self.feed(path.read_text("utf-8"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if tag == "img":
            self.images.append(values)
        if tag == "pre":
            self.pre.append("")
        if tag not in VOID:
            self._open.append((tag, values.get("class") or ""))

    def handle_endtag(self, tag):
        while self._open and self._open.pop()[0] != tag:
            pass

    def handle_data(self, data):
        around = " ".join(f"{tag}.{classes}" for tag, classes in self._open)
        self.texts.append((around, data))
        if self.pre and "pre." in around:
            self.pre[-1] += data

    def text(self, inside=""):
        """The text of all elements of a class."""
        return "".join(text for around, text in self.texts if inside in around)


@pytest.fixture(scope="module")
def pages(built):
    return {path.stem: Lesson(built[1] / "lessons" / f"{path.stem}.html") for path in LESSONS}


def cells_of(path):
    return json.loads(path.read_text("utf-8"))["cells"]


def test_it_is_built_without_a_network_a_warning_or_a_broken_link(built):
    printed, folder = built
    assert "WARNING" not in printed and printed.rstrip().endswith(" 0 findings")
    assert all(path.stem in (folder / "lessons/index.html").read_text("utf-8") for path in LESSONS)


def test_no_page_holds_a_solution_or_a_hidden_case(built, tmp_path):
    paths = []
    for number, path in enumerate(sorted(built[1].rglob("*.html"))):
        page = Lesson(path)
        paths.append(tmp_path / f"{number}.json")
        paths[-1].write_text(json.dumps([page.text(), *page.pre]))
    published = HandedOut(paths)
    exercises = all_exercises().values()
    assert len(exercises) > 50
    assert [each.id for each in exercises if list(published.leaks(each))] == [TAUGHT]


def test_every_result_of_a_prediction_is_behind_a_click(pages):
    revealed = 0
    for name, page in pages.items():
        for around, text in page.texts:
            assert "No guess yet" not in text, name
            if "The result is" in text and "cell_output" in around:
                assert "details.course-reveal" in around, (name, text)
                revealed += 1
    assert revealed > 130


def test_the_text_that_states_a_result_is_behind_the_same_click(pages):
    for name, sentence in {
        "02_what_is_image_processing": "painted[floor] = (0, 160, 0)",
        "03_images_as_messages": "258 mm become 513 mm",
        "04_grayscale": "The result is 18 instead of 103",
        "05_grayscale_node": "ROS called the function about twenty times",
        "06_noise_removal": "Between 50 and 200 there are now 101 and 146",
        "08_canny_stages": "grad_row, grad_col = sobel(step)",
        "14_where_am_i": "without: -1",
    }.items():
        assert sentence in pages[name].text("details.course-reveal"), name
        assert pages[name].text("details.course-reveal").count(sentence) == pages[name].text().count(sentence)
    closed = [page for page in pages.values() if "Recap" in page.text("details.course-reveal")]
    assert closed == []


def test_the_answer_to_a_question_from_an_earlier_lesson_is_behind_a_click(pages):
    for master in all_masters().values():
        page = pages[master.path.stem]
        for question in master.questions.values():
            answer = str(question["answer"])
            assert f"{answer} · {question['replies'][answer]}" in page.text("details.course-reveal")
        assert "No answer yet" not in page.text()
    assert sum(len(master.questions) for master in all_masters().values()) == 38


def test_a_text_that_states_no_result_is_not_folded(pages):
    for name, sentence in {
        "04_grayscale": "A television standard (ITU-R BT.601) defines three weights",
        "05_grayscale_node": "waits for messages and calls the callbacks, again and again",
        "17_recognising_objects": "Nine bins of 20 degrees",
    }.items():
        page = pages[name]
        assert sentence in page.text() and sentence not in page.text("details.course-reveal"), name
    sources = [cell["source"] for path in LESSONS for cell in cells_of(path)]
    texts = "".join("".join(source) for source in sources)
    assert [words for words in (*AGAIN, *TEACHING) if words not in texts] == []


def test_no_link_leads_into_what_is_closed(built):
    html = (built[1] / "lessons/05_grayscale_node.html").read_text("utf-8")
    before = html[: html.index('id="grayscale-node-12"')]
    assert before.count("<details") == before.count("</details>")


def test_a_progress_bar_is_left_out(pages):
    page = pages["09_edge_detection_node"]
    assert 'tqdm(sigmas, desc="blurs")' in page.text() and "0/4" not in page.text()


def test_the_first_page_and_the_set_up_name_the_lessons_as_they_are(built):
    for name, folder, lesson in (
        ("index.html", "lessons", "obstacles_ahead"),
        ("learn/start.html", "../lessons", "grayscale_node"),
    ):
        html = (built[1] / name).read_text("utf-8")
        master = all_masters()[lesson]
        link = f'<a href="{folder}/{master.path.stem}.html">{master.number} {master.title}</a>'
        assert link in html and "[[" not in html, name
        assert facts()["course_address"] or "write the address of the repository" in html


def test_each_page_names_version_date_contributors_and_licences(built):
    about = facts()
    pages = sorted(set(built[1].rglob("*.html")) - {built[1] / "404.html", built[1] / "cheat_sheet.html"})
    assert len(pages) > 80 and (built[1] / ".nojekyll").exists()
    for page in pages:
        footer = page.read_text("utf-8").partition('<p class="course-source">')[2].partition("</p>")[0]
        assert f"Version {about['course_version']}, {about['course_date']} " in footer, page
        for words in ("the imgproc-course contributors", "CC BY 4.0", "Apache-2.0", ">Ask and report<"):
            assert words in footer, (page, words)


def test_the_address_of_the_repository_is_that_of_git():
    for remote, address in {
        "https://github.com/someone/course.git": "https://github.com/someone/course",
        "https://name:secret@example.org/a/b/course/": "https://example.org/a/b/course",
        "git@github.com:someone/course.git": "https://github.com/someone/course",
        "ssh://git@example.org:2222/someone/course": "https://example.org/someone/course",
        "/home/me/course": None,
        "../course": None,
        "file:///srv/course.git": None,
        "": None,
    }.items():
        assert address_of(remote) == address, remote
    page = f"git clone {PLACEHOLDER} course\n\nFor `{PLACEHOLDER}`, write it.\n\nYou need Linux.\n"
    assert with_address(page, None) == page
    assert with_address(page, "https://a.b/c") == "git clone https://a.b/c course\n\nYou need Linux.\n"


def test_a_release_names_all_that_it_lacks(tmp_path):
    texts = [*release.PAGES, *release.ADDRESSED, "CITATION.cff", "CHANGELOG.md", "nbclassroom/LICENSE"]
    for name in texts:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        text = (ROOT / name).read_text("utf-8")
        (tmp_path / name).write_text(text.replace(PLACEHOLDER, "https://a.b/c"), "utf-8")
    shutil.copytree(ROOT / ".github/ISSUE_TEMPLATE", tmp_path / ".github/ISSUE_TEMPLATE")
    released = dt.date.fromisoformat(re.search(r"released: (.*)", (tmp_path / "CITATION.cff").read_text())[1])
    assert list(release.missing(tmp_path, released)) == []
    (tmp_path / ".github/SUPPORT.md").unlink()
    (tmp_path / "nbclassroom/LICENSE").write_text("other")
    (tmp_path / "CHANGELOG.md").write_text("# Changes\n\n## Unreleased\n")
    (tmp_path / "README.md").write_text(PLACEHOLDER)
    lines = "\n".join(release.missing(tmp_path, dt.date(2027, 1, 2)))
    for words in (
        ".github/SUPPORT.md does not exist",
        "nbclassroom/LICENSE is not LICENSE",
        "date-released in CITATION.cff: '",
        "expected '2027-01-02'",
        "the first heading of CHANGELOG.md: '## Unreleased', expected '## 0.1.0, 2 January 2027'",
        f'sed -i "s|{PLACEHOLDER}|ADDRESS|" README.md',
    ):
        assert words in lines, lines


def test_the_cheat_sheet_and_the_glossary_lead_on(built):
    sheet = (built[1] / "cheat_sheet.html").read_text("utf-8")
    assert '<a href="lessons/01_arrays.html">lesson 01</a>' in sheet
    assert '<a href="learn/index.html">All lessons</a>' in sheet
    glossary = (built[1] / "lessons/glossary.html").read_text("utf-8")
    assert re.search(r'href="#absolute-trajectory-error">A</a> · <a [^>]*>B</a>', glossary)


def test_folded_cells_stay_folded(pages):
    for path in LESSONS:
        cells = cells_of(path)
        folded = [cell for cell in cells if cell["metadata"].get("jupyter", {}).get("source_hidden")]
        shown = pages[path.stem].text("hide above-input summary.")
        titles = ["".join(cell["source"]).splitlines()[0].lstrip("# ")[:70] for cell in folded]
        assert all(title in shown for title in titles), path.name


def test_an_exercise_shows_its_task_its_stub_and_its_check(pages):
    for master in all_masters().values():
        page = next(page for name, page in pages.items() if name.endswith(f"_{master.name}"))
        code = " ".join(page.pre)
        assert "not attempted yet" not in page.text()
        for exercise in master.exercises:
            if not exercise.practice:
                assert f'check("{exercise.id}"' in code, exercise.id
                stub = exercise.stub.strip().strip("*")
                assert stub in code or stub in page.text(), exercise.id


def test_every_image_has_a_file_and_a_text(built, pages):
    for name, page in pages.items():
        for image in page.images:
            assert "alt" in image and not image["src"].startswith("data:"), name
            assert (built[1] / "lessons" / image["src"]).exists(), (name, image["src"])


def test_a_live_cell_shows_a_still_image_and_says_so(pages):
    for path in LESSONS:
        page = pages[path.stem]
        live = [cell for cell in cells_of(path) if "moves when this cell is run" in json.dumps(cell)]
        stills = [image for image in page.images if "_static/live/" in image["src"]]
        assert len(stills) >= len(live) and all(len(image["alt"]) > 15 for image in stills), path.name
        assert page.text().count("A still image: ") == len(stills)
        assert "moves when this cell is run" not in page.text()


def test_a_live_cell_says_what_it_shows(pages):
    sentence = (
        "The drive and its edges. The two sliders set the thresholds. A still image: in JupyterLab it moves"
    )
    assert sentence in pages["02_what_is_image_processing"].text("figcaption.")


def test_each_lesson_names_the_command_that_opens_it(pages):
    for path in LESSONS:
        text = pages[path.stem].text("div.course-open")
        assert "You are reading the lesson. To run it" in text
        assert "environment/lab" in text and path.name in text
        assert pages[path.stem].text().index(text) < pages[path.stem].text().index("You will be able to")


def test_formulas_are_mathml(built):
    html = (built[1] / "lessons/07_binarization.html").read_text("utf-8")
    assert html.count("<math") == 10
    assert re.findall(r"<script[^>]* src=\"(?!\.\./_static/)", html) == []


def test_the_check_finds_a_dead_link_another_host_and_an_image_without_a_text(tmp_path):
    faults = {
        '<a href="gone.html">x</a>': "links to gone.html, which does not exist",
        '<a href="#nowhere">x</a>': "links to #nowhere, which has no such anchor",
        '<a href="/other.html#top">x</a>': "links to /other.html#top, which does not exist",
        '<script src="https://cdn.example.org/a.js"></script>': "loads https://cdn.example.org/a.js",
        '<img alt="x" src="//example.org/a.png">': "loads //example.org/a.png",
        "<table><tr><th>x</th><th> </th></tr></table>": "has an empty header of a table",
        '<img src="data:,x">': "has an image without alt: data:,x",
    }
    for number, html in enumerate(faults):
        (tmp_path / f"{number}.html").write_text(html)
    (tmp_path / "right.html").write_text('<a id="a" href="#a">x</a><a href="https://example.org">y</a>')
    (tmp_path / "style.css").write_text("p { background: url('https://example.org/b.png') }")
    command = [sys.executable, ROOT / "docs/_ext/check.py", tmp_path]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    expected = [f"{number}.html {text}" for number, text in enumerate(faults.values())]
    expected += ["style.css loads https://example.org/b.png", "8 pages, 0.0 MB, 8 findings"]
    assert (ended.returncode, ended.stdout.splitlines()) == (1, expected)
