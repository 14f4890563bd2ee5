"""Tracking the ball: the lesson's node for a minute in the room, from three starts.

Required: no bump, and the ball at the distance asked for.

Run it with `environment/test --benchmarks tracking`; SECONDS_IN_THE_ROOM=20 is shorter.
"""

import math

from geometry_msgs.msg import PoseStamped, Twist
from in_the_room import SECONDS, Topics, program, room, verdict

STARTS = ((1, (0.0, 0.0, 0.2)), (2, (0.4, 0.6, -0.2)), (3, (1.3, 0.2, 0.0)))
RESULTS = {"/ball": PoseStamped, "/kachaka/manual_control/cmd_vel": Twist}
BALL, CAMERA = "/truth/pose/ball", "/truth/pose/camera"
KEPT, TOLERANCE = 0.8, 0.15  # metres between camera and ball


def follow(seed, start):
    """Prints a minute in the room; whether it failed."""
    with room(start, seed, rate=10) as live:
        topics = Topics(RESULTS | {BALL: PoseStamped, CAMERA: PoseStamped})
        with program("lesson_nodes.py", "object_tracking", SECONDS) as node:
            node.process.wait()
        bumps = live.bumps()
    balls, cameras = topics.poses(BALL), topics.poses(CAMERA)
    kept = [math.dist(balls[s].position[:2], cameras[s].position[:2]) for s in balls if s in cameras]
    print(
        f"seed {seed} from {start}: {node.printed.strip()} looks; received: "
        f"{', '.join(f'{kind.__name__} {topics.count(topic)}' for topic, kind in RESULTS.items())}; "
        f"distance kept {kept[-1]:.2f} m (least {min(kept):.2f}); {bumps} bumps",
        flush=True,
    )
    return bumps > 0 or abs(kept[-1] - KEPT) > TOLERANCE


if __name__ == "__main__" and SECONDS:
    has_failed = False
    for number, place in STARTS:
        has_failed |= follow(number, place)
    raise SystemExit(verdict(has_failed))
