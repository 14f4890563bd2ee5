"""Written answers without a teacher: what their learner compares and ticks; and what a declaration needs."""

import json

import pytest
from nbclassroom.authoring.build import read_valid_master
from nbclassroom.authoring.masters import read_master
from nbclassroom.exercises import check, overview, progress, solution
from nbclassroom.exercises.declaration import MasterError, exercise
from nbclassroom.exercises.kinds.written import self_assessment
from nbclassroom.exercises.progress import progress_of
from template_master import write_carried_files

MASTER = """# ---
# jupyter:
#   imgproc_course:
#     title: Words
# ---

# %% [markdown]
# # Words
# A lesson with one written answer.

# %%
from imgproc_course.exercises import check

# %% role="exercise"
exercise("words-noise", subject="written", points=2, rubric=(("names it", 2), ("blurs", -1)))

# %% [markdown] role="answer"
# *Your answer:*

# %% [markdown] role="solution"
# It is salt and pepper.

# %% role="check"
check("words-noise")
"""


@pytest.fixture
def learner(tmp_path, monkeypatch):
    """A learner's folder with the lesson, in a process that looks like a kernel's; saves an answer."""
    path = tmp_path / "masters" / "22_words.py"
    path.parent.mkdir()
    path.write_text(MASTER)
    write_carried_files(read_master(path), tmp_path)
    (tmp_path / ".course.json").write_text("{}")
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("NBCLASSROOM_CHECKS", raising=False)
    monkeypatch.setenv("JPY_SESSION_NAME", str(tmp_path / "22_words.ipynb"))
    monkeypatch.setattr(progress, "_of_this_process", {})
    for module in (progress, self_assessment):
        monkeypatch.setattr(module, "TEST_VARIABLE", "NOT_SET_BY_PYTEST")

    def save(text):
        cell = {"id": "answer-words-noise", "cell_type": "markdown", "metadata": {}, "source": text}
        about = {"lesson": "words", "title": "Words", "minutes": 9}
        first = {"cell_type": "markdown", "metadata": {}, "source": "# Words"}
        notebook = {"cells": [first, cell], "metadata": {"imgproc_course": about}}
        (tmp_path / "22_words.ipynb").write_text(json.dumps(notebook))

    return save


@pytest.mark.parametrize("text", ["*Your answer:*", "", "  \n"])
def test_nobody_sees_the_answer_before_writing_one(learner, text):
    learner(text)
    for shown in (check("words-noise"), solution("words-noise")):
        assert "the saved notebook has no answer yet" in repr(shown) and "salt" not in repr(shown)
    assert progress_of("words-noise").ticks is None


def test_a_learner_compares_and_the_ticks_are_kept_and_counted_apart(learner, tmp_path, monkeypatch):
    learner("Gaussian?")
    assert "0 of 0 exercises passed, 0 of 1 written answers compared" in repr(overview(tmp_path))
    shown = check("words-noise")
    lines = repr(shown).splitlines()
    assert "It is salt and pepper." in lines and lines[-2:] == ["☐ names it", "☐ blurs (a mistake)"]
    boxes = shown.boxes().children
    boxes[0].value = boxes[1].value = True
    boxes[1].value = False
    monkeypatch.setattr(progress, "_of_this_process", {})
    assert progress_of("words-noise").ticks == (1,)
    assert [box.value for box in check("words-noise").boxes().children] == [True, False]
    assert "0 of 0 exercises passed, 1 of 1 written answers compared" in repr(overview(tmp_path))


def test_what_a_learner_gets_has_the_rubric_only_with_the_solutions(learner, tmp_path):
    assert "names it" not in (tmp_path / "checks/words.json").read_text()
    learner("Gaussian?")
    (tmp_path / "solutions/words.json").unlink()
    assert "has not released" in repr(check("words-noise"))


RUBRIC = (("names it", 2), ("blurs", -1))


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"function": "noise"}, "function='noise', expected none"),
        ({"points": 0}, "points=0, expected a whole number > 0"),
        ({"points": 3}, "its rubric gives at most 2 points, expected 3"),
        ({"rubric": ()}, r"rubric=\(\), expected"),
        ({"rubric": (("", 2),)}, "expected .*what to look for"),
        ({"rubric": ("names it", 2)}, "expected .*what to look for"),
        (
            {"subject": "function", "function": "f"},
            "points and rubric are declared for subject='written' only",
        ),
    ],
)
def test_a_wrong_declaration_is_named(changes, text):
    declared = {"subject": "written", "points": 2, "rubric": RUBRIC} | changes
    with pytest.raises(MasterError, match=text):
        exercise("words-noise", **declared)


@pytest.mark.parametrize(
    ("old", "new", "text"),
    [
        ("# It is salt and pepper.", "#", "needs a model answer"),
        (
            'subject="written", points=2, rubric=(("names it", 2), ("blurs", -1))',
            'function="f"',
            "a code cell",
        ),
        ('[markdown] role="answer"', '[markdown] role="given"', "a role needs a code cell"),
        (
            '# %% role="check"',
            '# %% role="mistake" name="x" says="X."\nx = 1\n\n# %% role="check"',
            "no check sees",
        ),
    ],
)
def test_a_master_with_a_mistake_is_refused(tmp_path, old, new, text):
    path = tmp_path / "22_words.py"
    path.write_text(MASTER.replace(old, new))
    with pytest.raises(MasterError, match=text):
        read_valid_master(path)
