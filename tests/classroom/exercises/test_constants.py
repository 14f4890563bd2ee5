"""What needs no thought gains no point: constants, the input, empty images, other exercises' answers."""

from functools import cache

import numpy as np
import pytest
from all_masters import PATHS, all_exercises, all_masters
from nbclassroom.exercises import running
from nbclassroom.exercises.canonical import canonical
from nbclassroom.exercises.comparison import compare

SEEDS = (11, 12, 13)  # of keys
CONSTANTS = [
    *(None, True, False, 0, 1, -1, 2, 255, 0.0, 1.0, -1.0, 0.5, 100.0, float("nan"), float("inf")),
    *(-float("inf"), "", "grayscale", (), [], {}, b"", np.uint8(0), np.zeros(0), (0, 0), (None, None)),
]
FUNCTIONS = {
    "the first input": lambda *inputs: inputs[0],
    "the last input": lambda *inputs: inputs[-1],
    "all inputs": lambda *inputs: inputs,
    "a mean": lambda *inputs: float(np.mean(inputs[0])),
    "a size": lambda *inputs: inputs[0].size,
    "a shape": lambda *inputs: inputs[0].shape,
    **{
        f"{name} of {dtype}, {shape}": lambda *inputs, fill=fill, dtype=dtype, cut=cut: fill(
            np.shape(inputs[0])[:cut], dtype
        )
        for name, fill in (
            ("zeros", np.zeros),
            ("ones", np.ones),
            ("255", lambda *a: np.ones(*a) * a[1](255)),
        )
        for dtype in (np.uint8, np.float64, np.bool_)
        for shape, cut in (("shaped like the input", None), ("of its pixels", 2))
    },
}


def is_graded(exercise):
    """Not those that drive: no value can stand for a node, and what its texts say is in the task."""
    return not exercise.practice and exercise.subject == "function"


@cache
def solutions():
    graded = filter(is_graded, all_exercises().values())
    return {exercise.id: exercise.function_of(exercise.solution, "solution") for exercise in graded}


@pytest.fixture(scope="module", params=PATHS, ids=lambda path: path.stem)
def drawn(request):
    """(exercise, case with points, for each seed the list of (arguments, canonical form of the answer))."""
    (master,) = (master for master in all_masters().values() if master.path == request.param)
    return [
        (exercise, case, [draw(exercise, case, seed) for seed in SEEDS])
        for exercise in filter(is_graded, master.exercises)
        for case in exercise.cases
        if case.points
    ]


def draw(exercise, case, seed):
    solution = solutions()[exercise.id]
    return [(call, canonical(solution(*call))) for call in exercise.arguments(case, seed)]


def agree(exercise, case, expected, value):
    """Whether grading takes a value for the expected one; in most exercises the type need not be exact."""
    return compare(expected, value, case.tolerance, exact_type=exercise.exact_type) is None


def passes(function, calls, exercise, case):
    for arguments, expected in calls:
        result = running.call(function, arguments, [str(k) for k in range(len(arguments))], 5)
        if not result.finished or not agree(exercise, case, expected, result.value):
            return False
    return True


def test_inputs_depend_on_the_seed(drawn):
    for _, case, draws in drawn:
        texts = {
            repr(sorted(repr([canonical(value) for value in call]) for call, _ in calls)) for calls in draws
        }
        assert len(texts) > 1, case.id


def test_no_constant_gains_a_point(drawn):
    for exercise, case, draws in drawn:
        answers = [answer for calls in draws for _, answer in calls]
        for constant in [*map(canonical, CONSTANTS), *answers]:
            passed = [
                all(agree(exercise, case, expected, constant) for _, expected in calls) for calls in draws
            ]
            # An answer of one seed passes with that one only; what one can think of passes with none.
            is_answer = any(constant is answer for answer in answers)
            assert sum(passed) <= (1 if is_answer else 0), (case.id, constant)


def test_no_answer_without_thought_gains_a_point(drawn):
    for exercise, case, draws in drawn:
        others = {id: function for id, function in solutions().items() if id != exercise.id}
        for name, function in (FUNCTIONS | others).items():
            assert not any(passes(function, calls, exercise, case) for calls in draws), (case.id, name)
