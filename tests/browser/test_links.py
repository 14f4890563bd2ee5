"""Links between lessons and into the glossary, clicked as a learner does."""

import itertools

import pytest
from jupyter_page import ROOT
from nbclassroom.authoring.handout import hand_out
from playwright.sync_api import TimeoutError as PlaywrightTimeoutError

pytestmark = [pytest.mark.browser, pytest.mark.timeout(600)]
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


def click(page, source, link, heading):
    """Clicks a link of the notebook `source`, and waits until JupyterLab is at the heading.

    JupyterLab 4.6 draws the cells of a notebook while the browser is idle, and may end beside the one that a
    link names: another click leads on. The later ones need no mouse; the test's time limit ends them.
    """
    for attempt in itertools.count(1):
        try:
            timeout = 6_000 * attempt
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


def test_links_lead_to_a_heading_of_another_lesson_and_into_the_glossary(lab, open_notebook, tmp_path):
    handout = f"handout-{tmp_path.name}"  # of its own if the test runs again
    hand_out(lab[1] / handout, ROOT / "notebooks", ["mapping_and_slam", "drive_the_robot"])
    (lesson,) = (lab[1] / handout).glob("*_mapping_and_slam.ipynb")
    source = f"{handout}/{lesson.name}"
    page = open_notebook(source).page
    click(page, source, "section 5 of lesson 11", "Drive a square")
    click(page, source, "Bresenham's line", "Bresenham's line")
    path = page.evaluate("window.jupyterapp.shell.currentWidget.context.path")
    assert path == f"{handout}/glossary.md"
