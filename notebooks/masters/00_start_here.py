# ---
# jupyter:
#   imgproc_course:
#     title: Start here
# ---

# %% [markdown]
# # Start here
#
# A small robot drives through a living room. Its camera is 20 cm above the floor and takes ten images per second. One image of such a stream is called a *[[term:frame]]*. The robot *[[term:publish|publishes]]* (sends) every frame on a ROS 2 *[[term:topic]]*: a named stream of messages. Any program can *[[term:subscribe]]* to a topic, and then receives its messages. Here each message contains one frame. The name of this topic is `/kachaka/front_camera/image_raw`.
#
# At the end of this lesson, these frames arrive in this notebook, and your own function processes each of them. You need no robot. The drive is a recording that a computer rendered for this course; everything else is real ROS 2. (ROS 2, the Robot Operating System, is a collection of libraries and tools for robot programs.)
#
# **You will be able to**
# - run a lesson cell by cell, and restart it,
# - check whether your computer is ready for the course, and repair what is missing,
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
# Look at the brackets on the left of the cell:
#
# | brackets | meaning |
# |---|---|
# | `[ ]` | not run yet |
# | `[*]` | running, or waiting for another cell |
# | `[3]` | finished; it was the third run since the start |
#
# Run the cells from top to bottom, because a cell uses results of the cells above it. To begin in the middle, first choose **Run → Run All Above Selected Cell** in the menu. Otherwise Python does not know the names of the cells above: a `NameError`.
#
# The *[[term:notebook kernel|kernel]]* is the Python process that runs the cells.
#
# | you want to | do this |
# |---|---|
# | stop a cell that runs too long | **Kernel → Interrupt Kernel**, or the ■ in the toolbar |
# | begin again with an empty memory | **Kernel → Restart Kernel and Run All Cells…**; your code stays. A live image from before the restart stands still or is gone, until its cell has run again |
# | save | **Ctrl + S**; JupyterLab also saves every two minutes |
# | write in a cell | click into it, or press **Enter** (*edit mode*) |
# | leave a cell, to move with the arrow keys | **Esc** (*command mode*); in this mode, letters are commands: `a` adds a cell above, `b` below |
# | finish a lesson | **File → Close and Shut Down Notebook**; a closed tab alone keeps its kernel running |
#
# This file is your own copy: an update never overwrites it.
#
# Sections that are marked *deeper* can be left out. The rest is the *core* of a lesson: it never needs them.
#
# **Try**, **Look** and **Check** mean: run the cell and compare. Some cells show only their first line, such as `# Check: the numbers in this section`. They contain lines with [[term:assert|`assert`]]: each of them tests that a number in the text is right. You can run these cells without reading them.
#
# ## 2 · Is your computer ready? ([[minutes]])
#
# The next cell runs the *doctor*, a program of this course that checks everything the lessons need. If a line shows ✗, it also says how to fix the problem. You can ignore a line that shows !. (In a terminal, the command `imgproc-course doctor` does the same.)
#
# If the cell says *No module named 'imgproc_course'*, the notebook uses another Python than the course. Close it, and open the lessons with `environment/lab`. Or choose **Kernel → Change Kernel…** and the Python in the course's folder `.venv`.

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
# We begin without ROS. `open_recording` opens the recording of the drive, and `frame(0)` is its first frame. An image is an *[[term:array]]*: a table of numbers. Its smallest part is a *[[term:pixel]]*: one small square of one colour. The `shape` of an array says how many rows, columns and so on it has. Its `dtype` (data type) says what kind of numbers it contains.

# %%
from imgproc_course.display import show
from imgproc_course.exercises import compare_guess
from imgproc_course.recording import open_recording

recording = open_recording("drive")
frame = recording.frame(0)

# %% [markdown]
# **Predict.** The image is 1280 pixels wide and 720 pixels high. Which of these two numbers comes first in its shape? Write your guess instead of `None`, and run the cell. (In later guesses, a word stands in quotes: `"yes"`.) Then run the cell below it, which compares your guess with the result. A wrong guess costs nothing, and you can leave `None`.

# %% role="predict"
guess_first = None  # your guess: 720 or 1280?

# %%
print("frames in the recording:", len(recording))
print("shape:", frame.shape, "  dtype:", frame.dtype)
compare_guess(guess_first, frame.shape[0])

# %% [markdown]
# Rows come first: 720 rows, 1280 columns, and 3 numbers for each pixel. The three numbers belong to three *[[term:channel|channels]]*: blue, green and red. Each number is an *[[term:intensity]]*: 0 means no light of this colour, 255 means the most light. The dtype `uint8` holds whole numbers from 0 to 255.

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
# Now we use ROS 2. `open_camera` starts a camera that publishes the recording on the robot's topic, as the robot does. A robot has one camera, so there is one for all your notebooks and programs, too: if it runs already, `open_camera` joins it. It stops when the last program that uses it stops. `ImageSubscriber` subscribes to this topic, so it receives every frame that is published there. `wait` waits for the next frame and returns it.
#
# If ROS 2 is not installed (macOS, Windows without WSL), `ros_available()` returns `False`. This lesson then uses the recording. In other lessons, the cells that begin with `if ros_available():` do nothing: read them. `environment/site --serve` opens the course's pages, which show their results, and a still image for each live view. The doctor above says what to install.

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
# This frame went through every step. It was read from the recording and converted to a *[[term:message]]* (one unit of data on a topic). The same middleware as on a robot sent it to this notebook. (The *[[term:middleware]]* is the software that carries messages from one program to another.) Here the message was received and converted back to an array.
#
# **Look.** Here are the frames live. The view calls the function `darken` for every frame, with the value of the slider. Move the slider while the view runs. With a mouse, drag it; with the keyboard, use the arrow keys.
#
# `darken` multiplies every intensity by `percent` and divides it by 100 (`//` divides and rounds down). 255 × 100 = 25,500 is too large for `uint8`. So `astype` first converts the numbers to `uint16`, a dtype that holds numbers up to 65,535, and at the end back to `uint8`.

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
# | `frame`: a colour image, an array like `frame` above, of any size | the number of its pixels: one whole number, rows × columns | for an image of 2 rows and 3 columns, `count_pixels(image)` gives `6` |
#
# Replace the line with `raise` by your own code. Then run this cell and the cell below it.
#
# | cell | what it does |
# |---|---|
# | `check("start-count", count_pixels)` | runs your function on some images, and says what is right and what to look at. |
# | `hint("start-count")` | shows a hint. Run it again for the next one; there are three. |
# | `solution("start-count")` | shows a solution and explains it, after three honest tries. `solution("start-count", give_up=True)` shows it at once. |
#
# If a check cell shows `NameError: name 'count_pixels' is not defined`, run the cell with your function first. Most exercises give *points*: if you take the course with an instructor, a program *grades* your answers (it tests them again, with other inputs). Hints and solutions never change your points. This exercise is for practice and gives no points.

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
# Here is the first hint of this exercise. In other exercises you call `hint` and `solution` yourself, in a cell that you add: press **Esc**, then `b`.

# %%
hint("start-count", step=1)

# %% [markdown]
# ## Recap
#
# Images are arrays of numbers: rows first, then columns, then channels. On a robot, images arrive as messages on a topic, and your own function can process each of them.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | *frame*, from the recording or the topic | (720, 1280, 3) | uint8 | 0 to 255 | intensity of blue, green, red |
#
# Many words in the lessons are links to the [glossary](glossary.md).
#
# **Next:** [[arrays]]. Before you go on, choose **File → Close and Shut Down Notebook**.
#
# **Only one day?** *The original lesson in one day* is a route of about 6 hours through the cores of nine lessons. Their minutes: [[start_here]] 25, [[arrays]] 35, [[what_is_image_processing]] 30, [[images_as_messages]] 35, [[grayscale]] 35, [[grayscale_node]] 60, [[canny_stages]] 40, [[edge_detection_node]] 25, [[ros2_packages]] 50. The [list of all lessons](index.ipynb) names two other routes.
