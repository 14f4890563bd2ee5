"""Minutes of sections and lessons, and what of a lesson is deeper."""

import re

import pytest
from nbclassroom.authoring.masters import read_master
from nbclassroom.authoring.minutes import minutes_of

WORDS = "word " * 70  # one minute
LESSON = f"""
# %% [markdown]
# **Time** [[minutes]].
#
# ## 1 · Core ([[minutes]])
# {WORDS * 6}

# %%
first = 1

# %% [markdown]
# ### Deep ([[minutes]], deeper)
# {WORDS * 7}
#
# #### Still deep
# {WORDS}

# %%
second = 2

# %% [markdown]
# ## Without minutes
# {WORDS * 2}
#
# ## 2 · Deep ([[minutes]], deeper)
#
# ### Deep as its section ([[minutes]], practice)
# {WORDS * 9}

# %%
third = 3

# %% [markdown]
# ## 3 · Core again ([[minutes+5]])
# {WORDS * 3}
"""


def sources(master):
    return "\n".join(cell.source for cell in master.cells)


def test_minutes_are_those_of_the_rule():
    counts = {"words": 700, "code lines": 20, "predictions": 2, "exercises": 1, "solution lines": 4}
    assert minutes_of(counts) == pytest.approx(10 + 2 + 3 + 3 + 4)
    assert minutes_of({"written answers": 2, "further minutes": 2}) == 18


def test_build_fills_in_the_minutes_of_sections_and_of_the_lesson(write_master):
    master = read_master(write_master(add=LESSON, name="09_template"))
    text = sources(master)
    assert "## 1 · Core (8 minutes)\n" in text  # with the two minutes below the heading without minutes
    assert "### Deep (8 minutes, deeper)\n" in text
    assert "## 2 · Deep (1 minute, deeper)\n" in text
    assert "### Deep as its section (9 minutes, practice)\n" in text
    assert "## 3 · Core again (8 minutes)" in text
    assert (master.core_minutes, master.minutes) == (20, 40)
    assert "**Time** about 20 minutes for the core, 40 with the deeper sections." in text


def test_a_deeper_section_ends_at_the_next_heading_of_its_level(write_master):
    master = read_master(write_master(add=LESSON))
    deeper = {cell.source: cell.deeper for cell in master.cells if cell.kind == "code"}
    assert [deeper[f"{name} = {value}"] for name, value in (("first", 1), ("second", 2), ("third", 3))] == [
        False,
        True,
        True,
    ]


def test_an_exercise_in_a_deeper_section_is_deeper(write_master):
    heading = ("**Your turn.** Write `double`", "## Your turn ([[minutes]], deeper)\n# Write `double`")
    master = read_master(write_master(heading))
    assert master.deeper_exercises == ("template-double",)
    assert read_master(write_master()).deeper_exercises == ()


def test_what_the_stub_gives_is_not_written_by_the_learner(write_master):
    stub = '    raise NotImplementedError("your turn")'
    solution = "    return np.minimum(pixels.astype(np.uint16) * 2, LIMIT).astype(np.uint8)"
    lines = "\n".join(f"    # {n}\n    x{n} = {n}" for n in range(40))
    longer = read_master(write_master((solution, f"{lines}\n{solution}"))).minutes
    given = read_master(write_master((solution, f"{lines}\n{solution}"), (stub, f"{lines}\n{stub}"))).minutes
    assert (longer, given) == (45, 5)  # 40 lines of one minute


def test_a_call_that_is_wrapped_in_a_solution_counts_as_one_line(write_master):
    solution = "    return np.minimum(pixels.astype(np.uint16) * 2, LIMIT).astype(np.uint8)"
    wrapped = "    values = [\n" + "        [1, 2],\n" * 40 + "    ]\n"
    masters = [write_master((solution, lines + solution)) for lines in ("    values = [[1, 2]]\n", wrapped)]
    assert [read_master(path).minutes for path in masters] == [5, 5]


def test_of_code_to_read_a_wrapped_call_is_one_line_and_imports_are_none(write_master):
    kinds = {
        "ten lines": "first = 1\n" * 10,
        "imports": "import math\n" * 8 + "from math import sin, cos\n",
        "wrapped": "first = max(\n    1,\n    2,\n)\n" * 2,
        "one line": "first = 1\n",
    }

    def minutes_of_fifty_cells(kind):
        section = "\n# %% [markdown]\n# ## 1 · Code ([[minutes]])\n" + f"\n# %%\n{kinds[kind]}" * 50
        text = sources(read_master(write_master(add=section, name="09_template")))
        return int(re.search(r"## 1 · Code \((\d+) minute", text)[1])

    minutes = {kind: minutes_of_fifty_cells(kind) for kind in kinds}
    # A line takes 0.1 minutes; of a wrapped call, the line with its parenthesis at the end counts.
    assert minutes == {"ten lines": 50, "imports": 1, "wrapped": 10, "one line": 5}
