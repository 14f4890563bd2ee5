"""Without ROS, or with a broken one: the package imports, and calls that need a graph say what to install."""

import pytest

NO_RCLPY = "import sys; sys.modules['rclpy'] = None\n"
REMEDIES = ["environment/setup", "environment/pixi.toml", "Dockerfile", "WSL", "open_recording('drive')"]
CALLS = [
    "open_camera()",
    "Robot()",
    "record()",
    "ImageSubscriber('/image')",
    "RosSession()",
    "RosSession.current()",
]


def test_calls_that_need_a_graph_say_what_to_install(run_python):
    code, out, err = run_python(
        NO_RCLPY + "from imgproc_course.ros import *\n"
        "from imgproc_course.ros import RosMissingError\n"
        "assert not ros_available()\n"
        f"for call in {CALLS}:\n"
        "    try: eval(call)\n"
        "    except RosMissingError as error: print(error)"
    )
    assert (code, err) == (0, "")
    assert len(out.splitlines()) == len(CALLS)
    for remedy in REMEDIES:
        assert all(remedy in line for line in out.splitlines())


@pytest.mark.ros
def test_a_message_package_that_is_missing_is_named(run_python):
    code, out, err = run_python(
        "import sys; sys.modules['visualization_msgs'] = None\n"
        "from imgproc_course.ros import ros_available, ros_problem; print(ros_available(), ros_problem())"
    )
    assert (code, err) == (0, "")
    assert out.startswith("False ROS 2 is missing (visualization_msgs")
    assert "environment/pixi.toml" in out


def test_an_rclpy_of_another_python_is_distinguished_from_a_missing_one(run_python, tmp_path):
    (tmp_path / "rclpy").mkdir()
    (tmp_path / "rclpy" / "__init__.py").write_text("import rclpy._rclpy_pybind11")
    code, out, err = run_python(
        "from imgproc_course.ros import ros_available, ros_problem; print(ros_available(), ros_problem())",
        PYTHONPATH=str(tmp_path),
    )
    assert (code, err) == (0, "")
    assert out.startswith("False ROS 2 is installed, but Python 3.")
    assert "No module named 'rclpy._rclpy_pybind11'" in out and "environment/lab" in out


@pytest.mark.ros
def test_a_middleware_that_is_not_installed_does_not_end_the_kernel(run_python):
    code, out, err = run_python(
        "from imgproc_course.ros import ros_available, ros_problem; print(ros_available(), ros_problem())",
        RMW_IMPLEMENTATION="rmw_none_such_cpp",
    )
    assert (code, err) == (0, "")
    assert out.startswith("False RMW_IMPLEMENTATION=rmw_none_such_cpp is set, but that middleware is not")
