"""The solution of obstacles-drive drives the robot twice: by the node of its lesson, and in RoomEnv."""

import math
import time

from lesson_nodes import MASTERS, lesson_definitions
from nbclassroom.exercises.declaration import read_exercises

from imgproc_course.simulation.room_env import OPTIONS, RoomEnv, controller_observation


def exercise():
    (master,) = MASTERS.glob("*_obstacles_ahead.py")
    (found,) = (e for e in read_exercises(master) if e.id == "obstacles-drive")
    return found


def solution():
    return exercise().function_of(exercise().solution, "solution", prepared=True)


def drive_in_env(scenario):
    """The places (x, y, yaw) of a drive in RoomEnv, and its metrics."""
    env, control, memory, over = RoomEnv(exercise().sensors), solution(), {}, False
    options = {name: scenario[name] for name in OPTIONS if name in scenario}
    observation, info = env.reset(seed=1, options=options)
    while not over:
        observation, _, _, over, info = env.step(control(controller_observation(observation), memory))
    return env.path, info


def drive_in_ros(session, scenario, is_over):
    """The true places of a drive by the lesson's node until is_over(simulation), and its bumps.

    The robot is in this process, and nothing else moves in its room.
    """
    from imgproc_course.ros.robot_topics import TOPIC
    from imgproc_course.ros.room_images import RoomImages
    from imgproc_course.ros.room_publisher import RoomPublisher

    lesson, control = lesson_definitions("obstacles_ahead", robot_rays=[]), solution()
    options = {"room": scenario["room"], "start": tuple(scenario["start"]), "movers": False}
    images = RoomImages(10, seed=1, size=(640, 360), lighting="day", **options)
    body = RoomPublisher(TOPIC, images)
    body.start()
    node = session.add_node(lesson["ControlNode"](control, context=session.context))
    places = []
    try:
        while not is_over(images.simulation):
            places.append(images.simulation.place)
            time.sleep(0.05)
    finally:
        session.remove_node(node)
        body.stop()
    return places, images.bumps


def is_in(goal, place):
    return math.dist(place[:2], goal[:2]) < goal[2]


def farthest(places, path):
    """The greatest distance of one of the places from a path, in metres."""
    return max(min(math.dist(place[:2], known[:2]) for known in path) for place in places)
