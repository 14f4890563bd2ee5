import pytest
from nbclassroom.authoring.lesson_names import lesson_name
from nbclassroom.authoring.masters import read_master
from nbclassroom.authoring.references import References
from nbclassroom.exercises.declaration import MasterError

PROSE = """
# %% [markdown]
# Read [[blur]], [[blur#2]] and [[blur|how to blur]]. [[blur#2]] comes first. `[[blur]]` is code.
"""
SECTIONS = """
# %% [markdown]
# ## 1 · One
#
# ## 21 · Not two

# %%
seed = 1

# %% [markdown]
# ### 2 · Two (3 minutes)
"""
GLOSSARY = """
["gray level"]
lesson = "template"
definition = "A number."
spellings = ["gray levels"]
"""


@pytest.fixture
def references(write_master):
    path = write_master(name="04_sharpen")
    write_master(("title: Doubling", "title: 'Blur: a mean'"), name="03_blur", add=SECTIONS)
    path.with_name("glossary.toml").write_text(GLOSSARY)
    return References(path)


def test_in_prose_references_are_links(references):
    assert references.in_prose("As in [[blur]].") == "As in [lesson 03, Blur: a mean](03_blur.ipynb)."
    assert references.in_prose("See [[blur|the mean]].") == "See [the mean](03_blur.ipynb)."
    section = "[section 2 of lesson 03](03_blur.ipynb#cell-id=blur-9)"
    assert references.in_prose("In [[blur#2]].") == f"In {section}."
    assert references.in_prose("One. [[blur#2]] is two.") == f"One. {section.replace('[s', '[S')} is two."
    assert references.in_prose("A [[term:gray level]]") == "A [gray level](glossary.md#gray-level)"
    assert references.in_prose("[[term:Gray levels|Levels]]") == "[Levels](glossary.md#gray-level)"
    code = "`[[blur]]` and ``x[[`rows`]]``, [[1, 2], [3, 4]]"
    assert references.in_prose(code) == code


def test_in_code_only_comments_and_strings_hold_references(references):
    source = 'rows = table[[blur]]  # as in [[blur]]\nprint("[[blur]]", "[[blur]]")\n'
    expected = 'rows = table[[blur]]  # as in lesson 03\nprint("lesson 03", "lesson 03")\n'
    assert references.in_code(source) == expected
    assert references.in_code("!ls  # [[blur]]") == "!ls  # lesson 03"
    assert references.in_text("[[blur]] shows [[term:gray level|levels]].") == "Lesson 03 shows levels."


@pytest.mark.parametrize(
    ("reference", "message"),
    [
        ("[[blurr]]", "[[blurr]] names no lesson; did you mean blur?"),
        ("[[zzz]]", "[[zzz]] names no lesson; there are: blur, template"),
        ("[[Blur it]]", "[[Blur it]] names no lesson; did you mean blur?"),
        ("[[blur#7]]", "03_blur.py has no section 7"),
        ("[[term:gray levl]]", "[[term:gray levl]] names no term; did you mean gray level?"),
    ],
)
def test_an_unknown_reference_is_refused_with_its_line(write_master, references, reference, message):
    path = write_master(add=f"\n# %% [markdown]\n# Words.\n# {reference}\n")
    references._path.unlink()
    with pytest.raises(MasterError) as error:
        read_master(path)
    line = len(path.read_text().splitlines())
    assert str(error.value) == f"90_template.py, line {line}: {message}"


def test_a_lesson_and_its_exercise_hold_no_unresolved_reference(write_master, references):
    path = write_master(
        ('title="Bright pixels"', 'title="As in [[blur]]"'),
        ('hint="Widen before', 'hint="[[blur]]: widen before'),
        ('says="uint8 ends', 'says="See [[blur]]: uint8 ends'),
        ('raise NotImplementedError("your turn")', 'raise NotImplementedError("[[blur]]")'),
        ("LIMIT = 255", "LIMIT = 255  # as in [[blur]]"),
        add=PROSE,
    )
    master = read_master(path)
    (exercise,) = master.exercises
    assert exercise.cases[0].title == "As in lesson 03"
    assert exercise.cases[0].hint.startswith("Lesson 03: widen")
    assert exercise.mistakes[0].says.startswith("See lesson 03: uint8")
    assert 'NotImplementedError("Lesson 03")' not in exercise.stub
    assert 'NotImplementedError("lesson 03")' in exercise.stub
    assert exercise.given[0].endswith("LIMIT = 255  # as in lesson 03")
    cells = {cell.id: cell for cell in master.cells}
    assert cells["answer-template-double"].source == exercise.stub
    assert cells["answer-template-double"].solved_source == exercise.solution
    assert cells["given-template-double-1"].source == exercise.given[0]
    assert master.cells[-1].source.count("](03_blur.ipynb") == 4
    assert master.cells[-1].source == master.cells[-1].solved_source


def test_the_number_is_no_part_of_a_lessons_name():
    assert lesson_name("04_grayscale") == lesson_name("grayscale") == "grayscale"
    assert lesson_name("04") == "04"


def test_the_lesson_has_its_number_in_its_heading(write_master):
    assert read_master(write_master(name="07_x")).cells[0].source.startswith("# 07 · Doubling\n")
    with pytest.raises(MasterError, match="begins with '# Doubling'; build adds the number"):
        read_master(write_master(("# # Doubling", "# # 07 · Doubling"), name="07_x"))
