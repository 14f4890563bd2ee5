"""The cheat sheet prints on two pages, and opens from the index."""

import re

import nbformat
import pytest
from accessibility import violations
from jupyter_page import ROOT
from nbclassroom.authoring.build import CHEAT_SHEET, cheat_sheet_page
from nbformat.v4 import new_markdown_cell, new_notebook

pytestmark = pytest.mark.browser
PAPER = {"width": 1062, "height": 733}  # CSS pixels of A4, landscape, inside the margins of 8 mm
SIZES = """() => [...document.querySelectorAll(".page")].map(
    page => [page.scrollWidth, page.getBoundingClientRect().height])"""
# The text of everything that is wider than the block in which it stands.
WIDER = """() => [...document.querySelectorAll(".block :is(table, pre, p, h3, h4)")].filter(element => {
    const block = element.closest(".stages > div") || element.closest(".block");
    const isOutside = element.getBoundingClientRect().right > block.getBoundingClientRect().right + 0.5;
    return isOutside || element.scrollWidth > element.clientWidth + 1;
}).map(element => element.textContent)"""


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("sheet") / CHEAT_SHEET
    path.write_text(cheat_sheet_page(ROOT / "notebooks" / "masters" / CHEAT_SHEET), encoding="utf-8")
    return path


@pytest.fixture
def page(browser, file):
    page = browser.new_page(viewport={"width": 900, "height": 1000})
    page.goto(file.as_uri())
    yield page
    page.close()


def test_two_pages_are_printed(page):
    pdf = page.pdf(prefer_css_page_size=True)
    assert len(re.findall(rb"/Type\s*/Page\b", pdf)) == 2
    [media_box] = set(re.findall(rb"/MediaBox\s*\[\s*0 0 ([\d.]+) ([\d.]+)\s*\]", pdf))
    assert [round(float(points) / 72 * 25.4) for points in media_box] == [297, 210]
    page.emulate_media(media="print")
    page.set_viewport_size(PAPER)
    sizes = page.evaluate(SIZES)
    assert len(sizes) == 2
    # Other fonts may need a little more height.
    assert all(width <= PAPER["width"] and height <= 0.97 * PAPER["height"] for width, height in sizes)
    assert page.evaluate(WIDER) == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_everybody_can_read_it_in_a_narrow_window(page, scheme):
    page.emulate_media(color_scheme=scheme)
    assert page.evaluate("document.documentElement.scrollWidth") <= 900 and page.evaluate(WIDER) == []
    assert violations(page) == []
    assert (
        page.evaluate("getComputedStyle(document.body).backgroundColor")
        == {
            "light": "rgb(255, 255, 255)",
            "dark": "rgb(18, 22, 28)",
        }[scheme]
    )


def test_a_link_in_a_notebook_opens_the_page(lab, open_notebook, file):
    (lab[1] / CHEAT_SHEET).write_bytes(file.read_bytes())
    cells = [new_markdown_cell(f"[Cheat sheet]({CHEAT_SHEET})")]
    kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    nbformat.write(new_notebook(cells=cells, metadata={"kernelspec": kernel}), lab[1] / "sheet_link.ipynb")
    page = open_notebook("sheet_link.ipynb").page
    page.locator(".jp-Notebook a", has_text="Cheat sheet").click()
    shown = page.frame_locator(".jp-HTMLViewer iframe")
    shown.get_by_role("heading", name="The stages of Canny").wait_for(timeout=30_000)
    columns = shown.locator(".blocks").first.evaluate("element => getComputedStyle(element).columnWidth")
    assert columns == "352px"  # its style is applied: 22 rem
