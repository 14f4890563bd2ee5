# ---
# jupyter:
#   imgproc_course:
#     title: Where am I?
# ---

# %% [markdown]
# # Where am I?
#
# A robot that counts the turns of its wheels believes that it knows where it is, and it is wrong: its odometry drifts. In this lesson the robot *looks*. First it sees a marker, and computes its own place from four corners. Then it does without a marker: it follows hundreds of points of the room from image to image, and adds up its own steps. At the end, you see how ROS 2 names such places, and puts them together: `map`, `odom`, `base_footprint`.
#
# **You will be able to**
# - compute the homography of a flat thing from four corners,
# - take a matrix apart (SVD),
# - find the motion between two clouds of points (Kabsch), and say how RANSAC leaves out the wrong pairs,
# - chain motions to a path, and measure its error against the truth,
# - name the coordinate frames of a robot, and say which node publishes what (tf2),
# - deeper: say how a marker carries its number, and compare the camera with the wheels, also in a node.
#
# **Time** [[minutes]], with a pause after section 4. **You need** [[obstacles_ahead]], [[drive_the_robot]], and of [[object_tracking#4]] the product of matrices. Only the ends of sections 8 and 9 need ROS 2.

# %% role="given" exercise=["where-homography", "where-motion"]
import math

import numpy as np

# %% tags=["long"]
import time

import cv2
from matplotlib.figure import Figure

from imgproc_course.display import show, show_figure
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.geometry import (
    CameraModel,
    Pose,
    ate,
    homography,
    homography_pose,
    rigid_motion,
)
from imgproc_course.recording import open_recording
from imgproc_course.ros import Robot, RosSession, open_camera, ros_available
from imgproc_course.simulation import Simulation

recording = open_recording("drive")

# %% role="texts"
figure_texts = {
    "marker": (
        "The marker in the first and in the last frame of the drive. The dots are the corners that OpenCV finds; the large dot is the first one.",
        "Two cut-outs of the room: a black square with white cells, small and far away, and larger.",
    ),
    "cells": (
        "Left, the marker and the middles of its 6 × 6 cells. Right, what they say: 1 is white, 0 is black.",
        "Left, the marker with one small dot in each cell. Right, a grid of 6 × 6 squares with a black border, and a pattern inside.",
    ),
    "svd": (
        "What the matrix does with a circle: V rotates it, s makes it longer in one direction and shorter in the other, U rotates it again. The red and the blue point are always the same two points.",
        "Four panels: a circle; the circle with its two points rotated; an ellipse along the axes; the same ellipse, rotated.",
    ),
    "flips": (
        "The room from above: the places that the marker gives. With refined corners (blue), all of them are near the true path; without (red crosses), some are far away.",
        "A gray line from left to right, blue dots near it, and a few red crosses far away from it.",
    ),
    "pairs": (
        "Frames 40 and 50: each line begins where a point was, and ends where it is now. One point in three is drawn.",
        "The living room with many short lines; most of them point away from the middle of the image.",
    ),
    "inliers": (
        "White: pairs that agree with the motion of the robot. Red: pairs that do not.",
        "The living room with white lines on walls and furniture, and red lines, most of them on the rug and at the edges of furniture.",
    ),
    "paths": (
        "The drive from above. With a step for each frame the path leaves the truth; with a step for every tenth frame it stays.",
        "Three lines from left to right: the true path in gray, a red line that leaves it, and a blue line that lies on it.",
    ),
    "room": (
        "The robot's way in the room: the wheels (red) lose it, the camera (blue) does not.",
        "Three wavy lines from left to right: the gray and the blue one lie on each other, the red one goes away from them.",
    ),
    "live": (
        "What the node published: the path of the camera, beside the path of the wheels.",
        "Two lines on a map that begin at the same place.",
    ),
}

# %% [markdown]
# ## 1 · Two ways to know the place ([[minutes]])
#
# In [[drive_the_robot#5]] the robot drove a square, and its wheels were wrong by 15 cm at the end. The wheels count only steps, and each small error stays. There are two better ways:
#
# - **Look at something whose place you know.** A [[term:marker]] stands in front of the wall; we know its place in the room. From how it looks in the image, the robot computes where it is itself. This has no [[term:drift]], but it needs the marker.
# - **Look at how the room moves.** From one frame to the next, all points of the room move a little. From this, the robot computes how it moved itself. This is called *[[term:visual odometry]]*.
#
# OpenCV finds the marker, and gives its four corners, always in the same order: the upper left corner of its pattern is the first, then clockwise.

# %%
dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
settings = cv2.aruco.DetectorParameters()
settings.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
detector = cv2.aruco.ArucoDetector(dictionary, settings)


def find_corners(gray, detector=detector):
    """The corners of marker 7 as (column, row), (4, 2)."""
    corners, numbers, _ = detector.detectMarkers(gray)
    index = numbers.ravel().tolist().index(7)
    return corners[index].reshape(4, 2).astype(float)

# %%
frames = [recording.frame(k) for k in range(90)]
grays = [cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY) for frame in frames]
corners = [find_corners(gray) for gray in grays]
print(corners[0].round(1))

# %% tags=["long"]
def cut_out(k):
    """The marker in frame k, enlarged to 240 × 240 pixels, with its corners."""
    center = corners[k].mean(axis=0)
    half = np.ptp(corners[k], axis=0).max()
    col, row = np.rint(center - half).astype(int)
    size = int(2 * half)
    image = cv2.resize(frames[k][row:row + size, col:col + size], (240, 240))
    for number, corner in enumerate(corners[k]):
        place = np.rint((corner - (col, row) + 0.5) * 240 / size - 0.5).astype(int)
        cv2.circle(image, place.tolist(), 9 if number == 0 else 5, (0, 160, 255), -1)
    return image


show([cut_out(0), cut_out(89)], ["frame 0", "frame 89"], text="where_am_i/marker")

# %%
# Check: the marker is found in every frame
assert len(corners) == 90 and all(found.shape == (4, 2) for found in corners)

# %% [markdown]
# ## 2 · From a flat thing to its image ([[minutes]])
#
# The marker is flat. Give each of its points two coordinates, x and y. Where is the point in the image? There is one 3 × 3 matrix for all of its points, the *[[term:homography]]*. Multiply it with (x, y, 1): this gives three numbers a, b and c. Then **divide**: the column is u = a / c, the row is v = b / c.

# %%
H = np.array([[100.0, 0, 300], [0, -100, 200], [0.2, 0, 1]])


def to_image(H, x, y):
    a, b, c = H @ [x, y, 1]
    return float(round(a / c, 1)), float(round(b / c, 1))


print("(0, 0) ->", to_image(H, 0, 0))
print("(1, 0) ->", to_image(H, 1, 0))

# %% [markdown]
# From x = 0 to x = 1, the column goes from 300 to 333.3. **Predict** the column of the point (2, 0).

# %% role="predict"
guess_column = None  # your guess: which column?

# %%
column, _ = to_image(H, 2, 0)
compare_guess(guess_column, column)

# %% [markdown]
# The second step is shorter, 23.8 instead of 33.3 pixels: this side of the thing is farther away. The division by c makes far things small.
#
# Now backwards: we know four corners and their pixels, and look for the nine numbers h₁ … h₉ of the matrix, row by row. For one corner (x, y) and its pixel (u, v):
#
# $$u = \frac{h_1 x + h_2 y + h_3}{h_7 x + h_8 y + h_9}$$
#
# Multiply by the denominator, and move everything to one side. Then all nine numbers are in one row of products, and the sum is 0:
#
# $$h_1 x + h_2 y + h_3 - u x h_7 - u y h_8 - u h_9 = 0$$
#
# The row v gives a second equation, with h₄, h₅ and h₆. So each corner gives two rows of nine numbers:

# %%
x, y, u, v = 1, 0, 400 / 1.2, 200 / 1.2  # the point (1, 0) of the example
row_u = np.array([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
row_v = np.array([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
print("row of u times the matrix:", abs(round(float(row_u @ H.ravel()), 6)))
print("row of v times the matrix:", abs(round(float(row_v @ H.ravel()), 6)))

# %% [markdown]
# Four corners give eight rows. We look for the vector that gives 0 with each of them. For this we take the matrix apart.
#
# ### Rotate, stretch, rotate ([[minutes]])
#
# What does a matrix do to the plane? Every matrix does the same three things: it **rotates**, it **stretches or shrinks** along the two axes, and it **rotates** again. (A rotation may also be a mirror.) The *[[term:singular value decomposition]]*, SVD, finds the three parts: `U, s, V = np.linalg.svd(M)`, and M is `U @ np.diag(s) @ V`. Read it from the right: first V, then s, then U. (Many books call the third part Vᵀ.)
#
# Row k of V and column k of U can both change their signs, and M stays the same. Each computer may choose other signs. So we choose: V has positive numbers on its diagonal.

# %%
M = np.array([[1.0, 1.0], [0.0, 1.0]])
U, s, V = np.linalg.svd(M)
signs = np.sign(np.diag(V))
U, V = U * signs, V * signs[:, np.newaxis]  # columns of U, rows of V
print("s", s.round(3))

# %% tags=["long"]
angles = np.linspace(0, 2 * math.pi, 200)
circle = np.array([np.cos(angles), np.sin(angles)])
figure = Figure(figsize=(9, 2.6), layout="constrained")
stages = {"a circle": np.eye(2), "V rotates": V, "s stretches": np.diag(s) @ V, "U rotates: M": M}
for axes, (title, stage) in zip(figure.subplots(1, 4, sharey=True), stages.items(), strict=True):
    axes.plot(*(stage @ circle).round(3), color="0.5")
    for (a, b), colour in zip(stage.T.round(3), "rb", strict=True):  # where (1, 0) and (0, 1) go
        axes.plot([0, a], [0, b], f"{colour}o-", markevery=[1])
    axes.set(title=title, xlim=(-1.8, 1.8), ylim=(-1.8, 1.8), aspect="equal")
show_figure(figure, text="where_am_i/svd")

# %%
# Check: the numbers of the SVD
assert np.allclose(U @ np.diag(s) @ V, M) and np.allclose(U @ U.T, np.eye(2)) and np.allclose(V @ V.T, np.eye(2))
assert s[0] > s[1] and all(np.allclose(M @ V[k], s[k] * U[:, k]) for k in range(2))

# %% [markdown]
# The numbers in s are sorted, the largest first. Row k of V is the direction that is stretched by `s[k]`. So the **last row** of V is the direction that is stretched least: to 0, if a vector gives 0 with all rows. First a small example with two rows, and a vector of three numbers:

# %%
rows = np.array([[1.0, 2, -3], [2, -1, -1]])
_, _, vectors = np.linalg.svd(rows)
vector = vectors[-1]
vector = vector / vector[-1]
print(vector.round(3))
print("rows times vector:", abs((rows @ vector).round(6)))

# %% [markdown]
# Why the division? If a vector gives 0, so does each multiple of it. NumPy returns the one with the length 1, and its sign depends on the computer. So we make the last number 1. (This way to a homography is called the *[[term:direct linear transform]]*, DLT.)

# %%
# Check: the numbers of the homography
assert to_image(H, 1, 0) == (333.3, 166.7) and column == 357.1 and round(357.1 - 333.3, 1) == 23.8
assert abs(row_u @ H.ravel()) < 1e-9 and abs(row_v @ H.ravel()) < 1e-9 and np.allclose(vector, 1)

# %% [markdown]
# ### Your turn: the homography of four corners
#
# Write `find_homography(points, pixels)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `points`: (4, 2) float, each row (x, y); `pixels`: (4, 2) float, each row (u, v), of the same corners | (3, 3) float: the homography from the points to the pixels, divided by its last number, so that `H[2, 2]` is 1 | `find_homography(points, pixels)` with the pixels of `H` above returns `H` |

# %% role="exercise"
exercise(
    "where-homography",
    title="The homography of four corners",
    function="find_homography",
    tolerance=1e-5,
    hint="Two rows for each corner, the second one with 0, 0, 0 in front; then the last row (not a column) of the third result of np.linalg.svd, in the shape (3, 3), divided by its last number, H[2, 2].",
    hints=(
        "Which two rows of nine numbers does one corner give, and which vector gives 0 with all eight rows?",
        "1. Begin with an empty list of rows.\n"
        "2. For each corner, append the row of u and the row of v, as above.\n"
        "3. Take the third result of np.linalg.svd of all rows, and of it the last row.\n"
        "4. Give it the shape (3, 3), and divide it by its last number.",
        "rows = []\nfor (x, y), (u, v) in zip(points, pixels):\n    rows.append([x, y, 1, 0, 0, 0, -u * x, ...])\n"
        "    rows.append([0, 0, 0, x, y, 1, ...])\n_, _, vectors = np.linalg.svd(np.array(rows))\n"
        "H = vectors[-1].reshape(3, 3)\nreturn H / H[...]",
    ),
    explanation="Eight rows leave one direction of nine numbers: the last row of the third result. reshape(3, 3) fills the matrix"
    " row by row, in the order h1 to h9. The division takes away both the length and the sign, which do not matter.",
    another_way="You can also set h9 = 1, move the last column to the other side, and call np.linalg.solve with the 8 × 8 matrix.",
)


def corners_of(rng, side=1.0, size=80.0):
    """The corners of a square, and four pixels around a middle: a four-sided figure."""
    points = np.array([[0, 0], [side, 0], [side, side], [0, side]]) - side * rng.uniform(0, 0.6, 2).round(2)
    middle = rng.uniform(150, 400, 2).round()
    around = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * size
    return points.round(3), (middle + around + rng.uniform(-0.4, 0.4, (4, 2)) * size).round(1)

# %% role="answer"
def find_homography(points, pixels):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels, strict=True):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    _, _, vectors = np.linalg.svd(np.array(rows))
    H = vectors[-1].reshape(3, 3)
    return H / H[2, 2]


# %% role="check"
check("where-homography", find_homography)

# %% role="case" title="a unit square" points=1
def inputs(rng):
    square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    return [(square, np.array([[10.0, 20], [90, 24], [96, 88], [6, 100]])), (square, corners_of(rng)[1])]


# %% role="case" title="other squares" points=1 hint="Where x and y are not 0 or 1, is each product right? -u * x, -u * y, -u in the row of u, -v * x, -v * y, -v in the row of v."
def inputs(rng):
    return [corners_of(rng, 3.0), corners_of(rng, 6.0, 60.0)]


# %% role="hidden" title="any four corners" points=1 hint="Does each corner have two rows, and did you divide by the last number?"
def inputs(rng):
    return [corners_of(rng, side, size) for side, size in ((2.0, 90.0), (4.0, 50.0), (1.5, 70.0))]


# %% [markdown]
# OpenCV does the same: `cv2.getPerspectiveTransform` for four corners, `cv2.findHomography` for more. From here on, the lesson uses `homography` of the course's package, so that it does not need your function.

# %% [markdown]
# ## 3 · Read the marker ([[minutes]], deeper)
#
# Which marker is it? Its pattern has 6 × 6 cells. We give the corners of the marker the coordinates (0, 0), (6, 0), (6, 6) and (0, 6): then the middle of the first cell is at (0.5, 0.5). The homography says which pixel that is.

# %%
marker_cells = np.array([(0, 0), (6, 0), (6, 6), (0, 6)])


def cell_pixels(corners):
    """The pixel (column, row) at the middle of each cell, (6, 6, 2)."""
    H = homography(marker_cells, corners)
    pixels = np.zeros((6, 6, 2), int)
    for row in range(6):
        for col in range(6):
            a, b, c = H @ [col + 0.5, row + 0.5, 1]
            pixels[row, col] = round(a / c), round(b / c)
    return pixels

# %%
def read_cells(gray, corners):
    pixels = cell_pixels(corners)
    levels = gray[pixels[:, :, 1], pixels[:, :, 0]].astype(int)
    middle = (levels.min() + levels.max()) / 2
    return (levels > middle).astype(np.uint8)  # 1 is white


cells = read_cells(grays[89], corners[89])
print(cells)

# %%
dotted = frames[89].copy()
for col, row in cell_pixels(corners[89]).reshape(36, 2).tolist():
    cv2.circle(dotted, (col, row), 2, (0, 160, 255), -1)
(left, top), (right, bottom) = corners[89].min(axis=0), corners[89].max(axis=0)
part = dotted[int(top) - 9:int(bottom) + 9, int(left) - 9:int(right) + 9]
show([part, np.kron(cells, np.full((17, 17), 255, np.uint8))],
     ["the middles of the cells", "1 is white"], text="where_am_i/cells")

# %% [markdown]
# The outermost cells are all black: this is the *border*, by which the marker is found. The 4 × 4 cells inside are the *word* of the marker. The [[term:marker dictionary|dictionary]] DICT_4X4_50 has 50 words, one for each number:

# %%
words = np.array([cv2.aruco.generateImageMarker(dictionary, number, 6)[1:5, 1:5]
                  for number in range(50)]) // 255
print(words.shape)
print(words[7])

# %%
# Check: the cells by hand are the word of the dictionary, in all 90 frames
assert cells.shape == (6, 6) and words.shape == (50, 4, 4)
agreeing = np.array([(np.rot90(words[7], turns) == words).sum(axis=(1, 2)) for turns in range(4)])
agreeing[0, 7] = 0  # the word itself
assert agreeing.max() == 12
assert all((read_cells(grays[k], corners[k]) == np.pad(words[7], 1)).all() for k in range(90))

# %% [markdown]
# This is the word that we have read. A marker can also hang turned, so the detector compares the cells in four turns. The words of a dictionary are chosen so that none of them, in any turn, is like another one: here at least 4 of the 16 cells are different. So one wrong cell does not make another number of it.

# %% [markdown]
# ## 4 · Where is the camera? ([[minutes]])
#
# The four corners say where the robot is. If the marker has its real size of 0.25 m, its homography contains where the marker is, as seen from the camera: its [[term:pose]]. `homography_pose` of the course's package takes it out; OpenCV's `cv2.solvePnP` computes it from the corners directly. (PnP means *[[term:perspective-n-point]]*: the pose from n points.)
#
# The homography knows nothing of the lens's [[term:distortion]], so it gets rays with depth 1 in place of pixels. The marker's x is to its right, its y is up, and its z comes out of its front.

# %%
info = recording.camera_info
camera = CameraModel(info.width, info.height, info.k[0], info.k[4],
                     info.k[2], info.k[5], tuple(info.d))
side = 0.25 / 2
square = np.array([(-side, side), (side, side), (side, -side), (-side, -side)])
rays = camera.unproject(corners[60])[:, :2]
seen = homography_pose(homography(square, rays), np.eye(3))
print("right, down, ahead:", seen.position.round(2))

# %% [markdown]
# So the marker is more than two metres ahead. We want the opposite: where is the *camera* in the room? We know where the marker is in the room. Its pose, and then the inverse of what the camera sees: this is the pose of the camera.

# %% tags=["long"]
right, back, up = Pose.from_vector(recording.pose("marker", 0)).rotation.T  # its z is -back
marker = Pose(np.column_stack([right, up, -back]), recording.pose("marker", 0)[:3])
true_poses = [Pose.from_vector(recording.pose("camera", k)) for k in range(90)]
true_places = np.array([pose.position for pose in true_poses])
square_3d = np.column_stack([square, np.zeros(4)])


def place_by_hand(corners):
    rays = camera.unproject(corners)[:, :2]
    seen = homography_pose(homography(square, rays), np.eye(3))
    return (marker @ seen.inverse()).position


def place_by_opencv(corners):
    _, turn, shift = cv2.solvePnP(square_3d, corners, camera.matrix, np.array(camera.distortion),
                                  flags=cv2.SOLVEPNP_IPPE_SQUARE)
    seen = Pose(cv2.Rodrigues(turn)[0], shift.ravel())
    return (marker @ seen.inverse()).position

# %%
print("by hand", place_by_hand(corners[60]).round(2))
print("OpenCV ", place_by_opencv(corners[60]).round(2))
print("truth  ", true_places[60].round(2))

# %% [markdown]
# Now all 90 frames. To measure a whole path, we take the distance between the computed and the true place in each frame, square it, take the mean, and then the root: the *[[term:absolute trajectory error]]* (ATE). (In tables of papers, the computed path is first shifted and turned until it fits best. Ours is not.)
#
# And once more, with another setting: without the *refinement* of the corners, which shifts each corner by parts of a pixel until it is at the edge between black and white. Without it, the corners are whole pixels, and up to 1.5 pixels away from the refined ones. **Predict** the largest error of the place in the 90 frames with these rough corners, in centimetres.

# %% role="predict"
guess_flip = None  # your guess: how many centimetres?

# %%
settings = cv2.aruco.DetectorParameters()
settings.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_NONE
rough = cv2.aruco.ArucoDetector(dictionary, settings)
refined_places = np.array([place_by_opencv(found) for found in corners])
rough_places = np.array([place_by_opencv(find_corners(gray, rough)) for gray in grays])
refined_errors = np.linalg.norm(refined_places - true_places, axis=1)
rough_errors = np.linalg.norm(rough_places - true_places, axis=1)
compare_guess(guess_flip, round(100 * rough_errors.max()), "cm")

# %%
print("refined: ATE", round(100 * ate(refined_places, true_places)), "cm, at most",
      round(100 * refined_errors.max()), "cm")
print("rough:   ATE", round(100 * ate(rough_places, true_places)), "cm")
print("rough, more than 1 m away:", (rough_errors > 1).sum(), "of 90 frames")

# %%
figure = Figure(figsize=(8, 4), layout="constrained")
axes = figure.subplots()
axes.plot(true_places[:, 0], true_places[:, 1], color="0.7", linewidth=6, label="truth")
axes.plot(*refined_places[:, :2].round(2).T, "b.", label="refined corners")
axes.plot(*rough_places[:, :2].round(2).T, "rx", label="rough corners")
axes.plot(*marker.position[:2], "ks", label="marker")
axes.set(xlabel="x (m), ahead", ylabel="y (m), left", aspect="equal")
axes.legend()
show_figure(figure, text="where_am_i/flips")

# %%
# Check: the numbers in this section
rough_corners = np.array([find_corners(gray, rough) for gray in grays])
true_corners = np.array([camera.project((pose.inverse() @ marker).apply(square_3d)) for pose in true_poses])
assert 1.45 < np.linalg.norm(rough_corners - corners, axis=2).max() < 1.5
assert np.linalg.norm(rough_corners - true_corners, axis=2)[rough_errors > 1].max() < 1.9
sizes = [np.abs(np.array(found) - np.mean(found, axis=1, keepdims=True)) for found in (true_corners, corners)]
assert 0.65 < (sizes[0] - sizes[1]).mean() < 0.8
assert round(100 * refined_errors.max()) == 28 and round(100 * ate(refined_places, true_places)) == 14
assert round(100 * rough_errors.max()) == 261 and (rough_errors > 1).sum() == 6
assert (rough_errors > 1.5).sum() == 6 == (rough_errors > 0.6).sum() and round(100 * 4 * math.sin(math.radians(1))) == 7
assert max(math.dist(place_by_hand(corners[k]), refined_places[k]) for k in range(90)) < 0.01

# %% [markdown]
# In 6 of the 90 frames, an error of less than two pixels moves the robot by more than 1.5 m! A small square far away looks almost the same if it is turned to the left or to the right by the same angle. There are always **two poses** with almost the same corners, and a small error makes the wrong one fit better: the *[[term:two-fold ambiguity]]*. And even a turn of one degree, at a distance of 4 m, moves the robot by 7 cm.
#
# **Repair it**: refine the corners. They are better, but not exact either: they lie about 0.7 pixels inside the edges of the marker, to the side and in height. On a robot, one also compares with the place of the frame before, and uses larger markers, or several.
#
# **Pause?** Afterwards choose **Run → Run All Above Selected Cell**.
#
# ## 5 · The motion between two clouds of points ([[minutes]])
#
# Most places have no marker. But every room has corners, edges and patterns. Take frame 40 and frame 50, one second later. OpenCV finds points that are easy to find again (`goodFeaturesToTrack`), and follows each of them into the other frame (`calcOpticalFlowPyrLK`, the *[[term:optical flow]]* of Lucas and Kanade). As a test, it follows them back: a point that does not come back to its start is left out.

# %% tags=["long"]
grays = [cv2.cvtColor(frame[::2, ::2], cv2.COLOR_BGR2GRAY) for frame in frames]  # as large as the depth images
depths = [recording.depth(k) for k in range(90)]
half_camera = camera.every(2)


def follow(before, after):
    """Pixels of points in both images: two arrays (N, 2), as (column, row)."""
    start = cv2.goodFeaturesToTrack(before, 400, 0.001, 7)
    if start is None:  # a bare wall has no corners
        return np.zeros((0, 2)), np.zeros((0, 2))
    end, _, _ = cv2.calcOpticalFlowPyrLK(before, after, start, None)
    back, _, _ = cv2.calcOpticalFlowPyrLK(after, before, end, None)
    near = np.linalg.norm(back - start, axis=2).ravel() < 0.5  # pixels
    inside = (end.reshape(-1, 2) >= 0).all(1) & (end.reshape(-1, 2) < (639, 359)).all(1)
    near = near & inside
    return start[near].reshape(-1, 2).astype(float), end[near].reshape(-1, 2).astype(float)


start, end = follow(grays[40], grays[50])
print(start.shape, end.shape)

# %%
lines = frames[50][::2, ::2].copy()
for a, b in zip(np.rint(start[::3]).astype(int), np.rint(end[::3]).astype(int), strict=True):
    cv2.line(lines, a.tolist(), b.tolist(), (0, 220, 255), 1)
    cv2.circle(lines, b.tolist(), 2, (0, 220, 255), -1)
show(lines, "frame 50", text="where_am_i/pairs")

# %% [markdown]
# With the depth image, each pixel becomes a point in front of the camera, as in [[obstacles_ahead#2]]: its ray, times its depth. So we get two clouds of points, and each point of the first cloud has its partner in the second one.

# %% tags=["long"]
def to_points(pixels, depth, camera):
    """Points in front of the camera, (N, 3), in metres."""
    cols, rows = np.rint(pixels).astype(int).T
    return camera.unproject(pixels) * depth[rows, cols, np.newaxis] / 1000


def two_clouds(gray_before, depth_before, gray_after, depth_after, camera):
    start, end = follow(gray_before, gray_after)
    before, after = to_points(start, depth_before, camera), to_points(end, depth_after, camera)
    good = (before[:, 2] > 0.2) & (after[:, 2] > 0.2) & (before[:, 2] < 6) & (after[:, 2] < 6)
    return before[good], after[good]


before, after = two_clouds(grays[40], depths[40], grays[50], depths[50], half_camera)
print(before.shape, "  ahead: from", round(before[:, 2].min(), 1), "to", round(before[:, 2].max(), 1), "m")
print("nearer now, in the median:", round(np.median(before[:, 2] - after[:, 2]), 2), "m")

# %% [markdown]
# If the room stands still, all points seem to move together: each is turned by the same *rotation* R, and then shifted by the same vector t.
#
# $$\text{after} = R \cdot \text{before} + t$$
#
# How do we find R and t? First with three points in the plane. Here the points were turned by a quarter to the left, and shifted by (5, 1). The shift disappears if we subtract the mean of each cloud. Then only the rotation is left:

# %%
few = np.array([[0.0, 0], [3, 0], [0, 6]])
few_after = np.array([[5.0, 1], [5, 4], [-1, 1]])
few_centered = few - few.mean(axis=0)
after_centered = few_after - few_after.mean(axis=0)
print(few_centered.tolist())
print(after_centered.tolist())

# %% [markdown]
# The *[[term:Kabsch algorithm]]* has two steps. First multiply the clouds with each other: `after_centered.T @ few_centered`, a small matrix. It holds the sums of all products, as a covariance matrix does, but of one cloud with the other one. Then take it apart with the SVD: rotate, stretch, rotate. Leave the stretching out: `U @ V` is a rotation. No other one gives a smaller sum of squared distances between the two clouds: this is *[[term:least squares]]*.

# %%
U, sizes, V = np.linalg.svd(after_centered.T @ few_centered)
R = U @ V
print(R.round(3) + 0.0)
t = few_after.mean(axis=0) - R @ few.mean(axis=0)
print("t", t.round(3) + 0.0)

# %% [markdown]
# This is a quarter turn: (3, 0) goes to (0, 3). The shift t takes the turned mean of the first cloud to the mean of the second.
#
# There is one trap. A *mirror* also keeps all distances, but no robot can move like a mirror. If points lie almost in a plane, as on a wall, then a little noise is enough, and U @ V is a mirror. The *[[term:determinant]]* tells: it is 1 for a rotation. **Predict** the determinant of this matrix, which mirrors left and right.

# %% role="predict"
guess_mirror = None  # your guess: which number?

# %%
mirror = np.array([[-1.0, 0], [0, 1]])
compare_guess(guess_mirror, round(np.linalg.det(mirror)))

# %% [markdown]
# **The repair**: multiply the *last* column of U by the determinant of U @ V, which is 1 or −1. The last column belongs to the direction in which the points differ least, so this costs least. With `np.diag` in two dimensions:

# %%
mirrored = after_centered * (1, -1)
U, sizes, V = np.linalg.svd(mirrored.T @ few_centered)
flip = np.diag([1, np.linalg.det(U @ V)])
print("without:", round(np.linalg.det(U @ V)), "  with:", round(np.linalg.det(U @ flip @ V)))

# %%
# Check: the numbers in this section
assert np.allclose(R, [[0, -1], [1, 0]]) and np.allclose(t, [5, 1])
assert np.allclose(few @ R.T + t, few_after)
noisy = after_centered + 0.3 * few_centered
U_near, _, V_near = np.linalg.svd(noisy.T @ few_centered)
turns = [np.array([[math.cos(a), -math.sin(a)], [math.sin(a), math.cos(a)]]) for a in angles]
sums = [((few_centered @ turn.T - noisy)**2).sum() for turn in [U_near @ V_near, *turns]]
assert sums[0] == min(sums)
assert round(np.linalg.det(U @ V)) == -1 and round(np.linalg.det(U @ flip @ V)) == 1
assert np.allclose((few - few.mean(axis=0)) @ R.T, after_centered)
assert before.shape == after.shape == (142, 3) and 0.3 < np.median(before[:, 2] - after[:, 2]) < 0.35

# %% [markdown]
# ### Your turn: the motion of a cloud
#
# Write `find_motion(before, after)`, for points in the room: with three numbers, the repair is `np.diag([1, 1, ...])`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `before`, `after`: (N, 3) float; each row of `after` is the partner of the same row of `before` | two arrays: the rotation R (3, 3) with determinant 1, and the shift t (3,), so that R @ before + t is as near to after as possible | `find_motion(before, after)` returns R and t |

# %% role="exercise"
exercise(
    "where-motion",
    title="The motion of a cloud of points",
    function="find_motion",
    tolerance=1e-6,
    hint="U, s, V = svd(after_centered.T @ before_centered); R = U @ diag([1, 1, det(U @ V)]) @ V; t = mean of after - R @ mean of before.",
    hints=(
        "What is left of the motion if both clouds have their mean at 0? And what if the result is a mirror?",
        "1. The means of both clouds, over axis 0; subtract them.\n"
        "2. The singular value decomposition of after_centered.T @ before_centered: U, s, V.\n"
        "3. R: U times the diagonal matrix with 1, 1 and the determinant of U @ V, times V.\n"
        "4. t: the mean of after minus R times the mean of before.",
        "before_mean, after_mean = before.mean(axis=0), ...\n"
        "U, _, V = np.linalg.svd((after - after_mean).T @ (before - ...))\n"
        "R = U @ np.diag([1, 1, np.linalg.det(...)]) @ V\nreturn R, after_mean - R @ ...",
    ),
    explanation="The means take the shift away, and the decomposition finds the orthogonal matrix that turns one cloud on the other"
    " with the smallest squared distances. The determinant makes a rotation of it, if it was a mirror. Then t follows from the means.",
    another_way="You can also decompose before_centered.T @ after_centered, and take V.T @ diag @ U.T; SciPy has Rotation.align_vectors.",
)


def turned_about(axis, angle):
    """The rotation about an axis, by the formula of Rodrigues."""
    x, y, z = axis / np.sqrt((axis * axis).sum())
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def moved_cloud(rng, count, angle, noise=0.0):
    before = rng.uniform((-2, -1, 1), (2, 0.5, 5), (count, 3)).round(3)
    after = before @ turned_about(rng.normal(0, 1, 3), angle).T + rng.uniform(-1, 1, 3)
    return before, (after + rng.normal(0, noise, (count, 3))).round(6)


def wall(rng, count):
    """Points on a wall: the noise in its depth has changed the sides of all of them."""
    before = rng.uniform((-2, -1, 0), (2, 1, 0), (count, 3)).round(3)
    bumps = np.where(rng.random(count) < 0.5, -1, 1) * rng.uniform(0.02, 0.05, count).round(4)
    bumps[0], bumps[1] = 0.05, -0.05
    turn, shift = turned_about(rng.normal(0, 1, 3), 0.4), rng.uniform(1, 2, 3)
    sides = np.column_stack([np.zeros(count), np.zeros(count), bumps])
    return before + sides + (0, 0, 3), ((before - sides + (0, 0, 3)) @ turn.T + shift).round(6)

# %% role="answer"
def find_motion(before, after):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def find_motion(before, after):
    before_mean, after_mean = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - after_mean).T @ (before - before_mean))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, after_mean - R @ before_mean


# %% role="check"
check("where-motion", find_motion)

# %% role="case" title="a cloud that moves" points=1
def inputs(rng):
    return [moved_cloud(rng, 8, 0.5), moved_cloud(rng, 20, 1.2, 0.05)]


# %% role="case" title="points on a wall" points=1 hint="With points on a wall, U @ V can be a mirror, with the determinant -1. Then the last column of U (or the last row of V) must change its signs before you multiply."
def inputs(rng):
    return [wall(rng, 12), wall(rng, 20)]


# %% role="hidden" title="any clouds" points=1 hint="Do you subtract both means, and is t the mean of after minus R @ the mean of before?"
def inputs(rng):
    return [moved_cloud(rng, 5, 2.5), moved_cloud(rng, 40, 0.1, 0.02), wall(rng, 15)]


# %% [markdown]
# ## 6 · Many pairs are wrong ([[minutes]])
#
# The room does not stand still: the person walks, the ball rolls, the car drives. And some points jump: from the edge of a thing to the wall behind it, or to the next stripe of the rug, which looks the same. So many pairs are wrong. The remedy is [[term:RANSAC]], as in [[obstacles_ahead#4]], with a motion in place of a plane: draw three pairs, compute their motion, count the [[term:inlier|inliers]], repeat.
#
# A pair is an inlier if the moved point is nearer to its partner than 2 % of its depth: far points are less exact.

# %% tags=["long"]
def ransac_motion(before, after, draws=100):
    """The motion that most pairs agree with, and a mask of these pairs."""
    rng = np.random.default_rng(0)
    best = np.zeros(len(before), bool)
    for _ in range(draws):
        three = rng.choice(len(before), 3, replace=False)
        try:
            motion = rigid_motion(before[three], after[three])
        except ValueError:  # the three points lie on a line
            continue
        distances = np.linalg.norm(motion.apply(before) - after, axis=1)
        near = distances < 0.02 * after[:, 2]
        if near.sum() > best.sum():
            best = near
    return rigid_motion(before[best], after[best]), best

# %% [markdown]
# **Predict** how many percent of the pairs of frames 40 and 50 are inliers of the best motion.

# %% role="predict"
guess_inliers = None  # your guess: how many percent?

# %%
motion, near = ransac_motion(before, after)
compare_guess(guess_inliers, round(100 * near.mean()), "%")

# %% tags=["long"]
everything = rigid_motion(before, after)
true_motion = true_poses[50].inverse() @ true_poses[40]
for name, found in (("all pairs", everything), ("RANSAC", motion)):
    error = 100 * np.linalg.norm(found.position - true_motion.position)
    print(name, "error of the shift:", round(error, 1), "cm")

# %% tags=["long"]
start, end = (np.rint(half_camera.project(points)).astype(int) for points in (before, after))
lines = frames[50][::2, ::2].copy()
for a, b, agrees in zip(start, end, near, strict=True):
    colour = (255, 255, 255) if agrees else (0, 0, 255)
    cv2.line(lines, a.tolist(), b.tolist(), colour, 1)
    cv2.circle(lines, b.tolist(), 2, colour, -1)
show(lines, "frame 50", text="where_am_i/inliers")

# %%
# Check: the numbers in this section
assert round(100 * near.mean()) == 75
assert 0.1 < math.dist(everything.position, true_motion.position) < 0.106
assert math.dist(motion.position, true_motion.position) < 0.0045

# %% [markdown]
# With all pairs, the shift is wrong by 10 cm; with the inliers of the best motion, by less than half a centimetre.
#
# ## 7 · The whole drive, and more drift ([[minutes]])
#
# Now chain the motions: the pose of the camera at frame 1 is its pose at frame 0, and then the motion from 0 to 1; then the motion from 1 to 2, and so on. The points move the other way round than the camera, so we take the inverse.
#
# We can do this with every frame, in 89 small steps, or with every tenth frame, in 8 large ones (the last one at frame 80). In small steps, more than twice as many points are found again. First every tenth frame:

# %%
def path_of(step):
    """The places of the camera in the frames 0, step, 2 · step, …, (N, 3)."""
    pose = true_poses[0]
    places = [pose.position]
    for k in range(step, 90, step):
        clouds = two_clouds(grays[k - step], depths[k - step],
                            grays[k], depths[k], half_camera)
        motion, _ = ransac_motion(*clouds)
        pose = pose @ motion.inverse()
        places.append(pose.position)
    return np.array(places)

# %%
tenth = path_of(10)
print("every tenth frame: ATE", round(100 * ate(tenth, true_places[::10]), 1), "cm")
error_tenth = 100 * np.linalg.norm(tenth[-1] - true_places[80])
print("at frame 80:", round(error_tenth, 1), "cm")

# %% [markdown]
# The robot has driven 2.2 m until there. **Predict** the error at frame 80 with *every* frame, in centimetres.

# %% role="predict"
guess_every = None  # your guess: how many centimetres?

# %%
every = path_of(1)
error_every = 100 * np.linalg.norm(every[80] - true_places[80])
print("every frame: ATE", round(100 * ate(every, true_places), 1), "cm")
compare_guess(guess_every, round(error_every, 1), "cm")

# %% tags=["long"]
figure = Figure(figsize=(8, 2.4), layout="constrained")
axes = figure.subplots()
axes.plot(true_places[:, 0], true_places[:, 1], color="0.7", linewidth=6, label="truth")
axes.plot(*every[:, :2].round(3).T, "r", label="every frame")
axes.plot(*tenth[:, :2].round(3).T, "b.--", label="every tenth frame")
axes.set(xlabel="x (m), ahead", ylabel="y (m), left", aspect="equal")
figure.legend(loc="outside upper center", ncols=3)
show_figure(figure, text="where_am_i/paths")

# %%
# Check: the numbers in this section
assert ate(tenth, true_places[::10]) < 0.01 and error_tenth < 1.4 and len(tenth) == 9
assert 0.04 < ate(every, true_places) < 0.06 and 8 < error_every < 9.5
assert len(follow(grays[40], grays[41])[0]) > 2 * len(follow(grays[40], grays[50])[0])
assert 2.2 < np.linalg.norm(np.diff(true_places[:81], axis=0), axis=1).sum() < 2.3

# %% [markdown]
# More images, more drift! Each step has a small error of its own, however short it is: the depth of a pixel, and the place of a point, are never exact. 89 steps add up 89 such errors, and 8 steps only 8. But steps cannot be as large as you like: then too few points are found again.
#
# So visual odometry uses **[[term:keyframe|keyframes]]**. Each frame is compared with the last keyframe, not with the frame before. Only when the robot has moved or turned far enough, the frame becomes the next keyframe. Section 9 does so in the room.

# %% [markdown]
# ## 8 · Frames with names: tf2 ([[minutes]])
#
# A pose always says where one thing is *as another one sees it*. ROS calls these things coordinate frames, and names them. The document REP 105 has the names for a robot that drives, and their order, a tree:
#
# ```mermaid
# %%{init: {"theme": "base", "themeVariables": {"primaryColor": "#e3eefc", "primaryTextColor": "#111", "lineColor": "#777", "tertiaryColor": "#ededed", "edgeLabelBackground": "#ededed"}}}%%
# flowchart LR
#     accTitle: The coordinate frames of a robot
#     accDescr: From map to odom leads what a localization publishes, from odom to base_footprint what the odometry publishes, and from base_footprint to camera_front and to laser_frame how the sensors are mounted.
#     map -->|localization| odom -->|odometry| base[base_footprint] -->|mounted| camera[camera_front]
#     base -->|mounted| laser[laser_frame]
# ```
#
# | from → to | says where … is | published on a real robot by |
# |---|---|---|
# | `map` → `odom` | the place at which the wheels began to count | localization: a marker, or a map |
# | `odom` → `base_footprint` | the robot, as the wheels count | the driver of the robot; or `ekf_node` of the package `robot_localization`, a Kalman filter of wheels, camera and gyroscope |
# | `base_footprint` → `camera_front`, `laser_frame` | a sensor on the robot | `robot_state_publisher`, from a model of the robot |
#
# Each arrow is a *[[term:transform]]*: a pose with two names and a stamp. The library **tf2** collects all of them, and multiplies along the tree.
#
# The robot drives five curves (left, right, left, right, left) in the simulated room. Its camera stands 0.21 m before the axle, and 0.20 m above the floor, as in [[object_tracking#6]]:

# %%
ahead = np.array([[0.0, 0, 1], [-1, 0, 0], [0, -1, 0]])
mount = Pose(ahead, np.array([0.21, 0.0, 0.20]))  # the camera, as the robot sees it

robot = Simulation(seed=2, start=(0.0, 0.0, 0.0))
for angular in (0.5, -0.5, -0.5, 0.5, 0.5, -0.5, -0.5, 0.5):
    robot.step(0.25, angular, dt=1.0)

# %% [markdown]
# "Where is the camera in the map?" is then one product of poses:

# %%
counted = robot.odometry()
odom_to_base = Pose.planar(counted.x, counted.y, counted.yaw)
x, y, _, _, _, qz, qw = robot.pose("robot")
map_to_base = Pose.planar(x, y, 2 * math.atan2(qz, qw))  # as an exact localization knows it
map_to_odom = map_to_base @ odom_to_base.inverse()
camera_in_map = map_to_odom @ odom_to_base @ mount
print("map -> odom:    ", map_to_odom.position.round(1) + 0.0)
print("camera in map:  ", camera_in_map.position.round(2))
print("its true place: ", robot.pose("camera")[:3].round(2))

# %% [markdown]
# Why two frames, `map` and `odom`? When the robot sees a marker, its place in the map is corrected: it **jumps**. A controller that drives 0.5 m straight ahead must not see this jump. So the wheels keep their own frame: the robot's pose in `odom` drifts, but it **never jumps**. The correction goes into `map` → `odom` alone. At the start of the drive both frames were the same; now this arrow holds the drift of the wheels.
#
# And the axes? In all frames of a robot, x points ahead, y to the left, z up (REP 103). A camera's image has other axes: x to the right, y down, z ahead, along the *optical axis*. `mount` turns the one into the other. On many robots this *optical frame* has a name that ends in `_optical_frame`; on this robot it is `camera_front` itself.

# %%
# Check: the chain gives the camera's true place, and the columns of mount are the camera's axes
assert np.allclose(camera_in_map.position, robot.pose("camera")[:3], atol=1e-3)
assert np.linalg.norm(map_to_odom.position) > 0.1
with Simulation(seed=2, start=(0.0, 0.0, 0.0)) as at_start:
    assert (at_start.odometry().x, at_start.odometry().y) == (0, 0) == tuple(at_start.pose("robot")[:2])
assert mount.rotation.T.tolist() == [[0, -1, 0], [0, 0, -1], [1, 0, 0]]

# %% [markdown]
# As a message, a transform is a `TransformStamped`. This is what a robot publishes once for its camera:

# %%
if ros_available():
    from geometry_msgs.msg import TransformStamped

    msg = TransformStamped(child_frame_id="camera_front")
    msg.header.frame_id = "base_footprint"  # the parent
    shift, turn = msg.transform.translation, msg.transform.rotation
    shift.x, shift.y, shift.z, turn.x, turn.y, turn.z, turn.w = mount.vector.tolist()
    print(msg.header.frame_id, "->", msg.child_frame_id)
    print("shift", shift.x, shift.y, shift.z)
    print("quaternion", turn.x, turn.y, turn.z, turn.w)

# %% [markdown]
# Transforms that change are sent on `/tf`, the mounted ones on `/tf_static`: there a subscriber that comes late still gets the last message (*transient local*). Their type, `tf2_msgs/TFMessage`, is not among the packages from which this course installs ROS 2. So nothing here publishes `/tf`, and you multiply the poses yourself. On a robot, `ros2 run tf2_tools view_frames` draws its tree, and `buffer.lookup_transform("map", "camera_front", stamp)` gives the product.

# %% [markdown]
# ## 9 · In the room ([[minutes]], deeper)
#
# The robot drives the five curves of section 8 once more, and has both: its wheels, and its camera. The class follows the points of the last keyframe, and takes a new keyframe after 0.15 m or 10 degrees. It also takes one if fewer than 40 pairs agree, while it still can.

# %% tags=["long"]
class VisualOdometry:
    """The pose of a camera, from images and depth alone; pose: where it is at first."""

    def __init__(self, pose):
        self.pose = self.key_pose = pose
        self.key = None  # gray image and depth of the last keyframe
        self.count = 0  # of keyframes

    def step(self, gray, depth, camera):
        if self.key is None or self.moved(gray, depth, camera):
            self.key, self.key_pose = (gray, depth), self.pose
            self.count += 1
        return self.pose

    def moved(self, gray, depth, camera):
        """Finds the new pose; True if a new keyframe is needed."""
        before, after = two_clouds(*self.key, gray, depth, camera)
        if len(before) < 10:
            return True  # it sees nothing, and goes on from where it was
        try:
            motion, near = ransac_motion(before, after)
        except ValueError:  # fewer than three pairs agree
            return True
        way = np.linalg.norm(motion.position)
        if way > 0.5:  # no robot jumps so far
            return True
        self.pose = self.key_pose @ motion.inverse()
        # the diagonal of a rotation adds up to 1 + 2 cos(angle)
        angle = math.acos(min(1.0, (np.trace(motion.rotation) - 1) / 2))
        return bool(way > 0.15 or angle > math.radians(10) or near.sum() < 40)

# %% tags=["long"]
robot = Simulation(seed=2, start=(0.0, 0.0, 0.0))
odometry = VisualOdometry(mount)
truth, wheels, seen = [], [], []
for angular, images in ((0.5, 5), (-0.5, 10), (0.5, 10), (-0.5, 10), (0.5, 5)):
    for _ in range(images):
        gray = cv2.cvtColor(robot.frame(), cv2.COLOR_BGR2GRAY)
        seen.append(odometry.step(gray, robot.depth(), robot.depth_camera()).position)
        counted = robot.odometry()
        wheels.append((Pose.planar(counted.x, counted.y, counted.yaw) @ mount).position)
        truth.append(robot.pose("camera")[:3])
        robot.step(0.25, angular, dt=0.2)

# %% [markdown]
# These were 40 images in 8 seconds. At the end, the wheels are 22 cm wrong. **Predict** the error of the camera, in centimetres.

# %% role="predict"
guess_camera = None  # your guess: how many centimetres?

# %%
error_wheels = 100 * math.dist(wheels[-1], truth[-1])
error_camera = 100 * math.dist(seen[-1], truth[-1])
print("keyframes:", odometry.count)
compare_guess(guess_camera, round(error_camera, 1), "cm")

# %% tags=["long"]
figure = Figure(figsize=(8, 2.8), layout="constrained")
axes = figure.subplots()
for name, path, style in (("truth", truth, "0.7"), ("wheels", wheels, "r--"), ("camera", seen, "b")):
    axes.plot(*np.array(path)[:, :2].round(3).T, style, label=name, linewidth=6 if name == "truth" else 2)
axes.set(xlabel="x (m), ahead", ylabel="y (m), left", aspect="equal")
figure.legend(loc="outside upper center", ncols=3)
show_figure(figure, text="where_am_i/room")

# %%
# Check: the numbers in this section
assert round(error_wheels) == 22 and error_camera < 6 and not robot.bumped and len(truth) == 40

# %% [markdown]
# And where it sees nothing? A bare wall has no corners, so there are no points to follow. The class then takes the pose from before, and the camera is worse than the wheels.
#
# So real robots combine both, in a Kalman filter as in [[object_tracking#4]]. `ekf_node` needs the covariances in each message; in the `Odometry` of this course's robot they are 0, and you would have to fill them in. It asks tf2 how the sensors are mounted.

# %% [markdown]
# ### Visual odometry as a node ([[minutes]], deeper)
#
# The node sees only what the robot publishes. It begins where the wheels say that it is, and then goes its own way. It publishes its pose as `Odometry`, and the way until now as a `Path`, both in the frame `odom`; RViz and Foxglove draw them. If a red line says that the room reaches fewer than 10 images per second, your machine is busy, and the two paths may differ much.

# %% tags=["long"]
if ros_available():
    from geometry_msgs.msg import PoseStamped
    from imgproc_course.messages import image_to_array
    from nav_msgs.msg import Odometry, Path
    from rclpy.node import Node
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import CameraInfo, Image

    class VisualOdometryNode(Node):
        def __init__(self, context=None):
            super().__init__("visual_odometry", context=context)
            self.odometry = self.camera = self.robot_pose = self.image = self.depth = None
            self.looks, self.wheels, self.path = 0, [], Path()
            base = "/kachaka/front_camera"
            for kind, topic, callback in (
                    (CameraInfo, f"{base}/camera_info", self.on_info),
                    (Odometry, "/kachaka/odometry/odometry", self.on_odometry),
                    (Image, f"{base}/image_raw", self.on_image),
                    (Image, f"{base}/depth", self.on_depth)):
                self.create_subscription(kind, topic, callback, qos_profile_sensor_data)
            self.poses = self.create_publisher(Odometry, "/visual_odometry/odometry", 10)
            self.paths = self.create_publisher(Path, "/visual_odometry/path", 10)

        def on_info(self, msg):
            self.camera = CameraModel(msg.width, msg.height, msg.k[0], msg.k[4],
                                      msg.k[2], msg.k[5], tuple(msg.d))

        def on_odometry(self, msg):
            place, turn = msg.pose.pose.position, msg.pose.pose.orientation
            self.robot_pose = Pose.from_vector(
                [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w])

        def on_image(self, msg):
            self.image = msg
            self.look()

        def on_depth(self, msg):
            self.depth = msg
            self.look()

        def look(self):
            known = (self.image, self.depth, self.camera, self.robot_pose)
            if None in known or self.image.header.stamp != self.depth.header.stamp:
                return
            if self.odometry is None:
                self.odometry = VisualOdometry(self.robot_pose @ mount)
            every = self.image.width // self.depth.width  # the depth image may be smaller
            gray = image_to_array(self.image, "mono8")[::every, ::every].copy()
            pose = self.odometry.step(gray, image_to_array(self.depth), self.camera.every(every))
            self.wheels.append(self.robot_pose.position)
            self.publish_pose(pose @ mount.inverse())
            self.looks += 1

        def publish_pose(self, robot_pose):
            msg = Odometry(child_frame_id="base_footprint")
            msg.header.stamp, msg.header.frame_id = self.image.header.stamp, "odom"
            place, turn = msg.pose.pose.position, msg.pose.pose.orientation
            (place.x, place.y, place.z, turn.x, turn.y, turn.z,
             turn.w) = robot_pose.vector.tolist()
            self.poses.publish(msg)
            self.path.header = msg.header
            self.path.poses.append(PoseStamped(header=msg.header, pose=msg.pose.pose))
            self.paths.publish(self.path)

# %% tags=["nbval-ignore-output", "long"]
if ros_available():
    live_camera = open_camera("room", rate=10)
    live_robot = Robot()
    live_robot.restart(start=(0.2, 0.0, 0.0))
    session = RosSession.current()
    node = session.add_node(VisualOdometryNode(context=session.context))
    for angular, looks in ((0.4, 10), (-0.4, 25), (0.4, 35)):
        end = time.monotonic() + 12
        while node.looks < looks and time.monotonic() < end:
            live_robot.drive(0.25, angular)  # again and again: an old command stops the robot
            time.sleep(0.1)
    live_robot.stop()
    session.remove_node(node)
    live_camera.stop()
    print("looks:", node.looks, "  poses in the path:", len(node.path.poses))
    places = [pose.pose.position for pose in node.path.poses]
    figure = Figure(figsize=(8, 2.8), layout="constrained")
    axes = figure.subplots()
    axes.plot([place.x for place in places], [place.y for place in places], "b", label="camera")
    axes.plot([place[0] for place in node.wheels], [place[1] for place in node.wheels],
              "r--", label="wheels")
    axes.set(xlabel="x (m), ahead", ylabel="y (m), left", aspect="equal")
    axes.legend()
    show_figure(figure, text="where_am_i/live")

# %%
# Check: the node looked, and published each pose
assert not ros_available() or node.looks == len(node.path.poses) > 0

# %% [markdown]
# **On the real robot**, the depth image comes from another camera, which looks up and does not see the floor; so one uses points without depth, and more of them.

# %% [markdown]
# ## Recap
#
# A marker says where the robot is, if its corners are exact. Two clouds of points say how it moved; RANSAC leaves out what moves by itself. Every step adds its error, so take few steps: compare with keyframes.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | corners of the marker | (4, 2) | float64 | inside the image | pixel: column, row |
# | homography | (3, 3) | float64 | `H[2, 2]` is 1 | |
# | cloud of points | (N, 3) | float64 | 0.2 to 6 ahead | metre: right, down, ahead |
# | rotation | (3, 3) | float64 | −1 to 1 | |
# | shift | (3,) | float64 | | metre |
# | inliers | (N,) | bool | False, True | |
#
# **Next:** [[reading_text]], or the optional [[mapping_and_slam]]. The route *The driving robot* ends here. First choose **File → Close and Shut Down Notebook**: it frees the robot.

# %%
# Check: the numbers in the table
assert corners[0].shape == (4, 2)
assert before.shape == after.shape and before[:, 2].min() > 0.2 and after[:, 2].max() < 6
assert near.shape == (len(before),) and near.dtype == bool and motion.rotation.shape == (3, 3)
