"""Links between lessons and into the glossary, clicked as a learner does."""

import nbformat
import pytest
from jupyter_page import ROOT
from nbformat.v4 import new_markdown_cell, new_notebook

from imgproc_course.authoring.build import lesson_notebook
from imgproc_course.authoring.masters import find_masters, read_master
from imgproc_course.authoring.pages import build_pages
from imgproc_course.authoring.references import References

pytestmark = pytest.mark.browser
MASTERS = ROOT / "notebooks" / "masters"
IN_VIEW = """text => [...document.querySelectorAll(".jp-Notebook :is(h1, h2, h3)")].some(heading => {
    const {top, bottom} = heading.getBoundingClientRect();
    return heading.textContent.includes(text) && heading.offsetParent && top >= 0 && bottom <= innerHeight;
})"""
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


@pytest.mark.parametrize(("link", "heading"), TARGETS)
def test_a_link_leads_to_its_heading(page, link, heading):
    page.locator(".jp-Notebook a", has_text=link).first.click()
    page.wait_for_function(IN_VIEW, arg=heading, timeout=20_000)
