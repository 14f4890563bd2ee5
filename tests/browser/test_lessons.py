"""Every lesson, opened and run as a learner does: no error, its live view moves, its sliders slide."""

import shutil
from pathlib import Path

import pytest
from jupyter_page import ROOT, VIEW

pytestmark = pytest.mark.browser

LESSONS = sorted((ROOT / "notebooks").glob("*.ipynb"))


def test_there_are_lessons():
    assert [path.name for path in LESSONS][:1] == ["00_start_here.ipynb"]


def moves(page, number):
    """Whether a view is alive: a lesson may have stopped some, others are of a still frame."""
    page.page.locator(VIEW).nth(number).scroll_into_view_if_needed()  # a view out of sight rests
    return page.pictures_per_second(1, number=number)["changes"] > 1


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda path: path.stem)
def test_lesson_runs_without_an_error_in_the_browser(lesson: Path, lab, open_notebook):
    shutil.copy(lesson, lab[1] / lesson.name)
    page = open_notebook(lesson.name, by_its_address=lesson == LESSONS[0])  # as environment/lab opens it
    page.run_all()
    assert page.errors() == []
    assert page.not_run() == []
    views = page.page.locator(VIEW)
    if "live_view(" in lesson.read_text(encoding="utf-8"):
        page.wait_until(lambda: any(moves(page, number) for number in range(views.count())))
    if page.page.locator(".noUi-handle").count():
        seen = {page.readout()}
        for key in ("ArrowLeft", "ArrowRight"):  # a slider may stand at either end
            page.press_on_slider(key)
            page.page.wait_for_timeout(200)
            seen.add(page.readout())
        assert len(seen) > 1
    page.screenshot(lesson.stem, VIEW if views.count() else "figure img, .jp-Cell")
