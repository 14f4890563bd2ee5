"""What pip installs of the two distributions, and what a Python without the extras says."""

import re
import subprocess
import sys
import zipfile
from email.parser import Parser
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def metadata(wheel):
    (name,) = (name for name in wheel.namelist() if name.endswith(".dist-info/METADATA"))
    return Parser().parsestr(wheel.read(name).decode())


@pytest.fixture(scope="module")
def wheels(tmp_path_factory):
    """{name: ZipFile} of the wheels of both distributions."""
    folder = tmp_path_factory.mktemp("wheels")
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation"]
    subprocess.run([*command, "-w", folder, ROOT, ROOT / "nbclassroom"], check=True)
    return {path.name.partition("-")[0]: zipfile.ZipFile(path) for path in folder.glob("*.whl")}


def requirements(wheel):
    """(names that are always required, all requirements) of a wheel's metadata."""
    lines = metadata(wheel).get_all("Requires-Dist")
    return {re.match(r"[\w-]+", line)[0] for line in lines if "extra ==" not in line}, lines


def test_the_course_needs_three_packages_and_names_nothing_that_no_index_has(wheels):
    always, lines = requirements(wheels["imgproc_course"])
    assert always == {"numpy", "opencv-python-headless", "scipy"}
    needed = {
        extra: [line for line in lines if f"extra == '{extra}'" in line] for extra in ("ros", "room", "ocr")
    }
    heavy = [extra for extra, of_it in needed.items() if re.search("rapidocr|onnxruntime", " ".join(of_it))]
    assert heavy == ["ocr"]
    assert [line for line in lines if "nbclassroom" in line] == []
    assert "imgproc_course/course.toml" in wheels["imgproc_course"].namelist()


def test_a_wheel_names_its_contributors_and_carries_the_licence(wheels):
    assert wheels.keys() == {"imgproc_course", "nbclassroom"}
    for wheel in wheels.values():
        named = metadata(wheel)
        assert named["Author"] == "The imgproc-course contributors"
        assert named["License-Expression"] == "Apache-2.0" and named["License-File"] == "LICENSE"
        assert any(name.endswith(".dist-info/licenses/LICENSE") for name in wheel.namelist())
        assert "Programming Language :: Python :: 3.11" in named.get_all("Classifier")


def test_the_classroom_is_one_package_and_needs_nothing_of_images_or_ros(wheels):
    always, _ = requirements(wheels["nbclassroom"])
    assert {"jupyterlab", "nbval", "numpy"} <= always
    assert not always & {"opencv-python-headless", "scipy", "rclpy", "imgproc-course"}
    names = {name.partition("/")[0] for name in wheels["nbclassroom"].namelist()}
    assert {name for name in names if not name.endswith(".dist-info")} == {"nbclassroom"}


# Imports that fail if a package is missing, with the extra that brings it.
@pytest.mark.parametrize(
    ("code", "missing", "text"),
    [
        ("import imgproc_course.display", "ipywidgets", 'pip install ".[lab]"'),
        ("import imgproc_course.doctor", "rich", 'pip install ".[lab]"'),
        ("import imgproc_course.simulation.room_env", "gymnasium", 'pip install ".[room]"'),
        ("from imgproc_course.recording import RecordingWriter", "rosbags", 'pip install ".[ros]"'),
        ("from imgproc_course.recording import open_recording as f; f()", "rosbags", 'pip install ".[ros]"'),
        ("import imgproc_course.exercises", "nbclassroom", "pip install ./nbclassroom"),
        ("from imgproc_course.command import main; main()", "click", 'pip install ".[lab]" ./nbclassroom'),
        ("from imgproc_course.command import main; main()", "nbclassroom", "pip install ./nbclassroom"),
    ],
)
def test_what_is_missing_names_what_brings_it(code, missing, text):
    program = f"import sys; sys.modules[{missing!r}] = None; {code}"
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    last = ended.stderr.splitlines()[-1]
    assert ended.returncode == 1 and missing in last and text in last


def test_gymnasium_finds_the_room_without_an_import():
    name = "imgproc_course.simulation.room_env:imgproc_course/Room-v0"
    program = f"import gymnasium; print(gymnasium.make({name!r}, sensors=('scan',)).action_space.shape)"
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert ended.stdout == "(2,)\n"
