"""Mapping and SLAM: the lesson's node for a minute in the room, with each seed.

Required: no bump, a loop is closed, the path errs less than with the wheels, and the subscriber receives what
the node published. The lesson asserts the map before and after its closure.

Run it with `environment/test --benchmarks mapping`; SECONDS_IN_THE_ROOM=20 is shorter.
"""

import numpy as np
from in_the_room import ODOMETRY, SECONDS, TRUTH, circles_in_the_room, nanoseconds, nearest, verdict
from nav_msgs.msg import OccupancyGrid
from nav_msgs.msg import Path as PathMessage

from imgproc_course.geometry import Pose, ate

SEEDS = (1, 2, 3)
START = (0.45, -1.0, 0.0)
MAP, PATH = "/map", "/mapping/path"


def path_errors(topics):
    """(metres of the true way, ATE in cm by the wheels, ATE of the node) of the keyframes."""
    true, counted, paths = topics.poses(TRUTH), topics.poses(ODOMETRY), topics.messages[PATH]
    stamps = {len(path.poses) - 1: nanoseconds(path) for path in paths}  # the newest pose of each
    known = [k for k, stamp in stamps.items() if stamp in true]
    truth = np.array([true[stamps[k]].position for k in known])
    start, newest = Pose.planar(*START), [pose.pose.position for pose in paths[-1].poses]
    mapped = start.apply([(newest[k].x, newest[k].y, 0.0) for k in known])
    wheels = start.apply([nearest(counted, stamps[k]).position for k in known])
    way = np.linalg.norm(np.diff(truth, axis=0), axis=1).sum()
    return way, *(100 * ate(places[:, :2], truth[:, :2]) for places in (wheels, mapped))


def print_live(seed):
    """Prints a minute of circles in the room, with the node in another process; whether it failed."""
    kinds = {MAP: OccupancyGrid, PATH: PathMessage}
    topics, printed, bumps = circles_in_the_room(
        "mapping_and_slam", START, kinds, lambda topics: topics.node.count_publishers(PATH), seed=seed
    )
    _, keyframes, loops = map(int, printed.split())
    way, before, after = path_errors(topics)
    print(
        f"{SECONDS:.0f} s live, seed {seed}, way {way:.1f} m: {keyframes} keyframes, {loops} loops; "
        f"received: {topics.count(MAP)} OccupancyGrid, {topics.count(PATH)} Path; {bumps} bumps; ATE of the "
        f"keyframes {after:.1f} cm, by the wheels {before:.1f} cm"
    )
    lost = max(abs(topics.count(topic) - keyframes) for topic in (MAP, PATH))
    return bumps > 0 or lost > 0.05 * keyframes or not loops or after > before


if __name__ == "__main__" and SECONDS:
    has_failed = False
    for number in SEEDS:
        has_failed |= print_live(number)
    raise SystemExit(verdict(has_failed))
