"""Exercises as masters declare them."""

import numpy as np
import pytest
from nbclassroom.exercises.declaration import (
    MasterError,
    exercise,
    read_exercises,
)
from nbclassroom.exercises.lesson import PUBLIC_SEED


def test_a_whole_exercise_is_read(write_master):
    (exercise_read,) = read_exercises(write_master())
    assert (exercise_read.id, exercise_read.function, exercise_read.time_limit) == (
        "test-double",
        "double",
        0.5,
    )
    assert (exercise_read.title, exercise_read.allowed, exercise_read.practice) == (
        "test-double",
        (),
        False,
    )
    assert [case.id for case in exercise_read.cases] == [
        "case-test-double-1",
        "case-test-double-2",
        "hidden-test-double-1",
    ]
    assert [case.points for case in exercise_read.cases] == [2, 1, 3]
    assert exercise_read.points == 6
    assert [case.hint for case in exercise_read.public] == ["Widen.", "Start small."]
    assert [mistake.says for mistake in exercise_read.mistakes] == ["It wraps.", "One too many."]
    assert exercise_read.given == ("LIMIT = 255",)


def test_the_solution_gets_numpy_and_the_given_names_only(write_master):
    (exercise_read,) = read_exercises(write_master())
    double = exercise_read.function_of(exercise_read.solution, "solution")
    np.testing.assert_array_equal(double(np.uint8([3, 200])), np.uint8([6, 255]))
    assert "SIDE" not in double.__globals__ and "exercise" not in double.__globals__


def test_mistakes_may_call_the_solution(write_master):
    (exercise_read,) = read_exercises(write_master())
    wrong = exercise_read.function_of(exercise_read.mistakes[1].source, "mistake", prepared=True)
    np.testing.assert_array_equal(wrong(np.uint8([3])), np.uint8([7]))


def test_inputs_depend_on_the_seed_alone(write_master):
    (exercise_read,) = read_exercises(write_master())
    case = exercise_read.public[0]
    ((first,),) = exercise_read.arguments(case)
    ((again,),) = exercise_read.arguments(case, PUBLIC_SEED)
    ((other,),) = exercise_read.arguments(case, 1)
    np.testing.assert_array_equal(first, again)
    assert first.shape == (3, 4) and not np.array_equal(first, other)
    assert len(exercise_read.arguments(exercise_read.public[1])) == 2
    (moved,) = read_exercises(write_master("81_moved", title="# %% [markdown]\n# # Doubling\n# More words."))
    np.testing.assert_array_equal(moved.arguments(moved.public[0])[0][0], first)


def test_a_changed_master_is_read_again(write_master):
    read_exercises(write_master())
    path = write_master(answer='# %% role="answer"\ndef double(pixels): ...')
    assert read_exercises(path)[0].stub == "def double(pixels): ..."


BESIDE = """# %% [markdown]
# # test-double

# %% [markdown]
# Words about them.

# %%
ONE = np.uint8(1)

# %% role="mistake" name="one less" says="One too few."
def double(pixels):
    return solution(pixels) - ONE
"""


def test_known_mistakes_stand_in_the_master_or_beside_it(write_master):
    path = write_master()
    assert len(read_exercises(path)[0].mistakes) == 2
    path.with_suffix(".mistakes.py").write_text(BESIDE)
    (exercise_read,) = read_exercises(path)
    assert [mistake.name for mistake in exercise_read.mistakes] == ["wraps", "off by one", "one less"]
    wrong = exercise_read.function_of(exercise_read.mistakes[2].source, "mistake", prepared=True)
    np.testing.assert_array_equal(wrong(np.uint8([3])), np.uint8([5]))
    path.with_suffix(".mistakes.py").write_text(BESIDE.replace("one less", "one too few"))
    assert read_exercises(path)[0].mistakes[2].name == "one too few"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("test-double", "test-triple", "no exercise 'test-triple' in 80_doubling.py; a heading names one of"),
        ("# # test-double", "# Words.", "code before any heading; write its exercise above"),
        ("mistake", "case", 'line 10: only role="mistake" cells of the exercise in the heading'),
        ('"mistake"', '"mistake" exercise="test-triple"', "line 10: only"),
        (' says="One too few."', "", 'line 10: a mistake cell needs says="..." in its header'),
    ],
)
def test_a_fault_in_the_file_of_known_mistakes_is_named(write_master, old, new, message):
    path = write_master()
    path.with_suffix(".mistakes.py").write_text(BESIDE.replace(old, new))
    with pytest.raises(MasterError) as error:
        read_exercises(path)
    assert str(error.value).startswith("80_doubling.mistakes.py") and message in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"solution": ""}, 'needs one role="solution" cell, found 0'),
        ({"case": '# %% role="case"\ndef inputs(rng): ...'}, 'a case cell needs title="..."'),
        ({"mistake": '# %% role="mistake" name="x"\ndef double(pixels): ...'}, 'needs says="..."'),
        ({"given": '# %% role="given"\nLIMIT = 255'}, "a given cell before any exercise"),
        (
            {"given": '# %% role="given" exercise="test-triple"\n...'},
            "exercise='test-triple' is not declared",
        ),
        (
            {"exercise": '# %% role="exercise"\nexercise("test-double")'},
            "function='', expected the name of a function",
        ),
        ({"exercise": '# %% role="exercise"\nexercise(NAME, function="f")'}, "literals only"),
        ({"exercise": '# %% role="exercise"\nSIDE = 3'}, "expected one call of exercise(...), found 0"),
        ({"case": '# %% role="case" title="x" points=0.5\n...'}, "points=0.5, expected a whole number >= 0"),
    ],
)
def test_a_broken_declaration_is_named_with_its_place(write_master, changed, message):
    with pytest.raises(MasterError) as error:
        read_exercises(write_master(**changed))
    assert message in str(error.value)
    assert "80_doubling.py" in str(error.value)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        (
            {"case": '# %% role="case" title="x"\ndef inputs(rng): return rng'},
            "must return a tuple of arguments",
        ),
        ({"case": '# %% role="case" title="x"\ndef inputs(rng): return (sides,)'}, "NameError"),
        ({"case": '# %% role="case" title="x"\ninput = 3'}, "does not define inputs(rng)"),
        (
            {"exercise": '# %% role="exercise"\nexercise("test-double", function="double")\nx = y'},
            "NameError",
        ),
    ],
)
def test_a_broken_case_is_named_with_its_place(write_master, changed, message):
    (exercise_read,) = read_exercises(write_master(**changed))
    with pytest.raises(MasterError) as error:
        exercise_read.arguments(exercise_read.public[0])
    assert message in str(error.value)
    assert "80_doubling.py" in str(error.value)


def test_arguments_of_a_declaration_are_checked():
    for arguments in (
        {"id": "Grayscale Luma", "function": "f"},
        {"id": "a-b", "function": "f()"},
        {"id": "a-b", "function": "f", "time_limit": 0},
        {"id": "a-b", "function": "f", "tolerance": -1},
        {"id": "a-b", "function": "f", "allowed": "cv2"},
    ):
        with pytest.raises(MasterError):
            exercise(**arguments)
