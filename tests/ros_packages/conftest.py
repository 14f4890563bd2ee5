"""Fixtures: both packages built once by colcon, nodes as processes, and a camera for tests."""

import contextlib
import json
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

SOURCES = Path(__file__).parents[2] / "environment" / "ros2_ws" / "src"
PROCESSOR = (sys.executable, Path(__file__).parents[1] / "processor_node.py")
PACKAGES = ("image_edge_detection", "image_gray_processor")
TOPIC = "/kachaka/front_camera/image_raw"
QUERY_INDEX = (
    "import json\n"
    "from ament_index_python import get_package_prefix as prefix, get_package_share_directory as share\n"
    f"print(json.dumps({{name: [prefix(name), share(name)] for name in {PACKAGES}}}))"
)


@pytest.fixture(scope="session")
def workspace(tmp_path_factory):
    """A colcon workspace with both packages built, and its environment after sourcing."""
    root = tmp_path_factory.mktemp("ros2_ws")
    ignore = shutil.ignore_patterns("__pycache__", "build", "install", "log", ".pytest_cache")
    shutil.copytree(SOURCES, root / "src", ignore=ignore)
    colcon = Path(sys.executable).with_name("colcon")
    build = subprocess.run(
        [colcon, "--log-base", "log", "build"], cwd=root, capture_output=True, text=True, timeout=240
    )
    assert build.returncode == 0, build.stdout + build.stderr
    sourced = subprocess.run(
        ["bash", "-c", "source install/setup.bash && env -0"], cwd=root, capture_output=True, check=True
    )
    pairs = (entry.partition("=") for entry in sourced.stdout.decode().split("\0") if entry)
    environment = {name: value for name, _, value in pairs} | {"ROS_LOG_DIR": str(root / "ros_log")}
    query = subprocess.run(
        [sys.executable, "-c", QUERY_INDEX], env=environment, capture_output=True, text=True, check=True
    )
    folders = json.loads(query.stdout)
    return SimpleNamespace(
        root=root,
        colcon=colcon,
        output=build.stdout,
        environment=environment,
        prefix={name: Path(prefix) for name, (prefix, _) in folders.items()},
        share={name: Path(share) for name, (_, share) in folders.items()},
    )


class Process:
    """A process and all its output."""

    def __init__(self, command, environment):
        self._process = subprocess.Popen(
            [str(part) for part in command],
            env={**environment, "PYTHONUNBUFFERED": "1", "RCUTILS_COLORIZED_OUTPUT": "0"},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        self.pid = self._process.pid
        self.output = ""
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        with self._process.stdout as lines:
            for line in lines:
                self.output += line

    @property
    def running(self):
        return self._process.poll() is None

    def wait_for(self, pattern, seconds=60.0, times=1):
        """Waits until the output has so many matches of a regular expression; returns the last of them."""
        end = time.monotonic() + seconds
        while len(matches := list(re.finditer(pattern, self.output))) < times:
            if time.monotonic() > end or not (self.running or self._reader.is_alive()):
                pytest.fail(f"no {pattern!r} ({times} times) in the output:\n{self.output}")
            time.sleep(0.02)
        return matches[times - 1]

    def send(self, number):
        self._process.send_signal(number)

    def leave(self, *numbers, seconds=60.0):
        """Sends these signals (SIGINT if omitted) and returns the exit code.

        Once in hundreds of runs on a busy machine a process did not end: then they are sent once more.
        """
        for timeout in (seconds / 2, seconds):
            for number in numbers or (signal.SIGINT,):
                self.send(number)
            with contextlib.suppress(subprocess.TimeoutExpired):
                return self.wait(timeout)
        pytest.fail(f"not ended by its signals:\n{self.output}")

    def wait(self, seconds=60.0):
        """Waits until it has ended by itself and returns the exit code."""
        code = self._process.wait(seconds)
        self._reader.join(seconds)
        return code

    def kill(self):
        self._process.kill()
        self.wait()


@pytest.fixture
def start(workspace):
    """Starts a command in the sourced workspace; it is killed at the end of the test."""
    running = []

    def start_process(*command, **variables):
        environment = {**workspace.environment, **variables}
        running.append(
            Process(command, {name: value for name, value in environment.items() if value is not None})
        )
        return running[-1]

    yield start_process
    for process in running:
        process.kill()


@pytest.fixture
def start_node(start):
    """Starts one of the nodes as an ImageProcessor, and waits until it has subscribed."""

    def start_processor(name, *arguments, **variables):
        process = start(*PROCESSOR, name, *(["--ros-args", *arguments] if arguments else []), **variables)
        process.wait_for("subscribed to")
        return process

    return start_processor


@pytest.fixture
def start_executable(start, workspace):
    """Starts the executable of a package, as `ros2 run` does, and waits until its node has started."""

    def start_installed(package, *arguments):
        executable = workspace.prefix[package] / "lib" / package / package
        process = start(executable, "--ros-args", *arguments)
        process.wait_for("The node has started")
        return process

    return start_installed


class Collector:
    """Subscribes to a topic and keeps every message, in the order of arrival."""

    def __init__(self, session, topic, message_type=None, qos=None):
        from rclpy.qos import qos_profile_sensor_data
        from sensor_msgs.msg import Image

        self.messages = []
        self._session = session
        self._subscription = session.node.create_subscription(
            message_type or Image, topic, self.messages.append, qos or qos_profile_sensor_data
        )

    def stop(self):
        self._session.run(lambda: self._session.node.destroy_subscription(self._subscription))

    def stamps(self):
        return [nanoseconds(message) for message in list(self.messages)]

    def with_stamp(self, stamp):
        """The message with this stamp, or None."""
        return next((message for message in list(self.messages) if nanoseconds(message) == stamp), None)


@pytest.fixture
def collect(session):
    return lambda topic, message_type=None, qos=None: Collector(session, topic, message_type, qos)


class Camera:
    """Publishes images one by one, each with the next stamp."""

    def __init__(self, session, topic=TOPIC):
        from rclpy.qos import qos_profile_sensor_data
        from sensor_msgs.msg import Image

        self._session = session
        self._publisher = session.node.create_publisher(Image, topic, qos_profile_sensor_data)
        self.stamp = 1_700_000_000_000_000_000
        self.sent = 0

    def send(self, message, stamp=None):
        """Publishes a message with this stamp (or the next), and returns the stamp."""
        self.stamp = self.stamp + 33_000_000 if stamp is None else stamp
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(self.stamp, 1_000_000_000)
        message.header.frame_id = "camera_front"
        self._publisher.publish(message)
        self.sent += 1
        return self.stamp

    def send_until(self, condition, message, seconds=60.0, every=0.03, stamp=None):
        """Sends the message repeatedly until the condition holds, because best effort may lose some."""
        end = time.monotonic() + seconds
        while not (result := condition()):
            if time.monotonic() > end:
                pytest.fail(f"the condition did not become true after {self.sent} images")
            self.send(message, stamp)
            time.sleep(every)
        return result

    def get_result(self, collector, message):
        """The result that a collector receives for this image; the image is sent until a result comes."""
        first = self.send(message)

        def result():
            return next((m for m in reversed(collector.messages) if nanoseconds(m) >= first), None)

        return self.send_until(result, message)


@pytest.fixture
def camera(session):
    return Camera(session)


def nanoseconds(message):
    return message.header.stamp.sec * 1_000_000_000 + message.header.stamp.nanosec


def make_frame(seed=0, height=48, width=64):
    """A small frame with edges in it: (height, width, 3) uint8, bgr8."""
    rng = np.random.default_rng(seed)
    frame = np.full((height, width, 3), 30, np.uint8)
    for level in (90, 160, 230):
        row, col = rng.integers(0, height // 2), rng.integers(0, width // 2)
        frame[row : row + height // 3, col : col + width // 3] = level
    return frame + rng.integers(0, 8, frame.shape, dtype=np.uint8)


def contrasts():
    """A step that grows from left to right (low ends its edge), and separate squares (high selects some)."""
    frame = np.zeros((96, 256, 3), np.uint8)
    frame[72:] = np.arange(256, dtype=np.uint8)[None, :, None]
    for k, level in enumerate((30, 50, 100, 200)):
        frame[16:48, 16 + 60 * k : 48 + 60 * k] = level
    return frame


def message_of(frame, encoding="bgr8"):
    """A sensor_msgs/Image of the frame."""
    from sensor_msgs.msg import Image

    message = Image(height=frame.shape[0], width=frame.shape[1], encoding=encoding)
    message.step = frame.nbytes // frame.shape[0] if frame.size else 0
    message.data.frombytes(frame.tobytes())
    return message


def pixels(message):
    """The array in a mono8 or bgr8 message, read from its fields alone."""
    channels = {"mono8": 1, "bgr8": 3}[message.encoding]
    assert (message.step, message.is_bigendian) == (message.width * channels, 0)
    array = np.frombuffer(message.data, np.uint8).reshape(message.height, message.width, channels)
    return array[..., 0] if channels == 1 else array


@pytest.fixture
def tools():
    """The functions above, for the tests: in importlib mode a test cannot import conftest."""
    return SimpleNamespace(
        message_of=message_of,
        make_frame=make_frame,
        contrasts=contrasts,
        pixels=pixels,
        nanoseconds=nanoseconds,
        topic=TOPIC,
        processor=PROCESSOR,
        packages=PACKAGES,
        sources=SOURCES,
    )


class Parameters:
    """A node's parameters, through its ROS services."""

    def __init__(self, session, node_name):
        from rclpy.parameter_client import AsyncParameterClient

        self._client = AsyncParameterClient(session.node, node_name)
        assert self._client.wait_for_services(30.0)

    def get(self, *names):
        from rclpy.parameter import parameter_value_to_python

        return [
            parameter_value_to_python(value)
            for value in _response(lambda: self._client.get_parameters(names)).values
        ]

    def describe(self, *names):
        return _response(lambda: self._client.describe_parameters(names)).descriptors

    def set(self, **values):
        """Sets all or none: (whether they were accepted, the reason if not)."""
        from rclpy.parameter import Parameter

        request = [Parameter(name, value=value) for name, value in values.items()]
        result = _response(lambda: self._client.set_parameters_atomically(request)).result
        return result.successful, result.reason


def _response(call):
    """The response of a service. DDS may find the service before the way back: then a response is lost."""
    for _ in range(6):
        received = threading.Event()
        future = call()
        future.add_done_callback(lambda _, received=received: received.set())
        if received.wait(8.0):
            return future.result()
    pytest.fail("the node's parameter service does not answer")


@pytest.fixture
def parameters_of(session):
    return lambda node_name: Parameters(session, node_name)
