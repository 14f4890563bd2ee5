"""Every lesson, opened and run as a learner does: no error, readable, live views change, sliders move."""

import shutil
from pathlib import Path

import pytest
from jupyter_page import ROOT, VIEW

pytestmark = pytest.mark.browser

LESSONS = sorted((ROOT / "notebooks").glob("[0-9][0-9]_*.ipynb"))


def test_there_are_lessons():
    assert [path.name for path in LESSONS][:1] == ["00_start_here.ipynb"]


def changes(page, number):
    """Whether the image of a view changes. A lesson may have stopped it, or shows a single frame in it."""
    page.page.locator(VIEW).nth(number).scroll_into_view_if_needed()  # a view outside the visible part pauses
    return page.images_per_second(1, number=number)["changes"] > 1


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda path: path.stem)
def test_lesson_runs_without_an_error_in_the_browser(lesson: Path, lab, open_notebook):
    shutil.copy(lesson, lab[1] / lesson.name)
    page = open_notebook(lesson.name, by_address=lesson == LESSONS[0])  # as environment/lab opens it
    page.run_all()
    assert page.errors() == []
    assert page.not_run() == []
    views = page.page.locator(VIEW)
    source = lesson.read_text(encoding="utf-8")
    if '"view.stop()' in source:  # the lesson stops its view, which keeps the last image
        page.wait_until(lambda: page.images_per_second(1)["changes"] <= 1)
    elif "live_view(" in source:
        page.wait_until(lambda: any(changes(page, number) for number in range(views.count())))
    if page.page.locator(".noUi-handle").count():
        readout, handle = page.readout(), page.page.locator(".noUi-handle").first
        is_at_end = handle.get_attribute("aria-valuenow") == handle.get_attribute("aria-valuemin")
        page.press_on_slider("ArrowRight" if is_at_end else "ArrowLeft")
        page.wait_until(lambda: page.readout() != readout)
        page.page.wait_for_function(
            "[...document.querySelectorAll('.noUi-handle')].every(handle => handle.ariaLabel)"
        )
    for theme in ("Dark", "Light"):
        page.set_theme(theme)
        assert page.violations() == []
    page.screenshot(lesson.stem, VIEW if views.count() else "figure img, .jp-Cell")
