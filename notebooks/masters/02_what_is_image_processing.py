# ---
# jupyter:
#   imgproc_course:
#     title: What is image processing?
# ---

# %% [markdown]
# # What is image processing?
#
# *[[term:image processing|Image processing]]* improves an image, or extracts information from it. A robot needs both: its camera gives it 2.8 million numbers, ten times per second, and none of them says "floor", "person" or "stop".
#
# **You will be able to**
# - name four uses of images on a home robot,
# - recognise four basic operations by what they do to the numbers, and write one of them,
# - deeper: name the four steps of a program that processes a robot's images, and its libraries.
#
# **Time** [[minutes]]. **You need** [[arrays]]: slices, masks, `np.where`, the mean of a mask.

# %%
import cv2
import numpy as np

from imgproc_course.display import live_view, show
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.recording import open_recording
from imgproc_course.ros import ImageSubscriber, open_camera, ros_available

recording = open_recording("drive")
frame = recording.frame(30)
print("frame", frame.shape, frame.dtype, "  numbers:", frame.size)

# %% role="texts"
figure_texts = {
    "frame": (
        "Three seconds after the start: a person walks past, and a marker stands in front of the wall.",
        "A living room seen from close to the floor: a person walking, a ball on a striped rug, a square marker.",
    ),
    "floor": (
        "A little more than a third of the image is floor. The rug is not painted: is it safe to drive on it? (Section 4 counts it as free.)",
        "The same room with the wooden floor in plain green around the rug.",
    ),
    "person": (
        "The frame has millions of numbers, the bounding box has only four. They are enough for a robot that follows a person.",
        "The room with a yellow box around the walking person.",
    ),
    "marker": (
        "OpenCV has found the four corners of the marker, and its number: 7.",
        "A black and white square in front of the wall, with a green outline and the text id=7.",
    ),
    "depth": (
        "Distances from 0.5 m (black) to 5 m (white): the ball stands out against the wall behind it.",
        "A gray image of the room in which near objects are dark; the ball is a dark disc ahead.",
    ),
    "gray": (
        "One intensity for each pixel: only a third of the numbers, but we still recognise nearly every shape.",
        "The room in colour, and the same room in shades of gray.",
    ),
    "binary": (
        "Pixels above the threshold 128 become white, all others black. The result shows areas, not objects.",
        "The gray room, and the same room in pure black and white areas.",
    ),
    "edges": (
        "Both have two values. Binarization gives areas; edge detection gives thin lines, one pixel wide.",
        "Left, black and white areas; right, thin white outlines of the same room on black.",
    ),
    "noise": (
        "The noise is gone. Look closely: the finest details are gone too.",
        "A part of the image around ball and marker with black and white noise pixels, and the same part without them.",
    ),
    "live": (
        "The drive and its edges. The two sliders set the thresholds.",
        "The room in colour and its edges as white lines on black, while the robot drives.",
    ),
}

# %%
show(frame, "frame 30 of the drive", text="what_is_image_processing/frame")

# %%
# Check: the numbers in this section
assert frame.size == 2_764_800 and recording.rate == 10

# %% [markdown]
# ## Part one: what a robot needs to know
#
# A home robot asks its images: where can I drive (*environment recognition*)? Who is there (*object detection*)? Where am I (*position estimation*)? What is in my way (*obstacle avoidance*)? The first question is answered here, the others in deeper sections.
#
# For each frame, the recording also has the right answers, the *[[term:ground truth]]*: the *[[term:label image]]* says what each pixel shows (1 is floor), the *[[term:depth image]]* says how far away it is.
#
# ### 1 · Environment recognition: where can I drive? ([[minutes]])
#
# **Predict.** How many percent of the image are floor? (The rug does not count.)

# %% role="predict"
guess_floor = None  # your guess: how many percent of the pixels?

# %%
labels = recording.labels(30)
print(recording.label_names)
floor = labels == 1  # a mask: True where the pixel shows the floor
floor_share = floor.mean()
compare_guess(guess_floor, round(floor_share * 100), "%")

# %% [markdown]
# The mean of a mask is the share of its True pixels. A mask also selects pixels: here we paint them green.

# %%
painted = frame.copy()
painted[floor] = (0, 160, 0)  # blue, green, red
show(painted, "floor, painted green", text="what_is_image_processing/floor")

# %%
# Check: the numbers in this section
assert recording.label_names[1] == "floor"
assert round(floor_share * 100) == 36

# %% [markdown]
# ### 2 · Object detection: who is there? ([[minutes]], deeper)
#
# A detector returns a *[[term:bounding box]]*: the smallest rectangle around an object, given by its first and last row and column. Here we take it from the label image.

# %%
person = labels == 16
rows, columns = np.nonzero(person)  # the row and column of every True pixel
top, bottom = rows.min(), rows.max()
left, right = columns.min(), columns.max()
print("rows", top, "to", bottom, "  columns", left, "to", right)

# %%
boxed = frame.copy()
yellow = (0, 255, 255)
# OpenCV's points are (column, row), the other way round than an index
cv2.rectangle(boxed, (left, top), (right, bottom), yellow, thickness=4)
show(boxed, "one person, one bounding box", text="what_is_image_processing/person")

# %%
# Check: the numbers in this section
assert recording.label_names[16] == "person"
assert (top, bottom, left, right) == (102, 394, 584, 690)

# %% [markdown]
# ### 3 · Position estimation: where am I? ([[minutes]], deeper)
#
# The black and white square is a *[[term:marker]]*. OpenCV finds its four corners in the image, and reads its number. (`_` is a name for a result that we do not need.)

# %%
patterns = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
detector = cv2.aruco.ArucoDetector(patterns)
corners, ids, _ = detector.detectMarkers(frame)
marked = frame.copy()
cv2.aruco.drawDetectedMarkers(marked, corners, ids)
show(marked, "the marker", rows=(280, 430), cols=(590, 790),
     text="what_is_image_processing/marker")

# %% [markdown]
# From its size in the image, a program computes how far away the marker is, and from this the robot's own position: see [[where_am_i]].

# %%
# Check: the marker's number
assert ids[0][0] == 7

# %% [markdown]
# #### How far away is it? ([[minutes]], deeper)
#
# Here are two of the four corners:

# %%
top_left, top_right, bottom_right, bottom_left = corners[0][0]
print("top left corner (column, row):", top_left)
print("bottom left corner:           ", bottom_left)

# %% [markdown]
# Each side of the marker is 0.25 m long. An object at twice the distance looks half as large. Its size in pixels also depends on the lens, on its *[[term:focal length]]*, here 705 pixels:
#
# $$\text{distance} = \text{focal length} \cdot \frac{\text{real size}}{\text{size in pixels}}$$
#
# **Predict** the distance. (The left side of the marker goes from row 330 to row 377.)

# %% role="predict"
guess_marker = None  # your guess: how many metres?

# %%
focal_length = recording.camera_info.k[4]  # in pixels
side = bottom_left[1] - top_left[1]  # in pixels
distance = focal_length * 0.25 / side
print("focal length:", focal_length, "  side:", side)
compare_guess(guess_marker, round(float(distance), 2), "m")

# %% [markdown]
# The true distance, from the recording, is 3.6 m. Our result has an error of less than five percent.

# %%
# Check: the numbers in this section
marker_position = recording.pose("marker", 30)[:3]
true_distance = np.linalg.norm(marker_position - recording.pose("camera", 30)[:3])
assert focal_length == 705
assert top_left[1] == 330 and bottom_left[1] == 377
assert round(true_distance, 1) == 3.6 and round(float(distance), 2) == 3.75
assert abs(distance - true_distance) / true_distance < 0.05

# %% [markdown]
# ### 4 · Obstacle avoidance: what is in my way? ([[minutes]], deeper)
#
# The depth image has distances in millimetres, for every second row and column of the frame. We look for the nearest obstacle straight ahead, in the middle third of the image. Floor and rug are no obstacles.
#
# **Predict.** Which obstacle is it?

# %% role="predict"
guess_obstacle = None  # your guess: "ball", "box", "person", "table" or "toy"?

# %%
depth = recording.depth(30)
small_labels = labels[::2, ::2]  # as large as the depth image
obstacle = (small_labels != 1) & (small_labels != 14)  # not floor, not rug
obstacle[:, :213] = False  # the left third is not ahead
obstacle[:, 427:] = False  # nor is the right third
nearest = depth[obstacle].min()
names = small_labels[obstacle & (depth == nearest)]
print("depth", depth.shape, depth.dtype, "  nearest:", nearest / 1000, "m")
compare_guess(guess_obstacle, recording.label_names[names[0]])

# %% [markdown]
# The ball is the nearest obstacle ahead, at 1.72 m. The boxes on the right are nearer (1.05 m), but the robot can drive past them.

# %%
show(depth, "depth in millimetres: dark is near", limits=(500, 5000),
     text="what_is_image_processing/depth")

# %%
# Check: the numbers in this section
assert depth.shape == (360, 640) and depth.dtype == np.uint16
assert recording.label_names[14] == "rug" and recording.label_names[names[0]] == "ball"
assert nearest == 1722 and (depth > 0).all()
box = small_labels == 8
assert recording.label_names[8] == "box" and round(depth[box].min() / 1000, 2) == 1.05
assert np.nonzero(box)[1].min() > 427

# %% [markdown]
# ## Part two: four operations
#
# **Pause?** **You can begin here** after it: run the first code cell, then go on below.
#
# Programs for all four uses are built from simple operations. Look at what each does to the *numbers*: to the shape of the array, and to how many different values it has (`np.unique` lists them, `.size` counts them).
#
# ### 5 · Grayscale: three numbers become one ([[minutes]])

# %%
gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
print("before", frame.shape, "  after", gray.shape, gray.dtype)
print("different values:", np.unique(gray).size)
show([frame, gray], ["colour", "gray"], text="what_is_image_processing/gray")

# %% [markdown]
# ### 6 · Planned failure: “black and white” ([[minutes]])
#
# In a *planned failure*, something goes wrong on purpose; **Repair it** then says what to do. Many people call a gray image "black and white". **Predict** how many percent of its pixels are black (0) or white (255).

# %% role="predict"
guess_black_white = None  # your guess: how many percent of the pixels?

# %%
together = round(float(((gray == 0) | (gray == 255)).mean()) * 100, 3)
compare_guess(guess_black_white, together, "%")

# %%
# Check: the numbers in the sections 5 and 6
assert gray.shape == (720, 1280) and np.unique(gray).size == 246
assert together == 0.005

# %% [markdown]
# A gray image has up to 256 intensities ([[term:gray level|gray levels]]), and hardly a pixel is fully black or white. **Repair it**: choose a *[[term:threshold]]*, and compare every pixel with it.
#
# ### 7 · Binarization: above the threshold or not ([[minutes]])
#
# *[[term:binarization|Binarization]]* makes an image with two values.

# %%
binary = np.where(gray > 128, 255, 0).astype(np.uint8)
binary_share = (binary == 255).mean()
print("different values:", np.unique(binary))
print("white:", round(binary_share * 100), "%")
show([gray, binary], ["gray: 246 values", "binary: two"],
     text="what_is_image_processing/binary")

# %% [markdown]
# ### Your turn: binarize by hand ([[minutes]])
#
# Here are 5 × 5 pixels: every 144th row and every 256th column of the gray image.

# %%
patch = gray[::144, ::256]
print(patch)

# %% [markdown]
# **Predict.** With the threshold 100, how many of these 25 pixels become white? Count them.

# %% role="predict"
guess_above = None  # your guess: how many pixels?

# %%
compare_guess(guess_above, (patch > 100).sum())

# %% [markdown]
# Now write `binarize(gray, level)`. `np` is ready to use in every exercise.
#
# | Input | Output | Example call |
# |---|---|---|
# | `gray`: (height, width) uint8; `level`: a number | (height, width) uint8: 255 where the pixel is above `level`, 0 elsewhere | `binarize(patch, 100)` |
#
# The dtype counts: `np.where` with two whole numbers gives `int64`.

# %% role="exercise"
exercise(
    "tour-binarize",
    title="Binarize an image",
    function="binarize",
    exact_type=True,
    time_limit=5,
    hint="255 where the pixel is brighter than level, and 0 everywhere else.",
    hints=(
        "Which function makes a new array from a mask and two values?",
        "Make the mask gray > level. Choose 255 for True and 0 for False with np.where. Convert the result to uint8.",
        "return np.where(gray > level, ?, ?).astype(np.uint8) with the two values in place of the question marks.",
    ),
    explanation="np.where takes the first value where the mask is True and the second where it is False. Its result has the dtype int64, because 255 and 0 are Python integers; astype makes an image of it again.",
    another_way="You can also write (gray > level) * np.uint8(255): True counts as 1 and False as 0.",
)

# %% role="answer"
def binarize(gray, level):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def binarize(gray, level):
    return np.where(gray > level, 255, 0).astype(np.uint8)

# %% role="check"
check("tour-binarize", binarize)

# %% role="case" title="few gray levels, then many" points=1
def inputs(rng):
    gray = np.array([[10, 50, 50, 90, 90], [10, 90, 140, 90, 200], [10, 10, 90, 90, 90]], dtype=np.uint8)
    return [(rng.permutation(gray), 50), (rng.integers(0, 256, (4, 6), dtype=np.uint8), 90)]


# %% role="case" title="another level" points=0
def inputs(rng):
    return (rng.integers(0, 256, (5, 7), dtype=np.uint8), 200)

# %% role="hidden" title="other images" points=1
def inputs(rng):
    return [(rng.integers(0, 5, (6, 5), dtype=np.uint8), level) for level in (2, 1, 4)]


# %% [markdown]
# ### 8 · Edge detection: where the intensity jumps ([[minutes]])
#
# An *[[term:edge]]* is a place where the intensity changes strongly from one pixel to the next. The *[[term:Canny edge detector]]* finds edges; [[canny_stages]] explains its two numbers, 50 and 150. Its result has two values, too: 255 (white) for an edge, 0 for none.
#
# **Predict.** Are more or fewer of its pixels white than in the binary image?

# %% role="predict"
guess_white = None  # your guess: "more" or "fewer"?

# %%
edges = cv2.Canny(gray, 50, 150)
edge_share = (edges == 255).mean()
print("different values:", np.unique(edges))
print("white:", round(edge_share * 100), "%")
compare_guess(guess_white, "more" if edge_share > binary_share else "fewer")

# %%
show([binary, edges], ["binary: areas", "edges: lines"],
     text="what_is_image_processing/edges")

# %%
# Check: the numbers in the sections 7 and 8
assert patch.shape == (5, 5) and (binary[::144, ::256] == np.where(patch > 128, 255, 0)).all()
assert np.unique(binary).tolist() == np.unique(edges).tolist() == [0, 255]
assert round(edge_share * 100) == 4 and binary_share > 0.3

# %% [markdown]
# ### 9 · Noise removal: the same image with fewer errors ([[minutes]])
#
# Sensors make errors, called *[[term:noise]]*. Here we set 5 % of the pixels to black or white: *[[term:impulse noise]]* (salt-and-pepper noise).

# %%
# with the same seed, you always get the same random numbers
rng = np.random.default_rng(seed=1)
random_values = rng.random((720, 1280))  # one number from 0 to 1 for each pixel
noisy = frame.copy()
noisy[random_values < 0.025] = 0
noisy[random_values > 0.975] = 255

# %% [markdown]
# A *median filter* takes the [[term:median]] of the 3 × 3 pixels around each pixel, in each channel: the value in the middle when you sort the nine. So single wrong values disappear.

# %%
cleaned = cv2.medianBlur(noisy, 3)
print("before", noisy.shape, "  after", cleaned.shape)
show([noisy, cleaned], ["with noise", "after a 3 × 3 median"],
     rows=(300, 460), cols=(440, 730), text="what_is_image_processing/noise")

# %%
# Check: the numbers in this section
noise = (random_values < 0.025) | (random_values > 0.975)
assert round(noise.mean() * 100) == 5 and cleaned.shape == noisy.shape

# %% [markdown]
# ## 10 · The four steps, live on the robot's topic ([[minutes]], deeper)
#
# A program for a robot's images has four steps:
#
# 1. **Subscribe** to the camera's topic, to receive its messages: with `rclpy`, ROS 2 in Python.
# 2. **Convert** each message to an array: with `cv_bridge`.
# 3. **Process** the array: with OpenCV (`cv2`) and NumPy (`np`).
# 4. **Display** the result (OpenCV), or **publish** it on a topic of its own.
#
# `ImageSubscriber` does the steps 1 and 2, and `live_view` step 4. Here is step 3, edge detection, on the live frames. Move the sliders `low` and `high`, the two thresholds.

# %%
def with_edges(frame, low=50, high=150):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    edges = cv2.Canny(gray, min(low, high), max(low, high))
    return {"camera": frame, "edges": edges}


# %% tags=["nbval-ignore-output"]
if ros_available():
    camera = open_camera("recording")
    source = ImageSubscriber(camera.topic)
else:
    source = recording
view = live_view(source, with_edges, low=(0, 500), high=(0, 500),
                 text="what_is_image_processing/live")

# %%
# Check: the function gives the same edges as above
assert (with_edges(frame)["edges"] == edges).all()

# %% [markdown]
# ## 11 · Your turn: name the operation ([[minutes]], deeper)
#
# Write `name_operation(before, after)`. It gets an image before and after one operation, and returns the name of this operation.
#
# | Input | Output | Example call |
# |---|---|---|
# | `before`: a colour image of any size; `after`: the result of one operation on `before` | one of the four texts `"grayscale"`, `"binarization"`, `"edges"`, `"noise removal"`, exactly as they are written here | `name_operation(frame, gray)` gives `"grayscale"` |
#
# Use the number of dimensions of `after` (`after.ndim` is 2 for a gray image and 3 for a colour image), the number of its different values, and the share of its white pixels: in this exercise, at least a quarter in every binary image, and less than a fifth in every edge image.

# %% role="exercise"
import cv2

exercise(
    "tour-name",
    title="Name the operation",
    function="name_operation",
    time_limit=5,
    hint="Ask in this order: does after have three dimensions? Does it have more than two different values? Is the share of white pixels small? Return one of the four names exactly as the task writes it.",
    hints=(
        "Which of the four results still has colours? And which of the other three has more than two different values?",
        "Three questions are enough. First: does after have three dimensions? Then it is noise removal. Second: does it have more than two different values? Then it is grayscale. Third: is the share of white pixels less than a fifth? Then it is edges; otherwise it is binarization.",
        'The three conditions are: after.ndim == 3, then np.unique(after).size > 2, then (after == 255).mean() < 0.2. Write an if with a return for each of them. The last line is return "binarization".',
    ),
    explanation="Each question separates one operation from the rest, so the order matters. Only noise removal keeps the three channels, and so the third dimension. Only a gray image has more than two different values. Binary images and edge images both have only 0 and 255; they differ in the share of white pixels: edges are thin lines, so few pixels are white.",
    another_way="You can also write len(after.shape) == 3 for the first question, and compare the share of white pixels with 0.25 instead of 0.2.",
)


def room_image(rng):
    """A colour image of a flat wall with boxes, (45, 60, 3) uint8, with a little noise."""
    image = np.full((45, 60, 3), rng.integers(140, 200, size=3), dtype=np.float64)
    for _ in range(6):
        row, column = rng.integers(0, 35), rng.integers(0, 45)
        image[row : row + rng.integers(8, 20), column : column + rng.integers(10, 30)] = rng.integers(0, 256, size=3)
    return np.clip(image + rng.normal(0, 3, size=image.shape), 0, 255).astype(np.uint8)


def to_gray(before):
    return cv2.cvtColor(before, cv2.COLOR_BGR2GRAY)


def gray_with_white(rng):
    before = rng.integers(20, 200, size=(8, 10, 3), dtype=np.uint8)
    before[3, 2:5] = 255
    return before, to_gray(before)


def gray_with_even_first_row(rng):
    before = rng.integers(20, 200, size=(8, 10, 3), dtype=np.uint8)
    before[0] = 120
    return before, to_gray(before)


def lines(rng):
    before = room_image(rng)
    return before, cv2.Canny(to_gray(before), 50, 150)


def many_lines(rng):
    stripes = np.tile(np.repeat([30, 220], 7), 6)[rng.integers(0, 7) :][:72].astype(np.uint8)
    before = np.dstack([np.tile(stripes, (40, 1))] * 3)
    return before, cv2.Canny(to_gray(before), 50, 150)


def areas_mostly_black(rng):
    before = room_image(rng)
    gray = to_gray(before)
    return before, np.where(gray > np.quantile(gray, 0.57), 255, 0).astype(np.uint8)


def few_lines(rng):
    stripes = np.tile(np.repeat([30, 220], 7), 4)[rng.integers(0, 7) :][:40].astype(np.uint8)
    before = np.dstack([np.tile(stripes, (9, 1))] * 3)
    return before, cv2.Canny(to_gray(before), 50, 150)


def small_areas(rng):
    before = rng.integers(20, 200, size=(8, 10, 3), dtype=np.uint8)
    gray = to_gray(before)
    return before, np.where(gray > np.median(gray), 255, 0).astype(np.uint8)


def small_with_less_noise(rng):
    before = rng.integers(20, 200, size=(8, 10, 3), dtype=np.uint8)
    return before, cv2.medianBlur(before, 3)


def any_of(rng, *kinds):
    """Eight small pairs of these kinds: nobody can know before in which order the names come."""
    return [kinds[number](rng) for number in rng.integers(0, len(kinds), 8)]

# %% role="answer" exercise="tour-name"
def name_operation(before, after):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution" exercise="tour-name"
def name_operation(before, after):
    if after.ndim == 3:
        return "noise removal"
    if np.unique(after).size > 2:
        return "grayscale"
    if (after == 255).mean() < 0.2:
        return "edges"
    return "binarization"


# %% role="check" exercise="tour-name"
check("tour-name", name_operation)

# %% role="case" exercise="tour-name" title="gray images, and images of lines" points=1
def inputs(rng):
    before = room_image(rng)
    return [(before, to_gray(before)), lines(rng), *any_of(rng, gray_with_white, few_lines)]


# %% role="case" exercise="tour-name" title="images of areas, and images with less noise" points=1
def inputs(rng):
    before = room_image(rng)
    gray = to_gray(before)
    areas = np.where(gray > np.median(gray) - 1, 255, 0).astype(np.uint8)
    return [(before, areas), (before, cv2.medianBlur(before, 3)), *any_of(rng, small_areas, small_with_less_noise)]


# %% role="case" exercise="tour-name" title="an image of lines" points=0
def inputs(rng):
    return lines(rng)

# %% role="case" exercise="tour-name" title="an image with less noise" points=0
def inputs(rng):
    before = room_image(rng)
    return before, cv2.medianBlur(before, 3)

# %% role="case" exercise="tour-name" title="noise removal in an image without noise: nothing changes" points=0
def inputs(rng):
    before = np.full((7, 9, 3), rng.integers(40, 200, size=3), dtype=np.uint8)
    return before, cv2.medianBlur(before, 3)

# %% role="case" exercise="tour-name" title="a gray image with some white pixels" points=0
def inputs(rng):
    return gray_with_white(rng)

# %% role="case" exercise="tour-name" title="a gray image of only three rows" points=0
def inputs(rng):
    before = rng.integers(20, 200, size=(3, 11, 3), dtype=np.uint8)
    return before, to_gray(before)

# %% role="case" exercise="tour-name" title="a gray image whose first row is all the same" points=0
def inputs(rng):
    return gray_with_even_first_row(rng)

# %% role="case" exercise="tour-name" title="an image of areas, mostly black" points=0
def inputs(rng):
    return areas_mostly_black(rng)

# %% role="case" exercise="tour-name" title="an image of many lines" points=0
def inputs(rng):
    return many_lines(rng)

# %% role="hidden" exercise="tour-name" title="images of lines, and images of areas" points=1 hint="These images have only two values. Lines have less than a fifth of white pixels, areas have more."
def inputs(rng):
    return [lines(rng), many_lines(rng), areas_mostly_black(rng), *any_of(rng, few_lines, small_areas)]


# %% role="hidden" exercise="tour-name" title="images with less noise, and gray images" points=1 hint="Only one of the four operations keeps the colours, and only a gray image has more than two different values."
def inputs(rng):
    before = room_image(rng)
    calls = [(before, cv2.medianBlur(before, 3)), gray_with_white(rng), gray_with_even_first_row(rng)]
    return [*calls, *any_of(rng, small_with_less_noise, gray_with_white)]


# %% [markdown]
# ## Recap
#
# A robot's camera answers: Where can I drive? Who is there? Where am I? What is in my way? You recognise an operation by the shape and the values of its result (all uint8):
#
# | operation | shape | different values | unit |
# |---|---|---|---|
# | *frame*, noise removal | (720, 1280, 3) | up to 256 per channel | intensity of blue, green, red |
# | grayscale | (720, 1280) | up to 256 | gray level |
# | binarization | (720, 1280) | two, in areas | black 0, white 255 |
# | edges | (720, 1280) | two, in lines | no edge 0, edge 255 |
#
# **Next:** [[images_as_messages]]. First choose **File → Close and Shut Down Notebook**: it frees the camera.

# %%
# Check: the table above
for image in (gray, binary, edges):
    assert image.shape == (720, 1280) and image.dtype == np.uint8
assert cleaned.shape == frame.shape == (720, 1280, 3) and cleaned.dtype == np.uint8
