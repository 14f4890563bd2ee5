"""One JupyterLab and one Chromium for all tests of this package, ended before those of another begin: while a
Playwright is open, its thread has an event loop that runs, and no other can."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from jupyter_page import NotebookPage, open_tab, running_chromium, running_lab


@pytest.fixture(scope="package")
def browser():
    with running_chromium() as chromium:
        yield chromium


@pytest.fixture(scope="package")
def lab(tmp_path_factory):
    """(address, folder) of a JupyterLab, started as environment/lab starts it, that serves `folder`."""
    folder = tmp_path_factory.mktemp("lessons")
    with running_lab(folder, tmp_path_factory.mktemp("lab")) as address:
        yield address, folder


@pytest.fixture(scope="package")
def tab(lab, browser):
    """A function that gives the tab of all tests; a new one where a test has left a dialog in it."""
    tabs = []

    def usable():
        if tabs and tabs[-1].locator(".jp-Dialog").count():
            tabs.pop().close()
        if not tabs:
            tabs.append(open_tab(browser, lab[0]))
        return tabs[-1]

    return usable


@pytest.fixture
def open_notebook(lab, browser, tab):
    """Opens a notebook of the lab's folder (by its address: in its own tab); closes it and its kernel."""
    pages = []

    def open_one(name, *, by_its_address=False):
        page = NotebookPage(browser, lab[0], name, tab=None if by_its_address else tab())
        pages.append(page)
        return page

    yield open_one
    for page in pages:
        page.close()
