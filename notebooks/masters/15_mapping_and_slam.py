# ---
# jupyter:
#   imgproc_course:
#     title: Mapping and SLAM
#     optional: true
# ---

# %% [markdown]
# # Mapping and SLAM
#
# *Optional:* no route needs this lesson, and it has no image in it. The robot draws a map of the room. It drives a circle, and its laser scanner measures the distance to walls and furniture. With exact poses, the map is good. With the poses that the wheels count, each wall appears twice. Then the robot recognizes the place where it began, closes the loop, and corrects its whole path at once. Finding the path and the map together is called *[[term:SLAM]]*: simultaneous localization and mapping.
#
# **You will be able to**
# - find the cells of a grid that a ray passes through,
# - add up what many scans say about a cell, as log-odds,
# - compute how much two poses disagree with a measured motion,
# - recognize a place with two laser scans,
# - correct all poses of a path with the Gauss-Newton method, and measure how much better the map becomes,
# - deeper: a node that maps while the robot drives, and a latched map.
#
# **Time** [[minutes]], with a pause after section 4. **You need** [[where_am_i]], [[drive_the_robot]], and of [[object_tracking#4]] matrices and variance. Only the last part of section 9 needs ROS 2.

# %% role="given" exercise=["mapping-ray", "mapping-scan", "mapping-error"]
import math

import numpy as np

# %% tags=["long"]
import time

from matplotlib.figure import Figure
from scipy.spatial import KDTree

from imgproc_course.display import show, show_figure
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.geometry import (
    ate,
    compose_poses,
    grid_precision_recall,
    grid_ray,
    optimize_pose_graph,
    probability,
    relative_pose,
    update_grid,
)
from imgproc_course.ros import Robot, RosSession, open_camera, ros_available
from imgproc_course.simulation import Simulation
from imgproc_course.simulation.laser import cut
from imgproc_course.simulation.room import recorded_room

# %% role="texts"
figure_texts = {
    "scan": (
        "The first scan: each dot is a place where a ray of the laser scanner ends. The robot stands at the triangle.",
        "Dots from above: they form the outline of a room, with gaps behind furniture.",
    ),
    "ray": (
        "The cells of the ray from (0, 0) to (2, 5): the thin line is the exact ray.",
        "A grid of 3 × 6 squares; six of them are dark, and form stairs from one corner to the other.",
    ),
    "log-odds": (
        "From probability to log-odds: 0.5 becomes 0, and both ends go to infinity.",
        "A curve that rises from the lower left to the upper right, steep at both ends and flat in the middle.",
    ),
    "first map": (
        "The map after one scan: white is free, black is occupied, gray is unknown.",
        "A white star of rays on a gray field; black cells at the ends of the rays.",
    ),
    "doubled": (
        "Left, the map with the true poses; right, with the poses of the wheels: the same scans, but each wall is there twice.",
        "Two maps of a room with a blue circle. Left, clear black walls. Right, tilted and doubled walls, and a circle that does not close.",
    ),
    "matching": (
        "Left, the first scan (gray) and the last one (red), where the wheels say that it is. Right, after the matching: both lie on each other.",
        "Two outlines of a room, turned against each other; on the right, they are one.",
    ),
    "closed": (
        "Left, the map with the poses of the wheels; right, after the correction: the walls are straight, and the circle is closed.",
        "Two maps of a room with a blue circle. Left, doubled walls; right, clear black walls.",
    ),
    "live": (
        "The map that the node published before and after it closed the loop.",
        "Two maps of a room from above, with the path of the robot.",
    ),
}

# %% [markdown]
# ## 1 · A loop in the room ([[minutes]])
#
# The scanner of the robot sends 360 rays in a plane, 10 cm above the floor. Where a ray ends, there is something. The robot drives a circle, and comes back to its start after 25 seconds. Every 0.8 seconds it keeps a scan, and what the wheels say. For the scores, we also keep the true pose.

# %% tags=["long"]
def scan_points(scan):
    """The ends of the rays (N, 2) as the robot sees them: x ahead, y left, in metres."""
    hit = np.isfinite(scan.ranges)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges))[hit]
    x = 0.156 + scan.ranges[hit] * np.cos(angles)  # the scanner is 0.156 m before the axle
    y = scan.ranges[hit] * np.sin(angles)
    return np.column_stack([x, y]).round(6)


start = (0.45, -1.0, 0.0)
robot = Simulation(seed=5, start=start)
scans, counted, truth = [], [], []
for _ in range(33):
    scans.append(scan_points(robot.scan()))
    counted.append(robot.odometry()[:3])
    x, y, _, _, _, qz, qw = robot.pose("robot")
    truth.append((x, y, 2 * math.atan2(qz, qw)))
    for _ in range(4):
        robot.step(0.25, 0.25, dt=0.2)

truth = np.array(truth).round(6)
wheels = compose_poses(start, counted).round(6)  # the wheels count from 0; the robot began at start
print("scans:", len(scans), "  points in the first one:", scans[0].shape)
print("poses:", wheels.shape, "  each one is x, y, yaw")

# %%
figure = Figure(figsize=(6, 3.6), layout="constrained")
axes = figure.subplots()
axes.plot(*scans[0].T, "k.", markersize=3)
axes.plot(0, 0, "b>")
axes.set(xlabel="x (m), ahead", ylabel="y (m), left", aspect="equal")
show_figure(figure, text="mapping_and_slam/scan")

# %%
# Check: the numbers in this section
assert round(sum(math.dist(a, b) for a, b in zip(truth[:-1, :2], truth[1:, :2], strict=True)), 1) == 6.3
assert len(scans) == 33 and wheels.shape == truth.shape == (33, 3) and not robot.bumped
assert math.dist(truth[0, :2], truth[-1, :2]) < 0.1 and 25 < robot.time < 27

# %% [markdown]
# A cloud of dots is not yet a map. A robot that plans its way needs two answers for each place: is there something, is it free, **or do we not know**? So we divide the floor into squares of 5 cm, the *cells* of an *[[term:occupancy grid]]*. Each ray says two things: its last cell is occupied, and all cells on the way are free.
#
# ## 2 · The cells of a ray ([[minutes]])
#
# A ray begins in the cell (0, 0), row and column, and ends in (2, 5). Which cells does it pass through? It goes 2 rows and 5 columns far. So it takes 5 *steps*, the larger of both numbers. In each step the column grows by 1, and the row by 2/5. **Predict** the row after the second step, in the cell of column 2.

# %% role="predict"
guess_row = None  # your guess: 0, 1 or 2?

# %%
steps = 5
exact = [2 * k / steps for k in range(steps + 1)]
print("exact rows:", exact)
compare_guess(guess_row, round(exact[2]))

# %% [markdown]
# The exact row is 0.8, and the nearest whole row is 1. What if the exact row is 0.5? Then both rows are equally near, and we take the one that is **farther from the start**. Python's `round` does not do that: `round(0.5)` is 0, and `round(1.5)` is 2.
#
# So we add 1/2 and round down: rows · k / steps + 1/2. With both parts of the fraction times 2, all numbers stay whole: `(2 * k * rows + steps) // (2 * steps)`. Here for a ray of 2 rows and 4 columns:

# %%
rows, steps = 2, 4
print("exact:", [rows * k / steps for k in range(steps + 1)])
print("round:", [round(rows * k / steps) for k in range(steps + 1)])
print("ours: ", [(2 * k * rows + steps) // (2 * steps) for k in range(steps + 1)])

# %% [markdown]
# The formula needs a way that is **not negative**, because `//` rounds down. For a ray that goes up or to the left, compute with the length of the way, `abs(rows)`, and then multiply the result by the sign:

# %%
way, steps = -2, 4
sign = 1 if way > 0 else -1
print([3 + sign * ((2 * k * abs(way) + steps) // (2 * steps)) for k in range(steps + 1)])

# %% [markdown]
# This ray begins in row 3 and ends in row 1. J. Bresenham found in 1962 how a pen plotter can do all of this with additions alone; the method is called *[[term:Bresenham's line]]*. `grid_ray` of the course's package computes the same cells:

# %%
cells = grid_ray((0, 0), (2, 5))
print(cells.tolist())
grid = np.zeros((3, 6))
grid[cells[:, 0], cells[:, 1]] = 1
figure = Figure(figsize=(5, 2.4), layout="constrained")
axes = figure.subplots()
axes.imshow(grid, cmap="Blues", vmax=1.4)
axes.plot([0, 5], [0, 2], "r")
axes.set(xlabel="column", ylabel="row", yticks=[0, 1, 2])
show_figure(figure, text="mapping_and_slam/ray")

# %%
# Check: the numbers in this section
assert exact[2] == 0.8 and [round(0.5), round(1.5)] == [0, 2]
assert cells.tolist() == [[0, 0], [0, 1], [1, 2], [1, 3], [2, 4], [2, 5]]
assert grid_ray((3, 4), (1, 8))[:, 0].tolist() == [3, 2, 2, 1, 1]

# %% [markdown]
# ### Your turn: the cells of a ray
#
# Write `ray_cells(start, end)`, for rays in all directions, also steep ones.
#
# | Input | Output | Example call |
# |---|---|---|
# | `start`, `end`: two different cells, each (row, column), whole numbers | a list of cells (row, column) from start to end, both included; of two equally near rows or columns the one farther from the start | `ray_cells((0, 0), (2, 4))` returns `[(0, 0), (1, 1), (1, 2), (2, 3), (2, 4)]` |

# %% role="exercise"
exercise(
    "mapping-ray",
    title="The cells of a ray",
    function="ray_cells",
    hint="steps is the larger of both ways; after step k: start + sign * ((2 * k * abs(way) + steps) // (2 * steps)), for the row and for the column, each with the sign of its own way.",
    hints=(
        "How many steps does the ray take, and how far has it gone in rows and in columns after step k?",
        "1. The ways: end row minus start row, end column minus start column.\n"
        "2. The steps: the larger of both lengths (abs).\n"
        "3. For k from 0 to steps (included): the row and the column by the formula, each with its sign.\n"
        "4. Append (row, column) to a list.",
        "row_way, col_way = end[0] - start[0], ...\nsteps = max(abs(row_way), ...)\ncells = []\nfor k in range(steps + 1):\n"
        "    rows = (2 * k * abs(row_way) + steps) // (2 * steps)\n    cols = ...\n"
        "    cells.append((start[0] + rows * (1 if row_way > 0 else -1), ...))\nreturn cells",
    ),
    explanation="The formula is the exact way, k * way / steps, rounded to the nearest whole number, with halves away from the start."
    " Along the longer way it gives k itself, so no cell is left out. The same formula works for rows and columns."
    " A ray of one cell has no step, and the formula would divide by zero: its only cell is the start.",
    another_way="Bresenham's way: add 2 * abs(way) to a counter in each step; if it reaches steps, go one row on and subtract 2 * steps.",
)


def far_cell(rng, start, rows, cols):
    """A cell so many rows and columns away, in any of the four directions."""
    return int(start[0] + rows * rng.choice([-1, 1])), int(start[1] + cols * rng.choice([-1, 1]))


def far_ray(rng):
    return (20, 20), far_cell(rng, (20, 20), int(rng.integers(5, 9)), int(rng.integers(10, 14)))

# %% role="answer"
def ray_cells(start, end):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def ray_cells(start, end):
    row_way, col_way = end[0] - start[0], end[1] - start[1]
    steps = max(abs(row_way), abs(col_way))
    if steps == 0:
        return [start]
    cells = []
    for k in range(steps + 1):
        rows = (2 * k * abs(row_way) + steps) // (2 * steps)
        cols = (2 * k * abs(col_way) + steps) // (2 * steps)
        row = start[0] + rows * (1 if row_way > 0 else -1)
        col = start[1] + cols * (1 if col_way > 0 else -1)
        cells.append((row, col))
    return cells


# %% role="check"
check("mapping-ray", ray_cells)

# %% role="case" title="flat rays to the right" points=1
def inputs(rng):
    return [((0, 0), (2, 5)), ((0, 0), (2, 4)), ((3, 1), (3, 6)), ((1, 2), (4, 2 + int(rng.integers(5, 9))))]


# %% role="case" title="all directions" points=1 hint="The number of steps is the larger of both ways, without its sign. Rows and columns have a sign each, outside of // or floor, which round down. The first cell is start, the last one is end, and each is (row, column)."
def inputs(rng):
    return [((5, 5), (1, 7)), ((6, 9), (4, 2)), ((0, 8), (9, 3)), ((8, 3), (0, 3)), ((7, 7), (3, 3)), ((2, 9), (4, 5)), ((9, 1), (7, 5)), ((1, 7), (5, 5)),
            far_ray(rng)]


# %% role="hidden" title="any rays" points=1 hint="Are both ends there, and is a half rounded away from the start in every direction?"
def inputs(rng):
    starts = [(10, 12), (20, 11), (15, 15), (13, 19), (14, 10)]
    return [(start, far_cell(rng, start, rows, cols)) for start, (rows, cols) in zip(starts, ((3, 8), (9, 6), (1, 2), (8, 4), (5, 10)), strict=True)] + [
        ((12, 12), (11, 2)), ((12, 12), (3, 11))]


# %% [markdown]
# ## 3 · How sure is a cell? ([[minutes]])
#
# One scan can be wrong: a ray hits the leg of a person who walks by, or passes a corner. So each scan only makes a cell *more* or *less* likely to be occupied. If a ray ends in a cell, something is there with a [[term:probability]] of 0.7, as long as we know nothing else. If a ray passes, with 0.4: this says less, because a ray can pass beside a thin leg. Both numbers are choices.
#
# How do we join such answers? The *[[term:odds]]* of a probability p are p / (1 − p): 0.7 gives 7 to 3, that is 2.33. A hit is then 2.33 times as frequent at occupied cells as at free ones. Say that of 400 cells, 100 are occupied: the odds are 1 to 3. Hits are at 70 of these 100, and at 90 of the 300 free ones. So among the cells with a hit, the odds are 70 to 90, which is 2.33 times as much. Each independent answer **multiplies** the odds. And so that we can **add**, we take the logarithm. This is the *[[term:log-odds]]*:
#
# $$l = \log \frac{p}{1 - p}$$

# %%
for p in (0.4, 0.5, 0.7, 0.9):
    odds = p / (1 - p)
    print("probability", p, "  odds", round(odds, 2), "  log-odds", round(math.log(odds), 2))

# %%
p = np.linspace(0.01, 0.99, 99)
figure = Figure(figsize=(5, 2.6), layout="constrained")
axes = figure.subplots()
axes.plot(p, np.log(p / (1 - p)).round(3))
axes.axhline(0, color="0.7")
axes.set(xlabel="probability", ylabel="log-odds")
show_figure(figure, text="mapping_and_slam/log-odds")

# %% [markdown]
# 0 means: we do not know. So the map begins with zeros, each hit adds 0.85, and each ray that passes takes away 0.4. Two hits and one passing ray: 0.85 + 0.85 − 0.4 = 1.3. Back to a probability, it is 0.79. We limit the number to the range −6 to 6, so that new hits and rays can still change every cell.
#
# Many rays have passed through a cell, so it is at −6. Now somebody puts a chair there, and each scan hits it. **Predict** after how many hits the cell is occupied, that is above 0.

# %% role="predict"
guess_hits = None  # your guess: how many hits?

# %%
level, hits = -6.0, 0
while level <= 0:
    level += 0.85
    hits += 1
compare_guess(guess_hits, hits)

# %% [markdown]
# Now a whole scan, in a small grid. The robot stands in the cell (1, 0). One ray passes two cells and ends in (1, 3); another one ends in (0, 2). In one scan, **each cell changes once**, no matter how many rays pass: rays near the robot share their cells. First we collect the changes in a grid of their own, one cell at a time, and write the ends last:

# %%
change = np.zeros((3, 4))
for row, col in [(1, 0), (1, 1), (1, 2), (0, 1)]:  # passed
    change[row, col] = -0.4
for row, col in [(1, 3), (0, 2)]:  # the ends
    change[row, col] = 0.85
print(change)

# %% [markdown]
# Then the change is added to the map, and `np.clip` stops each cell at the limits:

# %%
few = np.array([-5.9, 0.0, 5.9])
print(np.clip(few + np.array([-0.4, -0.4, 0.85]), -6, 6))

# %%
# Check: the numbers in this section
assert round(0.7 / 0.3, 2) == 2.33 and round(math.log(0.7 / 0.3), 2) == 0.85 and round(math.log(0.4 / 0.6), 1) == -0.4
assert hits == 8 and round(float(probability(1.3)), 2) == 0.79 and math.isclose((70 / 90) / (100 / 300), 0.7 / 0.3)

# %% [markdown]
# ### Your turn: add a scan to the map
#
# Write `add_scan(grid, rays, hit, passed)`. Of one scan, the end of a ray counts more: a cell where one ray ends is a hit, even if other rays pass through it.
#
# | Input | Output | Example call |
# |---|---|---|
# | `grid`: (rows, columns) float, log-odds; `rays`: a list of rays, each a list of cells (row, column), the last one is where it ends; `hit` and `passed`: two probabilities, such as 0.7 and 0.4 | a **new** grid: the log-odds of `hit` added where a ray ends, those of `passed` added in the other cells of the rays, each cell once, and then all between −6 and 6 | `add_scan(np.zeros((1, 3)), [[(0, 0), (0, 1), (0, 2)]], 0.7, 0.4)` returns `[[-0.41, -0.41, 0.85]]`, with more digits |

# %% role="exercise"
exercise(
    "mapping-scan",
    title="Add a scan to the map",
    function="add_scan",
    tolerance=1e-6,
    hint="A grid of zeros for the change: math.log(passed / (1 - passed)) in ray[:-1] of all rays, then math.log(hit / (1 - hit)) at ray[-1] of all rays, each with = and not +=, because a cell changes once; then np.clip(grid + change, -6, 6).",
    hints=(
        "What must be written last, so that a cell where one ray ends stays a hit?",
        "1. A grid of zeros of the same shape, for the changes.\n"
        "2. For each ray, for each cell but its last: write the log-odds of passed.\n"
        "3. In a second loop over all rays: at the last cell, write the log-odds of hit.\n"
        "4. Add the changes to the grid, and clip the result at -6 and 6.",
        "change = np.zeros(grid.shape)\nfor ray in rays:\n    for row, col in ray[:-1]:\n        change[row, col] = math.log(passed / ...)\n"
        "for ray in rays:\n    row, col = ray[-1]\n    change[...] = math.log(hit / ...)\nreturn np.clip(grid + ..., -6, 6)",
    ),
    explanation="A cell that is written twice keeps the last value, so each cell changes once, and the second loop makes hits win."
    " grid + change makes a new array: the grid that was given stays as it was.",
    another_way="You can also use two masks: passed_mask and hit_mask, both of bool, and then np.where.",
)


def line_between(start, end):
    """Some cells from start to end; which ones exactly does not matter here."""
    ways = [end[axis] - start[axis] for axis in (0, 1)]
    steps = max(abs(way) for way in ways)
    return [tuple(start[axis] + round(k * ways[axis] / steps) for axis in (0, 1)) for k in range(steps + 1)]


def fan(rng, shape, count, robot=None):
    """Rays from one cell to cells at the border of the grid, as lists of cells."""
    rows, cols = shape
    robot = robot or (rows // 2, cols // 2)
    border = [(row, col) for row in range(rows) for col in range(cols) if row in (0, rows - 1) or col in (0, cols - 1)]
    ends = [border[int(k)] for k in rng.permutation(len(border))[:count]]
    lines = [line_between(robot, end) for end in ends if end != robot]
    return [line[: max(2, len(line) - int(rng.integers(0, 2)))] for line in lines]


def one_map(rng, shape):
    return rng.uniform(-5.9, 5.9, shape).round(2)

# %% role="answer"
def add_scan(grid, rays, hit, passed):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(passed / (1 - passed))
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    return np.clip(grid + change, -6, 6)

# %% role="check"
check("mapping-scan", add_scan)

# %% role="case" title="one ray, and two rays that cross" points=1
def inputs(rng):
    cross = [[(1, 0), (1, 1), (1, 2), (1, 3)], [(1, 0), (1, 1), (0, 2)], [(1, 0), (1, 1), (1, 2)], [(2, 2), (1, 2)]]
    hit = round(float(rng.uniform(0.6, 0.8)), 2)
    return [(np.zeros((1, 3)), [[(0, 0), (0, 1), (0, 2)]], 0.7, 0.4), (np.zeros((3, 4)), cross, hit, 0.4), (np.zeros((3, 4)), cross[::-1], hit, 0.4),
            (np.zeros((5, 6)), fan(rng, (5, 6), 4), hit, 0.4)]


# %% role="case" title="a map that knows something already" points=1 hint="Do you add to the old map, and does each cell stay between -6 and 6?"
def inputs(rng):
    old = np.array([[5.8, -5.9, 1.0], [0.5, -2.0, 5.9]])
    return [(old, [[(1, 0), (0, 1), (0, 2)], [(1, 0), (1, 1), (1, 2)]], 0.7, 0.4), (one_map(rng, (5, 6)), fan(rng, (5, 6), 6), 0.8, 0.3),
            (-old, [[(0, 1), (0, 0)], [(0, 1), (1, 2)]], 0.6, 0.45)]


# %% role="hidden" title="any scan" points=1 hint="Does each cell change once, and does a hit win? Is the given grid unchanged?"
def inputs(rng):
    return [(one_map(rng, (8, 9)), fan(rng, (8, 9), 14), 0.7, 0.4), (np.zeros((7, 7)), fan(rng, (7, 7), 20), 0.9, 0.35),
            (np.array([[5.9, -5.95, 0.0, 5.9]]), [[(0, 0), (0, 1), (0, 2), (0, 3)], [(0, 0), (0, 1), (0, 2)]], 0.65, 0.4),
            (np.array([[5.9, -5.95, 0.0, 5.9]]), [[(0, 0), (0, 1), (0, 2)], [(0, 0), (0, 1), (0, 2), (0, 3)]], 0.65, 0.4)]


# %% [markdown]
# ## 4 · Two maps of one room ([[minutes]])
#
# Our map has 110 × 150 cells of 5 cm. Its first cell is at x = −1.5 m and y = −2.7 m. A scan is given as the robot sees it, so first its points go into the room, turned and shifted by the pose of the robot, as in [[drive_the_robot]]. Then each point has a cell:

# %%
cell_size = 0.05  # metres
corner = np.array([-1.5, -2.7])  # x and y of the first cell's corner


def to_room(pose, points):
    """Points (N, 2) that the robot sees, as points of the room."""
    x, y, yaw = pose
    c, s = math.cos(yaw), math.sin(yaw)
    ahead, left = points[:, 0], points[:, 1]
    return np.column_stack([x + c * ahead - s * left, y + s * ahead + c * left]).round(6)


def cells_of(points):
    """The cells (row, column) of points (x, y) of the room: x gives the column."""
    return np.floor((points - corner) / cell_size).astype(int)[:, ::-1]

# %% [markdown]
# `update_grid` of the course's package does what your function does, and finds the cells of the rays itself. All scans together make the map:

# %%
def make_map(poses, scans):
    """The log-odds (110, 150) after all scans."""
    grid = np.zeros((110, 150))
    for pose, points in zip(poses, scans, strict=True):
        scanner = cells_of(to_room(pose, np.array([[0.156, 0.0]])))[0]
        grid = update_grid(grid, scanner, cells_of(to_room(pose, points)))
    return grid

# %%
def draw_map(axes, grid, poses, title):
    """White is free, black is occupied, gray is unknown; the path is blue."""
    right, top = corner + cell_size * np.array(grid.shape)[::-1]
    axes.imshow(np.clip(-grid.round(3), -0.5, 0.5), cmap="gray", vmin=-0.5, vmax=0.5,
                origin="lower", extent=(corner[0], right, corner[1], top))
    axes.plot(*np.asarray(poses)[:, :2].T, "b.-", markersize=3, linewidth=1)
    axes.set(title=title, xlabel="x (m)", ylabel="y (m)", aspect="equal")

# %%
first_map = make_map(truth[:1], scans[:1])
print("after one scan: occupied", (first_map > 0).sum(), "  free", (first_map < 0).sum(),
      "  unknown", (first_map == 0).sum())
figure = Figure(figsize=(6, 4), layout="constrained")
draw_map(figure.subplots(), first_map, truth[:1], "one scan")
show_figure(figure, text="mapping_and_slam/first map")

# %% [markdown]
# How good is a map? For the score we need the truth: the cells of all walls and furniture at the height of the scanner. [[edge_detection_node]] had the two numbers for it: *[[term:precision]]*, the share of the occupied cells where there really is something, and *[[term:recall]]*, the share of the real cells that the map has found. A cell beside the right one is good enough.

# %% tags=["long"]
room = recorded_room()
walls = cut(room.model.triangles[room.model.joint < 0], 0.105)  # lines (N, 2, 2) of all that stands still
shares = np.linspace(0, 1, 400)[:, np.newaxis, np.newaxis]
points = (walls[:, 0] + shares * (walls[:, 1] - walls[:, 0])).reshape(-1, 2)
rows, cols = cells_of(points).T
inside = (rows >= 0) & (rows < 110) & (cols >= 0) & (cols < 150)
real = np.zeros((110, 150), bool)
real[rows[inside], cols[inside]] = True

true_map = make_map(truth, scans)
precision, recall = grid_precision_recall(true_map, real)
print("true poses:  precision", round(precision, 2), "  recall", round(recall, 2))

# %% [markdown]
# That is with the true poses, which a robot does not know. It knows its wheels. In [[drive_the_robot#5]], they were wrong by 15 cm after a small square. Now the robot is back at its start, after 6.3 m in a circle. **Predict** how far from its true place it is according to the wheels, in centimetres.

# %% role="predict"
guess_wheels = None  # your guess: how many centimetres?

# %%
error_wheels = 100 * math.dist(wheels[-1, :2], truth[-1, :2])
print("yaw of the wheels: wrong by", round(math.degrees(abs(relative_pose(wheels[-1], truth[-1])[2]))), "degrees")
compare_guess(guess_wheels, round(error_wheels), "cm")

# %%
wheels_map = make_map(wheels, scans)
wheels_precision, wheels_recall = grid_precision_recall(wheels_map, real)
print("wheels:  precision", round(wheels_precision, 2), "  recall", round(wheels_recall, 2))
figure = Figure(figsize=(9, 3.7), layout="constrained")
left, right = figure.subplots(1, 2)
draw_map(left, true_map, truth, "true poses")
draw_map(right, wheels_map, wheels, "poses of the wheels")
show_figure(figure, text="mapping_and_slam/doubled")

# %% [markdown]
# The same scans, but each wall is there twice, or three times: this map is useless. The scanner is exact; only the poses are wrong. The rest of this lesson repairs them.
#
# One question before that. A toy car drove through the room all the time, and the scanner saw it in 30 of the 33 scans. **Why is it not in the map?** Look at the log-odds of the cells where it was:

# %%
levels, seen = [], 0
for k in range(33):
    place = np.array([room.car.at(0.8 * k, room.rug)[0][:2]])  # the car at the time of the scan
    row, col = cells_of(place)[0]
    levels.append(float(true_map[row, col]))
    seen += bool((np.linalg.norm(to_room(truth[k], scans[k]) - place, axis=1) < 0.25).any())
print("seen in", seen, "scans;   log-odds from", round(min(levels), 2), "to", round(max(levels), 2))

# %% [markdown]
# In each cell the car was seen in one or two scans, and in all others the rays passed. One hit adds 0.85, and thirty passing rays take away 12: the sum says *free*. What moves leaves no trace, if there are enough scans.

# %%
# Check: the numbers in this section
assert round(precision, 2) == 0.99 and round(recall, 2) == 0.97
assert round(wheels_precision, 2) == 0.41 and round(wheels_recall, 2) == 0.53 and round(error_wheels) == 59
assert seen == 30 and max(levels) < -4 and min(levels) == -6
assert (first_map > 0).sum() + (first_map < 0).sum() + (first_map == 0).sum() == 110 * 150

# %% [markdown]
# This is a good place for a pause.
#
# ## 5 · What an edge says ([[minutes]])
#
# The wheels are wrong about the whole way, but about one step from a pose to the next, they are nearly right. So we keep the small steps, and leave open where the poses are. Such a net is called a *[[term:pose graph]]*: its nodes are poses (x, y, yaw), and each *edge* is a measured motion from one pose to another one: so far ahead, so far to the left, and turned by so much.
#
# If the robot stands at (1, 1) and looks along y (yaw 90°), and another pose is at (1, 3), then this pose is 2 m *ahead*, although only y is different. With c and s, the cosine and sine of the first yaw:
#
# $$\text{ahead} = c\,(x_2 - x_1) + s\,(y_2 - y_1) \qquad \text{left} = c\,(y_2 - y_1) - s\,(x_2 - x_1)$$

# %%
first, second = (1.0, 1.0, math.radians(90)), (1.0, 3.0, math.radians(120))
c, s = math.cos(first[2]), math.sin(first[2])
dx, dy = second[0] - first[0], second[1] - first[1]
print("ahead:", round(c * dx + s * dy, 3), "  left:", abs(round(c * dy - s * dx, 3)))
print("turned:", round(math.degrees(second[2] - first[2])), "degrees")

# %% [markdown]
# Now the wheels measured something else for this edge: 1.9 m ahead, 0.1 m to the left, turned by 30 degrees. The *error* of the edge is the difference: what the poses say, less what was measured. Here it is 0.1, −0.1 and 0.
#
# There is a trap in the angle. One pose has the yaw 170°, the next one −170°. **Predict** how many degrees the robot has turned between them, to the left.

# %% role="predict"
guess_turn = None  # your guess: how many degrees?

# %%
plain = -170 - 170
short = math.remainder(plain, 360)
print("plain difference:", plain)
compare_guess(guess_turn, round(short), "degrees")

# %% [markdown]
# The plain difference is almost a full turn, which no robot does in 0.8 seconds. `math.remainder(angle, 2 * math.pi)` brings each angle between −π and π: we say that the angle is *wrapped*. Wrap at the very end, after the measured angle has been subtracted, because the difference of two wrapped angles can be too large again.

# %%
# Check: the numbers in this section
assert abs(c * dx + s * dy - 2) < 1e-9 and abs(c * dy - s * dx) < 1e-9
assert plain == -340 and short == 20

# %% [markdown]
# ### Your turn: the error of an edge
#
# Write `edge_error(first, second, measured)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `first`, `second`: two poses (x, y, yaw), metres and radians; `measured`: the motion (ahead, left, turned) from the first to the second | array (3,): what the poses say, less what was measured; the angle between −π and π | `edge_error((1, 1, math.pi / 2), (1, 3, math.pi / 2), (1.9, 0.1, 0))` returns `[0.1, -0.1, 0]` |

# %% role="exercise"
exercise(
    "mapping-error",
    title="The error of an edge",
    function="edge_error",
    tolerance=1e-6,
    hint="ahead = c * dx + s * dy, left = c * dy - s * dx with the first yaw; subtract what was measured; math.remainder(..., 2 * math.pi) for the angle, at the end.",
    hints=(
        "How does the first pose see the second one: how far ahead, how far to the left, and turned by how much?",
        "1. dx and dy: the second place less the first one.\n"
        "2. c and s: cosine and sine of the first yaw; ahead and left by the formula.\n"
        "3. Subtract the measured motion from ahead and left.\n"
        "4. The angle: second yaw minus first yaw minus measured angle, and then math.remainder.",
        "dx, dy = second[0] - first[0], ...\nc, s = math.cos(first[2]), ...\nahead, left = c * dx + s * dy, ...\n"
        "angle = math.remainder(second[2] - first[2] - measured[2], ...)\nreturn np.array([ahead - measured[0], ..., angle])",
    ),
    explanation="The formula turns the way from the room's axes into the robot's: by minus the first yaw. If all poses are shifted or"
    " turned together, the error stays the same; so the first pose of a graph must be held fixed.",
    another_way="You can also multiply with a matrix: np.array([[c, s], [-s, c]]) @ (second[:2] - first[:2]), with arrays.",
)


def wrapped(angle):
    return math.remainder(angle, 2 * math.pi)


def any_edge(rng, yaw, turn, off=0.2):
    """An edge whose first pose has this yaw, and that turns by so much; the motion is measured with an error."""
    x, y, left = rng.uniform(-0.8, 0.8, 3).round(2).tolist()
    ahead = round(float(rng.uniform(0.5, 1.5)), 2)
    c, s = math.cos(yaw), math.sin(yaw)
    second = (round(x + c * ahead - s * left, 4), round(y + s * ahead + c * left, 4), round(wrapped(yaw + turn), 4))
    errors = rng.uniform(0.05, off, 3) * rng.choice([-1, 1], 3)
    measured = tuple(float(v) for v in np.round(np.array([ahead, left, turn]) + errors, 3))
    return (x, y, round(wrapped(yaw), 4)), second, measured


# %% role="answer"
def edge_error(first, second, measured):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def edge_error(first, second, measured):
    dx, dy = second[0] - first[0], second[1] - first[1]
    c, s = math.cos(first[2]), math.sin(first[2])
    ahead, left = c * dx + s * dy, c * dy - s * dx
    angle = math.remainder(second[2] - first[2] - measured[2], 2 * math.pi)
    return np.array([ahead - measured[0], left - measured[1], angle])

# %% role="check"
check("mapping-error", edge_error)

# %% role="case" title="small turns" points=1
def inputs(rng):
    return [((1.0, 1.0, math.pi / 2), (1.0, 3.0, math.pi / 2), (1.9, 0.1, 0.0)), ((0.0, 0.0, 0.0), (9.0, 1.0, 0.2), (2.0, 0.5, 0.1)), any_edge(rng, 0.6, 0.4), any_edge(rng, -1.1, -0.5)]


# %% role="case" title="angles across π" points=1 hint="Is the angle brought between -π and π at the very end, after the measured angle is subtracted?"
def inputs(rng):
    return [any_edge(rng, 2.9, 0.7), any_edge(rng, -2.8, -0.9), ((0.0, 0.0, 3.0), (1.0, 0.5, -3.0), (1.0, 0.5, 0.2)),
            ((0.5, 0.0, -1.5), (0.0, 1.0, 1.4), (0.3, 0.2, -2.9)), ((0.5, 0.0, 1.5), (0.0, 1.0, -1.4), (0.3, 0.2, 2.9)),
            ((0.0, 0.0, 1.0), (1.0, 0.2, -1.2), (0.8, 0.1, -0.1))]


# %% role="hidden" title="any edges" points=1 hint="Are ahead and left computed with the first yaw, and is the measured motion subtracted?"
def inputs(rng):
    return [any_edge(rng, float(rng.uniform(-3, 3)), float(rng.uniform(-1, 1))) for _ in range(3)] + [
        any_edge(rng, 2.5, 1.5), any_edge(rng, -2.6, -1.2), ((2.0, 1.0, 2.0), (1.0, 0.0, -1.2), (0.9, -0.6, -2.9))]


# %% [markdown]
# ## 6 · I have been here before ([[minutes]])
#
# With the edges of the wheels alone, nothing can be corrected: each pose follows from the one before, and no edge contradicts another. We need an edge that goes back: the robot must notice that it is at a place where it has been. This is a *[[term:loop closure]]*. A person would recognize the sofa. The robot compares two scans: if they come from almost the same place, they lie on each other after a small shift and turn. This is called *[[term:scan matching]]*.
#
# If we knew which point of one scan belongs to which point of the other, this would be the motion of a cloud, as in [[where_am_i#5]]. There U @ V was the nearest rotation. In the plane we need no SVD: two sums give the angle.

# %%
def planar_motion(before, after):
    """The motion (x, y, yaw) that takes the points before to those after, (N, 2) each."""
    b, a = before - before.mean(axis=0), after - after.mean(axis=0)
    across = (b[:, 0] * a[:, 1] - b[:, 1] * a[:, 0]).sum()
    along = (b[:, 0] * a[:, 0] + b[:, 1] * a[:, 1]).sum()
    yaw = math.atan2(across, along)
    x, y = after.mean(axis=0) - to_room((0, 0, yaw), before).mean(axis=0)
    return x, y, yaw


few = np.array([[0.0, 0], [3, 0], [0, 6]])
print(np.round(planar_motion(few, to_room((5, 1, 0.5), few)), 3))

# %% [markdown]
# But which points belong together is not known. So we guess: to each point of the second scan belongs the **nearest** point of the first one. Most of these pairs are wrong, but the motion that they give is a little better than no motion. Move the points, look for the nearest ones again, and so on, 30 times. This is called *[[term:iterative closest point]]*, ICP. Pairs that are far from each other are left out.

# %%
def match(first, second, guess):
    """Where the second scan was taken, seen from the first, and the share of points that fit."""
    tree = KDTree(first)  # finds nearest points fast
    motion = guess
    for _ in range(30):
        distance, nearest = tree.query(to_room(motion, second))
        near = distance < max(0.1, 2 * np.median(distance))
        motion = planar_motion(second[near], first[nearest[near]])
    distance, _ = tree.query(to_room(motion, second))
    return motion, float((distance < 0.05).mean())  # metres

# %% [markdown]
# The last pose and the first one: the wheels say that they are 53 cm apart. ICP needs a first guess, and it goes only to the nearest solution, which may be a wrong one. So we try two guesses: what the wheels say, and "the same place". How many points fit in the end shows which one is right:

# %%
by_wheels, share_wheels = match(scans[0], scans[32], relative_pose(wheels[0], wheels[32]))
same_place, share_same = match(scans[0], scans[32], (0.0, 0.0, 0.0))
print("from the wheels:     about", 10 * round(10 * share_wheels), "% of the points fit")
print("from the same place: about", 10 * round(10 * share_same), "% of the points fit")

# %%
true_motion = relative_pose(truth[0], truth[32])
error = np.abs(relative_pose(true_motion, same_place))
print("error below 1 cm:", math.hypot(error[0], error[1]) < 0.01,
      "  and below half a degree:", math.degrees(error[2]) < 0.5)

# %% tags=["nbval-ignore-output", "long"]
figure = Figure(figsize=(9, 3.7), layout="constrained")
parts = figure.subplots(1, 2, sharey=True)
motions = {"where the wheels say": relative_pose(wheels[0], wheels[32]), "after the matching": same_place}
for axes, (title, motion) in zip(parts, motions.items(), strict=True):
    axes.plot(*scans[0].T, ".", color="0.6", markersize=6)
    axes.plot(*to_room(motion, scans[32]).T, "r.", markersize=2)
    axes.set(title=title, xlabel="x (m)", ylabel="y (m)", aspect="equal")
show_figure(figure, text="mapping_and_slam/matching")

# %%
# Check: the numbers in this section
assert np.allclose(planar_motion(few, to_room((5, 1, 0.5), few)), (5, 1, 0.5), atol=1e-5)
assert round(100 * math.dist(wheels[0, :2], wheels[32, :2])) == 53
assert 0.46 < share_wheels < 0.52 and 0.92 < share_same < 0.95 and math.hypot(error[0], error[1]) < 0.01 and error[2] < math.radians(0.5)

# %% [markdown]
# So a loop closure needs **two** signs: the poses are near each other, as far as the wheels know, **and** most points fit. The first one alone is too weak, because the wheels drift. Is the second one enough? In a hotel, all rooms have the same outline. A *wrong* loop closure bends the whole map, so one asks for both. A marker on the wall, as in [[where_am_i#3]], is a third sign.
#
# And there must be time between both poses: two neighbours always look alike, but they say nothing about the drift.

# %% [markdown]
# ## 7 · Pull the graph straight ([[minutes]])
#
# Now some edges contradict each other. First on a line: three poses at x = 0, 1 and 2. The wheels have measured 1.0 and 1.0. Then the robot compares the scans, and measures that the last pose is only 1.7 after the first. The errors of the three edges:

# %%
x = np.array([0.0, 1.0, 2.0])
errors = np.array([x[1] - x[0] - 1.0, x[2] - x[1] - 1.0, x[2] - x[0] - 1.7])
print(errors.round(2))

# %% [markdown]
# We look for the poses with the smallest sum of squared errors ([[term:least squares]]). The first pose stays where it is. The *[[term:Jacobian]]* J says how each error changes if a pose moves by 1: one row for each edge, one column for each pose. The first edge is x₁ − x₀ − 1: its error grows by 1 with x₁, and falls by 1 with x₀.

# %%
J = np.array([[-1.0, 1, 0],
              [0, -1, 1],
              [-1, 0, 1]])
J = J[:, 1:]  # the first pose is fixed: leave its column out

# %% [markdown]
# Why leave the column out? All poses could move together without changing any error, so there would be no single solution: `solve` would stop with *Singular matrix*.
#
# After a step, the errors are errors + J · step. When is their sum of squares smallest? Think of each error as a spring. At the best poses, the pulls on each pose are in balance: for each column of J, the sum of J · error is 0. All these sums are one product, Jᵀ · (errors + J · step) = 0. So there are as many equations as unknowns, the *[[term:normal equations]]*, and `np.linalg.solve` solves them:
#
# $$J^T J \cdot \text{step} = -J^T \cdot \text{errors}$$
#
# **Predict** where the pose in the middle goes to, if all three edges are equally exact.

# %% role="predict"
guess_middle = None  # your guess: which x?

# %%
H = J.T @ J
step = np.linalg.solve(H, -J.T @ errors)
print("step:", step.round(3))
compare_guess(guess_middle, round(float(x[1] + step[0]), 2))

# %% [markdown]
# The contradiction of 0.3 is shared: each edge now has an error of 0.1. But a scan is more exact than the wheels. So each edge gets the weight 1 / variance, as in [[object_tracking#4]], in a diagonal matrix W:

# %%
W = np.diag([1.0, 1.0, 100.0])  # the third edge is ten times as exact
step = np.linalg.solve(J.T @ W @ J, -J.T @ W @ errors)
print("step:", step.round(3))

# %% [markdown]
# Now the wheels give way, and the exact edge keeps its 1.7 almost exactly.
#
# In the plane, a pose has three numbers. The error is not a linear function of the yaw, so one step does not reach the goal: after it, errors and Jacobian are computed again, and so on. This is the *[[term:Gauss-Newton method]]*; `optimize_pose_graph` of the course's package does it for a whole graph: there each edge has three rows of J, and each pose three columns.

# %%
# Check: the numbers in this section; after the step, the pulls are in balance
moved = x + np.append(0, np.linalg.solve(H, -J.T @ errors))
assert np.allclose(errors, [0, 0, 0.3]) and np.allclose(moved, [0, 0.9, 1.8]) and np.allclose(J.T @ (errors + J @ (moved - x)[1:]), 0)
assert np.allclose(step, [-0.1493, -0.2985], atol=1e-4)

# %% [markdown]
# ## 8 · The map afterwards ([[minutes]])
#
# Now for our circle. The pairs that may close a loop are those whose wheels say that they are at most 1 m apart, and that are at least 12 poses from each other. The scans decide:

# %%
shares, motions = np.zeros((33, 33)), {}
for i in range(33):
    for j in range(i + 12, 33):
        if math.dist(wheels[i, :2], wheels[j, :2]) <= 1.0:
            tries = [match(scans[i], scans[j], guess)
                     for guess in (relative_pose(wheels[i], wheels[j]), (0.0, 0.0, 0.0))]
            motions[i, j], shares[i, j] = max(tries, key=lambda result: result[1])
loops = [pair for pair in motions if shares[pair] >= 0.7]
print("tried:", len(motions), "pairs   loops:", loops)

# %% [markdown]
# The edges of the wheels have a standard deviation of 2 cm and 0.05 radians, those of the scans 1 cm and 0.01 radians. `optimize_pose_graph` repeats the step of section 7 until nothing changes any more. On real robots, the libraries GTSAM, g2o and Ceres do the same, for hundreds of thousands of poses.

# %%
edges = []
for k in range(32):
    edges.append((k, k + 1, relative_pose(wheels[k], wheels[k + 1]), (1 / 0.02**2, 1 / 0.05**2)))
for i, j in loops:
    edges.append((i, j, motions[i, j], (1 / 0.01**2, 1 / 0.01**2)))

for steps in range(4):
    poses = optimize_pose_graph(wheels, edges, iterations=steps) if steps else wheels
    print("steps:", steps, "  ATE:", round(100 * ate(poses[:, :2], truth[:, :2])), "cm")

# %% [markdown]
# The [[term:absolute trajectory error]] of the whole path falls, although only the two ends of the path were compared: the edges in between pass the correction on. **Predict** the precision of the new map. With the poses of the wheels it was 0.41.

# %% role="predict"
guess_precision = None  # your guess: between 0 and 1

# %% tags=["nbval-ignore-output"]
poses = optimize_pose_graph(wheels, edges)
new_map = make_map(poses, scans)
new_precision, new_recall = grid_precision_recall(new_map, real)
compare_guess(guess_precision, round(new_precision, 2))

# %%
# Check: precision and recall of the new map
assert 0.97 < new_precision < 0.995 and 0.95 < new_recall < 0.99

# %% tags=["nbval-ignore-output", "long"]
figure = Figure(figsize=(9, 3.7), layout="constrained")
left, right = figure.subplots(1, 2)
draw_map(left, wheels_map, wheels, "poses of the wheels")
draw_map(right, new_map, poses, "after the loop closure")
show_figure(figure, text="mapping_and_slam/closed")

# %%
# Check: the numbers in this section
new_error = ate(poses[:, :2], truth[:, :2])
assert len(loops) == len(motions) == 6 and new_error < 0.02
assert round(100 * ate(wheels[:, :2], truth[:, :2])) == 36 and min(shares[pair] for pair in loops) > 0.9

# %% [markdown]
# From 36 cm to less than 2 cm, and the map is nearly as good as with the true poses. Nothing was measured anew: the same scans and the same wheels, and six comparisons.
#
# What if one loop closure is **wrong**? Say that the scan matching had taken pose 16, on the other side of the circle, for the place of pose 0:

# %%
wrong = [*edges, (0, 16, (0.0, 0.0, 0.0), (1 / 0.01**2, 1 / 0.01**2))]
bent = optimize_pose_graph(wheels, wrong, iterations=50)
print("ATE with one wrong loop:", "more than 30 cm" if ate(bent[:, :2], truth[:, :2]) > 0.3 else "small")

# %%
# Check: one wrong loop closure spoils the path
assert ate(bent[:, :2], truth[:, :2]) > 0.3

# %% [markdown]
# ## 9 · Live: the map snaps ([[minutes]], deeper)
#
# Now everything together, step by step while the robot drives. A `Mapper` takes a new *[[term:keyframe]]* after 20 cm or 20 degrees. It compares each keyframe with the nearest one that is at least 12 keyframes older. If they match, it corrects all poses.

# %% tags=["long"]
class Mapper:
    """A pose graph that grows while the robot drives, and closes its loops."""

    def __init__(self):
        self.wheels, self.scans, self.edges, self.loops = [], [], [], []
        self.poses = np.zeros((0, 3))

    def add(self, wheels, points):
        """True if this scan is a new keyframe; wheels: the pose (x, y, yaw) that they count."""
        if not self.wheels:
            self.poses = np.array([wheels], float)
        else:
            motion = relative_pose(self.wheels[-1], wheels)
            if math.hypot(motion[0], motion[1]) < 0.2 and abs(motion[2]) < math.radians(20):
                return False
            last = len(self.poses) - 1
            self.edges.append((last, last + 1, motion, (1 / 0.02**2, 1 / 0.05**2)))
            self.poses = np.vstack([self.poses, compose_poses(self.poses[-1], motion)])
        self.wheels.append(wheels)
        self.scans.append(points)
        self.close_loop(len(self.poses) - 1)
        return True

    def close_loop(self, newest):
        older = self.poses[:max(0, newest - 11)]
        if len(older) == 0:
            return
        distances = np.hypot(*(older[:, :2] - self.poses[newest, :2]).T)
        near = int(distances.argmin())
        if distances[near] > 1.0:
            return
        guesses = relative_pose(self.poses[near], self.poses[newest]), (0.0, 0.0, 0.0)
        tries = [match(self.scans[near], self.scans[newest], guess) for guess in guesses]
        motion, share = max(tries, key=lambda result: result[1])
        if share >= 0.7:
            self.edges.append((near, newest, motion, (1 / 0.01**2, 1 / 0.01**2)))
            self.loops.append((near, newest))
            self.poses = optimize_pose_graph(self.poses, self.edges)

# %% [markdown]
# The node sees only what the robot publishes: the scan and the odometry. With each new keyframe it publishes the path as `nav_msgs/Path` and the map as `nav_msgs/OccupancyGrid`: each cell is −1 (unknown) or 0 to 100, the [[term:probability]] in percent. RViz and Foxglove draw both.
#
# - **The frame.** Path and map are in the frame `map` ([[where_am_i#8]]). Its origin is where the wheels began to count. When a loop is closed, the robot jumps in `map`, and never in `odom`.
# - **Latched.** A map comes seldom. A program that starts later must still get the last one. So the publisher keeps it: the durability is *transient local*, and the subscription must request the same. Maps are published like this in all of ROS 2.

# %% tags=["long"]
if ros_available():
    from geometry_msgs.msg import PoseStamped
    from nav_msgs.msg import OccupancyGrid, Odometry, Path
    from rclpy.node import Node
    from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
    from sensor_msgs.msg import LaserScan

    def seconds(msg):
        return msg.header.stamp.sec + msg.header.stamp.nanosec / 1e9

    class MappingNode(Node):
        LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

        def __init__(self, context=None):
            super().__init__("mapping", context=context)
            self.mapper, self.scan, self.looks = Mapper(), None, 0
            self.before = self.grid = self.before_path = None  # before: the last map without a loop
            self.create_subscription(Odometry, "/kachaka/odometry/odometry",
                                     self.on_odometry, qos_profile_sensor_data)
            self.create_subscription(LaserScan, "/kachaka/lidar/scan",
                                     self.on_scan, qos_profile_sensor_data)
            self.grids = self.create_publisher(OccupancyGrid, "/map", self.LATCHED)
            self.paths = self.create_publisher(Path, "/mapping/path", 10)

        def on_scan(self, msg):
            self.scan = msg  # an older one that still waits is left out

        def on_odometry(self, msg):
            if self.scan is None or seconds(msg) < seconds(self.scan):
                return  # the wheels have not yet counted as far as the scan
            scan, self.scan = self.scan, None
            place, turn = msg.pose.pose.position, msg.pose.pose.orientation
            wheels = (place.x, place.y, 2 * math.atan2(turn.z, turn.w))
            self.looks += 1
            if not self.mapper.add(wheels, self.points(scan)):
                return
            self.grid = make_map(self.mapper.poses, self.mapper.scans)
            if not self.mapper.loops:
                self.before, self.before_path = self.grid, self.mapper.poses
            self.publish(scan.header.stamp)

        def points(self, msg):
            """The scanner is turned to the left by 90 degrees, and 0.156 m before the axle."""
            ranges = np.array(msg.ranges)
            hit = np.isfinite(ranges)
            angles = msg.angle_min + msg.angle_increment * np.arange(len(ranges))[hit]
            ends = np.column_stack([np.cos(angles), np.sin(angles)]) * ranges[hit, np.newaxis]
            return to_room((0.156, 0.0, math.pi / 2), ends)

        def publish(self, stamp):
            msg = OccupancyGrid()
            msg.header.stamp, msg.header.frame_id = stamp, "map"
            msg.info.resolution = cell_size
            msg.info.height, msg.info.width = self.grid.shape
            msg.info.origin.position.x, msg.info.origin.position.y = corner.tolist()
            percent = np.round(100 * probability(self.grid)).astype(np.int8)
            msg.data = np.where(self.grid == 0, -1, percent).ravel().tolist()
            self.grids.publish(msg)
            path = Path(header=msg.header)
            for x, y, yaw in self.mapper.poses.tolist():
                pose = PoseStamped(header=msg.header)
                pose.pose.position.x, pose.pose.position.y = x, y
                pose.pose.orientation.z, pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
                path.poses.append(pose)
            self.paths.publish(path)

# %% [markdown]
# The robot drives a small circle, until the node has closed the loop. Then a subscription comes late, and waits for the map that was already sent.

# %% tags=["nbval-ignore-output", "long"]
if ros_available():
    live_camera = open_camera("room", rate=10)
    live_robot = Robot()
    live_robot.restart(start=(0.45, -0.4, 0.0), seed=5)
    session = RosSession.current()
    node = session.add_node(MappingNode(context=session.context))
    end = time.monotonic() + 30
    while not node.mapper.loops and time.monotonic() < end:
        live_robot.drive(0.3, 0.6)  # again and again: an old command stops the robot
        time.sleep(0.1)
    live_robot.stop()
    late = []
    node.create_subscription(OccupancyGrid, "/map", late.append, node.LATCHED)
    end = time.monotonic() + 5
    while not late and time.monotonic() < end:
        time.sleep(0.1)
    session.remove_node(node)
    live_camera.stop()
    print("maps that the late subscription got:", len(late))
    print("scans:", node.looks, "  keyframes:", len(node.mapper.poses), "  loops:", node.mapper.loops)
    if node.mapper.loops:
        figure = Figure(figsize=(9, 3.7), layout="constrained")
        left, right = figure.subplots(1, 2)
        draw_map(left, node.before, node.before_path, "before the loop was closed")
        draw_map(right, node.grid, node.mapper.poses, "after")
        show_figure(figure, text="mapping_and_slam/live")

# %%
# Check: the node has seen scans, and made keyframes of them
assert not ros_available() or (node.looks > 0 and len(node.mapper.poses) > 0)

# %% [markdown]
# **Try it**: let the robot drive for two rounds. With each keyframe of the second round, a loop is closed, and the wheels have no time to drift.
#
# **What you would start on a robot:**
#
# - `slam_toolbox` does the whole of this lesson: scan matching, pose graph, loop closure. It needs a `LaserScan`, which this course's robot publishes, and two transforms from tf2, odom → base_footprint and base_footprint → laser_frame, which it does not. It publishes `/map`, latched, and map → odom.
# - *Nav2* plans a way in this map and drives it. It needs the map, the same transforms, the odometry and the scan, and it publishes a `Twist`. The types of this course's topics fit; without tf2, Nav2 does not start to plan.

# %% [markdown]
# ## Recap
#
# A map needs exact poses, and the poses come from the map: SLAM finds both. Rays fill the cells, and log-odds add up what they say. Edges hold the poses together, and one place that is recognized corrects the whole path.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | scan | (N, 2) | float64 | up to 8 | metre: ahead, left |
# | cells of a ray | (n, 2) | int64 | inside the grid | cell: row, column |
# | map | (110, 150) | float64 | −6 to 6 | log-odds; 0 is unknown |
# | `OccupancyGrid.data` | 16 500 | int8 | −1, 0 to 100 | percent |
# | poses | (33, 3) | float64 | yaw: −π to π | metre, metre, radian |
# | error of an edge | (3,) | float64 | | metre, metre, radian |
#
# **Next:** [[reading_text]]. First choose **File → Close and Shut Down Notebook**: it frees the robot.

# %%
# Check: the numbers in the table
assert new_map.shape == (110, 150) and new_map.size == 16500 and np.abs(new_map).max() == 6
assert np.abs(scans[0]).max() < 8
assert grid_ray((0, 0), (2, 5)).dtype == np.int64 and poses.shape == (33, 3)
