"""Without ROS, or with a broken one: the package imports, and calls that need a graph say what to install."""

import pytest

NO_RCLPY = "import sys; sys.modules['rclpy'] = None\n"
CALLS = [
    "open_camera()",
    "Robot()",
    "record()",
    "ImageSubscriber('/image')",
    "RosSession()",
    "RosSession.current()",
]


@pytest.mark.parametrize("call", CALLS)
def test_calls_that_need_a_graph_say_what_to_install(run_python, call):
    code, out, err = run_python(
        NO_RCLPY + "from imgproc_course.ros import *\n"
        "from imgproc_course.ros import RosMissingError\n"
        "assert not ros_available()\n"
        f"try: {call}\n"
        "except RosMissingError as error: print(error)"
    )
    assert (code, err) == (0, "")
    assert out.count("\n") == 1
    for remedy in (
        "environment/setup",
        "environment/pixi.toml",
        "Dockerfile",
        "WSL",
        "open_recording('drive')",
    ):
        assert remedy in out


@pytest.mark.ros
@pytest.mark.parametrize("package", ["geometry_msgs", "nav_msgs", "std_srvs", "visualization_msgs"])
def test_each_message_package_that_is_missing_is_named(run_python, package):
    code, out, err = run_python(
        f"import sys; sys.modules['{package}'] = None\n"
        "from imgproc_course.ros import ros_available, ros_problem; print(ros_available(), ros_problem())"
    )
    assert (code, err) == (0, "")
    assert out.startswith(f"False ROS 2 is missing ({package}")
    assert "environment/pixi.toml" in out


def test_the_error_is_an_import_error():
    from imgproc_course.ros import RosMissingError

    assert issubclass(RosMissingError, ImportError)


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


@pytest.mark.ros
def test_ros_is_available_if_it_is_installed(run_python):
    code, out, err = run_python("import imgproc_course.ros as r; print(r.ros_available(), r.ros_problem())")
    assert (code, out, err) == (0, "True None\n", "")
