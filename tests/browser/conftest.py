"""One JupyterLab and one Chromium for all tests of this package, closed before other tests start.

While Playwright is open, its thread has a running event loop, and no other event loop can run there.
"""

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
    """A function that returns the tab for all tests, or a new tab if a test has left a dialog in it."""
    tabs = []

    def usable_tab():
        if tabs and tabs[-1].locator(".jp-Dialog").count():
            tabs.pop().close()
        if not tabs:
            tabs.append(open_tab(browser, lab[0]))
        return tabs[-1]

    return usable_tab


@pytest.fixture
def open_notebook(lab, browser, tab):
    """Opens a notebook of the lab's folder (by address: in its own tab); later closes it and its kernel."""
    pages = []

    def open_page(name, *, by_address=False):
        page = NotebookPage(browser, lab[0], name, tab=None if by_address else tab())
        pages.append(page)
        return page

    yield open_page
    for page in pages:
        page.close()
