"""The real command `ros2` with the course's nodes, and with the package that `ros2 pkg create` makes.

It needs ROS 2 Jazzy's `ros2`: on the PATH, or its path in ROS2; without one it only says so. The made package
gets a node with a parameter, is built by colcon and run by `ros2 run`.

Run it with `environment/test --benchmarks ros2`. It shows what each command prints.
"""

import contextlib
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

from imgproc_course.ros import open_camera

ROS2 = os.environ.get("ROS2") or shutil.which("ros2")
PACKAGES = Path(__file__).parents[2] / "environment" / "ros2_ws" / "src"
TIMEOUT = 180.0  # seconds that a command may take, on a busy machine too
CREATE = "pkg create bright_pixels --build-type ament_python --node-name bright_pixels --dependencies rclpy"
HZ = "topic hz /kachaka/front_camera/image_raw/compressed"
NODE = """\
import rclpy
from imgproc_course.messages import array_to_image, image_to_array
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image


class BrightPixels(Node):
    def __init__(self):
        super().__init__("bright_pixels")
        self.declare_parameter("level", 100)
        self.publisher = self.create_publisher(Image, "~/bright", qos_profile_sensor_data)
        topic = "/kachaka/front_camera/image_raw"
        self.create_subscription(Image, topic, self.on_image, qos_profile_sensor_data)

    def on_image(self, msg):
        bright = image_to_array(msg, "mono8") > self.get_parameter("level").value
        self.publisher.publish(array_to_image(bright.astype("uint8") * 255, "mono8", msg.header))


def main():
    rclpy.init()
    rclpy.spin(BrightPixels())
"""
# What each command must print, as a regular expression.
OF_ALL = {
    "topic list": "/kachaka/front_camera/image_raw\n",
    HZ: r"average rate: [0-9.]+",
    "pkg executables bright_pixels": "bright_pixels bright_pixels",
    "node list": "(?s)/bright_pixels\n.*/image_edge_detection\n",
    "param get /image_edge_detection low": "Integer value is: 50",
    "param set /image_edge_detection low 20": "Set parameter successful",
    "param get /image_edge_detection low ": "Integer value is: 20",
    "param set /bright_pixels level 200": "Set parameter successful",
    "param set /bright_pixels level 99.5": "Setting parameter failed: Wrong parameter type",
    "topic echo --once --no-arr /bright_pixels/bright": "encoding: mono8",
    "topic info /image_edge_detection/edges": "Type: sensor_msgs/msg/Image",
}


def run(command, environment, folder, until=None):
    """What a command prints, up to its end or to the first line in which `until` is found."""
    options = {"env": environment, "cwd": folder, "text": True, "stdout": subprocess.PIPE}
    with subprocess.Popen(command, stderr=subprocess.STDOUT, start_new_session=True, **options) as process:
        timer = threading.Timer(TIMEOUT, os.killpg, (process.pid, signal.SIGKILL))
        timer.start()
        printed = ""
        for line in process.stdout:
            printed += line
            if until and re.search(until, line):
                os.killpg(process.pid, signal.SIGINT)
                break
        timer.cancel()
    return printed


def sourced(folder):
    """The environment after `source install/setup.bash`."""
    line = ["bash", "-c", "source install/setup.bash && env -0"]
    printed = subprocess.run(line, cwd=folder, capture_output=True, check=True, text=True).stdout
    return {name: value for name, _, value in (entry.partition("=") for entry in printed.split("\0"))} | {
        "PYTHONUNBUFFERED": "1"
    }


def build(folder):
    """A workspace with the course's packages and the one that `ros2 pkg create` makes; what that prints."""
    shutil.copytree(PACKAGES, folder / "src")
    printed = run([ROS2, *CREATE.split()], None, folder / "src")
    (folder / "src" / "bright_pixels" / "bright_pixels" / "bright_pixels.py").write_text(NODE)
    subprocess.run([sys.executable, "-m", "colcon", "build"], cwd=folder, check=True, capture_output=True)
    return printed


def main():
    if not ROS2:
        print("there is no ros2 on the PATH: install ROS 2 Jazzy, or give the path of its command in ROS2")
        return 0
    with tempfile.TemporaryDirectory() as name, contextlib.ExitStack() as stack:
        folder = Path(name)
        printed = {CREATE: build(folder)}
        environment = sourced(folder)
        stack.enter_context(open_camera())
        for package in ("bright_pixels", "image_edge_detection"):
            command = [ROS2, "run", package, package]
            quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
            node = subprocess.Popen(command, env=environment, start_new_session=True, **quiet)
            stack.callback(node.wait)
            stack.callback(os.killpg, node.pid, signal.SIGINT)
        stack.callback(run, [ROS2, "daemon", "stop"], environment, folder)
        for command, expected in OF_ALL.items():
            until = expected if command == HZ else None
            printed[command] = run([ROS2, *command.split()], environment, folder, until)
    wrong = [command for command, expected in OF_ALL.items() if not re.search(expected, printed[command])]
    for command, text in printed.items():
        print(f"\n$ ros2 {command}{'   <-- not as expected' if command in wrong else ''}\n{text.rstrip()}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
