# ---
# jupyter:
#   imgproc_course:
#     title: What is image processing?
#     minutes: 40
# ---

# %% [markdown]
# # 01 · What is image processing?
#
# A camera gives a robot 2.8 million numbers, ten times a second. None of them says "floor", "person" or "stop". Image processing is the work of getting from those numbers to something a robot can act on.
#
# **You will be able to**
# - say what a home robot uses pictures for, with an example of each use,
# - recognise the four basic operations (grayscale, edge detection, noise removal, binarization) by what they do to the numbers,
# - say why a grayscale picture is not a binary one.
#
# **Time** about 40 minutes. **You need** lesson 00.
#
# If the next cell says *No module named 'imgproc_course'*, open the lessons with `environment/lab`, as lesson 00 explains.

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
     caption="Three seconds into the drive: a person walks past, a ball lies ahead, a marker stands by the wall.",
     alt="A living room from close to the floor: a person walking, a ball on a striped rug, a square marker.")

# %% [markdown]
# ## Part one: what a robot wants to know
#
# The recording holds answers as well as pictures: for each pixel what it shows (*labels*) and how far away it is (*depth*). A robot has no such answers; it has to work them out. We use them to see what it is after.
#
# ### 1 · Environment recognition: where can I drive? (4 minutes)
#
# **Predict.** How much of the picture is floor: a tenth, a third, a half?

# %%
labels = recording.labels(30)
number_of = {name: number for number, name in recording.label_names.items()}
floor = labels == number_of["floor"]
print(f"floor: {floor.mean():.1%} of the picture")

assert round(floor.mean() * 100) == 36

# %%
painted = frame.copy()
painted[floor] = painted[floor] // 2 + np.array([0, 127, 0], np.uint8)
show(painted, "floor, painted green",
     caption="A bit more than a third of the picture is floor. And the rug: is it safe to drive on?",
     alt="The same room with the wooden floor tinted green around the rug.")

# %% [markdown]
# ### 2 · Object detection: who is there? (4 minutes)
#
# Detection answers with a *box*: the rows and columns between which an object lies. Here the person's box comes from the labels; a detector would have to find it.

# %%
rows, columns = np.nonzero(labels == number_of["person"])
top, bottom = rows.min(), rows.max()
left, right = columns.min(), columns.max()
print(f"person: rows {top} to {bottom}, columns {left} to {right}")

assert (top, bottom, left, right) == (102, 394, 584, 690)

# %%
boxed = frame.copy()
cv2.rectangle(boxed, (int(left), int(top)), (int(right), int(bottom)), (0, 255, 255), thickness=4)  # (column, row)
show(boxed, "one person, one box",
     caption="The box is four numbers where the picture had millions: this is what a follow-me function works with.",
     alt="The room with a yellow box around the walking person.")

# %% [markdown]
# ### 3 · Position estimation: where am I? (5 minutes)
#
# The black and white square is a marker whose size is known: 25 cm. Its corners in the picture, the camera's focal length, and a little geometry give the distance. Compare with the truth that the recording kept.

# %%
dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
corners, ids, _ = cv2.aruco.ArucoDetector(dictionary).detectMarkers(frame)
half = 0.25 / 2  # metres
square = np.array([[-half, half, 0], [half, half, 0], [half, -half, 0], [-half, -half, 0]])
info = recording.camera_info
found, _, position = cv2.solvePnP(square, corners[0][0], np.array(info.k).reshape(3, 3), np.array(info.d))
measured = np.linalg.norm(position)
true = np.linalg.norm(recording.pose("marker", 30)[:3] - recording.pose("camera", 30)[:3])
print(f"marker {ids[0][0]}: measured {measured:.1f} m, true {true:.1f} m")

assert ids[0][0] == 7
assert abs(measured - true) / true < 0.05  # within five percent

# %% [markdown]
# From one picture, within five percent. A robot that knows where the marker hangs now knows where it is itself.
#
# ### 4 · Obstacle avoidance: what is in my way? (4 minutes)
#
# The depth picture holds a distance in millimetres for every second pixel. **Predict** what stands nearest ahead, and at how many metres.

# %%
depth = recording.depth(30)
ball = labels[::2, ::2] == number_of["ball"]  # depth has half as many rows and columns
ball_distance = np.median(depth[ball]) / 1000
print("depth", depth.shape, depth.dtype, f" ball: {ball_distance:.2f} m")

assert depth.shape == (360, 640) and depth.dtype == np.uint16
assert round(ball_distance, 2) == 1.75

# %%
show(depth, "depth in millimetres: dark is near", encoding="16UC1", limits=(500, 5000),
     caption="Distances from 0.5 m (black) to 5 m (white): the ball stands out against the wall behind it.",
     alt="A gray picture of the room in which near things are dark; the ball is a dark disc ahead.")

# %% [markdown]
# ## Part two: four operations
#
# All four uses above are built from simple steps. Four of them come again and again, and each has a lesson of its own. Look at what each does to the *numbers*: shape, and how many different values.
#
# ### 5 · Grayscale: three numbers become one (3 minutes)

# %%
gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
print("before", frame.shape, "  after", gray.shape, gray.dtype, "  different values:", np.unique(gray).size)
show([frame, gray], ["colour", "gray"], encoding=["bgr8", "mono8"],
     caption="One brightness for each pixel: a third of the numbers, and nearly all of the shapes.",
     alt="The room in colour, and the same room in shades of gray.")

assert gray.shape == (720, 1280) and np.unique(gray).size == 246

# %% [markdown]
# ### 6 · Planned failure: grayscale is not binary (3 minutes)
#
# "Black and white photograph" is what people call a gray picture. A hurried programmer believes it and counts the white pixels:

# %%
white = (gray == 255).mean()
black = (gray == 0).mean()
print(f"white {white:.2%}, black {black:.2%}, together {white + black:.2%}")

assert white + black < 0.01

# %% [markdown]
# Less than one pixel in a hundred is fully white or black: a gray picture has up to 256 values. **Repair it**: to make two values out of 256 somebody must draw a line between them. That is the next operation.
#
# ### 7 · Binarization: a line is drawn (3 minutes)

# %%
binary = np.where(gray > 128, 255, 0).astype(np.uint8)
print("different values:", np.unique(binary), f"  white: {(binary == 255).mean():.1%}")
show([gray, binary], ["gray: 246 values", "binary: two"], encoding="mono8",
     caption="Brighter than 128 becomes white, all else black: whole areas, whatever they belong to.",
     alt="The gray room, and the same room in pure black and white areas.")

assert np.unique(binary).tolist() == [0, 255]

# %% [markdown]
# ### 8 · Edge detection: where brightness jumps (3 minutes)
#
# An edge picture has two values as well. **Predict.** What tells it from a binary one?

# %%
edges = cv2.Canny(gray, 50, 150)
print("different values:", np.unique(edges), f"  white: {(edges == 255).mean():.1%}")
show([binary, edges], ["binary: areas", "edges: lines"], encoding="mono8",
     caption="Both have two values. Binarization fills areas; edges are lines one pixel thin.",
     alt="Left, black and white areas; right, thin white outlines of the same room on black.")

assert np.unique(edges).tolist() == [0, 255]
assert round((edges == 255).mean() * 100) == 4 and (binary == 255).mean() > 0.3

# %% [markdown]
# ### 9 · Noise removal: the same picture, calmer (3 minutes)
#
# Sensors make mistakes: here one pixel in twenty is set to black or white. A *median* of each 3 × 3 neighbourhood throws the odd ones out. The picture keeps its shape and its colours.

# %%
rng = np.random.default_rng(seed=1)
dice = rng.random(frame.shape[:2])
noisy = frame.copy()
noisy[dice < 0.025] = 0
noisy[dice > 0.975] = 255
cleaned = cv2.medianBlur(noisy, 3)
spoiled = (noisy != frame).any(axis=-1).mean()
print(f"spoiled: {spoiled:.1%} of the pixels   shape before {noisy.shape}, after {cleaned.shape}")

assert round(spoiled * 100) == 5 and cleaned.shape == noisy.shape

# %%
window = (slice(300, 460), slice(440, 730))
show([noisy[window], cleaned[window]], ["with noise", "after a 3 × 3 median"],
     caption="The specks are gone; look closely and the finest detail went with them.",
     alt="A crop around ball and marker with black and white specks, and the same crop without them.")

error_before = np.abs(noisy.astype(int) - frame).mean()
error_after = np.abs(cleaned.astype(int) - frame).mean()
print(f"mean error: {error_before:.1f} before, {error_after:.1f} after, in gray levels")
assert error_after < error_before / 2

# %% [markdown]
# ## 10 · Live, on the robot's topic (4 minutes)
#
# The same Canny on the moving picture. Move the sliders: `low` and `high` are the two thresholds that lesson 07 takes apart.

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
# ## 11 · Your turn: name the operation (6 minutes)
#
# Write `name_operation(before, after)`. It gets a colour picture and what became of it, and gives back one of four names: `"grayscale"`, `"binarization"`, `"edges"`, `"noise removal"`.
#
# Everything you need stands above: look at the shape of `after`, at the values in it, and at how many of its pixels are white. Every binary picture here has white on at least a quarter of its pixels, every edge picture on less than a fifth.

# %% role="exercise"
import cv2

exercise(
    "tour-name",
    title="Name the operation",
    function="name_operation",
    time_limit=5,
    refused=(),
    hint="Ask in this order: does it still have colour? Does it have more than two values? Is little of it white?",
)


def a_room(rng):
    """A colour picture of flat walls with boxes in it, (90, 120, 3) uint8, with a little noise."""
    picture = np.full((90, 120, 3), rng.integers(140, 200, size=3), dtype=np.float64)
    for _ in range(6):
        row, column = rng.integers(0, 70), rng.integers(0, 90)
        picture[row : row + rng.integers(15, 40), column : column + rng.integers(20, 60)] = rng.integers(0, 256, size=3)
    return np.clip(picture + rng.normal(0, 3, size=picture.shape), 0, 255).astype(np.uint8)


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


# %% role="case" exercise="tour-name" title="a gray picture" points=1
def inputs(rng):
    before = a_room(rng)
    return before, cv2.cvtColor(before, cv2.COLOR_BGR2GRAY)


# %% role="case" exercise="tour-name" title="a picture of areas" points=1
def inputs(rng):
    before = a_room(rng)
    gray = cv2.cvtColor(before, cv2.COLOR_BGR2GRAY)
    return before, np.where(gray > np.median(gray) - 1, 255, 0).astype(np.uint8)


# %% role="hidden" exercise="tour-name" title="a picture of lines" points=1 hint="Two values, but little white: which of the four draws lines?"
def inputs(rng):
    before = a_room(rng)
    return before, cv2.Canny(cv2.cvtColor(before, cv2.COLOR_BGR2GRAY), 50, 150)


# %% role="hidden" exercise="tour-name" title="a calmer picture" points=1 hint="Only one of the four keeps the colours."
def inputs(rng):
    before = a_room(rng)
    return before, cv2.medianBlur(before, 3)


# %% role="mistake" exercise="tour-name" name="gray taken for binary" says="A gray picture has up to 256 values, a binary one has two. Count the different values with np.unique."
def name_operation(before, after):
    answer = solution(before, after)
    return "binarization" if answer == "grayscale" else answer


# %% role="mistake" exercise="tour-name" name="areas taken for lines" says="Two values alone do not make an edge picture: binarization fills areas, edges are thin lines. Look at how much of it is white."
def name_operation(before, after):
    answer = solution(before, after)
    return "edges" if answer == "binarization" else answer


# %% [markdown]
# ## Recap
#
# A robot asks four things of its camera: what is around me, who is there, where am I, what is in my way. The answers are built from simple operations on numbers, and each leaves its trace in shape and values.
#
# | operation | shape | dtype | different values | unit |
# |---|---|---|---|---|
# | *frame*, `bgr8` | (720, 1280, 3) | uint8 | up to 256 a channel | gray level of blue, green, red |
# | grayscale | (720, 1280) | uint8 | up to 256 | gray level |
# | binarization | (720, 1280) | uint8 | two, in areas | black 0, white 255 |
# | edges | (720, 1280) | uint8 | two, in lines | no edge 0, edge 255 |
# | noise removal | (720, 1280, 3) | uint8 | up to 256 a channel | gray level of blue, green, red |

# %%
for name, picture in {"gray": gray, "binary": binary, "edges": edges, "cleaned": cleaned}.items():
    print(f"{name:8} {picture.shape!s:15} {picture.dtype}")

assert gray.shape == binary.shape == edges.shape == (720, 1280)
assert cleaned.shape == frame.shape == (720, 1280, 3)
