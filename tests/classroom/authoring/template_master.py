"""The example master of the format's description, and a fixture that writes it, changed, into a folder."""

import re
import textwrap

import pytest

from imgproc_course.classroom.authoring import masters
from imgproc_course.classroom.authoring.lesson_files import lesson_files

# The example in the format's description, so that what is described is what is tested.
TEMPLATE = textwrap.dedent(re.search(r"A whole one:\n\n(.*?)\nFront matter", masters.__doc__, re.S)[1])


@pytest.fixture(scope="session")
def template():
    """The template master, as text."""
    return TEMPLATE


@pytest.fixture
def write_master(tmp_path):
    """Writes the template with pieces of it replaced, or text added, and lets `check` find it."""

    def write(*replacements, add="", name="90_template"):
        text = TEMPLATE
        for old, new in replacements:
            assert old in text
            text = text.replace(old, new)
        folder = tmp_path / "masters"
        folder.mkdir(exist_ok=True)
        path = folder / f"{name}.py"
        path.write_text(text + add, encoding="utf-8")
        return path

    return write


def write_carried_files(master, folder):
    """Write the files that the lesson of a Master carries into a folder."""
    for name, text in lesson_files(master).items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
