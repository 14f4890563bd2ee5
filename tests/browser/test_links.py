"""Links between lessons and into the glossary, clicked as a learner does."""

import shutil

import nbformat
import pytest
from jupyter_page import OPEN_NOTEBOOK, ROOT
from nbformat.v4 import new_markdown_cell, new_notebook
from playwright.sync_api import TimeoutError as PlaywrightTimeoutError

from imgproc_course.authoring.build import lesson_notebook
from imgproc_course.authoring.handout import hand_out
from imgproc_course.authoring.masters import find_masters, read_master
from imgproc_course.authoring.pages import build_pages
from imgproc_course.authoring.references import References
from imgproc_course.working_copies import update_lessons

pytestmark = pytest.mark.browser
MASTERS = ROOT / "notebooks" / "masters"
# A cell that is not rendered yet when JupyterLab scrolls there stays Markdown source: .cm-line.
HEADINGS = ".jp-Notebook :is(h1, h2, h3, .cm-line)"
IN_VIEW = f"""text => [...document.querySelectorAll("{HEADINGS}")].some(heading => {{
    const {{top, bottom}} = heading.getBoundingClientRect();
    return heading.textContent.includes(text) && heading.offsetParent && top >= 0 && bottom <= innerHeight;
}})"""
OPEN_TOO = "path => { window.jupyterapp.commands.execute('docmanager:open', {path}); }"
TEXT = "[[canny_stages#8]] | [[term:Otsu's method]] | [[term:zero padding]] | [[term:ROS]] | [[grayscale]]"
TARGETS = [
    ("section 8 of lesson", "Edge tracking by hysteresis"),
    ("Otsu's method", "Otsu's method"),
    ("zero padding", "border handling"),
    ("ROS", "ROS 2"),
    ("Grayscale", "Grayscale"),
]


@pytest.fixture
def page(lab, open_notebook):
    for path in find_masters(MASTERS, ["canny_stages", "grayscale"]):
        nbformat.write(lesson_notebook(read_master(path)), lab[1] / f"{path.stem}.ipynb")
    for name, text in build_pages(MASTERS).items():
        (lab[1] / name).write_text(text, encoding="utf-8")
    cells = [new_markdown_cell(References(MASTERS / "glossary.toml").in_prose(TEXT))]
    kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    nbformat.write(new_notebook(cells=cells, metadata={"kernelspec": kernel}), lab[1] / "links.ipynb")
    return open_notebook("links.ipynb").page


def click(page, source, link, heading):
    """Clicks a link of the notebook `source`, and waits until the heading is in view.

    JupyterLab 4.6 scrolls once, before all cells above have their height: on a busy machine it can
    end beside the heading. Not if the notebook is open already: then a second click leads there.
    """
    for is_last in (False, True):
        page.locator(".jp-Notebook:visible a", has_text=link).first.click()
        try:
            page.wait_for_function(IN_VIEW, arg=heading, timeout=60_000 if is_last else 20_000)
            return
        except PlaywrightTimeoutError:
            if is_last:
                raise
        page.evaluate(OPEN_TOO, source)


@pytest.mark.parametrize(("link", "heading"), TARGETS)
def test_a_link_leads_to_its_heading(page, link, heading):
    click(page, "links.ipynb", link, heading)


def test_a_link_into_the_glossary_works_from_each_place_of_a_lesson(lab, tab):
    for folder in ("notebooks", "my_lessons", "handout"):
        target = lab[1] / "places" / folder
        if folder == "notebooks":
            shutil.copytree(ROOT / folder, target, ignore=shutil.ignore_patterns("masters"))
        elif folder == "my_lessons":
            update_lessons(target=target)
        else:
            hand_out(target, ROOT / "notebooks", ["grayscale"])
        (lesson,) = target.glob("*_grayscale.ipynb")
        page = tab()
        source = f"places/{folder}/{lesson.name}"
        page.evaluate(OPEN_NOTEBOOK, source)
        click(page, source, "gamma-encoded", "gamma")
        path = page.evaluate("window.jupyterapp.shell.currentWidget.context.path")
        assert path == f"places/{folder}/glossary.ipynb"
