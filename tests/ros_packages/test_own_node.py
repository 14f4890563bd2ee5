"""The node in the workspace's README: run unchanged, and as a package that colcon builds."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import cv2
import pytest

pytestmark = pytest.mark.ros

SOURCES = Path(__file__).parents[2] / "environment" / "ros2_ws"
NODE = re.search(
    r"<!-- tested: node -->\n```python\n(.*?)```",
    (SOURCES / "README.md").read_text(encoding="utf-8"),
    re.DOTALL,
)[1]


@pytest.fixture
def binary_of(collect, camera, tools):
    """binary_of(level) -> the pixels that the node publishes for a frame, and the expected ones."""

    def run(level):
        frame = tools.make_frame(5)
        result = camera.get_result(collect("/my_binary/binary"), tools.message_of(frame))
        expected = (cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY) > level) * 255
        assert expected.min() == 0 and expected.max() == 255
        return tools.pixels(result).tolist(), expected.tolist()

    return run


def test_it_runs_unchanged(start, tmp_path, binary_of):
    (tmp_path / "my_binary.py").write_text(NODE)
    process = start(sys.executable, tmp_path / "my_binary.py", "--ros-args", "-p", "level:=90")
    process.wait_for("subscribed to /kachaka/front_camera/image_raw")
    published, expected = binary_of(90)
    assert published == expected
    assert process.leave() == 0
    assert re.search(r"my_binary: \d+ received, \d+ processed, 0 failed", process.output)


def test_a_copied_package_with_another_name_works(start, tmp_path, binary_of, workspace):
    old, new = "image_gray_processor", "my_binary"
    package = tmp_path / "src" / new
    shutil.copytree(SOURCES / "src" / old, package, ignore=shutil.ignore_patterns("__pycache__"))
    for path in sorted(package.rglob("*"), reverse=True):
        if path.is_file():
            path.write_text(path.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
        path.rename(path.with_name(path.name.replace(old, new)))
    (package / new / f"{new}.py").write_text(NODE)
    build = subprocess.run(
        [workspace.colcon, "--log-base", "log", "build"], cwd=tmp_path, capture_output=True, text=True
    )
    assert build.returncode == 0, build.stdout + build.stderr
    program = 'source install/setup.bash && exec "$0/lib/my_binary/my_binary"'
    process = start("bash", "-c", f"cd {tmp_path} && {program}", tmp_path / "install" / new)
    process.wait_for("subscribed to /kachaka/front_camera/image_raw")
    published, expected = binary_of(127)
    assert published == expected
    assert process.leave() == 0
