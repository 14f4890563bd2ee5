"""The solution of obstacles-drive: in the node of its lesson, and in RoomEnv."""

from lesson_nodes import MASTERS, lesson_definitions

from imgproc_course.classroom.exercises.declaration import read_exercises
from imgproc_course.simulation.room_env import RoomEnv, controller_observation

SENSORS = ("depth", "scan", "odometry")


def solution():
    (master,) = MASTERS.glob("*_obstacles_ahead.py")
    (exercise,) = (e for e in read_exercises(master) if e.id == "obstacles-drive")
    return exercise.function_of(exercise.solution, "solution", prepared=True)


def control_node(context):
    lesson = lesson_definitions("obstacles_ahead", robot_rays=[])
    return lesson["ControlNode"](solution(), context=context)


def path_in_env(room, start, goal, seconds=40.0):
    """The path of a drive in RoomEnv, and its metrics."""
    env, control, memory, over = RoomEnv(SENSORS), solution(), {}, False
    options = {"room": room, "start": start, "goal": goal, "duration": seconds}
    observation, info = env.reset(seed=1, options=options)
    while not over:
        observation, _, _, over, info = env.step(control(controller_observation(observation), memory))
    return env.path, info
