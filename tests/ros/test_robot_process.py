"""One camera for all programs: real processes share it, are killed, are refused, and switch it."""

import contextlib
import os
import signal
import socket
import subprocess
import sys

import psutil
import pytest

pytestmark = pytest.mark.ros

TOPIC = "/kachaka/front_camera/image_raw"
# Imports the package once, and forks a program for each domain that it receives. A program evaluates each
# line that it reads, and prints the value.
PROGRAMS = """
import faulthandler, os, signal, socket, sys
from imgproc_course.ros import ImageSubscriber, open_camera

def evaluate_lines():
    faulthandler.enable()  # what crashes in Fast DDS leaves its stack in the message of `evaluate`
    for line in sys.stdin:
        try:
            print(repr(eval(line)), flush=True)
        except (ValueError, RuntimeError) as error:
            print(type(error).__name__, error, flush=True)

signal.signal(signal.SIGCHLD, signal.SIG_IGN)
requests = socket.socket(fileno=int(sys.argv[1]))
while True:
    domain, descriptors, _, _ = socket.recv_fds(requests, 100, 3)
    if not domain:
        break
    if (pid := os.fork()) == 0:
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        os.environ["ROS_DOMAIN_ID"] = domain.decode()
        for number, descriptor in enumerate(descriptors):
            os.dup2(descriptor, number)
        requests.close()
        os.closerange(3, 100)
        sys.stdout = os.fdopen(os.dup(1), "w", buffering=1, closefd=False)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # what Fast DDS prints, see ONLY_PYTHON_PRINTS
        evaluate_lines()
        sys.exit()
    requests.send(str(pid).encode())
    for descriptor in descriptors:
        os.close(descriptor)
"""


class Program:
    """A process of its own, which evaluates what a test asks for."""

    def __init__(self, programs, domain):
        pipes = [os.pipe() for _ in range(3)]
        (stdin, self._stdin), (self._stdout, stdout), (self._stderr, stderr) = pipes
        socket.send_fds(programs, [domain.encode()], [stdin, stdout, stderr])
        self.pid = int(programs.recv(100))
        for descriptor in (stdin, stdout, stderr):
            os.close(descriptor)
        self._stdin = os.fdopen(self._stdin, "w", buffering=1)
        self._stdout, self._stderr = os.fdopen(self._stdout), os.fdopen(self._stderr)
        self.name = f"python -c (pid {self.pid})"

    def evaluate(self, expression):
        """The repr of the expression's value; or the name and the text of the error."""
        self._stdin.write(f"{expression}\n")
        line = self._stdout.readline()
        assert line, f"{self.name} has ended at {expression}: {self._stderr.read()}"
        return line.removesuffix("\n")

    def open(self, options=""):
        return self.evaluate(f"globals().update(camera=open_camera({options})) or camera")

    def receive(self):
        """The shape of a frame that the program receives."""
        return self.evaluate("ImageSubscriber(camera.topic).wait(60).shape")

    def read_error_line(self):
        return self._stderr.readline()

    def kill(self):
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.pid, signal.SIGKILL)
        for pipe in (self._stdin, self._stdout, self._stderr):
            pipe.close()


@pytest.fixture(scope="module")
def programs():
    here, there = socket.socketpair()
    with here, there:
        command = [sys.executable, "-c", PROGRAMS, str(there.fileno())]
        with subprocess.Popen(command, pass_fds=[there.fileno()]):
            there.close()
            yield here
            here.close()


@pytest.fixture
def start_program(programs):
    """Starts programs in a domain (this test's own, if omitted) and kills them at the end."""
    started = []

    def start(domain=None):
        started.append(Program(programs, domain or os.environ["ROS_DOMAIN_ID"]))
        return started[-1]

    yield start
    for program in started:
        program.kill()


def socket_file():
    from imgproc_course.ros.robot_process import runtime_file

    return runtime_file(int(os.environ["ROS_DOMAIN_ID"]), "socket")


@pytest.fixture(autouse=True)
def nothing_remains(wait_until, robot_processes):
    """Each test begins and ends without a robot process and without a socket."""
    wait_until(lambda: not robot_processes())
    yield
    wait_until(lambda: not robot_processes() and not socket_file().exists())


FRAME = "(720, 1280, 3)"
AT_30 = f"<Camera {TOPIC} at 30 Hz>"
AT_10 = f"<Camera {TOPIC} at 10 Hz>"


def test_programs_share_one_camera_until_the_last_is_killed(start_program, wait_until, robot_processes):
    first, second = start_program(), start_program()
    assert (first.open("speed=3.0"), second.open("speed=3.0")) == (AT_30, AT_30)
    (robot,) = robot_processes()
    assert (first.receive(), second.receive()) == (FRAME, FRAME)
    assert second.evaluate("camera.other_users") == str([first.name])
    first.kill()  # the one that started it, with kill -9
    assert second.receive() == FRAME
    wait_until(lambda: second.evaluate("camera.other_users") == "[]")
    third = start_program()
    assert third.open("speed=3.0") == AT_30
    assert second.evaluate("camera.stop(), camera.running") == "(None, False)"
    assert third.receive() == FRAME and robot_processes() == [robot]
    third.kill()
    robot.wait(60)


def test_who_asks_for_another_speed_is_refused_or_switches_it_for_all(start_program):
    first, second = start_program(), start_program()
    assert first.open("speed=3.0") == AT_30
    assert second.open() == (
        f"RobotInUseError the robot of this domain is playing drive at 30 Hz on {TOPIC}, used by "
        f"{first.name}; you asked for speed 1.0: switch=True (--switch in a terminal) switches it for all, "
        "or take another ROS_DOMAIN_ID (0 to 101)"
    )
    assert second.open("topic='/elsewhere'").startswith("RobotInUseError ")
    assert second.open("'webcam'").startswith("RobotInUseError ")
    assert second.open("'topic'").startswith("RobotInUseError ")
    assert second.open("'topic', topic='/elsewhere'") == "<Camera /elsewhere>"
    assert second.open("switch=True") == AT_10
    assert first.read_error_line() == (
        f"{second.name} has switched the robot: it is now playing drive at 10 Hz on {TOPIC}\n"
    )
    assert first.evaluate("camera") == AT_10
    assert (first.receive(), second.receive()) == (FRAME, FRAME)


def test_a_switch_that_fails_leaves_the_camera_as_it_was(start_program):
    first, second = start_program(), start_program()
    assert first.open("speed=3.0") == AT_30
    assert second.open("recording='/no/such/bag', switch=True").startswith(
        "RecordingError there is no recording /no/such/bag"
    )
    assert second.open("'webcam', switch=True").startswith("RuntimeError no webcam answers")
    # This one can be opened, but not started: its camera info would be on the topic of its images.
    assert second.open("topic='/elsewhere/camera_info', switch=True") == (
        "ValueError cannot publish images on /elsewhere/camera_info: the camera uses this name, or one "
        f"beside it, for another type of message; choose another topic, such as {TOPIC}"
    )
    assert first.evaluate("camera, camera.last_error, camera.running") == f"({AT_30}, None, True)"
    assert first.receive() == FRAME


def test_a_program_alone_switches_its_camera_without_saying_so(start_program, robot_processes):
    program = start_program()
    assert (program.open("speed=3.0"), program.open()) == (AT_30, AT_10)
    assert program.open("'topic', switch=True") == f"<Camera {TOPIC}>"
    assert len(robot_processes()) == 1


def test_two_domains_have_two_cameras(start_program, robot_processes):
    other_domain = str(int(os.environ["ROS_DOMAIN_ID"]) % 20)
    first, second = start_program(), start_program(other_domain)
    assert (first.open("speed=3.0"), second.open()) == (AT_30, AT_10)
    assert len(robot_processes()) == len(robot_processes(other_domain)) == 1
    assert (first.receive(), second.receive()) == (FRAME, FRAME)
    first.kill()
    assert second.receive() == FRAME


def test_what_a_killed_robot_leaves_is_no_obstacle(start_program, wait_until, robot_processes):
    program = start_program()
    program.open("speed=3.0")
    os.kill(program.pid, signal.SIGSTOP)  # so that it does not start the robot again
    (robot,) = robot_processes()
    robot.kill()
    program.kill()
    wait_until(lambda: not robot_processes())
    assert socket_file().exists()
    assert start_program().open() == AT_10


def test_programs_learn_that_their_robot_was_killed_and_start_it_again(start_program, robot_processes):
    first, second = start_program(), start_program()
    assert (first.open("speed=3.0"), second.open("speed=3.0")) == (AT_30, AT_30)
    (robot,) = robot_processes()
    robot.kill()
    end = "the robot process has ended unexpectedly; open_camera() starts it again"
    for program in (first, second):
        assert program.read_error_line() == f"{end}\n"
        assert program.evaluate("camera.wait(60), camera.last_error") == str((True, end))
        assert program.open("speed=3.0") == AT_30
        assert program.receive() == FRAME
    assert second.evaluate("camera.other_users") == str([first.name])
    assert len(robot_processes()) == 1


def test_a_forked_child_keeps_no_camera_alive(start_program, robot_processes):
    program = start_program()
    program.open()
    child = int(program.evaluate("__import__('os').fork() or __import__('time').sleep(600)"))
    (robot,) = robot_processes()
    program.kill()
    try:
        robot.wait(60)
    finally:
        psutil.Process(child).kill()


def test_it_stops_twice_and_with_its_block_and_with_the_session(start_program, wait_until, robot_processes):
    program = start_program()
    program.open("speed=3.0")
    assert program.evaluate("camera.__exit__(), camera.stop(), camera.running, camera.played >= 0") == (
        "(None, None, False, True)"
    )
    wait_until(lambda: not robot_processes())
    program.open("speed=3.0")
    assert program.evaluate("ImageSubscriber('/x').session.stop(), camera.running") == "(None, False)"
    wait_until(lambda: not robot_processes())
    assert program.open("speed=3.0") == AT_30


def test_the_end_of_a_recording_and_a_warning_reach_every_program(start_program):
    first, second = start_program(), start_program()
    first.open("loop=False, speed=15")
    second.open("loop=False, speed=15")
    # The event reaches each: at the end of its time, `wait` alone would ask the robot and know it too.
    ended = "camera._ended.wait(60), camera.wait(60)"
    assert first.evaluate(ended) == second.evaluate(ended) == "(True, True)"
    assert second.evaluate("camera.played, camera.published, camera.last_error") == "(90, 0, None)"
    assert second.open("loop=False, speed=15") == f"<Camera {TOPIC} at 150 Hz>"  # from its beginning
    assert first.evaluate(f"{ended}, camera.played") == "(True, True, 90)"


@pytest.mark.parametrize(
    "options, message",
    [
        ({"source": "robot"}, "unknown source 'robot'; use 'recording', 'room', 'webcam' or 'topic'"),
        ({"speed": 0}, "speed must be a positive number, got 0"),
        ({"speed": float("nan")}, "speed must be a positive number, got nan"),
        ({"speed": "fast"}, "speed must be a positive number, got 'fast'"),
        ({"source": "webcam", "speed": 2.0}, "only a recording can change its speed"),
        ({"stamps": "then"}, "stamps must be 'now' or 'recorded', got 'then'"),
        ({"topic": "two words"}, "'two words' is not a topic name"),
    ],
)
def test_bad_arguments_are_refused_in_one_line(session, options, message, robot_processes):
    from imgproc_course.ros import open_camera

    with pytest.raises(ValueError) as error:
        open_camera(**options)
    assert message in str(error.value) and "\n" not in str(error.value)
    assert robot_processes() == []
