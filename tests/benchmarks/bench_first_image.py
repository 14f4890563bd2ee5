"""The first image after `open_camera()`, in fresh processes, with and without the profile's announcements.

The receivers: an ImageSubscriber, as in a notebook; a plain rclpy subscription in a script that imports
imgproc_course.ros; the result of a node that its console script has started, and that waits for 4 s. Each
start has a fresh robot process. The peer is the same start with a profile without <builtin>.
Budget: within 0.7 s in every start. Run it on a quiet machine: it prints the load.
"""

import argparse
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from bench_soak import node_command
from rich.console import Console
from rich.table import Table

from imgproc_course.ros.profile import LARGE, PROFILE_VARIABLES

BUDGET = 0.7  # seconds
NODE = "image_gray_processor"
START = """
import time
from imgproc_course.ros import ImageSubscriber, RosSession, open_camera
{before}
camera = open_camera()
opened = time.monotonic()
{receive}
print("seconds", time.monotonic() - opened)
"""
RECEIVERS = {
    "notebook": ("", "ImageSubscriber(camera.topic).wait(30)"),
    "plain script": (
        "import rclpy\nfrom rclpy.qos import qos_profile_sensor_data\nfrom sensor_msgs.msg import Image\n"
        "rclpy.init()",
        "images = []; node = rclpy.create_node('plain')\n"
        "node.create_subscription(Image, camera.topic, images.append, qos_profile_sensor_data)\n"
        "while not images: rclpy.spin_once(node, timeout_sec=1)",
    ),
    "console script": (
        f"result = ImageSubscriber('/{NODE}/gray')\nwhile not result.matched: time.sleep(0.01)\n"
        "time.sleep(4)",
        "result.wait(30)",
    ),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--starts", type=int, default=20, help="of each receiver")
    starts = parser.parse_args().starts
    os.environ.setdefault("ROS_DOMAIN_ID", "94")
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    load_before = os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as folder:
        peer = Path(folder) / "without_announcements.xml"
        peer.write_text(re.sub(r"<builtin>.*</builtin>", "", LARGE.read_text(), flags=re.DOTALL))
        profiles = {"": LARGE, ", without": peer}
        seconds = {receiver + name: [] for receiver in RECEIVERS for name in profiles}
        for _ in range(starts):
            for receiver in RECEIVERS:
                for name, profile in profiles.items():
                    seconds[receiver + name].append(measure(receiver, profile))
    print(f"load {load_before:.1f} before, {os.getloadavg()[0]:.1f} after, {os.cpu_count()} processors")
    return report(seconds)


def measure(receiver, profile):
    """Seconds from the return of `open_camera()` to the first image, in fresh processes."""
    before, receive = RECEIVERS[receiver]
    environment = os.environ | dict.fromkeys(PROFILE_VARIABLES, str(profile))
    command = [sys.executable, "-c", START.format(before=before, receive=receive)]
    node = None
    if receiver == "console script":
        output = subprocess.DEVNULL
        node = subprocess.Popen(node_command(NODE), env=environment, stdout=output, stderr=output)
    try:
        output = subprocess.run(
            command, env=environment, stdout=subprocess.PIPE, text=True, check=True
        ).stdout
    finally:
        if node is not None:
            node.terminate()
            node.wait()
    return float(output.split()[-1])


def report(seconds):
    table = Table("start", f"within {BUDGET} s", "median s", "longest s", "× without announcements, mean")
    for name, times in seconds.items():
        in_time = f"{sum(time <= BUDGET for time in times)} of {len(times)}"
        peer = seconds[f"{name.partition(',')[0]}, without"]
        ratio = f"{statistics.mean(times) / statistics.mean(peer):.2f}"
        table.add_row(name, in_time, f"{statistics.median(times):.2f}", f"{max(times):.2f}", ratio)
        print(f"{name}: {' '.join(f'{time:.2f}' for time in sorted(times))}")
    Console(width=110).print(table)
    kept = all(max(seconds[receiver]) <= BUDGET for receiver in RECEIVERS)
    print("budget kept" if kept else "OVER BUDGET")
    return 0 if kept else 1


if __name__ == "__main__":
    raise SystemExit(main())
