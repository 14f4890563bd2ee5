"""Both nodes on 1280×720 at 30 Hz, the camera in another process, compared with the original lesson's nodes.

For each node: images sent; images processed (results by the node's own numbers, which are all images that
reached it); results delivered here; and the time from the stamp of an image to the publication of its result.
The lesson's callbacks use a plain conversion and OpenCV's functions; they publish too, so the work is equal.

Run it with `environment/test --benchmarks nodes`; SECONDS=60 in the environment makes each run longer.
"""

import collections
import contextlib
import os
import subprocess
import sys
import time

import numpy as np
from bench_soak import node_command
from rich.console import Console
from rich.table import Table

TOPIC = "/kachaka/front_camera/image_raw"
SECONDS = float(os.environ.get("SECONDS", "10"))
ROUNDS = 2
WARM_UP = 3.0
PLAY = "from imgproc_course.ros.player import play; play(speed=3.0)"
# The callback of the lesson's page, with a publisher instead of imshow.
LESSON = """
import signal, sys, time
import imgproc_course.ros  # chooses the DDS profile, so that the same images arrive
import cv2, numpy as np, rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy, DurabilityPolicy
from sensor_msgs.msg import Image

QOS = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT, durability=DurabilityPolicy.VOLATILE)
CANNY = sys.argv[1] == "edges"

class Lesson(Node):
    def __init__(self):
        super().__init__("lesson")
        self.sender = self.create_publisher(Image, "~/result", QOS)
        self.create_subscription(Image, "/kachaka/front_camera/image_raw", self.on_image, QOS)

    def on_image(self, msg):
        frame = np.frombuffer(msg.data, np.uint8).reshape(msg.height, msg.width, 3)
        result = cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY)
        if CANNY:
            result = cv2.Canny(result, 50, 150)
        output = Image(header=msg.header, height=msg.height, width=msg.width, step=msg.width)
        output.encoding = "mono8"
        output.data.frombytes(result.data)
        self.sender.publish(output)

# Ctrl-C ends ROS, and with it spin. It must not raise KeyboardInterrupt too, in the middle of an image.
signal.signal(signal.SIGINT, lambda *_: None)
rclpy.init()
node = Lesson()
try:
    rclpy.spin(node)
except (KeyboardInterrupt, rclpy.executors.ExternalShutdownException):
    pass
except RuntimeError:
    if rclpy.ok():  # else Ctrl-C has ended ROS in the middle of a call, such as publish
        raise
finally:
    node.destroy_node()
    rclpy.try_shutdown()
"""
COMMANDS = {
    "gray, the lesson's node": ([sys.executable, "-c", LESSON, "gray"], "/lesson/result"),
    "gray, image_gray_processor": (
        node_command("image_gray_processor"),
        "/image_gray_processor/gray",
    ),
    "edges, the lesson's node": ([sys.executable, "-c", LESSON, "edges"], "/lesson/result"),
    "edges, image_edge_detection": (
        node_command("image_edge_detection"),
        "/image_edge_detection/edges",
    ),
}


def main():
    from imgproc_course.ros import RosSession

    results = collections.defaultdict(list)
    with RosSession.current() as session, camera():
        for _ in range(ROUNDS):
            for name, (command, topic) in COMMANDS.items():
                results[name].append(measure(session, command, topic))
    return report(results)


@contextlib.contextmanager
def camera():
    with process([sys.executable, "-c", PLAY]):
        yield


@contextlib.contextmanager
def process(command):
    running = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield running
    finally:
        running.terminate()
        running.wait()


def measure(session, command, topic):
    """One run: a dict of sent, processed, delivered, and latencies in seconds."""
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import Image

    latencies, sequence = [], []

    def on_result(msg, info):
        stamp = msg.header.stamp.sec * 1_000_000_000 + msg.header.stamp.nanosec
        latencies.append((info["source_timestamp"] - stamp) / 1e9)
        sequence.append((stamp, info["publication_sequence_number"]))

    with process(command):
        subscription = session.run(
            lambda: session.node.create_subscription(Image, topic, on_result, qos_profile_sensor_data)
        )
        end = time.monotonic() + 60
        while not latencies:
            if time.monotonic() > end:
                raise SystemExit(f"nothing came on {topic} in 60 s")
            time.sleep(0.05)
        time.sleep(WARM_UP)
        latencies.clear()
        sequence.clear()
        time.sleep(SECONDS)
        run_latencies, run_sequence = list(latencies), list(sequence)
        session.run(lambda: session.node.destroy_subscription(subscription))
    span = (run_sequence[-1][0] - run_sequence[0][0]) / 1e9
    return {
        "sent": round(span * 30) + 1,  # the camera's stamps are 1/30 s apart
        "processed": run_sequence[-1][1] - run_sequence[0][1] + 1,
        "delivered": len(run_sequence),
        "latencies": run_latencies,
    }


def report(results):
    table = Table("node", "sent", "processed", "result delivered", "median ms", "99 % ms")
    shares = {}
    for name, runs in results.items():
        sent, processed, delivered = (
            sum(run[key] for run in runs) for key in ("sent", "processed", "delivered")
        )
        median, slowest = np.percentile(np.concatenate([run["latencies"] for run in runs]) * 1e3, (50, 99))
        shares[name] = processed / sent
        table.add_row(name, str(sent), str(processed), str(delivered), f"{median:.1f}", f"{slowest:.1f}")
    Console(width=110).print(table)
    behind = []
    for kind in ("gray", "edges"):
        course_node, lesson_node = (
            next(name for name in shares if name.startswith(kind) and part in name)
            for part in ("image_", "lesson")
        )
        # On a busy machine even the lesson's node falls behind, so only the ratio counts.
        ratio = shares[course_node] / shares[lesson_node]
        verdict = "kept" if ratio >= 0.98 else "OVER"
        print(
            f"{kind}: {shares[course_node]:.1%} processed, the lesson's {shares[lesson_node]:.1%}: "
            f"{verdict} (0.98 of it)"
        )
        if ratio < 0.98:
            behind.append(kind)
    return 1 if behind else 0


if __name__ == "__main__":
    raise SystemExit(main())
