# ---
# jupyter:
#   imgproc_course:
#     title: Start here
# ---

# %% [markdown]
# # Start here
#
# A small robot drives through a living room. Its camera is 20 cm above the floor and takes ten images per second. One image of such a stream is called a *[[term:frame]]*. The robot *[[term:publish|publishes]]* (sends) every frame on a ROS 2 *[[term:topic]]*, a named stream of messages. Any program can *[[term:subscribe]]* to a topic, and then receives its messages.
#
# At the end of this lesson, these frames arrive in this notebook, and your own function processes them. You need no robot: the drive is a recording that a computer rendered. Everything else is real ROS 2, a collection of libraries and tools for robot programs.
#
# **You will be able to**
# - run a lesson cell by cell, and restart it,
# - receive a camera's frames from a ROS 2 topic and watch them live,
# - do an exercise, check your answer, and get a hint.
#
# **Time** [[minutes]]. **You need** a little Python: variables, functions, lists.

# %% [markdown]
# ## 1 · How a lesson works ([[minutes]])
#
# A lesson is a *[[term:notebook]]*: a list of cells. Text cells like this one are for reading. Code cells contain Python. Click into the next cell and press **Shift + Enter** to run it. Its output appears below it.

# %%
print("hello")

# %% [markdown]
# The brackets on the left of a cell are `[ ]` before it runs, `[*]` while it runs or waits, and `[3]` after the third run since the start.
#
# Run the cells from top to bottom: a cell uses results of those above it. To begin in the middle, first choose **Run → Run All Above Selected Cell** in the menu; otherwise you get a `NameError`.
#
# The *[[term:notebook kernel|kernel]]* is the Python process that runs the cells.
#
# | you want to | do this |
# |---|---|
# | stop a cell | **Kernel → Interrupt Kernel** |
# | begin again | **Kernel → Restart Kernel and Run All Cells…**; your code stays |
# | save | **Ctrl + S** (also done every two minutes) |
# | write in a cell; leave it | **Enter**; **Esc** (then letters are commands: `b` adds a cell below) |
# | see more of the page | **Ctrl + B** hides the list of files |
# | finish a lesson | **File → Close and Shut Down Notebook** |

# %% [markdown]
# This file is your own copy: an update never overwrites it. In a lesson that you open again, a live image says *Error displaying widget: model not found* until its cell has run again.
#
# Sections that are marked *deeper* can be left out. The rest, the *core* of a lesson, never needs them.
#
# **Try**, **Look** and **Check** mean: run the cell and compare. Some cells show only their first line, such as `# Check: the numbers in this section`. They test that the numbers in the text are right ([[term:assert|`assert`]]). Run them without reading.
#
# ## 2 · Is your computer ready? ([[minutes]])
#
# The *doctor* checks everything that the lessons need. A line with ✗ says how to fix the problem. You can ignore a line with !.
#
# *No module named 'imgproc_course'* means that the notebook uses another Python. Close it, and open the lessons with `environment/lab`, or choose **Kernel → Change Kernel…** and the Python in the course's folder `.venv`.

# %% tags=["nbval-ignore-output"]
from imgproc_course.doctor import doctor

report = doctor()
report

# %%
# Check: your computer is ready
assert report.ready, "a line above shows ✗; do what it says, then run both cells again"

# %% role="texts"
figure_texts = {
    "frame": (
        "The robot's camera, 20 cm above the floor, sees a lot of floor, some furniture, and a ball in front of the robot.",
        "A living room seen from close to the floor: wooden boards, a sofa, a ball ahead, a chair and boxes.",
    ),
    "live": (
        "The drive. The slider sets the brightness in percent.",
        "The living room seen from close to the floor, while the robot drives.",
    ),
}

# %% [markdown]
# ## 3 · An image from the recording ([[minutes]])
#
# An image is an *[[term:array]]*: a table of numbers. Its smallest part is a *[[term:pixel]]*: one small square of one colour. The `shape` of an array says how many rows, columns and so on it has. Its `dtype` (data type) says what kind of numbers it contains.

# %%
from imgproc_course.display import show
from imgproc_course.exercises import compare_guess
from imgproc_course.recording import open_recording

recording = open_recording("drive")
frame = recording.frame(0)

# %% [markdown]
# **Predict.** The image is 1280 pixels wide and 720 pixels high. Which number comes first in its shape? Write your guess instead of `None`, and run the cell and the one below it. (In later guesses, a word stands in quotes: `"yes"`.) A wrong guess costs nothing.

# %% role="predict"
guess_first = None  # your guess: 720 or 1280?

# %%
print("frames in the recording:", len(recording))
print("shape:", frame.shape, "  dtype:", frame.dtype)
compare_guess(guess_first, frame.shape[0])

# %% [markdown]
# Rows come first: 720 rows, 1280 columns, and 3 numbers for each pixel, one for each *[[term:channel]]*: blue, green and red. Each number is an *[[term:intensity]]*: 0 means no light of this colour, 255 means the most. The dtype `uint8` holds whole numbers from 0 to 255.

# %%
show(frame, "the robot's first frame", text="start_here/frame")

# %%
# Check: the numbers in this section
import numpy as np

assert len(recording) == 90 and frame.shape == (720, 1280, 3)
assert frame.dtype == np.uint8 and np.iinfo(np.uint8).max == 255
assert round(recording.pose("camera", 0)[2], 2) == 0.2  # metres above the floor

# %% [markdown]
# ## 4 · A frame from a topic ([[minutes]])
#
# `open_camera` starts a camera that publishes the recording on the robot's topic. A robot has one camera: if it runs already, for another notebook, `open_camera` joins it. `ImageSubscriber` subscribes to this topic. `wait` waits for the next frame.
#
# Without ROS 2 (macOS, Windows without WSL), this lesson uses the recording; in other lessons, cells that begin with `if ros_available():` then do nothing. Their results are on the pages that `environment/site --serve` opens.

# %%
from imgproc_course.ros import ImageSubscriber, open_camera, ros_available

if ros_available():
    camera = open_camera("recording")
    source = ImageSubscriber(camera.topic)
    received = source.wait(timeout=10)
    print("topic:", camera.topic)
else:
    source = recording
    received = recording.frame(1)
print("shape:", received.shape, "  dtype:", received.dtype)

# %% [markdown]
# This frame came as a *[[term:message]]* (one unit of data on a topic). The *[[term:middleware]]*, the software that carries messages from one program to another, sent it to this notebook. Here it became an array again.
#
# **Look.** Here are the frames live. The view calls the function `darken` for every frame, with the value of the slider, which `percent=(0, 100)` makes. Move it.
#
# `darken` multiplies every intensity by `percent` and divides it by 100 (`//` divides and rounds down). 255 × 100 = 25,500 is too large for `uint8`. So `astype` first converts the numbers to `uint16`, which holds numbers up to 65,535, and at the end back to `uint8`.

# %% tags=["nbval-ignore-output"]
from imgproc_course.display import live_view


def darken(frame, percent=100):
    large = frame.astype("uint16") * percent // 100
    return large.astype("uint8")


view = live_view(source, darken, percent=(0, 100), text="start_here/live")

# %%
# Check: the numbers in this section
assert received.shape == frame.shape and received.dtype == frame.dtype
assert 255 * 100 == 25_500 and np.iinfo(np.uint16).max == 65_535
assert frame.max() == 255 and darken(frame, percent=50).max() == 127

# %% [markdown]
# ## 5 · Your turn: the first exercise ([[minutes]])
#
# How many pixels does an image have? Write the function `count_pixels(frame)`:
#
# | Input | Output | Example call |
# |---|---|---|
# | `frame`: a colour image of any size, an array like `frame` above | the number of its pixels: one whole number | for an image of 2 rows and 3 columns, `count_pixels(image)` gives `6` |
#
# Replace the line with `raise` by your own code, and run both cells.
#
# - `check("start-count", count_pixels)` runs your function on some images, and says what to look at.
# - `hint("start-count")` shows a hint. Run it again for the next one; there are three.
# - `solution("start-count")` shows and explains a solution, after three honest tries. With `give_up=True` it comes at once.
#
# Most exercises give *points*: in a class, a program *grades* your answers with other inputs. Hints and solutions never change your points. This exercise is practice and gives none.

# %% role="exercise"
exercise(
    "start-count",
    title="Count the pixels",
    function="count_pixels",
    practice=True,
    time_limit=5,
    hint="frame.shape has three numbers. The first two are the number of rows and the number of columns.",
    hints=(
        "frame.shape of the robot's frame is (720, 1280, 3). Which of these three numbers do you need to count the pixels?",
        "The first number of frame.shape is the number of rows, the second is the number of columns. Take both from frame.shape, multiply them, and return the product.",
        "Python counts from 0: rows = frame.shape[0] and columns = frame.shape[1]. The last line is return rows * columns.",
    ),
    explanation="frame.shape[0] is the number of rows and frame.shape[1] the number of columns. Each row has the same number of pixels, so the product is the number of all pixels. The third number, the channels, is not needed: the three numbers of a pixel belong to one pixel. Because the size comes from frame.shape, the function works for an image of any size.",
    another_way="You can also write rows, columns, channels = frame.shape and return rows * columns.",
)

# %% role="answer" exercise="start-count"
def count_pixels(frame):
    raise NotImplementedError("your turn: delete this line and write the function")

# %% role="solution" exercise="start-count"
def count_pixels(frame):
    return frame.shape[0] * frame.shape[1]


# %% role="check" exercise="start-count"
from imgproc_course.exercises import check, hint, solution

check("start-count", count_pixels)

# %% role="case" exercise="start-count" title="a small image"
def inputs(rng):
    rows, columns = rng.integers(2, 9, size=2)
    return (rng.integers(0, 256, size=(rows, columns + 9, 3), dtype=np.uint8),)

# %% role="case" exercise="start-count" title="a dark image with black pixels" points=0
def inputs(rng):
    rows, columns = rng.integers(3, 6, size=2)
    return (rng.integers(0, 3, size=(rows + 6, columns, 3), dtype=np.uint8),)

# %% role="hidden" exercise="start-count" title="another image" hint="Does your function read both numbers from frame.shape?"
def inputs(rng):
    rows, columns = rng.integers(10, 30, size=2)
    return (rng.integers(0, 256, size=(rows, columns + 30, 3), dtype=np.uint8),)

# %% [markdown]
# Here is a hint. In other exercises you add a cell for `hint` and `solution`: **Esc**, then `b`.

# %%
hint("start-count", step=1)

# %% [markdown]
# ## Recap
#
# Images are arrays of numbers: rows first, then columns, then channels. On a robot, images arrive as messages on a topic.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | *frame* | (720, 1280, 3) | uint8 | 0 to 255 | intensity of blue, green, red |
#
# Many words in the lessons are links to the [glossary](glossary.md).
#
# **Next:** [[arrays]]. Before you go on, choose **File → Close and Shut Down Notebook**. *The original lesson in one day* is a route of about 6 hours: the [list of all lessons](index.ipynb) shows it, and two others.
