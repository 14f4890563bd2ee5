"""The command imgproc-course: its commands, the options that they pass on, and errors of one line."""

import importlib.metadata
import subprocess
import sys

import pytest
from click.testing import CliRunner

from imgproc_course.cli import main
from imgproc_course.course_file import COURSE_FILE
from imgproc_course.doctor import Report
from imgproc_course.doctor.report import failure, ok, warning

COMMAND = [sys.executable, "-c", "from imgproc_course.cli import main; main()"]


@pytest.fixture
def call():
    return lambda *arguments: CliRunner().invoke(main, arguments, catch_exceptions=False)


def test_help_names_every_command(call):
    text = call("--help").output
    for name in ("doctor", "start", "play", "drive", "record", "build", "check"):
        assert f"\n  {name} " in text


def test_its_version_is_the_packages(call):
    assert call("--version").output.strip().endswith(importlib.metadata.version("imgproc-course"))


def test_help_loads_nothing_heavy():
    code = (
        "import sys; from click.testing import CliRunner; from imgproc_course.cli import main; "
        "CliRunner().invoke(main, ['--help']); "
        "print([name for name in ('cv2', 'numpy', 'rclpy', 'jupyterlab', 'nbformat') if name in sys.modules])"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert result.stdout.strip() == "[]"


def test_the_package_itself_loads_nothing_and_has_no_other_names():
    code = (
        "import sys; modules = set(sys.modules); import imgproc_course; "
        "print(sorted(set(sys.modules) - modules), hasattr(imgproc_course, 'dance'))"
    )
    result = subprocess.run([sys.executable, "-I", "-c", code], capture_output=True, text=True)
    assert result.stdout.strip() == "['imgproc_course'] False"


def test_a_command_whose_packages_are_not_installed_says_so_in_one_line():
    code = "import sys; sys.modules['nbformat'] = None; from imgproc_course.cli import main; main()"
    for command in (["start"], ["build", "00"]):
        result = subprocess.run([sys.executable, "-c", code, *command], capture_output=True, text=True)
        assert (result.returncode, result.stdout) == (1, "")
        assert result.stderr == (
            "Error: this command needs nbformat, which is not installed for this Python; use the "
            "imgproc-course in the course's own .venv\n"
        )


# ---------------------------------------------------------------------------------------- doctor


@pytest.mark.parametrize(
    ("diagnosis", "code"), [(ok("a", "b"), 0), (warning("a", "b", "c"), 0), (failure("a", "b", "c"), 1)]
)
def test_the_doctor_command_fails_only_if_a_check_fails(call, monkeypatch, diagnosis, code):
    monkeypatch.setattr("imgproc_course.doctor.doctor", lambda: Report([diagnosis]))
    result = call("doctor")
    assert result.exit_code == code
    assert "b" in result.output


# ---------------------------------------------------------------------------------------- start


def test_jupyterlab_gets_its_options(call, monkeypatch):
    passed_options = []
    monkeypatch.setattr("nbclassroom.lab.server.start", lambda options, say: passed_options.extend(options))
    options = ["--no-browser", "--port", "8890", "--ip=127.0.0.1", "--ServerApp.token=x", "--debug"]
    assert call("start", *options).exit_code == 0
    assert passed_options == options


def test_why_jupyterlab_cannot_start_is_one_line(call, monkeypatch):
    def refuse(options, say):
        say("New in my_lessons/: a.ipynb")
        raise ValueError("the disk is full; free some space")

    monkeypatch.setattr("nbclassroom.lab.server.start", refuse)
    result = call("start")
    assert result.exit_code == 1
    assert result.output == "New in my_lessons/: a.ipynb\nError: the disk is full; free some space\n"


def test_start_copies_the_lessons_before_it_runs_jupyterlab(call, monkeypatch, tmp_path):
    lesson = '{"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}'
    (tmp_path / "notebooks").mkdir()
    (tmp_path / "notebooks" / "00_start_here.ipynb").write_text(lesson)
    course_file = tmp_path / "notebooks" / "course.toml"
    course_file.write_bytes(COURSE_FILE.read_bytes())
    monkeypatch.setenv("NBCLASSROOM_COURSE", str(course_file))
    monkeypatch.setenv("JUPYTER_DATA_DIR", str(tmp_path / "data"))
    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(tmp_path / "runtime"))
    runs = []
    monkeypatch.setattr(
        "nbclassroom.lab.server.run", lambda folder, options, say: runs.append((folder, options))
    )
    result = call("start", "--no-browser")
    assert result.output == "New in my_lessons/: 00_start_here.ipynb\n"
    assert runs == [(tmp_path / "my_lessons", ("--no-browser",))]
    assert (tmp_path / "my_lessons" / "00_start_here.ipynb").read_text() == lesson
    assert call("start").output == "my_lessons/ is up to date; nothing was changed.\n"


# ---------------------------------------------------------------------------------------- play


@pytest.mark.ros
def test_play_passes_its_options_on(call, monkeypatch):
    calls = []
    monkeypatch.setattr("imgproc_course.ros.player.play", lambda **options: calls.append(options) or 0)
    assert call("play").exit_code == 0
    options = ["--speed", "3", "--once", "--recording", "my_bag", "--topic", "/cam", "--stamps", "recorded"]
    options += ["--camera-topic", "/back", "--switch"]
    assert call("play", *options).exit_code == 0
    default_topics = {"topic": "/kachaka/front_camera/image_raw", "camera_topic": None, "stamps": "now"}
    given_topics = {"topic": "/cam", "camera_topic": "/back", "stamps": "recorded"}
    assert calls == [
        {"recording": "drive", "speed": 1.0, "loop": True, "switch": False, **default_topics},
        {"recording": "my_bag", "speed": 3.0, "loop": False, "switch": True, **given_topics},
    ]


@pytest.mark.ros
def test_a_camera_that_stopped_on_an_error_fails_the_command(call, monkeypatch):
    monkeypatch.setattr("imgproc_course.ros.player.play", lambda **_: 1)
    assert call("play").exit_code == 1


@pytest.mark.ros
@pytest.mark.parametrize(
    ("options", "error"),
    [
        (
            ["--recording", "/no/such/bag"],
            "Error: there is no recording /no/such/bag; give the path of a rosbag2",
        ),
        (
            ["--camera-topic", "/back"],
            "Error: drive holds no images on /back, but on: /kachaka/front_camera/",
        ),
        (["--speed", "-1"], "Error: speed must be a positive number, got -1.0"),
        (["--topic", "no topic"], "Error: 'no topic' is not a topic name"),
    ],
)
def test_bad_input_to_play_is_one_line(call, options, error):
    result = call("play", *options)
    assert result.exit_code == 1
    assert result.output.startswith(error)
    assert result.output.count("\n") == 1


def test_play_without_ros_says_what_to_install(call, monkeypatch):
    monkeypatch.setattr("imgproc_course.ros.ros_problem", lambda: "ROS 2 is missing; environment/pixi.toml")
    result = call("play")
    assert (result.exit_code, result.output) == (1, "Error: ROS 2 is missing; environment/pixi.toml\n")


@pytest.mark.ros
def test_drive_and_record_pass_their_options_on(call, monkeypatch, tmp_path):
    calls = []
    monkeypatch.setattr(
        "imgproc_course.ros.player.play", lambda source, **options: calls.append((source, options)) or 0
    )
    monkeypatch.setattr(
        "imgproc_course.ros.recorder.record_until_signal", lambda *args, say: calls.append(args) or 1
    )
    options = ["--seed", "3", "--size", "1280x720", "--lighting", "evening", "--rate", "5", "--switch"]
    assert call("drive", *options, "--start", "0.5", "-0.2", "1", "--room", "17").exit_code == 0
    assert call("drive").exit_code == 0
    assert call("record", str(tmp_path / "own"), "/a", "/b").exit_code == 1
    assert call("record", str(tmp_path / "own")).exit_code == 1
    given = {"seed": 3, "size": (1280, 720), "lighting": "evening", "rate": 5.0, "start": (0.5, -0.2, 1.0)}
    given["room"] = 17
    assert calls == [
        ("room", {**given, "switch": True}),
        ("room", {**dict.fromkeys(given), "switch": False}),
        (["/a", "/b"], tmp_path / "own"),
        (None, tmp_path / "own"),
    ]


@pytest.mark.ros
@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (["drive", "--rate", "0"], "Error: rate must be 1 to 60 images per second, got 0.0"),
        (
            ["drive", "--size", "big"],
            "Error: Invalid value for '--size': 'big' is not a size; write it like 1280x720",
        ),
        (
            ["drive", "--size", "640x480"],
            "Error: size is (width, height), 16:9, 160 to 1920 pixels wide, such as",
        ),
        (
            ["drive", "--start", "50", "0", "0"],
            "Error: the robot cannot start at (50.0, 0.0, 0.0): a wall or furn",
        ),
        (
            ["record", "tests"],
            "Error: tests exists already and is not overwritten; choose another name, or rem",
        ),
        (["drive", "--room", "-3"], "Error: room must be a whole number from 0 on, such as 17, got -3"),
        (["record", "own", "no topic"], "Error: 'no topic' is not a topic name"),
    ],
)
def test_bad_input_to_drive_and_record_is_one_line(call, arguments, line):
    result = call(*arguments)
    assert result.exit_code in (1, 2)
    assert result.output.splitlines()[-1].startswith(line)


# ---------------------------------------------------------------------------------------- build, check


def test_build_names_a_lesson_that_does_not_exist(call, tmp_path):
    result = call("build", "--masters", str(tmp_path), "99_no_such_lesson")
    assert result.exit_code == 1
    assert result.output.count("\n") == 1
