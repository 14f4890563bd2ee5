import pytest
from nbclassroom.authoring.build import build, build_pages, compare_lessons
from nbclassroom.authoring.references import read_glossary
from nbclassroom.exercises.declaration import MasterError

GLOSSARY = """
["Zoom"]
lesson = "blur"
definition = "To enlarge, as in [[blur]]. See [[term:median filters]]."

["median filter"]
lesson = "sharpen"
definition = "The middle value."
spellings = ["median filters", "rank filter"]

["edge"]
lesson = "blur"
definition = "A border."

["edge detector"]
lesson = "sharpen"
definition = "A program."

["view"]
lesson = "sharpen"
definition = "Ordinary."
ordinary = true
"""


@pytest.fixture
def glossary(tmp_path):
    def write(text=GLOSSARY):
        path = tmp_path / "masters" / "glossary.toml"
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_the_glossary_is_a_page_in_alphabetical_order(glossary, write_master):
    write_master(name="01_blur"), write_master(name="02_sharpen")
    assert build_pages(glossary().parent).keys() == {"glossary.md"}
    page = build_pages(glossary().parent)["glossary.md"]
    headings = [line for line in page.splitlines() if line.startswith("#")]
    assert headings[0] == "# Glossary"
    assert headings[1:] == ["### edge", "### edge detector", "### median filter", "### view", "### Zoom"]
    assert page.endswith(
        "\n\n### Zoom\n\nTo enlarge, as in [lesson 01, Doubling](01_blur.ipynb). See [median"
        " filters](glossary.md#median-filter).\n\n→ [lesson 01, Doubling](01_blur.ipynb)\n"
    )


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[", "glossary.toml: it is not TOML"),
        ('["x"]\nlesson = "blur"\n', "glossary.toml: ['x'] needs definition = \"...\""),
        ('["x"]\nlesson = " "\ndefinition = "y"\n', "glossary.toml: ['x'] needs lesson = \"...\""),
        ('["x"]\nnote = "y"\n', "glossary.toml: ['x'] takes only definition, lesson, ordinary, spellings"),
        (GLOSSARY.replace("rank filter", "Edge"), "'edge' belongs to 'median filter' and to 'edge'"),
    ],
)  # fmt: skip
def test_a_glossary_with_an_error_is_refused(glossary, text, message):
    with pytest.raises(MasterError) as error:
        read_glossary(glossary(text))
    assert message in str(error.value)


def test_a_term_of_an_unknown_lesson_is_refused(glossary, write_master):
    write_master(name="01_blur")
    with pytest.raises(MasterError, match=r"\[\[sharpen\]\] names no lesson"):
        build_pages(glossary().parent)


def test_build_writes_the_glossary_and_reports_a_difference(glossary, tmp_path):
    masters, lessons = glossary().parent, tmp_path / "lessons"
    lessons.mkdir()
    (masters / "01_blur.py").write_text("# %% [markdown]\n# # No title\n")  # pages do not depend on it
    (masters / "02_sharpen.py").write_text("# %% [markdown]\n# # No title\n")
    result = build(masters, lessons, tmp_path / "solved")
    assert result.built == [] and not any("glossary" in problem for problem in result.problems)
    assert (lessons / "glossary.md").read_text() == build_pages(masters)["glossary.md"]
    assert not any("glossary" in problem for problem in compare_lessons(masters, lessons).problems)
    glossary(GLOSSARY.replace("A border.", "A line."))
    difference = "glossary.md: differs from the master; run imgproc-course build"
    assert difference in compare_lessons(masters, lessons).problems
    glossary("[")
    assert any("not TOML" in problem for problem in compare_lessons(masters, lessons).problems)
    (masters / "glossary.toml").unlink()
    problems = build(masters, lessons, tmp_path / "solved").problems
    assert "glossary.md: it has no master; delete it, or restore its master" in problems
