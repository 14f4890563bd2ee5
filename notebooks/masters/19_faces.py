# ---
# jupyter:
#   imgproc_course:
#     title: Faces
# ---

# %% [markdown]
# # Faces
#
# A home robot sees people every day. Where is a face? Whose face is it? And what may the robot keep of it? In this lesson you build the parts of a face detector that most cameras used for years, and two ways to recognise a face. At the end, you hide all faces that your detector finds, before anything is stored.
#
# A face is personal. So the people in this lesson do not exist: we draw their faces from numbers. The one face that you see of a real person is the photograph of an astronaut that NASA put into the public domain.
#
# **You will be able to**
# - compute the sum of any box of an image without adding up its pixels (integral image),
# - compute a Haar feature, and explain how a cascade of them finds faces,
# - compare faces by eigenfaces and by local binary patterns,
# - say when each of these fails,
# - hide faces in an image, and say what a robot may store.
#
# **Time** [[minutes]], with a pause after section 4. **You need** [[noise_removal]] and [[recognising_objects]]. Only the last part of section 8 needs ROS 2.

# %% role="given" exercise=["faces-integral", "faces-haar", "faces-residue", "faces-lbp", "faces-anonymise"]
import numpy as np

# %% tags=["long"]
import tempfile
import time
from pathlib import Path
from xml.etree import ElementTree as ET

import cv2
from matplotlib.figure import Figure
from skimage import data
from skimage.feature import Cascade

from imgproc_course.display import show, show_figure
from imgproc_course.exercises import check, compare_guess, hint, solution
from imgproc_course.imaging import to_gray
from imgproc_course.recording import open_recording
from imgproc_course.ros import RosSession, open_camera, record, ros_available
from imgproc_course.simulation import draw_face, put_face, random_identity

recording = open_recording("drive")

# %% role="texts"
figure_texts = {
    "people": (
        "Four images of drawn faces. The first, third and fourth one show the same person.",
        "Four simple drawn faces with hair, eyes, nose and mouth; the third one is dark on one side, the fourth one looks a little to the side.",
    ),
    "feature": (
        "A window of 24 × 24 pixels, drawn 16 times as large. Pixels between the two red rectangles count −1. Those in the inner strip, at the height of the eyes, count −1 + 3 = 2.",
        "A coarse gray image of a face; a red rectangle lies over eyes, nose and forehead, and inside it a strip from eye to eye.",
    ),
    "stages": (
        "How many of the windows are left after each stage. The scale is logarithmic: each line is ten times the one below it.",
        "Bars that become shorter from left to right, from more than two hundred thousand to about ten.",
    ),
    "neighbours": (
        "Left: every window that the detector accepts. Right: the groups of at least five windows.",
        "Two images of an astronaut: on the left, many green squares lie around her face and a few ones elsewhere; on the right, one square lies around her face.",
    ),
    "alarm": (
        "Parts of two frames of the drive, and what the detector takes for a face there.",
        "Two parts of the living room: on the left a green square lies on the sign KITCHEN, on the right one lies on a plant under the table.",
    ),
    "eigenfaces": (
        "The mean of 30 drawn faces, and the first five eigenfaces, drawn three times as large. In an eigenface, gray is 0, brighter is positive, darker is negative.",
        "Six small images: a blurred face, then five in gray in which eyes, hairline, cheeks and mouth are brighter or darker than the rest.",
    ),
    "codes": (
        "The same person in light from the front and from the side, and the LBP codes of both images. Many codes change; around the eyes and the brows their patterns stay most alike.",
        "Two faces above: one evenly lit, one dark on one side. Below, two images of codes: around eyes and brows the patterns are alike, on the cheeks and at the mouth they differ.",
    ),
    "scores": (
        "How many of 30 persons are recognised, by three ways, in five kinds of images.",
        "Groups of three bars. Local binary patterns are best in dim light and in side light, and worst with strong noise.",
    ),
    "mosaics": (
        "One person behind mosaics with blocks of 4, 8, 16 and 64 pixels. The image has 64 × 64 pixels.",
        "Four images of a face: with small blocks the face is easy to see, with the largest one it is a plain square.",
    ),
    "live": (
        "Left: what the camera with the visitor sends, before it is stored anywhere. Right: the first stored image.",
        "Two images of the living room. On the left there is a drawn person; on the right there is a plain square in place of the face.",
    ),
}

# %% [markdown]
# ## 1 · People who do not exist ([[minutes]])
#
# *[[term:face detection|Face detection]]* finds where faces are in an image. *[[term:face recognition|Face recognition]]* says whose face it is. These are different questions, and they need different tools.
#
# To measure a detector or a recogniser, we must know the truth. `random_identity` makes twelve numbers: how wide the head is, how far the eyes are apart, how dark the skin is, and so on. They are one person. `draw_face` draws this person, with light from the front or from the side, and turned a little (`yaw`) if we want.

# %%
people = [random_identity(np.random.default_rng(number)) for number in range(30)]
print(len(people), "people, the first one:", people[0].round(2))
faces = [draw_face(people[0], 128), draw_face(people[1], 128),
         draw_face(people[0], 128, side_light=0.6), draw_face(people[0], 128, yaw=0.3)]
show(faces, ["person 0", "person 1", "0, side light", "0, turned"],
     columns=4, text="faces/people")

# %%
# Check: the numbers in this section
assert len(people) == 30 and people[0].shape == (12,) and faces[0].shape == (128, 128, 3) and faces[0].dtype == np.uint8

# %% [markdown]
# ## 2 · The sum of any box ([[minutes]])
#
# Where the eyes are, a face is dark. So a detector adds up the pixels of many boxes and compares the sums. A box of 200 × 300 pixels has 60,000 of them, and there are hundreds of thousands of boxes. We do it with **running sums** instead: each number is the sum of all numbers up to it.

# %%
print(np.array([3, 1, 4, 1]).cumsum())
tiny = np.array([[1, 2, 3],
                 [4, 5, 6]])
print(tiny.cumsum(axis=0))  # down each column
print(tiny.cumsum(axis=1))  # along each row

# %% [markdown]
# The *[[term:integral image]]* does this in both directions. Its number in row *r*, column *c* is the sum of all pixels of the image that are above row *r* **and** left of column *c*. Nothing is above row 0 or left of column 0, so its first row and its first column are 0. It has one row and one column more than the image.
#
# `np.pad` adds rows and columns of zeros: `((1, 0), (1, 0))` means one row before the first and none after the last, and the same for the columns.

# %%
print(np.pad(np.array([[7, 8]]), ((1, 0), (1, 0))))

# %% [markdown]
# **Predict** the last number (in the last row and the last column) of the integral image of `tiny`.

# %% role="predict"
guess_last = None  # your guess: which number?

# %%
integral = cv2.integral(tiny.astype(np.uint8))
print(integral)
compare_guess(guess_last, int(integral[-1, -1]))

# %%
# Check: the numbers in this section
assert integral.tolist() == [[0, 0, 0, 0], [0, 1, 3, 6], [0, 5, 12, 21]] and 200 * 300 == 60_000

# %% [markdown]
# ### Your turn: the integral image
#
# Write `integral_image(gray)`. OpenCV has it as `cv2.integral`; here you write it with NumPy.
#
# | Input | Output | Example call |
# |---|---|---|
# | `gray`: (H, W) uint8 | (H + 1, W + 1) int64: in row r, column c the sum of all pixels above row r and left of column c | `integral_image(np.array([[2, 5]], np.uint8))` returns `[[0, 0, 0], [0, 2, 7]]` |

# %% role="exercise"
exercise(
    "faces-integral",
    title="The integral image",
    function="integral_image",
    hint="Running sums down the columns, then of these along the rows; one row and one column of zeros before them.",
    hints=(
        "If you have the running sums down each column, which sums of them do you still need?",
        "1. Make int64 of the image: uint8 ends at 255.\n"
        "2. The running sums down each column.\n"
        "3. Of these, the running sums along each row.\n"
        "4. One row of zeros above, one column of zeros on the left.",
        "sums = gray.astype(np.int64).cumsum(axis=0).cumsum(axis=...)\nreturn np.pad(sums, ((1, 0), ...))",
    ),
    explanation="The order of the two running sums does not matter. astype comes first, because a sum of uint8 can wrap round.",
    another_way="A loop also works: each number is the pixel, plus the sum above, plus the sum on the left, minus the sum above and"
    " on the left of it, which was counted twice.",
)


def image(rng, rows, cols):
    return rng.integers(40, 256, (rows, cols), dtype=np.uint8)

# %% role="answer"
def integral_image(gray):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def integral_image(gray):
    sums = gray.astype(np.int64).cumsum(axis=0).cumsum(axis=1)
    return np.pad(sums, ((1, 0), (1, 0)))

# %% role="check"
check("faces-integral", integral_image)

# %% role="case" title="a small image" points=1
def inputs(rng):
    return [(image(rng, 2, 3),), (image(rng, 4, 3),)]


# %% role="case" title="larger sums" points=1 hint="Are the numbers int64 before you add them up? uint8 ends at 255."
def inputs(rng):
    return [(image(rng, 5, 7),), (image(rng, 20, 20) // 4 + np.uint8(191),)]


# %% role="hidden" title="any image" points=1 hint="Is each number the sum of all pixels above it and left of it, and are the first row and column 0?"
def inputs(rng):
    return [(image(rng, 6, 5),), (image(rng, 9, 11),)]


# %% [markdown]
# Now the sum of a box. **Predict** how many numbers of the integral image are enough for the sum of any box, be it 2 × 3 or 200 × 300 pixels.

# %% role="predict"
guess_corners = None  # your guess: how many numbers?

# %%
block = np.arange(20).reshape(4, 5)
sums = cv2.integral(block.astype(np.uint8))
print(block)
print(sums)
top, bottom, left, right = 1, 3, 2, 4  # the rows 1 and 2, the columns 2 and 3
corners = [sums[bottom, right], -sums[top, right], -sums[bottom, left], sums[top, left]]
print(*corners, "sum", sum(corners))
print("one by one:", block[top:bottom, left:right].sum())
compare_guess(guess_corners, len(corners))

# %% [markdown]
# Everything down to the lower right corner of the box; minus the part above the box; minus the part left of it. What is above *and* left was subtracted twice, so it is added once.

# %%
# Check: the numbers in this section
assert [int(corner) for corner in corners] == [78, -6, -33, 1] and sum(corners) == block[1:3, 2:4].sum() == 40

# %% [markdown]
# ## 3 · Bright boxes and dark boxes ([[minutes]])
#
# A *[[term:Haar feature]]* consists of two or three boxes in a small window, and each box has a weight. Its value is the sum of the pixels of each box, times its weight, all added up. OpenCV's face detector looks at windows of 24 × 24 pixels. This is the first feature in its file: left, top, width, height and weight of each box, counted from the upper left corner of the window.

# %%
first_feature = ((6, 4, 12, 9, -1),
                 (6, 7, 12, 3, 3))

# %%
portrait = to_gray(data.astronaut()[..., ::-1])  # from RGB to BGR first
small = cv2.resize(portrait, (144, 144), interpolation=cv2.INTER_AREA)
window = cv2.cvtColor(small[20:20 + 24, 52:52 + 24], cv2.COLOR_GRAY2BGR)
view = cv2.resize(window, (384, 384), interpolation=cv2.INTER_NEAREST)
for left, top, width, height, _ in first_feature:
    cv2.rectangle(view, (16 * left, 16 * top), (16 * (left + width), 16 * (top + height)), (0, 0, 255), 2)
show(view, "24 × 24 pixels", text="faces/feature")

# %% [markdown]
# The large box has the weight −1, and the strip inside it 3. So a pixel of the strip counts 3 − 1 = 2, and every other pixel of the large box counts −1. On a face the strip lies at the height of the eyes.
#
# **Predict** the value of this feature in an image in which every pixel is 100.

# %% role="predict"
guess_plain = None  # your guess: which number?

# %%
plain = np.full((24, 24), 100)
value = 0
for left, top, width, height, weight in first_feature:
    value += weight * plain[top:top + height, left:left + width].sum()
compare_guess(guess_plain, int(value))

# %%
face = small[20:20 + 24, 52:52 + 24].astype(int)
value_on_face = 0
for left, top, width, height, weight in first_feature:
    value_on_face += weight * face[top:top + height, left:left + width].sum()
print("on the face:", value_on_face)

# %% [markdown]
# The eyes are darker than the forehead and the cheeks, so the value on the face is far below 0.
#
# With the integral image, no pixel needs to be added up again, wherever the window is. For one box in the window whose upper left pixel is in row 2, column 1 of an image:

# %%
image = np.arange(48).reshape(6, 8)
print(image)
sums = cv2.integral(image.astype(np.uint8))
row, col = 2, 1  # the window
left, top, width, height, weight = 1, 0, 3, 2, -1  # the box in the window
first_row, first_col = row + top, col + left
last_row, last_col = first_row + height, first_col + width
total = (sums[last_row, last_col] - sums[first_row, last_col]
         - sums[last_row, first_col] + sums[first_row, first_col])
print("rows", first_row, "to", last_row - 1, "columns", first_col, "to", last_col - 1)
print("sum", total, "times the weight:", weight * total)

# %%
# Check: the numbers in this section
assert value == 0 and value_on_face == -2510 and total == image[2:4, 2:5].sum()

# %% [markdown]
# ### Your turn: a Haar feature
#
# Write `haar_feature(sums, boxes, row, col)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `sums`: the integral image, (H + 1, W + 1) int64; `boxes`: a list of boxes (left, top, width, height, weight), counted from the upper left corner of the window; `row`, `col`: row and column of this corner | one whole number: the sum of each box times its weight, all added up | `haar_feature(sums, [(1, 0, 3, 2, -1)], 2, 1)` returns the last number above |

# %% role="exercise"
exercise(
    "faces-haar",
    title="A Haar feature",
    function="haar_feature",
    hint="For each box: four numbers of sums, at the corners row + top, col + left, and height rows and width columns farther; times the weight; all boxes added up.",
    hints=(
        "Where in the image are the first row and the first column of a box, if the window begins in row, col?",
        "1. Begin with 0.\n"
        "2. For each box: its first row and column in the image (window + box), and the row and column after its last ones.\n"
        "3. The sum of the box from four numbers of sums.\n"
        "4. Add this sum times the weight.",
        "value = 0\nfor left, top, width, height, weight in boxes:\n    first_row, first_col = row + top, col + ...\n"
        "    last_row, last_col = first_row + height, ...\n"
        "    total = sums[last_row, last_col] - sums[first_row, last_col] - ... + ...\n    value += weight * total\nreturn value",
    ),
    explanation="Four numbers for each box, whatever its size. The window only moves all corners by row and col.",
    another_way="You can write the sum of a box as a function of its own, and add up in one line with sum(...).",
)


def integral(rng, rows, cols):
    gray = rng.integers(0, 256, (rows, cols)).astype(np.int64)
    return np.pad(gray.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))


TWO = [(1, 2, 4, 3, -1), (1, 3, 4, 1, 3)]
SIDE = [(0, 1, 6, 2, -1), (2, 1, 2, 2, 3)]
CORNERS = [(1, 0, 4, 6, -1), (1, 0, 2, 3, 2), (3, 3, 2, 3, 2)]


# %% role="answer"
def haar_feature(sums, boxes, row, col):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def haar_feature(sums, boxes, row, col):
    value = 0
    for left, top, width, height, weight in boxes:
        first_row, first_col = row + top, col + left
        last_row, last_col = first_row + height, first_col + width
        total = (sums[last_row, last_col] - sums[first_row, last_col]
                 - sums[last_row, first_col] + sums[first_row, first_col])
        value += weight * total
    return int(value)

# %% role="check"
check("faces-haar", haar_feature)

# %% role="case" title="a window" points=1
def inputs(rng):
    return [(integral(rng, 12, 15), TWO, 3, 5), (integral(rng, 12, 15), SIDE, 2, 6)]


# %% role="case" title="two and three boxes" points=1 hint="Is every box added, each with its own weight?"
def inputs(rng):
    return [(integral(rng, 10, 12), CORNERS, 1, 4), (integral(rng, 12, 12), TWO, 4, 2)]


# %% role="hidden" title="any feature" points=1 hint="Four corners for each box, moved by row and col; minus, minus and plus; times the weight."
def inputs(rng):
    return [(integral(rng, 14, 18), CORNERS, 5, 7), (integral(rng, 14, 18), SIDE, 6, 3)]


# %% [markdown]
# ## 4 · The cascade ([[minutes]])
#
# One feature finds no face: curtains and shelves also have dark strips. A *weak classifier* compares one feature with a limit and gives one of two numbers. A *stage* adds up the numbers of its weak classifiers. If the sum is below the threshold of the stage, the window is rejected. Three windows, two weak classifiers, and a threshold of 1.5:

# %%
values = np.array([[-0.2, 0.1, -0.3],   # of one feature, in three windows
                   [0.4, -0.1, -0.1]])  # of another one
votes = (np.where(values[0] < -0.1, 2.0, -2.0)
         + np.where(values[1] < 0.2, -1.0, 1.5))
threshold = 1.5
print("sums:", votes, "left:", votes >= threshold)

# %% [markdown]
# Stages in a row are a *[[term:cascade]]*: a window is only looked at by the next stage if it passed all stages before. OpenCV's cascade has 25 stages with 2913 weak classifiers; they were learned from thousands of images. (The file names Intel, the year 2000 and an open-source licence, and comes with OpenCV 4.) OpenCV 5 has no such cascades; there this lesson uses scikit-image's, and the numbers of this section are missing.

# %% tags=["long"]
HAAR_FOLDER = getattr(getattr(cv2, "data", None), "haarcascades", "")
HAAR_FILE = Path(HAAR_FOLDER) / "haarcascade_frontalface_default.xml"
HAS_HAAR = hasattr(cv2, "CascadeClassifier") and HAAR_FILE.is_file()


def read_cascade(path):
    """[(threshold, [(boxes, limit, below, above), ...]), ...]: the stages and their weak classifiers."""
    root = ET.parse(path).getroot()[0]
    features = [[[int(float(number)) for number in box.text.split()] for box in feature.find("rects")]
                for feature in root.find("features")]
    stages = []
    for stage in root.find("stages"):
        weak = []
        for classifier in stage.find("weakClassifiers"):
            _, _, number, limit = classifier.find("internalNodes").text.split()
            leaves = np.array(classifier.find("leafValues").text.split(), np.float32)
            weak.append((features[int(number)], np.float32(limit), *leaves))
        stages.append((float(stage.find("stageThreshold").text), weak))
    return stages


stages = read_cascade(HAAR_FILE) if HAS_HAAR else [(0.0, [])]
print(len(stages), "stages,", sum(len(weak) for _, weak in stages), "weak classifiers")
print("first stage:", len(stages[0][1]), "weak classifiers")
for _, limit, below, above in stages[0][1][:1]:
    print(f"first feature below {limit:.3f}: {below:.2f}, else {above:.2f}")

# %% [markdown]
# To look at all windows at once, `rows` and `cols` are arrays: one number for each window. An image with strong contrast has larger features than a faint one. So each feature is divided by two numbers: by the standard deviation of the window's inner 22 × 22 pixels, and by their number, 484.

# %% tags=["long"]
def box_sums(sums, rows, cols, left, top, width, height):
    """The sum of one box in many windows."""
    first_row, first_col = rows + top, cols + left
    last_row, last_col = first_row + height, first_col + width
    return (sums[last_row, last_col] - sums[first_row, last_col]
            - sums[last_row, first_col] + sums[first_row, first_col])


def surviving_windows(gray, stages, step=1):
    """Rows and columns of the accepted windows, and how many were left after each stage."""
    sums, squares = cv2.integral2(gray)
    sums, squares = sums.astype(np.int64), squares.astype(np.int64)
    rows, cols = np.mgrid[0:gray.shape[0] - 23:step, 0:gray.shape[1] - 23:step].reshape(2, -1)
    inside = (1, 1, 22, 22)
    # 484 * sum of squares - square of the sum = (484 * standard deviation) ** 2
    variance = (484 * box_sums(squares, rows, cols, *inside)
                - box_sums(sums, rows, cols, *inside) ** 2)
    scale = np.sqrt(np.maximum(variance, 1))
    left = [len(rows)]
    for threshold, weak in stages:
        votes = np.zeros(len(rows), np.float32)
        for boxes, limit, below, above in weak:
            value = sum(weight * box_sums(sums, rows, cols, *box) for *box, weight in boxes)
            votes += np.where(value / scale < limit, below, above)
        kept = votes >= threshold - 1e-4
        rows, cols, scale = rows[kept], cols[kept], scale[kept]
        left.append(len(rows))
    return rows, cols, left

# %% [markdown]
# The photograph has 512 × 512 pixels, so there are 489 × 489 = 239,121 windows. **Predict** how many percent of them are left after the first stage, which has only 9 weak classifiers.

# %% role="predict"
guess_first = None  # your guess: how many percent?

# %%
rows, cols, left = surviving_windows(portrait, stages)
print(left[:6], "...", left[-1])
compare_guess(guess_first, round(100 * left[1] / left[0]), "%")

# %%
figure = Figure(figsize=(8, 2.8), layout="constrained")
axes = figure.subplots()
axes.bar(range(len(left)), left, color="b")
axes.set(xlabel="stage", ylabel="windows left", yscale="log")
axes.grid(axis="y")
show_figure(figure, text="faces/stages")

# %%
# Check: the numbers in this section
assert votes.tolist() == [3.5, -3, 1] and left[0] == 489 * 489 == 239_121
assert not HAS_HAAR or (len(stages) == 25 and sum(len(weak) for _, weak in stages) == 2913 and len(stages[0][1]) == 9)
assert not HAS_HAAR or [tuple(box) for box in stages[0][1][0][0]] == list(first_feature)
assert not HAS_HAAR or (left[1:6] == [93059, 46014, 27506, 14954, 9068] and left[-1] == 11)

# %% [markdown]
# After five stages, most windows are gone, and they have cost only a few features each. Only the windows that look like a face go through all 2913. The detector is fast because it rejects early.
#
# Is our cascade the one of OpenCV? `detectMultiScale` with `minNeighbors=0` gives all accepted windows. It goes in steps of two pixels; so do we, in the small image of 144 × 144 pixels. (To save time, OpenCV also leaves out the next window after one that the first stage rejects. So in some images our cascade accepts a window more.)

# %%
haar = cv2.CascadeClassifier(str(HAAR_FILE)) if HAS_HAAR else None
rows, cols, _ = surviving_windows(small, stages, step=2)
by_hand = sorted(zip(rows.tolist(), cols.tolist(), strict=True))
print("by hand:", by_hand if HAS_HAAR else "no cascade")
if HAS_HAAR:
    boxes = haar.detectMultiScale(small, scaleFactor=100.0, minNeighbors=0,
                                  minSize=(24, 24), maxSize=(24, 24))
    by_opencv = sorted((top, left) for left, top, _, _ in boxes.tolist())
    print("OpenCV: ", by_opencv)

# %%
# Check: window for window the same
assert not HAS_HAAR or by_hand == by_opencv == [(20, 48), (20, 50), (20, 52)]

# %% [markdown]
# A face can be larger than 24 pixels. So OpenCV makes the image smaller again and again (`scaleFactor=1.1`: by 10 % each time), and looks for 24 × 24 pixels in each of them. A real face is accepted in many windows beside each other. Windows that nearly agree are one group; a group with fewer than `minNeighbors` others is dropped.

# %% tags=["long"]
def find_faces(gray, neighbours=4):
    """[(left, top, width, height), ...] of what the detector takes for a face."""
    if haar is not None:
        boxes = haar.detectMultiScale(gray, scaleFactor=1.1, minNeighbors=neighbours, minSize=(40, 40))
        return [tuple(int(number) for number in box) for box in boxes]
    cascade = Cascade(data.lbp_frontal_face_cascade_filename())  # OpenCV 5
    boxes = cascade.detect_multi_scale(gray, scale_factor=1.2, step_ratio=1, min_size=(40, 40),
                                       max_size=gray.shape[:2], min_neighbor_number=neighbours)
    return [(box["c"], box["r"], box["width"], box["height"]) for box in boxes]


def with_boxes(gray, boxes):
    view = cv2.cvtColor(gray, cv2.COLOR_GRAY2BGR)
    for left, top, width, height in boxes:
        cv2.rectangle(view, (left, top), (left + width, top + height), (0, 255, 0), 2)
    return view


every_window, groups = find_faces(portrait, 0), find_faces(portrait, 4)
print(len(every_window), "windows,", len(groups), "group")
show([with_boxes(portrait, every_window), with_boxes(portrait, groups)],
     ["minNeighbors=0", "minNeighbors=4"], text="faces/neighbours")

# %%
# Check: the numbers in this section
assert not HAS_HAAR or len(every_window) == 44
assert not HAS_HAAR or len(groups) == 1  # OpenCV 5: scikit-image's cascade finds two more

# %% [markdown]
# scikit-image contains another cascade, with local binary patterns (section 6) instead of Haar features. It finds the astronaut too.

# %%
lbp_cascade = Cascade(data.lbp_frontal_face_cascade_filename())
found = lbp_cascade.detect_multi_scale(portrait, scale_factor=1.2, step_ratio=1,
                                       min_size=(60, 60), max_size=(123, 123))
print("faces:", len(found))

# %%
# Check: it is the astronaut's; how large the box is depends on the processor by some pixels
middle = [found[0][start] + found[0][size] / 2 for start, size in (("r", "height"), ("c", "width"))]
assert len(found) == 1 and np.abs(np.subtract(middle, (116, 222))).max() < 5

# %% [markdown]
# **Planned failure.** In the recorded drive, a person walks past, but nobody looks at the camera: there is no face in any of its 90 frames. **Predict** how many faces `find_faces` finds in the frames 0, 30 and 66 together.

# %% role="predict"
guess_alarms = None  # your guess: how many?

# %%
alarms = {k: find_faces(to_gray(recording.frame(k))) for k in (0, 30, 66)}
print(alarms)
compare_guess(guess_alarms, sum(map(len, alarms.values())))

# %%
views = []
for k, rows, cols in ((30, slice(150, 420), slice(400, 800)), (66, slice(200, 470), slice(130, 530))):
    view = recording.frame(k).copy()
    for left, top, width, height in alarms[k]:
        cv2.rectangle(view, (left, top), (left + width, top + height), (0, 255, 0), 3)
    views.append(view[rows, cols])
show(views, ["frame 30", "frame 66"], text="faces/alarm")

# %%
# Check: the numbers in this section
assert not HAS_HAAR or [len(alarms[k]) for k in (0, 30, 66)] == [0, 1, 1]

# %% [markdown]
# A sign and a plant: a dark strip between two brighter ones, as at the eyes of a face. In all 90 frames together, there are 33 such errors; with `minNeighbors=10` there are still 9. (The benchmark `faces` of this course counted them, with the same settings.) A detector always answers; it does not know how rare faces are here. So count its *[[term:false positive|false positives]]* where the robot will work, and not where somebody else took photographs.

# %% [markdown]
# This is a good place for a pause.
#
# ## 5 · Eigenfaces ([[minutes]])
#
# Now that a face is found: whose is it? A gray image of 64 × 64 pixels is a vector of 4096 numbers. But faces are alike: most of the 4096 numbers say nothing about the person. So we describe a face by a few numbers: how it differs from the **mean face**, in the directions in which faces differ most.
#
# First with two numbers instead of 4096. The mean is (5, 5), and there is one direction, with the length 1. `@` multiplies number by number and adds up: it gives how far we must go along the direction to come as near as possible to the vector.

# %%
mean = np.array([5.0, 5])
directions = np.array([[0.8, 0.6]])  # one direction in each row
vector = np.array([7.0, 9])
weights = directions @ (vector - mean)
rebuilt = mean + weights @ directions
print("weights", weights, "rebuilt", rebuilt, "left over", (vector - rebuilt).round(2))

# %% [markdown]
# One weight describes the vector (it has nothing to do with the weights of the boxes), but not completely: (−1.2, 1.6) is left over. The *[[term:residue]]* is the length (L2 norm) of what is left over.
#
# **Predict** the residue.

# %% role="predict"
guess_residue = None  # your guess: which number?

# %%
length = np.sqrt(((vector - rebuilt) ** 2).sum())
compare_guess(guess_residue, round(length, 2))

# %% [markdown]
# With more directions, it is the same code. `weights` has one number for each direction, and `weights @ directions` adds up all directions, each times its weight:

# %%
two_directions = np.array([[0.6, 0.8, 0.0],
                           [0.0, 0.0, 1.0]])
print(two_directions @ np.array([10.0, 5, 2]))  # two weights
print(np.array([10.0, 2]) @ two_directions)     # 10 times the first + 2 times the second

# %%
# Check: the numbers in this section
assert weights.round(9).tolist() == [4] and rebuilt.round(9).tolist() == [8.2, 7.4] and round(length, 9) == 2
assert (two_directions @ np.array([10.0, 5, 2])).round(9).tolist() == [10, 2]

# %% [markdown]
# ### Your turn: the residue
#
# Write `residue(vector, mean, directions)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `vector`, `mean`: (D,) float; `directions`: (k, D) float, one direction in each row, each of length 1, at right angles to each other | one float: the L2 norm of what is left over when the vector is rebuilt from the mean and its k weights | `residue(vector, mean, directions)` returns the length above |

# %% role="exercise"
exercise(
    "faces-residue",
    title="The residue",
    function="residue",
    tolerance=1e-6,
    hint="weights = directions @ (vector - mean). Rebuild with the mean and all directions; then the L2 norm of vector - rebuilt, not rounded.",
    hints=(
        "Which two vectors do you compare at the end, and how do you get the second one from the weights?",
        "1. The weights: the directions times (vector minus mean).\n"
        "2. Rebuild the vector: the mean, plus the directions, each times its weight.\n"
        "3. Subtract it from the vector.\n"
        "4. The root of the sum of the squares.",
        "weights = directions @ (vector - ...)\nrebuilt = mean + weights @ ...\nreturn float(np.sqrt(((vector - ...) ** 2).sum()))",
    ),
    explanation="The mean is subtracted before the weights are computed, and added when the vector is rebuilt. With all D directions"
    " nothing would be left over.",
    another_way="np.linalg.norm(vector - rebuilt) is the same length.",
)


HALVES = np.array([[1, 1, 1, 1, 0, 0], [1, -1, 1, -1, 0, 0], [0, 0, 0, 0, 1.2, 1.6], [1, 1, -1, -1, 0, 0]]) / 2


def face(rng, count, repeat=1):
    """A vector, a mean and some directions; whole numbers, so that no result depends on rounding."""
    directions = np.kron(HALVES[rng.permutation(4)[:count]], np.ones(repeat)) / np.sqrt(repeat)
    columns = rng.permutation(6 * repeat)
    vector, mean = rng.integers(3, 60, (2, 6 * repeat)).astype(float)
    return vector, mean, directions[:, columns]


# %% role="answer"
def residue(vector, mean, directions):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    rebuilt = mean + weights @ directions
    return float(np.sqrt(((vector - rebuilt) ** 2).sum()))

# %% role="check"
check("faces-residue", residue)

# %% role="case" title="one and two directions" points=1
def inputs(rng):
    return [face(rng, 2), face(rng, 1)]


# %% role="case" title="three directions" points=1 hint="Are all directions added, each times its own weight?"
def inputs(rng):
    return [face(rng, 3), face(rng, 3)]


# %% role="hidden" title="longer vectors" points=1 hint="Subtract the mean first; rebuild with the mean; take the root of the sum of squares."
def inputs(rng):
    return [face(rng, 3, repeat=4), face(rng, 2, repeat=4)]


# %% [markdown]
# Which directions? Those in which the faces of our 30 people differ most. `np.linalg.svd` computes them, the most important one first (the *singular value decomposition*; how it does this is not part of this lesson). Directions of faces are called *[[term:eigenface|eigenfaces]]*: each can be drawn as an image.

# %%
def photo(identity, side_light=0.0, yaw=0.0, light=1.0, noise=1.0, seed=0):
    """A gray image of a drawn face: (64, 64) uint8."""
    gray = to_gray(draw_face(identity, 64, side_light, yaw)) * light
    gray = gray + np.random.default_rng(seed).normal(0, noise, gray.shape)
    return np.clip(gray, 0, 255).round().astype(np.uint8)


known = np.array([photo(identity, seed=number) for number, identity in enumerate(people)])
vectors = known.reshape(30, -1).astype(float)
mean_face = vectors.mean(axis=0)
eigenfaces = np.linalg.svd(vectors - mean_face, full_matrices=False)[2]
print(vectors.shape, mean_face.shape, eigenfaces.shape)

# %% tags=["nbval-ignore-output"]
def as_image(eigenface):
    scaled = 128 + 127 * eigenface / abs(eigenface).max()
    return scaled.reshape(64, 64).round().astype(np.uint8)


views = [mean_face.reshape(64, 64).round().astype(np.uint8), *map(as_image, eigenfaces[:5])]
show([cv2.resize(view, (192, 192), interpolation=cv2.INTER_NEAREST) for view in views],
     ["mean", "1", "2", "3", "4", "5"], columns=3, text="faces/eigenfaces")

# %%
# Check: the eigenfaces have length 1 and are at right angles to each other
assert eigenfaces.shape == (30, 4096)
assert abs(eigenfaces[:29] @ eigenfaces[:29].T - np.eye(29)).max() < 1e-9

# %% [markdown]
# To recognise a new image, we compute its weights, and take the known person whose weights are nearest (as in [[recognising_objects#3]]). The known images are called the *gallery*, and the share of new images for which the nearest one is the right person the *rank-1 accuracy*. We draw a new image of each person, in the same light, and have all the truth.

# %%
def pixel_vector(gray):
    return gray.ravel().astype(float)


def eigenface_weights(gray):
    return eigenfaces[:20] @ (gray.ravel() - mean_face)


def number_right(describe, images):
    """How many of the 30 new images have the right person as the nearest one of the gallery."""
    gallery = np.array([describe(gray) for gray in known])
    new = np.array([describe(gray) for gray in images])
    distances = ((new[:, None] - gallery) ** 2).sum(axis=2)
    return int((distances.argmin(axis=1) == np.arange(30)).sum())


# %%
same_light = [photo(identity, seed=100 + number) for number, identity in enumerate(people)]
print("eigenfaces:", number_right(eigenface_weights, same_light), "of 30 right")
print("pixels:", number_right(pixel_vector, same_light), "of 30 right")

# %%
# Check: everybody is recognised
assert number_right(eigenface_weights, same_light) == number_right(pixel_vector, same_light) == 30

# %% [markdown]
# In other light it is not so easy: section 6 measures it.
#
# **Planned failure.** The residue can tell a face from something else: something that is no face cannot be rebuilt from eigenfaces, so its residue is large. We try it with real images. scikit-image has 100 small photographs of faces and 100 parts of photographs without a face (`lfw_subset`, from a data set of people in the news). As far as we know, nobody asked these people, so this lesson computes with them, and shows none of them. First, each crop gets the mean 0 and the standard deviation 1, so that its brightness and contrast do not count. Then we learn eigenfaces from the first 50 faces.

# %%
crops = data.lfw_subset().reshape(200, -1).astype(float)
spread = crops.std(axis=1, keepdims=True)
crops = (crops - crops.mean(axis=1, keepdims=True)) / np.where(spread > 0, spread, 1)
real_mean = crops[:50].mean(axis=0)
real_eigenfaces = np.linalg.svd(crops[:50] - real_mean, full_matrices=False)[2]
print(crops.shape, real_eigenfaces.shape)


def residues(vectors, count):
    differences = vectors - real_mean
    directions = real_eigenfaces[:count]
    left_over = differences - differences @ directions.T @ directions
    return np.sqrt((left_over ** 2).sum(axis=1))

# %% [markdown]
# We compare each of the other 50 faces with each of the 100 crops without a face. With 5 eigenfaces, the face has the smaller residue in 95 % of these 5000 pairs. **Predict** in how many percent of the pairs with 40 eigenfaces.

# %% role="predict"
guess_more = None  # your guess: how many percent?

# %%
shares = {}
for count in (5, 40):
    faces_residue, others_residue = residues(crops[50:100], count), residues(crops[100:], count)
    shares[count] = round(100 * (faces_residue[:, None] < others_residue).mean())
    if count == 5:
        print("with 5 eigenfaces:", shares[count], "%")
compare_guess(guess_more, shares[40], "%")

# %%
# Check: the numbers in this section, and that they are far from a rounding
assert shares == {5: 95, 40: 71}

# %% [markdown]
# More eigenfaces tell less. A few eigenfaces can rebuild faces, and hardly anything else; so a large residue says that something is no face. With 40 of them, a curtain is rebuilt quite well too, and its residue is also small.

# %% [markdown]
# ## 6 · Local binary patterns ([[minutes]], deeper)
#
# A lamp at the side makes one half of a face dark. Each gray level changes, and so do the weights of the eigenfaces. But the eye is still darker than the skin beside it. A *[[term:local binary pattern]]*, LBP, keeps only this. For each of the 8 neighbours of a pixel: is the neighbour **at least as bright** as the pixel (`>=`)? Each yes adds a number. The numbers go clockwise, from the upper left:
#
# | left | middle | right |
# |---|---|---|
# | 1 | 2 | 4 |
# | 128 | the pixel | 8 |
# | 64 | 32 | 16 |
#
# So each pixel gets a code from 0 to 255. Here is a pixel (50) with its neighbours:

# %%
patch = np.array([[90, 50, 50],
                  [10, 50, 20],
                  [30, 40, 70]], np.uint8)
print(patch)

# %% [markdown]
# **Predict** the code of the pixel in the middle.

# %% role="predict"
guess_code = None  # your guess: a number from 0 to 255

# %%
answers = patch >= patch[1, 1]
print(answers)
code = 1 * answers[0, 0] + 2 * answers[0, 1] + 4 * answers[0, 2] + 8 * answers[1, 2]
code += 16 * answers[2, 2] + 32 * answers[2, 1] + 64 * answers[2, 0] + 128 * answers[1, 0]
compare_guess(guess_code, int(code))

# %% [markdown]
# For a whole image we cut out slices of equal shape: all pixels that have eight neighbours, and their neighbours on one side. For the neighbours on the right, which add 8:

# %%
gray = np.array([[10, 20, 30, 40],
                 [50, 10, 60, 60],
                 [70, 80, 90, 20]], np.uint8)
pixels = gray[1:-1, 1:-1]
right_neighbours = gray[1:-1, 2:]
print(pixels, right_neighbours)
print(8 * (right_neighbours >= pixels))

# %%
# Check: the numbers in this section
assert code == 1 + 2 + 4 + 16 and (8 * (right_neighbours >= pixels)).tolist() == [[8, 8]]

# %% [markdown]
# Never subtract here: the pixels are uint8, and 10 − 20 is 246, so every answer would be yes.
#
# ### Your turn: the LBP codes
#
# Write `lbp_codes(gray)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `gray`: (H, W) uint8, at least 3 × 3 pixels | (H − 2, W − 2) uint8: the code of each pixel that has eight neighbours. The type counts: uint8 | `lbp_codes(patch)` returns the code above, as an array with one row and one column |

# %% role="exercise"
exercise(
    "faces-lbp",
    title="The LBP codes",
    function="lbp_codes",
    exact_type=True,
    hint="For each of the eight neighbours: its number where neighbour >= pixel. Clockwise from the upper left: 1, 2, 4, 8, 16, 32, 64, 128.",
    hints=(
        "Which slice of the image are the upper left neighbours of all pixels, and what do they add?",
        "1. The pixels with eight neighbours: gray without the outermost rows and columns.\n"
        "2. For each of the eight neighbours the slice of the same shape, moved by one row or column or both.\n"
        "3. Where the neighbour is at least as bright as the pixel, add 1, 2, 4, ..., 128.\n"
        "4. Return uint8.",
        "pixels = gray[1:-1, 1:-1]\ncodes = np.zeros(pixels.shape, int)\ncodes += 1 * (gray[:-2, :-2] >= pixels)\n"
        "codes += 2 * (gray[:-2, 1:-1] >= pixels)\ncodes += 4 * (gray[:-2, ...] >= pixels)\n... (five more, clockwise)\n"
        "return codes.astype(np.uint8)",
    ),
    explanation="Eight comparisons of whole slices. A comparison gives True or False, which count as 1 and 0 when they are multiplied.",
    another_way="Two loops over the inner pixels, with the eight comparisons inside, give the same codes.",
)


def levels(rng, rows, cols):
    """Few gray levels, so that many neighbours are equal."""
    return rng.choice(np.array([20, 60, 61, 130, 200, 255], np.uint8), (rows, cols))

# %% role="answer"
def lbp_codes(gray):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def lbp_codes(gray):
    pixels = gray[1:-1, 1:-1]
    neighbours = [
        gray[:-2, :-2], gray[:-2, 1:-1], gray[:-2, 2:], gray[1:-1, 2:],
        gray[2:, 2:], gray[2:, 1:-1], gray[2:, :-2], gray[1:-1, :-2],
    ]
    codes = np.zeros(pixels.shape, int)
    for number, neighbour in enumerate(neighbours):
        codes += 2**number * (neighbour >= pixels)
    return codes.astype(np.uint8)

# %% role="check"
check("faces-lbp", lbp_codes)

# %% role="case" title="small images" points=1
def inputs(rng):
    return [(levels(rng, 4, 5),), (levels(rng, 6, 4),)]


# %% role="case" title="equal neighbours" points=1 hint="A neighbour that is equal to the pixel counts too: >=."
def inputs(rng):
    return [(levels(rng, 5, 6),), (levels(rng, 5, 5),)]


# %% role="hidden" title="any image" points=1 hint="Neighbour >= pixel; clockwise from the upper left: 1, 2, 4, 8, 16, 32, 64, 128."
def inputs(rng):
    return [(levels(rng, 7, 8),), (levels(rng, 8, 6),)]


# %% [markdown]
# If you are not finished, do not read the next cell yet: it has the same in another way. Then come the codes of one person in two kinds of light.

# %%
NEIGHBOURS = ((-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1))


def patterns(gray):
    codes = np.zeros(gray.shape, np.uint8)
    for number, (down, right) in enumerate(NEIGHBOURS):
        moved = np.roll(gray, (-down, -right), axis=(0, 1))
        codes |= (moved >= gray).astype(np.uint8) << number  # << number: times 2 ** number
    return codes[1:-1, 1:-1]

# %%
front, side = photo(people[6], noise=0), photo(people[6], side_light=0.6, noise=0)
show([front, side, patterns(front), patterns(side)],
     ["front light", "side light", "codes", "codes"], columns=2, text="faces/codes")

# %% [markdown]
# scikit-image's `local_binary_pattern` interpolates the diagonal neighbours on a circle, so only its straight neighbours agree with ours. Its neighbours also have another order.
#
# A code at one pixel changes if the face moves by a pixel. So we divide the image of codes into 8 × 8 parts and count, in each part, how often each code occurs: a histogram, as in HOG. Again the square root makes large counts count less. **Predict** of how many numbers this description of a face consists.

# %% role="predict"
guess_length = None  # your guess: how many numbers?

# %%
def lbp_vector(gray):
    """The histograms of 8 × 8 parts of the codes, as square roots of the counts."""
    parts = [part for rows in np.array_split(patterns(gray), 8)
             for part in np.array_split(rows, 8, axis=1)]
    counts = [np.bincount(part.ravel(), minlength=256) for part in parts]
    return np.sqrt(np.concatenate(counts))


compare_guess(guess_length, len(lbp_vector(front)))

# %% [markdown]
# The exam: 30 people, five kinds of new images of each, three descriptions. The nearest image of the gallery wins.

# %%
kinds = {"same light": {}, "dim light": {"light": 0.6}, "side light": {"side_light": 0.6},
         "turned": {"yaw": 0.2}, "noise": {"noise": 8.0}}
images = {kind: [photo(identity, seed=100 + number, **settings)
                 for number, identity in enumerate(people)]
          for kind, settings in kinds.items()}

# %% [markdown]
# **Predict** how many of the 30 people are recognised by their pixels in side light.

# %% role="predict"
guess_side = None  # your guess: how many of 30?

# %%
compare_guess(guess_side, number_right(pixel_vector, images["side light"]))

# %%
describers = {"pixels": pixel_vector, "eigenfaces": eigenface_weights, "LBP": lbp_vector}
right = {name: [number_right(describe, images[kind]) for kind in kinds]
         for name, describe in describers.items()}
for name, numbers in right.items():
    print(f"{name:10}", *(f"{kind} {number}," for kind, number in zip(kinds, numbers, strict=True)))

# %%
figure = Figure(figsize=(8, 3), layout="constrained")
axes = figure.subplots()
places = np.arange(5)
for shift, name, colour in (
        (-0.27, "pixels", "0.6"), (0, "eigenfaces", "orange"), (0.27, "LBP", "b")):
    axes.bar(places + shift, right[name], 0.25, label=name, color=colour)
axes.set_xticks(places, list(kinds))
axes.set(ylabel="right, of 30", ylim=(0, 39), yticks=(0, 10, 20, 30))
axes.legend(loc="upper center", ncols=3)
show_figure(figure, text="faces/scores")

# %%
# Check: the numbers in this section
assert right == {"pixels": [30, 3, 11, 27, 30], "eigenfaces": [30, 2, 8, 27, 30], "LBP": [30, 30, 26, 20, 10]}
assert len(lbp_vector(front)) == 16_384
assert patterns(front).dtype == np.uint8 and lbp_vector(front).dtype == np.float64
normalised = [pixel_vector(gray) - gray.mean() for gray in [*known, *images["dim light"]]]
normalised = np.array([vector / vector.std() for vector in normalised])
assert (((normalised[30:, None] - normalised[:30]) ** 2).sum(axis=2).argmin(axis=1) == np.arange(30)).all()
blurred = [np.array([lbp_vector(cv2.blur(gray, (3, 3))) for gray in group]) for group in (known, images["noise"])]
assert (((blurred[1][:, None] - blurred[0]) ** 2).sum(axis=2).argmin(axis=1) == np.arange(30)).sum() > 25

# %% [markdown]
# Two planned failures in one figure. Dim light and side light defeat pixels and eigenfaces, and not LBP. Dim light changes the order of hardly any two neighbours. Side light changes most codes, but enough of them stay: the histograms are still nearest to those of the right person. But noise defeats LBP, and not the others: on smooth skin, noise decides which neighbour is brighter. (Two remedies to try: for dim light, subtract from each image its mean and divide by its standard deviation; for noise, blur a little before the codes.) And a turned head moves the mouth and the eyes into other parts. No description is best for all; say in which light a score was measured.

# %% [markdown]
# ## 7 · What may a robot keep? ([[minutes]])
#
# A home robot sees who is at home, when, with whom, and in what state. People who live there, guests and children did not all agree to this. Before you store or send images of people, ask:
#
# - **Do I need it?** To drive around a person, a robot needs a place on the floor, and no face. What is not stored cannot be lost, stolen or sold.
# - **Do they know, and did they agree?** Everybody in the image, guests too. They may say no later, and then you delete it.
# - **How long, and who can see it?** Say when it is deleted. Keep it on the robot, not on somebody's server.
# - **Is it really anonymous?** A voice, clothes, the room and the time also tell who it is.
#
# In the European Union, a face in an image is *personal data*. Numbers that serve to recognise a person, such as our weights and our LBP histograms, are *[[term:biometric data]]*: the General Data Protection Regulation (Article 9) forbids their use, with few exceptions such as explicit consent. It does not cover purely private use at home, but the four questions do. Other countries have other laws.
#
# So hide faces **before** anything is stored or sent, not afterwards. A usual way is a *mosaic*: the box of the face is divided into blocks, and each block gets one colour, the mean of its pixels. In an image with one channel, with blocks of 2 × 2 pixels:

# %%
part = np.array([[10, 20, 100, 100, 7],
                 [30, 40, 100, 140, 9],
                 [50, 50, 60, 80, 1]])
first_block = part[0:2, 0:2]
print(first_block.mean())
print(part[0:2, 4:6].mean(), part[2:4, 0:2].mean())  # blocks at the border are smaller
print(list(range(0, 5, 2)))  # where the columns of blocks begin

# %% [markdown]
# A colour has three numbers: `.mean(axis=(0, 1))` is the mean over rows and columns, one number for each channel. And a box can reach over the border of the image. **Predict** how many pixels of an image of 5 × 5 pixels lie in the box left −2, top 3, width 4, height 4.

# %% role="predict"
guess_inside = None  # your guess: how many pixels?

# %%
left, top, width, height = -2, 3, 4, 4
first_row, last_row = max(top, 0), min(top + height, 5)
first_col, last_col = max(left, 0), min(left + width, 5)
inside = np.zeros((5, 5))[first_row:last_row, first_col:last_col]
compare_guess(guess_inside, inside.size)

# %%
# Check: the numbers in this section
assert first_block.mean() == 25 and part[0:2, 4:6].mean() == 8 and part[2:4, 0:2].mean() == 50 and inside.size == 4

# %% [markdown]
# ### Your turn: the mosaic
#
# Write `hide_boxes(frame, boxes, size)`.
#
# | Input | Output | Example call |
# |---|---|---|
# | `frame`: (H, W, 3) uint8; `boxes`: a list of boxes (left, top, width, height) that do not overlap, some partly outside the image; `size`: side of a block, in pixels | a new (H, W, 3) uint8 image. Each box is first cut to the image. Its blocks begin at its upper left corner; the last ones may be smaller. Each block gets the mean of its pixels (in each channel; a difference of 1 is accepted). All other pixels stay as they are. The type counts: uint8 | `hide_boxes(recording.frame(0), [(600, 200, 64, 64)], 16)` |

# %% role="exercise"
exercise(
    "faces-anonymise",
    title="The mosaic",
    function="hide_boxes",
    tolerance=1.0,
    exact_type=True,
    hint="Copy the frame; cut each box to the image; go through its blocks with range(first, last, size); each block gets its mean(axis=(0, 1)).",
    hints=(
        "Where does a block end if it is the last one of its row of blocks, and where does a box end that reaches over the border?",
        "1. A copy of the frame.\n"
        "2. For each box: its first and last row and column inside the image.\n"
        "3. Two loops over the first rows and the first columns of the blocks.\n"
        "4. A block ends after size rows, or where the box ends.\n"
        "5. Put the mean of the block, for each channel, into the copy.",
        "result = frame.copy()\nfor left, top, width, height in boxes:\n"
        "    last_row, last_col = min(top + height, frame.shape[0]), min(...)\n"
        "    for row in range(max(top, 0), last_row, size):\n        for col in range(max(left, 0), ..., size):\n"
        "            end_row, end_col = min(row + size, last_row), min(...)\n"
        "            result[row:end_row, col:end_col] = frame[row:end_row, col:end_col].mean(axis=(0, 1)).round()\nreturn result",
    ),
    explanation="max(..., 0) matters most: a negative index counts from the other side of the image, and then the face would stay visible."
    " The end of a slice may be too large, but the box must not grow over its own border.",
    another_way="cv2.resize of the part with INTER_AREA, and back with INTER_NEAREST, gives the same if the blocks fill the box exactly.",
)


def view(rng, rows, cols):
    return rng.integers(0, 256, (rows, cols, 3), dtype=np.uint8)

# %% role="answer"
def hide_boxes(frame, boxes, size):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution"
def hide_boxes(frame, boxes, size):
    result = frame.copy()
    for left, top, width, height in boxes:
        last_row = min(top + height, frame.shape[0])
        last_col = min(left + width, frame.shape[1])
        for row in range(max(top, 0), last_row, size):
            for col in range(max(left, 0), last_col, size):
                end_row, end_col = min(row + size, last_row), min(col + size, last_col)
                block = frame[row:end_row, col:end_col]
                result[row:end_row, col:end_col] = block.mean(axis=(0, 1)).round()
    return result


# %% role="check"
check("faces-anonymise", hide_boxes)

# %% role="case" title="two faces" points=1
def inputs(rng):
    return [
        (view(rng, 10, 13), [(2, 1, 4, 6), (8, 3, 5, 4)], 2),
        (view(rng, 11, 12), [(1, 2, 5, 7), (7, 1, 4, 5)], 3),
    ]


# %% role="case" title="over the border" points=1 hint="Cut each box to the image first: max(..., 0), and min(..., height or width of the image)."
def inputs(rng):
    return [
        (view(rng, 9, 12), [(-2, -1, 7, 5), (8, 5, 7, 8)], 3),
        (view(rng, 8, 11), [(-3, 4, 6, 7), (6, -2, 8, 5)], 2),
    ]


# %% role="hidden" title="any boxes" points=2 hint="Are the boxes cut to the image, do the blocks begin at the corner of the box, and do they end where it ends?"
def inputs(rng):
    return [
        (view(rng, 14, 17), [(3, 2, 7, 5), (-1, 9, 9, 8), (12, 5, 9, 7)], 3),
        (view(rng, 12, 15), [(5, 3, 8, 7), (-4, -3, 7, 6)], 4),
    ]


# %% [markdown]
# Is a face behind a mosaic really hidden? A person cannot recognise it. But a program can make a mosaic of each image in its gallery too, and compare these. OpenCV makes the mosaic: smaller with `INTER_AREA`, and larger again.

# %%
def behind_mosaic(gray, size):
    small = cv2.resize(gray, None, fx=1 / size, fy=1 / size, interpolation=cv2.INTER_AREA)
    return cv2.resize(small, (64, 64), interpolation=cv2.INTER_NEAREST)


hidden = [behind_mosaic(photo(people[6]), size) for size in (4, 8, 16, 64)]
show(hidden, ["blocks of 4 pixels", "8", "16", "64"], columns=4, text="faces/mosaics")

# %% [markdown]
# With blocks of 16 pixels, 16 numbers are left of a face. **Predict** how many of the 30 people the program recognises from them, in the same light.

# %% role="predict"
guess_hidden = None  # your guess: how many of 30?

# %%
def right_behind_mosaic(size):
    return number_right(lambda gray: pixel_vector(behind_mosaic(gray, size)), same_light)


compare_guess(guess_hidden, right_behind_mosaic(16))

# %%
print({size: right_behind_mosaic(size) for size in (4, 16, 32, 64)})

# %%
# Check: the numbers in this section
assert [right_behind_mosaic(size) for size in (4, 16, 32, 64)] == [30, 30, 29, 19]

# %% [markdown]
# Even one single gray level, the mean of the whole face, tells 19 of 30 people apart (among only 30, in the same light). Blur has the same weakness. So our robot paints a colour over the face that does not depend on the face at all:

# %%
def paint_over(frame, boxes):
    """A new frame in which each box, with a border, is plain gray."""
    frame = frame.copy()
    for left, top, width, height in boxes:
        border = width // 4  # the hair and the chin too
        frame[max(top - border, 0):top + height + border,
              max(left - border, 0):left + width + border] = 120
    return frame

# %% [markdown]
# ## 8 · Hidden before it is stored ([[minutes]], deeper)
#
# The person in the room of our robot does not turn a face to the camera. So a node of ours, the *visitor*, draws a visitor into each image of the camera, who moves from the left to the right. The second node, the *anonymiser*, subscribes to these images. It looks for faces, paints over them, and publishes the result on a topic of its own. It does not know where the visitor is. `record` stores only the anonymiser's topic.

# %% tags=["long"]
if ros_available():
    from imgproc_course.messages import array_to_image, image_to_array
    from rclpy.node import Node
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import Image

    class VisitorNode(Node):
        """Draws a face into each image of the camera."""

        def __init__(self, identity, context=None):
            super().__init__("visitor", context=context)
            self.identity = identity
            self.sent = {}  # the image and the box of the face, by the stamp of the image
            self.images = self.create_publisher(Image, "~/image", qos_profile_sensor_data)
            self.create_subscription(Image, "/kachaka/front_camera/image_raw",
                                     self.on_image, qos_profile_sensor_data)

        def on_image(self, msg):
            left = 60 + 10 * len(self.sent) % 300
            frame = image_to_array(msg, "bgr8").copy()
            cv2.rectangle(frame, (left + 48, 215), (left + 92, 262), (85, 105, 135), -1)  # the neck
            cv2.ellipse(frame, (left + 70, 380), (110, 135), 0, 0, 360, (100, 70, 50), -1)  # the body
            frame, box = put_face(frame, self.identity, left, 100, 140)
            self.sent[msg.header.stamp.sec, msg.header.stamp.nanosec] = frame, box
            self.images.publish(array_to_image(frame, "bgr8", msg.header))

    class AnonymiserNode(Node):
        """Hides each face that it finds in the images of a topic, and publishes them."""

        def __init__(self, find_faces, hide, topic="/visitor/image", context=None):
            super().__init__("anonymiser", context=context)
            self.find_faces, self.hide = find_faces, hide
            self.frames = self.faces = 0
            self.images = self.create_publisher(Image, "~/image", qos_profile_sensor_data)
            self.create_subscription(Image, topic, self.on_image, qos_profile_sensor_data)

        def on_image(self, msg):
            frame = image_to_array(msg, "bgr8")
            boxes = self.find_faces(to_gray(frame))
            self.images.publish(array_to_image(self.hide(frame, boxes), "bgr8", msg.header))
            self.frames += 1
            self.faces += len(boxes)

# %% [markdown]
# The next cell needs some seconds. The recording goes into a folder that is deleted at the end.

# %% tags=["nbval-ignore-output", "long"]
if ros_available():
    live_camera = open_camera("room", rate=5)
    session = RosSession.current()
    visitor = session.add_node(VisitorNode(people[6], context=session.context))
    anonymiser = session.add_node(AnonymiserNode(find_faces, paint_over, context=session.context))
    with tempfile.TemporaryDirectory() as folder:
        with record("/anonymiser/image", f"{folder}/hidden"):
            end = time.monotonic() + 60
            while anonymiser.frames < 20 and time.monotonic() < end:
                time.sleep(0.1)
        live_camera.stop()
        session.remove_node(anonymiser)
        session.remove_node(visitor)
        with open_recording(f"{folder}/hidden") as stored:
            print("stored topics:", *stored.topics)
            messages = [stored.message(k) for k in range(len(stored))]
    print(len(messages), "images stored")

# %%
# Check: images were stored, of one topic only
assert not ros_available() or (len(messages) > 0 and list(stored.topics) == ["/anonymiser/image"])

# %% [markdown]
# How many of the stored images still show the face? We know where it was, so we compare: which share of the pixels of its box was not changed?

# %% tags=["nbval-ignore-output", "long"]
visible = []
if ros_available():
    for msg in messages:
        frame, (left, top, width, height) = visitor.sent[msg.header.stamp.sec, msg.header.stamp.nanosec]
        part = np.s_[top:top + height, left:left + width]
        same = (image_to_array(msg, "bgr8")[part] == frame[part]).all(axis=2)
        visible.append(same.mean())
    print("images with a face that is still visible:", sum(share > 0.5 for share in visible))
    first = visitor.sent[messages[0].header.stamp.sec, messages[0].header.stamp.nanosec][0]
    show([first, image_to_array(messages[0], "bgr8")], ["from the visitor", "stored"],
         text="faces/live")

# %%
# Check: each stored image was compared
assert not ros_available() or len(visible) == len(messages)

# %% [markdown]
# This visitor looks at the camera. **Predict** how many of our 30 people the detector finds if each of them turns the head by 0.5 radians (29 degrees).

# %% role="predict"
guess_turned = None  # your guess: how many of 30?

# %% tags=["nbval-ignore-output"]
found = {}
for yaw in (0.0, 0.5):
    views = [to_gray(draw_face(identity, 160, yaw=yaw)) for identity in people]
    found[yaw] = sum(len(find_faces(view)) > 0 for view in views)
print("looking at the camera:", found[0.0], "of 30")
compare_guess(guess_turned, found[0.5])

# %%
# Check: the numbers in this section; on another processor a face or two may be found or not
assert found[0.0] == 30 and 8 <= found[0.5] <= 18

# %% [markdown]
# **Planned failure.** About half of them stay visible, because the cascade learned from people who look at the camera. And in the room? The benchmark `faces` let this node run for a minute, with a visitor who came nearer, turned up to 20 degrees and stood in light from the side: of 302 stored images, the face was hidden in 250, hidden in part in 5, and visible in 47. To paint over what was found is a help, and not a guarantee. To store nothing is one.
#
# To use your own function, pass it to the node: `AnonymiserNode(find_faces, lambda frame, boxes: hide_boxes(frame, boxes, 40))`. With your own webcam, `open_camera("webcam")` publishes images on the same topic as the robot, and `AnonymiserNode(..., topic="/kachaka/front_camera/image_raw")` hides your face. Nothing is stored as long as you do not call `record`. Before you switch it on: does everybody who can be seen know it, and agree?

# %% [markdown]
# ## Recap
#
# An integral image gives the sum of any box with four numbers. A Haar feature compares boxes, and a cascade rejects most windows after a few features. Eigenfaces describe a face by its difference from the mean; LBP by the order of neighbouring gray levels. Each fails somewhere. And what shows a face need not be stored.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | identity | (12,) | float64 | | shares of the head; brightness |
# | integral image | (H + 1, W + 1) | int64 | 0 or more | gray levels |
# | Haar feature | one number | int | | gray levels |
# | eigenfaces | (30, 4096) | float64 | each of length 1 | |
# | residue | one number | float | 0 or more | gray levels |
# | LBP codes | (H − 2, W − 2) | uint8 | 0 to 255 | |
# | LBP vector | (16384,) | float64 | 0 or more | root of a count |
#
# **Next:** [[gestures]]. Before you go on, choose **File → Close and Shut Down Notebook**: otherwise this lesson continues to use the robot.

# %%
# Check: the numbers in the table
assert eigenfaces.dtype == np.float64
