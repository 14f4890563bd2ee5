"""An example master, and a fixture that writes it, changed, into a folder."""

import pytest
from nbclassroom.authoring.lesson_files import lesson_files

# A whole master, with one cell of nearly every role.
TEMPLATE = """\
# ---
# jupyter:
#   imgproc_course:
#     title: Doubling
# ---

# %% [markdown]
# # Doubling
# You will write a function, and see it checked.

# %% role="given" exercise="template-double"
import numpy as np

LIMIT = 255

# %%
from imgproc_course.exercises import check

# %% role="exercise"
from imgproc_course.exercises import exercise

exercise(
    "template-double",
    function="double",
    time_limit=5,
    allowed=("scipy",),
    hints=(
        "What is 2 * 200, and where does uint8 end?",
        "Widen the array, multiply, limit it to LIMIT, and make it uint8 again.",
        "np.minimum(pixels.astype(np.uint16) * ..., ...).astype(...)",
    ),
    explanation="uint16 has room for 2 * 255, so nothing is lost before the limit.",
    another_way="You can also write np.where(pixels > LIMIT // 2, LIMIT, pixels * 2).",
)

# %% [markdown]
# **Your turn.** Write `double`: each value twice, never above 255.

# %% role="answer"
def double(pixels):
    raise NotImplementedError("your turn")

# %% role="solution"
def double(pixels):
    return np.minimum(pixels.astype(np.uint16) * 2, LIMIT).astype(np.uint8)

# %% role="check"
check("template-double", double)

# %% role="case" title="Bright pixels" points=1 hint="Widen before you multiply: uint8 ends at 255."
def inputs(rng):
    return (rng.integers(100, 256, (3, 4), dtype=np.uint8),)

# %% role="hidden" title="Any pixels" points=2 hint="What does 200 become?"
def inputs(rng):
    return [(rng.integers(0, 256, (5, 5), dtype=np.uint8),) for _ in range(3)]

# %% role="mistake" name="uint8 wraps" says="uint8 ends at 255, and 200 * 2 became 144: widen first."
def double(pixels):
    return pixels * 2
"""


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
