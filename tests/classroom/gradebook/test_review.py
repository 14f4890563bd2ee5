"""The pages on which a teacher reads answers and decides: in a browser, by keyboard, copied or saved."""

import contextlib
import html
import json
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
import urllib.error
import urllib.request
from pathlib import Path

import pytest
from accessibility import violations
from nbclassroom.autograder.sanitize import sanitize_line, spreadsheet_text
from nbclassroom.gradebook import grade, teacher_tables
from nbclassroom.gradebook.csv_table import csv_text
from nbclassroom.gradebook.grade import grade_submissions
from nbclassroom.gradebook.report import AnswerParts, _coloured
from nbclassroom.gradebook.review_server import ReviewServer, save_decisions
from nbclassroom.gradebook.teacher_tables import DECISIONS_TEMPLATE, read_decisions
from submissions import answers_of, notebook, write

pytestmark = pytest.mark.sandbox
HEADER = "learner,lesson,exercise,points,comment\n"
EVIL = 'def double(pixels):\n    "</pre><script>alert(1)</script>\u202e"\n    return pixels'
KINDS = {"Ada, B": "right", "Bob": 0, "Cy": 0, "Dora": "raising", "=Eve": "untouched"}


@pytest.fixture(scope="module")
def graded(light, key_path, tmp_path_factory):
    """The folder of grades of six learners."""
    folder = tmp_path_factory.mktemp("review")
    for name, kind in KINDS.items():
        write(folder / "in" / name / "20_light.ipynb", notebook(light, answers_of(light, kind)))
    write(folder / "in" / "Mal" / "20_light.ipynb", notebook(light, {"light-double": EVIL}))
    grade_submissions(folder / "in", [key_path], folder / "out", workers=1)
    return folder / "out"


def text_of(page):
    """The words of a page's HTML."""
    return " ".join(re.sub("<[^>]+>", " ", page).split())


def articles(out):
    """{learner: HTML} of the page of the exercise, in its order."""
    page = (out / "review/light-double.html").read_text(encoding="utf-8")
    return {re.search("<bdi>(.*?)</bdi>", part)[1]: part for part in page.split("<article")[1:]}


def test_a_hidden_check_shows_its_values_to_the_teacher_alone(graded):
    """The public check comes first; a learner's page has the hidden one without values."""
    hidden = articles(graded)["Bob"].partition("on other inputs")[2]
    for words in ("given pixels", "returned", "expected"):
        assert f"{words}: an array of shape" in hidden
    (page,) = (graded / "learners").glob("bob-*.html")
    shown = (
        page.read_text(encoding="utf-8")
        .partition("on other inputs")[2]
        .partition('<div class="exercise">')[0]
    )
    assert shown and "given" not in shown and "expected" not in shown
    assert "given" not in articles(graded)["Ada, B"]


def test_the_answer_stands_coloured_beside_its_values_and_its_mistake(graded):
    bob = articles(graded)["Bob"]
    assert '<span class="k">return</span>' in bob
    assert "return pixels * 2" in text_of(bob)
    assert "uint8 ends at 255: widen first." in text_of(bob)
    for words in ("given pixels", "returned", "expected"):
        assert f"{words}: an array of shape (18, 24)" in bob
    assert bob.count("data:image/png") == 4


SLOW = ["\n" + " \n" * 9_980, " " * 20_000, '"\\' * 9_999, "'''" + '"""' * 6_600, "\\" * 20_000, "(" * 20_000]


@pytest.mark.parametrize("source", ["'a' + f\"<b>\"  # &\ndef x(): 'open", *SLOW])
def test_the_colours_of_an_answer_change_no_character_and_take_no_time(source):
    """The processor time is this test's own; one of these took eleven seconds."""
    start = time.process_time()
    assert html.unescape(re.sub("<[^>]+>", "", _coloured(source))) == source
    assert time.process_time() - start < 3


def test_a_page_loads_nothing_and_an_answer_is_only_text(graded):
    page = (graded / "review/light-double.html").read_text(encoding="utf-8")
    assert page.count("<script") == 1 and "alert(1)&lt;/script&gt;" in page
    assert "\u202e" not in page and "\\u202e" in page
    assert "default-src 'none'" in html.unescape(page)
    assert not re.search(r'(src|href)="(?!data:|\.\./|#)', page)


def test_learners_who_fail_alike_are_one_group_and_follow_each_other(graded):
    page = (graded / "review/light-double.html").read_text(encoding="utf-8")
    groups = [text_of(group) for group in page.split('<form class="alike"')[1:]]
    assert "2 learners: Bob , Cy uint8 wraps (fails An image, Any image)" in groups[0]
    assert len(groups) == 1  # who fails as nobody else is no group
    assert list(articles(graded))[:2] == ["Bob", "Cy"] and list(articles(graded))[-1] == "Ada, B"


def test_the_list_of_exercises_names_how_many_pass_and_in_how_many_ways_others_fail(graded):
    row = (graded / "review.html").read_text(encoding="utf-8").partition("light-double</span>")[2]
    assert re.findall(r'<td class="number">(\d+)</td>', row.partition("</tr>")[0]) == ["6", "0", "1", "4"]
    assert 'href="review.html"' in (graded / "summary.html").read_text(encoding="utf-8")


def test_pages_of_exercises_that_are_gone_are_removed(graded, masters, key_path, tmp_path):
    out = tmp_path / "out"
    shutil.copytree(graded, out)
    write(tmp_path / "in" / "Ada" / "21_sound.ipynb", notebook(masters["sound"]))
    grade_submissions(tmp_path / "in", [key_path], out, workers=1)
    assert [path.name for path in (out / "review").iterdir()] == ["sound-mean.html"]


# ---------------------------------------------------------------- in a browser


@pytest.fixture
def page(chromium):
    """A tab without a network; it stops a test at an error of the script."""
    context = chromium.new_context(permissions=["clipboard-read", "clipboard-write"])
    tab, errors = context.new_page(), []
    tab.on("pageerror", lambda error: errors.append(str(error)))
    tab.on("console", lambda message: errors.append(message.text))
    yield tab
    context.close()
    assert [error for error in errors if "status of 400" not in error] == []  # Chromium's own line


@pytest.mark.browser
@pytest.mark.parametrize("name", ["summary.html", "review.html", "review/light-double.html"])
def test_everybody_can_read_the_pages_in_both_themes(graded, page, name):
    for theme in ("light", "dark"):
        page.emulate_media(color_scheme=theme)
        page.goto((graded / name).as_uri())
        page.evaluate("document.querySelectorAll('details').forEach(node => node.open = true)")
        assert violations(page, impacts=None) == []


FOCUSED = "document.activeElement.querySelector('h2')?.innerText.trim() ?? document.activeElement.name"


@pytest.mark.browser
def test_a_decision_is_made_and_copied_by_keyboard_alone(graded, page, key_path, tmp_path):
    page.goto((graded / "review/light-double.html").as_uri())
    seen = []
    for key in ("n", "n", "n", "p", "c"):
        page.keyboard.press(key)
        seen.append(page.evaluate(FOCUSED))
    names = list(articles(graded))
    assert seen == ["Bob", "Cy", names[2], "Cy", "comment"]
    page.keyboard.type('nice, "but" =no')
    page.keyboard.press("Shift+Tab")
    page.keyboard.type("1,5")
    page.keyboard.press("Escape")
    assert page.evaluate(FOCUSED) == "Cy"
    line = 'Cy,light,light-double,"1,5","nice, ""but"" =no"'
    assert page.locator("#lines").input_value() == line
    page.locator("#copy").focus()
    page.keyboard.press("Enter")
    page.get_by_text("Copied.").wait_for()
    assert page.evaluate("navigator.clipboard.readText()") == line
    (tmp_path / "decisions.csv").write_text(HEADER + line)
    options = {"workers": 1, "decisions": tmp_path / "decisions.csv"}
    grade_submissions(graded.parent / "in", [key_path], tmp_path / "out", **options)
    grades = json.loads((tmp_path / "out/grades.json").read_text())
    (cy,) = [entry for entry in grades["learners"] if entry["name"] == "Cy"]
    decision = {"points": 1.5, "excused": False, "comment": 'nice, "but" =no'}
    assert cy["lessons"][0]["exercises"][0]["decision"] == decision
    assert 'value="1.5"' in articles(tmp_path / "out")["Cy"]


@pytest.mark.browser
def test_one_decision_is_written_to_all_who_failed_alike(graded, page):
    page.goto((graded / "review/light-double.html").as_uri())
    group = page.locator(".alike").first
    group.locator("summary").press("Enter")
    group.locator("[name=points]").fill("1")
    group.locator("[name=comment]").fill("Right idea.")
    group.locator("button").press("Enter")
    assert page.locator("#lines").input_value().splitlines() == [
        f"{name},light,light-double,1,Right idea." for name in ("Bob", "Cy")
    ]
    assert page.locator("#count").inner_text() == "2 lines for decisions.csv: Bob, Cy"
    assert page.locator("#save").is_hidden()


# ---------------------------------------------------------------- served


@pytest.fixture
def server(graded, answer_keys, tmp_path):
    decisions = tmp_path / "decisions.csv"
    decisions.write_text(HEADER + '# mine\nBob,20_light,light-double,0,"two\nlines"\nCy,light,,1,\n')
    with ReviewServer(graded, decisions, answer_keys) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield server
        server.shutdown()
        thread.join()


@pytest.mark.browser
def test_a_decision_is_saved_by_the_page_that_is_served(server, page):
    from playwright.sync_api import expect  # as in `chromium`: not everybody has it

    page.goto(server.url)
    page.get_by_role("link", name="Twice as bright").click()
    page.locator("article [name=points]").first.fill("2")
    page.get_by_text("1 line saved.").wait_for()  # without a click, one second later
    assert page.locator("#lines").input_value() == ""
    kept = HEADER + '# mine\nCy,light,,1,\nBob,light,light-double,2,"two\nlines"\r\n'
    assert server.decisions.read_bytes().decode() == kept
    page.keyboard.press("Escape")
    page.keyboard.press("e")
    page.wait_for_url("**/light-halves.html")
    page.goto(page.url.replace("light-halves", "light-double"))
    # Not wait_for_function: if it must wait, it evaluates a string, which the page's policy refuses.
    expect(page.locator("article [name=points]").first).to_have_value("2")
    page.locator("article [name=points]").nth(1).fill("7")
    page.get_by_role("button", name="Save").press("Enter")
    page.get_by_text("the points are '7'; expected 0 to 3").wait_for()
    assert server.decisions.read_bytes().decode() == kept


def test_the_command_serves_the_pages_and_counts_what_was_decided(graded, key_path, tmp_path):
    folders = [graded.parent / "in", "--key", key_path, "--out", tmp_path / "out"]
    program = Path(sys.executable).with_name("imgproc-course")
    command = [program, "grade", *folders, "--workers", "1", "--review"]
    with subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, text=True) as process:
        line = next(line for line in process.stdout if line.startswith("Read the answers"))
        url = line.split()[-1].replace("review.html", "decisions")
        assert status_of(url, b"Dora,light,light-double,2.5,") == 200
        process.send_signal(signal.SIGINT)
        rest = process.stdout.read()
    assert process.returncode == 0 and "6 learners, 6 lessons graded (0 in this run" in rest
    grades = json.loads((tmp_path / "out/grades.json").read_text())
    assert {entry["name"]: entry["points"] for entry in grades["learners"]}["Dora"] == 2.5


def status_of(url, data=None):
    try:
        with urllib.request.urlopen(url, data, timeout=60) as answer:
            return answer.status
    except urllib.error.HTTPError as error:
        error.close()
        return error.code


def test_only_pages_are_served_only_with_the_token_only_on_loopback(server):
    base = server.url.removesuffix("review.html")
    assert server.server_address[0] == "127.0.0.1"
    assert [status_of(base + name) for name in ("summary.html", "review/light-double.html")] == [200, 200]
    for name in ("grades.json", "decisions.csv", "../summary.html", "review/../decisions.csv", ""):
        assert status_of(base + name) == 404
    stranger = base.replace(server.token, "x" * len(server.token))
    assert status_of(stranger + "review.html") == 404
    before = server.decisions.read_bytes()
    assert status_of(stranger + "decisions", b"Bob,light,light-double,1,") == 404
    assert status_of(base + "decisions", b"Bob,light") == 400
    assert server.decisions.read_bytes() == before


BODY = b"Bob,light,light-double,1,"


@pytest.mark.parametrize(
    ("headers", "body"),
    [
        *((f"Content-Length: {length}", BODY) for length in ("abc", "-1", "9" * 5_000, "+25", len(BODY) + 9)),
        ("Transfer-Encoding: chunked", b"%x\r\n%b\r\n0\r\n\r\n" % (len(BODY), BODY)),
        (f"Content-Length: {len(BODY) + 1}", BODY + b"\xff"),
        (f"Content-Length: {len(BODY) + 200_000}", BODY + b"x" * 200_000),
    ],
)
def test_a_request_with_a_mistake_gets_a_line_and_saves_nothing(server, capsys, headers, body):
    before = server.decisions.read_bytes()
    with socket.create_connection(server.server_address) as connection:
        head = f"POST /{server.token}/decisions HTTP/1.0\r\nHost: elsewhere\r\n{headers}\r\n\r\n"
        connection.sendall(head.encode() + body)
        connection.shutdown(socket.SHUT_WR)
        reply = connection.makefile("rb").read()
    assert b" 400 " in reply.splitlines()[0] and b"Not saved: " in reply
    assert server.decisions.read_bytes() == before and capsys.readouterr().err == ""


def test_a_line_without_points_and_comment_takes_a_decision_back(server, answer_keys):
    assert save_decisions(server.decisions, "Bob,light,light-double,,", answer_keys) == 1
    assert server.decisions.read_text() == HEADER + "# mine\nCy,light,,1,\n"


@pytest.mark.parametrize("learner", ["=Eve", "'=Eve"])
def test_a_table_of_a_spreadsheet_keeps_its_form(tmp_path, answer_keys, learner):
    table = tmp_path / "decisions.csv"
    header = "\ufefflesson;learner;points;exercise;comment\r\n"
    table.write_bytes(
        f"{header}light;''=Eve;3;light-double;\r\nlight;{learner};1;light-double;x\r\n".encode()
    )
    save_decisions(table, '\'=Eve,light,light-double,2,"a; b"', answer_keys)
    assert (
        table.read_bytes().decode()
        == f"{header}light;''=Eve;3;light-double;\r\nlight;'=Eve;2;light-double;\"a; b\"\r\n"
    )


NAMES = ["#ada", "'#ada", "''#ada", "# ada", "=ada", "'=ada", "a,b", 'a"b', "a;b", "a\\nb", "-1", "'", "a\tb"]


def test_a_decision_on_any_name_is_saved_and_read(tmp_path, answer_keys):
    table, names = tmp_path / "decisions.csv", [sanitize_line(name) for name in NAMES]
    table.write_text(DECISIONS_TEMPLATE, encoding="utf-8")
    for name in names:
        line = csv_text([[spreadsheet_text(name), "light", "light-double", 1, ""]])
        assert save_decisions(table, line, answer_keys) == 1
    decisions = teacher_tables._by_learner(
        read_decisions(table, answer_keys), dict(zip(names, names, strict=True))
    )
    assert {name: len(rows) for name, rows in decisions.items()} == dict.fromkeys(names, 1)


def test_the_pages_of_answers_go_with_the_last_exercise(tmp_path):
    (tmp_path / "review").mkdir()
    for name in ("review.html", "review/light-double.html", "summary.html"):
        (tmp_path / name).write_text("of the run before")
    with contextlib.closing(AnswerParts(tmp_path)) as parts:
        grade._write_review(tmp_path, {"learners": []}, parts, dict)
    assert [path.name for path in tmp_path.rglob("*.html")] == ["summary.html"]
