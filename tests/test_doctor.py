"""The doctor: what it checks, what it reports, and the remedies."""

import importlib.metadata
import importlib.util
import io
import os
import re
import socket
import subprocess
import sys
from pathlib import Path

import cv2
import pytest
from rich.console import Console

from imgproc_course import doctor as doctor_package
from imgproc_course.doctor import Finding, Report, doctor, graph, software
from imgproc_course.doctor.report import failure, ok, warning
from imgproc_course.messages import ConversionError

ROOT = Path(__file__).parents[1]


def findings_of(check):
    """What a check reports, by name."""
    return {finding.name: finding for finding in check()}


@pytest.fixture(scope="module")
def report():
    return doctor()


@pytest.mark.ros
def test_on_a_machine_that_is_set_up_nothing_fails(report):
    assert report.ready
    assert [each.name for each in report.findings if each.verdict == "failure"] == []
    findings = {finding.name: finding.observation for finding in report.findings}
    assert {"kernel", "ROS 2", "DDS profile", "domain"} < findings.keys()
    assert findings["topic"] == "frames arrive from the camera, a process of its own"
    assert findings["Python"] == ".".join(map(str, sys.version_info[:3]))
    assert findings["imgproc-course"] == importlib.metadata.version("imgproc-course")
    assert findings["numpy"] == importlib.metadata.version("numpy")
    assert findings["recording"] == "90 frames of 1280×720, 10 per second"
    assert findings["OpenCV"].startswith(cv2.__version__)


def test_no_path_of_this_machine_is_in_the_report(report):
    page = f"{report}\n{report._repr_html_()}"
    for part in (str(ROOT), str(Path.home()), sys.prefix, sys.executable):
        assert part not in page or part in ("/", "/root")
    paths = re.findall(r"(?<![\w<./])/[a-z]\w*/[\w./-]+", page)
    assert [path for path in paths if not path.startswith("/dev/shm")] == []


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("cannot open /opt/ros/jazzy/lib/librcl.so: no", "cannot open librcl.so: no"),
        ("'/home/ada/course/.venv/bin/python' is old", "'python' is old"),
        (r"see C:\Users\ada\course\x.py", "see x.py"),
        ("5 MiB free in /dev/shm; and on /kachaka/front_camera/image_raw", None),
        ("git checkout -- imgproc_course/recording/drive", None),
        ("run environment/lab; or macOS/Windows", None),
        ("two\nlines", "two lines"),
    ],
)
def test_paths_are_cut_to_their_last_part(text, shown):
    assert ok("x", text).observation == (shown or text)
    assert failure("x", "y", text).remedy == (shown or text)


REPORT = Report(
    [ok("one", "fine"), warning("two", "so <so>", "leave it"), failure("three", "bad", "mend it & ask")]
)


def test_a_failure_makes_the_report_not_ready_and_a_warning_does_not():
    assert not REPORT.ready
    assert REPORT.summary == "1 of 3 failed: follow the remedy beside each ✗, then run the doctor again."
    assert Report(REPORT.findings[:2]).ready
    assert Report(REPORT.findings[:2]).summary == "Ready. You can ignore the lines with !."
    assert Report(REPORT.findings[:1]).summary == "Everything is ready."


def test_as_text_each_diagnosis_is_a_line_with_its_remedy_below():
    assert str(REPORT).splitlines() == [
        "✓ one    fine",
        "! two    so <so>",
        "         → leave it",
        "✗ three  bad",
        "         → mend it & ask",
        "1 of 3 failed: follow the remedy beside each ✗, then run the doctor again.",
    ]
    assert repr(REPORT) == str(REPORT)


def test_in_a_notebook_it_is_a_table_without_stray_markup():
    page = REPORT._repr_html_()
    assert page.count("<tr>") == 3
    assert "so &lt;so&gt;" in page
    assert "mend it &amp; ask" in page
    assert 'title="failure">✗' in page


def test_in_a_terminal_it_is_a_table():
    console = Console(file=io.StringIO(), width=100, force_terminal=False)
    REPORT.print(console)
    lines = [line.rstrip() for line in console.file.getvalue().splitlines()]
    assert lines[0] == "✓  one    fine"
    assert lines[1:3] == ["!  two    so <so>", "          → leave it"]


# ---------------------------------------------------------------------------------------- software


def test_a_python_that_is_too_new(monkeypatch):
    monkeypatch.setattr(software.sys, "version_info", (3, 14, 0))
    finding = findings_of(software.check_python)["Python"]
    assert (finding.verdict, finding.observation) == ("failure", "3.14.0")
    assert "run environment/lab" in finding.remedy


def test_packages_in_pythonpath_that_hide_the_courses_end_the_checks(monkeypatch, tmp_path):
    ros = tmp_path / f"ros/lib/python3.{sys.version_info.minor}/site-packages"
    for folder in (ros / "rclpy", tmp_path / "other/my_package", tmp_path / "other/numpy"):
        folder.mkdir(parents=True)
        (folder / "__init__.py").touch()
    monkeypatch.setenv("PYTHONPATH", f"{ros}:{tmp_path / 'other'}")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "ros"))
    problem = "packages there come before the course's own: numpy"
    remedy = "unset PYTHONPATH; environment/lab does not use it"
    assert doctor().findings == [Finding("PYTHONPATH", "failure", problem, remedy)]
    monkeypatch.setenv("PYTHONPATH", str(ros))
    assert list(software.check_pythonpath()) == []


@pytest.mark.parametrize(("path", "verdict"), [("/a b/c", "warning"), ("/x" * 60, "warning"), ("/é/c", None)])
def test_a_path_in_which_ros_packages_do_not_start(monkeypatch, path, verdict):
    monkeypatch.setattr(software, "VENV", Path(path, ".venv"))
    assert getattr(findings_of(software.check_disk).get("folder"), "verdict", None) == verdict


def test_without_the_library_of_x11_the_room_names_its_package(tmp_path):
    (tmp_path / "libX11.so.6").touch()  # hides the system's
    libraries = f"{tmp_path}:{os.environ.get('LD_LIBRARY_PATH', '')}"
    environment = {"LD_LIBRARY_PATH": libraries, "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1"}
    code = "from imgproc_course.doctor import software; print(*software.check_room())"
    command = [sys.executable, "-c", code]
    process = subprocess.run(command, env=os.environ | environment, capture_output=True, text=True)
    assert "verdict='failure', observation=\"the room's renderer does not load" in process.stdout
    assert "remedy='install that: sudo apt install libx11-6 (Debian, Ubuntu)" in process.stdout


def test_a_missing_package(monkeypatch):
    monkeypatch.setattr(importlib.metadata, "version", _missing("nbval"))
    findings = findings_of(software.check_packages)
    assert findings["nbval"] == Finding("nbval", "failure", "is not installed", software.SET_UP)
    assert findings["numpy"].verdict == "ok"


def _missing(absent):
    real = importlib.metadata.version

    def version(name):
        if name == absent:
            raise importlib.metadata.PackageNotFoundError(name)
        return real(name)

    return version


def test_a_kernel_of_another_environment(monkeypatch, tmp_path):
    monkeypatch.setattr(software, "VENV", tmp_path)
    finding = findings_of(software.check_kernel)["kernel"]
    assert finding.verdict == "warning"
    assert "Kernel > Change Kernel > Python 3" in finding.remedy


def test_an_environment_without_jupyter_has_no_kernel_to_check(monkeypatch):
    monkeypatch.setattr(software, "VENV", Path(sys.prefix))
    monkeypatch.setitem(sys.modules, "jupyter_client.kernelspec", None)
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name: None if name == "jupyter_client" else find(name)
    )
    assert findings_of(software.check_kernel) == {}


def test_a_jupyter_kernel_of_another_environment(monkeypatch):
    monkeypatch.setattr(software, "VENV", Path(sys.prefix))
    monkeypatch.setattr(software, "_kernel_of_jupyter", lambda: "/usr/bin/python3")
    finding = findings_of(software.check_kernel)["kernel"]
    assert (finding.verdict, finding.remedy) == (
        "warning",
        "start JupyterLab with environment/lab, which uses the course's own",
    )
    monkeypatch.setattr(software, "_kernel_of_jupyter", lambda: sys.executable)
    assert findings_of(software.check_kernel)["kernel"].verdict == "ok"


class _Distribution:
    version = "4.12.0"

    def __init__(self, name):
        self.metadata = {"Name": name}


def test_two_opencvs_break_each_other(monkeypatch):
    both = [_Distribution("opencv-python"), _Distribution("opencv-python-headless"), _Distribution("numpy")]
    monkeypatch.setattr(importlib.metadata, "distributions", lambda: both)
    finding = findings_of(software.check_opencv)["OpenCV"]
    assert finding.verdict == "failure"
    assert finding.observation.startswith("opencv-python and opencv-python-headless are both installed")
    assert finding.remedy.startswith("pip uninstall opencv-python opencv-python-headless; then delete .venv")


def test_an_opencv_that_does_not_load(monkeypatch):
    monkeypatch.setitem(sys.modules, "cv2", None)
    finding = findings_of(software.check_opencv)["OpenCV"]
    assert finding.verdict == "failure"
    assert "delete .venv" in finding.remedy


@pytest.mark.parametrize("cascades", ["empty folder", "no data"])
def test_an_opencv_without_cascades_is_a_warning(monkeypatch, tmp_path, cascades):
    if cascades == "no data":
        monkeypatch.delattr(cv2, "data")
    else:
        monkeypatch.setattr(cv2.data, "haarcascades", str(tmp_path))
    finding = findings_of(software.check_opencv)["OpenCV"]
    assert (finding.verdict, finding.observation) == (
        "warning",
        f"{cv2.__version__}, without Haar cascades",
    )


# ---------------------------------------------------------------------------------------- ROS


def test_without_ros_the_lessons_still_run(monkeypatch):
    missing = "ROS 2 is missing (rclpy is not installed), and this needs a running graph"
    problem = f"{missing}; on Linux x86-64: environment/setup"
    monkeypatch.setattr("imgproc_course.ros.ros_problem", lambda: problem)
    monkeypatch.setattr(graph.importlib.util, "find_spec", lambda _: None)
    (finding,) = graph.check_ros()
    assert (finding.verdict, finding.remedy) == ("warning", "on Linux x86-64: environment/setup")
    assert finding.observation == missing


@pytest.mark.ros
def test_a_ros_that_does_not_load_is_a_failure(monkeypatch):
    problem = (
        "ROS 2 is installed, but Python 3.11 cannot load it (/opt/ros/x/librcl.so); start JupyterLab anew"
    )
    monkeypatch.setattr("imgproc_course.ros.ros_problem", lambda: problem)
    (finding,) = graph.check_ros()
    assert (finding.verdict, finding.remedy) == ("failure", "start JupyterLab anew")
    assert finding.observation == "ROS 2 is installed, but Python 3.11 cannot load it (librcl.so)"


@pytest.mark.ros
def test_a_profile_with_a_note_is_a_warning(monkeypatch):
    from imgproc_course.ros import DdsProfile

    note = "/dev/shm has 10 MiB free and images need 18; enlarge it"
    profile = DdsProfile("nobody", note=note)
    monkeypatch.setattr("imgproc_course.ros.dds_profile", lambda: profile)
    findings = findings_of(graph.check_ros)
    assert findings["DDS profile"] == Finding("DDS profile", "warning", "none: Fast DDS's defaults", note)


@pytest.mark.parametrize(
    ("domain", "discovery_range", "verdict", "observation"),
    [
        ("", "", "ok", "0; topics are shared with everyone on this network in the same domain"),
        ("7", "LOCALHOST", "ok", "7; topics are shared only with programs on this machine, not with a robot"),
        ("102", "", "failure", "ROS_DOMAIN_ID=102"),
        ("7", "OFF", "failure", "ROS_AUTOMATIC_DISCOVERY_RANGE=OFF: programs do not discover each other"),
        (
            "7",
            "localhost",
            "failure",
            "ROS_AUTOMATIC_DISCOVERY_RANGE=localhost is not one of SUBNET, LOCALHOST, OFF, ",
        ),
    ],
)
def test_the_domain_says_who_shares_the_topics(monkeypatch, domain, discovery_range, verdict, observation):
    monkeypatch.setenv("ROS_DOMAIN_ID", domain)
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", discovery_range)
    (finding,) = graph._domain()
    assert finding.verdict == verdict
    assert finding.observation.startswith(observation)
    assert bool(finding.remedy) == (verdict == "failure")


@pytest.mark.parametrize(
    ("environment", "verdict", "observation", "remedy"),
    [
        (
            {"ROS_DISCOVERY_SERVER": "10.0.0.9:11811"},
            "warning",
            "ROS_DISCOVERY_SERVER=10.0.0.9",
            "start it, or unset",
        ),
        (
            {"ROS_LOCALHOST_ONLY": "1", "ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF"},
            "ok",
            "9; topics are shared only",
            "",
        ),
        ({"ROS_DOMAIN_ID": "٣"}, "failure", "ROS_DOMAIN_ID=", "give a number from 0 to 101"),
        ({}, "warning", "ROS programs of another user (54321) are in domain 9", "for a domain of your own: "),
    ],
)
def test_what_keeps_programs_apart(monkeypatch, environment, verdict, observation, remedy):
    for name, value in ({"ROS_DOMAIN_ID": "9"} | environment).items():
        monkeypatch.setenv(name, value)
    users = set() if environment else {54321, os.getuid()}
    monkeypatch.setattr("imgproc_course.ros_domain.users_in", lambda domain: users)
    (finding,) = graph._domain()
    assert finding.verdict == verdict
    assert finding.observation.startswith(observation) and finding.remedy.startswith(remedy)


def test_the_loopback_carries_packets_and_multicast():
    assert graph._packet_arrives("127.0.0.1")
    assert findings_of(graph.check_network)["loopback"].verdict in ("ok", "warning")


@pytest.mark.parametrize(
    ("blocked", "verdict", "remedy"),
    [
        ({"127.0.0.1", graph.MULTICAST_GROUP}, "failure", "sudo ufw allow in on lo"),
        ({graph.MULTICAST_GROUP}, "warning", "export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST"),
        (set(), "ok", ""),
    ],
)
def test_a_network_that_carries_nothing(monkeypatch, blocked, verdict, remedy):
    monkeypatch.setattr(graph, "_packet_arrives", lambda address: address not in blocked)
    finding = findings_of(graph.check_network)["loopback"]
    assert finding.verdict == verdict
    assert remedy in finding.remedy


def cannot_send(*_):
    raise OSError(101, "Network is unreachable")


def send_another(sender, _, address, send=socket.socket.sendto):
    send(sender, b"stranger", address)


@pytest.mark.parametrize("send", [cannot_send, send_another, lambda *_: None], ids=["fails", "other", "lost"])
def test_a_packet_that_is_not_sent_or_lost_or_another_did_not_arrive(monkeypatch, send):
    monkeypatch.setattr(socket.socket, "sendto", send)
    assert not graph._packet_arrives("127.0.0.1")


# ---------------------------------------------------------------------------------------- camera


def test_a_damaged_recording(monkeypatch, tmp_path):
    monkeypatch.setattr("imgproc_course.recording.recording.DRIVE", tmp_path)
    finding = findings_of(software.check_recording)["recording"]
    assert finding.verdict == "failure"
    assert "git checkout -- imgproc_course/recording/drive" in finding.remedy


def test_a_recording_whose_error_has_no_remedy(monkeypatch):
    def damaged(_):
        raise ConversionError("frame 3 is cut short")

    monkeypatch.setattr("imgproc_course.recording.open_recording", damaged)
    finding = findings_of(software.check_recording)["recording"]
    assert finding.observation == "frame 3 is cut short"
    assert finding.remedy == "git checkout -- imgproc_course/recording/drive"


def test_a_disk_that_is_nearly_full(monkeypatch):
    usage = software.shutil.disk_usage("/")._replace(free=50 << 20)
    monkeypatch.setattr(software.shutil, "disk_usage", lambda _: usage)
    finding = findings_of(software.check_disk)["disk"]
    assert (finding.verdict, finding.observation) == ("warning", "50 MiB free where your lessons are")


@pytest.mark.ros
def test_a_topic_that_stays_silent(monkeypatch):
    monkeypatch.setattr(
        graph, "_why_no_frames", lambda topic: f"nothing came on {topic} in 5 s; restart the kernel"
    )
    finding = findings_of(graph.check_topics)["topic"]
    assert finding.verdict == "failure"
    assert finding.observation == "nothing came on /kachaka/front_camera/image_raw in 5 s"
    assert finding.remedy.startswith("restart the kernel; see the lines on DDS profile")


@pytest.mark.ros
def test_the_camera_that_runs_is_checked_and_not_changed():
    from imgproc_course.ros import RosSession, open_camera

    with open_camera(topic="/elsewhere", speed=3.0) as camera:
        (finding,) = graph.check_topics()
        assert (finding.verdict, camera.rate, camera.running) == ("ok", 30.0, True)
    assert RosSession().running  # it ran before
    RosSession().stop()


@pytest.mark.ros
def test_the_session_that_the_doctor_started_ends_with_the_check(monkeypatch):
    from imgproc_course.ros import RosSession

    RosSession().stop()
    monkeypatch.setattr(graph, "_why_no_frames", lambda topic: None)
    (finding,) = graph.check_topics()
    assert (finding.verdict, RosSession().running) == ("ok", False)


@pytest.mark.ros
def test_the_topic_check_names_an_invalid_domain_too(monkeypatch):
    from imgproc_course.ros import RosSession

    RosSession().stop()
    monkeypatch.setenv("ROS_DOMAIN_ID", "seven")
    (finding,) = graph.check_topics()
    assert finding.verdict == "failure"
    assert "ROS_DOMAIN_ID" in finding.observation


def test_without_ros_no_topic_is_tried(monkeypatch):
    monkeypatch.setattr("imgproc_course.ros.ros_available", lambda: False)
    assert list(graph.check_topics()) == []


def test_it_shows_what_it_checks(monkeypatch, capsys):
    monkeypatch.setattr(doctor_package, "CHECKS", (("the weather", lambda: [ok("weather", "fair")]),))
    updates = []
    monkeypatch.setattr("rich.status.Status.update", lambda self, text: updates.append(text))
    assert str(doctor()) == "✓ weather  fair\nEverything is ready."
    assert updates == ["The doctor checks the weather ..."]
    assert capsys.readouterr().out == ""


@pytest.mark.ros
def test_a_topic_without_a_publisher_is_reported():
    from imgproc_course.ros import RosSession

    problem = graph._why_no_frames("/doctor_nobody/image_raw", timeout=0.2)
    RosSession().stop()
    assert "/doctor_nobody/image_raw" in problem
    assert "; " in problem
