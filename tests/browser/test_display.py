"""show, live_view and tune in a real browser: images change, sliders work, the page does not move."""

import re
import textwrap

import pytest
from jupyter_page import VIEW, write_notebook

pytestmark = pytest.mark.browser

LAST_CELL = ".jp-CodeCell >> nth=-1"
BOTH_IMAGES = """selector => {
    const images = [...document.querySelectorAll(selector)];
    return images.length === 2 && images.every(image => image.naturalWidth > 0);
}"""
# A camera of 1280 × 720 at 30 Hz: a red bar that moves over a gradient.
CAMERA = textwrap.dedent(
    """
    import glob
    import time
    import cv2
    import numpy as np
    from imgproc_course.display import live_view, show, tune

    class MovingBar:
        rate = 30.0
        def __len__(self):
            return 120
        def frame(self, k, encoding="bgr8"):
            frame = np.empty((720, 1280, 3), np.uint8)
            frame[:] = np.linspace(0, 200, 1280).astype(np.uint8)[:, None]
            frame[:, 10 * k : 10 * k + 60] = (0, 0, 255)
            return frame

    camera = MovingBar()
    """
)


@pytest.fixture
def notebook(lab, open_notebook, request):
    """Writes a notebook of CAMERA and the given cells, opens it and runs all cells."""

    def make(*cells, run=True):
        name = f"{request.node.name.partition('[')[0]}.ipynb"
        write_notebook(lab[1] / name, [CAMERA, *map(textwrap.dedent, cells)])
        page = open_notebook(name)
        if run:
            page.run_all()
        return page

    return make


def colour_at(page, x, y):
    """[red, green, blue] of the live image at (x, y), each from 0 to 1."""
    return page.page.evaluate(
        """([selector, x, y]) => {
            const image = document.querySelector(selector);
            const canvas = new OffscreenCanvas(image.naturalWidth, image.naturalHeight);
            const context = canvas.getContext("2d");
            context.drawImage(image, 0, 0);
            const pixel = [x * canvas.width, y * canvas.height].map(Math.floor);
            return Array.from(context.getImageData(...pixel, 1, 1).data).slice(0, 3);
        }""",
        [VIEW, x, y],
    )


def test_a_live_view_changes_and_its_slider_works_while_it_runs(notebook):
    page = notebook(
        """
        def bright(frame, level=100):
            return cv2.threshold(cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), level, 255, cv2.THRESH_BINARY)[1]

        view = live_view(camera, bright, level=(0, 250, 50))
        """,
        "1 + 1",
    )
    assert page.errors() == []
    page.wait_for_image()
    assert page.images_per_second(3)["changes"] > 5
    page.wait_until(lambda: colour_at(page, 0.9, 0.5)[0] > 200 or colour_at(page, 0.9, 0.2)[0] > 200)
    distance = page.distance_from_top(LAST_CELL)
    for _ in range(5):
        page.press_on_slider("ArrowRight")
    page.wait_until(lambda: max(colour_at(page, 0.9, 0.5)) < 60)
    assert page.readout() == "250"
    page.page.locator("code", has_text="bright(frame, level=250)").wait_for()
    assert page.distance_from_top(LAST_CELL) == distance
    page.screenshot("live_view", VIEW)


def test_no_blank_space_stands_below_an_image_without_a_text(notebook):
    page = notebook("live_view(camera)", "tune(lambda frame, k: frame, camera.frame(3), k=(0, 9))", "1 + 1")
    page.page.wait_for_function(BOTH_IMAGES, arg=VIEW)
    for number in range(2):
        image, screen = (
            page.page.locator(css).nth(number).bounding_box() for css in (VIEW, f".widget-vbox:has(> {VIEW})")
        )
        assert screen["y"] + screen["height"] - image["y"] - image["height"] <= 6


def test_an_error_in_the_function_is_shown_and_the_view_goes_on(notebook):
    page = notebook(
        """
        count = 0
        def every_third(frame):
            global count
            count += 1
            print("number", count)
            if count % 90 > 45:
                raise ValueError("a frame that I do not like")
            return frame

        view = live_view(camera, every_third)
        """,
        "1 + 1",
    )
    error_line = page.page.get_by_text("ValueError: a frame that I do not like")
    error_line.wait_for()
    distance = page.distance_from_top(LAST_CELL)
    assert 'raise ValueError("a frame that I do not like")' in error_line.inner_text()
    assert "in every_third, line 7" in error_line.inner_text()
    page.screenshot("live_view_error", VIEW)
    error_line.wait_for(state="hidden")
    page.page.get_by_text(re.compile(r"number \d")).wait_for()
    assert page.outputs(1) == []
    assert page.distance_from_top(LAST_CELL) == distance
    assert page.errors() == []


def test_stop_start_snapshot_and_running_the_cell_again(notebook, lab):
    page = notebook(
        "views = []",
        "view = live_view(camera); views.append(view)",
        "print([view.running for view in views])",
    )
    page.wait_for_image()
    page.press_button("Stop")
    page.page.get_by_text("stopped after").wait_for()
    page.wait_until(lambda: page.images_per_second(1)["loads"] == 0)  # the last ones may be on their way
    page.press_button("Snapshot")
    page.page.get_by_text("saved as .snapshots[0] and snapshot-001.png").wait_for()
    assert (lab[1] / "snapshot-001.png").stat().st_size > 1000
    page.press_button("Start")
    page.wait_until(lambda: page.images_per_second(0.5)["loads"] > 0)
    page.run_cell(2)
    page.run_cell(3)
    assert page.outputs(3) == ["[False, True]\n"]


def test_a_live_view_pauses_when_its_output_is_deleted(notebook):
    page = notebook(
        "view = live_view(camera)",
        """
        shown = view.shown
        while view.shown < shown + 3:
            time.sleep(0.01)
        shown = -1
        """,
        """
        while shown != view.shown:
            shown = view.shown
            time.sleep(1)
        print("it pauses")
        """,
        run=False,
    )
    for cell in range(3):
        page.run_cell(cell)
    page.page.locator(".jp-CodeCell .cm-content").nth(1).click()
    page.page.get_by_role("menuitem", name="Edit", exact=True).click()
    page.page.get_by_role("menuitem", name="Clear Cell Output", exact=True).click()
    page.page.locator(VIEW).wait_for(state="detached")
    page.run_cell(3)
    assert page.outputs(3) == ["it pauses\n"]


def test_a_view_goes_on_while_another_cell_runs(notebook, lab):
    page = notebook("view = live_view(camera)", "'ready'")
    page.wait_for_image()
    page.page.locator(".jp-CodeCell .cm-content").nth(2).click()
    page.page.keyboard.press("Control+A")
    page.page.keyboard.type("while not glob.glob('go on'): time.sleep(0.1)")
    page.page.keyboard.press("Control+Enter")
    page.wait_until(lambda: "[*]:" in page.prompts())
    for _ in range(3):
        page.wait_until(lambda: page.images_per_second(0.5)["loads"] > 0)
    assert "[*]:" in page.prompts()
    (lab[1] / "go on").touch()
    page.wait_until(lambda: "[*]:" not in page.prompts())


def test_tune_follows_its_range_slider_and_resets(notebook):
    page = notebook(
        """
        def canny(gray, low, high, *, sigma=0.0):
            return cv2.Canny(gray, low, high)

        gray = camera.frame(20)[:, :, 2]
        tuner = tune(canny, gray, thresholds=(0, 1020), sigma=(0, 5.0))
        """,
        "print(tuner.call, tuner.value.sum() // 255)",
    )
    assert page.errors() == []
    page.wait_for_image()
    assert page.readout() == "100 – 200"
    page.press_on_slider("PageUp", 1)
    page.wait_until(lambda: page.readout() != "100 – 200")
    call = f"canny(gray, low=100, high={page.readout().split()[-1]}, sigma=0.0)"
    page.page.locator("code", has_text=call).wait_for()
    page.run_cell(2)
    assert page.outputs(2)[0].startswith(call)
    page.screenshot("tune", VIEW)
    page.press_button("Reset")
    page.wait_until(lambda: page.readout() == "100 – 200")
    assert page.page.locator(VIEW).get_attribute("title") == "Result of canny on the frame"


TUNER = """
    def canny(gray, low, high, *, sigma=0.0, l2_gradient=False, stage="edges"):
        return cv2.Canny(gray, low, high, L2gradient=l2_gradient)

    gray = camera.frame(20)[:, :, 2]
    tuner = tune(canny, gray, thresholds=(0, 1020), sigma=(0, 5.0), l2_gradient=False, stage=["edges"])
"""


def left_top_width(page, selector):
    return page.page.evaluate(
        """selector => {
            const box = document.querySelector(selector).getBoundingClientRect();
            return [box.left, box.top, box.width];
        }""",
        selector,
    )


def test_sliders_are_long_enough_beside_the_image_or_below_it(notebook):
    page = notebook(TUNER)
    page.wait_for_image()

    def place_of_sliders():
        image, slider = (left_top_width(page, selector) for selector in (VIEW, ".noUi-target"))
        return slider[2] > 240, slider[0] > image[0] + image[2], slider[1] < image[1] + 100

    for width in (1600, 1400, 1280, 1000):
        page.page.set_viewport_size({"width": width, "height": 1000})
        is_beside = width == 1600
        # JupyterLab arranges its parts some time later.
        page.wait_until(lambda is_beside=is_beside: place_of_sliders() == (True, is_beside, is_beside))
        column = left_top_width(page, ".noUi-target")[0]
        for control in (".widget-checkbox input", ".widget-dropdown select"):
            assert abs(left_top_width(page, control)[0] - column) < 12


def test_show_has_an_alternative_text_also_in_an_untrusted_notebook(notebook, lab, open_notebook):
    page = notebook(
        """
        show([camera.frame(20), camera.frame(20)[:, :, 2]], ["frame", "its red channel"],
             alt="a red bar on a gray ramp", caption="In the red channel the bar is white.")
        """,
        "show(np.arange(25, dtype=np.uint8).reshape(5, 5) * 10, alt='five by five numbers')",
    )
    alts = page.page.locator("figure img").evaluate_all("nodes => nodes.map(node => node.alt)")
    assert alts == ["a red bar on a gray ramp", "continued", "five by five numbers"]
    page.page.keyboard.press("Control+s")
    page.screenshot("show")
    path = lab[1] / "test_show_has_an_alternative_text_also_in_an_untrusted_notebook.ipynb"
    page.wait_until(
        lambda: "five by five numbers" in path.read_text().replace("alt='five by five numbers'", "")
    )
    page.close()
    # A copy with another source, as an updated lesson, is a notebook that Jupyter does not trust.
    copy = lab[1] / "copied.ipynb"
    copy.write_text(path.read_text().replace("np.arange(25", "np.arange( 25"))
    page = open_notebook(copy.name)
    images = page.page.locator("figure img")
    images.first.wait_for()
    alts_and_sizes = images.evaluate_all("nodes => nodes.map(node => [node.alt, node.naturalWidth > 200])")
    assert alts_and_sizes == [[alt, True] for alt in alts]
    assert page.page.locator("figcaption").all_inner_texts() == ["In the red channel the bar is white."]
