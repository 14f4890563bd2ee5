"""An exercise that would grade unjustly is not built."""

import pytest

from imgproc_course.authoring.validation import prove
from imgproc_course.exercises import read_exercises


def complaints(path):
    (declared,) = read_exercises(path)
    return prove(declared)


def test_a_just_exercise_has_no_complaint(write_master):
    assert complaints(write_master()) == []


@pytest.mark.parametrize(
    ("replacements", "added", "said"),
    [
        ([("    return pixels * 2", "    return solution(pixels)")], "", "passes every public case"),
        (
            [],
            '\n# %% role="mistake" name="twin" says="x"\ndef double(pixels):\n    return pixels + pixels\n',
            "the mistake 'twin' is taken for 'uint8 wraps'",
        ),
        ([('    raise NotImplementedError("your turn")', "    return pixels")], "", "the stub answers"),
        (
            [("    return np.minimum(", "    import cv2\n    return np.minimum(")],
            "",
            "the solution uses cv2, which the exercise refuses",
        ),
        (
            [("    return np.minimum(", "    return np.random.default_rng().random() + np.minimum(")],
            "",
            "does it draw by chance?",
        ),
        (
            [("(5, 5), dtype=np.uint8)", "(200, 200), dtype=np.uint8) * 0.5"), ("np.uint16", "float"),
             (".astype(np.uint8)\n\n# %% role=\"check\"", "\n\n# %% role=\"check\"")],
            "",
            "an answer of 320000 bytes cannot be compared with a tolerance",
        ),
    ],
)  # fmt: skip
def test_an_unjust_exercise_is_named(write_master, replacements, added, said):
    found = complaints(write_master(*replacements, add=added))
    assert any(said in complaint for complaint in found), found
