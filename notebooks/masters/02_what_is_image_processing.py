# ---
# jupyter:
#   imgproc_course:
#     title: What is image processing?
#     minutes: 45
# ---

# %% [markdown]
# # What is image processing?
#
# A camera gives a robot 2.8 million numbers, ten times per second. None of them says "floor", "person" or "stop". Image processing improves such images, or extracts information from them that the robot can use.
#
# **You will be able to**
# - name four uses of images on a home robot, with an example of each,
# - recognise four basic operations (grayscale, edge detection, noise removal, binarization) by what they do to the numbers,
# - explain why a grayscale image is not a binary image.
#
# **Time** about 45 minutes. **You need** [[start_here]].
#
# If the next cell says *No module named 'imgproc_course'*, open the lessons with `environment/lab`, as [[start_here]] explains.

# %%
import cv2
import numpy as np

from imgproc_course.display import live_view, show
from imgproc_course.exercises import check
from imgproc_course.recording import open_recording
from imgproc_course.ros import ImageSubscriber, open_camera, ros_available

recording = open_recording("drive")
frame = recording.frame(30)
print("frame", frame.shape, frame.dtype, "numbers:", f"{frame.size:,}")

assert frame.size == 2_764_800

# %%
show(frame, "frame 30 of the drive",
     caption="Three seconds after the start: a person walks past, a ball lies ahead, and a marker stands in front of the wall.",
     alt="A living room seen from close to the floor: a person walking, a ball on a striped rug, a square marker.")

# %% [markdown]
# ## Part one: what a robot needs to know
#
# The recording contains more than the frames. For each frame it also has two images with the right answers, the *ground truth*:
# - a *label image*: the number in each pixel says what this pixel shows (1 is floor, for example),
# - a *depth image*: the number in each pixel says how far away the thing is that this pixel shows, measured straight ahead of the camera.
#
# A robot does not have the ground truth. It has to find the answers itself. Here we use the ground truth to see what the robot looks for.
#
# ### 1 · Environment recognition: where can I drive? (4 minutes)
#
# **Predict.** How much of the image is floor: a tenth, a third, a half?

# %%
labels = recording.labels(30)
number_of = {name: number for number, name in recording.label_names.items()}
floor = labels == number_of["floor"]  # compares every pixel with this number
print(f"floor: {floor.mean():.1%} of the image")

assert number_of["floor"] == 1 and round(floor.mean() * 100) == 36

# %% [markdown]
# `floor` is a *mask*: an array with True or False for each pixel. True counts as 1 and False as 0, so the mean of a mask is the share of its True pixels. A mask also selects pixels: `painted[floor]` are the pixels of the floor. Here we paint them green.

# %%
painted = frame.copy()
painted[floor] = painted[floor] // 2 + np.array([0, 127, 0], np.uint8)  # half of the old colour, plus green
show(painted, "floor, painted green",
     caption="A little more than a third of the image is floor. The rug is not painted: is it safe to drive on it?",
     alt="The same room with the wooden floor tinted green around the rug.")

# %% [markdown]
# ### 2 · Object detection: who is there? (4 minutes)
#
# A detector returns a *bounding box*: the smallest rectangle around an object, given by its first and last row and its first and last column. Here we compute the person's bounding box from the label image. A real detector has to find the person in the frame.

# %%
rows, columns = np.nonzero(labels == number_of["person"])  # the positions of all pixels that show the person
top, bottom = rows.min(), rows.max()
left, right = columns.min(), columns.max()
print(f"person: rows {top} to {bottom}, columns {left} to {right}")

assert (top, bottom, left, right) == (102, 394, 584, 690)

# %%
boxed = frame.copy()
cv2.rectangle(boxed, (int(left), int(top)), (int(right), int(bottom)), (0, 255, 255), thickness=4)  # (column, row)
show(boxed, "one person, one bounding box",
     caption="The frame has millions of numbers, the bounding box has only four. They are enough for a robot that follows a person.",
     alt="The room with a yellow box around the walking person.")

# %% [markdown]
# ### 3 · Position estimation: where am I? (5 minutes)
#
# The black and white square is a *marker*. We know its size: each side is 25 cm. OpenCV finds its four corners in the image. To compute the position of the marker from the corners, we need two facts about the camera:
# - its *intrinsics* (`info.k`), in pixels: the *focal length*, which says how strongly the lens enlarges, and the *principal point*, the image point straight ahead of the camera,
# - its *distortion* (`info.d`): how much the lens bends straight lines in the image.
#
# `cv2.solvePnP` then computes the *pose* of the marker relative to the camera. A pose is a position and an orientation. Here we use only the position. We compare its distance from the camera with the ground truth in the recording.

# %%
dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
corners, ids, _ = cv2.aruco.ArucoDetector(dictionary).detectMarkers(frame)
half = 0.25 / 2  # metres
square = np.array([[-half, half, 0], [half, half, 0], [half, -half, 0], [-half, -half, 0]])
info = recording.camera_info
success, _, position = cv2.solvePnP(square, corners[0][0], np.array(info.k).reshape(3, 3), np.array(info.d))
measured = np.linalg.norm(position)  # the length of the vector: the distance
true = np.linalg.norm(recording.pose("marker", 30)[:3] - recording.pose("camera", 30)[:3])
print(f"marker {ids[0][0]}: measured {measured:.1f} m, true {true:.1f} m")

assert ids[0][0] == 7
assert abs(measured - true) / true < 0.05  # within five percent

# %% [markdown]
# From one image we get the distance with an error of less than five percent. If a robot knows where in the room the marker stands, it can compute its own position from the pose of the marker.
#
# ### 4 · Obstacle avoidance: what is in my way? (4 minutes)
#
# The depth image contains distances in millimetres, for every second row and every second column. **Predict**: how many metres away is the ball ahead of the robot?

# %%
depth = recording.depth(30)
ball = labels[::2, ::2] == number_of["ball"]  # [::2, ::2]: every second row and column, as in the depth image
ball_distance = np.median(depth[ball]) / 1000
print("depth", depth.shape, depth.dtype, f" ball: {ball_distance:.2f} m")

assert depth.shape == (360, 640) and depth.dtype == np.uint16
assert round(ball_distance, 2) == 1.75

# %%
# encoding="16UC1": one channel, 16 bits (numbers from 0 to 65535)
show(depth, "depth in millimetres: dark is near", encoding="16UC1", limits=(500, 5000),
     caption="Distances from 0.5 m (black) to 5 m (white): the ball stands out against the wall behind it.",
     alt="A gray image of the room in which near objects are dark; the ball is a dark disc ahead.")

# %% [markdown]
# ## Part two: four operations
#
# Programs for all four uses are built from simple operations. Four operations are very common, and each has its own lesson. Look at what each operation does to the *numbers*: to the shape of the array, and to how many different values it has.
#
# ### 5 · Grayscale: three numbers become one (3 minutes)

# %%
gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
print("before", frame.shape, "  after", gray.shape, gray.dtype, "  different values:", np.unique(gray).size)
# bgr8: channels blue, green, red, 8 bits each; mono8: one channel of 8 bits
show([frame, gray], ["colour", "gray"], encoding=["bgr8", "mono8"],
     caption="One intensity for each pixel: only a third of the numbers, but we still recognise nearly every shape.",
     alt="The room in colour, and the same room in shades of gray.")

assert gray.shape == (720, 1280) and np.unique(gray).size == 246

# %% [markdown]
# ### 6 · Planned failure: grayscale is not binary (3 minutes)
#
# Many people call a gray image a "black and white photograph". Are all its pixels black or white? Count them. (In a *planned failure*, something goes wrong on purpose. **Repair it** then says what to do.)

# %%
white = (gray == 255).mean()
black = (gray == 0).mean()
print(f"white {white:.2%}, black {black:.2%}, together {white + black:.2%}")

assert white + black < 0.01

# %% [markdown]
# Less than 1 % of the pixels are fully white or black: a gray image has up to 256 intensities (gray levels). **Repair it**: to get two values from 256, choose a *threshold*, and compare every pixel with it. That is the next operation.
#
# ### 7 · Binarization: above the threshold or not (3 minutes)

# %%
binary = np.where(gray > 128, 255, 0).astype(np.uint8)
print("different values:", np.unique(binary), f"  white: {(binary == 255).mean():.1%}")
show([gray, binary], ["gray: 246 values", "binary: two"], encoding="mono8",
     caption="Pixels above the threshold 128 become white, all others black. The result shows areas, not objects.",
     alt="The gray room, and the same room in pure black and white areas.")

assert np.unique(binary).tolist() == [0, 255]

# %% [markdown]
# ### 8 · Edge detection: where the intensity jumps (3 minutes)
#
# An *edge* is a place where the intensity changes strongly from one pixel to the next. We detect edges with the method of John Canny; [[canny_stages]] explains it and the two numbers in the next cell. An edge image also has only two values. **Predict.** How is it different from the binary image above?

# %%
edges = cv2.Canny(gray, 50, 150)
print("different values:", np.unique(edges), f"  white: {(edges == 255).mean():.1%}")
show([binary, edges], ["binary: areas", "edges: lines"], encoding="mono8",
     caption="Both have two values. Binarization gives areas; edge detection gives thin lines, one pixel wide.",
     alt="Left, black and white areas; right, thin white outlines of the same room on black.")

assert np.unique(edges).tolist() == [0, 255]
assert round((edges == 255).mean() * 100) == 4 and (binary == 255).mean() > 0.3

# %% [markdown]
# ### 9 · Noise removal: the same image with fewer errors (4 minutes)
#
# Sensors make errors, called *noise*. Here we set 5 % of the pixels to black or white. This is *impulse noise*, also called salt-and-pepper noise. A *median filter* replaces each pixel by the median of the 3 × 3 pixels around it. (The median is the value in the middle when you sort them.) So single wrong values disappear. The image keeps its shape and its colours.

# %%
rng = np.random.default_rng(seed=1)  # with the same seed, you always get the same random numbers
random_values = rng.random(frame.shape[:2])
noisy = frame.copy()
noisy[random_values < 0.025] = 0
noisy[random_values > 0.975] = 255
cleaned = cv2.medianBlur(noisy, 3)
noise_share = (noisy != frame).any(axis=-1).mean()  # pixels with any changed channel
print(f"noise: {noise_share:.1%} of the pixels   shape before {noisy.shape}, after {cleaned.shape}")

assert round(noise_share * 100) == 5 and cleaned.shape == noisy.shape

# %%
window = (slice(300, 460), slice(440, 730))
show([noisy[window], cleaned[window]], ["with noise", "after a 3 × 3 median"],
     caption="The noise is gone. Look closely: the finest details are gone too.",
     alt="A part of the image around ball and marker with black and white noise pixels, and the same part without them.")

error_before = np.abs(noisy.astype(int) - frame).mean()
error_after = np.abs(cleaned.astype(int) - frame).mean()
print(f"mean error: {error_before:.1f} before, {error_after:.1f} after, in gray levels")
assert error_after < error_before / 2

# %% [markdown]
# ## 10 · Live, on the robot's topic (4 minutes)
#
# Here is the same edge detection on the live frames. Move the sliders `low` and `high`: they set the two numbers, the thresholds that [[canny_stages]] explains.

# %% tags=["nbval-ignore-output"]
def with_edges(frame, low=50, high=150):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    return {"camera": frame, "edges": cv2.Canny(gray, min(low, high), max(low, high))}


if ros_available():
    camera = open_camera("recording")
    source = ImageSubscriber(camera.topic)
else:
    source = recording
view = live_view(source, with_edges, low=(0, 500), high=(0, 500))
assert (with_edges(frame)["edges"] == edges).all()

# %% [markdown]
# ## 11 · Your turn: name the operation (8 minutes)
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
    refused=(),
    hint="Ask in this order: does after have three dimensions? Does it have more than two different values? Is the share of white pixels small?",
    hints=(
        "Which of the four results still has colours? And which of the other three has more than two different values?",
        "Three questions are enough. First: does after have three dimensions? Then it is noise removal. Second: does it have more than two different values? Then it is grayscale. Third: is the share of white pixels less than a fifth? Then it is edges; otherwise it is binarization.",
        'The three conditions are: after.ndim == 3, then np.unique(after).size > 2, then (after == 255).mean() < 0.2. Write an if with a return for each of them. The last line is return "binarization".',
    ),
    explanation="Each question separates one operation from the rest, so the order matters. Only noise removal keeps the three channels, and so the third dimension. Only a gray image has more than two different values. Binary images and edge images both have only 0 and 255; they differ in the share of white pixels: edges are thin lines, so few pixels are white.",
    another_way="You can also write len(after.shape) == 3 for the first question, and compare the share of white pixels with 0.25 instead of 0.2.",
)


def room_image(rng):
    """A colour image of a flat wall with boxes, (90, 120, 3) uint8, with a little noise."""
    image = np.full((90, 120, 3), rng.integers(140, 200, size=3), dtype=np.float64)
    for _ in range(6):
        row, column = rng.integers(0, 70), rng.integers(0, 90)
        image[row : row + rng.integers(15, 40), column : column + rng.integers(20, 60)] = rng.integers(0, 256, size=3)
    return np.clip(image + rng.normal(0, 3, size=image.shape), 0, 255).astype(np.uint8)


def to_gray(before):
    return cv2.cvtColor(before, cv2.COLOR_BGR2GRAY)


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


# %% role="case" exercise="tour-name" title="a gray image" points=1
def inputs(rng):
    before = room_image(rng)
    return before, to_gray(before)


# %% role="case" exercise="tour-name" title="an image of areas" points=1
def inputs(rng):
    before = room_image(rng)
    gray = to_gray(before)
    return before, np.where(gray > np.median(gray) - 1, 255, 0).astype(np.uint8)


# %% role="case" exercise="tour-name" title="an image of lines" points=0
def inputs(rng):
    before = room_image(rng)
    return before, cv2.Canny(to_gray(before), 50, 150)


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
    before = rng.integers(20, 200, size=(8, 10, 3), dtype=np.uint8)
    before[3, 2:5] = 255
    return before, to_gray(before)


# %% role="case" exercise="tour-name" title="a gray image of only three rows" points=0
def inputs(rng):
    before = rng.integers(20, 200, size=(3, 11, 3), dtype=np.uint8)
    return before, to_gray(before)


# %% role="case" exercise="tour-name" title="a gray image whose first row is all the same" points=0
def inputs(rng):
    before = rng.integers(20, 200, size=(8, 10, 3), dtype=np.uint8)
    before[0] = 120
    return before, to_gray(before)


# %% role="case" exercise="tour-name" title="an image of areas, mostly black" points=0
def inputs(rng):
    before = room_image(rng)
    gray = to_gray(before)
    return before, np.where(gray > np.quantile(gray, 0.6), 255, 0).astype(np.uint8)


# %% role="case" exercise="tour-name" title="an image of many lines" points=0
def inputs(rng):
    stripes = np.tile(np.repeat([30, 220], 7), 6)[rng.integers(0, 7) :][:72].astype(np.uint8)
    before = np.dstack([np.tile(stripes, (40, 1))] * 3)
    return before, cv2.Canny(to_gray(before), 50, 150)


# %% role="hidden" exercise="tour-name" title="an image of lines" points=1 hint="The image has two values, but few white pixels. Which of the four operations gives lines?"
def inputs(rng):
    before = room_image(rng)
    return before, cv2.Canny(to_gray(before), 50, 150)


# %% role="hidden" exercise="tour-name" title="an image with less noise" points=1 hint="Only one of the four operations keeps the colours."
def inputs(rng):
    before = room_image(rng)
    return before, cv2.medianBlur(before, 3)


# %% role="mistake" exercise="tour-name" name="gray taken for binary" says="A gray image has up to 256 values, a binary image has two. Count the different values with np.unique."
def name_operation(before, after):
    operation = solution(before, after)
    return "binarization" if operation == "grayscale" else operation


# %% role="mistake" exercise="tour-name" name="areas taken for lines" says="Not every image of two values is an edge image: binarization gives areas. Look at the share of white pixels, (after == 255).mean(). It is a number between 0 and 1: compare it with 0.2, not with 20."
def name_operation(before, after):
    operation = solution(before, after)
    return "edges" if operation == "binarization" else operation


# %% role="mistake" exercise="tour-name" name="lines taken for areas" says="Not every image of two values is a binary image: edges have only 0 and 255, too. Edges are lines, so the share of white pixels is small. The share is the mean of the mask, (after == 255).mean(). The number of white pixels (sum) is not the share, and after.mean() is the mean gray level, from 0 to 255."
def name_operation(before, after):
    operation = solution(before, after)
    return "binarization" if operation == "edges" else operation


# %% role="mistake" exercise="tour-name" name="lines and areas swapped" says="The two names are swapped. In an edge image the lines are thin, so less than a fifth of the pixels are white. A binary image has larger white areas."
def name_operation(before, after):
    operation = solution(before, after)
    return {"edges": "binarization", "binarization": "edges"}.get(operation, operation)


# %% role="mistake" exercise="tour-name" name="other name: gray" says="Your function returns \"gray\". The name in this exercise is \"grayscale\": use the four texts exactly as the task gives them."
def name_operation(before, after):
    operation = solution(before, after)
    return "gray" if operation == "grayscale" else operation


# %% role="mistake" exercise="tour-name" name="other name: binary" says="Your function returns \"binary\". The name in this exercise is \"binarization\": use the four texts exactly as the task gives them."
def name_operation(before, after):
    operation = solution(before, after)
    return "binary" if operation == "binarization" else operation


# %% role="mistake" exercise="tour-name" name="capital letters" says="The names begin with a capital letter. Python distinguishes capital and small letters: write all four names in small letters."
def name_operation(before, after):
    return solution(before, after).capitalize()


# %% role="mistake" exercise="tour-name" name="no name for areas" says="For an image of areas your function returns None: no return was reached. Add the last case, return \"binarization\"."
def name_operation(before, after):
    operation = solution(before, after)
    return None if operation == "binarization" else operation


# %% role="mistake" exercise="tour-name" name="three channels not recognised" says="The colour image was not recognised by its three dimensions. after.shape is a tuple such as (90, 120, 3): it never equals the number 3, and other images have another size than the lesson's frame. Compare after.ndim, the number of dimensions, with 3."
def name_operation(before, after):
    operation = solution(before, after)
    return "grayscale" if operation == "noise removal" else operation


# %% role="mistake" exercise="tour-name" name="three rows taken for three channels" says="len(after) and after.shape[0] are the number of rows, not the number of dimensions. Compare after.ndim or len(after.shape) with 3."
def name_operation(before, after):
    if len(after) == 3:
        return "noise removal"
    operation = solution(before, after)
    return "grayscale" if operation == "noise removal" else operation


# %% role="mistake" exercise="tour-name" name="before and after expected to be equal" says="Noise removal was recognised only where before and after are equal. But noise removal changes pixels. What stays is the shape, with three channels: look at after.ndim."
def name_operation(before, after):
    if np.array_equal(before, after):
        return "noise removal"
    operation = solution(before, after)
    return "grayscale" if operation == "noise removal" else operation


# %% role="mistake" exercise="tour-name" name="the same name for every image" says="An image without colours was named \"noise removal\". Do you look at before? It is a colour image every time. Look at after: its dimensions, its values and its share of white pixels."
def name_operation(before, after):
    return "noise removal"


# %% role="mistake" exercise="tour-name" name="two values taken for gray" says="An image with only two different values was named \"grayscale\". Count the different values: np.unique(after).size."
def name_operation(before, after):
    return "noise removal" if after.ndim == 3 else "grayscale"


# %% role="mistake" exercise="tour-name" name="image returned" says="For a colour image your function returns the image itself. Return the name of the operation as text, \"noise removal\"."
def name_operation(before, after):
    return after if after.ndim == 3 else "grayscale"


# %% role="mistake" exercise="tour-name" name="number of gray levels fixed" says="A gray image was named \"edges\". How many gray levels an image has differs from image to image (one frame of the lesson has 246). More than two different values means grayscale."
def name_operation(before, after):
    operation = solution(before, after)
    return "edges" if operation == "grayscale" else operation


# %% role="mistake" exercise="tour-name" name="white pixels in a gray image" says="A gray image with white pixels (255) was not recognised. A gray image can have every value from 0 to 255: count the different values of after. More than two means grayscale."
def name_operation(before, after):
    operation = solution(before, after)
    return "edges" if operation == "grayscale" and after.max() == 255 else operation


# %% role="mistake" exercise="tour-name" name="only the first row counted" says="A gray image whose first row has only one value was not recognised. after[0] is only the first row: count the different values of the whole array, np.unique(after)."
def name_operation(before, after):
    operation = solution(before, after)
    return "edges" if operation == "grayscale" and np.unique(after[0]).size <= 2 else operation


# %% role="mistake" exercise="tour-name" name="a later name replaces an earlier one" says="All images with few white pixels are named \"edges\", the gray and the colour image, too. If your ifs stand one after the other, a later one replaces the name of an earlier one: use elif, or return the name at once."
def name_operation(before, after):
    return "edges" if (after == 255).mean() < 0.2 else solution(before, after)


# %% role="mistake" exercise="tour-name" name="limit for lines too low" says="An edge image with many lines was named \"binarization\". In an edge image, up to a fifth of the pixels may be white: compare the share with 0.2."
def name_operation(before, after):
    operation = solution(before, after)
    return "binarization" if operation == "edges" and (after == 255).mean() > 0.1 else operation


# %% role="mistake" exercise="tour-name" name="limit for areas too high" says="A binary image with more black than white was named \"edges\". In a binary image of this exercise only a quarter of the pixels may be white: compare the share with 0.2."
def name_operation(before, after):
    operation = solution(before, after)
    return "edges" if operation == "binarization" and (after == 255).mean() < 0.45 else operation


# %% [markdown]
# ## Recap
#
# A robot uses its camera to answer four questions: Where can I drive? Who is there? Where am I? What is in my way? Programs that answer them are built from simple operations on numbers. You recognise each operation by the shape and the values of its result.
#
# | operation | shape | dtype | different values | unit |
# |---|---|---|---|---|
# | *frame*, `bgr8` | (720, 1280, 3) | uint8 | up to 256 per channel | intensity of blue, green, red |
# | grayscale | (720, 1280) | uint8 | up to 256 | gray level |
# | binarization | (720, 1280) | uint8 | two, in areas | black 0, white 255 |
# | edges | (720, 1280) | uint8 | two, in lines | no edge 0, edge 255 |
# | noise removal | (720, 1280, 3) | uint8 | up to 256 per channel | intensity of blue, green, red |

# %%
for name, image in {"gray": gray, "binary": binary, "edges": edges, "cleaned": cleaned}.items():
    print(f"{name:8} {image.shape!s:15} {image.dtype}")

assert gray.shape == binary.shape == edges.shape == (720, 1280)
assert cleaned.shape == frame.shape == (720, 1280, 3)
