"""The solution of obstacles-drive in the node of its lesson, and in RoomEnv: bumps, goal, and how far apart.

Drives of 40 s, in real time: in room 17, and in hidden scenarios of the exercise. Nothing else moves there.
Required: no bump, and the goal is reached. The two paths need not be the same, as messages come late.

Run it with `environment/test --benchmarks control_in_room`; DRIVES=3 in the environment says how many.
"""

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "ros"))
DRIVES = int(os.environ.get("DRIVES", "3"))
SECONDS = 40.0


def scenarios(exercise):
    from test_control_in_room import SCENARIO

    yield SCENARIO | {"duration": SECONDS}
    for seed in range(1, DRIVES):
        yield exercise.arguments(exercise.hidden[0], seed)[0][0]


def main():
    os.environ.setdefault("ROS_DOMAIN_ID", "95")
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    from control_in_room import drive_in_env, drive_in_ros, exercise, farthest, is_in

    from imgproc_course.ros import RosSession

    failed = False
    for scenario in scenarios(exercise()):
        path, info = drive_in_env(scenario)
        places, bumps = drive_in_ros(RosSession.current(), scenario, lambda room: room.time > SECONDS)
        to_goal = next((k for k, place in enumerate(places) if is_in(scenario["goal"], place)), None)
        failed |= bumps > 0 or to_goal is None
        until = farthest(places[:to_goal], path)
        print(
            f"room {scenario['room']}: {bumps} bumps in ROS, {info['bumps']} in RoomEnv (goal after"
            f" {info['goal_time']} s); apart at most {until:.2f} m on the way to the goal,"
            f" {farthest(places, path):.2f} m in all",
            flush=True,
        )
    print("FAILED" if failed else "no bumps, every goal reached")
    return int(failed)


if __name__ == "__main__":
    raise SystemExit(main())
