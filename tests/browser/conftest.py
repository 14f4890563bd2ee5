"""One JupyterLab and one Chromium for all browser tests of a worker."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from jupyter_page import NotebookPage, running_chromium, running_lab


@pytest.fixture(scope="session")
def browser():
    with running_chromium() as chromium:
        yield chromium


@pytest.fixture(scope="session")
def lab(tmp_path_factory):
    """(address, folder) of a JupyterLab, started as environment/lab starts it, that serves `folder`."""
    folder = tmp_path_factory.mktemp("lessons")
    with running_lab(folder, tmp_path_factory.mktemp("lab")) as address:
        yield address, folder


@pytest.fixture
def open_notebook(lab, browser):
    """Opens a notebook of the lab's folder in a tab; closes the tab and its kernel afterwards."""
    pages = []

    def open_one(name, **options):
        page = NotebookPage(browser, lab[0], name, **options)
        pages.append(page)
        return page

    yield open_one
    for page in pages:
        page.close()
