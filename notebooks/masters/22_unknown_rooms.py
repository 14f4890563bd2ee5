# ---
# jupyter:
#   imgproc_course:
#     title: Unknown rooms
# ---

# %% [markdown]
# # Unknown rooms
#
# A robot comes into a room that it has never seen. It has a minute to look around. In this lesson you write its controller, and measure it in ten rooms.
#
# **You will be able to**
# - measure how well a robot explores a room, with one score,
# - let a robot remember where it has been, and drive to what is new,
# - store where the markers of a room are, and read its sign,
# - compare two controllers in ten rooms.
#
# **Time** [[minutes]]. **You need** [[obstacles_ahead]], above all its section 9, and [[where_am_i]] for the markers.

# %% role="given" exercise=["unknown-coverage", "unknown-new", "unknown-drive"]
import math

import numpy as np

# %%
import cv2

from imgproc_course.display import show
from imgproc_course.exercises import check, compare_guess, hint, solution, with_progress
from imgproc_course.simulation.exploration import ROOMS, exploration_score, scenario_of
from imgproc_course.simulation.room_env import RoomEnv, controller_observation
from imgproc_course.simulation.room_map import draw_map

# %% role="texts"
figure_texts = {
    "baseline": (
        "The baseline in room 34: the path of the robot from above, from the green dot to the outline of its body.",
        "A plan of a room with furniture in gray. A blue path of long straight lines crosses the free floor.",
    ),
    "next": (
        "Room 103 in the evening: a marker, and toys on the floor.",
        "A room in warm light: a shelf with books, a black and white marker on the floor beside it, toy blocks, and the edge of a rug.",
    ),
    "view": (
        "What the camera sees in room 33: a marker and a sign on the wall.",
        "A light wall near the floor: on the left a square black and white marker, in the middle a white sign with the word GARAGE, on the right a bin.",
    ),
}

# %% [markdown]
# ## 1 · One score for a minute ([[minutes]])
#
# In a room that you know, you can write down a route. In an unknown room you cannot: furniture, walls, markers and the sign are at other places each time. So the robot must decide with what it sees now, and with what it remembers.
#
# How good is such a robot? We divide the floor into square cells of 0.5 m. The *[[term:coverage]]* is the share of the cells in which the robot was, of all cells that it can reach. The room also has two markers, with other numbers in each room, and a sign with a word. After 60 seconds, the robot has a score:
#
# $$\text{score} = 100 \cdot \text{coverage} + 10 \cdot \text{markers} + 20 \cdot \text{word} - 5 \cdot \text{bumps}$$
#
# It is rounded, and never below 0. A marker counts if its place is right within 0.3 m, and the word counts if it is read right (1 or 0). The time is limited, so a fast robot reaches more: at 0.3 m/s, 60 seconds are 18 m.
#
# An example: a robot was in 21 of the 70 cells, found one marker, did not read the word, and bumped twice. **Predict** its score.

# %% role="predict"
guess_score = None  # your guess: how many points?

# %%
score = round(100 * 21 / 70 + 10 * 1 + 20 * 0 - 5 * 2)
compare_guess(guess_score, score)

# %%
# Check: the numbers in this section
assert score == 30 and round(0.3 * 60, 6) == 18

# %% [markdown]
# ### Your turn: the coverage ([[minutes]], deeper)
#
# A point (x, y) is in the cell with the column floor(x / 0.5) and the row floor(y / 0.5). Write `coverage(path, cells)`. Each cell counts once, also if the robot was in it several times. A cell that is not in `cells` does not count.
#
# | Input | Output | Example call |
# |---|---|---|
# | `path`: array (N, 3), the x, y (metres) and yaw of the robot at N times; `cells`: array (M, 2) of whole numbers, column and row of each cell that the robot can reach | one number from 0 to 1 | `coverage(np.array([[0.2, -0.1, 0.0]]), np.array([[0, -1], [0, 0]]))` is 0.5 |

# %% role="exercise"
exercise(
    "unknown-coverage",
    title="The share of a room in which the robot was",
    function="coverage",
    tolerance=1e-6,
    hint="np.floor(path[:, :2] / 0.5) gives columns and rows. Keep each pair once, keep only those in cells, and divide by len(cells).",
    hints=(
        "Which cell is each place of the path in? How do you count each cell only once?",
        "1. Divide x and y by 0.5, and round down with np.floor: int() rounds negative numbers up.\n"
        "2. Make a set of pairs (column, row).\n"
        "3. Make a set of the pairs of cells, too.\n"
        "4. Count the pairs in both sets, and divide by the number of cells.",
        "entered = {(math.floor(x / 0.5), ...) for x, y, yaw in path}\nreachable = {tuple(cell) for cell in cells.tolist()}\n"
        "return len(... & ...) / len(reachable)",
    ),
    explanation="A set holds each pair once, and & of two sets has what is in both. floor rounds down also below 0; int rounds"
    " towards 0, and would join the cells on both sides of 0.",
    another_way="You can also paint the cells of the path into a small image, and count its pixels.",
)


def any_room(rng, steps=60):
    """A random path of short steps, and cells around the origin."""
    way = rng.uniform(-0.2, 0.2, (steps, 2)).cumsum(0) + rng.uniform(-0.6, 0.6, 2)
    path = np.column_stack([way, rng.uniform(-3, 3, steps)]).round(3) + 0.0004
    every = np.array([(col, row) for col in range(-4, 4) for row in range(-4, 4)])
    return path, every[rng.permutation(64)[:40]]


def all_reached(rng):
    """Every cell of a block was entered, some of them twice."""
    every = np.array([(col, row) for col in range(-2, 2) for row in range(-1, 1)]) + rng.integers(-3, 3, 2)
    visits = np.concatenate([every, every[:5]]) * 0.5 + rng.uniform(0.1, 0.4, (13, 2)).round(3)
    return np.column_stack([visits, np.zeros(13)]), every


# %% role="answer"
def coverage(path, cells):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def coverage(path, cells):
    pairs = np.floor(np.asarray(path)[:, :2] / 0.5).astype(int).tolist()
    reachable = set(map(tuple, np.asarray(cells).tolist()))
    return len(reachable.intersection(map(tuple, pairs))) / len(reachable)

# %% role="check"
check("unknown-coverage", coverage)

# %% role="case" title="a few places" points=1
def inputs(rng):
    return [(np.array([[0.2, -0.1, 0.0]]), np.array([[0, -1], [0, 0]])),
            (np.array([[0.2, 0.1, 0.0], [0.7, 0.1, 0.0], [0.3, 0.2, 1.0], [9.2, 0.2, 1.0]]), np.array([[0, 0], [1, 0], [2, 0], [3, 0]])),
            all_reached(rng), any_room(rng), any_room(rng, 150), any_room(rng, 250)]


# %% role="case" title="a path on both sides of 0" points=1 hint="Do you round down also below 0?"
def inputs(rng):
    return [any_room(rng), any_room(rng, 20), any_room(rng, 150), any_room(rng, 250)]


# %% role="hidden" title="any path" points=1 hint="Does each cell count once, and only if it is in cells?"
def inputs(rng):
    return [any_room(rng), any_room(rng, 120), any_room(rng, 10), all_reached(rng)]


# %% [markdown]
# ## 2 · The baseline ([[minutes]])
#
# Before you improve something, measure a simple solution: the *[[term:baseline]]*. Our baseline drives until the laser scanner sees something near, then it turns to the left. A controller is a function `control(observation, memory)` as in [[obstacles_ahead#9]]: it is called ten times per second, and returns the linear speed (m/s) and the angular speed (rad/s).

# %%
def baseline(observation, memory):
    ahead = np.concatenate([observation["scan"][-40:], observation["scan"][:40]])
    if ahead.min() < 0.5:
        return 0.0, 0.8
    return 0.3, 0.0

# %% [markdown]
# `RoomEnv` is the room with the robot as an *environment* of Gymnasium, a Python package in which many robots learn and are measured. `reset` begins a drive, and `step` drives for 0.1 s. The controller gets the sensors only. The environment knows the truth, so only `exploration_score` may use it.

# %%
def explore(env, control, room):
    """Drives through a room for 60 s: what the robot has reached."""
    scenario = scenario_of(room, seed=room)
    observation, _ = env.reset(seed=scenario.pop("seed"), options=scenario)
    memory, over = {}, False
    while not over:
        speeds = control(controller_observation(observation), memory)
        observation, _, _, over, _ = env.step(speeds)
    return exploration_score(env, memory.get("found"))

# %% tags=["nbval-ignore-output"]
scan_env = RoomEnv(("scan",))
first = explore(scan_env, baseline, 34)
print(first)
bumps = [(look, x, y) for look, (x, y, _) in scan_env.bump_places]
show(draw_map(scan_env.path, bumps, room=scan_env.room), text="unknown_rooms/baseline")

# %%
# Check: what the text says of the first room
assert first["coverage"] > 0.3 and first["bumps"] == 0

# %% [markdown]
# It can be lucky: in this room the coverage is more than 0.3, without a bump. One room says little. So we drive in ten rooms, and take the mean of the scores.

# %% tags=["nbval-ignore-output"]
rows = []
print("room  coverage  markers  word  bumps  score")
for room in with_progress(ROOMS, "driving through ten rooms"):
    row = explore(scan_env, baseline, room)
    rows.append(row)
    print(f"{room:4} {row['coverage']:9.2f} {row['markers']:8} {row['word']:5} {row['bumps']:6} {row['score']:6}")
scores = [row["score"] for row in rows]
print("mean score:", np.mean(scores))

# %%
# Check: what the text says of the baseline
assert sum(row["bumps"] > 0 for row in rows) > 5
assert 18 <= np.mean(scores) <= 24 and min(scores) <= 5 and max(scores) > 40

# %% [markdown]
# The mean is about 21 points, between 0 and more than 40 in single rooms. Why? In most rooms the baseline drives into slippers or building blocks: they are lower than the plane of the laser scanner. Then it often stands there for the rest of the minute. And where it drives well, it does not know where it was already.

# %% [markdown]
# ## 3 · Where is something new? ([[minutes]])
#
# The longest free way is a good first rule: turn to where the robot can drive farthest. But then it drives to and fro between the same two walls. A better rule needs memory: the set of the cells in which the robot was. For each direction, we count the cells on the free way that are not in this set.
#
# The robot stands at (0.25, 0.25) and looks along the axis x. The free way is 1.45 m, and it was in the cells (0, 0) and (1, 0). **Predict**: how many new cells are on this way?

# %% role="predict"
guess_new = None  # your guess: how many cells?

# %%
distances = np.arange(0.1, 1.45, 0.1)
columns = np.floor((0.25 + distances) / 0.5).astype(int)
print("columns:", columns)
new = len(set(columns.tolist()) - {0, 1})
compare_guess(guess_new, new)

# %%
# Check: the numbers in this section
assert new == 2 and columns.max() == 3 and columns.min() == 0

# %% [markdown]
# ### Your turn: count what is new
#
# Write `count_new(place, heading, way, visited)`. Look at the points on the straight way at 0.1 m, 0.2 m, 0.3 m and so on from the place, as long as the distance is less than `way`. Count the cells of these points that are not in `visited`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `place`: (x, y) in metres; `heading`: the direction of the way, radians; `way`: its length in metres; `visited`: array (K, 2) of whole numbers, column and row of each cell in which the robot was | number of new cells | `count_new((0.25, 0.25), 0.0, 1.45, np.array([[0, 0], [1, 0]]))` is 2 |

# %% role="exercise"
exercise(
    "unknown-new",
    title="New cells on a straight way",
    function="count_new",
    hint="np.arange(0.1, way, 0.1) gives the distances. x is place[0] + distance * cos(heading), y has the sine. Then floor, a set of pairs, and the difference of two sets.",
    hints=(
        "Where is the point that is 0.1 m away in the direction heading? In which cell is it?",
        "1. Make the distances with np.arange(0.1, way, 0.1).\n"
        "2. Compute x with the cosine of heading, y with the sine, and add the place.\n"
        "3. Divide by 0.5, round down with floor, and make a set of pairs (column, row).\n"
        "4. Subtract the set of the visited cells, and return the number of the rest.",
        "distances = np.arange(0.1, ..., 0.1)\nx = place[0] + distances * math.cos(heading)\ny = ...\n"
        "cells = {(math.floor(a / 0.5), ...) for a, b in zip(x, y)}\nreturn len(cells - {tuple(cell) for cell in visited.tolist()})",
    ),
    explanation="The points are nearer to each other than a cell is wide, so the way leaves out a cell only where it cuts a corner"
    " of it. The set counts each cell once, although several points are in it.",
    another_way="The cells of a ray can also be computed without points, as grid_ray does in the lesson on mapping.",
)


def any_way(rng, count=12, longest=29):
    """A way with a random direction, and random cells near its start."""
    place = tuple((rng.uniform(-1.2, 1.2, 2).round(2) + 0.003).tolist())
    visited = rng.integers(-4, 4, (count, 2))
    return place, round(float(rng.uniform(-3.1, 3.1)), 3), int(rng.integers(3, longest)) / 10 + 0.05, visited


# %% role="answer"
def count_new(place, heading, way, visited):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def count_new(place, heading, way, visited):
    steps = np.arange(0.1, way, 0.1)[:, np.newaxis] * (math.cos(heading), math.sin(heading))
    pairs = np.floor((steps + place) / 0.5).astype(int)
    return len(set(map(tuple, pairs.tolist())).difference(map(tuple, visited.tolist())))

# %% role="check"
check("unknown-new", count_new)

# %% role="case" title="straight ways" points=1
def inputs(rng):
    return [((0.25, 0.25), 0.0, 1.45, np.array([[0, 0], [1, 0]])), ((0.25, 0.25), math.pi / 2, 1.05, np.array([[0, 0], [1, 0]])),
            ((0.0, 0.25), 0.0, 0.5, np.array([[0, 0]])), ((-0.2, 0.3), 3.1, 0.05, np.array([[0, 0]])),
            ((-0.2, 0.3), 3.1, 1.75, np.array([[0, 0], [-1, 0], [-1, 0]])), any_way(rng, 3)]


# %% role="case" title="any direction" points=1 hint="Do you add the place, use cosine for x and sine for y, and round down below 0?"
def inputs(rng):
    return [any_way(rng), any_way(rng), any_way(rng, 30), any_way(rng, 1)]


# %% role="hidden" title="any ways" points=1 hint="Is the end of the way less than way, and does each cell count once?"
def inputs(rng):
    return [any_way(rng), any_way(rng, 20), any_way(rng, 30), any_way(rng, 4), any_way(rng, 2)]


# %% [markdown]
# ## 4 · Explore ([[minutes]])
#
# Now you write the controller. These two functions are those of [[obstacles_ahead#9]]: `obstacles` makes points of the depth image and the scan, and `free_way` measures how far the robot can go in a direction.

# %% role="given" exercise="unknown-drive" tags=["long"]
from imgproc_course.geometry import CameraModel

drive_camera = CameraModel(1280, 720, 705.0, 705.0, 639.5, 359.5,
                           (-0.170, 0.035, 0.0004, -0.0003, 0.0)).resized(160, 90)
drive_rays = drive_camera.rays()[::2, ::2]


def obstacles(observation):
    """(N, 2) metres: forward and left of the axle, everything that stands there."""
    seen = drive_rays * (observation["depth"][::2, ::2] / 1000)[:, :, np.newaxis]
    forward, left, height = seen[:, :, 2], -seen[:, :, 0], 0.20 - seen[:, :, 1]
    stands = (height > 0.015 + 0.007 * forward) & (height < 0.40) & (forward > 0) & (forward < 3)
    by_camera = np.column_stack([forward[stands] + 0.21, left[stands]])
    hit = np.isfinite(observation["scan"])
    ranges, angles = observation["scan"][hit], np.radians(np.arange(360))[hit]
    by_laser = np.column_stack([ranges * np.cos(angles) + 0.156, ranges * np.sin(angles)])
    return np.concatenate([by_camera, by_laser])


def free_way(points, direction, width=0.5):
    """Metres before the robot's front, if it drives in this direction (radians)."""
    c, s = math.cos(direction), math.sin(direction)
    forward, left = points[:, 0] * c + points[:, 1] * s, points[:, 1] * c - points[:, 0] * s
    return forward[(np.abs(left) <= width / 2) & (forward > 0)].min(initial=9.0) - 0.24

# %% [markdown]
# ### Your turn: drive to what is new
#
# Write `control(observation, memory)`. Each drive takes 60 s in an unknown room, and has three conditions: no **bump**; the body comes no nearer than 0.08 m to anything (**clearance**); and the robot is in at least 20 **places**, cells of 0.5 m. The stub is the baseline. Improve it step by step:
#
# 1. Begin with your `control` of [[obstacles_ahead#9]], which turns to the longest free way.
# 2. Keep a set of visited cells in `memory`. `observation["odometry"]` has x, y and yaw.
# 3. Every metre, choose a new direction: the one with the most new cells on its free way. Count at most 2 m of a way.
# 4. A turn takes time: subtract about one cell for each radian.
#
# `count_new` is yours to use. The check drives in three rooms, and takes about ten seconds.
#
# | Input | Output | Example call |
# |---|---|---|
# | `observation`: a dict with `"scan"`, `"depth"`, `"odometry"` and `"time"`; `memory`: a dict that is yours | two numbers: the linear speed in m/s (at most 0.3) and the angular speed in rad/s (positive: to the left) | `control({"depth": ..., "scan": ..., "odometry": ..., "time": 0.0}, {})` |

# %% role="exercise"
exercise(
    "unknown-drive",
    title="Explore a room that you have not seen",
    function="control",
    subject="drive",
    sensors=("depth", "scan", "odometry"),
    hint="Turn on the spot to the chosen direction, then drive until less than 0.45 m are free or 1 m is driven. Then choose the direction with the most new cells on its free way, less one cell for each radian of the turn.",
    hints=(
        "Where is something that the robot has not visited, and how far can it drive there? When must it choose again?",
        "1. Store the last 60 looks of obstacles in the frame of the odometry: the camera does not see what is low and near.\n"
        "2. Add the robot's cell to a set in memory.\n"
        "3. If the yaw is not near the chosen heading, turn on the spot. Use math.remainder.\n"
        "4. If more than 0.45 m are free and less than 1 m is driven since the last choice, drive on.\n"
        "5. Else compare the directions all around: new cells on at most 2 m of the free way, less the turn.",
        "def worth(direction):\n    way = min(free_way(points, direction), 2.0)\n    if way < 0.45:\n        return way - 10\n"
        "    return count_new((x, y), yaw + direction, ..., ...) - abs(direction)\n"
        "best = max(np.radians(np.arange(-165, 181, 15)), key=worth)\nmemory[\"heading\"] = yaw + float(best)\nmemory[\"chosen_at\"] = ...",
    ),
    explanation="The robot chooses a direction each metre. It counts new cells on the first 2 m of a free way: what is farther away"
    " can be reached by a later choice. Without the cost of a turn it would lose many seconds with turning.",
    another_way="A planner on a grid knows more: it drives to the nearest border between known and unknown cells (frontier-based exploration).",
)


def unseen_room(rng):
    """A scenario: a furnished room, with a start that is drawn by its seed."""
    thresholds = {"bumps": ["<=", 0], "clearance": [">=", 0.08], "places": [">=", 20]}
    return {"seed": int(rng.integers(1 << 31)), "room": int(rng.integers(1, 100_000)), "duration": 60.0,
            "thresholds": thresholds}


# %% role="answer"
def control(observation, memory):
    ahead = np.concatenate([observation["scan"][-40:], observation["scan"][:40]])
    if ahead.min() < 0.5:
        return 0.0, 0.8
    return 0.3, 0.0  # your turn: this is the baseline

# %% role="solution"
def control(observation, memory):
    x, y, yaw = observation["odometry"]
    c, s = math.cos(yaw), math.sin(yaw)
    to_room = np.array([[c, s], [-s, c]])
    looks = memory.setdefault("looks", [])
    looks.append(obstacles(observation) @ to_room + (x, y))
    del looks[:-60]
    points = (np.concatenate(looks) - (x, y)) @ to_room.T
    visited = memory.setdefault("visited", set())
    visited.add((math.floor(x / 0.5), math.floor(y / 0.5)))

    error = math.remainder(memory.setdefault("heading", yaw) - yaw, 2 * math.pi)
    if abs(error) > 0.1:
        return 0.0, min(max(3 * error, -1.57), 1.57)
    driven = math.dist((x, y), memory.setdefault("chosen_at", (x, y)))
    if free_way(points, error) > 0.45 and driven < 1.0:
        return 0.3, 2 * error

    def worth(direction):
        way = min(free_way(points, direction), 2.0)
        if way < 0.45:
            return way - 10
        along = np.arange(0.0, way + 0.1, 0.1)
        u, v = x + along * math.cos(yaw + direction), y + along * math.sin(yaw + direction)
        cells = zip(np.floor(u / 0.5).astype(int).tolist(), np.floor(v / 0.5).astype(int).tolist(), strict=True)
        return len(set(cells) - visited) + 0.1 * way - abs(direction)

    best = float(max(np.radians(np.arange(-165, 181, 15)), key=worth))
    memory["heading"], memory["chosen_at"] = yaw + best, (x, y)
    return (0.3 if abs(best) < 0.1 else 0.0), 0.0

# %% role="check" tags=["long"]
check("unknown-drive", control)

# %% role="case" title="an unknown room" points=1
def inputs(rng):
    return (unseen_room(rng),)


# %% role="case" title="another room" points=1
def inputs(rng):
    return (unseen_room(rng),)


# %% role="case" title="a third room" points=1
def inputs(rng):
    return (unseen_room(rng),)


# %% role="hidden" title="an unseen room" points=2
def inputs(rng):
    return (unseen_room(rng),)


# %% role="hidden" title="a second unseen room" points=2
def inputs(rng):
    return (unseen_room(rng),)


# %% role="hidden" title="a third unseen room" points=2
def inputs(rng):
    return (unseen_room(rng),)


# %% [markdown]
# ## 5 · Markers and the word ([[minutes]], deeper)
#
# While the robot drives, it can look for markers and for the sign. It stores what it finds in `memory["found"]`; there `exploration_score` looks for it. All places are in the frame of the odometry, which begins at (0, 0) where the drive begins. As an example, the robot stands 1.7 m before the sign of room 33:

# %%
env = RoomEnv(("scan", "depth", "image", "odometry"))
observation, _ = env.reset(seed=1, options={"room": 33, "start": (0.81, 0.25, 3.14)})
show(observation["image"], text="unknown_rooms/view")

# %% [markdown]
# The detector of [[where_am_i#1]] finds the corners of a marker, and `solvePnP` computes where it is, seen from the camera. Then we turn this place by the yaw of the odometry, and add the robot's place. The side of a marker is 0.25 m.

# %% tags=["long"]
image_camera = CameraModel(1280, 720, 705.0, 705.0, 639.5, 359.5,
                           (-0.170, 0.035, 0.0004, -0.0003, 0.0)).resized(320, 180)
detector = cv2.aruco.ArucoDetector(cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50))
square = 0.125 * np.array([(-1, 1, 0), (1, 1, 0), (1, -1, 0), (-1, -1, 0)])


def find_markers(observation):
    """{number: (x, y)} of the markers in the image, in the frame of the odometry."""
    corners, numbers, _ = detector.detectMarkers(cv2.cvtColor(observation["image"], cv2.COLOR_BGR2GRAY))
    x, y, yaw = observation["odometry"].tolist()
    places = {}
    for four, number in zip(corners, [] if numbers is None else numbers.ravel().tolist(), strict=True):
        _, _, (right, _, ahead) = cv2.solvePnP(square, four[0], image_camera.matrix, np.array(image_camera.distortion),
                                               flags=cv2.SOLVEPNP_IPPE_SQUARE)
        forward, left = 0.21 + float(ahead[0]), -float(right[0])
        places[number] = (x + forward * math.cos(yaw) - left * math.sin(yaw),
                          y + forward * math.sin(yaw) + left * math.cos(yaw))
    return places


markers = find_markers(observation)
print({number: (round(x, 1), round(y, 1)) for number, (x, y) in markers.items()})

# %% [markdown]
# Marker 14 is 1.7 m ahead and 0.9 m to the left. Now the word: `rapidocr` of [[reading_text#1]] reads the whole image. With the option `limit_side_len` it does not enlarge the image so much, and needs less than a tenth of a second.

# %% tags=["nbval-ignore-output"]
import rapidocr

reader = rapidocr.RapidOCR(params={
    "Global.log_level": "error", "Det.limit_side_len": 320,
    "EngineConfig.onnxruntime.intra_op_num_threads": 1, "EngineConfig.onnxruntime.inter_op_num_threads": 1})


def read_words(image):
    """Texts in the image that are one word in capital letters."""
    texts = reader(image, use_det=True, use_cls=False, use_rec=True).txts or ()
    return [text for text in texts if text.isalpha() and text.isupper() and len(text) > 4]


words = read_words(observation["image"])
print(words)

# %%
# Check: the marker's place is right within 0.1 m, and the word is that of the room
assert list(markers) == [14] and math.dist(markers[14], (1.71, 0.86)) < 0.1
assert words == [env.room.word] == ["GARAGE"]

# %% [markdown]
# `explorer` joins the parts: it looks for markers at every fifth look and for words at every tenth, and drives with *your* `control` of section 4. A word that was read more often wins, because a single look can be wrong.

# %%
def explorer(observation, memory):
    found = memory.setdefault("found", {"markers": {}, "word": ""})
    look = round(observation["time"] * 10)
    if look % 5 == 0:
        found["markers"].update(find_markers(observation))
    if look % 10 == 0:
        votes = memory.setdefault("votes", {})
        for word in read_words(observation["image"]):
            votes[word] = votes.get(word, 0) + 1
        found["word"] = max(votes, key=votes.get, default="")
    return control(observation, memory)

# %% [markdown]
# Write room numbers of `ROOMS` into `my_rooms`, such as `ROOMS[:3]` or all ten, and run both cells. Each room takes about five seconds. What would find more: to turn around once at the start, to drive nearer to what may be a sign, or to keep the place of a marker from the nearest look?

# %%
my_rooms = ()  # such as ROOMS[:3]

# %%
my_scores = {room: explore(env, explorer, room) for room in with_progress(my_rooms, "driving")}
for room, row in my_scores.items():
    print(room, row)
if my_scores:
    print("mean score:", np.mean([row["score"] for row in my_scores.values()]))

# %% [markdown]
# ## 6 · The league ([[minutes]], deeper)
#
# Ten rooms that you know can be learned by heart, also without intention: you try numbers until they fit. So a fair comparison needs rooms that nobody has seen. Save your controller as a Python file with your name, such as `controllers/anna.py`; the table shows an alias in its place. It has the function `control(observation, memory)`, its imports, and all functions that it uses; `controllers/baseline.py` is an example. `imgproc-course league controllers/` drives all files of this folder through secret rooms, and writes a page with a table, maps and films. The baseline is always in it: do you beat it?

# %% [markdown]
# ## Recap
#
# A score joins what counts: coverage, markers, the word and bumps. A baseline says what a simple controller reaches, and ten rooms say more than one. A robot explores better if it remembers where it was, and drives to what is new.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | scan | (360,) | float32 | above 0, `inf` where it meets nothing | metre |
# | depth image | (90, 160) | uint16 | 0 to 65,535; 0 is no depth | millimetre |
# | image | (180, 320, 3) | uint8 | 0 to 255 | |
# | odometry | (3,) | float64 | yaw −π to π | metre, radian |
# | coverage | one number | float | 0 to 1 | |
# | score | one number | int | 0 or more | points |

# %%
# Check: the numbers in the table
given = controller_observation(scan_env.reset(seed=1)[0])
assert given["scan"].shape == (360,) and given["scan"].dtype == np.float32
assert first["score"] == round(first["score"]) and 0 <= first["coverage"] <= 1

# %% [markdown]
# ## 7 · What next ([[minutes]], deeper)
#
# This was the last lesson. You began with the bytes of one image; now a robot explores rooms that nobody has shown to it. Three projects continue from here, and each has a start.
#
# **Another room.** Every whole number is a room. Choose one, look at it, and let your `explorer` drive in it. What does it not find, and why?

# %%
env.reset(options={"room": 103, "lighting": "evening"}, seed=2)
show(env.frame(), text="unknown_rooms/next")

# %% [markdown]
# **Another sign.** The signs have different words. From how far is each of them read right, by day and in the evening? Measure it with the edit distance of [[reading_text]], from 1 m to 3 m.

# %%
from imgproc_course.simulation import furnished

print({number: furnished(number).word for number in range(101, 106)})

# %% [markdown]
# **A real robot.** A Kachaka has these topics, and your nodes of the lessons use them. Start with a node that only subscribes; a node that drives comes last. If you have another robot, its topics have other names: give them as parameters.
#
# | topic | type | QoS | frame | check before you drive |
# |---|---|---|---|---|
# | `/kachaka/front_camera/image_raw` | `sensor_msgs/msg/Image` | best effort | `camera_front` | `encoding`, width and height: is your code written for this size? |
# | `/kachaka/front_camera/camera_info` | `sensor_msgs/msg/CameraInfo` | best effort | `camera_front` | `k` and `d` belong to this camera, not to that of the course |
# | `/kachaka/lidar/scan` | `sensor_msgs/msg/LaserScan` | best effort | `laser_frame` | `angle_min`: where does the first ray point? |
# | `/kachaka/odometry/odometry` | `nav_msgs/msg/Odometry` | best effort | `odom` | push the robot 1 m by hand: does x grow by 1? |
# | `/kachaka/manual_control/cmd_vel` | `geometry_msgs/msg/Twist` | best effort | | wheels off the floor; start with 0.05 m/s; stop when no image comes for 0.5 s |
#
# The simulated robot has the same topics. To look at those of a robot in your network, start the lessons with its domain (`ROS_DOMAIN_ID=7 environment/lab`), and run `open_camera("topic")`. [[obstacles_ahead]] says what the real robot has in place of the depth image.
#
# And there is the league of section 6.
