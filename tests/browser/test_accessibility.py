"""What the course draws in JupyterLab can be read in both themes, and used without a mouse."""

import textwrap

import nbformat
import pytest
from jupyter_page import ROOT, NotebookPage, write_notebook
from nbclassroom.authoring.build import lesson_notebook
from nbclassroom.authoring.masters import read_master

pytestmark = pytest.mark.browser

OUTPUTS = [
    """
    import numpy as np
    from imgproc_course.display import show
    from imgproc_course.doctor.report import Report, failure, ok, warning
    from imgproc_course.exercises import check, compare_guess, hint, overview, solution

    grid = np.arange(25, dtype=np.uint8).reshape(5, 5) * 10
    show([grid, grid.T, grid[::-1]], ["a", "b", "c"], alt="three grids", caption="Three grids.")
    Report([ok("a", "well"), warning("b", "odd", "repair it"), failure("c", "broken", "repair it")])
    """,
    "overview()",
    "compare_guess(36, 40)",
    "def crop(image, top, bottom, left, right):\n    return image[top:bottom]",
    'check("arrays-crop", crop)',
    "def crop(image, top, bottom, left, right):\n    return image[top:bottom, left:right]",
    'check("arrays-crop", crop)',
    'hint("arrays-crop")',
    'solution("arrays-crop", give_up=True)',
    """
    from imgproc_course.display import live_view, tune

    class Ramp:
        rate = 10.0
        def __len__(self):
            return 50
        def frame(self, k, encoding="bgr8"):
            return np.full((90, 160, 3), 5 * k, np.uint8)

    def band(frame, low, high, *, offset=0, inside=True):
        if offset > 5:
            raise ValueError("an offset above 5")
        is_inside = (low <= frame[..., 0] + offset) & (frame[..., 0] + offset < high)
        return is_inside == inside

    tuner = tune(band, np.dstack([np.tile(np.arange(250, dtype=np.uint8), (90, 1))] * 3),
                 thresholds=(0, 250), offset=(0, 9), inside=True)
    tuner["offset"].value = 9
    """,
    "view = live_view(Ramp())",
]


# The element that has the focus: its name, and whether the focus changes its look.
FOCUSED = """() => {
    const node = document.activeElement;
    const look = () => {
        const style = getComputedStyle(node);
        return [style.outline, style.boxShadow, style.background, style.border].join();
    };
    const withFocus = look();
    node.blur();
    const differs = look() !== withFocus;
    node.focus();
    return [node.ariaLabel || node.innerText || node.closest("label, .jupyter-widgets")?.innerText, differs];
}"""
# The texts and classes of the boxes and labels that are wider than their place.
CUT_OFF = """() => [...document.querySelectorAll(".jp-Cell :is(.widget-box, .widget-label, .jupyter-button)")]
    .filter(node => node.scrollWidth > node.clientWidth).map(node => [node.className, node.innerText])"""
# In the order of the Tab key; a number is the value that stands beside a slider.
CONTROLS = ["thresholds: low", "thresholds: high", "20 – 50", "offset", "9", "inside", "Reset"]


@pytest.fixture(scope="module")
def outputs(lab, browser):
    """The page of a notebook of OUTPUTS that has run."""
    write_notebook(lab[1] / "outputs.ipynb", [textwrap.dedent(cell).strip() for cell in OUTPUTS])
    page = NotebookPage(browser, lab[0], "outputs.ipynb")
    page.run_all()
    page.page.locator(".noUi-handle[aria-label]").nth(2).wait_for()
    yield page
    page.close()


def assert_everybody_can_read(page, name, selector):
    assert page.errors() == []
    page.page.locator(selector).first.wait_for()
    for theme in ("Dark", "Light"):
        page.set_theme(theme)
        assert page.violations(only_colors=theme == "Light") == []
        page.screenshot(f"{name}_{theme}", selector)


def test_everybody_can_read_the_index(lab, open_notebook):
    notebook = lesson_notebook(read_master(ROOT / "notebooks" / "masters" / "index.py"))
    nbformat.write(notebook, lab[1] / "index.ipynb")
    page = open_notebook("index.ipynb")
    page.run_all()
    assert_everybody_can_read(page, "index", "svg")


def test_everybody_can_read_what_the_course_draws(outputs):
    assert_everybody_can_read(outputs, "outputs", ".noUi-handle[aria-label]")


def test_images_stand_one_below_the_other_in_a_narrow_window(outputs):
    images = outputs.page.locator("figure img")

    def rows_and_widths():
        boxes = [images.nth(k).bounding_box() for k in range(3)]
        return len({box["y"] for box in boxes}), {round(box["width"]) for box in boxes}

    for width, rows in ((1400, 1), (900, 3)):
        outputs.page.set_viewport_size({"width": width, "height": 1000})
        outputs.wait_until(lambda rows=rows: rows_and_widths() == (rows, {298}))


def test_sliders_and_buttons_work_with_the_keyboard_alone(outputs):
    page = outputs
    page.page.set_viewport_size({"width": 900, "height": 1000})
    page.page.locator(".noUi-handle").first.focus()
    for control in CONTROLS:
        assert page.page.evaluate(FOCUSED) == [control, True]
        if control != CONTROLS[-1]:
            page.page.keyboard.press("Tab")
    page.page.keyboard.press("Space")
    page.wait_until(lambda: page.readout(1) == "0")
    page.page.locator("button.jupyter-button", has_text="Stop").focus()
    page.page.keyboard.press("Space")
    page.page.get_by_text("stopped after").wait_for()
    assert page.page.evaluate(CUT_OFF) == []
