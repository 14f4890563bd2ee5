"""The two ament_python packages: built by PyPI's colcon, found in the index, and their launch files.

Not tested here, because the commands are missing: `ros2 run` and `ros2 launch` themselves (the other files of
this folder test the executables that they run), and rosdep.
"""

import ast
import re
import sys
import types

import pytest

pytestmark = pytest.mark.ros

# Keys of rosdistro's python.yaml, and packages of ROS 2 Jazzy, both of which rosdep resolves.
ROSDEP_KEYS = {"python3-numpy", "python3-opencv"}
ROS_PACKAGES = {"rclpy", "ros2launch", "sensor_msgs"}
NO_KEY = {"imgproc_course"}


def for_both_packages(function):
    return pytest.mark.parametrize("name", ["image_edge_detection", "image_gray_processor"])(function)


@for_both_packages
def test_colcon_builds_it_and_the_index_finds_it(workspace, name):
    assert f"Finished <<< {name}" in workspace.output
    assert workspace.prefix[name] == workspace.root / "install" / name
    marker = workspace.prefix[name] / "share/ament_index/resource_index/packages" / name
    assert marker.read_bytes() == b""
    installed = {
        path.relative_to(workspace.share[name]).as_posix() for path in workspace.share[name].rglob("*")
    }
    assert {"package.xml", f"launch/{name}.launch.py"} <= installed


@for_both_packages
def test_the_executable_uses_the_python_that_built_it(workspace, name):
    scripts = [path.name for path in (workspace.prefix[name] / "lib" / name).iterdir()]
    assert scripts == [name]
    script = workspace.prefix[name] / "lib" / name / name
    assert script.read_text().splitlines()[0] == f"#!{sys.executable}"
    assert script.stat().st_mode & 0o111


@for_both_packages
def test_package_xml_names_all_dependencies_and_only_keys_that_rosdep_knows(tools, name):
    from catkin_pkg.package import parse_package

    warnings = []
    package = parse_package(tools.sources / name, warnings=warnings)
    assert warnings == []
    assert (package.package_format, package.name, package.version) == (3, name, "0.1.0")
    assert [str(export) for export in package.exports] == ["<build_type>ament_python</build_type>"]
    assert (package.licenses[0], package.get_build_type()) == ("Apache-2.0", "ament_python")
    assert {dependency.name for dependency in package.exec_depends} == ROSDEP_KEYS | ROS_PACKAGES
    text = (tools.sources / name / "package.xml").read_text()
    assert re.search(r"<!--.*imgproc_course has no such name.*-->", text, re.S)


@for_both_packages
def test_every_import_of_the_node_is_declared(tools, name):
    keys = {"cv2": "python3-opencv"}
    declared = (tools.sources / name / "package.xml").read_text()
    for module in (tools.sources / name / name).glob("*.py"):
        for node in ast.walk(ast.parse(module.read_text())):
            names = [a.name for a in node.names] if isinstance(node, ast.Import) else []
            names += [node.module] if isinstance(node, ast.ImportFrom) else []
            for root in {imported.partition(".")[0] for imported in names} - NO_KEY:
                assert f"<exec_depend>{keys.get(root, root)}</exec_depend>" in declared


class Recorded:
    """Replaces a class of `launch` and keeps its arguments."""

    def __init__(self, *arguments, **options):
        self.kind, self.arguments, self.options = type(self).__name__, arguments, options


@pytest.fixture
def launch_stubs(monkeypatch):
    """`launch` has no wheel: stubs with its six names, which only keep their arguments."""
    modules = {
        "launch": ["LaunchDescription"],
        "launch.actions": ["DeclareLaunchArgument"],
        "launch.substitutions": ["LaunchConfiguration"],
        "launch_ros": [],
        "launch_ros.actions": ["Node"],
        "launch_ros.parameter_descriptions": ["ParameterValue"],
    }
    for name, classes in modules.items():
        module = types.ModuleType(name)
        for class_name in classes:
            setattr(module, class_name, type(class_name, (Recorded,), {}))
        monkeypatch.setitem(sys.modules, name, module)


DECLARED = {
    "image_edge_detection": {"low": 50, "high": 150},
    "image_gray_processor": {},  # none
}


@for_both_packages
def test_the_launch_file_starts_the_executable_with_the_parameters_that_the_node_declares(
    workspace, launch_stubs, tools, name
):
    namespace = {}
    exec((workspace.share[name] / f"launch/{name}.launch.py").read_text(encoding="utf-8"), namespace)
    *arguments, node = namespace["generate_launch_description"]().arguments[0]
    assert (node.options["package"], node.options["executable"]) == (name, name)
    assert (workspace.prefix[name] / "lib" / node.options["package"] / node.options["executable"]).is_file()
    [(source, target)] = node.options["remappings"]
    assert (source, target.arguments) == (tools.topic, ("topic",))
    defaults = {argument.arguments[0]: argument.options["default_value"] for argument in arguments}
    assert defaults.pop("topic") == tools.topic
    [parameters] = node.options.get("parameters", [{}])
    assert {
        key: (value.arguments[0].arguments, value.options["value_type"]) for key, value in parameters.items()
    } == {key: ((key,), type(value)) for key, value in DECLARED[name].items()}
    assert {key: ast.literal_eval(value.capitalize()) for key, value in defaults.items()} == DECLARED[name]
