"""A person before a webcam: the lesson's node HandCamera publishes drawn hands on /webcam/image_raw.

    python tests/ros/show_gestures.py SECONDS SEED     ends after so many seconds of images

It prints a line for each gesture: its name, and the times of its first and its last image (time.time()).
"""

import sys
import time

import numpy as np
from lesson_nodes import lesson_definitions, run_assignments, spin

RATE = 10  # images per second: the node's timer
# "palm after" is a palm while the robot turns: it follows the swipe before it after half a second.
ALL = ("swipe left", "swipe right", "raise", "wave", "circle", "stop", "palm")
CUT_SHORT = (("swipe left", "palm after"), ("swipe right", "palm after"))
PAUSE = 30  # images without a hand: the robot turns by 45 degrees meanwhile


def shown_frames(lesson, seconds, seed):
    """The frames of all gestures in any order, again and again, with pauses."""
    rng, left = np.random.default_rng(seed), round(seconds * RATE)
    background = lesson["background"]
    turns = [(gesture,) for gesture in ALL] + list(CUT_SHORT)
    yield from [background] * PAUSE
    while True:
        for number in rng.permutation(len(turns)):
            for gesture in turns[number]:
                frames = list(lesson["gesture_frames"](gesture.removesuffix(" after"), rng))
                frames = [frame for frame in frames if frame is not background]
                begin = time.time()
                yield from frames
                print(gesture, begin, time.time(), sep="\t", flush=True)
                is_cut_short = len(turns[number]) == 2 and gesture != "palm after"
                pause = [background] * (RATE // 2 if is_cut_short else PAUSE)
                yield from pause
                left -= len(frames) + len(pause)
            if left < 0:
                return


if __name__ == "__main__":
    names = run_assignments("gestures", {"recording", "background"}, lesson_definitions("gestures"))
    frames = shown_frames(names, float(sys.argv[1]), int(sys.argv[2]))
    spin(
        lambda: names["HandCamera"](frames),
        lambda node: node.frames.gi_frame is None,
        lambda node: f"images\t{node.sent}",
    )
