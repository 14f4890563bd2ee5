"""The files of a package that a learner writes as texts: what each wrong file is told."""

from pathlib import Path

import pytest
from nbclassroom.exercises import read_exercises
from nbclassroom.exercises.checking import run_cases

MASTER = Path(__file__).parents[3] / "notebooks" / "masters" / "10_ros2_packages.py"
EXERCISE = next(exercise for exercise in read_exercises(MASTER) if exercise.id == "packages-own")


def checked(*changes):
    """The CheckResult of the solution with some texts replaced."""
    source = EXERCISE.solution
    for old, new in changes:
        assert old in source
        source = source.replace(old, new)
    return run_cases(EXERCISE, EXERCISE.function_of(source, "answer"))


def test_the_solution_passes_and_so_do_other_styles():
    assert checked().passed
    assert checked(
        ('name="image_negative"', "name=NAME"), ("\nsetup(", '\nNAME = "image_negative"\nsetup(')
    ).passed
    assert checked(
        ('["image_negative"]', "find_packages()"), ("import setup", "import find_packages, setup")
    ).passed
    assert checked(
        ('"share/image_negative"', 'f"share/{NAME}"'), ("\nsetup(", '\nNAME = "image_negative"\nsetup(')
    ).passed
    assert checked(
        ('"resource/image_negative"', '"resource/" + NAME'), ("\nsetup(", '\nNAME = "image_negative"\nsetup(')
    ).passed
    assert checked(
        ('"share/image_negative"', 'os.path.join("share", "image_negative")'),
        ("import setup", "import setup; import os"),
    ).passed
    assert checked(("<exec_depend>rclpy</exec_depend>", "<depend>rclpy</depend>")).passed
    assert checked(("255 - gray", "cv2.bitwise_not(gray)")).passed


@pytest.mark.parametrize(
    ("step", "old", "new", "sentence"),
    [
        (1, "<name>image_negative", "<name>negative", "is called 'negative'. The task asks for 'image_"),
        (1, "python3-opencv", "opencv-python", "opencv-python is a name of pip. package.xml has rosdep keys"),
        (1, "  <exec_depend>sensor_msgs</exec_depend>\n", "", "package.xml does not name: sensor_msgs."),
        (1, "ament_python", "ament_cmake", "<build_type>ament_python</build_type>"),
        (1, "<license>Apache-2.0</license>", "", "text in each of these elements: license."),
        (1, "</export>", "", "package.xml is not XML: mismatched tag"),
        (1, '"package.xml": PACKAGE_XML', '"pakage.xml": PACKAGE_XML', "There is no package.xml. The paths"),
        (
            1,
            "rclpy</exec_depend>\n  <exec_depend>sensor_msgs",
            "rclpy, sensor_msgs",
            "does not name: rclpy sensor_msgs. Write <exec_depend>",
        ),
        (2, "image_negative.image_negative:main", "image_negative:main", "=image_negative:main. Write"),
        (2, "image_negative = image", "negative = image", "executables: negative=image"),
        (2, "_negative:main", "_negative:start", "image_negative:start. Write NAME = MODULE:FUNCTION"),
        (2, '"share/image_negative"', '"share/gray"', "installs package.xml to share/gray, "),
        (2, '["package.xml"]', '["package.xml", "setup.py"]', "setup.py to share/image_negative."),
        (3, "255 - gray", "255 - frame", "encoding 'mono8' needs an array of uint8, (H, W)"),
        (3, "Policy.VOLATILE", "Policy.TRANSIENT_LOCAL", "subscription is TRANSIENT_LOCAL."),
        (2, 'image_negative:main"', 'main"', "executables: image_negative=image_negative.main."),
        (2, 'packages=["image_negative"]', "packages=[]", "must name the folder of the node"),
        (2, '"image_negative/image_neg', '"image_neg', "file image_negative/image_negative.py, and none"),
        (2, '["resource/image_negative"]', "[]", "Yours installs package.xml to share/image_negative."),
        (2, "def main(args=None)", "def start(args=None)", "defines no function main"),
        (2, "setup(\n", "setup(\n    (", "setup.py, line"),
        (3, "255 - gray", "gray", "pixels of the published image are wrong."),
        (3, "BEST_EFFORT", "RELIABLE", "The sensor offers best effort"),
        (3, "except CvBridgeError", "except KeyError", "A message that cannot be"),
        (3, "import cv2\n", "import cv2\nimport scipy\n", "imports scipy, which this exercise does not need"),
        (3, "def main(args", "rclpy.spin(None)\n\n\ndef main(args", "rclpy.spin(None) runs when the file is"),
        (3, "node = ImageNegative", "node = Negative", "reads Negative, and nothing in this file has that"),
        (3, "~/negative", "~/gray", "You publish on /image_negative/gray."),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said_in_a_sentence(step, old, new, sentence):
    result = checked((old, new))
    assert [case.passed for case in result.results].index(False) == step - 1
    assert sentence in str(result)
