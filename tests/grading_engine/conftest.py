"""A key of a small lesson that is there to be attacked, made once a session."""

from pathlib import Path

import pytest

from imgproc_course.grading.judge import judge
from imgproc_course.grading.kernel.sandbox import Limits
from imgproc_course.grading.key import make_key

MASTERS = Path(__file__).parent / "masters"
SEED = 8_675_309
# Short, so that what never ends is soon ended; long enough for two kernels on a busy machine.
SHORT = Limits(grace=0.5, wall_factor=4, wall_grace=2.0, memory=1 << 30, output=2 << 20)


@pytest.fixture(scope="session")
def masters():
    return MASTERS


@pytest.fixture(scope="session")
def key(tmp_path_factory):
    return make_key(MASTERS, SEED, tmp_path_factory.mktemp("key") / "key")


@pytest.fixture(scope="session")
def right():
    """The right answers of the attacked lesson."""
    return {
        "attacked-double": "def double(pixels):\n"
        "    return np.minimum(pixels.astype(int) * 2, LIMIT).astype(np.uint8)",
        "attacked-mean": "def mean(values):\n    return sum(values) / len(values)",
    }


@pytest.fixture
def grade(key, right):
    """Grade one answer to `double` (the other exercise answered rightly); gives its exercise's result."""

    def graded(source, *, exercise="attacked-double", **options):
        answers = right | {exercise: source}
        options = {"workers": 1, "limits": SHORT} | options
        (result,) = judge([("one", "10_attacked", answers)], key, **options)
        return next(each for each in result["exercises"] if each["id"] == exercise)

    return graded
