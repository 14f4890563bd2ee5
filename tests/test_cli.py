"""The command imgproc-course: each of its commands, what goes on to the rooms, and errors of one line."""

import os
import signal
import subprocess
import sys
import time

import pytest
from click.testing import CliRunner

import imgproc_course
from imgproc_course.cli import main
from imgproc_course.doctor import Report
from imgproc_course.doctor.report import failure, ok, warning
from imgproc_course.lab import LabError
from imgproc_course.working_copies import LessonsError

COMMAND = [sys.executable, "-c", "from imgproc_course.cli import main; main()"]


@pytest.fixture
def call():
    return lambda *arguments: CliRunner().invoke(main, arguments, catch_exceptions=False)


def test_help_names_every_command(call):
    text = call("--help").output
    for name in ("doctor", "start", "play", "build", "check"):
        assert f"\n  {name} " in text


def test_every_command_has_help(call):
    for name in ("doctor", "start", "play", "build", "check"):
        done = call(name, "--help")
        assert done.exit_code == 0
        assert done.output.startswith(f"Usage: main {name} ")


def test_an_unknown_command_is_refused(call):
    done = call("dance")
    assert done.exit_code == 2
    assert "No such command 'dance'" in done.output


def test_its_version_is_the_packages(call):
    assert call("--version").output.strip().endswith(imgproc_course.__version__)


def test_help_loads_nothing_heavy():
    code = (
        "import sys; from click.testing import CliRunner; from imgproc_course.cli import main; "
        "CliRunner().invoke(main, ['--help']); "
        "print([name for name in ('cv2', 'numpy', 'rclpy', 'jupyterlab', 'nbformat') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout.strip() == "[]"


def test_the_package_itself_loads_nothing_and_has_no_other_names():
    code = (
        "import sys; before = set(sys.modules); import imgproc_course; "
        "print(sorted(set(sys.modules) - before), hasattr(imgproc_course, 'dance'))"
    )
    done = subprocess.run([sys.executable, "-I", "-c", code], capture_output=True, text=True)
    assert done.stdout.strip() == "['imgproc_course'] False"


def test_a_command_whose_packages_are_not_installed_says_so_in_one_line():
    code = "import sys; sys.modules['nbformat'] = None; from imgproc_course.cli import main; main()"
    for command in (["start"], ["check", "x.ipynb"]):
        done = subprocess.run([sys.executable, "-c", code, *command], capture_output=True, text=True)
        assert (done.returncode, done.stdout) == (1, "")
        assert done.stderr == (
            "Error: nbformat is not installed for this Python, and this command needs it; use the "
            "imgproc-course of the course's own .venv, which environment/setup makes\n"
        )


# ---------------------------------------------------------------------------------------- doctor


@pytest.mark.parametrize(
    ("diagnosis", "code"), [(ok("a", "b"), 0), (warning("a", "b", "c"), 0), (failure("a", "b", "c"), 1)]
)
def test_the_doctor_fails_only_where_something_fails(call, monkeypatch, diagnosis, code):
    monkeypatch.setattr("imgproc_course.doctor.doctor", lambda: Report([diagnosis]))
    done = call("doctor")
    assert done.exit_code == code
    assert "b" in done.output


# ---------------------------------------------------------------------------------------- start


def test_options_of_jupyterlab_go_on(call, monkeypatch):
    given = []
    monkeypatch.setattr("imgproc_course.lab.start", lambda options, say: given.extend(options))
    options = ["--no-browser", "--port", "8890", "--ip=127.0.0.1", "--ServerApp.token=x", "--debug"]
    assert call("start", *options).exit_code == 0
    assert given == options


@pytest.mark.parametrize("error", [LabError, LessonsError])
def test_what_keeps_jupyterlab_from_starting_is_one_line(call, monkeypatch, error):
    def refuse(options, say):
        say("New in my_lessons/: a.ipynb")
        raise error("the disk is full; free some space")

    monkeypatch.setattr("imgproc_course.lab.start", refuse)
    done = call("start")
    assert done.exit_code == 1
    assert done.output == "New in my_lessons/: a.ipynb\nError: the disk is full; free some space\n"


def test_start_brings_the_lessons_before_it_runs_jupyterlab(call, monkeypatch, tmp_path):
    lesson = '{"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}'
    (tmp_path / "notebooks").mkdir()
    (tmp_path / "notebooks" / "00_start_here.ipynb").write_text(lesson)
    monkeypatch.setattr("imgproc_course.lab.CHECKOUT", tmp_path)
    monkeypatch.setattr("imgproc_course.working_copies.CHECKOUT", tmp_path)
    monkeypatch.setenv("JUPYTER_DATA_DIR", str(tmp_path / "data"))
    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(tmp_path / "runtime"))
    ran = []
    monkeypatch.setattr("imgproc_course.lab.run", lambda folder, options, say: ran.append((folder, options)))
    done = call("start", "--no-browser")
    assert done.output == "New in my_lessons/: 00_start_here.ipynb\n"
    assert ran == [(tmp_path / "my_lessons", ("--no-browser",))]
    assert (tmp_path / "my_lessons" / "00_start_here.ipynb").read_text() == lesson
    assert call("start").output == "my_lessons/ is up to date; nothing in it was touched.\n"


# ---------------------------------------------------------------------------------------- play


@pytest.mark.ros
def test_play_hands_its_options_on(call, monkeypatch):
    given = []
    monkeypatch.setattr("imgproc_course.ros.player.play", lambda **options: given.append(options) or 0)
    assert call("play").exit_code == 0
    options = ["--speed", "3", "--once", "--recording", "my_bag", "--topic", "/cam", "--stamps", "recorded"]
    options += ["--camera-topic", "/back"]
    assert call("play", *options).exit_code == 0
    usual = {"topic": "/kachaka/front_camera/image_raw", "camera_topic": None, "stamps": "now"}
    mine = {"topic": "/cam", "camera_topic": "/back", "stamps": "recorded"}
    assert given == [
        {"recording": "drive", "speed": 1.0, "loop": True, **usual},
        {"recording": "my_bag", "speed": 3.0, "loop": False, **mine},
    ]


@pytest.mark.ros
def test_a_camera_that_stopped_on_an_error_fails_the_command(call, monkeypatch):
    monkeypatch.setattr("imgproc_course.ros.player.play", lambda **_: 1)
    assert call("play").exit_code == 1


@pytest.mark.ros
@pytest.mark.parametrize(
    ("options", "words"),
    [
        (
            ["--recording", "/no/such/bag"],
            "Error: there is no recording /no/such/bag; give the path of a rosbag2",
        ),
        (
            ["--camera-topic", "/back"],
            "Error: drive holds no pictures on /back, but on: /kachaka/front_camera/",
        ),
        (["--speed", "-1"], "Error: speed -1.0 is no positive number"),
        (["--topic", "no topic"], "Error: 'no topic' is no topic name"),
    ],
)
def test_bad_input_to_play_is_one_line(call, options, words):
    done = call("play", *options)
    assert done.exit_code == 1
    assert done.output.startswith(words)
    assert done.output.count("\n") == 1


def test_play_without_ros_says_what_to_install(call, monkeypatch):
    monkeypatch.setattr("imgproc_course.ros.ros_problem", lambda: "ROS 2 is missing; environment/pixi.toml")
    done = call("play")
    assert (done.exit_code, done.output) == (1, "Error: ROS 2 is missing; environment/pixi.toml\n")


@pytest.mark.ros
def test_play_says_its_rate_and_ends_with_ctrl_c():
    topic = f"/test_play_{os.getpid()}/image_raw"
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    command = [*COMMAND, "play", "--speed", "3", "--topic", topic]
    player = subprocess.Popen(
        command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    try:
        first = player.stdout.readline()
        assert first.startswith("drive at 30 Hz in domain ")
        assert f"{topic}, {topic}/compressed" in first
        time.sleep(0.3)
        player.send_signal(signal.SIGINT)
        out, errors = player.communicate(timeout=60)
    finally:
        player.kill()
    assert player.returncode == 0
    assert out.startswith("stopped after ")
    assert errors == ""


# ---------------------------------------------------------------------------------------- build, check


def test_build_says_which_lesson_there_is_not(call, tmp_path):
    done = call("build", "--masters", str(tmp_path), "99_no_such_lesson")
    assert done.exit_code == 1
    assert done.output.count("\n") == 1


def test_check_wants_a_lesson(call):
    done = call("check")
    assert done.exit_code == 2
    assert "Missing argument" in done.output
