"""The format's rules."""

import pytest
from nbclassroom.authoring.build import lesson_notebook
from nbclassroom.authoring.masters import find_masters, read_master
from nbclassroom.exercises import MasterError


def test_a_master_is_read_whole(write_master):
    master = read_master(write_master())
    assert (master.number, master.name, master.title) == ("90", "template", "Doubling")
    assert (master.minutes, master.core_minutes, master.deeper_exercises) == (5, 5, ())
    assert [(cell.id, cell.role) for cell in master.cells] == [
        ("template-1", ""),
        ("given-template-double-1", "given"),
        ("template-3", ""),
        ("template-4", ""),
        ("answer-template-double", "answer"),
        ("check-template-double-1", "check"),
    ]
    answer = master.cells[4]
    assert "NotImplementedError" in answer.source and "NotImplementedError" not in answer.solved_source
    assert "np.minimum" in answer.solved_source and "np.minimum" not in answer.source
    assert all(cell.source == cell.solved_source for cell in master.cells if cell.role != "answer")


THIRTEEN = "\n".join(f"x{k} = {k}" for k in range(13))


def test_an_optional_lesson_says_so_in_its_heading_and_metadata(write_master):
    master = read_master(write_master(("title: Doubling", "title: Doubling\n#     optional: true")))
    assert master.cells[0].source.startswith("# 90 · Doubling (optional)\n")
    assert lesson_notebook(master).metadata["imgproc_course"]["optional"] is True


@pytest.mark.parametrize(
    ("replacements", "added", "message"),
    [
        ([("title: Doubling", "title: Trebling")], "", "begins with '# Trebling'"),
        ([("title: Doubling", "title: ''")], "", "the front matter needs"),
        ([("#     title: Doubling\n", "")], "", "the front matter needs"),
        ([('role="hidden"', 'role="case"')], "", 'has no role="hidden"'),
        ([('        "What is 2 * 200, and where does uint8 end?",\n', "")], "", "nearly the code; it has 2"),
        ([('"What is 2 * 200, and where does uint8 end?"', '" "')], "", "needs hints=(...) with 3 texts"),
        ([("    explanation=", "    title=")], "", "needs explanation=...: why is"),
        ([("    another_way=", "    title=")], "", 'needs another_way="You can also write ..."'),
        ([('role="case"', 'role="hidden"')], "", 'has no role="case"'),
        ([('check("template-double", double)', "double")], "", 'must call check("template-double", ...)'),
        ([], '\n# %% role="mistake" name="uint8 wraps" says="x"\nx = 1\n', "the mistake 'uint8 wraps' twice"),
        ([], '\n# %% role="answer"\ndef double(pixels): ...\n', 'needs one role="answer" cell, found 2'),
        ([], f"\n# %%\n{THIRTEEN}\n", "13 lines of code, at most 12"),
        ([], "\n# %%\nfrom math import *\n", "star imports"),
        ([], "\n# %%\n# %%capture\nx = 1\n", "magics that hide work"),
        ([], "\n# %%\nx = 1\nx;\n", "ends with ';'"),
        ([], '\n# %% tags=["hide-input"]\nx = 1\n', "a tag hides this cell"),
        ([], "\n# %%\n# NBVAL_IGNORE_OUTPUT\nx = 1\n", "as a tag"),
        ([], "\n# %%\n# only words\n", "a code cell without code"),
        ([], '\n# %% tags=["nbval-ignore-output"]\nx = 1\n\n# %%\ny = x\n', "the next code cell must begin"),
        ([], '\n# %% tags=["nbval-ignore-output"]\nx = 1\nassert x\n', "template-7: move its asserts"),
        ([], "\n# %%\ndouble = 2 * 3\n", "defines double, which is the name of an exercise's function"),
        ([], '\n# %% role="given"\n# !ls\n', "it takes no magics"),
        ([], "\n# %%\nassert True\n", "template-7: move its asserts into a cell that begins with"),
        ([], "\n# %% [markdown]\n# **Predict** it.\n", "template-7 says **Predict**; the next cell must"),
    ],
)  # fmt: skip
def test_a_broken_rule_is_named(write_master, replacements, added, message):
    with pytest.raises(MasterError) as error:
        read_master(write_master(*replacements, add=added))
    assert message in str(error.value)
    assert str(error.value).startswith("90_template.py")


@pytest.mark.parametrize(
    "added",
    [
        f'\n# %% tags=["long"]\n{THIRTEEN}\n',
        '\n# %% tags=["nbval-ignore-output"]\nx = 1\n\n# %% [markdown]\n# A\n\n# %%\n# Check: x\nassert x\n',
        "\n# %%\n# !echo hello\n",
    ],
)
def test_a_master_that_follows_the_rules_is_read(write_master, added):
    assert len(read_master(write_master(add=added)).cells) > 6


# A prediction and a section's asserts, as the format's description shows them.
PREDICTION = """
# %% [markdown]
# **Predict** the sum.

# %% role="predict"
guess_sum = None  # your guess: which number?

# %%
total = 2 + 3
compare_guess(guess_sum, total)

# %%
# Check: the numbers in this section
assert total == 5
"""
SECOND = PREDICTION.replace("guess_sum", "guess_product").replace("2 + 3", "2 * 3")
GUESS = "guess_sum = None  # your guess: which number?"
COMPARISON = "compare_guess(guess_sum, total)"
ASSERT = "assert total == 5"


def test_predictions_and_folded_cells_are_read(write_master):
    cells = read_master(write_master(add=PREDICTION + SECOND)).cells[6:]
    roles = [(cell.id, cell.role, cell.exercise) for cell in cells if cell.role]
    assert roles == [("predict-template-1", "predict", ""), ("predict-template-2", "predict", "")]
    assert [cell.source.splitlines()[0] for cell in cells if cell.folded] == [
        "# Check: the numbers in this section"
    ] * 2


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (GUESS, GUESS.replace("None", "5"), "predict-template-2: write one line, guess_share = None"),
        (GUESS, "guess_sum = None", "predict-template-2: write one line, guess_share = None"),
        ('# %% role="predict"', "# %%", 'says **Predict**; the next cell must have role="predict"'),
        (COMPARISON, "compare_guess(guess_sum, 5)", "must end with compare_guess(guess_sum, value)"),
        (COMPARISON, "compare_guess(guess, total)", "must end with compare_guess(guess_sum, value)"),
        (COMPARISON, f"{COMPARISON}\nprint(5)", "must end with compare_guess(guess_sum, value)"),
        (COMPARISON, f"{COMPARISON}\n{ASSERT}", "move its asserts into a cell that begins with '# Check: '"),
        (ASSERT, f"{ASSERT}\nprint(5)", "it holds only asserts, and names for them"),
        (ASSERT, "five = 5", "it holds only asserts, and names for them"),
        (ASSERT, ASSERT + SECOND.replace("product", "sum"), "guess_sum is the guess of another cell too"),
    ],
)
def test_a_broken_rule_of_predictions_is_named(write_master, old, new, message):
    assert old in PREDICTION
    with pytest.raises(MasterError) as error:
        read_master(write_master(add=SECOND + PREDICTION.replace(old, new, 1)))
    assert message in str(error.value)


def test_a_planned_failure_may_stand_before_the_comparison(write_master):
    failure = '# %% tags=["nbval-raises-exception"]\nint("three")\n\n# %%\ntotal = 2'
    read_master(write_master(add=PREDICTION.replace("# %%\ntotal = 2", failure)))


TEXTS = '\n# %% role="texts"\nfigure_texts = {"a": ("A.", "B.")}\n\n# %%\n'


@pytest.mark.parametrize(
    ("added", "message"),
    [
        ("# %%\nshow(image)\n", 'show(...) needs text="<lesson>/<name>"'),
        ('# %%\nshow(image, alt="an image")\n', 'show(...) needs text="<lesson>/<name>"'),
        (f"{TEXTS}x = 1\n", 'no figure takes text="template/a"; delete it'),
        (f'{TEXTS}live_view(x, text="a")\n', 'text="a": no role="texts" cell has it; there are: template/a'),
        (f'{TEXTS}show(x, text="template/b")\n', 'text="template/b": no role="texts" cell has it'),
        ('# %%\ntext = "template/b"\n', 'text="template/b": no role="texts" cell has it; there are: none'),
        (TEXTS.replace('"B."', "f'{1}'"), "expected figure_texts = {"),
        (TEXTS.replace('"B."', '" "'), "expected figure_texts = {"),
        (TEXTS.replace(', "B."', ""), "expected figure_texts = {"),
    ],
)
def test_a_figure_without_its_texts_is_named(write_master, added, message):
    with pytest.raises(MasterError) as error:
        read_master(write_master(add=f"\n{added}"))
    assert message in str(error.value)


def test_the_texts_of_figures_stand_in_a_cell_that_no_lesson_has(write_master):
    figure = 'show(image, text="template/a")\nshow(image, caption="A.", alt="B.")'
    master = read_master(write_master(add=TEXTS + figure))
    assert (master.texts, master.cells[-1].id) == ({"a": ("A.", "B.")}, "template-7")
    assert master.cells[-1].source == figure


def test_guesses_are_read_by_the_exercises(write_master):
    path = write_master(("from imgproc_course.exercises import check", "check = print"), add=PREDICTION)
    with pytest.raises(MasterError, match="predict-template-1: no cell above imports imgproc_course"):
        read_master(path)


def test_every_broken_rule_is_named_at_once(write_master):
    with pytest.raises(MasterError) as error:
        read_master(write_master(("title: Doubling", "title: Trebling"), add="\n# %%\nfrom math import *\n"))
    assert len(str(error.value).splitlines()) == 3  # the second names its line too


def test_lessons_are_found_by_number_and_by_name(write_master, tmp_path):
    first, second = write_master(name="01_first_steps"), write_master(name="02_images")
    write_master(name="notes")
    folder = tmp_path / "masters"
    assert find_masters(folder) == [first, second]
    assert find_masters(folder, ["02"]) == find_masters(folder, ["images"]) == [second]
    assert find_masters(folder, ["01_images"]) == [second]  # under an older number: the name decides
    assert find_masters(folder, ["02_images.ipynb", "01_first"]) == [first, second]
    with pytest.raises(MasterError, match="'03' names no lesson: 01_first_steps, 02_images"):
        find_masters(folder, ["03"])
    with pytest.raises(MasterError, match="'0' names several lessons"):
        find_masters(folder, ["0"])
    with pytest.raises(MasterError, match="no masters in"):
        find_masters(tmp_path)
    beside = second.with_suffix(".mistakes.py")
    beside.touch()
    assert find_masters(folder) == [first, second]
    beside.rename(folder / "03_images.mistakes.py")
    with pytest.raises(MasterError, match=r"there is no 03_images\.py; rename it like its master"):
        find_masters(folder)
    write_master(name="03_images")
    with pytest.raises(MasterError, match="two masters of the lesson images"):
        find_masters(folder)
