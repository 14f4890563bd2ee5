# ---
# jupyter:
#   imgproc_course:
#     title: What is image processing?
# ---

# %% [markdown]
# # What is image processing?
#
# *[[term:image processing|Image processing]]* improves the quality of an image, or extracts information from it. A robot needs both. Its camera gives it 2.8 million numbers, ten times per second. None of these numbers says "floor", "person" or "stop".
#
# **You will be able to**
# - name four uses of images on a home robot, with an example of each,
# - recognise four basic operations (grayscale, edge detection, noise removal, [[term:binarization]]) by what they do to the numbers,
# - say what distinguishes a grayscale image from a binary image,
# - name the four steps of a program that processes a robot's images, and the libraries that it needs.
#
# **Time** [[minutes]]; take a break after section 4. **You need** [[arrays]]: slices, masks, `np.where`, the mean of a mask.

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
        "Three seconds after the start: a person walks past, a ball lies ahead, and a marker stands in front of the wall.",
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
# The recording contains more than the frames. For each frame it also has two images with the right answers, the *[[term:ground truth]]*:
# - a *[[term:label image]]*: the number in each pixel says what this pixel shows (1 is floor, for example),
# - a *[[term:depth image]]*: the number in each pixel says how far away the thing in this pixel is.
#
# A robot does not have the ground truth. It has to find the answers itself. Here we use the ground truth to see what the robot looks for.
#
# ### 1 · Environment recognition: where can I drive? ([[minutes]])
#
# Look at the frame above. **Predict.** How many percent of the image are floor? (The rug does not count.)

# %% role="predict"
guess_floor = None  # your guess: how many percent of the pixels?

# %%
labels = recording.labels(30)
print(recording.label_names)
floor = labels == 1  # a mask: True where the pixel shows the floor
floor_share = floor.mean()
compare_guess(guess_floor, round(floor_share * 100), "%")

# %% [markdown]
# The mask `floor` has True or False for each pixel, and its mean is the share of the True pixels. A mask also selects pixels. Here we paint all pixels of the floor green:

# %%
painted = frame.copy()
painted[floor] = (0, 160, 0)  # blue, green, red
show(painted, "floor, painted green", text="what_is_image_processing/floor")

# %%
# Check: the numbers in this section
assert recording.label_names[1] == "floor"
assert round(floor_share * 100) == 36

# %% [markdown]
# ### 2 · Object detection: who is there? ([[minutes]])
#
# A detector returns a *[[term:bounding box]]*: the smallest rectangle around an object, given by its first and last row and its first and last column. Here we compute the person's bounding box from the label image. A real detector has to find the person in the frame.

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
# ### 3 · Position estimation: where am I? ([[minutes]])
#
# The black and white square is a *[[term:marker]]*. OpenCV knows its pattern: it finds the four corners of the marker in the image, and reads its number. (`_` is a name for a result that we do not need.)

# %%
patterns = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
detector = cv2.aruco.ArucoDetector(patterns)
corners, ids, _ = detector.detectMarkers(frame)
marked = frame.copy()
cv2.aruco.drawDetectedMarkers(marked, corners, ids)
show(marked, "the marker", rows=(280, 430), cols=(590, 790),
     text="what_is_image_processing/marker")

# %% [markdown]
# The marker is small in the image, so it is far away. From its real size and its size in the image, a program computes how far away it is. If a robot knows where in the room the marker is, it can then compute its own position; [[where_am_i]] does this.

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
# We know the real size of the marker: each side is 0.25 m. How far away is it? An object at twice the distance looks half as large. How large it looks in pixels also depends on the lens, on its *[[term:focal length]]*. The focal length of this camera is 705 pixels. Then:
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
# The recording contains the true positions of camera and marker, so we can compute the true distance: 3.6 m. Our result has an error of less than five percent.

# %%
# Check: the numbers in this section
marker_position = recording.pose("marker", 30)[:3]
true_distance = np.linalg.norm(marker_position - recording.pose("camera", 30)[:3])
assert focal_length == 705
assert top_left[1] == 330 and bottom_left[1] == 377
assert round(true_distance, 1) == 3.6 and round(float(distance), 2) == 3.75
assert abs(distance - true_distance) / true_distance < 0.05

# %% [markdown]
# ### 4 · Obstacle avoidance: what is in my way? ([[minutes]])
#
# The depth image contains distances in millimetres, for every second row and every second column of the frame. We look for the nearest obstacle straight ahead of the robot, in the middle third of the image. Floor and rug are no obstacles.
#
# **Predict.** Which obstacle is the nearest one straight ahead?

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
# `&` between two masks means *and*: True where both are True. The ball is the nearest obstacle ahead, at 1.72 m; the toy beside it is at 1.73 m. The boxes on the right are nearer (1.05 m), but the robot can drive past them.

# %%
show(depth, "depth in millimetres: dark is near", limits=(500, 5000),
     text="what_is_image_processing/depth")

# %%
# Check: the numbers in this section
assert depth.shape == (360, 640) and depth.dtype == np.uint16
assert recording.label_names[14] == "rug" and recording.label_names[names[0]] == "ball"
assert nearest == 1722 and (depth > 0).all()
toy, box = small_labels == 17, small_labels == 8
assert recording.label_names[17] == "toy" and recording.label_names[8] == "box"
assert round(depth[toy].min() / 1000, 2) == 1.73 and round(depth[box].min() / 1000, 2) == 1.05
assert np.nonzero(box)[1].min() > 427

# %% [markdown]
# **Pause.** This is a good place for a break. **You can begin here** after it: run the first code cell of this lesson, then go on below.
#
# ## Part two: four operations
#
# Programs for all four uses are built from simple operations. Four operations are very common, and each has its own lesson: [[grayscale]], [[binarization]], [[canny_stages|edge detection]] and [[noise_removal]]. Look at what each operation does to the *numbers*: to the shape of the array, and to the number of different values in it. (`np.unique` lists the different values, and `.size` counts them.)
#
# ### 5 · Grayscale: three numbers become one ([[minutes]])

# %%
gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
print("before", frame.shape, "  after", gray.shape, gray.dtype)
print("different values:", np.unique(gray).size)
show([frame, gray], ["colour", "gray"], text="what_is_image_processing/gray")

# %% [markdown]
# ### 6 · Planned failure: a “black and white” photograph ([[minutes]])
#
# Many people call a gray image "black and white". How many of its pixels really are black or white? (In a *planned failure*, something goes wrong on purpose. **Repair it** then says what to do.) **Predict** how many percent of its pixels are fully black (0) or fully white (255).

# %% role="predict"
guess_black_white = None  # your guess: how many percent of the pixels?

# %%
black_share = (gray == 0).mean()
white_share = (gray == 255).mean()
together = round(float(black_share + white_share) * 100, 3)
compare_guess(guess_black_white, together, "%")

# %%
# Check: the numbers in the sections 5 and 6
assert gray.shape == (720, 1280) and np.unique(gray).size == 246
assert together == 0.005

# %% [markdown]
# Almost no pixel is fully white or black: a gray image has up to 256 intensities ([[term:gray level|gray levels]]). **Repair it**: to get two values from 256, choose a *[[term:threshold]]*, and compare every pixel with it. That is the next operation.
#
# ### 7 · Binarization: above the threshold or not ([[minutes]])

# %%
binary = np.where(gray > 128, 255, 0).astype(np.uint8)
binary_share = (binary == 255).mean()
print("different values:", np.unique(binary))
print("white:", round(binary_share * 100), "%")
show([gray, binary], ["gray: 246 values", "binary: two"],
     text="what_is_image_processing/binary")

# %% [markdown]
# ### 8 · Edge detection: where the intensity jumps ([[minutes]])
#
# An *[[term:edge]]* is a place where the intensity changes strongly from one pixel to the next. We detect edges with the *[[term:Canny edge detector]]*; [[canny_stages]] explains it, and the two numbers 50 and 150 in the next cell. An edge image also has only two values: 255 (white) for an edge, 0 for no edge.
#
# **Predict.** Are more or fewer of its pixels white than in the binary image above?

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
assert np.unique(binary).tolist() == np.unique(edges).tolist() == [0, 255]
assert round(edge_share * 100) == 4 and binary_share > 0.3

# %% [markdown]
# ### 9 · Noise removal: the same image with fewer errors ([[minutes]])
#
# Sensors make errors, called *[[term:noise]]*. Here we set 5 % of the pixels to black or white. This is *[[term:impulse noise]]*, also called salt-and-pepper noise.

# %%
# with the same seed, you always get the same random numbers
rng = np.random.default_rng(seed=1)
random_values = rng.random((720, 1280))  # one number from 0 to 1 for each pixel
noisy = frame.copy()
noisy[random_values < 0.025] = 0
noisy[random_values > 0.975] = 255

# %% [markdown]
# A *median filter* replaces each pixel by the median of the 3 × 3 pixels around it. (The [[term:median]] is the value in the middle when you sort them.) So single wrong values disappear. The image keeps its shape and its colours.

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
# ### How much is left? ([[minutes]], deeper)
#
# **Predict.** How large is the mean error that is left, compared with the mean error of the noisy image?

# %% role="predict"
guess_error = None  # your guess: how many percent of it are left?

# %%
error_before = np.abs(noisy.astype(int) - frame).mean()
error_after = np.abs(cleaned.astype(int) - frame).mean()
print("mean error in gray levels:", round(float(error_before), 1),
      "before,", round(float(error_after), 1), "after")
compare_guess(guess_error, round(float(error_after / error_before) * 100), "%")

# %%
# Check: the error is less than half
assert error_after < error_before / 2

# %% [markdown]
# ## 10 · The four steps, live on the robot's topic ([[minutes]])
#
# Every program in this course that processes a robot's images has four steps:
#
# 1. **Subscribe** to the camera's topic, to receive its messages.
# 2. **Convert** each message to an array.
# 3. **Process** the array: for example, compute its edges.
# 4. **Display** the result, or **publish** it on a topic of its own, as a new message.
#
# These libraries are needed:
#
# | library | what it is | used for |
# |---|---|---|
# | `rclpy` | the Python library of ROS 2 | steps 1 and 4: topics and messages |
# | `cv_bridge` | the converter between ROS messages and arrays | steps 2 and 4 |
# | OpenCV (`cv2`) | the most widely used library for image processing | step 3, and windows for step 4 |
# | NumPy (`np`) | the library for arrays | all computation with pixels |
#
# `ImageSubscriber` of this course does the steps 1 and 2 with `rclpy`, and `live_view` does step 4. The next lessons look inside. Here is step 3, edge detection, on the live frames. Move the sliders `low` and `high`: they set the two thresholds that [[canny_stages]] explains.

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
# | `before`: a colour image of any size | one of the four texts `"grayscale"`, `"binarization"`, `"edges"`, `"noise removal"`, exactly as they are written here | `name_operation(frame, gray)` gives `"grayscale"` |
# | `after`: the result of one operation on `before` | | `name_operation(noisy, cleaned)` gives `"noise removal"` |
#
# Everything you need is shown above: use the number of dimensions of `after` (`after.ndim` is 2 for a gray image and 3 for a colour image), the number of its different values, and the share of its white pixels. In this exercise, at least a quarter of the pixels of every binary image are white, and less than a fifth of the pixels of every edge image.
#
# `np` is ready to use in every exercise. Import everything else that you use in the cell itself.

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
# A robot uses its camera to answer four questions: Where can I drive? Who is there? Where am I? What is in my way? Programs that answer them are built from simple operations on numbers. You recognise each operation by the shape and the values of its result.
#
# | operation | shape | dtype | different values | unit |
# |---|---|---|---|---|
# | *frame* | (720, 1280, 3) | uint8 | up to 256 per channel | intensity of blue, green, red |
# | grayscale | (720, 1280) | uint8 | up to 256 | gray level |
# | binarization | (720, 1280) | uint8 | two, in areas | black 0, white 255 |
# | edges | (720, 1280) | uint8 | two, in lines | no edge 0, edge 255 |
# | noise removal | (720, 1280, 3) | uint8 | up to 256 per channel | intensity of blue, green, red |
#
# **Next:** [[images_as_messages]]. Before you go on, choose **File → Close and Shut Down Notebook**: otherwise this lesson continues to use the camera.

# %%
# Check: the table above
for image in (gray, binary, edges):
    assert image.shape == (720, 1280) and image.dtype == np.uint8
assert cleaned.shape == frame.shape == (720, 1280, 3) and cleaned.dtype == np.uint8
