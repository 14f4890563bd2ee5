"""Gestures: the lesson's node for a minute in the room.

Printed: which gestures were shown, recognised and obeyed, and what a subscriber received.

Required: 9 of 10 gestures are recognised, all of these are obeyed, and nothing is bumped. The lesson asserts
how many fingers are counted right.

Run it with `environment/test --benchmarks gestures`; SECONDS_IN_THE_ROOM=20 is shorter.
"""

import math

import numpy as np
from geometry_msgs.msg import PoseStamped, Twist
from in_the_room import SECONDS, Topics, pose_of, print_rows, program, room, verdict, wait_for
from std_msgs.msg import String

START = (1.2, 0.2, 0.0)
COMMANDS, NAMES, POSE = "/kachaka/manual_control/cmd_vel", "/gestures/gesture", "/truth/pose/robot"
DEGREES, TOLERANCE, STILL = 45, 6, 1.5  # of a swipe; its largest error; how much the robot may turn otherwise
SETTLING = 0.8  # seconds after which a robot that was stopped stands


def turned(topics, begin, end):
    """By how many degrees the robot has turned to the left between two times."""
    rotations = np.array([pose_of(msg).rotation for msg in topics.messages[POSE]])
    yaws = np.unwrap(np.arctan2(rotations[:, 1, 0], rotations[:, 0, 0]))
    first, last = np.interp((begin, end), topics.times[POSE][: len(yaws)], yaws)
    return math.degrees(last - first)


def reaction(gesture, begin, following, topics):
    """(by how many degrees the robot turned, whether this is what the gesture asks for)."""
    if gesture.startswith("swipe"):
        angle = turned(topics, begin, following[1])
        error = angle - (DEGREES if gesture == "swipe left" else -DEGREES)
        if following[0] == "palm after":  # it has begun to turn
            return angle, math.copysign(1, error) != math.copysign(1, angle) and abs(angle) > STILL
        return angle, abs(error) < TOLERANCE
    angle = turned(topics, begin + SETTLING * gesture.startswith("palm"), following[1])
    return angle, abs(angle) < STILL


def print_gestures(shown, topics):
    """Prints each gesture with what followed; (how many were recognised, how many of these obeyed)."""
    rows, recognised, obeyed = [], 0, 0
    arrivals = list(zip(topics.times[NAMES], topics.messages[NAMES], strict=True))
    for k, (gesture, begin, end) in enumerate(shown):
        following = shown[k + 1] if k + 1 < len(shown) else ("", end + 3)
        names = [msg.data for when, msg in arrivals if begin < when < following[1]]
        angle, is_as_asked = reaction(gesture, begin, following, topics)
        name = gesture.removesuffix(" after")
        is_obeyed = name == "palm" or name.startswith("swipe")  # others may be none of the six
        is_recognised = names == [name] or not (names or is_obeyed)
        recognised += is_recognised
        obeyed += is_recognised and is_as_asked
        rows.append((gesture, ", ".join(names), f"{angle:.1f}°", "yes" if is_as_asked else "NO"))
    print_rows(rows, "shown", "recognised", "then turned by", "as asked")
    return recognised, obeyed


def print_live():
    """Prints a minute in which the robot obeys a person of another process; whether it failed."""
    with room(START, rate=10) as live:
        topics = Topics({NAMES: String, COMMANDS: Twist, POSE: PoseStamped})
        with program("lesson_nodes.py", "gestures") as node:
            wait_for(lambda: topics.node.count_publishers(NAMES), node)
            with program("show_gestures.py", SECONDS, 0) as person:
                person.process.wait()
        bumps = live.bumps()
    *lines, (_, sent) = (line.split("\t") for line in person.printed.splitlines())
    shown = [(name, float(begin), float(end)) for name, begin, end in lines]
    recognised, obeyed = print_gestures(shown, topics)
    print(
        f"{SECONDS:.0f} s live: {sent} images sent, {int(node.printed)} looks, {topics.count(COMMANDS)} "
        f"commands received; {len(shown)} gestures shown, {recognised} recognised, {obeyed} of these obeyed; "
        f"{bumps} bumps"
    )
    return bumps > 0 or recognised < 0.9 * len(shown) or obeyed < recognised


if __name__ == "__main__" and SECONDS:
    raise SystemExit(verdict(print_live()))
