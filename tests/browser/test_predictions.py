"""A working copy in JupyterLab: no result before its cell is run, a guess is compared, asserts are folded."""

import pytest
from nbclassroom.authoring.build import build
from nbclassroom.lab.working_copies import update_lessons

pytestmark = pytest.mark.browser

MASTER = """
# ---
# jupyter:
#   imgproc_course:
#     title: Sums
# ---

# %% [markdown]
# # Sums

# %%
from imgproc_course.exercises import compare_guess

# %% [markdown]
# **Predict** the sum of 2 and 3.

# %% role="predict"
guess_sum = None  # your guess: which number?

# %%
total = 2 + 3
compare_guess(guess_sum, total)

# %%
# Check: the number in this section
assert total == 5

# %%
# Check: the other number in this section
assert total < 6
"""
FOLDED = ["# Check: the number in this section", "# Check: the other number in this section"]


@pytest.fixture
def working_copy(lab, tmp_path):
    """The name of a working copy in the lab's folder."""
    (tmp_path / "masters").mkdir()
    (tmp_path / "masters" / "90_sums.py").write_text(MASTER.lstrip(), encoding="utf-8")
    built = build(tmp_path / "masters", tmp_path / "lessons", tmp_path / "solved", progress=lambda line: None)
    assert built.problems == []
    assert "The result is" in (tmp_path / "lessons" / "90_sums.ipynb").read_text(encoding="utf-8")
    update_lessons(tmp_path / "lessons", lab[1] / "copies")
    return "copies/90_sums.ipynb"


def test_a_guess_comes_before_the_result(working_copy, open_notebook):
    page = open_notebook(working_copy)
    assert page.prompts() == ["[ ]:"] * 3  # a folded cell has no prompt
    assert page.page.locator(".jp-OutputArea-output").count() == 0
    placeholders = page.page.locator(".jp-CodeCell .jp-InputPlaceholder")
    placeholders.nth(len(FOLDED) - 1).wait_for()
    assert [text.strip() for text in placeholders.all_text_contents()] == FOLDED
    assert not page.page.get_by_text("assert total").count()

    page.run_all()
    page.page.get_by_text("No guess yet").wait_for()
    assert page.page.locator(".jp-RenderedHTML").all_text_contents() == ["No guess yet. The result is 5."]
    page.page.locator(".jp-CodeCell .cm-content").nth(1).click()
    page.page.keyboard.press("Control+A")
    page.page.keyboard.type("guess_sum = 5")
    page.run_all()
    assert page.errors() == []
    page.page.get_by_text("Your guess: 5").wait_for()
    assert page.page.locator(".jp-RenderedHTML").all_text_contents() == [
        "Your guess: 5. The result: 5. Right!"
    ]
    placeholders.nth(0).locator(".jp-Placeholder-content").click()
    page.page.get_by_text("assert total == 5").wait_for()
