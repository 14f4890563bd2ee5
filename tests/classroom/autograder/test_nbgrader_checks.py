"""The benchmark against nbgrader gives both the same work: its tests accept what our comparison accepts."""

import sys
from pathlib import Path

import numpy as np
import pytest

from imgproc_course.classroom.exercises.canonical import canonical
from imgproc_course.classroom.exercises.comparison import compare

ARRAY = np.int32([[1, 2], [3, 4]])
PAIRS = [
    (ARRAY, ARRAY),
    (ARRAY, ARRAY + 1),
    (ARRAY, ARRAY[0]),
    (ARRAY, ARRAY.astype(np.float64)),
    (ARRAY, ARRAY.tolist()),
    (ARRAY > 2, ARRAY > 2),
    (ARRAY > 2, (ARRAY > 2).astype(np.uint8)),
    (np.array([0.1, 0.2]), np.float32([0.1, 0.2])),
    (np.array([0.1, 0.2]), np.array([0.1, 0.2 + 1e-6])),
    ((ARRAY, ARRAY), (ARRAY, ARRAY)),
    ((ARRAY, ARRAY), [ARRAY, ARRAY.astype(np.uint8)]),
    ((ARRAY, ARRAY), np.stack([ARRAY, ARRAY])),
    ((ARRAY, ARRAY), (ARRAY,)),
    ((1, 2), [1, 2]),
    ((1, 2), np.array([1, 2])),
    ([(1, 2), (3, 4)], ARRAY),
    (44.5, np.array([44.5])),
    (44.5, np.array([44.5, 44.5])),
    (44.5, [44.5]),
    (True, 1),
]


@pytest.fixture(scope="module")
def same():
    sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))
    import bench_grading

    namespace = {"np": np}
    exec(bench_grading._SAME, namespace)
    return namespace["_same"]


@pytest.mark.parametrize(("expected", "actual"), PAIRS)
@pytest.mark.parametrize("exact_type", [False, True])
def test_the_tests_for_nbgrader_accept_what_our_comparison_accepts(same, expected, actual, exact_type):
    accepted = compare(canonical(expected), canonical(actual), exact_type=exact_type) is None
    try:
        same(actual, expected, 0.0, exact_type)
    except (AssertionError, ValueError):
        assert not accepted
    else:
        assert accepted
