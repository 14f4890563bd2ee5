"""Every lesson, opened as a learner does, can be read; its widgets are run: views change, sliders move.

tests/notebooks runs all cells of all lessons, and holds what they show to the stored outputs.
"""

import re
import shutil
import sys
from pathlib import Path

import nbformat
import pytest
from jupyter_page import ROOT, VIEW

sys.path.append(str(ROOT / "tests" / "notebooks"))
from nbclassroom.authoring.lesson_names import lesson_name
from needed_cells import names_changed, names_imported, names_of, needed_cells

pytestmark = pytest.mark.browser

LESSONS = sorted((ROOT / "notebooks").glob("[0-9][0-9]_*.ipynb"))
HAS_WIDGETS = re.compile(r"(?<![.\w`])(?<!# )(live_view|tune|drive)\(")  # not in prose, nor switched off
STOPS_ITS_VIEW = re.compile(r"^ *view\.stop\(\)", re.MULTILINE)
SHOWS_A_VIEW = re.compile(r"(?<![.\w`])(?<!# )live_view\(")


def test_there_are_lessons():
    assert [path.name for path in LESSONS][:1] == ["00_start_here.ipynb"]


def changes(page, number):
    """Whether the image of a view changes. A lesson may have stopped it, or shows a single frame in it."""
    page.page.locator(VIEW).nth(number).scroll_into_view_if_needed()  # a view outside the visible part pauses
    return page.images_per_second(1, number=number)["changes"] > 1


def cell_sources(lesson):
    cells = nbformat.read(lesson, as_version=4).cells
    return [cell.source for cell in cells if cell.cell_type == "code"]


def cells_of_widgets(lesson):
    """Numbers of the code cells that make widgets, or use them, and of those that these need."""
    cells = cell_sources(lesson)
    names = [names_of(source) for source in cells]
    modules = set().union(*map(names_imported, cells))
    changes = [names_changed(source) - modules for source in cells]
    making = {number for number, source in enumerate(cells) if HAS_WIDGETS.search(source)}
    widgets = set().union({"open_camera"}, *(names[number][1] for number in making))
    using = {number for number, (read, _) in enumerate(names) if read & widgets}
    stopping = {number for number, cell in enumerate(cells) if STOPS_ITS_VIEW.search(cell)}
    chosen = making | using | stopping
    return needed_cells(names, chosen, changes)


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda path: path.stem)
def test_everybody_can_read_a_lesson_and_its_widgets_work(lesson: Path, lab, open_notebook):
    for path in (lesson, *lesson.parent.glob(f"{lesson_name(lesson.stem)}.py")):
        shutil.copy(path, lab[1])
    page = open_notebook(lesson.name, by_address=lesson == LESSONS[0])  # as environment/lab opens it
    source = lesson.read_text(encoding="utf-8")
    page.trust()
    if numbers := cells_of_widgets(lesson) if HAS_WIDGETS.search(source) else []:
        page.run_cells(numbers)
        assert page.errors() == []
        assert set(numbers).isdisjoint(page.not_run())
    else:
        page.page.set_viewport_size({"width": 1400, "height": 30_000})  # axe-core reads what is in the window
    views = page.page.locator(VIEW)
    if any(map(STOPS_ITS_VIEW.search, cell_sources(lesson))):  # then the view keeps the last image
        page.wait_until(lambda: page.images_per_second(1)["changes"] <= 1)
    elif SHOWS_A_VIEW.search(source) and "live_seconds = 0" not in source:  # there a learner switches it on
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
        assert page.violations(only_colors=theme == "Light") == []
    page.page.set_viewport_size({"width": 1400, "height": 1000})
    page.screenshot(lesson.stem, VIEW if views.count() else "figure img, .jp-Cell")
