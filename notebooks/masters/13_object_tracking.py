# ---
# jupyter:
#   imgproc_course:
#     title: Object tracking
# ---

# %% [markdown]
# # Object tracking
#
# To detect an object in one frame is one thing. To know that it is *the same object* in the next frame is another: this is [[term:tracking]]. In this lesson you track a red ball through the recorded drive, while a red toy car drives past it. At the end, the robot follows the ball.
#
# **You will be able to**
# - measure how well two boxes agree (IoU),
# - find the pixels that have the colour of an object (back-projection),
# - say how uncertain several numbers are together (covariance),
# - combine what you expect and what you measure, with a Kalman filter,
# - keep two objects apart that look the same, by joint assignment,
# - let a robot follow a ball,
# - deeper: write this as a node, and drive after a ball with the image alone.
#
# **Time** [[minutes]], with a pause after section 3. **You need** [[obstacles_ahead]]. Matrices are explained here. Only the last part of section 6 needs ROS 2.

# %% role="given" exercise=["tracking-iou", "tracking-predict", "tracking-update", "tracking-drive"]
import math

import numpy as np

# %%
import time

import cv2
from matplotlib.figure import Figure
from scipy.optimize import linear_sum_assignment

from imgproc_course.display import show, show_figure
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.geometry import CameraModel, Pose
from imgproc_course.recording import open_recording
from imgproc_course.ros import Robot, RosSession, open_camera, ros_available
from imgproc_course.simulation import Simulation

recording = open_recording("drive")

# %% role="texts"
figure_texts = {
    "task": (
        "The task: the white box is around the ball in the first frame. Where is the ball in all the other frames?",
        "Two frames of the living room. Left, a red and white ball, far away, in a small white box. Right, the ball is near and large, and a red toy car is beside it.",
    ),
    "weights": (
        "The back-projection: bright pixels have the colours of the ball.",
        "Left, the room with the ball; right, the same image in black, with bright spots on the ball, the toy car, the rug and some books.",
    ),
    "merged": (
        "Frame 46: the car is in front of the ball. Both together are one red spot.",
        "Left, the toy car covers a part of the ball; right, one single white spot over both.",
    ),
    "paths": (
        "The floor from above, as the robot sees it (ahead is up, and drawn larger): the true paths of ball and car (gray), and the track of the ball.",
        "A map with two gray paths. The red track leaves the path of the ball at its end, and crosses the path of the car; the dashed blue track, of the joint assignment, stays at the ball.",
    ),
    "live": (
        "What the node saw last.",
        "The ball on the floor of the living room, in front of the robot.",
    ),
    "rolling": (
        "One of the two balls rolls: half a second later it is in other columns.",
        "Twice the same view of the room with two red and white balls. The near one is at the same place; the other one, right of it, has moved a little to the right and away.",
    ),
    "follow": (
        "The robot follows the ball: its first and its last frame.",
        "Left, the ball is far away, a little left of the middle; right, it is near, a little right of the middle.",
    ),
}

# %% [markdown]
# ## 1 · Two boxes ([[minutes]])
#
# We work with every second row and column of each frame: 360 × 640 pixels, the size of the depth image. From the labels of the recording, OpenCV's `boundingRect` gives the true [[term:bounding box]] of the ball, as (col, row, width, height).

# %%
frames = [recording.frame(k)[::2, ::2].copy() for k in range(90)]
true_boxes = []
for k in range(90):
    is_ball = recording.labels(k)[::2, ::2] == 9  # 9 is the ball
    true_boxes.append(cv2.boundingRect(is_ball.astype(np.uint8)))
print("first", true_boxes[0], "  last", true_boxes[89])

# %%
def with_box(frame, box, colour=(255, 255, 255)):
    col, row, width, height = box
    return cv2.rectangle(frame.copy(), (col - 2, row - 2),
                         (col + width + 1, row + height + 1), colour, 2)


show([with_box(frames[0], true_boxes[0]), frames[60]], ["frame 0", "frame 60"],
     text="object_tracking/task")

# %% [markdown]
# How good is the box of a tracker? You know the *IoU* (intersection over union) of two masks from [[obstacles_ahead#5]]. For two boxes it is the area that both cover, divided by the area that at least one covers: 1 for equal boxes, and 0 for boxes that do not touch.
#
# Two boxes of 10 × 10 pixels; the second is 5 columns to the right of the first. **Predict** their IoU, in percent.

# %% role="predict"
guess_iou = None  # your guess: how many percent?

# %%
first, second = np.zeros((20, 20), bool), np.zeros((20, 20), bool)
first[5:15, 2:12] = True
second[5:15, 7:17] = True
both, either = (first & second).sum(), (first | second).sum()
print("both", both, "  at least one", either)
compare_guess(guess_iou, round(100 * both / either), "%")

# %% [markdown]
# It is not 50 %: the union is larger than one box. Without masks, you compute the same from a few numbers. On a line, the part that two pieces have in common goes from the **larger start** to the **smaller end**:

# %%
start_a, end_a = 2, 12
for start_b, end_b in [(7, 17), (4, 9), (15, 20)]:
    common = min(end_a, end_b) - max(start_a, start_b)
    print((start_b, end_b), "common:", common)

# %%
# Check: the numbers in this section
assert (both, either) == (50, 150) and common == -3
assert true_boxes[0] == (258, 175, 31, 31) and true_boxes[89] == (194, 153, 188, 189)

# %% [markdown]
# The last pair does not touch, and the result is negative; the true length is 0 there. The intersection of two boxes is a rectangle: its width comes from the columns, its height from the rows. The union is both areas together, minus the intersection, which is counted twice.
#
# ### Your turn: IoU
#
# Write `iou(a, b)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `a`, `b`: two boxes, each (col, row, width, height) with whole numbers; width and height are above 0 | float from 0 to 1: the area of the intersection divided by the area of the union | `iou((2, 5, 10, 10), (7, 5, 10, 10))` returns `0.333…` |

# %% role="exercise"
exercise(
    "tracking-iou",
    title="The IoU of two boxes",
    function="iou",
    tolerance=1e-6,
    hint="Intersection: common width times common height, none of them below 0; the common width is the smaller end minus the larger start. Union: both areas minus the intersection.",
    hints=(
        "Where does the common part of two boxes start and end, in columns and in rows? What if they do not touch?",
        "1. The common width: the smaller right end minus the larger left start; if it is negative, 0.\n"
        "2. The common height: the same with the rows.\n"
        "3. The intersection: width times height.\n"
        "4. The union: the area of a, plus the area of b, minus the intersection.",
        "width = min(a[0] + a[2], ...) - max(a[0], ...)\nheight = ...\nboth = max(width, 0) * max(...)\n"
        "return both / (a[2] * a[3] + ... - both)",
    ),
    explanation="Columns and rows are two separate questions on a line. max(..., 0) is needed for each of them: two negative"
    " numbers would give a positive product. The intersection lies in both boxes, so the sum of the areas counts it twice.",
    another_way="You can also draw both boxes into masks, and divide (a & b).sum() by (a | b).sum(); this is slower.",
)


def random_box(rng, low=5, high=40):
    col, row = rng.integers(0, 30, 2)
    width, height = rng.integers(low, high, 2)
    return int(col), int(row), int(width), int(height) + 1


# %% role="answer"
def iou(a, b):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def iou(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% role="check"
check("tracking-iou", iou)

# %% role="case" title="boxes that overlap" points=1
def inputs(rng):
    shift = int(rng.integers(2, 7))
    col, row, width, height = random_box(rng)
    return [((2, 5, 10, 10), (7, 5, 10, 10)), ((20, 10, 30, 12), (20 + shift, 14, 18, 25)), ((3, 4, 20, 30), (8, 9, 5, 6)), ((300, 250, 60, 40), (330, 240, 50, 20)),
            ((col, row, width, height), (col + 3, row + 2, *random_box(rng)[2:]))]


# %% role="case" title="boxes that do not touch" points=1 hint="If the common width or height is negative, it counts as 0: use max(..., 0) for each of them."
def inputs(rng):
    far = int(rng.integers(30, 60))
    return [((2, 5, 10, 10), (far, 6, 10, 9)), ((0, 0, 10, 20), (3, far, 8, 10)), ((1, 2, 8, 9), (far, far, 12, 7)), ((5, 6, 9, 8), (7, 3, 6, far))]


# %% role="hidden" title="any boxes" points=1 hint="Is the union the sum of both areas, minus the intersection?"
def inputs(rng):
    return [(random_box(rng), random_box(rng)) for _ in range(5)] + [((0, 0, 4, 5), (4 + int(rng.integers(1, 9)), 20, 6, 7))]


# %% [markdown]
# ## 2 · The colours of the ball ([[minutes]])
#
# What distinguishes the ball? Its [[term:hue]]: red, in sun and in shade. In OpenCV's HSV images, the hue is from 0 to 179 (see [[canny_stages#4]]), and red is near 0. The white parts of the ball have no colour: their *[[term:saturation]]* is low. So we count the hues inside the box of the first frame, but only where the saturation is above 140:

# %%
hsv_frames = [cv2.cvtColor(frame, cv2.COLOR_BGR2HSV) for frame in frames]
col, row, width, height = true_boxes[0]
patch = hsv_frames[0][row:row + height, col:col + width]
hues = patch[patch[:, :, 1] > 140][:, 0]
histogram = np.bincount(hues // 10, minlength=18)  # 18 bins of 10 hues
weights = (255 * histogram / histogram.max()).astype(np.uint8)
print(len(hues), "pixels of", patch[:, :, 0].size)
print(weights)

# %% [markdown]
# The result is a *[[term:histogram]]* with 18 *bins*: 18 numbers, each for 10 hues. We scale it so that the largest number is 255, and call the numbers *weights*. Only the hues 0 to 19 have a weight.
#
# Now we go back from the histogram to an image: each pixel gets the weight of its hue. This is the *[[term:back-projection]]*. A bright pixel means: many pixels of the ball have this colour. With an array of bins as an index, NumPy looks all of them up at once:

# %%
few_hues = np.array([[0, 9, 10], [19, 20, 179]])
print(few_hues // 10)
print(weights[few_hues // 10])

# %% [markdown]
# We do this with a whole frame, again only where the saturation is above 140. (OpenCV has it as `calcBackProject`.)

# %%
def ball_weights(hsv):
    """The back-projection of the ball's colours, (360, 640) uint8."""
    return np.where(hsv[:, :, 1] > 140, weights[hsv[:, :, 0] // 10], 0)


show([frames[40], ball_weights(hsv_frames[40])], ["frame 40", "back-projection"],
     text="object_tracking/weights")

# %% [markdown]
# The ball is bright. But so are the toy car, the chair, the pattern of the rug, and a few books.

# %%
# Check: the numbers, and OpenCV has the same weights
assert weights[:2].min() > 0 and weights[2:].max() == 0 and (few_hues // 10).tolist() == [[0, 0, 1], [1, 2, 17]]
scaled = weights.astype(np.float32).reshape(-1, 1)
by_opencv = cv2.calcBackProject([hsv_frames[40]], [0], scaled, [0, 180], 1)
assert (np.where(hsv_frames[40][:, :, 1] > 140, by_opencv, 0) == ball_weights(hsv_frames[40])).all()
assert ball_weights(hsv_frames[40]).dtype == np.uint8

# %% [markdown]
# ## 3 · Places on the floor ([[minutes]])
#
# As the robot drives nearer, the ball grows from 31 to 189 pixels in the image. In the room, its size does not change. So we track where things are on the **floor**, in metres.
#
# You need three things: the pixel, its depth, and the [[term:pose]] of the camera. Pixel and depth give a point in front of the camera, as in [[obstacles_ahead#2]]. The pose takes it into the room: `pose.apply(point)` gives x, y and z in metres, where z is the height above the floor.

# %%
info = recording.camera_info
camera = CameraModel(info.width, info.height, info.k[0], info.k[4],
                     info.k[2], info.k[5], tuple(info.d)).every(2)
pose = Pose.from_vector(recording.pose("camera", 20))
col, row, width, height = true_boxes[20]
center_col, center_row = col + width // 2, row + height // 2
ray = camera.unproject((center_col, center_row))
z = recording.depth(20)[center_row, center_col] / 1000
print("in front of the camera:", (ray * z).round(2))
print("in the room:           ", pose.apply(ray * z).round(2))
print("true middle of the ball", recording.pose("ball", 20)[:3].round(2))

# %% [markdown]
# The depth shows the *front* of the ball; its middle is 11 cm behind it.
#
# And without a depth image, as on the real robot? We know that the ball is 0.22 m wide, and a ball that is twice as far looks half as wide. So its width gives its depth:

# %%
depth_of_width = camera.fx * 0.22 / width
middle = pose.apply(ray * depth_of_width)
width_error = math.dist(middle[:2], recording.pose("ball", 20)[:2])
print("distance from the true place:", round(100 * width_error), "cm")

# %% [markdown]
# The depth image needs no such knowledge. With it, we find all red things on the floor:
#
# 1. [[term:connected component|Connected]] pixels with a weight of at least 128 form a spot. Spots of fewer than 15 pixels are left out.
# 2. The depth of a spot is the [[term:median]] of its pixels, and its ray goes through its middle.
# 3. Ball and car are 3 to 25 cm above the floor and nearer than 3.5 m. This leaves out the rug, the books and the sofa.
# 4. The middle of a thing is about 8 cm behind its front.
# 5. The largest thing comes first. Its real size is about pixels · depth².

# %% tags=["long"]
def find_red(hsv, depth, camera, pose):
    """The places (x, y) of red things on the floor, in metres, largest first."""
    red = (ball_weights(hsv) >= 128).astype(np.uint8)
    count, numbers, stats, centers = cv2.connectedComponentsWithStats(red)
    things = []
    for number in range(1, count):  # 0 is the background
        pixels = stats[number, cv2.CC_STAT_AREA]
        if pixels < 15:
            continue
        z = np.median(depth[numbers == number]) / 1000
        ray = camera.unproject(centers[number])
        if z < 3.5 and 0.03 < pose.apply(ray * z)[2] < 0.25:
            x, y, _ = pose.apply(ray * (z + 0.08))
            things.append((pixels * z**2, x, y))
    things.sort(reverse=True)
    return np.array([(x, y) for _, x, y in things]).reshape(-1, 2)

# %%
poses = [Pose.from_vector(recording.pose("camera", k)) for k in range(90)]
places = [find_red(hsv_frames[k], recording.depth(k), camera, poses[k])
          for k in range(90)]
true_ball = np.array([recording.pose("ball", k)[:2] for k in range(90)])
true_car = np.array([recording.pose("toycar", k)[:2] for k in range(90)])
print("found in frame 20:", places[20].round(2).tolist())
print("ball", true_ball[20].round(2), "  car", true_car[20].round(2))

# %% [markdown]
# In 75 of the 90 frames, something red is found less than 5 cm from the ball. In some frames the error is larger: when the car drives past the ball, both together are **one** spot.

# %%
red = ball_weights(hsv_frames[46]) >= 128
show([frames[46], red], ["frame 46", "red"], rows=(130, 280), cols=(130, 400),
     text="object_tracking/merged")

# %%
# Check: the numbers in this section
distances = [100 * np.linalg.norm(places[k] - true_ball[k], axis=1).min() for k in range(90)]
assert round(100 * width_error) == 1 and sum(distance < 5 for distance in distances) == 75

# %% [markdown]
# **Pause?** Afterwards choose **Run → Run All Above Selected Cell**.
#
# ## 4 · The Kalman filter ([[minutes]])
#
# We know two things about the ball: where it should be now, from its last place and speed, and where we see it now. Both are uncertain. How do we combine them? First we need a number for "uncertain".
#
# ### The doubt of one number
#
# A sensor measures the same distance four times. The *mean* is the best answer. How far a number is from the mean is its *deviation*. The mean of the **squared** deviations is the *[[term:variance]]*, and its root is the [[term:standard deviation]] σ: the typical error of **one** measurement.

# %%
few = np.array([5.0, 5.2, 4.9, 5.3])  # metres
deviations = few - few.mean()
variance = (deviations**2).sum() / 4
print("mean", few.mean().round(2), "m   deviations", deviations.round(2), "m")
print("variance", variance.round(4), "m²   σ", round(math.sqrt(variance), 3), "m")

# %% [markdown]
# (Without the squares, the deviations would always add up to 0.)
#
# Now two numbers with different doubt. The ball should be at 2.00 m, with σ = 0.1 m. We measure 2.40 m, with σ = 0.2 m. The variances are 0.01 and 0.04. The best answer is a mean in which each number has the *weight* 1 / variance: no other mix has a smaller variance. In tracking, one writes it with the share of the measurement, the *gain*: how far we go from the expected place towards the measured place.
#
# $$\text{gain} = \frac{\text{variance of the prediction}}{\text{variance of the prediction} + \text{variance of the measurement}}$$
#
# **Predict** the combined place.

# %% role="predict"
guess_place = None  # your guess: how many metres?

# %%
expected, expected_variance = 2.00, 0.1**2
measured, measured_variance = 2.40, 0.2**2
gain = expected_variance / (expected_variance + measured_variance)
combined = expected + gain * (measured - expected)
combined_variance = (1 - gain) * expected_variance
print("gain", round(gain, 2), "  variance", round(combined_variance, 4))
compare_guess(guess_place, round(combined, 2), "m")

# %% [markdown]
# The result lies nearer to the more certain number, and it is more certain than both: its variance is 0.008. So a bad measurement still helps.
#
# ### Numbers that belong together ([[minutes]])
#
# The *[[term:Kalman filter]]* does this for several numbers together, its *[[term:state]]*. For a ball on a line these are its place and its speed. Four balls, and what a tracker says of each:

# %%
balls = np.array([[0.0, 0.1], [0.2, 0.3], [0.1, 0.1], [0.5, 0.7]])  # m, m/s
d = balls - balls.mean(axis=0)  # axis=0: the mean of each column
print(d.round(2))
print("variance of the place", (d[:, 0] * d[:, 0]).mean().round(3))
print("variance of the speed", (d[:, 1] * d[:, 1]).mean().round(3))
print("covariance           ", (d[:, 0] * d[:, 1]).mean().round(3))

# %% [markdown]
# The *[[term:covariance]]* is the mean of deviation **times** deviation, of two different numbers. Here a ball that is farther than the mean is also faster: most products are positive, and so is their mean. If one number says nothing about the other, the covariance is 0.
#
# To compute with all of them at once, we need a *[[term:matrix]]*: a table of numbers with rows and columns. `@` multiplies two of them. The number in row i and column j of the product comes from **row i of the first** and **column j of the second** matrix: multiply them number by number, and add up.

# %%
M, N = np.array([[1, 2], [3, 4]]), np.array([[5, 6], [7, 8]])
print(M @ N)
print("row 0 with column 0:", 1 * 5 + 2 * 7, "  row 1 with column 0:", 3 * 5 + 4 * 7)
print("M times a vector:", M @ np.array([5, 7]))  # as if it was one column
print("M.T\n", M.T)

# %% [markdown]
# The order counts: `N @ M` is another matrix. `M.T` is M *transposed*: its rows are the columns of M (in formulas Mᵀ).
#
# Row i of `d.T` holds all deviations of the number i, and column j of `d` those of the number j. So `d.T @ d` multiplies them and adds up. Divided by the number of balls, this is the *covariance matrix* C: the variances on its diagonal, and the covariance beside it, twice. (NumPy: `np.cov(balls.T, bias=True)`.)

# %%
C = d.T @ d / len(d)
print(C.round(3))

# %%
# Check: the numbers of the variances and matrices
assert few.mean() == 5.1 and round(variance, 4) == 0.025 == round(few.var(), 4) and abs(deviations.sum()) < 1e-9
shares = np.linspace(0, 1, 101)  # of the measurement: the gain has the smallest variance
assert shares[((1 - shares)**2 * expected_variance + shares**2 * measured_variance).argmin()] == round(gain, 2)
assert abs(combined - 2.08) < 1e-9 and abs(combined_variance - 0.008) < 1e-9
assert (d.prod(axis=1) > 0).sum() == 3 and (M @ N).tolist() == [[19, 22], [43, 50]] and (N @ M != M @ N).any()
assert np.allclose(C, np.cov(balls.T, bias=True)) and C.round(3).tolist() == [[0.035, 0.045], [0.045, 0.06]]

# %% [markdown]
# ### The doubt rolls on ([[minutes]])
#
# After one second, each of the four balls is at place + 1 s · speed, with the same speed. This is a product with a matrix F: its first row says place + 1 · speed, its second one says speed.
#
# The variances of place and speed are 0.035 and 0.060. **Predict** the variance of the place after this second, in m².

# %% role="predict"
guess_variance = None  # your guess: how many m²?

# %%
F = np.array([[1.0, 1.0], [0.0, 1.0]])
after = d @ F.T  # F @ row, for each row
compare_guess(guess_variance, (after[:, 0]**2).mean().round(3), "m²")

# %% [markdown]
# If both errors were independent, their variances would be added: 0.095. But they belong together: the mean of (d_place + d_speed)² is variance + 2 · covariance + variance, so 0.035 + 2 · 0.045 + 0.06.
#
# A tracker has no four balls, only the matrix C. Each number of C is a mean of deviation times deviation, and F moves **both**. So F stands twice, on the left, and transposed on the right.

# %%
print("of the moved balls\n", (after.T @ after / len(after)).round(3))
print("F @ C @ F.T\n", (F @ C @ F.T).round(3))

# %% [markdown]
# Now one frame of our ball: dt = 0.1 s, so the new place is place + 0.1 · speed.

# %%
F = np.array([[1, 0.1], [0, 1]])
state = np.array([2.0, 0.5])  # 2 m, 0.5 m/s
C = np.array([[0.01, 0], [0, 0.25]])
Q = np.array([[0.0001, 0], [0, 0.01]])
print("state", (F @ state).round(4))
print((F @ C @ F.T + Q).round(4))

# %% [markdown]
# The place is now 2.05 m, and it is less certain: 0.0126 in place of 0.01, because the speed is not certain. The 0.025 beside the diagonal says: if the ball is farther than expected, it is probably also faster. *Q* adds what F does not know: the ball may become faster or slower.
#
# ### Your turn: predict
#
# Write `predict(state, covariance, F, Q)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `state`: (n,) float; `covariance`, `F`, `Q`: (n, n) float | two arrays: the predicted state (n,), and its covariance (n, n) | `predict(state, C, F, Q)` with the numbers above returns `[2.05, 0.5]` and `[[0.0126, 0.025], [0.025, 0.26]]` |

# %% role="exercise"
exercise(
    "tracking-predict",
    title="Kalman filter: predict",
    function="predict",
    tolerance=1e-9,
    hint="The state is F @ state, the covariance is F @ covariance @ F.T + Q.",
    hints=(
        "Which matrix moves the state on by one frame, and on which two sides of the covariance must it stand?",
        "1. The new state: F times the state, with @.\n"
        "2. The new covariance: F times the covariance times F transposed, plus Q.\n"
        "3. Return both, the state first.",
        "return F @ state, F @ ... @ F.T + ...",
    ),
    explanation="A covariance has two axes, and F changes both: once from the left for its rows, once transposed from the"
    " right for its columns. Q makes the state less certain with every frame that passes without a measurement.",
    another_way="You can also write np.dot(F, state) and F.dot(covariance).dot(F.T) + Q.",
)


def motion(dt):
    matrix = np.eye(4)
    matrix[0, 2] = matrix[1, 3] = dt
    return matrix


def random_covariance(rng, size, scale=1.0):
    """Symmetric and positive: rounded, with a strong diagonal."""
    part = rng.uniform(-0.1, 0.1, (size, size)).round(3)
    return scale * (np.diag(rng.uniform(0.5, 1.5, size).round(3)) + part + part.T)

# %% role="answer"
def predict(state, covariance, F, Q):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance @ F.T + Q


# %% role="check"
check("tracking-predict", predict)

# %% role="case" title="place and speed on a line" points=1
def inputs(rng):
    F = np.array([[1, 0.1], [0, 1]])
    return [(np.array([2.0, 0.5]), np.array([[0.01, 0], [0, 0.25]]), F, np.array([[0.0001, 0], [0, 0.01]])),
            (rng.uniform(-2, 2, 2).round(2), random_covariance(rng, 2), F, random_covariance(rng, 2, 0.1))]


# %% role="case" title="place and speed on the floor" points=1 hint="The state is F @ state, whatever its size. In the covariance F stands on the left side, and F.T on the right."
def inputs(rng):
    return [(rng.uniform(-2, 2, 4).round(2), random_covariance(rng, 4), motion(dt), random_covariance(rng, 4, 0.1))
            for dt in (0.1, 0.25)]


# %% role="hidden" title="any matrices" points=1 hint="F @ covariance @ F.T + Q"
def inputs(rng):
    sizes = (2, 3, 4)
    return [(rng.uniform(-2, 2, n).round(2), random_covariance(rng, n), rng.uniform(-1, 1, (n, n)).round(2),
             random_covariance(rng, n, 0.2)) for n in sizes]


# %% [markdown]
# **With the measurement**, we do the same as with one number. The matrix H says what we measure: here only the place, the first number of the state. The measured number minus the expected one is the *innovation*. *R* is the variance of the measurement. The *[[term:inverse]]* matrix, `np.linalg.inv(S)`, takes the place of a division: multiplied with S, it gives the *identity matrix*, with 1 on the diagonal and 0 beside it.

# %%
state, C = F @ state, F @ C @ F.T + Q  # one step on: run this cell once
H = np.array([[1.0, 0.0]])
R = np.array([[0.01]])
S = H @ C @ H.T + R  # variance of prediction and measurement together
gain = C @ H.T @ np.linalg.inv(S)
innovation = np.array([2.15]) - H @ state
print("S", S.round(4), "  gain", gain.ravel().round(3), "  innovation", innovation.round(3))
print("state", (state + gain @ innovation).round(3))

# %% [markdown]
# We measured only the place, but the speed was corrected too: from 0.5 m/s to 0.611 m/s. The ball was farther than expected, so it is probably faster. The covariance becomes smaller, as with one number: (1 − gain) · variance, where 1 is now the identity matrix, `np.eye(n)`, and the gain is `gain @ H`.
#
# OpenCV has the whole filter, `cv2.KalmanFilter`, with the steps `predict` and `correct`. With the same matrices it gives the same numbers. This one is for a thing on the floor:

# %% tags=["long"]
def new_filter(place, dt=0.1, push=0.3, error=0.03):
    """A Kalman filter for a thing on the floor: its state is x, y and both speeds.

    push: how much the speed may change, in m/s²; error: of a measurement, in m."""
    kalman = cv2.KalmanFilter(4, 2, 0, cv2.CV_64F)
    kalman.transitionMatrix = np.array(
        [[1, 0, dt, 0], [0, 1, 0, dt], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    kalman.measurementMatrix = np.eye(2, 4)
    per_push = np.array([[dt**2 / 2, 0], [0, dt**2 / 2], [dt, 0], [0, dt]])
    kalman.processNoiseCov = push**2 * per_push @ per_push.T
    kalman.measurementNoiseCov = error**2 * np.eye(2)
    kalman.statePost = np.array([[place[0]], [place[1]], [0.0], [0.0]])
    kalman.errorCovPost = np.diag([0.01, 0.01, 0.25, 0.25])
    return kalman

# %% tags=["long"]
# Check: the numbers, and OpenCV's filter has the same
assert np.allclose(after.T @ after / len(after), [[0.185, 0.105], [0.105, 0.06]]) and round(0.035 + 2 * 0.045 + 0.06, 3) == 0.185
assert round(gain[1, 0], 3) == 1.106 and C.round(4).tolist() == [[0.0126, 0.025], [0.025, 0.26]]
assert (state + gain @ innovation).round(3).tolist() == [2.106, 0.611]
kalman = new_filter([2.0, 1.0])
x, P, T = kalman.statePost.copy(), kalman.errorCovPost.copy(), kalman.transitionMatrix
for place in np.random.default_rng(0).normal(0, 1, (50, 2, 1)):
    x, P = T @ x, T @ P @ T.T + kalman.processNoiseCov
    G = P[:, :2] @ np.linalg.inv(P[:2, :2] + kalman.measurementNoiseCov)
    x, P = x + G @ (place - x[:2]), P - G @ P[:2]
    predicted = kalman.predict()
    assert np.abs(kalman.correct(place) - x).max() < 1e-9 and np.abs(kalman.errorCovPost - P).max() < 1e-9

# %% [markdown]
# ### Your turn: update
#
# Write `update(state, covariance, measurement, H, R)`. `np` is imported for you.
#
# | Input | Output | Example call |
# |---|---|---|
# | `state`: (n,) float; `covariance`: (n, n) float; `measurement`: (m,) float; `H`: (m, n) float; `R`: (m, m) float | two arrays: the corrected state (n,), and its covariance (n, n) | `update(state, C, np.array([2.15]), H, R)` with the numbers above returns about `[2.106, 0.611]` and `[[0.0056, 0.0111], [0.0111, 0.2323]]` |

# %% role="exercise"
exercise(
    "tracking-update",
    title="Kalman filter: update",
    function="update",
    tolerance=1e-9,
    hint="S = H @ covariance @ H.T + R, gain = covariance @ H.T @ inv(S); state + gain @ (measurement - H @ state), and (identity - gain @ H) @ covariance.",
    hints=(
        "Which four lines did the example need, and what changes with n numbers in the state?",
        "1. S: the covariance, seen by H on both sides, plus R.\n"
        "2. The gain: covariance times H transposed times the inverse of S.\n"
        "3. The new state: the state plus the gain times (measurement minus H times the state).\n"
        "4. The new covariance: (identity matrix minus gain times H) times the covariance.",
        "S = H @ covariance @ H.T + ...\ngain = covariance @ ... @ np.linalg.inv(...)\n"
        "state = state + gain @ (measurement - ...)\ncovariance = (np.eye(len(state)) - gain @ ...) @ covariance\n"
        "return state, covariance",
    ),
    explanation="H @ state is the measurement that we expect, and S its covariance together with the measurement's own. The gain"
    " weighs both, and it also corrects what was not measured, through the numbers beside the diagonal. After a measurement,"
    " the state is more certain: the covariance becomes smaller.",
    another_way="You can also write covariance - gain @ S @ gain.T, or use np.linalg.solve in place of the inverse.",
)


def random_covariance(rng, size, scale=1.0):
    """Symmetric and positive: rounded, with a strong diagonal."""
    part = rng.uniform(-0.15, 0.15, (size, size)).round(3)
    return scale * (np.diag(rng.uniform(0.6, 1.5, size).round(3)) + part + part.T)

# %% role="answer"
def update(state, covariance, measurement, H, R):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    state = state + gain @ (measurement - H @ state)
    covariance = (np.eye(len(state)) - gain @ H) @ covariance
    return state, covariance


# %% role="check"
check("tracking-update", update)

# %% role="case" title="place and speed on a line" points=1
def inputs(rng):
    H = np.array([[1.0, 0.0]])
    covariance = np.array([[0.0126, 0.025], [0.025, 0.26]])
    return [(np.array([2.05, 0.5]), covariance, np.array([2.15]), H, np.array([[0.01]])),
            (rng.uniform(-2, 2, 2).round(2), random_covariance(rng, 2), rng.uniform(-2, 2, 1).round(2), H, np.array([[0.25]]))]


# %% role="case" title="place and speed on the floor" points=1 hint="S is H @ covariance @ H.T + R, the gain is covariance @ H.T @ np.linalg.inv(S). The gain is multiplied by measurement - H @ state, and this is added to the state; np.eye(len(state)) - gain @ H is multiplied by the covariance."
def inputs(rng):
    return [(rng.uniform(-2, 2, 4).round(2), random_covariance(rng, 4), rng.uniform(-2, 2, 2).round(2), H,
             random_covariance(rng, 2, scale)) for scale, H in ((0.1, np.eye(2, 4)), (1.0, np.eye(2, 4, 2)))]


# %% role="hidden" title="any matrices" points=1 hint="Is each product in the right order?"
def inputs(rng):
    sizes = ((3, 1), (3, 2), (4, 2))
    return [(rng.uniform(-2, 2, n).round(2), random_covariance(rng, n), rng.uniform(-2, 2, m).round(2),
             rng.uniform(-1, 1, (m, n)).round(2), random_covariance(rng, m, 0.5)) for n, m in sizes]


# %% [markdown]
# ## 5 · Who is who? ([[minutes]])
#
# Two *tracks*, of ball and car, and in each frame several red things. Which thing belongs to which track?
#
# A distance in metres is not a good measure: 10 cm are much for a track that knows its place to 3 cm, and little for one that has not been seen for a second. So we divide by the uncertainty S: innovation · S⁻¹ · innovation is the squared distance in units of the expected error. (With one number it is innovation² / variance.) For two numbers with Gaussian noise, 1 % of the right pairs have more than 9.21. This is our *[[term:gate]]*: a pair beyond it is refused.

# %%
def costs_of(filters, places):
    """(tracks, things): the squared distances, in units of the expected error."""
    costs = np.zeros((len(filters), len(places)))
    for number, kalman in enumerate(filters):
        S = kalman.errorCovPre[:2, :2] + kalman.measurementNoiseCov
        innovation = places - kalman.statePre[:2].T
        weighted = innovation @ np.linalg.inv(S)
        costs[number] = (weighted * innovation).sum(axis=1)
    return costs

# %% [markdown]
# The simple rule: **each track takes the thing that is nearest to it**. The better rule: choose the pairs **together**, so that the sum of the costs is as small as possible, and no two tracks get the same thing. This is an *[[term:assignment]]* problem, and SciPy solves it:

# %%
example = np.array([[1.0, 8.0], [2.0, 99.0]])  # two tracks, two things
print("each for itself:", example.argmin(axis=1))
print("joint:          ", linear_sum_assignment(example)[1])

# %% [markdown]
# Each for itself, both tracks take thing 0. Jointly, track 0 takes thing 1: this costs 8 + 2, and the other choice 1 + 99.

# %% tags=["long"]
def for_itself(costs):
    if costs.size == 0:  # nothing red in this frame
        return []
    return list(enumerate(costs.argmin(axis=1)))


def jointly(costs):
    rows, things = linear_sum_assignment(np.minimum(costs, 100))
    return list(zip(rows, things, strict=True))


class Tracker:
    """A thing that is 0.5 m from all tracks begins one; 2 s without a thing end it."""

    def __init__(self, assign):
        self.assign = assign
        self.filters, self.misses, self.count = {}, {}, 0

    def step(self, places):
        if 0 not in self.filters:  # begin: the largest thing is track 0
            self.filters, self.misses, self.count = {}, {}, 0
        for place in places:
            if all(math.dist(place, self.place(number)) > 0.5 for number in self.filters):
                self.filters[self.count] = new_filter(place)
                self.misses[self.count] = 0
                self.count += 1
        numbers = list(self.filters)
        for number in numbers:
            self.filters[number].predict()
            self.misses[number] += 1
        costs = costs_of(self.filters.values(), places)
        for row, thing in self.assign(costs):
            if costs[row, thing] < 9.21:
                number = numbers[row]
                self.filters[number].correct(places[thing].reshape(2, 1))
                self.misses[number] = 0
        for number in numbers:
            if self.misses[number] > 20:
                del self.filters[number]

    def place(self, number):
        return self.filters[number].statePost[:2, 0].copy()

# %% [markdown]
# Without a thing inside its gate, a track is only predicted: it *coasts*. The ball is track 0 (the largest red thing), the car is track 1. First each track for itself. **Predict** how many centimetres the track of the ball is away from the ball in frame 60, after the car has driven past.

# %% role="predict"
guess_swap = None  # your guess: how many centimetres?

# %%
def run(assign):
    """The places of tracks 0 and 1 in frames 0 to 60, (61, 2, 2)."""
    tracker, path = Tracker(assign), []
    for k in range(61):
        tracker.step(places[k])
        path.append([tracker.place(0), tracker.place(1)])
    return np.array(path)


alone, joint = run(for_itself), run(jointly)
error_alone = 100 * math.dist(alone[60, 0], true_ball[60])
compare_guess(guess_swap, round(error_alone), "cm")

# %% tags=["long"]
print("joint:", round(100 * math.dist(joint[60, 0], true_ball[60])), "cm")
figure = Figure(figsize=(8, 3.6), layout="constrained")
axes = figure.subplots()
for truth, name in ((true_ball, "ball"), (true_car, "car")):
    axes.plot(truth[:61, 1], truth[:61, 0], color="0.7", linewidth=6)
    axes.annotate(name, truth[60, ::-1])
for path, style, name in ((alone, "r", "each for itself"), (joint, "b--", "joint assignment")):
    axes.plot(path[:, 0, 1].round(3), path[:, 0, 0].round(3), style, label=name)
axes.set(xlabel="y (m), left", ylabel="x (m), ahead", xlim=(1, -1.5))
axes.legend(title="track of the ball")
show_figure(figure, text="object_tracking/paths")

# %%
# Check: the numbers in this section
truth = np.stack([true_ball, true_car], axis=1)[:61]
errors_alone, errors_joint = (100 * np.linalg.norm(path - truth, axis=2) for path in (alone, joint))
from_car = [100 * np.linalg.norm(path[:, 0] - true_car[:61], axis=1) for path in (alone, joint)]
assert round(errors_alone[60, 0]) == 44 and errors_alone[:, 0].max() == errors_alone[60, 0]
assert np.diff(from_car[0] < errors_alone[:, 0]).sum() == 1  # one identity switch
assert 1 < errors_joint[60, 0] < 1.45 and errors_joint.max() < 9 and (from_car[1] > errors_joint[:, 0]).all()
assert round(math.exp(-9.21 / 2), 3) == 0.01  # the share of right pairs beyond the gate
assert linear_sum_assignment(example)[1].tolist() == [1, 0]

# %% [markdown]
# While both are one spot, both tracks take it, and the track of the ball is pulled towards the car. Then nothing is inside its gate any more, and it drives on in the wrong direction, nearer to the car than to the ball: an *[[term:identity switch]]*. With **joint assignment**, only one track gets the spot, and the track of the ball coasts until it sees the ball again.
#
# ## 6 · Follow the ball ([[minutes]])
#
# Now the robot in the room follows the ball. It knows its own pose from odometry. The camera stands 0.21 m before the axle, 0.20 m above the floor, and looks ahead: its right is the robot's −y, its down is −z, its ahead is x. These are the columns of the rotation. `@` puts two poses together, the robot in the room and the camera on the robot; `inverse()` goes back, from the room to the robot.

# %% tags=["long"]
def camera_pose(robot_pose):
    ahead = np.array([[0.0, 0, 1], [-1, 0, 0], [0, -1, 0]])
    return robot_pose @ Pose(ahead, np.array([0.21, 0.0, 0.20]))


def command_to(place, robot_pose):
    """The speeds that keep the camera 0.8 m from a place on the floor."""
    x, y, _ = robot_pose.inverse().apply(np.array([*place, 0.0]))
    x = x - 0.21  # from the camera
    linear = min(max(math.hypot(x, y) - 0.8, -0.3), 0.3)
    angular = min(max(1.5 * math.atan2(y, x), -1.0), 1.0)
    return round(linear, 2), round(angular, 2)


def follow(tracker, frame, depth, camera, robot_pose):
    """One step: the command for the robot."""
    hsv = cv2.cvtColor(frame, cv2.COLOR_BGR2HSV)
    tracker.step(find_red(hsv, depth, camera, camera_pose(robot_pose)))
    if 0 not in tracker.filters:
        return 0.0, 0.4  # look for it
    return command_to(tracker.place(0), robot_pose)

# %% [markdown]
# We try it in the simulation, for 5 seconds. The robot sees the ball 1.7 m ahead, and the car drives through between them.

# %% tags=["long"]
robot = Simulation(seed=1, start=(0.7, 0.2, 0.0), time=1.0)
tracker, images, kept = Tracker(jointly), [robot.frame()], []
for _ in range(50):
    counted = robot.odometry()
    robot_pose = Pose.planar(counted.x, counted.y, counted.yaw)
    linear, angular = follow(tracker, robot.frame(), robot.depth(),
                             robot.depth_camera(), robot_pose)
    robot.step(linear, angular, dt=0.1)
    kept.append(math.dist(robot.pose("ball")[:2], robot.pose("camera")[:2]))
images.append(robot.frame())
print("distances, one per second:", [round(value, 1) for value in kept[::10]], "m")

# %%
show(images, ["at the start", "after 5 s"], text="object_tracking/follow")

# %%
# Check: the robot kept its distance
assert round(kept[0], 1) == 1.7 and 0.77 < kept[-1] < 0.85 and not robot.bumped

# %% [markdown]
# ### The same in ROS ([[minutes]], deeper)
#
# The node sees only what the robot publishes: image, depth, camera info and odometry. It publishes the command, and the place of the ball as a `PoseStamped`, which RViz and Foxglove draw. Image and depth of one moment have the same stamp; the node waits until it has both.

# %% tags=["long"]
if ros_available():
    from geometry_msgs.msg import PoseStamped, Twist
    from imgproc_course.messages import image_to_array
    from nav_msgs.msg import Odometry
    from rclpy.node import Node
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import CameraInfo, Image

    class FollowNode(Node):
        def __init__(self, context=None):
            super().__init__("follow_ball", context=context)
            self.tracker = Tracker(jointly)
            self.camera = self.robot_pose = self.image = self.depth = None
            self.looks = 0
            base = "/kachaka/front_camera"
            for kind, topic, callback in (
                    (CameraInfo, f"{base}/camera_info", self.on_info),
                    (Odometry, "/kachaka/odometry/odometry", self.on_odometry),
                    (Image, f"{base}/image_raw", self.on_image),
                    (Image, f"{base}/depth", self.on_depth)):
                self.create_subscription(kind, topic, callback, qos_profile_sensor_data)
            self.balls = self.create_publisher(PoseStamped, "/ball", 10)
            self.commands = self.create_publisher(
                Twist, "/kachaka/manual_control/cmd_vel", qos_profile_sensor_data)

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
            command = Twist()
            command.linear.x, command.angular.z = follow(
                self.tracker, image_to_array(self.image, "bgr8"),
                image_to_array(self.depth), self.camera, self.robot_pose)
            self.commands.publish(command)
            if 0 in self.tracker.filters:
                ball = PoseStamped()
                ball.header.frame_id, ball.header.stamp = "odom", self.image.header.stamp
                x, y = self.tracker.place(0)
                ball.pose.position.x, ball.pose.position.y = float(x), float(y)
                ball.pose.position.z = 0.11
                self.balls.publish(ball)
            self.looks += 1

# %% tags=["nbval-ignore-output", "long"]
if ros_available():
    live_camera = open_camera("room", rate=10)
    Robot().restart(seed=1, start=(1.2, 0.2, 0.0))  # the ball begins to roll
    session = RosSession.current()
    node = session.add_node(FollowNode(context=session.context))
    end = time.monotonic() + 20
    while node.looks < 30 and time.monotonic() < end:
        time.sleep(0.1)
    session.remove_node(node)
    print("looks:", node.looks)
    if 0 in node.tracker.filters:
        way = math.dist(node.tracker.place(0), node.robot_pose.position[:2])
        print(f"from the axle to the ball: {way:.2f} m")
    live_camera.stop()
    show(image_to_array(node.image, "bgr8"), text="object_tracking/live")

# %%
# Check: the node looked
assert not ros_available() or node.looks > 0

# %% [markdown]
# **On the real robot**, the depth camera does not see the floor. So call `look` for each image alone, and let `find_red` compute the depth from the width of each spot, as in section 3. The camera is lower, too: 0.07 m above the floor, in `camera_pose`.
#
# **What you would start there**: the package `image_pipeline`. Its `image_proc` takes the distortion out of images, and `depth_image_proc` makes clouds of points of depth images, as you did with ray · depth.

# %% [markdown]
# ## 7 · Follow the ball that rolls away ([[minutes+20]], deeper)
#
# Here your function drives the robot with the image alone. **Several red balls lie in the room. The right one is the one that moves:** it rolls away in front of the robot, to the left or to the right, and slows down. Another ball lies nearer, and more in the middle of the image. The robot follows the ball that rolls, and keeps 0.6 m between the camera and the middle of this ball.
#
# Ten times per second, the robot calls your function `control(observation, memory)`. It returns two speeds, as for `robot.step`. One call may take 0.5 s, and 0.05 s of processor time on average. `memory` is an empty dict at the start, and keeps what you store in it. The *observation* is a dict, too:
#
# | key | value |
# |---|---|
# | `"image"` | (180, 320, 3) uint8 BGR: the image of the front camera |
# | `"time"` | float: seconds since the start |
#
# The function `red_spots` is given. It returns the boxes of the red spots. At this size of the image, the focal length is 176.25 pixels, and column 160 is straight ahead. The width of a box gives the distance, as in section 3. Which spot is the right ball? The robot stands still for half a second. What lies still stays in its columns:

# %% role="given" exercise="tracking-drive" tags=["long"]
import cv2


def red_spots(image):
    """Boxes (col, row, width, height) of the red spots in an image, the largest one first."""
    hue, saturation, value = cv2.split(cv2.cvtColor(image, cv2.COLOR_BGR2HSV))
    red = ((hue < 9) | (hue > 174)) & (saturation > 120) & (value > 60)
    # joins the red stripes of the ball, if they are near to each other
    joined = cv2.morphologyEx(red.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((9, 9)))
    count, _, stats, _ = cv2.connectedComponentsWithStats(joined)
    boxes = [tuple(stats[k, :4].tolist()) for k in range(1, count) if stats[k, 4] > 30]
    return sorted(boxes, key=lambda box: -box[2] * box[3])

# %%
rolling = Simulation(seed=1, start=(-0.43, 1.47, -0.72), movers=False, size=(320, 180),
                     balls=[(0.12, 0.26, 0.11, -1.44), (0.45, 0.87, 0.0, 0.0)])
images = [rolling.frame()]
rolling.step(0.0, 0.0, 0.5)
images.append(rolling.frame())
before, now = ([(col + width / 2, max(width, height)) for col, row, width, height
                in red_spots(image)][:2] for image in images)
print("middle column and size, before:", before)
print("after 0.5 s:                   ", now)
show(images, ["at the start", "after 0.5 s"], text="object_tracking/rolling")

# %%
# Check: the largest spot lies still; the second one is the ball that rolls, about at its true distance
assert abs(now[0][0] - before[0][0]) <= 1 and abs(now[1][0] - before[1][0]) >= 4
way = math.dist(rolling.pose("ball")[:2], rolling.pose("camera")[:2])
assert abs(176.25 * 0.22 / now[1][1] - way) < 0.3 and len(red_spots(images[1])) > 2
assert rolling.camera.fx == 176.25 and images[0].shape == (180, 320, 3)

# %% [markdown]
# Then your robot moves, and everything moves in its image. So **predict** where the ball will be, from its last column and from the robot's own turn: at an angular speed ω, all columns grow by 17.6 · ω in 0.1 s. And use a **gate**: the ball is the spot near this column, of nearly the same size. Other things are red, too. And sometimes the two red stripes of the ball are two spots: then the distance seems larger than it is.
#
# ### Your turn: follow the ball
#
# Write `control(observation, memory)`. Each drive takes 20 s. It gives its points only if it keeps three metrics, the last two as means after the first 5 s:
#
# - **bumps**: none, also not into a ball.
# - **error of the distance**: |distance − 0.6 m| to the ball that rolled is at most 0.22 m.
# - **ball beside the middle**: the robot looks at most 8° past this ball.
#
# `math`, `np`, `cv2` and `red_spots` are imported for you. You may also import `scipy`, and of `imgproc_course` the packages `geometry`, `imaging` and `messages`.
#
# The stub drives straight ahead: check it first. The check takes a while: it drives three times.
#
# | Input | Output | Example call |
# |---|---|---|
# | `observation`: the dict of the table above; `memory`: a dict that is yours | two numbers: the linear speed in m/s (at most 0.3; negative: backwards) and the angular speed in rad/s (at most 1.57; positive: to the left) | `control({"image": rolling.frame(), "time": 0.0}, {})` |

# %% role="exercise"
exercise(
    "tracking-drive",
    title="Follow a ball that rolls away",
    function="control",
    subject="drive",
    sensors=("image",),
    hint="Stand for half a second, and take the spot that moved. Then the ball is the spot near the column where you predict it. Turn in proportion to 160 minus its column, and drive in proportion to its distance minus 0.6.",
    hints=(
        "How can you see which of the balls is the right one? And when your robot turns, where in the next image is a ball that lies still?",
        "1. Return 0, 0 for the first 0.5 s, and store the spots of the first image in memory: their middle columns and sizes (the larger one of width and height).\n"
        "2. Then take the spot whose column is farthest from all columns of the first image. Leave out spots that are smaller than 15 pixels.\n"
        "3. From now on, predict its column: add 17.6 times the angular speed that you returned last.\n"
        "4. The ball is the largest spot near this column that is not much larger than before: this is your gate. If there is none, keep the predicted column.\n"
        "5. The distance is 176.25 * 0.22 / size. Drive in proportion to the distance minus 0.6, and turn in proportion to 160 minus the column.",
        "if observation[\"time\"] < 0.55:\n    memory.setdefault(\"before\", spots)\n    return 0.0, 0.0\n"
        "if \"ball\" not in memory:\n    memory[\"ball\"] = max(spots, key=lambda spot: min(abs(spot[0] - other[0]) for ...))\n"
        "middle, size = memory[\"ball\"]\nmiddle += 17.6 * memory.get(\"turn\", 0.0)\n"
        "near = [spot for spot in spots if abs(spot[0] - middle) < 0.7 * size and ...]\n"
        "linear = 1.2 * (176.25 * 0.22 / size - 0.6)\nangular = 2 * (160 - middle) / 176.25",
    ),
    explanation="First the robot stands: what moves in the image moves in the room. Then two errors give two speeds: the error"
    " of the column turns the robot, and the error of the distance drives it. The memory is the simplest tracker: the last"
    " column, moved by the robot's own turn, predicts the next one. A spot that is far from it, or much larger, is another"
    " thing. Of the others the largest one is taken: a small one may be a single stripe of the ball. For the same reason the"
    " size shrinks by 5 % a look at most.",
    another_way="You can also use a Kalman filter on column and size.",
)


def one_of_three_balls(rng):
    """A scenario: one ball rolls away. A nearer one and one far behind lie still, neither is in the way."""
    from imgproc_course.simulation import recorded_room

    room, times = recorded_room(), np.arange(0, 20, 0.1)
    shares = 0.88 * (1 - np.exp(-times / 3.5))[:, np.newaxis]  # of its way, that the ball has rolled

    def polar(angle, length):
        return length * np.array([math.cos(angle), math.sin(angle)])

    def are_free(places, metres):
        nearest = min(room.free_space.distance(*place) for place in places)
        return nearest > metres and not any(room.rug.holds(*place) for place in places)

    def follow(x, y, yaw, balls):
        """x, y and yaw of the camera (N, 3) of a robot that follows well."""
        track, speed = [], 0.0
        for ball in balls:
            camera = np.array([x, y]) + polar(yaw, 0.21)
            track.append((*camera, yaw))
            turn = math.remainder(math.atan2(*(ball - camera)[::-1]) - yaw, 2 * math.pi)
            asked = min(max(1.2 * (math.dist(camera, ball) - 0.6), -0.3), 0.3)
            speed += min(max(asked - speed, -0.06), 0.06)
            yaw += min(max(2 * turn, -1), 1) * 0.1
            x, y = np.array([x, y]) + polar(yaw, 0.1 * speed)
        return np.array(track)

    def seen(track, places):
        """Angle to the left of the middle, and distance, of a place or of places (N, 2) on the way."""
        ahead, left = (places - track[:, :2]).T
        angle = np.arctan2(left, ahead) - track[:, 2]
        return np.arctan2(np.sin(angle), np.cos(angle)), np.hypot(ahead, left)

    while True:
        x, y, yaw = rng.uniform((-0.5, -1.8, -math.pi), (5.2, 2.0, math.pi))
        to_left = rng.choice([-1, 1])
        ball = np.array([x, y]) + polar(yaw + to_left * rng.uniform(0.15, 0.45), rng.uniform(1.1, 1.7))
        roll = polar(yaw + to_left * rng.uniform(0.5, 1.4), rng.uniform(1.4, 2.6))
        balls = ball + shares * roll
        track = follow(x, y, yaw, balls)
        angles, distances = seen(track, balls)
        # Behind the ball the rug is as red as the ball.
        behind = balls + np.linspace(0, 1.5, 8)[:, np.newaxis, np.newaxis] * (balls - track[:, :2])
        is_on_rug = any(room.rug.holds(*place) for place in behind[:, ::10].reshape(-1, 2))
        if is_on_rug or not are_free(balls, 0.3) or not are_free(track[:, :2], 0.35):
            continue
        for _ in range(40):
            near = track[0, :2] + polar(yaw - to_left * rng.uniform(0, 0.3), rng.uniform(0.7, 1.0))
            far = track[-1, :2] + polar(track[-1, 2] + rng.uniform(-0.6, 0.6), rng.uniform(1.2, 2.0))
            (near_angles, near_way), (far_angles, far_way) = seen(track, near), seen(track, far)
            # The robot has room beside both, and the rolling ball is not beside another one in the image.
            if (are_free([near, far], 0.25) and min(near_way) > 0.5 and min(far_way) > 0.8
                    and abs(near_angles[0]) < abs(angles[0]) - 0.08 and near_way[0] < distances[0] - 0.2
                    and min(np.abs(near_angles - angles)[np.abs(near_angles) < 0.9], default=1) > 0.25
                    and min(np.abs(far_angles - angles)[np.abs(far_angles) < 0.9], default=1) > 0.2):
                ways = [(*ball, *roll), (*near, 0, 0), (*far, 0, 0)]
                return {"seed": int(rng.integers(1 << 31)), "duration": 20.0,
                        "start": [round(float(v), 3) for v in (x, y, yaw)],
                        "balls": [[round(float(v), 3) for v in way] for way in ways],
                        "thresholds": {"bumps": ["<=", 0], "ball_gap": ["<=", 0.22], "ball_angle": ["<=", 8]}}


# %% role="answer"
def control(observation, memory):
    return 0.2, 0.0  # your turn: this robot drives straight ahead, whatever it sees

# %% role="solution"
def control(observation, memory):
    spots = [(max(width, height), col + width / 2)
             for col, row, width, height in red_spots(observation["image"])]
    if observation["time"] < 0.55:  # stand and watch
        memory.setdefault("before", spots)
        return 0.0, 0.0

    def way(spot):
        """Columns to the nearest spot of the first image."""
        return min((abs(spot[1] - middle) for _, middle in memory["before"]), default=0)

    if "ball" not in memory:
        memory["ball"] = max((spot for spot in spots if spot[0] > 14), key=way, default=(20, 160))
    size, middle = memory["ball"]
    middle += 17.6 * memory.get("turn", 0.0)  # the robot's own turn moves the image
    near = [spot for spot in spots if abs(spot[1] - middle) < 0.7 * size and spot[0] < 1.4 * size]
    if near:
        seen, middle = max(near)
        size = max(seen, 0.95 * size)  # a single stripe is small
    linear = 1.2 * (176.25 * 0.22 / size - 0.6) if near else 0.0
    angular = min(max(2 * (160 - middle) / 176.25, -1.0), 1.0)
    memory["ball"], memory["turn"] = (size, middle), angular
    return min(max(linear, -0.3), 0.3), angular

# %% role="check" tags=["long"]
check("tracking-drive", control)

# %% role="case" title="one of three balls rolls away" points=1
def inputs(rng):
    return (one_of_three_balls(rng),)


# %% role="case" title="another way" points=1
def inputs(rng):
    return (one_of_three_balls(rng),)


# %% role="case" title="a third way" points=1
def inputs(rng):
    return (one_of_three_balls(rng),)


# %% role="hidden" title="an unseen way" points=2
def inputs(rng):
    return (one_of_three_balls(rng),)


# %% role="hidden" title="a second unseen way" points=2
def inputs(rng):
    return (one_of_three_balls(rng),)


# %% role="hidden" title="a third unseen way" points=2
def inputs(rng):
    return (one_of_three_balls(rng),)


# %% role="hidden" title="a fourth unseen way" points=2
def inputs(rng):
    return (one_of_three_balls(rng),)


# %% [markdown]
# ## Recap
#
# A colour says where something red is, but not which thing it is. A box in the image changes its size; a place on the floor does not. A Kalman filter expects, measures and combines both. And who is who is decided for all tracks together.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | hue | (360, 640) | uint8 | 0 to 179 | 2 degrees |
# | back-projection | (360, 640) | uint8 | 0 to 255 | weight |
# | box | four numbers | int | inside the image | pixel: col, row, width, height |
# | IoU | one number | float | 0 to 1 | |
# | places | (N, 2) | float64 | | metre: x, y on the floor |
# | state | (4,) | float64 | | metre and metre per second |
# | covariance | (4, 4) | float64 | | squares and products of these |
# | costs | (tracks, things) | float64 | 0 to infinity | squared expected errors |
#
# **Next:** [[where_am_i]]. First choose **File → Close and Shut Down Notebook**: it frees the robot.

# %%
# Check: the numbers in the table
assert ball_weights(hsv_frames[0]).shape == (360, 640) and hsv_frames[0][:, :, 0].max() <= 179
assert places[0].shape[1] == 2 and tracker.filters[0].statePost.shape == (4, 1)
assert tracker.filters[0].errorCovPost.shape == (4, 4)
