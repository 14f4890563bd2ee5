"""questions.toml beside the masters: the cells and texts of the lessons that ask, and its faults."""

import json

import pytest
from nbclassroom.authoring.lesson_files import lesson_files
from nbclassroom.authoring.masters import MasterError, read_master

TWO = """
[light]
section = "template#1"
asked = ["template"]
question = "How many `lux`?"
answer = 12
replies = {12 = "Yes, as in [[template]].", less = "More.", more = "Less."}

[which]
section = "template#1"
asked = ["template", "other"]
question = "Which one?"
answer = "b"
options = {a = "left", b = "right"}
replies = {a = "It is not left.", b = "It is right."}

[elsewhere]
section = "template#1"
asked = ["other"]
question = "Which one?"
answer = "a"
options = {a = "left"}
replies = {a = "It is left."}
"""
SECTION = "\n# %% [markdown]\n# ## 1 · The section ([[minutes]])\n"


def cells_of(path):
    return {cell.id: cell for cell in read_master(path).cells}


def test_a_lesson_opens_with_its_questions_and_no_other_cell_changes(write_master):
    path = write_master(add=SECTION)
    before = cells_of(path)
    path.with_name("questions.toml").write_text(TWO)
    after = cells_of(path)
    new = ["question-template-1", "ask-template-1", "question-template-2", "ask-template-2"]
    assert [id for id in after if id in before] == list(before) and [id for id in after if id in new] == new
    assert (
        list(after).index("question-template-1")
        == [cell.kind for cell in list(before.values())[1:]].index("markdown") + 1
    )
    assert all(after[id].source == cell.source for id, cell in before.items())
    assert after["question-template-1"].source.endswith("\n\n**1.** How many `lux`?")
    assert after["question-template-2"].source == "**2.** Which one?\n\n- **a** left\n- **b** right"
    assert after["ask-template-1"].source == (
        'from imgproc_course.exercises import ask\n\nask("template/light", None)  # your answer: a number'
    )
    assert after["ask-template-2"].source.endswith('None)  # your answer: "a" or "b"')
    assert not after["ask-template-1"].exercise and not after["ask-template-1"].deeper


def test_a_lesson_without_a_section_ends_with_its_questions(write_master):
    only_text = ("# %% [markdown]\n# **Your turn.**", "# %%\n1  #")
    path = write_master(only_text, ("# # Doubling\n", "# # Doubling\n# ## 1 · Double\n"))
    path.with_name("questions.toml").write_text(TWO)
    assert list(cells_of(path))[-1] == "ask-template-2"


def test_the_questions_count_in_the_minutes(write_master):
    path = write_master(add=SECTION)
    path.with_name("questions.toml").write_text(TWO.replace("Which one?", "Which one of these? " * 200))
    # 800 words and a few more at 70 a minute, two answers of 1.5 minutes, and the exercise below them
    heading = "## Two questions from earlier lessons (19 minutes)\n"
    assert heading in cells_of(path)["question-template-1"].source
    assert read_master(path).core_minutes == 20


def test_the_answers_are_in_the_texts_of_the_lesson(write_master):
    path = write_master(add=SECTION)
    path.with_name("questions.toml").write_text(TWO)
    texts = json.loads(lesson_files(read_master(path))["texts/template.json"])
    assert texts["light"] == {
        "answer": 12,
        "replies": {"12": "Yes, as in lesson 90.", "less": "More.", "more": "Less."},
        "again": "Read section 1 of lesson 90 again.",
    }
    assert list(texts) == ["light", "which"]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[light]", "[light", r"questions.toml: it is not TOML: "),
        ('question = "How many `lux`?"\n', "", r'questions.toml: \["light"\] has no question; add it'),
        ('less = "More.", ', "", r'\["light"\] has no less; add it'),
        ('12 = "Yes', '13 = "Yes', r'\["light"\] has no 12; add it'),
        (', b = "It is right."', "", r'\["which"\] has no b; add it'),
        ('section = "template#1"', 'section = "temple#1"', r"\[\[temple#1\]\] names no lesson"),
    ],
)
def test_a_fault_of_the_file_is_named(write_master, old, new, message):
    assert old in TWO
    path = write_master(add=SECTION)
    path.with_name("questions.toml").write_text(TWO.replace(old, new, 1))
    with pytest.raises(MasterError, match=message):
        read_master(path)
