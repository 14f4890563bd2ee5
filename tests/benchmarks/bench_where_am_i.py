"""Where am I: the lesson's node for a minute of circles in the room; errors of its path, and of the wheels'.

Required: no bump, and the subscriber receives what the node publishes.

Run it with `environment/test --benchmarks where_am_i`; SECONDS_IN_THE_ROOM=20 is shorter.
"""

import numpy as np
from in_the_room import ODOMETRY, SECONDS, TRUTH, circles_in_the_room, nearest, verdict
from nav_msgs.msg import Odometry

from imgproc_course.geometry import Pose, ate

START = (0.3, -0.7, 0.0)
SEEN = "/visual_odometry/odometry"


def places(topics):
    """True places (N, 3), those of the node, and those of the wheels, from the node's first on."""
    true, seen, counted = map(topics.poses, (TRUTH, SEEN, ODOMETRY))
    stamps = [stamp for stamp in true if stamp in seen]
    start = Pose.planar(*START)
    return (
        np.array([true[stamp].position for stamp in stamps]),
        start.apply([seen[stamp].position for stamp in stamps]),
        start.apply([nearest(counted, stamp).position for stamp in stamps]),
    )


def print_live():
    """Prints a minute of circles in the room; whether it failed."""
    topics, printed, bumps = circles_in_the_room(
        "where_am_i", START, {SEEN: Odometry}, lambda topics: topics.count(SEEN), angular=0.3
    )
    looks, received = int(printed), topics.count(SEEN)
    true, seen, wheels = places(topics)
    way = np.linalg.norm(np.diff(true, axis=0), axis=1).sum()
    print(
        f"{SECONDS:.0f} s live, way {way:.1f} m: {looks} looks, {received} Odometry received, {bumps} bumps; "
        f"ATE {100 * ate(seen, true):.0f} cm, by the wheels {100 * ate(wheels, true):.0f} cm"
    )
    return bumps > 0 or looks - received > 0.05 * looks


if __name__ == "__main__" and SECONDS:
    raise SystemExit(verdict(print_live()))
