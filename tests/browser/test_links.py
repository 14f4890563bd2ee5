"""Links between lessons and into the glossary, clicked as a learner does."""

import itertools

import nbformat
import pytest
from jupyter_page import OPEN_NOTEBOOK, ROOT
from nbformat.v4 import new_markdown_cell, new_notebook
from playwright.sync_api import TimeoutError as PlaywrightTimeoutError

from imgproc_course.classroom.authoring.build import build_pages, lesson_notebook
from imgproc_course.classroom.authoring.handout import hand_out
from imgproc_course.classroom.authoring.masters import find_masters, read_master
from imgproc_course.classroom.authoring.references import References
from imgproc_course.lab.working_copies import update_lessons

pytestmark = [pytest.mark.browser, pytest.mark.timeout(600)]
MASTERS = ROOT / "notebooks" / "masters"
# Whether a link has led to its heading: it is in view, or its cell is the active one. JupyterLab 4.6 scrolls
# a notebook once, before the cells above have their height: on a busy machine it can end beside the heading.
AT_HEADING = """heading => {
    const widget = window.jupyterapp.shell.currentWidget;
    const isInView = node => {
        const {top, bottom} = node.getBoundingClientRect();
        return node.textContent.includes(heading) && node.offsetParent && top >= 0 && bottom <= innerHeight;
    };
    const source = widget.content.activeCell?.model.sharedModel.source;
    return source?.match(/^#+ .*/m)?.[0].includes(heading)
        || [...widget.node.querySelectorAll(":is(h1, h2, h3)")].some(isInView);
}"""
# Opens a notebook beside the others, or brings it to the front, and shows the cell with a text.
SHOW = """async ([path, text]) => {
    const app = window.jupyterapp;
    const {content, context, id} = await app.commands.execute("docmanager:open", {path});
    await context.ready;
    app.shell.activateById(id);
    const cell = content.widgets.find(cell => cell.model.sharedModel.source.includes(text));
    cell.node.scrollIntoView();
}"""
TEXT = "[[canny_stages#9]] | [[term:Otsu's method]] | [[term:zero padding]] | [[term:ROS]] | [[grayscale]]"
TARGETS = [
    ("Section 9 of lesson", "Edge tracking by hysteresis"),
    ("Otsu's method", "Otsu's method"),
    ("zero padding", "border handling"),
    ("ROS", "ROS 2"),
    ("Grayscale", "Grayscale"),
]


@pytest.fixture(scope="module")
def linked_notebooks(lab):
    """Two lessons, the pages, and links.ipynb, which links into them."""
    for path in find_masters(MASTERS, ["canny_stages", "grayscale"]):
        nbformat.write(lesson_notebook(read_master(path)), lab[1] / f"{path.stem}.ipynb")
    for name, text in build_pages(MASTERS).items():
        (lab[1] / name).write_text(text, encoding="utf-8")
    cells = [new_markdown_cell(References(MASTERS / "glossary.toml").in_prose(TEXT))]
    kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    nbformat.write(new_notebook(cells=cells, metadata={"kernelspec": kernel}), lab[1] / "links.ipynb")


@pytest.fixture
def page(linked_notebooks, open_notebook):
    return open_notebook("links.ipynb").page


def click(page, source, link, heading):
    """Clicks a link of the notebook `source`, and waits until JupyterLab is at the heading.

    JupyterLab 4.6 draws the cells of a notebook while the browser is idle, and waits ten seconds for the one
    that a link names: on a busy machine another click leads on. The later ones need no mouse; only the time
    limit of the test ends them.
    """
    for attempt in itertools.count(1):
        try:
            timeout = 20_000 * attempt
            go(page, source, link, mouse=attempt <= 2, timeout=timeout)
            page.wait_for_function(AT_HEADING, arg=heading, polling=200, timeout=timeout)
            return
        except PlaywrightTimeoutError:
            continue


def go(page, source, link, *, mouse, timeout):
    page.evaluate(SHOW, [source, link])
    anchor = page.locator(".jp-NotebookPanel:not(.lm-mod-hidden) a", has_text=link).first
    if mouse:
        anchor.click(timeout=timeout)
    else:
        anchor.evaluate("link => link.click()", timeout=timeout)
    left = "path => window.jupyterapp.shell.currentWidget.context.path !== path"
    page.wait_for_function(left, arg=source, polling=200, timeout=timeout)


@pytest.mark.parametrize(("link", "heading"), TARGETS)
def test_a_link_leads_to_its_heading(page, link, heading):
    click(page, "links.ipynb", link, heading)


def test_a_link_into_the_glossary_works_from_each_place_of_a_lesson(lab, tab, tmp_path):
    """Clicked in a hand-out; the other places have the same link, and the same page beside the lesson."""
    handout = f"handout-{tmp_path.name}"  # of its own if the test runs again
    places = (lab[1] / handout, tmp_path / "my_lessons", ROOT / "notebooks")
    hand_out(places[0], ROOT / "notebooks", ["grayscale"])
    update_lessons(target=places[1])
    (lesson,) = places[0].glob("*_grayscale.ipynb")
    for place in places:
        assert "[gamma-encoded](glossary.md#gamma)" in (place / lesson.name).read_text(encoding="utf-8")
        assert "\n### gamma\n" in (place / "glossary.md").read_text(encoding="utf-8")
    page, source = tab(), f"{handout}/{lesson.name}"
    page.evaluate(OPEN_NOTEBOOK, source)
    click(page, source, "gamma-encoded", "gamma")
    path = page.evaluate("window.jupyterapp.shell.currentWidget.context.path")
    assert path == f"{handout}/glossary.md"
