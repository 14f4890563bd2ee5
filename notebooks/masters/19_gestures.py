# ---
# jupyter:
#   imgproc_course:
#     title: Gestures
#     optional: true
# ---

# %% [markdown]
# # Gestures
#
# *Optional:* no other lesson needs this one. You stand in the living room and raise your hand: the robot stops. You swipe to the left: the robot turns to the left. In this lesson you count the raised fingers of a hand in three ways, by its outline, by a circle, and with a small neural network. Then you compare movements. At the end, the robot in the room obeys your hand.
#
# **You will be able to**
# - find the valleys between the fingers (convex hull, convexity defects),
# - count fingers on a circle around the palm,
# - compare two movements of different length,
# - deeper: train a small neural network and test it honestly, and let the robot obey your hand.
#
# **Time** [[minutes]], with a pause after section 4. **You need** [[canny_stages]] and [[recognising_objects]]. Only the last part of section 7 needs ROS 2.

# %% role="given" exercise=["gestures-valley", "gestures-runs"]
import numpy as np

# %% tags=["long"]
import time

import cv2
from matplotlib.figure import Figure
from sklearn.neural_network import MLPClassifier

from imgproc_course.display import show, show_figure
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.recording import open_recording
from imgproc_course.ros import Robot, RosSession, open_camera, ros_available
from imgproc_course.simulation import GESTURES, Hand, draw_hand, gesture_track, hand_mask, random_hand

recording = open_recording("drive")

# %% role="texts"
figure_texts = {
    "gloves": (
        "Six drawn hands, with 0 to 5 raised fingers.",
        "Six small images of a green hand before the living room: a fist, then hands with one to five raised fingers.",
    ),
    "mask": (
        "The green pixels of the hand with four fingers, and the largest circle that fits inside.",
        "Left, a green hand with four fingers before the room; right, its white mask on black, with a gray circle in the palm.",
    ),
    "hull": (
        "The outline of the hand (yellow) and its convex hull (white), drawn twice as large. Red points: the deepest points of valleys that count.",
        "A hand with four fingers; a white polygon around it touches the finger tips, and three red points are between the fingers.",
    ),
    "circle": (
        "The circle around the palm, drawn twice as large. Where it crosses the hand it is red; below is the arm.",
        "A mask of a hand with four fingers; a circle around the palm crosses the four fingers and the arm in red, and is blue between them.",
    ),
    "tables": (
        "The number of fingers (row) and the answer (column), for valleys plus one, and for the circle.",
        "Two tables with six rows and columns. On the left the rows 0 and 1 are both in column 1; on the right all large numbers are on the diagonal.",
    ),
    "crops": (
        "What the network sees of six hands: 16 × 16 pixels each.",
        "Six very coarse white hands on black; the fingers are two pixels wide.",
    ),
    "tracks": (
        "One track of each gesture. The green point is its first point.",
        "Six small diagrams: a line to the left, a line to the right, a line upwards, a short line left and right, a circle, and a small tangle for stop.",
    ),
    "live": (
        "The hand that the node saw last.",
        "A drawn green hand with five fingers before the living room.",
    ),
}

# %% [markdown]
# ## 1 · A hand in a glove ([[minutes]])
#
# Nobody's hand was photographed for this lesson: the hands are drawn from random numbers, so we know how many fingers each of them raises. They wear a green glove, because green occurs hardly anywhere in the room. `random_hand` draws the place, the size and the turn of a hand; `draw_hand` draws it over a frame, with noise.

# %%
background = cv2.resize(recording.frame(30)[:, 160:1120], (240, 180), interpolation=cv2.INTER_AREA)
rng = np.random.default_rng(3)
hands = [random_hand(rng, fingers) for fingers in range(6)]
images = [draw_hand(background, hand, noise=12, rng=rng) for hand in hands]
print(images[0].shape, images[0].dtype)
show(images, [f"{fingers} raised" for fingers in range(6)], columns=3, text="gestures/gloves")

# %% [markdown]
# The hand is found by its colour, like the ball in [[object_tracking]]: a median filter against the noise, then the [[term:hue]] of green and enough [[term:saturation]], then the largest [[term:connected component]].

# %%
def find_glove(frame):
    """The mask of the largest green thing in a frame: (H, W) uint8, 0 or 1."""
    hsv = cv2.cvtColor(cv2.medianBlur(frame, 5), cv2.COLOR_BGR2HSV)
    hue, saturation = hsv[..., 0], hsv[..., 1]
    green = (hue > 50) & (hue < 80) & (saturation > 90)
    _, numbers, boxes, _ = cv2.connectedComponentsWithStats(green.astype(np.uint8))
    if len(boxes) == 1:  # only the background: no green thing
        return np.zeros(green.shape, np.uint8)
    return (numbers == 1 + boxes[1:, 4].argmax()).astype(np.uint8)

# %% [markdown]
# **Predict** the IoU of the mask that we find and of the true mask of the hand with four fingers, in percent (see [[object_tracking#1]]).

# %% role="predict"
guess_iou = None  # your guess: how many percent?

# %%
mask = find_glove(images[4])
true_mask = hand_mask(hands[4])
both, either = (mask & true_mask).sum(), (mask | true_mask).sum()
print("both:", both, "  at least one:", either)
compare_guess(guess_iou, round(100 * both / either), "%")

# %% [markdown]
# Where is the palm? `cv2.distanceTransform` computes for each pixel of the mask how far it is to the nearest pixel outside. Where this distance is largest is the center of the largest circle that fits into the hand, and the distance is its radius. On a small mask:

# %%
small_mask = np.zeros((7, 9), np.uint8)
small_mask[1:6, 1:6] = 1
small_mask[3, 6:8] = 1
print(cv2.distanceTransform(small_mask, cv2.DIST_L2, 5).round(1))

# %%
def palm_of(mask):
    """The center of the palm and its radius, in pixels: row, col, radius."""
    distances = cv2.distanceTransform(mask, cv2.DIST_L2, 5)
    row, col = np.unravel_index(distances.argmax(), mask.shape)
    return int(row), int(col), float(distances.max())


row, col, radius = palm_of(mask)
print(f"row {row}, col {col}, radius {radius:.1f} pixels")
view = cv2.circle(mask * 255, (col, row), round(radius), 128, 2)
show([images[4], view], ["four fingers", "mask"], text="gestures/mask")

# %% [markdown]
# `argmax` of an image counts the pixels row by row; `np.unravel_index` makes a row and a column of this number.

# %%
# Check: the numbers in this section
assert small_mask.sum() == 27

# %% [markdown]
# ## 2 · A rubber band around the hand ([[minutes]])
#
# Stretch a rubber band around the hand and let it go: it touches the finger tips, and spans the valleys between them. The shape of the band is called the *[[term:convex hull]]*. Its corners are points of the hand.
#
# OpenCV finds it in two steps: `cv2.findContours` finds the points of the outline of a mask, and `cv2.convexHull` its hull. The points of an outline, in order, are called a *[[term:contour]]*. `cv2.approxPolyDP` leaves out the points that lie less than 1.5 pixels from the line between their neighbours. Points are (x, y) here: x to the right, y **down**.

# %%
def outline_of(mask):
    """The contour of the largest thing in a mask: (N, 2) points x, y."""
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE)
    largest = max(contours, key=cv2.contourArea)
    return cv2.approxPolyDP(largest, 1.5, True)[:, 0]


outline = outline_of(mask)
hull = cv2.convexHull(outline)[:, 0]
print(len(outline), "points of the outline,", len(hull), "corners of the hull")

# %% [markdown]
# ## 3 · Valleys ([[minutes]])
#
# Between two neighbouring corners of the hull, the contour goes into a valley. How deep is it? The depth of a point is its distance to the straight line through the two corners. It needs one number, the third one of the [[term:cross product]] of the two directions b − a and c − a. (In an image nothing has a z, so its other two numbers are 0.) Its sign says to which side the path a, b, c turns. Without the sign, it is the area of a parallelogram with the base from a to b, and the distance is the height of this parallelogram. So divide it by the length of the base.

# %% role="given" exercise=["gestures-valley"]
def turn(a, b, c):
    """Positive if the path a, b, c turns to the right, negative if to the left, 0 if it is straight."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

# %%
a, b, p = (0, 0), (8, 6), (4, 8)
area = abs(turn(a, b, p))
length = np.hypot(b[0] - a[0], b[1] - a[1])
print("area", area, "  length", length, "  distance", area / length)

# %% [markdown]
# **Predict** the distance of the point (7, −1) to the line from (0, 0) to (8, 6), in pixels.

# %% role="predict"
guess_distance = None  # your guess: how many pixels?

# %%
print("turn:", turn(a, b, (7, -1)))
compare_guess(guess_distance, abs(turn(a, b, (7, -1))) / length, "pixels")

# %% [markdown]
# A contour is closed: after its last point comes its first one. In a contour of six points, these are the positions after 4 and before 1:

# %%
position = (4 + 1) % 6
while position != 1:
    print("position", position)
    position = (position + 1) % 6

# %% [markdown]
# For the exercise, a contour of six points. The corners are at the positions 0, 3, 4 and 5; the valley from corner 0 to corner 3 goes over the points at 1 and 2.

# %%
small_contour = np.array([[0, 0], [3, 5], [7, 1], [10, 0], [10, 12], [0, 12]])

# %%
# Check: the numbers in this section, and the example calls of the exercise
assert area == 40 and length == 10 and turn(a, b, (7, -1)) == -50
assert [abs(turn(small_contour[0], small_contour[3], small_contour[i])) / 10 for i in (1, 2)] == [5, 1]
over_the_end = [abs(turn(small_contour[5], small_contour[2], small_contour[i])) / np.hypot(7, 11) for i in (0, 1)]
assert round(over_the_end[0], 2) == 6.44 > 2 > over_the_end[1]

# %% [markdown]
# ### Your turn: the deepest point of a valley
#
# Write `deepest_point(contour, start, end)`. `turn` is given.
#
# | Input | Output | Example call |
# |---|---|---|
# | `contour`: (N, 2) whole numbers, the points x, y of a closed contour, in order; `start`, `end`: two different positions in it. At least one point after `start` and before `end` is not on the line through both | a tuple (position, depth). Of the points after `start` and before `end`, the one that is farthest from the line through the points at `start` and `end`: its position in the contour, and its distance in pixels (float). If several are equally far, the first of them on the way from `start` | `deepest_point(small_contour, 0, 3)` returns `(1, 5.0)`; `deepest_point(small_contour, 5, 2)` looks at the positions 0 and 1, and returns about `(0, 6.44)` |

# %% role="exercise"
exercise(
    "gestures-valley",
    title="The deepest point of a valley",
    function="deepest_point",
    tolerance=1e-6,
    hint="From start + 1 (with %) to end: the distance is abs(turn(a, b, point)) divided by the length from a to b; keep the largest and its position.",
    hints=(
        "Which points do you look at, and what comes after the last point of the contour?",
        "1. The two corners, and the length of the line between them.\n"
        "2. Begin at the position after start, with % len(contour), and go on until you reach end.\n"
        "3. The distance of each point: turn without its sign, divided by the length.\n"
        "4. If it is larger than the largest one until now, keep it and its position.",
        "a, b = contour[start], contour[end]\nlength = np.hypot(b[0] - a[0], b[1] - a[1])\nbest, depth = start, -1.0\n"
        "position = (start + 1) % ...\nwhile position != ...:\n    distance = abs(turn(a, b, ...)) / ...\n"
        "    if distance > ...:\n        best, depth = ...\n    position = ...\nreturn best, depth",
    ),
    explanation="% len(contour) leads from the last position to 0. With > the first of several equal points stays; the depth"
    " begins below 0, so that the first point is always kept.",
    another_way="Without a loop: the positions are (start + 1 + np.arange((end - start - 1) % len(contour))) % len(contour), and"
    " argmax takes the first of the largest distances.",
)


def some_valley(rng, heights, begin, count=6):
    """A contour with a valley of these heights over a slanted line, mixed signs from call to call; and points outside it."""
    along = np.array([[3, 1], [2, -3], [-1, 4], [-5, -2]][int(rng.integers(4))])
    across = np.array([-along[1], along[0]])
    steps = 1 + np.sort(rng.permutation(2 * len(heights))[: len(heights)])
    valley = [step * along + height * across for step, height in zip(steps, heights, strict=True)]
    last = (2 * len(heights) + 2) * along
    sign = 1 if max(heights) > 0 else -1
    far = [last + (i % 3 - 4) * along + sign * int(rng.integers(15, 25)) * across for i in range(count)]
    points = np.array([0 * along, *valley, last, *far]) + rng.integers(20, 60, 2)
    return np.roll(points, begin, axis=0), begin % len(points), (begin + len(heights) + 1) % len(points)

# %% role="answer"
def deepest_point(contour, start, end):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def deepest_point(contour, start, end):
    a, b = contour[start], contour[end]
    length = np.hypot(b[0] - a[0], b[1] - a[1])
    best, depth = start, -1.0
    position = (start + 1) % len(contour)
    while position != end:
        distance = float(abs(turn(a, b, contour[position])) / length)
        if distance > depth:
            best, depth = position, distance
        position = (position + 1) % len(contour)
    return best, depth


# %% role="check"
check("gestures-valley", deepest_point)

# %% role="case" title="a valley" points=1
def inputs(rng):
    return [some_valley(rng, (1, 5, 9, 4, 2), 2), some_valley(rng, (-11, -8, -2, -3), 1), some_valley(rng, (2, 7, 3, 7, 1), 3),
            some_valley(rng, rng.permutation(np.arange(1, 40))[:6], 2)]


# %% role="case" title="over the end of the contour" points=1 hint="After the last point comes the first one: (position + 1) % len(contour)."
def inputs(rng):
    return [some_valley(rng, (3, 4, 10, 6, 2), -3), some_valley(rng, (-1, -3, -2, -6), -1), some_valley(rng, (2, 6, 5, 6, 3), -4)]


# %% role="hidden" title="any valley" points=1 hint="Are these only the points after start and before end, and is the distance divided by the length?"
def inputs(rng):
    heights = [(-2, -9, -4, -9), (4, 1, 3), (1, 3, 8, 12, 5, 2), (-5, -1, -7)]
    return [some_valley(rng, heights[i], begin, 7) for i, begin in enumerate((-2, 4, -5, 2))]


# %% [markdown]
# OpenCV finds all valleys at once. `cv2.convexityDefects` takes the contour and the positions of the hull's corners; a valley is called a *[[term:convexity defect]]* there. Each row of its result is start, end, position of the deepest point, and 256 × the depth (a whole number).

# %%
places = cv2.convexHull(outline, returnPoints=False)
# OpenCV 4 gives the shape (N, 1, 4), OpenCV 5 (N, 4)
defects = cv2.convexityDefects(outline, places).reshape(-1, 4)
for start, end, far, depth in defects[defects[:, 3] > 5 * 256]:
    print(f"from {outline[start]} to {outline[end]}: deepest {outline[far]}, depth {depth / 256:.1f}")

# %% [markdown]
# Not every valley lies between two fingers: the edge of the palm and the arm make long, flat ones. So a valley counts if it is deep (more than 0.45 of the palm's radius) and narrow: at its deepest point, the angle between the directions to its two corners is less than 85 degrees. The cosine of this angle is the dot product of the two directions, divided by both lengths.

# %%
def valleys_of(mask):
    """The deepest points of the valleys between fingers: a list of x, y."""
    outline, radius = outline_of(mask), palm_of(mask)[2]
    places = cv2.convexHull(outline, returnPoints=False)
    defects = cv2.convexityDefects(outline, places)
    deepest = []
    for start, end, far, depth in defects.reshape(-1, 4) if defects is not None else []:
        u, v = outline[start] - outline[far], outline[end] - outline[far]
        cosine = (u @ v) / (np.linalg.norm(u) * np.linalg.norm(v))
        if depth / 256 > 0.45 * radius and cosine > np.cos(np.radians(85)):
            deepest.append(outline[far])
    return deepest

# %%
view = images[4].copy()
cv2.polylines(view, [outline], True, (0, 255, 255), 1)
cv2.polylines(view, [hull], True, (255, 255, 255), 1)
for x, y in valleys_of(mask):
    cv2.circle(view, (int(x), int(y)), 4, (0, 0, 255), -1)
show(cv2.resize(view, None, fx=2, fy=2, interpolation=cv2.INTER_NEAREST), "four fingers",
     text="gestures/hull")

# %% [markdown]
# Four fingers have three valleys: one fewer than fingers. **Predict** how many valleys are found in the image with one finger, and think of the fist as well.

# %% role="predict"
guess_valleys = None  # your guess: how many valleys with one finger?

# %%
valleys = [len(valleys_of(find_glove(image))) for image in images]
for fingers, count in enumerate(valleys):
    print("raised:", fingers, "  valleys:", count)
compare_guess(guess_valleys, valleys[1])

# %% [markdown]
# **The planned failure:** a fist has no valley, and one finger has no valley either. "Valleys plus one" is right from two fingers on, but it cannot tell a fist from one finger. In a robot that stops when it sees a fist this would be dangerous. Counting valleys more exactly does not help: what we need is not in this number.

# %%
# Check: the numbers in this section
assert valleys == [0, 0, 1, 2, 3, 4]

# %% [markdown]
# ## 4 · A circle around the palm ([[minutes]])
#
# So another idea. Draw a circle around the palm's center, twice as large as the palm's circle. Walk around it once, and count how often you come from the background onto the hand: once for each raised finger, and once for the arm.

# %% tags=["long"]
def circle_pixels(row, col, radius):
    """The pixels of a circle in their order: rows, cols, 360 whole numbers each."""
    # .round(6) first: processors differ in the last digits of a sine
    angles = np.radians(np.arange(360))
    rows = np.round((row + radius * np.sin(angles)).round(6)).astype(int)
    cols = np.round((col + radius * np.cos(angles)).round(6)).astype(int)
    return rows, cols


row, col, radius = palm_of(mask)
rows, cols = circle_pixels(row, col, 2 * radius)
view = cv2.cvtColor(mask * 255, cv2.COLOR_GRAY2BGR)
for r, c in zip(rows, cols, strict=True):
    colour = (0, 0, 255) if mask[r, c] else (255, 128, 0)
    view[r - 1:r + 2, c - 1:c + 2] = colour
show(cv2.resize(view, None, fx=2, fy=2, interpolation=cv2.INTER_NEAREST), "four fingers",
     text="gestures/circle")

# %% [markdown]
# A row of neighbouring pixels on the circle that all belong to the hand is called a *run*. The circle is closed, so the pixel before the first one is the last one. In a Python list, `values[-1]` is just that.
#
# **Predict** how many runs of ones this circle of ten pixels has.

# %% role="predict"
guess_runs = None  # your guess: how many runs?

# %%
values = [1, 1, 0, 0, 1, 0, 1, 1, 0, 1]
begins = [i for i in range(10) if values[i] == 1 and values[i - 1] == 0]
print("runs begin at the positions", begins)
compare_guess(guess_runs, len(begins))

# %% [markdown]
# The run at the position 9 goes on over the end, so the ones at 0 and 1 belong to it. One more trap: a part of the circle may lie outside the image. There is no hand there. NumPy does not always notice it: `mask[-1, 0]` is a pixel of the last row.

# %%
# Check: the numbers in this section
assert begins == [4, 6, 9]

# %% [markdown]
# ### Your turn: count the runs
#
# For the example, a mask of 4 × 5 pixels, and a way of ten pixels, of which the last three are outside.

# %%
tiny_mask = np.array([[1, 1, 0, 1, 1],
                      [0, 0, 0, 0, 1],
                      [0, 0, 0, 0, 1],
                      [1, 0, 1, 0, 0]])
way_rows = np.array([0, 0, 0, 0, 0, 1, 2, 3, 4, -1])
way_cols = np.array([0, 1, 2, 3, 4, 4, 5, 5, 2, 0])

# %%
# Check: the result of the example call
inside = [0 <= r < 4 and 0 <= c < 5 and tiny_mask[r, c] == 1 for r, c in zip(way_rows, way_cols, strict=True)]
assert inside == [True, True, False, True, True, True] + 4 * [False]

# %% [markdown]
# Write `count_runs(mask, rows, cols)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `mask`: (H, W) uint8, 0 or 1; `rows`, `cols`: (N,) whole numbers, the pixels of a closed way, in order. Some may lie outside the mask; they count as 0. At least one pixel of the way is 0 | whole number: how many runs of ones there are on the way. A run that goes on over the end counts once | `count_runs(tiny_mask, way_rows, way_cols)` returns `2` |

# %% role="exercise"
exercise(
    "gestures-runs",
    title="The runs on a circle",
    function="count_runs",
    hint="Make a list of the values on the way, 0 outside the mask; a run begins where the value is 1 and the one before, values[i - 1], is 0.",
    hints=(
        "At which pixels does a run begin, and which pixel is before the first one?",
        "1. Make a list with the value of each pixel of the way.\n"
        "2. A pixel is outside if its row is negative or too large, or its column: then its value is 0.\n"
        "3. Go over the list, and count the places where the value is 1 and the value before is 0.",
        "values = []\nfor row, col in zip(rows, cols):\n    outside = row < 0 or row >= ... or ...\n"
        "    values.append(0 if outside else ...)\nreturn sum(values[i] == ... and values[i - 1] == ... for i in range(len(values)))",
    ),
    explanation="For i = 0, values[i - 1] is values[-1], the last one: so the way is closed without any more code. Each run begins"
    " exactly once.",
    another_way="Without a loop: padded = np.pad(mask, 1) has zeros around, np.clip(rows, -1, height) + 1 is always inside it, and"
    " (values > np.roll(values, 1)).sum() counts.",
)


def values_on(mask, rows, cols, top=-1):
    padded = np.pad(mask.astype(int), 1)
    return padded[np.clip(rows, top, mask.shape[0]) + 1, np.clip(cols, top, mask.shape[1]) + 1]


def is_outside(mask, rows, cols):
    return (rows < 0) | (cols < 0) | (rows >= mask.shape[0]) | (cols >= mask.shape[1])


def square_way(top, left, height, width, begin):
    """The pixels along the sides of a rectangle, clockwise."""
    rows = [*[top] * width, *range(top, top + height), *[top + height] * width, *range(top + height, top, -1)]
    cols = [*range(left, left + width), *[left + width] * height, *range(left + width, left, -1), *[left] * height]
    return np.roll(rows, begin), np.roll(cols, begin)


def some_mask(rng, height, width):
    mask = (rng.random((height, width)) < 0.55).astype(np.uint8)
    mask[:2, :2] = mask[0, -2:] = mask[-2:, -1] = mask[-1, :3] = 1
    mask[height // 2, :] = mask[:, width // 2] = 0
    return mask


def way_inside(rng, height=9, width=11, ones=(-2, -1, 0, 1)):
    """A way on which these pixels around its end are 1: a run goes on over it, ends or begins there."""
    mask = some_mask(rng, height, width)
    rows, cols = square_way(1, 1, height - 3, width - 3, 0)
    shift = int(np.flatnonzero(values_on(mask, rows, cols) == 0)[0]) + 1
    rows, cols = np.roll(rows, -shift - 2), np.roll(cols, -shift - 2)
    for i in (-2, -1, 0, 1):
        mask[rows[i], cols[i]] = i in ones
    mask[rows[4:6], cols[4:6]] = 0
    return mask, rows, cols


def way_outside(rng, top, left, height=8, width=9, border=1):
    """A way that leaves the mask; where it leaves and comes back, the mask has this value."""
    mask = some_mask(rng, height, width)
    begin = int(rng.integers(3, 9))
    rows, cols = square_way(top, left, height - 2, width - 2, begin)
    outside = is_outside(mask, rows, cols)
    for i in np.flatnonzero(outside):
        for j in (i - 1, (i + 1) % len(rows)):
            if not outside[j]:
                mask[rows[j], cols[j]] = border
    return mask, rows, cols


# %% role="answer"
def count_runs(mask, rows, cols):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols, strict=True):
        outside = row < 0 or row >= mask.shape[0] or col < 0 or col >= mask.shape[1]
        values.append(0 if outside else mask[row, col])
    count = 0
    for i in range(len(values)):
        if values[i] == 1 and values[i - 1] == 0:
            count += 1
    return count


# %% role="check"
check("gestures-runs", count_runs)

# %% role="case" title="ways inside the mask" points=1 hint="A run that goes on over the end (only if the first and the last pixel are both 1) counts once: the pixel before the first one is the last one."
def inputs(rng):
    return [way_inside(rng), way_inside(rng, 11, 9, ones=(0, 1)), way_inside(rng, 12, 14), way_inside(rng, ones=(-2, -1))]


# %% role="case" title="ways that leave the mask" points=1 hint="A pixel outside the mask counts as 0, also at a negative row or column. A run goes on over the end only if the first and the last pixel are both 1."
def inputs(rng):
    return [way_outside(rng, -2, 2), way_outside(rng, 3, 4), way_outside(rng, 2, -1, border=0), way_inside(rng, ones=(0, 1))]


# %% role="hidden" title="a drawn hand, and any way" points=1 hint="Do you count the beginnings of runs, with pixels outside as 0, and a run over the end once?"
def inputs(rng):
    from imgproc_course.simulation import hand_mask, random_hand

    hand = random_hand(rng, int(rng.integers(1, 6)))
    mask = hand_mask(hand).astype(np.uint8)
    size = int(hand.size)
    circle = square_way(int(hand.row) - size, int(hand.col) - size, 2 * size, 2 * size, int(rng.integers(200)))
    return [(mask, *circle), way_outside(rng, -3, -2, 9, 12), way_outside(rng, 4, 3, 10, 10, border=0), way_inside(rng, 14, 10, ones=(0, 1))]


# %% [markdown]
# NumPy can also do it without a loop: pad the mask with zeros, and compare the values with the values rolled by one (`np.roll`). One run is the arm; the rest are fingers.

# %%
def fingers_of(mask):
    """The number of raised fingers of the hand in a mask, by the circle around its palm."""
    row, col, radius = palm_of(mask)
    rows, cols = circle_pixels(row, col, 2 * radius)
    padded = np.pad(mask, 1)
    values = padded[np.clip(rows + 1, 0, padded.shape[0] - 1), np.clip(cols + 1, 0, padded.shape[1] - 1)]
    runs = ((values == 1) & (np.roll(values, 1) == 0)).sum()
    return int(max(runs - 1, 0))


print([fingers_of(find_glove(image)) for image in images])

# %% [markdown]
# One of the six is wrong: the hand with three fingers gets a 4. Is this bad luck? Now both ways on 120 hands, with other places, sizes and turns. For each way a [[term:confusion matrix]]: the row is the true number of fingers, the column is the answer.

# %% tags=["long"]
rng = np.random.default_rng(7)
truth, masks = [], []
for k in range(120):
    truth.append(k % 6)
    hand = random_hand(rng, truth[-1])
    masks.append(find_glove(draw_hand(background, hand, noise=12, rng=rng)))
by_valleys = [min(len(valleys_of(mask)) + 1, 5) for mask in masks]
by_circle = [min(fingers_of(mask), 5) for mask in masks]


def confusion_of(truth, answers):
    matrix = np.zeros((6, 6), int)
    for row, col in zip(truth, answers, strict=True):
        matrix[row, col] += 1
    return matrix

# %% [markdown]
# **Predict** how many of the 120 hands are right by "valleys plus one".

# %% role="predict"
guess_right = None  # your guess: how many of 120?

# %%
valley_matrix, circle_matrix = confusion_of(truth, by_valleys), confusion_of(truth, by_circle)
print("by the circle:", np.trace(circle_matrix), "of 120 right")
compare_guess(guess_right, np.trace(valley_matrix))

# %% tags=["long"]
figure = Figure(figsize=(8, 3.6), layout="constrained")
for axes, matrix, title in zip(figure.subplots(1, 2), (valley_matrix, circle_matrix),
                               ("valleys plus one", "circle"), strict=True):
    axes.imshow(matrix, cmap="Blues", vmax=20)
    for row, col in np.argwhere(matrix).tolist():
        axes.text(col, row, matrix[row, col], ha="center", va="center",
                  color="w" if matrix[row, col] > 10 else "k")
    axes.set(title=title, xlabel="answer", ylabel="raised fingers", xticks=range(6), yticks=range(6))
show_figure(figure, text="gestures/tables")

# %%
# Check: the numbers in this section
assert [fingers_of(find_glove(image)) for image in images] == [0, 1, 2, 4, 4, 5]
assert np.trace(valley_matrix) == 100 and valley_matrix[0].tolist() == [0, 20, 0, 0, 0, 0]
assert np.trace(circle_matrix) == 116 and set(by_valleys) <= set(range(6)) and circle_matrix.sum() == 120

# %% [markdown]
# Valleys plus one takes all 20 fists for one finger, and makes no other error. The circle tells them apart; it makes four errors, each of them one finger too many: at the ragged edge of a finger, a single pixel of noise can be a run of its own. How would you repair that?
#
# This is a good place for a pause.

# %% [markdown]
# ## 5 · A small network ([[minutes]], deeper)
#
# Somebody had to invent the circle. A *[[term:neural network]]* learns from examples what to look at. The linear classifier of [[recognising_objects#5]] multiplied and added once. A network does it several times, in *layers*, and after each layer but the last, negative numbers become 0. A network with two inputs, two numbers in its *[[term:hidden layer]]*, and two classes:

# %%
vector = np.array([1.0, 3])
hidden = np.array([[2.0, -1], [1, 1]]) @ vector + np.array([0.0, -2])
print("before:", hidden)
hidden = np.maximum(hidden, 0)
print("hidden layer:", hidden)
scores = np.array([[1.0, 0], [3, 1]]) @ hidden + np.array([1.5, 0])
print("scores:", scores)

# %% [markdown]
# Without the zeros, all layers together would be no more than one linear classifier. Training begins with random weights, and changes them in many small steps, so that the right class gets a larger score each time.
#
# Our network sees a square around the palm, 16 × 16 pixels: 256 numbers from 0 to 1. It has 32 hidden numbers and six classes, 0 to 5 fingers.

# %%
def crop_of(mask):
    """A square around the palm of a mask: (16, 16) float, from 0 to 1."""
    row, col, radius = palm_of(mask)
    half = round(3 * radius)
    padded = np.pad(mask, half).astype(np.float32)
    return cv2.resize(padded[row:row + 2 * half, col:col + 2 * half], (16, 16),
                      interpolation=cv2.INTER_AREA)

# %%
show([crop_of(find_glove(image)) for image in images],
     [f"{fingers} raised" for fingers in range(6)], columns=3, text="gestures/crops")

# %% [markdown]
# The training data are 600 other hands, drawn at half the size, to be quick. scikit-learn's `MLPClassifier` (BSD-3 licence) trains the network in less than a second. It stops when the *loss*, a number for how wrong the scores are, hardly falls any more. Nothing is downloaded: these weights are our own.

# %%
def some_hands(seed, count, shape=(180, 240), degrees=0):
    """Masks of so many hands, turned by an angle, and how many fingers they raise."""
    rng = np.random.default_rng(seed)
    fingers = np.arange(count) % 6
    masks = []
    for number in fingers.tolist():
        hand = random_hand(rng, number, shape)
        hand = hand._replace(turn=hand.turn + np.radians(degrees))  # another turn, all else equal
        masks.append(hand_mask(hand, shape).astype(np.uint8))
    return masks, fingers


def rows_of(masks):
    return np.array([crop_of(mask).ravel() for mask in masks])

# %% tags=["nbval-ignore-output"]
train_masks, train_fingers = some_hands(100, 600, (90, 120))
network = MLPClassifier((32,), learning_rate_init=0.01, tol=0.003, n_iter_no_change=5, random_state=0)
network.fit(rows_of(train_masks), train_fingers)
predicted = network.predict(rows_of(masks))
print("loss", round(network.loss_, 3), "after", network.n_iter_, "times over all examples")
print((predicted == truth).sum(), "of 120 right, with", (predicted[::6] == 0).sum(), "of 20 fists")

# %%
# Check: the network is right with a margin, and it is small
ordered = np.sort(network.predict_proba(rows_of(masks)), axis=1)
assert (predicted == truth).sum() >= 119 and (predicted[::6] == 0).sum() == 20
assert [weights.shape for weights in network.coefs_] == [(256, 32), (32, 6)] and network.n_iter_ < 60

# %% [markdown]
# The network is as good as the circle or better, also with noise, which it never saw in training. And it tells a fist from one finger. All the hands until now were turned by at most 23 degrees to each side. Now 60 hands are turned by 90 degrees more, so that the arm comes from the side. The circle has all 60 right.
#
# **Predict** how many of the 60 the network has right.

# %% role="predict"
guess_turned = None  # your guess: how many of 60?

# %% tags=["nbval-ignore-output"]
turned_masks, turned_fingers = some_hands(200, 60, degrees=90)
answers = network.predict(rows_of(turned_masks))
sure = network.predict_proba(rows_of(turned_masks)).max(axis=1)
wrong = answers != turned_fingers
print("circle:", sum(fingers_of(mask) == number for mask, number in zip(turned_masks, turned_fingers, strict=True)))
print("wrong, and yet the probability is above 90 %:", (wrong & (sure > 0.9)).sum())
compare_guess(guess_turned, (~wrong).sum())

# %%
# Check: the network only guesses, and often it is sure
assert 4 <= (~wrong).sum() <= 20 and (wrong & (sure > 0.9)).sum() > 30
assert [fingers_of(mask) for mask in turned_masks] == turned_fingers.tolist()
assert np.degrees(max(abs(hand.turn) for hand in hands)) < 23 and crop_of(mask).dtype == np.float32

# %% [markdown]
# The network has no more right than somebody who only guesses among the six classes. **The second planned failure:** the network has learnt these 600 hands, and not what a finger is. It knows nothing of turned hands, and does not say so: it gives a class, often with a high probability. The circle is the same from all sides. What would you change: the training data, or the crop?

# %% [markdown]
# ## 6 · Movements ([[minutes]])
#
# A wave is a movement, so one image is not enough. We follow the palm's center from frame to frame: its *[[term:tracking|track]]*, an array of points x, y. `gesture_track` makes such tracks of six gestures, with noise. No two people are equally fast, so the tracks have different lengths. A gesture is the same on the left and on the right of the image, so we subtract the mean of all points.

# %%
def centered(track):
    return track - track.mean(axis=0)


references = {gesture: centered(gesture_track(gesture, np.random.default_rng(5), noise=0, uneven=0))
              for gesture in GESTURES}
rng = np.random.default_rng(11)
examples = {gesture: centered(gesture_track(gesture, rng)) for gesture in GESTURES}
for gesture in GESTURES:
    print(f"{gesture:12} {len(examples[gesture])} points")

# %% tags=["long"]
figure = Figure(figsize=(8, 5), layout="constrained")
for axes, gesture in zip(figure.subplots(2, 3).ravel(), GESTURES, strict=True):
    x, y = examples[gesture].T
    axes.plot(x, y, "b.-", linewidth=1)
    axes.plot(x[:1], y[:1], "o", color="limegreen", markersize=9)
    axes.set(title=gesture, xlim=(-1.6, 1.6), ylim=(1.6, -1.6), aspect="equal")
show_figure(figure, text="gestures/tracks")

# %% [markdown]
# To compare two tracks of different lengths, the simplest way is to *resample* both: 24 points each, at equal times, with the points between computed by `np.interp`. Then take the mean distance of the points with the same number. The gesture whose reference is nearest is the answer.

# %%
def resample(track, count=24):
    old, new = np.linspace(0, 1, len(track)), np.linspace(0, 1, count)
    return np.column_stack([np.interp(new, old, track[:, 0]), np.interp(new, old, track[:, 1])])


def plain_distance(track, other):
    return np.linalg.norm(resample(track) - resample(other), axis=1).mean()


def nearest_gesture(track, distance):
    """The gesture whose reference is nearest to a track."""
    return min(GESTURES, key=lambda gesture: distance(centered(track), references[gesture]))

# %% [markdown]
# If the speed is constant, this works: `uneven=0`. With `uneven=1`, the hand is slow at first and fast later, or the other way round. **Predict** which gesture a wave with uneven speed is taken for.

# %% role="predict"
guess_wave = None  # your guess: which of the six gestures?

# %%
even_wave = gesture_track("wave", np.random.default_rng(8), uneven=0)
uneven_wave = gesture_track("wave", np.random.default_rng(8), uneven=1)
print("constant speed:", nearest_gesture(even_wave, plain_distance))
wave_answer = nearest_gesture(uneven_wave, plain_distance)
compare_guess(guess_wave, wave_answer)

# %%
# Check: the answers do not depend on rounding
wave_distances = sorted(plain_distance(centered(uneven_wave), references[gesture]) for gesture in GESTURES)
assert wave_answer == "stop" and wave_distances[1] - wave_distances[0] > 0.1
assert nearest_gesture(even_wave, plain_distance) == "wave"

# %% [markdown]
# **The third planned failure:** the hand moves to the left while the reference moves to the right. So the distance is large, and a hand that stands still in the middle is nearer. The points with the same number are at the same time, but not at the same place of the gesture. Of 120 tracks with uneven speed, 105 are right:

# %%
rng = np.random.default_rng(1)
tracks = [(gesture, gesture_track(gesture, rng, uneven=1)) for gesture in 20 * GESTURES]
plain_right = [gesture for gesture, track in tracks if nearest_gesture(track, plain_distance) == gesture]
for gesture in GESTURES:
    print(f"{gesture:12} {plain_right.count(gesture):2} of 20")

# %%
# Check: the numbers in this section
assert len(plain_right) == 105 and plain_right.count("swipe left") == plain_right.count("swipe right") == 20

# %% [markdown]
# A movement in one direction is easy: a swipe is a swipe at any speed. What goes to and fro, the wave and the circle, would need a distance that stretches time: *dynamic time warping* pairs each point with the one that fits best, without going back. Our robot obeys swipes, so the plain distance is enough.

# %% [markdown]
# ## 7 · In the room ([[minutes]], deeper)
#
# Now the robot obeys. Images of your hand come on the topic `/webcam/image_raw`. The node looks at each of them:
# - Five fingers are a **palm**: the robot stops at once, and forgets what it was doing. Stop always wins: how a palm moves does not matter.
# - While a hand is seen, its track grows. When the hand is gone, the track is complete, and the nearest reference says which gesture it was. A **swipe** turns the robot by 45 degrees (to within three), measured by its odometry.
# - All other gestures, and movements that are far from all six, such as a wide circle: the robot stands still.
#
# Swipes are made with two fingers, so that they are no palm. The node sees published topics only, and publishes a `Twist` for each image.

# %%
FARTHEST = 0.25  # the distance of a track that is none of the six gestures; a swipe has 0.2 at most


def gesture_of(track):
    """The gesture of a track, or None if it is far from all six."""
    gesture = nearest_gesture(track, plain_distance)
    distance = plain_distance(centered(track), references[gesture])
    return gesture if distance < FARTHEST else None

# %% tags=["long"]
if ros_available():
    from geometry_msgs.msg import Twist
    from imgproc_course.messages import array_to_image, image_to_array
    from nav_msgs.msg import Odometry
    from rclpy.node import Node
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import Image
    from std_msgs.msg import String

    class GestureNode(Node):
        """Turns the robot by 45 degrees after a swipe, and stops it at a palm with five fingers."""

        def __init__(self, fingers_of, gesture_of, context=None):
            super().__init__("gestures", context=context)
            self.fingers_of, self.gesture_of = fingers_of, gesture_of
            self.image = self.yaw = self.goal = None
            self.looks, self.is_palm, self.track, self.seen = 0, False, [], []
            self.create_subscription(
                Image, "/webcam/image_raw", self.on_image, qos_profile_sensor_data)
            self.create_subscription(Odometry, "/kachaka/odometry/odometry", self.on_odometry,
                                     qos_profile_sensor_data)
            self.commands = self.create_publisher(
                Twist, "/kachaka/manual_control/cmd_vel", qos_profile_sensor_data)
            self.names = self.create_publisher(String, "~/gesture", 10)

        def on_odometry(self, msg):
            turn = msg.pose.pose.orientation
            self.yaw = 2 * np.arctan2(turn.z, turn.w)

        def on_image(self, msg):
            if self.yaw is None:  # a turn needs the odometry
                return
            self.image = msg
            gesture = self.look(image_to_array(msg, "bgr8"))
            if gesture is not None:
                self.seen.append(gesture)
                self.names.publish(String(data=gesture))
                self.obey(gesture)
            self.commands.publish(self.command())
            self.looks += 1

        def look(self, frame):
            """The gesture that this frame completes, or None."""
            mask = find_glove(frame)
            if mask.sum() < mask.size / 50:  # no hand: if there was one, its track is complete
                track, is_palm = self.track, self.is_palm
                self.track, self.is_palm = [], False
                return self.gesture_of(np.array(track)) if len(track) >= 8 and not is_palm else None
            row, col, _ = palm_of(mask)
            self.track.append([3 * col / mask.shape[1], 3 * row / mask.shape[1]])
            if self.is_palm or self.fingers_of(mask) < 5:
                return None
            self.is_palm = True  # at once: if the count is wrong, to stop is the safe side
            return "palm"

        def obey(self, gesture):
            if gesture == "palm":
                self.goal = None
            elif gesture in ("swipe left", "swipe right"):
                self.goal = self.yaw + np.radians(45 if gesture == "swipe left" else -45)

        def command(self):
            """Towards the goal; without one, stand still."""
            command = Twist()
            if self.goal is not None:
                rest = (self.goal - self.yaw + np.pi) % (2 * np.pi) - np.pi  # from -π to π
                command.angular.z = float(np.clip(2 * rest, -0.6, 0.6))
                if abs(rest) < 0.05:
                    self.goal, command = None, Twist()
            return command

    class HandCamera(Node):
        """Publishes frames of hands, ten a second."""

        def __init__(self, frames, context=None):
            super().__init__("webcam", context=context)
            self.frames, self.sent = iter(frames), 0
            self.images = self.create_publisher(Image, "~/image_raw", qos_profile_sensor_data)
            self.create_timer(0.1, self.publish_frame)

        def publish_frame(self):
            frame = next(self.frames, None)
            if frame is not None:
                msg = array_to_image(frame, "bgr8")
                msg.header.stamp = self.get_clock().now().to_msg()
                self.images.publish(msg)
                self.sent += 1


# %% [markdown]
# `HandCamera` publishes frames as a webcam would, ten in a second. Most computers on which this course runs have no webcam, so the frames are drawn: a program plays the person. `gesture_frames` hands out the frames of one gesture, one after the other (`yield`), and then some without a hand.

# %%
def gesture_frames(gesture, rng):
    """The frames of a gesture: a palm shows five fingers, all others two; then the hand is gone."""
    fingers = 5 if gesture == "palm" else 2
    hand = random_hand(rng, fingers)._replace(turn=rng.uniform(-0.2, 0.2))
    for x, y in gesture_track("stop" if gesture == "palm" else gesture, rng, noise=0.02):
        yield draw_hand(background, hand._replace(row=hand.row + 60 * y, col=120 + 80 * x))
    for _ in range(5):
        yield background


def shown_frames(gestures):
    rng = np.random.default_rng(0)
    for gesture in gestures:
        yield from gesture_frames(gesture, rng)

# %% [markdown]
# The same with your own hand in a green glove (a green sock will do): `webcam_frames` gives the frames of your webcam, mirrored, so that your left is on the left. A webcam sees you and your home. So nothing is stored here (why that matters: [[faces#5]]): each frame is looked at once and then forgotten, and only this machine receives the topic. To use it, write `webcam_frames()` in place of `shown_frames(shown)` in the cell after the next one.

# %%
def webcam_frames():
    """The frames of the first webcam of this machine, as in a mirror. Nothing is stored."""
    webcam = cv2.VideoCapture(0)
    try:
        while webcam.isOpened():
            has_frame, frame = webcam.read()
            if not has_frame:
                return
            yield cv2.resize(cv2.flip(frame, 1), (240, 180), interpolation=cv2.INTER_AREA)
    finally:
        webcam.release()

# %% [markdown]
# This takes about 20 seconds. The person shows a swipe to the left, a circle, a swipe to the right, and a palm before the robot has turned back all the way:

# %% tags=["nbval-ignore-output", "long"]
shown = ["swipe left", "circle", "swipe right", "palm"]
if ros_available():
    live_camera = open_camera("room", rate=10)
    live_robot = Robot()
    live_robot.restart(start=(1.2, 0.2, 0.0))
    session = RosSession.current()
    node = session.add_node(GestureNode(fingers_of, gesture_of, context=session.context))
    webcam = session.add_node(HandCamera(shown_frames(shown), context=session.context))
    yaws = []
    end = time.monotonic() + 60
    while "palm" not in node.seen and time.monotonic() < end:
        time.sleep(0.1)
        if node.yaw is not None:
            yaws.append(float(np.degrees(node.yaw)))
    time.sleep(1)
    session.remove_node(webcam)
    session.remove_node(node)
    live_camera.stop()
    print("images:", node.looks, "  gestures:", node.seen)
    print(f"turned to the left at most {max(yaws):.0f} degrees, at the end {yaws[-1]:.0f}")
    show(image_to_array(node.image, "bgr8"), text="gestures/live")

# %%
# Check: the node looked
assert not ros_available() or node.looks > 0

# %% [markdown]
# ## Recap
#
# The convex hull spans the valleys between the fingers, and valleys cannot tell a fist from one finger. A circle around the palm can, and does not mind how the hand is turned. A network learns to count from examples, and knows only hands like those in its examples. Movements are compared point by point, as long as their speed is even.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | mask | (180, 240) | uint8 | 0 or 1 | |
# | outline | (N, 2) | int32 | 0 to 239 | pixels, x, y |
# | convex hull | (M, 2) | int32 | 0 to 239 | pixels, x, y |
# | depth of a valley | one number | float | 0 or more | pixels |
# | crop of a mask | (16, 16) | float32 | 0 to 1 | share |
# | track | (N, 2) | float64 | | half a swipe |
#
# **Next:** [[the_errand]]. The robot drives, keeps its distance, follows a ball, knows its place, draws a map, reads, names things, hides faces, and obeys your hand. In the last lesson, you join these parts. First choose **File → Close and Shut Down Notebook**: it frees the robot.

# %%
# Check: the numbers in the table
assert mask.shape == (180, 240) and mask.dtype == np.uint8 and outline.dtype == hull.dtype == np.int32
assert examples["wave"].dtype == np.float64
