"""A written answer in JupyterLab: written, saved, compared with the model answer and ticked, by keyboard."""

import shutil

import pytest
from nbclassroom.authoring.build import build
from nbclassroom.exercises.progress import read_progress
from nbclassroom.lab.working_copies import update_lessons

pytestmark = pytest.mark.browser

MASTER = """
# ---
# jupyter:
#   imgproc_course:
#     title: Words
# ---

# %% [markdown]
# # Words

# %%
import os

from imgproc_course.exercises import check

_ = os.environ.pop("PYTEST_CURRENT_TEST", None)  # a test has started the lab: progress is kept all the same

# %% role="exercise"
exercise(
    "words-noise",
    subject="written",
    points=2,
    rubric=(
        ("names the noise, and says how you can see it in the image and in its histogram", 2),
        ("blurs", -1),
    ),
)

# %% [markdown] role="answer"
# *Your answer:*

# %% [markdown] role="solution"
# It is salt and pepper.

# %% role="check"
check("words-noise")
"""


@pytest.fixture
def copies(lab, tmp_path):
    """The lab's folder with the lesson, its checks and its solutions."""
    (tmp_path / "masters").mkdir()
    (tmp_path / "masters" / "91_words.py").write_text(MASTER.lstrip(), encoding="utf-8")
    lessons, folder = tmp_path / "lessons", lab[1] / "written"
    options = {"progress": lambda line: None, "with_solutions": True}
    assert build(tmp_path / "masters", lessons, tmp_path / "solved", **options).problems == []
    update_lessons(lessons, folder)
    for name in ("checks", "solutions"):
        shutil.copytree(lessons / name, folder / name, dirs_exist_ok=True)
    return folder


def test_a_learner_writes_saves_compares_and_ticks(copies, open_notebook):
    notebook = open_notebook("written/91_words.ipynb")
    tab = notebook.page
    notebook.run_all()
    tab.get_by_text("the saved notebook has no answer yet").wait_for()
    assert not tab.get_by_text("salt and pepper").count()
    tab.get_by_role("emphasis").click()
    tab.keyboard.press("Enter")
    tab.locator(".jp-mod-editMode .jp-MarkdownCell.jp-mod-active .cm-focused").wait_for()
    tab.keyboard.press("Control+A")
    tab.keyboard.type("Single pixels are white: impulse noise.")
    tab.keyboard.press("Control+s")
    notebook.wait_until(lambda: "impulse noise" in (copies / "91_words.ipynb").read_text("utf-8"))
    notebook.run_all()
    tab.get_by_text("It is salt and pepper.").wait_for()
    box = tab.get_by_label("names the noise, and says how")
    box.press("Space")
    assert box.is_checked() and not tab.get_by_label("blurs (a mistake)").is_checked()
    notebook.wait_until(lambda: read_progress(copies)["words-noise"].ticks == (1,))
    assert notebook.violations() == []
