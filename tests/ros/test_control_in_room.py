"""The node of the lesson on obstacles: the same `control` drives the robot in ROS as in RoomEnv."""

import math
from pathlib import Path

import pytest

pytestmark = pytest.mark.ros

ROOM, START = 17, (3.6, 0.6, -2.6)
GOAL = (START[0] + 2.2 * math.cos(START[2]), START[1] + 2.2 * math.sin(START[2]), 0.6)


@pytest.fixture
def body(session):
    """The robot in this process, in a room in which nothing moves but the robot."""
    from imgproc_course.ros.robot_topics import TOPIC
    from imgproc_course.ros.room_images import RoomImages
    from imgproc_course.ros.room_publisher import RoomPublisher

    images = RoomImages(10, room=ROOM, start=START, seed=1, size=(640, 360), lighting="day", movers=False)
    body = RoomPublisher(TOPIC, images)
    body.start()
    yield body
    body.stop()


def test_the_lessons_node_drives_to_the_goal_as_in_the_environment(body, session, wait_until, monkeypatch):
    monkeypatch.syspath_prepend(Path(__file__).parent)
    from control_in_room import control_node, path_in_env

    path, info = path_in_env(ROOM, START, GOAL)
    assert info["bumps"] == 0 and info["goal_time"] is not None
    node = session.add_node(control_node(session.context))
    images = body._images
    places = []

    def is_at_goal():
        x, y, _ = images.simulation.place
        places.append((x, y))
        return math.dist((x, y), GOAL[:2]) < GOAL[2]

    wait_until(is_at_goal, 150)
    session.remove_node(node)
    assert images.bumps == 0
    assert max(min(math.dist(place, known[:2]) for known in path) for place in places) < 0.5
