"""The room at 30 Hz with both nodes and a notebook that drives: is every frame there, and does nothing grow?

The room is a process of its own; the notebook (this process) receives odometry, depth and scan too, and
drives at random, with commands that are wrong now and then. Required: 29 images per second, of which none is
lost, no growth, and a room process that takes at most 80 % of a core.

Run it with `environment/test --benchmarks room_live`; MINUTES=1 in the environment makes it shorter than 10.
"""

import contextlib
import math
import os
import random
import threading
import time

import psutil

LEAST_RATE = 29.0
MOST_CPU = 80.0  # percent of a core
WRONG_COMMANDS = ((math.nan, 0.0), (math.inf, -math.inf), (1e9, -1e9))


class Streams:
    """Counts what arrives on the robot's topics, and what is lost."""

    def __init__(self):
        from nav_msgs.msg import Odometry
        from rclpy.event_handler import SubscriptionEventCallbacks
        from rclpy.qos import QoSProfile, ReliabilityPolicy
        from sensor_msgs.msg import Image, LaserScan

        from imgproc_course.ros import RosSession
        from imgproc_course.ros.robot_topics import ODOMETRY, SCAN
        from imgproc_course.ros.stream_statistics import LossCounter

        qos = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
        self.counts, self.losses = {}, {}
        session = RosSession.current()
        for name, kind, topic in (
            ("odometry", Odometry, ODOMETRY),
            ("depth", Image, f"/soak_{os.getpid()}/depth"),
            ("scan", LaserScan, SCAN),
        ):
            self.counts[name], self.losses[name] = 0, LossCounter()
            events = SubscriptionEventCallbacks(matched=self.losses[name].on_matched)
            session.node.create_subscription(
                kind, topic, lambda _, info, name=name: self.count(name, info), qos, event_callbacks=events
            )

    def count(self, name, info):
        self.counts[name] += 1
        self.losses[name].receive(info.get("publication_sequence_number"))


class Driver(threading.Thread):
    """Drives at random, ten commands a second, and measures in between: odometry's rate, the room's CPU."""

    def __init__(self):
        super().__init__(daemon=True)
        self.ended, self.samples = threading.Event(), []

    def run(self):
        from geometry_msgs.msg import Twist, Vector3
        from rclpy.exceptions import InvalidHandle

        from imgproc_course.ros import RosSession
        from imgproc_course.ros.robot_topics import COMMANDS

        streams, choose = Streams(), random.Random(1)
        publisher = RosSession().node.create_publisher(Twist, COMMANDS, 10)
        room = None
        while not self.ended.wait(0.1):
            room = room or next((p for p in psutil.Process().children() if is_room(p)), None)
            speeds = (
                choose.choice(WRONG_COMMANDS)
                if choose.random() < 0.01
                else (choose.uniform(-0.1, 0.3), choose.uniform(-1, 1))
            )
            with contextlib.suppress(InvalidHandle):  # the soak has ended
                publisher.publish(Twist(linear=Vector3(x=speeds[0]), angular=Vector3(z=speeds[1])))
            if room is not None and room.is_running():
                cpu = sum(room.cpu_times()[:2])
                lost = {name: losses.total for name, losses in streams.losses.items()}
                self.samples.append((time.monotonic(), cpu, dict(streams.counts), lost))


def is_room(process):
    return "bench_soak import publish" in " ".join(process.cmdline())


def main():
    os.environ.setdefault("ROS_DOMAIN_ID", "97")
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    from bench_soak import MINUTES, soak

    driver = Driver()
    driver.start()
    code = soak("room")
    driver.ended.set()
    driver.join()
    end = driver.samples[-20][0] if len(driver.samples) > 20 else 0.0
    measured = [sample for sample in driver.samples if end - 60 * MINUTES < sample[0] < end]
    (start, cpu_before, counts_before, lost_before), (stop, cpu, counts, lost) = measured[0], measured[-1]
    share = 100 * (cpu - cpu_before) / (stop - start)
    print(f"the room's process: {share:.0f} % of a core")
    for name in counts:
        rate = (counts[name] - counts_before[name]) / (stop - start)
        missing = lost[name] - lost_before[name]
        print(f"{name}: {rate:.2f} per second, {missing} lost")
        code = code or rate < LEAST_RATE or missing > 0
    code = code or share > MOST_CPU
    print("FAILED" if code else "every frame, no growth")
    return int(code)


if __name__ == "__main__":
    raise SystemExit(main())
