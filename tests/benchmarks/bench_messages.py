"""Message conversion compared with the plain operations: np.frombuffer, cv2.cvtColor, memcpy.

Budgets: passthrough 1280×720 at most 2.5 × np.frombuffer and no copy; to another encoding at most 1.2 × the
bare cv2.cvtColor; array_to_image at most 1.3 × a copy of the pixels into fresh memory, with and without
ROS_PYTHON_CHECK_FIELDS=1.
"""

import os
import subprocess
import sys
import timeit

import cv2
import numpy as np
from rich.console import Console
from side_by_side import print_ratios, time_in_turns

from imgproc_course.messages import array_to_image, image_to_array

HEIGHT, WIDTH = 720, 1280
PASSTHROUGH_BUDGET = 2.5  # times np.frombuffer(...).reshape
CONVERSIONS = {
    ("rgb8", "bgr8"): cv2.COLOR_RGB2BGR,
    ("bgr8", "mono8"): cv2.COLOR_BGR2GRAY,
    ("bgr8", "bgra8"): cv2.COLOR_BGR2BGRA,
    ("mono8", "bgr8"): cv2.COLOR_GRAY2BGR,
    ("bayer_rggb8", "bgr8"): cv2.COLOR_BayerBG2BGR,
    ("uyvy", "bgr8"): cv2.COLOR_YUV2BGR_UYVY,
    ("nv12", "bgr8"): cv2.COLOR_YUV2BGR_NV12,
}
console = Console(width=110)


def frame_of(channels, rows=HEIGHT):
    shape = (rows, WIDTH) if channels == 1 else (rows, WIDTH, channels)
    return np.random.default_rng(0).integers(0, 256, shape, dtype=np.uint8)


def passthrough():
    """Prints the time of a view, which must share the memory of the message."""
    msg = array_to_image(frame_of(3), "bgr8")
    view = image_to_array(msg)
    is_copy = not np.shares_memory(view, np.frombuffer(msg.data, np.uint8))
    ways = {
        "bare np.frombuffer(...).reshape": lambda: np.frombuffer(msg.data, np.uint8).reshape(
            HEIGHT, WIDTH, 3
        ),
        "image_to_array": lambda: image_to_array(msg),
    }
    # One call is too short for the clock, and other programs on the machine must not count: take the fastest
    # of many short batches.
    seconds = {name: [] for name in ways}
    for _ in range(400):
        for name, way in ways.items():
            seconds[name].append(timeit.timeit(way, number=100) / 100)
    fastest = {name: min(times) for name, times in seconds.items()}
    over = print_ratios(
        "passthrough, 1280×720 bgr8",
        fastest,
        "bare np.frombuffer(...).reshape",
        {"image_to_array": PASSTHROUGH_BUDGET},
    )
    console.print("a COPY" if is_copy else "no copy")
    return over + ["passthrough"] * is_copy


def conversions():
    over = []
    for (source, desired), code in CONVERSIONS.items():
        rows = HEIGHT * 3 // 2 if source == "nv12" else HEIGHT
        channels = {"rgb8": 3, "bgr8": 3, "uyvy": 2}.get(source, 1)
        frame = frame_of(channels, rows)
        msg = array_to_image(frame, source)
        ways = {
            "bare cv2.cvtColor": lambda frame=frame, code=code: cv2.cvtColor(frame, code),
            "image_to_array": lambda msg=msg, desired=desired: image_to_array(msg, desired),
        }
        medians = time_in_turns(ways, rounds=150)
        over += print_ratios(
            f"{source} -> {desired}, 1280×720", medians, "bare cv2.cvtColor", {"image_to_array": 1.2}
        )
    return over


def to_messages():
    """Compares with the copy that every message needs: into newly allocated memory."""
    over = []
    checks = os.environ.get("ROS_PYTHON_CHECK_FIELDS", "0")
    for channels, encoding, budget in ((3, "bgr8", 1.3), (1, "mono8", None)):
        frame = frame_of(channels)
        ways = {
            "memcpy: array.tobytes()": lambda frame=frame: frame.tobytes(),
            "array_to_image": lambda frame=frame, encoding=encoding: array_to_image(frame, encoding),
        }
        title = f"array_to_image, 1280×720 {encoding}, ROS_PYTHON_CHECK_FIELDS={checks}"
        medians = time_in_turns(ways, rounds=500)
        over += print_ratios(title, medians, "memcpy: array.tobytes()", {"array_to_image": budget})
    return over


def main():
    if "--to-messages" in sys.argv:
        return bool(to_messages())
    cv2.setNumThreads(1)
    over = passthrough() + conversions()
    for checks in ("0", "1"):
        environment = {**os.environ, "ROS_PYTHON_CHECK_FIELDS": checks}
        over += ["array_to_image"] * subprocess.run(
            [sys.executable, __file__, "--to-messages"], env=environment
        ).returncode
    if over:
        console.print(f"over budget: {', '.join(over)}")
    return bool(over)


if __name__ == "__main__":
    sys.exit(main())
