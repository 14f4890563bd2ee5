"""Do the driving exercises ask for their deed? Honest and cheap controllers in unseen scenarios.

.venv/bin/python tests/benchmarks/bench_controllers.py [-n 20] [--seed 91] [--exercise ID] [--only NAME]

Required of 20: the solution passes 18, an honest controller of another style 15, a cheap one 4; the exit code
is 1 otherwise. That stub and repeated drives fail in hidden scenarios, each answer key proves.
"""

import argparse
import math
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import cv2
import numpy as np
from nbclassroom.exercises.declaration import read_exercises
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

from imgproc_course.simulation.room_env import OPTIONS, RoomEnv, controller_observation

MASTERS = Path(__file__).parents[2] / "notebooks/masters"
LEAST_OF_SOLUTION, LEAST_OF_HONEST, MOST_OF_CHEAP = 0.9, 0.75, 0.2
given: Any = SimpleNamespace()  # what the lesson defines for its controllers: given.red_spots …


# ---------------------------------------------------------------- obstacles_ahead: a way past low things


def along_a_graph(observation, memory, places, reach):
    """The shortest way to the goal through places (N, 2) beside the robot, then to the farthest one."""
    x, y, yaw = observation["odometry"]
    here = np.array([x, y])
    turn = np.array([[math.cos(yaw), math.sin(yaw)], [-math.sin(yaw), math.cos(yaw)]])
    known = np.concatenate(
        [given.obstacles(observation) @ turn + here, memory.get("known", np.empty((0, 2)))]
    )
    memory["known"] = known = np.unique((20 * known).round() / 20, axis=0)
    tree, shares = cKDTree(known), np.linspace(0, 1, 9)[:, np.newaxis, np.newaxis]

    def room(begins, ends):
        return tree.query(begins + shares * (ends - begins))[0].min(0)

    memory["is_there"] = is_there = memory.get("is_there") or math.dist((2.2, 0), here) < 0.45
    route = [place for place in memory.get("route", []) if math.dist(place, here) > 0.15]
    if (
        not route
        or room(here[np.newaxis], route[0][np.newaxis])[0] < 0.25
        or is_there > memory.get("was_there", False)
    ):
        memory["was_there"] = is_there
        places = np.concatenate([here[np.newaxis], here + places, [(2.2, 0.0)]])
        pairs = cKDTree(places).query_pairs(reach, output_type="ndarray")
        pairs = pairs[room(*places[pairs.T]) > np.where(pairs[:, 0] == 0, 0.26, 0.31)]
        ways = np.linalg.norm(np.subtract(*places[pairs.T]), axis=1)
        graph = coo_matrix((ways, pairs.T), shape=(len(places), len(places)))
        costs, before = dijkstra(graph, directed=False, indices=0, return_predecessors=True)
        left = -costs if is_there else np.linalg.norm(places - (2.2, 0.0), axis=1)
        index, route = int(np.argmin(np.where(np.isfinite(costs), left, np.inf))), []
        while index:
            route.insert(0, places[index])
            index = int(before[index])
    memory["route"] = route
    if not route:
        return 0.0, 0.8
    straight = [place for place in route if room(here[np.newaxis], place[np.newaxis])[0] > 0.3]
    aim = turn @ ((straight or route)[-1 if straight else 0] - here)
    angle = math.atan2(aim[1], aim[0])
    return (0.3 if abs(angle) < 0.2 else 0.0), min(max(2 * angle, -1.0), 1.0)


def grid_map(observation, memory):
    cells = np.arange(-2.5, 2.51, 0.14)
    return along_a_graph(observation, memory, np.stack(np.meshgrid(cells, cells), -1).reshape(-1, 2), 0.21)


def roadmap(observation, memory):
    places = np.random.default_rng(len(memory.get("known", ()))).uniform(-2.5, 2.5, (300, 2))
    return along_a_graph(observation, memory, places, 1.0)


def towards(place, x, y, yaw):
    turn = math.remainder(math.atan2(place[1] - y, place[0] - x) - yaw, 2 * math.pi)
    return (0.25 if abs(turn) < 0.3 else 0.0), min(max(2 * turn, -1.0), 1.0)


def blind_detour(observation, memory, side):
    """To a place beside the way, to the goal, and on by a map."""
    aims = memory.setdefault("aims", [(1.1, side), (2.2, 0.0)])
    if aims and math.dist(aims[0], observation["odometry"][:2]) < 0.2:
        del aims[0]
    if aims:
        return towards(aims[0], *observation["odometry"])
    memory["is_there"] = True
    return grid_map(observation, memory)


def one_look(observation, memory):
    """The first look decides the side of the detour."""
    points = given.obstacles(observation)
    free = [given.free_way(points, angle) for angle in (0.5, -0.5)]
    return blind_detour(observation, memory, 0.65 if free[0] > free[1] else -0.65)


def laser_alone(observation, memory):
    return grid_map(dict(observation, depth=np.zeros((90, 160), np.uint16)), memory)


def laser_detour(observation, memory, side):
    """By the laser alone, on one side."""
    if memory.setdefault("begins", True):
        memory["begins"] = math.dist((0.9, side), observation["odometry"][:2]) > 0.2
        way = given.free_way(given.obstacles(dict(observation, depth=np.zeros((90, 160)))), 0.0, 0.3)
        linear, angular = towards((0.9, side), *observation["odometry"])
        return (linear, angular) if way > 0.1 else (0.0, math.copysign(0.8, side))
    return laser_alone(observation, memory)


def with_side(control, side):
    """The controller for a side, metres to the left."""

    def on_this_side(observation, memory):
        return control(observation, memory, side)

    on_this_side.__name__ = f"{control.__name__} {side}"
    return on_this_side


# ---------------------------------------------------------------- object_tracking: one of three balls rolls

FOCAL = 176.25  # pixels


def sizes_and_columns(observation):
    """(size, middle column) of each red spot, pixels."""
    boxes = given.red_spots(observation["image"])
    return [(max(width, height), col + width / 2) for col, _, width, height in boxes]


def speeds_towards(size, middle):
    linear = 1.2 * (FOCAL * 0.22 / size - 0.6)
    return min(max(linear, -0.3), 0.3), min(max(2 * (160 - middle) / FOCAL, -1.0), 1.0)


def largest_spot(observation, memory):
    spots = sizes_and_columns(observation)
    return speeds_towards(*max(spots)) if spots else (0.0, 0.4)


def second_largest_spot(observation, memory):
    spots = sorted(sizes_and_columns(observation))
    return speeds_towards(*spots[-min(2, len(spots))]) if spots else (0.0, 0.4)


def spot_nearest_to_the_middle(observation, memory):
    spots = [spot for spot in sizes_and_columns(observation) if spot[0] > 12]
    if not spots:
        return 0.0, 0.4
    return speeds_towards(*min(spots, key=lambda spot: abs(spot[1] - 160)))


def spot_nearest_to_the_last(observation, memory):
    """Without a look at what moves, and without a prediction."""
    spots = [spot for spot in sizes_and_columns(observation) if spot[0] > 12]
    if not spots:
        return 0.0, 0.4
    spot = min(spots, key=lambda spot: abs(spot[1] - memory.get("middle", 160)))
    memory["middle"] = spot[1]
    return speeds_towards(*spot)


def moved_spot(observation, memory):
    """The spot that moved most while the robot stood for 0.6 s; until then None."""
    spots = sizes_and_columns(observation)
    first = memory.setdefault("first", spots)
    if observation["time"] < 0.55:
        return None
    large = [spot for spot in spots if spot[0] > 14]
    return max(large, key=lambda spot: min(abs(spot[1] - other[1]) for other in first), default=(20, 160))


def kalman_filter(observation, memory):
    """Of the direction and its speed, with a gate of three deviations."""
    if "state" not in memory:
        spot = moved_spot(observation, memory)
        if spot is None:
            return 0.0, 0.0
        state = np.array([(160 - spot[1]) / FOCAL, 0.0])
        memory.update(state=state, covariance=np.diag([0.002, 0.1]), size=spot[0], turn=0.0)
    F = np.array([[1, 0.1], [0, 1]])
    state = F @ memory["state"] - (0.1 * memory["turn"], 0)
    covariance = F @ memory["covariance"] @ F.T + np.diag([4e-4, 4e-3])
    variance, size = covariance[0, 0] + 1e-3, memory["size"]
    near = [
        (own, (160 - column) / FOCAL)
        for own, column in sizes_and_columns(observation)
        if abs((160 - column) / FOCAL - state[0]) < 3 * math.sqrt(variance) and 0.4 < own / size < 1.4
    ]
    linear = 0.0
    if near:
        seen, direction = max(near)
        gain = covariance[:, 0] / variance
        state = state + gain * (direction - state[0])
        covariance = covariance - np.outer(gain, covariance[0])
        size = max(seen, 0.95 * size)
        linear = min(max(1.2 * (FOCAL * 0.22 / size - 0.6), -0.3), 0.3)
    turn = min(max(2 * float(state[0]), -1.0), 1.0)
    memory.update(state=state, covariance=covariance, size=size, turn=turn)
    return linear, turn


def mean_size_and_nearest(observation, memory):
    """No filter: the nearest spot of about this size, and the mean of its size and the last one."""
    if "ball" not in memory:
        memory["ball"], memory["turn"] = moved_spot(observation, memory), 0.0
        if memory["ball"] is None:
            del memory["ball"]
            return 0.0, 0.0
    size, middle = memory["ball"]
    middle += FOCAL * 0.1 * memory["turn"]
    near = [
        spot
        for spot in sizes_and_columns(observation)
        if abs(spot[1] - middle) < max(20, 0.6 * size) and 0.35 < spot[0] / size < 1.5
    ]
    linear = 0.0
    if near:
        seen, middle = min(near, key=lambda spot: abs(spot[1] - middle) - 0.5 * spot[0])
        size = 0.5 * size + 0.5 * seen
        linear, _ = speeds_towards(size, middle)
    memory["ball"], memory["turn"] = (size, middle), speeds_towards(size, middle)[1]
    return linear, memory["turn"]


# ---------------------------------------------------------------- the_errand: a word, and its direction


def errand(observation, memory, *, goes_near=True, keeps_first=False, looks_again=False, backwards=False):
    """As the solution, but the answer is counted from a direction that it remembers, or sees ahead."""
    x, y, yaw = observation["odometry"]
    word, angle, _ = given.find_sign(observation["image"]) or (None, None, None)
    if "word" not in memory:
        if angle is None:
            return 0.0, 0.7
        if not (keeps_first and "direction" in memory):
            memory["direction"] = yaw + angle
        if word and (not looks_again or word == memory.get("last")):
            memory["word"] = word
        memory["last"] = word
        return (0.25 if abs(angle) < 0.3 and goes_near else 0.0), 1.5 * angle
    if math.hypot(x, y) > 0.08 and "home" not in memory:
        linear, angular = towards((0, 0), x, y, yaw + math.pi * backwards)
        return (-linear if backwards else linear), angular
    memory["home"] = True
    if looks_again and "seen" not in memory:
        if angle is None or abs(angle) > 0.03:
            return 0.0, 0.7 if angle is None else 1.5 * angle
        memory["seen"], memory["direction"] = True, yaw + angle
    rest = math.remainder(
        memory["direction"] + math.radians(given.ANSWERS[memory["word"]]) - yaw, 2 * math.pi
    )
    return 0.0, min(max(2 * rest, -1.0), 1.0)


def backwards(observation, memory):
    return errand(observation, memory, looks_again=True, backwards=True)


def sign_in_the_middle(observation, memory):
    return errand(observation, memory, looks_again=True)


def one_look_at_the_word(observation, memory):
    """The word as it is read from the start, without coming nearer."""
    return errand(observation, memory, goes_near=False)


def no_second_look(observation, memory):
    """The direction in which the sign was when its word was read."""
    return errand(observation, memory)


def direction_from_the_start(observation, memory):
    """The direction in which the sign was when it was seen first."""
    return errand(observation, memory, keeps_first=True)


def bounce(observation, memory):
    """Straight on, else a turn to the side that is freer; no memory of places."""
    points = given.obstacles(observation)
    if given.way_before(points, 0.0) > 0.35:
        memory.clear()
        return 0.3, 0.0
    ways = {side: given.way_before(points, 0.8 * side) for side in (-1, 1)}
    return 0.0, 1.2 * memory.setdefault("side", max(ways, key=ways.get))


# ---------------------------------------------------------------- the tables

# Of each exercise: honest controllers, which use its idea in another way, and cheap ones, which leave it out.
TABLES: dict[str, tuple] = {
    "obstacles-drive": (
        (grid_map, roadmap),
        (
            one_look,
            laser_alone,
            *(with_side(laser_detour, side) for side in (0.7, -0.7)),
            *(with_side(blind_detour, side) for side in (0.8, -0.8, 0.5, -0.5)),
        ),
    ),
    "tracking-drive": (
        (kalman_filter, mean_size_and_nearest),
        (largest_spot, second_largest_spot, spot_nearest_to_the_middle, spot_nearest_to_the_last),
    ),
    "errand-drive": (
        (backwards, sign_in_the_middle),
        (one_look_at_the_word, no_second_look, direction_from_the_start),
    ),
    "errand-explore": ((bounce,), ()),  # it visits as many places without a memory, as the lesson says
}


def drive(env, control, scenario):
    """The metrics of a drive, and whether it keeps the thresholds."""
    options = {name: scenario[name] for name in OPTIONS if name in scenario}
    observation, info = env.reset(seed=scenario["seed"], options=options)
    memory, over = {}, False
    while not (over or info["bumps"]):  # none is allowed
        observation, _, _, over, info = env.step(control(controller_observation(observation), memory))
    signs = {"<=": lambda value, limit: value <= limit, ">=": lambda value, limit: value >= limit}
    return info, all(
        info[name] is not None and signs[sign](info[name], limit)
        for name, (sign, limit) in scenario["thresholds"].items()
    )


def controllers_of(exercise):
    """(kind, name, control) of all controllers of an exercise."""
    solution = exercise.function_of(exercise.solution, "solution", prepared=True)
    vars(given).update(solution.__globals__)
    yield "solution", "solution", solution
    for kind, controls in zip(("honest", "cheap"), TABLES[exercise.id], strict=True):
        for control in controls:
            yield kind, control.__name__, control


def problem_of(kind, share):
    least = {"solution": LEAST_OF_SOLUTION, "honest": LEAST_OF_HONEST}.get(kind)
    if least is None:
        return "TOO MANY" if share > MOST_OF_CHEAP else ""
    return "TOO FEW" if share < least else ""


def main():
    cv2.setNumThreads(1)
    parser = argparse.ArgumentParser()
    parser.add_argument("--exercise", choices=TABLES, action="append")
    parser.add_argument("--seed", type=int, default=91)
    parser.add_argument("-n", type=int, default=20)
    parser.add_argument("--only", action="append")
    options = parser.parse_args()
    problems = []
    masters = [path for path in sorted(MASTERS.glob("[0-9]*.py")) if ".mistakes" not in path.name]
    exercises = {exercise.id: exercise for path in masters for exercise in read_exercises(path)}
    for exercise in map(exercises.get, options.exercise or TABLES):
        case, env = exercise.hidden[0], RoomEnv(exercise.sensors)
        scenarios = [exercise.arguments(case, 1000 * options.seed + k)[0][0] for k in range(options.n)]
        print(f"{exercise.id}, {options.n} scenarios of seed {options.seed}", flush=True)
        for kind, name, control in controllers_of(exercise):
            if options.only and name not in options.only:
                continue
            drives = [drive(env, control, scenario) for scenario in scenarios]
            count = sum(kept for _, kept in drives)
            problems += [problem_of(kind, count / options.n)]
            print(f"  {kind:8} {name:30} {count:3} {problems[-1]}", flush=True)
            for metric in scenarios[0]["thresholds"]:
                values = sorted(-1.0 if info[metric] is None else info[metric] for info, _ in drives)
                print(f"    {metric}: {' '.join(f'{value:.2f}' for value in values)}", flush=True)
    sys.exit(any(problems))


if __name__ == "__main__":
    main()
