# ---
# jupyter:
#   imgproc_course:
#     title: Faces
# ---

# %% [markdown]
# # Faces
#
# A home robot sees people every day. Where is a face? And what may the robot keep of it? In this lesson you build the parts of a face detector that most cameras used for years. At the end, you hide all faces that your detector finds, before anything is stored.
#
# A face is personal. So the people in this lesson do not exist: we draw their faces from numbers. The one face that you see of a real person is the photograph of an astronaut that NASA put into the public domain.
#
# **You will be able to**
# - compute the sum of any box of an image without adding up its pixels (integral image),
# - say what a Haar feature is, and explain how a cascade of them finds faces,
# - say when it fails,
# - hide faces in an image, and say what a robot may store.
#
# **Time** [[minutes]], with a pause after section 4. **You need** [[noise_removal]] and [[recognising_objects]]. Only the last part of section 6 needs ROS 2.

# %% role="given" exercise=["faces-integral", "faces-anonymise"]
import numpy as np

# %% tags=["long"]
import tempfile
import time
from pathlib import Path
from xml.etree import ElementTree as ET

import cv2
from skimage import data
from skimage.feature import Cascade

from imgproc_course.display import show
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
    "neighbours": (
        "Left: every window that the detector accepts. Right: the groups of at least five windows.",
        "Two images of an astronaut: on the left, many green squares lie around her face and a few ones elsewhere; on the right, one square lies around her face.",
    ),
    "alarm": (
        "Parts of two frames of the drive, and what the detector takes for a face there.",
        "Two parts of the living room: on the left a green square lies on the sign KITCHEN, on the right one lies on a plant under the table.",
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
# To measure a detector, we must know the truth. `random_identity` makes twelve numbers: how wide the head is, how far the eyes are apart, how dark the skin is, and so on. They are one person. `draw_face` draws this person, with light from the front or from the side, and turned a little (`yaw`) if we want.

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


# %% role="case" title="larger sums" points=1 hint="Are the sums int64? uint8 ends at 255, and uint16 at 65535: the sum of a large image is larger."
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
def feature_value(window, boxes):
    """The sum of each box times its weight, all added up."""
    value = 0
    for left, top, width, height, weight in boxes:
        value += weight * int(window[top:top + height, left:left + width].sum())
    return value


compare_guess(guess_plain, feature_value(np.full((24, 24), 100), first_feature))

# %%
value_on_face = feature_value(small[20:20 + 24, 52:52 + 24], first_feature)
print("on the face:", value_on_face)

# %%
# Check: the numbers in this section
assert feature_value(np.full((24, 24), 100), first_feature) == 0 and value_on_face == -2510

# %% [markdown]
# The eyes are darker than the forehead and the cheeks, so the value on the face is far below 0. With the integral image, each box needs four numbers, wherever the window is.

# %% [markdown]
# ## 4 · The cascade ([[minutes]])
#
# One feature finds no face: curtains and shelves also have dark strips. A *weak classifier* compares one feature with a limit and gives one of two numbers. A *stage* adds up the numbers of its weak classifiers, and rejects the window if the sum is below a threshold. Three windows, two weak classifiers, and a threshold of 1.5:

# %%
values = np.array([[-0.2, 0.1, -0.3],   # of one feature, in three windows
                   [0.4, -0.1, -0.1]])  # of another one
votes = (np.where(values[0] < -0.1, 2.0, -2.0)
         + np.where(values[1] < 0.2, -1.0, 1.5))
threshold = 1.5
print("sums:", votes, "left:", votes >= threshold)

# %% [markdown]
# Stages in a row are a *[[term:cascade]]*: a stage only looks at the windows that passed all stages before. OpenCV's cascade was learned from thousands of images. (OpenCV 5 has no such cascades; there this lesson uses scikit-image's, and the numbers of this section are missing.)

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
# Now all windows at once: `rows` and `cols` are arrays, one number for each window. In an image with strong contrast, all features are large. So each is divided by the standard deviation of the window's inner 22 × 22 pixels, and by their number, 484.

# %% tags=["long"]
def box_sums(sums, rows, cols, left, top, width, height):
    """The sum of one box in many windows, from four numbers as in section 2."""
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
# Check: the numbers in this section
assert votes.tolist() == [3.5, -3, 1] and left[0] == 489 * 489 == 239_121
assert not HAS_HAAR or (len(stages) == 25 and sum(len(weak) for _, weak in stages) == 2913 and len(stages[0][1]) == 9)
assert not HAS_HAAR or [tuple(box) for box in stages[0][1][0][0]] == list(first_feature)
assert not HAS_HAAR or (left[1:6] == [93059, 46014, 27506, 14954, 9068] and left[-1] == 11)

# %% [markdown]
# After five stages, most windows are gone, and they have cost only a few features each. The detector is fast because it rejects early.
#
# Is our cascade the one of OpenCV? `detectMultiScale` with `minNeighbors=0` gives all accepted windows. It goes in steps of two pixels; so do we, in the small image of 144 × 144 pixels.

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
# A face can be larger than 24 pixels. So OpenCV makes the image smaller again and again (`scaleFactor=1.1`: by 10 % each time), and looks for 24 × 24 pixels in each of them. A real face is accepted in many windows beside each other: they are one group. A group with fewer than `minNeighbors` others is dropped.

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
# **Planned failure.** In the recorded drive, a person walks past, but nobody looks at the camera: there is no face in any of its 90 frames. **Predict** how many faces `find_faces` finds in the frames 0, 30 and 66 together.

# %% role="predict"
guess_alarms = None  # your guess: how many?

# %%
alarms = {k: find_faces(to_gray(recording.frame(k))) for k in (0, 30, 66)}
print(alarms)
compare_guess(guess_alarms, sum(map(len, alarms.values())))

# %%
views = [with_boxes(to_gray(recording.frame(k)), alarms[k]) for k in (30, 66)]
show([views[0][150:420, 400:800], views[1][200:470, 130:530]], ["frame 30", "frame 66"], text="faces/alarm")

# %%
# Check: the numbers in this section
assert not HAS_HAAR or [len(alarms[k]) for k in (0, 30, 66)] == [0, 1, 1]

# %% [markdown]
# A sign and a plant: a dark strip between two brighter ones, as at the eyes of a face. In all 90 frames together, there are 33 such errors; with `minNeighbors=10` there are still 9. (The benchmark `faces` of this course counted them.) A detector always answers; it does not know how rare faces are here. So count its *[[term:false positive|false positives]]* where the robot will work.

# %% [markdown]
# This is a good place for a pause.
#
# ## 5 · What may a robot keep? ([[minutes]])
#
# A home robot sees who is at home, when, and with whom. People who live there, guests and children did not all agree to this. Before you store or send images of people, ask:
#
# - **Do I need it?** To drive around a person, a robot needs no face. What is not stored cannot be lost, stolen or sold.
# - **Do they know, and did they agree?** Guests too. They may say no later, and then you delete it.
# - **How long, and who can see it?** Say when it is deleted. Keep it on the robot, not on somebody's server.
# - **Is it really anonymous?** A voice, clothes, the room and the time also tell who it is.
#
# In the European Union, a face in an image is *personal data*. Numbers that serve to recognise a person are *[[term:biometric data]]*: the General Data Protection Regulation (Article 9) forbids their use, with few exceptions such as explicit consent. It does not cover purely private use at home, but the four questions do. Other countries have other laws.
#
# So hide faces **before** anything is stored or sent. A usual way is a *mosaic*: the box of the face is divided into blocks, and each block gets the mean of its pixels. In an image with one channel, with blocks of 2 × 2 pixels:

# %%
part = np.array([[10, 20, 100, 100, 7],
                 [30, 40, 100, 140, 9],
                 [50, 50, 60, 80, 1]])
first_block = part[0:2, 0:2]
print(first_block.mean())
print(part[0:2, 4:6].mean(), part[2:4, 0:2].mean())  # blocks at the border are smaller
print(list(range(0, 5, 2)))  # where the columns of blocks begin

# %% [markdown]
# In colour, `.mean(axis=(0, 1))` is the mean over rows and columns, one number for each channel. And a box can reach over the border of the image: of this one, only 4 pixels lie in an image of 5 × 5 pixels.

# %%
left, top, width, height = -2, 3, 4, 4
first_row, last_row = max(top, 0), min(top + height, 5)
first_col, last_col = max(left, 0), min(left + width, 5)
inside = np.zeros((5, 5))[first_row:last_row, first_col:last_col]
print("rows", first_row, "to", last_row - 1, "columns", first_col, "to", last_col - 1, "pixels", inside.size)

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


# %% role="case" title="over the border" points=1 hint="Cut each box to the image first: it ends at min(left + width, width of the image), with the given left, and begins at max(left, 0). So also for the rows."
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
# Is a face behind a mosaic really hidden? A program can make a mosaic of each image that it knows, too, and take the person whose mosaic is nearest. OpenCV makes the mosaic: smaller with `INTER_AREA`, and larger again.

# %%
def photo(identity, seed):
    """A gray image of a drawn face, with a little noise: (64, 64) uint8."""
    gray = to_gray(draw_face(identity, 64)) + np.random.default_rng(seed).normal(0, 1, (64, 64))
    return np.clip(gray, 0, 255).round().astype(np.uint8)


def behind_mosaic(gray, size):
    small = cv2.resize(gray, None, fx=1 / size, fy=1 / size, interpolation=cv2.INTER_AREA)
    return cv2.resize(small, (64, 64), interpolation=cv2.INTER_NEAREST)


hidden = [behind_mosaic(photo(people[6], seed=6), size) for size in (4, 8, 16, 64)]
show(hidden, ["blocks of 4 pixels", "8", "16", "64"], columns=4, text="faces/mosaics")

# %% [markdown]
# With blocks of 16 pixels, 16 numbers are left of a face. **Predict** how many of the 30 people the program recognises from them, in the same light.

# %% role="predict"
guess_hidden = None  # your guess: how many of 30?

# %%
def right_behind_mosaic(size):
    """How many of 30 new images are nearest to the known image of the same person."""
    known, new = (np.array([behind_mosaic(photo(identity, seed + number), size).ravel().astype(float)
                            for number, identity in enumerate(people)]) for seed in (0, 100))
    distances = ((new[:, None] - known) ** 2).sum(axis=2)
    return int((distances.argmin(axis=1) == np.arange(30)).sum())


compare_guess(guess_hidden, right_behind_mosaic(16))

# %%
print({size: right_behind_mosaic(size) for size in (4, 16, 32, 64)})

# %%
# Check: the numbers in this section
assert [right_behind_mosaic(size) for size in (4, 16, 32, 64)] == [30, 30, 29, 19]

# %% [markdown]
# Even one single gray level, the mean of the whole face, tells 19 of 30 people apart. Blur has the same weakness. So our robot paints over the face, with a colour that does not depend on it:

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
# ## 6 · Hidden before it is stored ([[minutes]], deeper)
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
# An integral image gives the sum of any box with four numbers. A Haar feature compares boxes, and a cascade rejects most windows after a few features. It fails where the light and the room are not those that it learned from. And what shows a face need not be stored.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | identity | (12,) | float64 | | shares of the head; brightness |
# | integral image | (H + 1, W + 1) | int64 | 0 or more | gray levels |
# | Haar feature | one number | int | | gray levels |
#
# **Next:** [[the_errand]], or the optional [[gestures]]. First choose **File → Close and Shut Down Notebook**: it frees the robot.
