"""An invalid exercise is not built."""

import itertools

import pytest
from nbclassroom.authoring.validation import validate_exercise
from nbclassroom.exercises import read_exercises, running
from nbclassroom.exercises.declaration import MasterError
from nbclassroom.exercises.lesson import PUBLIC_SEED

HIDDEN_INPUTS = "return [(rng.integers(0, 256, (5, 5), dtype=np.uint8),) for _ in range(3)]"
BRIGHT = "return (rng.integers(128, 256, (5, 5), dtype=np.uint8),)"  # whose doubles are all 255
SAME_TWO_CALLS = "return [(np.full((5, 5), level, np.uint8),) for level in (3, 7)]"
TWO_ANSWERS = "return [(np.full((5, n), 7, np.uint8),) for n in (3, 4, rng.integers(3, 5))]"
ONE_TYPE, FIVE_TYPES = (
    "astype(np.uint8)\n\n# %% role",
    "astype('HIqde'[pixels[0, 0] // 10 % 5])\n\n# %% role",
)


def problems_of(path):
    (exercise,) = read_exercises(path)
    return validate_exercise(exercise)


def test_a_valid_exercise_has_no_problem(write_master):
    assert problems_of(write_master()) == []


@pytest.mark.parametrize(
    ("replacements", "added", "message"),
    [
        ([("    return pixels * 2", "    return solution(pixels)")], "", "passes every public case"),
        (
            [],
            '\n# %% role="mistake" name="twin" says="x"\ndef double(pixels):\n    return pixels + pixels\n',
            "the mistake 'twin' is taken for 'uint8 wraps'",
        ),
        (
            [],
            '\n# %% role="case" title="No pixels" points=0\n'
            "def inputs(rng):\n    return (np.zeros((0, 3), np.uint8),)\n"
            '\n# %% role="mistake" name="empty" says="x"\n'
            "def double(pixels):\n    return solution(pixels) if pixels.size else None\n",
            "the mistake 'empty' earns all points",
        ),
        ([('    raise NotImplementedError("your turn")', "    return pixels")], "", "stub returns a value"),
        (
            [("    return np.minimum(", "    import cv2\n    return np.minimum(")],
            "",
            "the solution uses cv2; name it in allowed",
        ),
        (
            [("    return np.minimum(", "    return np.random.default_rng().random() + np.minimum(")],
            "",
            "is the solution random?",
        ),
        (
            [("(5, 5), dtype=np.uint8)", "(200, 200), dtype=np.uint8) * 0.5"), ("np.uint16", "float"),
             (".astype(np.uint8)\n\n# %% role=\"check\"", "\n\n# %% role=\"check\"")],
            "",
            "grading cannot compare an answer of 320000 bytes with a tolerance",
        ),
        ([(HIDDEN_INPUTS, "return (np.full((5, 5), 7, np.uint8),)")], "", "inputs(rng) ignores rng"),
        ([(HIDDEN_INPUTS, BRIGHT)], "", "a constant passes it with several seeds"),
        ([(HIDDEN_INPUTS, BRIGHT), (ONE_TYPE, FIVE_TYPES)], "", "a constant passes it with several seeds"),
        ([(HIDDEN_INPUTS, SAME_TWO_CALLS)], "", "inputs(rng) ignores rng"),
        ([(HIDDEN_INPUTS, TWO_ANSWERS)], "", "only counts its calls passes it with several seeds"),
    ],
)  # fmt: skip
def test_an_invalid_exercise_is_named(write_master, replacements, added, message):
    problems = problems_of(write_master(*replacements, add=added))
    assert any(message in problem for problem in problems), problems


def test_a_call_that_a_busy_machine_stops_is_named_by_the_time(write_master, monkeypatch):
    """Each call in turn is the one that is stopped; the masters differ, because results are cached."""

    def problems_if_late(late):
        exercise, calls = read_exercises(write_master(("Doubling", f"Doubling {late}")))[0], itertools.count()

        def call_within(function, _seconds):
            is_remark = function.__module__ != running.__name__  # which is left out, and not late
            if not is_remark and next(calls) == late:
                raise running.TimeUp
            return function()

        monkeypatch.setattr(running, "call_within", call_within)
        try:
            return validate_exercise(exercise), next(calls)
        except MasterError as error:
            return [str(error)], next(calls)

    problems, count = problems_if_late(-1)
    assert problems == [] and count > 40
    late = [problems for call in range(count) for problems in [problems_if_late(call)[0]] if problems]
    assert len(late) > 20 and all("did not finish" in problem for problems in late for problem in problems)


def test_a_mistake_costs_points_for_another_seed_too(write_master):
    """This mistake is wrong only where the first pixel is as in the public case of the lesson's seed."""
    (exercise,) = read_exercises(write_master())
    first_pixel = exercise.arguments(exercise.public[0])[0][0][0, 0]
    mistake = (
        '\n# %% role="mistake" name="once" says="x"\n'
        f"def double(pixels):\n    return None if pixels[0, 0] == {first_pixel} else solution(pixels)\n"
    )
    (problem,) = problems_of(write_master(add=mistake))
    assert "the mistake 'once' earns all points" in problem


def test_a_key_shuffles_the_calls_of_a_check_and_the_lesson_keeps_their_order(write_master):
    (exercise,) = read_exercises(write_master((HIDDEN_INPUTS, "return [(np.uint8([n]),) for n in range(9)]")))
    (case,) = exercise.hidden
    orders = [[int(call[0][0]) for call in exercise.arguments(case, seed)] for seed in (PUBLIC_SEED, 1, 2)]
    assert orders[0] == list(range(9))
    assert orders[1] != orders[2] and orders[0] not in orders[1:]
    assert all(sorted(order) == orders[0] for order in orders)
    assert exercise.arguments(case, 1) == exercise.arguments(case, 1)
