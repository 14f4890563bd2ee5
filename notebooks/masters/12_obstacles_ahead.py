# ---
# jupyter:
#   imgproc_course:
#     title: Obstacles ahead
# ---

# %% [markdown]
# # Obstacles ahead
#
# A robot that drives must know two things: what is in its way, and how far away it is. In this lesson you compute both from a depth image. At the end, a node of your own brakes before the robot bumps into something.
#
# **You will be able to**
# - compute the ray of a pixel, and with the depth the point in the room that the pixel shows,
# - find the floor among many points with RANSAC, and everything that stands on it,
# - find the nearest obstacle in the way of the robot,
# - brake in time, and write a node that reads a scan, drives, and stops when the data stop,
# - deeper: drive past obstacles to a goal.
#
# **Time** [[minutes]], with a pause after section 4. **You need** [[drive_the_robot]] and [[arrays]]. Only the end of section 9 needs ROS 2: the node of section 8 can be checked without it.

# %% role="given" exercise=["obstacles-plane", "obstacles-nearest", "obstacles-brake", "obstacles-drive"]
import math

import numpy as np

# %%
import time

from imgproc_course.display import live_view, show
from imgproc_course.exercises import check, compare_guess, hint
from imgproc_course.exercises import offer_modules, solution
from imgproc_course.geometry import CameraModel, Pose
from imgproc_course.recording import open_recording
from imgproc_course.ros import Robot, RosSession, open_camera, ros_available
from imgproc_course.simulation import Simulation

offer_modules()  # for the node of section 8
recording = open_recording("drive")

# %% role="texts"
figure_texts = {
    "depth": (
        "A frame of the recorded drive and its depth image: dark is near. The depth of the floor grows with each row upward.",
        "Left, the living room in colour; right, the same in gray levels: dark floor in front, bright walls behind.",
    ),
    "height": (
        "The height above the floor that was found, in metres. The floor is dark; what stands on it gets brighter upward.",
        "The living room in colours of height: the floor is dark blue, the lower parts of ball, sofa, table and boxes are green, everything above half a metre is yellow.",
    ),
    "obstacles": (
        "White: more than 3 cm above the floor. Left computed, right from the ground truth.",
        "Two black and white images that look nearly the same: the floor is black, furniture and walls are white.",
    ),
    "phantom": (
        "White: more than 3 cm above the floor. With the rays of the lens, the floor is free; without, there are phantom obstacles at its border.",
        "Left, a black floor; right, the same with white bands in the lower corners of the image.",
    ),
    "brakes": (
        "What the camera sees while my node drives, live.",
        "Cardboard boxes on a wooden floor, which come nearer and then stay where they are.",
    ),
    "boxes": (
        "What the robot sees before it drives: cardboard boxes.",
        "Cardboard boxes close in front of the camera, on a wooden floor.",
    ),
}

# %% [markdown]
# ## 1 · The depth image ([[minutes]])
#
# You may know the depth image from [[what_is_image_processing#4]]: for every second row and every second column of the frame, it has a distance in millimetres. This distance is the *[[term:depth]]* of a point: how far it is in front of the camera, measured straight ahead. 0 means: no depth; other cameras send NaN.

# %%
frame = recording.frame(30)
depth = recording.depth(30)
z = depth / 1000  # metres
print(depth.shape, depth.dtype, " from", z.min(), "to", z.max(), "m")
show([frame[::2, ::2], depth], ["frame", "depth"], limits=(0, 5000),
     text="obstacles_ahead/depth")

# %%
# Check: each pixel of this depth image has a depth
assert depth.shape == (360, 640) and (depth > 0).all()

# %% [markdown]
# **On the real robot** there is no such topic: `/kachaka/front_camera/depth` belongs to this course. The depth camera of a Kachaka (`/kachaka/tof_camera/image_raw`) looks up and does not see the floor. There you use the laser scanner, `/kachaka/lidar/scan`, as in section 8. Many other robots have a depth camera like ours.
#
# ## 2 · The ray of a pixel ([[minutes]])
#
# A pixel and its depth are not yet a place in the room. For this you need the *[[term:ray]]* of the pixel: the line from the camera on which everything lies that this pixel shows. We describe a ray by its point (x, y, 1), at a depth of 1 m: x metres to the **right** and y metres **down**. The point at the depth z is then (x · z, y · z, z).
#
# The camera's message `camera_info` has what we need, the *[[term:intrinsics]]* of the camera: its focal length `f` and its *[[term:principal point]]*, the pixel at which it looks straight ahead. Both are in pixels. The depth image has half the size, so all three are halved.

# %%
info = recording.camera_info
camera = CameraModel(info.width, info.height, info.k[0], info.k[4],
                     info.k[2], info.k[5], tuple(info.d)).every(2)
f, center = float(camera.fx), (float(camera.cx), float(camera.cy))
k1, k2 = info.d[0], info.d[1]
print("f", f, "  center", center, "  k1", k1, " k2", k2)

# %% [markdown]
# Without a lens (a *pinhole camera*), the ray is simple: a pixel that is f columns to the right of the principal point has x = 1. So x = (col − center col) / f, and y = (row − center row) / f.
#
# A lens bends the image: this is the [[term:distortion]]. In our image, every point is nearer to the middle than a pinhole camera would show it. The usual model says: a ray (x, y) appears at (x · factor, y · factor), with
#
# $$\text{factor} = 1 + k_1 r^2 + k_2 r^4, \qquad r^2 = x^2 + y^2$$
#
# We need the other direction: we know where the ray appears, and look for x and y. There is no simple formula, but a simple trick: guess, and improve the guess. Begin with the pinhole ray, compute the factor, and divide the pinhole ray by it. This gives a better guess. Repeat this. (OpenCV's `undistortPoints` does the same.) Here for the pixel in the upper left corner:

# %%
def lens_ray(pinhole_x, pinhole_y, k1, k2, repetitions=20):
    x, y = pinhole_x, pinhole_y
    for _ in range(repetitions):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
    return x, y


col, row = 0, 0
pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
for repetitions in (1, 2, 3, 4, 20):
    x, y = lens_ray(pinhole_x, pinhole_y, k1, k2, repetitions)
    print("repetitions", repetitions, "  x", round(x, 3), "  y", round(y, 3))

# %% [markdown]
# After 20 repetitions, x and y do not change any more. **Predict**: at a depth of 3 m, how many centimetres are between the point on the pinhole ray and the point on the right ray of this corner?

# %% role="predict"
guess_corner = None  # your guess: how many centimetres?

# %%
difference = 3 * math.hypot(x - pinhole_x, y - pinhole_y)
print("pinhole", round(pinhole_x, 3), round(pinhole_y, 3))
print("lens   ", round(x, 3), round(y, 3))
compare_guess(guess_corner, round(100 * difference), "cm")

# %%
# Check: the numbers in this section; the ray of the course's camera has three more numbers of the lens
ray = camera.rays()[0, 0]
assert round(100 * difference) == 70 and abs(x - ray[0]) < 0.002 and abs(y - ray[1]) < 0.002
assert (camera.fx, camera.cx, camera.cy) == (352.5, 319.75, 179.75)

# %% [markdown]
# The points are 70 cm apart! Section 6 shows what a robot does with such an error.
#
# The course's camera has the rays of all pixels: `camera.rays()`. It also uses three more numbers of the lens. Their effect is small: it moves each pixel of the depth image by at most one pixel. With one multiplication, every pixel becomes a point. (`np.newaxis`: one depth multiplies x, y and 1.)

# %%
rays = camera.rays()  # (360, 640, 3): x, y, 1
points = rays * z[:, :, np.newaxis]  # metres: right, down, ahead
print(rays.shape, points.shape, points.dtype)
print("the point of pixel (250, 400):", points[250, 400].round(2))

# %%
# Check: two ways to the same ray, and the three more numbers
grid_rows, grid_cols = np.mgrid[:360, :640]
own_x, own_y = lens_ray((grid_cols - 319.75) / 352.5, (grid_rows - 179.75) / 352.5, k1, k2)
moved = camera.project(np.dstack([own_x, own_y, np.ones((360, 640))])) - np.dstack([grid_cols, grid_rows])
assert np.hypot(moved[..., 0], moved[..., 1]).max() < 1

# %% [markdown]
# ## 3 · A plane of three points ([[minutes]])
#
# The floor is a *[[term:plane]]*. Three points that are not on one line lie on exactly one plane. How do we compute it?
#
# NumPy's `np.cross(u, v)` is the *[[term:cross product]]* of two vectors: a vector that is perpendicular to both. Take two directions on the floor, one to the right and one ahead:

# %%
right, ahead = np.array([1.0, 0, 0]), np.array([0, 0, 1.0])
print(np.cross(right, ahead))
print(np.cross(ahead, right))

# %% [markdown]
# The first result is (0, −1, 0). It points **up**, because y points down. (The order matters: the second result points down.) A vector that is perpendicular to a plane and 1 long is called the *[[term:normal]]* of the plane.
#
# From three points a, b, c we get two directions in the plane: b − a and c − a. Their cross product is perpendicular to the plane; divide it by its length, and if it points down (its y is positive), turn it round. The height of a point p above the plane is then `normal @ p + offset`, where the *offset* is chosen so that a has the height 0. (`@` multiplies the numbers of two vectors in pairs and adds up the products: the *dot product*.) **Predict** the offset for a floor that is 0.2 m below the camera.

# %% role="predict"
guess_offset = None  # your guess: which number?

# %%
slanted = np.array([0.0, -3.0, 4.0])
print("length", np.linalg.norm(slanted), "  divided by it:", slanted / np.linalg.norm(slanted))
up = np.cross(right, ahead)
point = np.array([0.5, 0.2, 2.0])  # on this floor
offset = -(up @ point)
compare_guess(guess_offset, round(float(offset), 2))

# %% [markdown]
# `np.linalg.norm` is the length of a vector: here the root of 3² + 4², which is 5. The offset is 0.2: it is the height of the camera above the plane, because the camera itself is the point (0, 0, 0).

# %%
# Check: the numbers in this section
assert np.cross(right, ahead).tolist() == [0, -1, 0] and np.cross(ahead, right).tolist() == [0, 1, 0]
assert np.linalg.norm(slanted) == 5 and up.tolist() == [0, -1, 0] and offset == 0.2

# %% [markdown]
# ### Your turn: the plane of three points
#
# Write `plane_of(a, b, c)`. `np` is imported for you. The points do not lie on one line.
#
# | Input | Output | Example call |
# |---|---|---|
# | `a`, `b`, `c`: arrays of three floats, metres: right, down, ahead | two values: the normal, an array of three floats that is 1 long and points up (its y is negative), and the offset, a float in metres | `plane_of(a, b, c)` with the points (0, 0.2, 1), (1, 0.2, 1) and (0, 0.2, 2) returns `[0, -1, 0]` and `0.2` |

# %% role="exercise"
exercise(
    "obstacles-plane",
    title="The plane of three points",
    function="plane_of",
    tolerance=1e-6,
    hint="The normal is the cross product of b - a and c - a, divided by its length, and turned so that its y is negative (up); the offset is -(normal @ a).",
    hints=(
        "Which two directions lie in the plane, and which vector is perpendicular to both?",
        "1. The cross product of b - a and c - a.\n"
        "2. Divide it by its length: np.linalg.norm.\n"
        "3. If its y, normal[1], is positive, take the opposite vector.\n"
        "4. The offset: minus the dot product of the normal and a. Compute it after step 3.",
        "normal = np.cross(b - a, ...)\nnormal = ... / np.linalg.norm(...)\nif ... > 0:\n    normal = ...\n"
        "return normal, ...",
    ),
    explanation="The cross product is perpendicular to both directions, so it is perpendicular to the whole plane. Divided by"
    " its length, normal @ p measures metres along the normal. All points of the plane have the same value there, that of"
    " a, so the offset -(normal @ a) makes it 0. The sign is chosen at the end, so that heights above the floor are"
    " positive.",
    another_way="You can also write normal *= -np.sign(normal[1]), or compute the offset from b or c.",
)

# %% role="answer"
def plane_of(a, b, c):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def plane_of(a, b, c):
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    if normal[1] > 0:
        normal = -normal
    return normal, float(-(normal @ a))

# %% role="check"
check("obstacles-plane", plane_of)

# %% role="case" title="a floor that is not level" points=1
def inputs(rng):
    shift = rng.uniform((-1, 0.15, 0.5), (1, 0.35, 3)).round(3)
    right, ahead = np.array([0.8, 0.1, 0.2]), np.array([-0.1, -0.15, 0.9])
    down = np.array([0.1, 0.2, 0.9])
    return [(shift, shift + right, shift + ahead), (shift, shift + 0.5 * right, shift + 2 * down)]


# %% role="case" title="the points in another order" points=1 hint="The normal must point up: its y must be negative. If it is positive, take the opposite vector, before you compute the offset."
def inputs(rng):
    shift = rng.uniform((-1, 0.15, 0.5), (1, 0.35, 3)).round(3)
    right, ahead = np.array([0.9, -0.2, 0.1]), np.array([0.3, 0.2, 1.1])
    return [(shift, shift + ahead, shift + right), (shift + right, shift, shift + ahead)]


# %% role="hidden" title="any three points" points=1 hint="Is the normal 1 long, does it point up, and has a the height 0?"
def inputs(rng):
    right, ahead = np.array([0.7, 0.2, -0.1]), np.array([0.2, -0.1, 0.8])
    starts = rng.uniform((-1, 0.1, 0.5), (1, 0.5, 3), (4, 3)).round(3)
    return [(s, s + ahead, s + right) if k % 2 else (s, s + right, s + ahead) for k, s in enumerate(starts)]


# %% [markdown]
# ## 4 · RANSAC: which points are the floor? ([[minutes]])
#
# A depth image has 230,400 points; we use every fourth row and column. Most of them are walls and furniture. A plane through the middle of *all* points is useless:

# %%
many = points[::4, ::4].reshape(-1, 3)  # one row for each point
unknowns = np.column_stack([many[:, 0], many[:, 2], np.ones(len(many))])
slope_x, slope_z, height = np.linalg.lstsq(unknowns, many[:, 1])[0]
print(len(many), "points")
print("camera", round(float(height), 2), "m above this plane")
print("the plane rises by", round(float(-slope_z), 2), "m per metre")

# %% [markdown]
# The true camera is 0.20 m above a level floor. (`np.linalg.lstsq` finds the plane with the smallest squared errors of all points; each point that is not the floor pulls at it.)
#
# *[[term:RANSAC]]* (random sample consensus) does something else. It does not mix: it **draws three points at random**, computes their plane, and counts how many points are near this plane, its *[[term:inlier|inliers]]*. It repeats this 100 times, and keeps the plane with the most inliers. If at least one of the 100 draws had three points of the floor, this plane wins, because so many points are floor.
#
# 36 % of our points are floor. **Predict** in how many of 100 draws all three points are floor. (One after the other: 0.36 · 0.36 · 0.36.)

# %% role="predict"
guess_draws = None  # your guess: in how many of 100 draws?

# %%
labels = recording.labels(30)[::2, ::2]
is_floor = labels[::4, ::4].ravel() == 1
share = is_floor.mean()
print("floor:", round(100 * share), "%")
compare_guess(guess_draws, round(100 * share**3))

# %% tags=["long"]
from imgproc_course.geometry import triangle_planes


def plane_through(*corners):  # the package's function, so that the lesson does not need yours
    (normal,), (distance,) = triangle_planes([corners])
    sign = -1 if normal[1] > 0 else 1
    return sign * normal, -sign * distance


def find_floor(points, seed, draws=100):
    rng = np.random.default_rng(seed)
    most = 0
    for _ in range(draws):
        numbers = rng.choice(len(points), 3, replace=False)
        normal, offset = plane_through(*points[numbers])
        near = np.abs(points @ normal + offset) < 0.02  # metres
        if near.sum() > most:
            most, best = near.sum(), (normal, offset, near)
    return best

# %%
normal, offset, near = find_floor(many, seed=0)
tilt = math.degrees(math.acos(-normal[1]))
print("inliers:", round(100 * near.mean()), "%")
print("camera", round(float(offset), 3), "m above the floor")
print("tilt", round(tilt, 1), "degrees")

# %% [markdown]
# In about five of 100 draws, all three points are floor, and one such draw is enough. The camera is 0.200 m above the floor, and the floor is level to 0.1 degrees. There are more inliers (43 %) than points of the floor, because the rug lies on it, and is only 12 mm high.

# %%
# Check: the numbers in this section, against the truth
assert len(many) == 14400 and depth.size == 230_400
assert round(float(height), 2) == 0.43 and round(float(-slope_z), 2) == 0.36
assert round(100 * share) == 36 and round(100 * share**3) == 5 and round(100 * near.mean()) == 43
pose = Pose.from_vector(recording.pose("camera", 30))
true_normal = pose.rotation[2]
assert abs(offset - 0.2) < 0.0004 and abs(pose.position[2] - offset) < 0.001
assert math.degrees(math.acos(min(1.0, normal @ true_normal))) < 0.1 and round(tilt, 1) == 0.1

# %% [markdown]
# **Pause?** Afterwards choose **Run → Run All Above Selected Cell**.

# %% [markdown]
# ## 5 · What stands on the floor ([[minutes]])
#
# Now every height is one line. What is more than 3 cm above the floor is an obstacle; the rug is not. The *[[term:IoU]]* (intersection over union) compares this mask with the right one.

# %%
height = points @ normal + offset  # (360, 640), metres
is_obstacle = height > 0.03
true_obstacle = (labels != 1) & (labels != 14)  # neither floor nor rug
both = (is_obstacle & true_obstacle).sum()
iou = both / (is_obstacle | true_obstacle).sum()  # in both, divided by in at least one
print("IoU with the ground truth:", round(iou, 2))
show(height.round(2), limits=(0, 0.5), cmap="viridis", text="obstacles_ahead/height")

# %%
show([is_obstacle, true_obstacle], ["computed", "ground truth"],
     text="obstacles_ahead/obstacles")

# %%
# Check: the obstacles agree with the ground truth
assert height.shape == (360, 640) and round(iou, 2) == 0.98
assert recording.label_names[14] == "rug"

# %% [markdown]
# ## 6 · Planned failure: the lens is forgotten ([[minutes]])
#
# Somebody knows that the camera is level and 0.20 m above the floor, so a height is just 0.20 − y, without RANSAC. This is right. But the rays are those of a pinhole camera: the lens was forgotten. **Predict** how many of the 48,154 points *of the floor* in frame 66 become "obstacles".

# %% role="predict"
guess_phantom = None  # your guess: how many of 48154 points?

# %%
z_66 = recording.depth(66) / 1000
rows, cols = np.mgrid[:360, :640]  # the row and the column of each pixel
wrong_left = -(cols - center[0]) / f * z_66
wrong_height = 0.20 - (rows - center[1]) / f * z_66
floor_66 = recording.labels(66)[::2, ::2] == 1
phantoms = (wrong_height > 0.03) & floor_66
print("points of the floor:", floor_66.sum())
compare_guess(guess_phantom, int(phantoms.sum()))

# %%
right_points = rays * z_66[:, :, np.newaxis]
right_height = 0.20 - right_points[:, :, 1]
show([right_height > 0.03, wrong_height > 0.03], ["with the lens", "pinhole"],
     text="obstacles_ahead/phantom")
print("with the lens:", ((right_height > 0.03) & floor_66).sum(), "phantoms")

# %% [markdown]
# Near the corners, the floor seems to stand up, because the pinhole rays do not go down far enough there. A robot brakes for these *phantom obstacles*. **Repair it**: use the rays of the lens. Many programs *undistort* the whole image first: the same correction.

# %%
# Check: the numbers in this section
assert floor_66.sum() == 48154 and phantoms.sum() == 1728
assert not ((right_height > 0.03) & floor_66).any()

# %% [markdown]
# ## 7 · The nearest obstacle in the corridor ([[minutes]])
#
# Not every obstacle is in the way. The robot is 0.24 m wide. If it drives straight ahead, it needs a *corridor*: a strip of the floor, in which we want 8 cm of free space on each side, so 0.40 m in all. An obstacle is a point in the corridor that is higher than 3 cm, but lower than 0.40 m (the robot drives under anything that is higher).
#
# Right, down, ahead are the axes of a camera in ROS, its *optical frame*. From now on we use the axes of a robot, by REP 103 ([[drive_the_robot#2]]): **forward** (our z), **left** (minus our x) and up. The points are `right_points` of section 6: frame 66, with the rays of the lens.

# %%
forward, left = right_points[:, :, 2], -right_points[:, :, 0]
corridor = np.abs(left) <= 0.40 / 2
stands = (right_height > 0.03) & (right_height < 0.40)
print("points in the corridor:", corridor.sum())
print("obstacles among them:", (corridor & stands).sum())
print("the nearest:", forward[corridor & stands].min(), "m ahead")

# %% [markdown]
# The ball is in the way, 0.95 m ahead. **Predict** what the pinhole rays of the last section give: how far away is the nearest "obstacle"?

# %% role="predict"
guess_nearest = None  # your guess: how many metres?

# %%
wrong_corridor = np.abs(wrong_left) <= 0.40 / 2
wrong_stands = (wrong_height > 0.03) & (wrong_height < 0.40)
wrong_nearest = z_66[wrong_corridor & wrong_stands].min()
compare_guess(guess_nearest, round(wrong_nearest, 2), "m")

# %%
# Check: the numbers in this section
nearest = forward[corridor & stands].min()
nearest_names = recording.labels(66)[::2, ::2][corridor & stands & (forward < nearest + 0.01)]
assert round(nearest, 2) == 0.95 and recording.label_names[np.bincount(nearest_names).argmax()] == "ball"
assert round(wrong_nearest, 2) == 0.33

# %% [markdown]
# With the wrong rays, the nearest "obstacle" is the floor itself, at 0.33 m: this robot would never drive.
#
# ### Your turn: the nearest obstacle
#
# Write `nearest_obstacle(forward, left, height, width)`: how far ahead is the nearest obstacle in a corridor of this width? Its middle is straight ahead. `math` and `np` are imported for you.
#
# | Input | Output | Example call |
# |---|---|---|
# | `forward`, `left`, `height`: three arrays of one shape, float, metres; `width`: float, metres | float: the smallest `forward` of all points in the corridor that are higher than 0.03 m and lower than 0.40 m; `math.inf` if there is none | `nearest_obstacle(forward, left, right_height, 0.40)` |

# %% role="exercise"
exercise(
    "obstacles-nearest",
    title="The nearest obstacle in the corridor",
    function="nearest_obstacle",
    tolerance=1e-6,
    hint="Combine the conditions by &: np.abs(left) <= width / 2, height > 0.03, height < 0.40. Then take the minimum of forward[mask], or math.inf if the mask is empty.",
    hints=(
        "Which three conditions must a point fulfil, and what is the minimum of no points at all?",
        "1. A mask: np.abs(left) <= width / 2, and height > 0.03, and height < 0.40, combined by & with parentheses.\n"
        "2. If no point is in the mask (mask.any() is False), return math.inf.\n"
        "3. Otherwise return the minimum of forward in the mask.",
        "mask = (np.abs(left) <= ...) & (height > ...) & (height < ...)\nif not mask.any():\n    return math.inf\n"
        "return forward[mask]...",
    ),
    explanation="The middle of the corridor is straight ahead, so it reaches width / 2 to each side: np.abs(left) treats both"
    " sides alike. The minimum of no points is an error in NumPy, but a free corridor is the normal case for a robot:"
    " infinitely far away is the answer that every comparison understands. forward > 0 is for a depth that is missing:"
    " 0 would be an obstacle at the camera, and with NaN the minimum is NaN, which is not less than any stopping distance.",
    another_way="You can also write np.where(mask, forward, math.inf).min(), or forward[mask].min(initial=math.inf).",
)


def scene(rng, nearest, high=0.5):
    """Floor, what is too low or too high by nothing too, beside the corridor, obstacles in it, and a near floor."""
    forward = np.array([0.4, 0.45, 0.48, 0.52, high, 0.55, 0.6, 0.65, 0.7, nearest, nearest + 0.6, nearest + 1.2, 0.2])
    left = np.array([0.0, 0.05, 0.03, 0.04, -0.02, 0.3, -0.35, 0.22, -0.21, -0.12, 0.1, 0.02, 0.6])
    height = np.array([0.0, 0.02, 0.03, 0.4, 0.9, 0.2, 0.2, 0.1, 0.1, 0.15, 0.3, 0.05, 0.0])
    order = rng.permutation(13)
    return forward[order], left[order], height[order]


# %% role="answer"
def nearest_obstacle(forward, left, height, width):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03) & (height < 0.40) & (forward > 0)
    if not mask.any():
        return math.inf
    return float(forward[mask].min())

# %% role="check"
check("obstacles-nearest", nearest_obstacle)

# %% role="case" title="a corridor with obstacles" points=1
def inputs(rng):
    return [(*scene(rng, round(rng.uniform(0.9, 1.5), 2)), 0.32), (*scene(rng, round(rng.uniform(1.6, 2.5), 2), 0.35), 0.34)]


# %% role="case" title="a free corridor, and other widths" points=1 hint="What does your function return if there is no point in the corridor? It must be math.inf. And is the corridor width / 2 wide on each side?"
def inputs(rng):
    forward, left, height = scene(rng, round(rng.uniform(0.9, 1.5), 2))
    free = (forward, left + 3, height)
    return [(*free, 0.32), (forward, left, height, 0.50), (forward, left, height, 0.15)]


# %% role="hidden" title="a depth image" points=1 hint="Do you use all conditions, with & between them?"
def inputs(rng):
    calls = []
    for width in (0.3, 0.5, 0.02):
        low, high = np.array((0.4, -1, -0.05)), np.array((4, 1, 0.8))
        values = rng.uniform(low[:, np.newaxis, np.newaxis], high[:, np.newaxis, np.newaxis], (3, 6, 8)).round(3)
        calls.append((*values, width))
    return calls


# %% [markdown]
# ## 8 · Brake! ([[minutes]])
#
# When must the robot brake? The first idea: when an obstacle is nearer than a fixed distance, say 0.06 m. We try it in the simulation, at three speeds. The robot measures once in each *step* of 0.1 s. (Its front is 0.03 m ahead of its camera.)

# %%
robot = Simulation(seed=1, start=(0.95, -1.3, 0.0), time=5.0)
robot_rays = robot.depth_camera().rays()
show(robot.frame(), text="obstacles_ahead/boxes")

# %% tags=["long"]
def free_distance(depth):
    """Metres between the robot's front and the nearest obstacle; 0 if it sees too little."""
    seen = robot_rays * (depth / 1000)[:, :, np.newaxis]
    forward, left, height = seen[:, :, 2], -seen[:, :, 0], 0.20 - seen[:, :, 1]
    measured = forward > 0  # False where the depth is 0 or NaN
    mask = measured & (np.abs(left) <= 0.20) & (height > 0.03) & (height < 0.40)
    if measured.mean() <= 0.5:
        return 0.0
    return forward[mask].min(initial=np.inf) - 0.03  # inf if nothing is in the corridor


def drive_and_brake(speed, limit):
    """Drives until limit metres are left, then brakes; the distance kept."""
    robot = Simulation(seed=1, start=(0.95, -1.3, 0.0), time=5.0)
    while free_distance(robot.depth()) > limit:
        robot.step(speed, 0.0, dt=0.1)  # one step
    while robot.speeds[0] > 0 and not robot.bumped:
        robot.step(0.0, 0.0)
    if robot.bumped:
        return "bump!"
    return round(float(free_distance(robot.depth())), 2)

# %% [markdown]
# **Predict** at which of the speeds 0.1, 0.2 and 0.3 m/s the robot bumps into the boxes.

# %% role="predict"
guess_bumps = None  # your guess: the speeds, for example (0.1, 0.2), or just one?

# %%
kept_fixed = {speed: drive_and_brake(speed, 0.06) for speed in (0.1, 0.2, 0.3)}
print(kept_fixed)
bumps = [speed for speed in kept_fixed if kept_fixed[speed] == "bump!"]
compare_guess(guess_bumps, bumps[0] if len(bumps) == 1 else tuple(bumps))

# %% [markdown]
# The faster the robot, the nearer it comes, and at 0.3 m/s it bumps. The better rule uses the stopping distance of [[drive_the_robot#6]]: brake when the free distance is less than the **stopping distance plus a margin**, here 0.15 m.

# %%
kept = {}
for speed in (0.1, 0.2, 0.3):
    stopping = speed / 10 + speed**2 / (2 * 0.6)  # ten steps per second
    kept[speed] = drive_and_brake(speed, 0.15 + stopping)
print(kept)

# %%
# Check: the numbers in this section
assert kept_fixed[0.3] == "bump!" and kept_fixed[0.1] > kept_fixed[0.2] > 0
assert all(0.15 <= kept[speed] < 0.19 for speed in kept)

# %% [markdown]
# Now it keeps its distance at every speed. How large must the margin be? This camera sees the floor straight ahead only from a distance of 0.38 m. A toy that is nearer is below the image. So with low obstacles, use a margin of 0.35 m or more.
#
# The node below uses the laser scanner. It has one speed, so one distance is enough.

# %%
# Check: where the image begins to show the floor; and what a missing depth changes
assert round(0.20 / robot_rays[-1, 320, 1], 2) == 0.38
some = np.where(np.arange(360)[:, np.newaxis] % 3 > 0, robot.depth(), np.nan)
most = np.where(np.arange(360)[:, np.newaxis] % 3 > 0, np.nan, robot.depth())
assert abs(free_distance(some) - free_distance(robot.depth())) < 0.02
assert free_distance(most) == free_distance(np.nan_to_num(most)) == 0

# %% [markdown]
# ### Where is straight ahead in a scan?
#
# The laser scanner measures, in each direction, the distance of the nearest thing. It publishes `sensor_msgs/LaserScan`: the first of its `ranges` lies at the angle `angle_min`, and each next one is `angle_increment` radians further to the left. The angles are counted in the frame that the header names: `laser_frame`. It follows REP 103, but it is turned by 90 degrees to the **left** against the robot. So an angle of the scan plus π / 2 is the angle seen from the robot. (The package `depthimage_to_laserscan` makes a scan of a depth image. Its header needs a frame with these axes, not the optical frame of the camera.)
#
# Here is a scan of eight ranges. Its `angle_min` is -π, its `angle_increment` π / 4. **Predict** which one is straight ahead of the robot: its index, from 0 to 7.

# %% role="predict"
guess_ahead = None  # your guess: which index?

# %%
angle_min, angle_increment = -math.pi, math.pi / 4
few = np.array([1.0, 2.0, 0.5, np.inf, 3.0, np.nan, 2.0, 0.01])
angles = angle_min + angle_increment * np.arange(8) + math.pi / 2
x, y = few * np.cos(angles), few * np.sin(angles)  # forward, left
print("degrees", np.degrees(angles))
print("forward", x.round(2))
compare_guess(guess_ahead, int(np.abs(angles).argmin()))

# %%
# Check: the numbers in this section
assert np.abs(angles).argmin() == 2 and (x[2], y[2]) == (0.5, 0)
assert not (few[5] <= 0.4) and not (few[5] > 0.4)

# %% [markdown]
# `inf` means that nothing was met. Other scanners send `nan`, and every comparison with `nan` is False. A range below `range_min`, such as 0.01 m, is no measurement either: the scanner sees itself.
#
# ### Your turn: a node that brakes
#
# Write the class `BrakeNode`. The robot drives straight ahead, and stops before an obstacle. The check sends scans, and reads the newest command after each of them.
#
# 1. **Connect.** The node is called `brake`. It subscribes to `LaserScan` on `/kachaka/lidar/scan`, and publishes `Twist` on `/kachaka/manual_control/cmd_vel`, both with `qos_profile_sensor_data`.
# 2. **Brake.** For each scan it publishes a command. `linear.x` is 0.0 if a range shows something in the corridor ahead, from 0 to 0.4 m forward and at most 0.2 m to the left or right; otherwise it is 0.2.
# 3. **Use only measurements.** Ranges that are not between `range_min` and `range_max` do not count.
# 4. **Stop when the data stop.** About ten scans come per second. If none has come for 0.5 s, the node publishes 0.0. With the next scan, the robot may drive again.
#
# For step 4, a node has *timers*. A timer calls a method again and again; `reset` lets its time begin again:
#
# ```python
# self.timer = self.create_timer(0.5, self.stop)  # calls self.stop() every 0.5 s
# self.timer.reset()
# ```
#
# The node must not call `rclpy.spin` or `time.sleep`.

# %% role="exercise"
exercise(
    "obstacles-brake",
    subject="node",
    title="A node that brakes",
    function="BrakeNode",
    time_limit=2,
    hint="on_scan resets the timer, computes forward and left as in the small scan, and publishes. stop publishes Twist().",
    hints=(
        "What does on_scan do with each scan, and who calls stop?",
        "1. In __init__, create the publisher, the subscription and a timer of 0.5 s that calls self.stop.\n"
        "2. In on_scan, reset the timer. Compute the angles, and forward and left of all ranges.\n"
        "3. Make a mask: measured, forward between 0 and 0.4, left between -0.2 and 0.2.\n"
        "4. Publish a Twist: 0.0 if any range is in the mask, else 0.2. stop publishes Twist(): zeros.",
        "ranges = np.array(msg.ranges)\n"
        "angles = msg.angle_min + msg.angle_increment * np.arange(len(ranges)) + ...\n"
        "forward, left = ranges * np.cos(angles), ...\n"
        "mask = (ranges >= msg.range_min) & (ranges <= ...) & (forward > 0) & (forward <= ...) & (np.abs(left) <= ...)\n"
        "command = Twist()\ncommand.linear.x = 0.0 if mask.any() else ...",
    ),
    explanation="Each scan resets the timer, so it calls stop only when scans stay away. Without it, the newest command stays"
    " as it is: a robot without a watchdog would drive on blindly. A new Twist has only zeros. A range that is no"
    " measurement is left out before anything is compared, so nan and inf cannot decide.",
    another_way="You can also store the time of each scan, self.get_clock().now(), and compare it in a timer of 0.1 s that"
    " publishes all commands.",
)


def scan(rng, *things, rays=60, lowest=0.05, empty=(), first=-180, **more):
    """A step of a drive: a scan of walls, and of things: (degrees to the left of straight ahead, range).

    Between the two degrees of `empty` nothing is met. The scan begins at `first`, degrees of the scanner.
    """
    ranges = rng.uniform(2.0, 4.0, rays).round(2)
    step = 2 * math.pi / rays
    for degrees, value in (*((degrees, math.inf) for degrees in range(*empty, 6)), *things) if empty else things:
        ranges[round((degrees - 90 - first) * rays / 360) % rays] = value
    begin = math.radians(first)
    fields = {"angle_min": begin, "angle_max": begin + (rays - 1) * step, "angle_increment": step,
              "range_min": lowest, "range_max": 8.0, "ranges": ranges.tolist()}
    places = ", ".join(place_of(*thing) for thing in things)
    about = "this scan has walls all around, also behind and on both sides, at least 2 m away"
    about += " (but inf from {}° to {}°)".format(*empty) if empty else ""
    about += f" and, counted to the left of straight ahead, {places}" if things else ""
    about += f", and begins at angle_min = {begin:.2f}" if first > -180 else ""
    return {"topic": "/kachaka/lidar/scan", "message": "LaserScan", "fields": fields, "about": about} | more


def place_of(degrees, value):
    if not 0.1 < value < 8:
        return f"{value} at {degrees}°"
    ahead, left = (value * f(math.radians(degrees)) for f in (math.cos, math.sin))
    side = f"{abs(left):.2f} m to the {'left' if left > 0 else 'right'}"
    along = "; a range is the way along its ray" if 0.01 < ahead < value - 0.01 else ""
    return f"{value} m at {degrees}° ({ahead:.2f} m ahead, {side}{along})"


def shuffled(rng, steps):
    return [steps[number] for number in rng.permutation(len(steps))]


# %% role="answer"
import math

import numpy as np
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class BrakeNode(Node):
    def __init__(self):
        raise NotImplementedError("step 1: delete this line; first comes super().__init__")

    def on_scan(self, msg):
        pass  # steps 2 and 3

    def stop(self):
        pass  # step 4


# %% role="solution"
import math

import numpy as np
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class BrakeNode(Node):
    def __init__(self):
        super().__init__("brake")
        self.commands = self.create_publisher(
            Twist, "/kachaka/manual_control/cmd_vel", qos_profile_sensor_data)
        self.create_subscription(
            LaserScan, "/kachaka/lidar/scan", self.on_scan, qos_profile_sensor_data)
        self.timer = self.create_timer(0.5, self.stop)

    def on_scan(self, msg):
        self.timer.reset()
        ranges = np.array(msg.ranges)
        angles = msg.angle_min + msg.angle_increment * np.arange(len(ranges)) + math.pi / 2
        forward, left = ranges * np.cos(angles), ranges * np.sin(angles)
        measured = (ranges >= msg.range_min) & (ranges <= msg.range_max)
        in_the_way = measured & (forward > 0) & (forward <= 0.4) & (np.abs(left) <= 0.2)
        command = Twist()
        command.linear.x = 0.0 if in_the_way.any() else 0.2
        self.commands.publish(command)

    def stop(self):
        self.commands.publish(Twist())


# %% role="check"
check("obstacles-brake", BrakeNode)


# %% role="case" title="step 1: connect" points=1 hint="Compare the name, the topics and the types, letter by letter."
def inputs(rng):
    return ("connections", [])


# %% role="case" title="step 2: brake" points=1 hint="Which angle of the scan is straight ahead? And are both limits used, forward and left?"
def inputs(rng):
    near = [(0, 0.3), (24, 0.42), (-24, 0.42), (-30, 0.3)]  # in the corridor
    elsewhere = [(90, 0.3), (-90, 0.3), (180, 0.3), (60, 0.35), (-60, 0.35), (0, 0.6)]
    scans = [scan(rng, thing) for thing in (*near, *near, *elsewhere)]
    beside = scan(rng, (84, 0.25), (6, 0.35))
    scans.append(scan(rng, empty=(150, 216)))
    return ("commands", [scan(rng), *shuffled(rng, [*scans, beside, scan(rng, (0, 0.25), rays=120), scan(rng, (0, 0.3), first=-90)])])


# %% role="case" title="step 3: use only measurements" points=1 hint="Do nan, inf and ranges below range_min stop your robot? Or do they hide an obstacle?"
def inputs(rng):
    no_measurements = [(6, math.nan)], [(0, math.inf)], [(12, 0.02)], [(-6, 9.5)]
    alone = [scan(rng, *things) for things in no_measurements]
    obstacles = [scan(rng, *things, (18, 0.3)) for things in no_measurements]
    gaps = [scan(rng, (12, 0.3), empty=(-90, 0)), scan(rng, (-12, 0.3), empty=(-90, -30)), scan(rng, empty=(-30, 60))]
    return ("commands", shuffled(rng, [*alone, *obstacles, *gaps, scan(rng, (0, 0.15), lowest=0.2)]))


# %% role="case" title="step 4: stop when the data stop" points=1 hint="A timer must publish 0.0 when no scan has come for 0.5 s, and each scan must begin its time again."
def inputs(rng):
    scans = [scan(rng) for _ in range(4)]
    mixed = [*scans, *(scan(rng, (degrees, 0.3)) for degrees in (0, 10, -10, 5))]
    first, then = shuffled(rng, mixed), shuffled(rng, mixed)
    stopped = [scan(rng), {"seconds": 1.2}, scan(rng), {"seconds": 1.2}]
    return ("commands", [{"seconds": 0.6}, *scans, scan(rng, seconds=0.3), *first, *stopped, *then])


# %% role="hidden" title="other scans" points=1 hint="Does your node use angle_min, angle_increment, range_min and range_max of each scan?"
def inputs(rng):
    free, near = scan(rng, rays=90), scan(rng, (int(rng.integers(-20, 21)), round(rng.uniform(0.2, 0.35), 2)), rays=90, first=-100)
    other = scan(rng, (0, round(rng.uniform(0.1, 0.25), 2)), (180, 0.2), rays=60, lowest=0.3)
    mixed = [free, near, near, other] * 3
    return ("commands", [*shuffled(rng, mixed), free, {"seconds": 1.2}, *shuffled(rng, mixed)])


# %% [markdown]
# **Run it** in the room: the robot drives to the boxes, and stops.

# %% tags=["nbval-ignore-output", "long"]
if ros_available():
    camera = open_camera("room", rate=10)
    Robot().restart(start=(0.4, -1.3, 0.0))
    view = live_view(camera, text="obstacles_ahead/brakes")
    try:
        node = RosSession.current().add_node(BrakeNode)
        time.sleep(8)
        RosSession.current().remove_node(node)
    except NotImplementedError:
        print("write step 1 of your class first")
    print("bumps:", camera.bumps)
    view.stop()
    camera.stop()

# %%
# Check: the live view had no error; and the numbers below
assert not ros_available() or view.error is None
assert round(0.4 - 0.084 - (0.2 * 0.2 + 0.2**2 / 1.2), 2) == 0.24 and round(0.2 * 0.2 + 0.2**2 / 1.2, 3) == 0.073

# %% [markdown]
# The robot's front is 0.084 m ahead of the scanner, and its stopping distance is 0.073 m (it drives on for 0.2 s, and brakes), so at least 0.24 m are left. **On the real robot** this node runs unchanged. The scanner misses what is lower or higher than its plane.

# %% [markdown]
# ## 9 · Drive through rooms that you have not seen ([[minutes+20]], deeper)
#
# Braking is not enough: a robot must also find a way past an obstacle. Your function drives the robot through furnished rooms that you do not know, for 40 s in each. Slippers or building blocks are in its way. A goal is behind them, 2.2 m straight ahead of the start. The robot drives to the goal, and then on through the room. In some rooms there is a way on the left only, in others on the right only, and in some the robot must first drive far to the side. A detour of a fixed shape touches something.
#
# The laser scanner looks over low things. The depth camera sees them, but only ahead, and from 0.38 m on. So the robot must remember them.
#
# In each step of 0.1 s, the robot calls your function `control(observation, memory)`. It returns two speeds: linear in m/s, at most 0.3, and angular in rad/s, to the left, at most 1.57. One call may take 0.5 s, and 0.05 s of processor time on average. `memory` is an empty dict at the start: what you store in it, you find again at the next call. (`memory.setdefault("count", 0)` gives a value, and stores 0 if there is none.) The *observation* is a dict, too:
#
# | key | value |
# |---|---|
# | `"depth"` | (90, 160) uint16: the depth image of the front camera in millimetres, 0 where there is none |
# | `"scan"` | (360,) float32: the laser scanner's ranges in metres, one per degree, to the left from straight ahead; `inf` where it meets nothing |
# | `"odometry"` | (3,) float64: x, y (metres) and yaw (radians), as the wheels count them: (0, 0, 0) at the start, x points to where the robot looks then |
# | `"time"` | float: seconds since the start |
#
# The goal is the place (2.2, 0) of the odometry. Two functions are given; they count from the middle of the axle, 0.24 m behind the front. `obstacles` makes points of both sensors. A slipper's sole is only 3 cm high, and far away the depth is less exact: a point counts above 2.2 cm at 1 m, and above 3.6 cm at 3 m. `free_way` finds the nearest point in a corridor of 0.64 m in any direction: 0.20 m stay free on each side. The check takes both as they stand here: to change one, write a function with another name in your answer cell.

# %% role="given" exercise="obstacles-drive" tags=["long"]
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


def free_way(points, direction, width=0.64):
    """Metres before the robot's front, if it drives in this direction (radians)."""
    c, s = math.cos(direction), math.sin(direction)
    forward, left = points[:, 0] * c + points[:, 1] * s, points[:, 1] * c - points[:, 0] * s
    return forward[(np.abs(left) <= width / 2) & (forward > 0)].min(initial=9.0) - 0.24

# %% [markdown]
# We try both in the room of the recorded drive, with the boxes of section 8 in front of the robot:

# %%
small = Simulation(seed=1, start=(0.95, -1.3, 0.0), movers=False, depth_size=(160, 90))
first_look = {"depth": small.depth(), "scan": small.scan().ranges}
things = obstacles(first_look)
for degrees in (0, 45, 90, 180):
    way = free_way(things, math.radians(degrees))
    print(degrees, "degrees to the left:", round(float(way), 1), "m")

# %%
# Check: the free ways are those of the room; and a point at the front has no way before it
assert first_look["depth"].shape == (90, 160) and things.shape[1] == 2
assert 0.3 < free_way(things, 0.0) < 0.5 and free_way(things, math.radians(90)) > 1
assert free_way(np.array([[0.24, 0.1]]), 0.0) == 0 and 2 * 0.32 == 0.64
assert [round(0.015 + 0.007 * forward, 3) for forward in (1, 3)] == [0.022, 0.036]

# %% [markdown]
# ### Your turn: drive
#
# Write `control(observation, memory)`. Each drive takes 40 s, and is judged by four metrics:
#
# - **bumps**: none.
# - **clearance**: the body comes no nearer than 0.08 m to anything while it moves.
# - **time to the goal**: within 20 s, the middle of the axle is at most 0.6 m from the goal, by the odometry. The map shows the true way; the odometry drifts.
# - **places**: in the whole drive, the robot is in at least 10 cells of 0.5 m. So it does not stop at the goal.
#
# A drive gives its points only if it keeps all four. `math`, `np`, `obstacles` and `free_way` are imported for you. You may also import `cv2`, `scipy`, and of `imgproc_course` the packages `geometry`, `imaging` and `messages`. The stub drives straight ahead: check it first. The check drives in three rooms, and takes about ten seconds. It shows what your function prints in the first drive that fails.
#
# | Input | Output | Example call |
# |---|---|---|
# | `observation`: the dict of the table above; `memory`: a dict that is yours | two numbers: the linear speed in m/s (at most 0.3) and the angular speed in rad/s (positive: to the left) | `control({**first_look, "odometry": np.zeros(3), "time": 0.0}, {})` |

# %% role="exercise"
exercise(
    "obstacles-drive",
    title="Drive through rooms that you have not seen",
    function="control",
    subject="drive",
    sensors=("depth", "scan", "odometry"),
    hint="If the way to the goal is free, drive there. Else drive first to a place 0.5 to 1.3 m away, to which the way is free, and from which the way to the goal is free. Remember what the camera saw: it forgets low things that are beside the robot, or near. After the goal, choose other places.",
    hints=(
        "Which places near the robot can it reach on a straight way? And from which of them is the straight way to the goal free? What stands beside the robot that no sensor sees any more? And where does it drive after the goal?",
        "1. Turn the points of each look into the frame of the odometry, round them to 5 cm, and store each one once: np.unique with axis=0. Turn all of them back into the frame of the robot. So it knows also what is below its image and beside it.\n"
        "2. Write is_free(begin, end): free_way of points - begin, in the direction of end - begin, is at least as long as the way.\n"
        "3. If the way to the goal is free, the goal is the aim. Else the aim is a place with two free legs: from the robot to it, and from it to the goal. Try places 0.5 to 1.3 m away all around, and take the one with the shortest way. Without any, take one with a free first leg.\n"
        "4. Store the aim, in the frame of the odometry. Choose again when the robot is there, or when the way to it is blocked.\n"
        "5. Turn on the spot while the aim is more than about 0.2 rad beside; else drive, and steer to it. Near the goal, begin to take aims with a long free way.",
        "goal = to_room @ np.subtract((2.2, 0.0), (x, y))  # seen from the robot\n"
        "around = [(r * math.cos(a), r * math.sin(a)) for r in (0.5, 0.9, 1.3) for a in np.radians(np.arange(-165, 181, 15))]\n"
        "ways = [place for place in around if is_free((0, 0), place) and is_free(place, ...)]\n"
        "aim = min(ways, key=lambda place: math.hypot(*place) + math.dist(place, ...), default=...)\n"
        "memory[\"aim\"] = aim @ to_room + (x, y)\n"
        "if abs(turn) > 0.2:\n    return 0.0, ...\nreturn 0.3, 1.5 * turn",
    ),
    explanation="The corridor is 0.64 m wide, so the robot keeps 0.2 m on each side of what it knows; if no way is so wide, 0.56 m are"
    " enough. It drives in up to two legs, to a free place and then to the goal, and chooses again when it has come there, or sees"
    " something new in its way. It keeps its points in the frame of the odometry, so slippers that are beside the robot or too near for"
    " the camera are still there. Rounded to 5 cm, many points of many looks are the same, and are stored once: so it forgets"
    " nothing, and a step takes a few milliseconds. After the goal, it drives to places with a long free way behind them.",
    another_way="You can also keep the points in a grid, and search the shortest way through its free cells (Dijkstra's algorithm).",
)


def past_something_low(rng, kind=None):
    """A scenario: a furnished room, in which slippers or blocks are between the robot and its goal.

    A detour of a fixed shape touches something. There is room on ways of two straight legs, which all begin to the
    left, or to the right, or at least 60 degrees beside the goal. Places are complex numbers, the goal is 2.2.
    """
    from imgproc_course.simulation import furnished

    shares = np.linspace(0, 1, 25)

    def legs(places):
        return np.concatenate([[*(shares * place), *(place + shares * (2.2 - place))] for place in places])

    places = np.outer((0.6, 0.8, 1.0, 1.2), np.exp(1j * np.radians(np.arange(-165, 181, 15)))).ravel()
    detours, ways = legs(1.1 + 1j * np.array([-0.8, -0.65, -0.5, 0, 0.5, 0.65, 0.8])), legs(places)
    sides = np.angle(places)
    kinds = {"left": sides > 0, "right": sides < 0, "beside": abs(sides) > 1}
    is_right = kinds[kind or ("left", "right", "beside")[int(rng.integers(3))]]
    while True:
        number = int(rng.integers(1, 100_000))
        room = furnished(number)
        metres, (low_x, low_y) = room.free_space.metres, room.free_space.origin

        def nearest(points):
            row, col = (points.imag - low_y) / room.free_space.cell, (points.real - low_x) / room.free_space.cell
            return metres[row.astype(int).clip(0, len(metres) - 1), col.astype(int).clip(0, len(metres[0]) - 1)]

        def least(path):
            return nearest(start + ahead * path).reshape(len(start), len(path) // 50, 50).min(2)

        things = [complex(*room.places[name][:2]) for name in ("slippers", "blocks")]
        ahead = np.exp(1j * rng.uniform(-math.pi, math.pi, (4000, 1)))
        before = rng.uniform(0.9, 1.3, (4000, 1)) + 1j * rng.uniform(-0.2, 0.2, (4000, 1))
        start = rng.choice(things, (4000, 1)) - before * ahead
        fits = (nearest(start) > 0.55) & (nearest(start + 2.2 * ahead) > 0.6)
        start, ahead = start[fits][:, np.newaxis], ahead[fits][:, np.newaxis]
        fits = (least(detours) < 0.2).all(1)
        start, ahead = start[fits], ahead[fits]
        free = least(ways) > 0.42
        for k in np.flatnonzero((free & is_right).any(1) & ~(free & ~is_right).any(1))[:1]:
            begin, goal = start[k, 0], start[k, 0] + 2.2 * ahead[k, 0]
            return {"seed": int(rng.integers(1 << 31)), "room": number, "duration": 40.0,
                    "start": [*np.round([begin.real, begin.imag, np.angle(ahead[k, 0])], 3).tolist()],
                    "goal": [*np.round([goal.real, goal.imag], 3).tolist(), 0.6],
                    "thresholds": {"bumps": ["<=", 0], "clearance": [">=", 0.08], "goal_time": ["<=", 20], "places": [">=", 10]}}


# %% role="answer"
def control(observation, memory):
    return 0.2, 0.0  # your turn: this robot drives straight ahead, whatever it sees

# %% role="solution"
def control(observation, memory):
    x, y, yaw = observation["odometry"]
    c, s = math.cos(yaw), math.sin(yaw)
    to_room = np.array([[c, s], [-s, c]])
    seen = obstacles(observation) @ to_room + (x, y)
    known = np.concatenate([memory.get("known", seen), seen])
    known = memory["known"] = np.unique((20 * known).round() / 20, axis=0)
    points = (known - (x, y)) @ to_room.T

    def is_free(begin, end, width):
        way = np.subtract(end, begin)
        return free_way(points - begin, math.atan2(way[1], way[0]), width) > math.hypot(*way) - 0.08

    def turn(place):
        return math.atan2(place[1], place[0])

    def length(place):
        return math.hypot(*place) + math.dist(place, goal) + 0.3 * abs(turn(place))

    def onward(place):
        return min(free_way(points, turn(place)), 3.0) + is_free((0, 0), place, 0.64) - 0.5 * abs(turn(place))

    def way_to_goal():
        for width in (0.64, 0.56):
            if is_free((0, 0), goal, width):
                return goal
            firsts = [place for place in around if is_free((0, 0), place, width)]
            ways = [place for place in firsts if is_free(place, goal, width)]
            if ways:
                return min(ways, key=length)
        return min(firsts or around, key=length)

    around = [(r * math.cos(a), r * math.sin(a)) for r in (0.5, 0.7, 0.9, 1.1, 1.3) for a in np.radians(np.arange(-165, 181, 15))]
    goal = to_room @ np.subtract((2.2, 0.0), (x, y))
    memory["is_there"] = memory.get("is_there") or math.hypot(*goal) < 0.5
    aim = to_room @ np.subtract(memory.get("aim", (x, y)), (x, y))
    if math.hypot(*aim) < 0.15 or not is_free((0, 0), aim, 0.5):
        aim = max(around, key=onward) if memory["is_there"] else way_to_goal()
        memory["aim"] = aim @ to_room + (x, y)
    if abs(turn(aim)) > 0.2:
        return 0.0, min(max(2 * turn(aim), -1.0), 1.0)
    return 0.3, 1.5 * turn(aim)

# %% role="check" tags=["long"]
check("obstacles-drive", control)

# %% role="case" title="a way on the left" points=1
def inputs(rng):
    return (past_something_low(rng, "left"),)


# %% role="case" title="a way on the right" points=1
def inputs(rng):
    return (past_something_low(rng, "right"),)


# %% role="case" title="a way that begins beside the goal" points=1
def inputs(rng):
    return (past_something_low(rng, "beside"),)


# %% role="hidden" title="an unseen room" points=2
def inputs(rng):
    return (past_something_low(rng),)


# %% role="hidden" title="a second unseen room" points=2
def inputs(rng):
    return (past_something_low(rng),)


# %% role="hidden" title="a third unseen room" points=2
def inputs(rng):
    return (past_something_low(rng),)


# %% role="hidden" title="a fourth unseen room" points=2
def inputs(rng):
    return (past_something_low(rng),)


# %% [markdown]
# ### The same function in ROS
#
# This node makes the observation of three topics, calls `control` with each depth image, and publishes the two speeds.

# %% tags=["long"]
if ros_available():
    from geometry_msgs.msg import Twist
    from imgproc_course.messages import image_to_array
    from nav_msgs.msg import Odometry
    from rclpy.node import Node
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import Image, LaserScan

    class ControlNode(Node):
        def __init__(self, control, context=None):
            super().__init__("control", context=context)
            self.control, self.memory, self.seen, self.begin = control, {}, {}, None
            self.commands = self.create_publisher(
                Twist, "/kachaka/manual_control/cmd_vel", qos_profile_sensor_data)
            for kind, topic in ((LaserScan, "lidar/scan"), (Odometry, "odometry/odometry"),
                                (Image, "front_camera/depth")):
                self.create_subscription(
                    kind, f"/kachaka/{topic}", self.on_message, qos_profile_sensor_data)

        def on_message(self, msg):
            self.seen[type(msg)] = msg
            if isinstance(msg, Image) and len(self.seen) == 3:
                linear, angular = self.control(self.observation(), self.memory)
                command = Twist()
                command.linear.x, command.angular.z = float(linear), float(angular)
                self.commands.publish(command)

        def observation(self):
            depth, scan, pose = self.seen[Image], self.seen[LaserScan], self.seen[Odometry].pose.pose
            stamp = depth.header.stamp.sec + depth.header.stamp.nanosec / 1e9
            self.begin = self.begin or stamp
            yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
            return {"depth": image_to_array(depth)[2::4, 2::4],  # each fourth pixel: 160 columns
                    "scan": np.roll(scan.ranges, -90).astype(np.float32),  # straight ahead is ray 90
                    "odometry": np.array([pose.position.x, pose.position.y, yaw]),
                    "time": stamp - self.begin}

# %% [markdown]
# Write 40 in place of 0, and run both cells. Here a person walks and a toy car drives, so a bump is possible.

# %%
live_seconds = 0  # such as 40

# %%
if ros_available() and live_seconds:
    camera = open_camera("room", room=19, rate=10)
    live_view(camera)
    Robot().restart(start=(0.57, 1.43, -0.19))
    session = RosSession.current()
    node = session.add_node(ControlNode(control, context=session.context))
    time.sleep(live_seconds)
    session.remove_node(node)
    print("bumps:", camera.bumps)
    camera.stop()

# %% [markdown]
# ## Recap
#
# A pixel, its depth and the numbers of the lens give a point. RANSAC finds the floor although most points are something else. What stands on it, in the corridor, decides whether the robot may drive on. It must brake early enough for its speed, and stand when no data come.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | depth image, `16UC1` | (360, 640) | uint16 | 0 to 65,535; 0 is no depth | millimetre |
# | rays | (360, 640, 3) | float64 | x −1.11 to 1.11, y −0.63 to 0.63, 1 | metre at a depth of 1 m |
# | *points* | (360, 640, 3) | float64 | | metre: right, down, ahead |
# | plane of the floor | normal (3,), offset | float64 | 1 long | metre |
# | inliers, obstacles | (N,), (360, 640) | bool | False, True | no and yes |
# | nearest obstacle | one number | float | 0 to infinity | metre |
# | scan | (8,) | float64 | 0 to infinity | metre |
# | command, `linear.x` | one number | float | 0 or 0.2 | m/s |
#
# **Next:** [[object_tracking]]. First choose **File → Close and Shut Down Notebook**: it frees the robot.

# %%
# Check: the numbers in the table
assert rays.shape == points.shape == (360, 640, 3) and few.shape == (8,)
assert np.abs(rays[..., 0]).max().round(2) == 1.11 and np.abs(rays[..., 1]).max().round(2) == 0.63
