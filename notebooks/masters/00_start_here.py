# ---
# jupyter:
#   imgproc_course:
#     title: Start here
#     minutes: 15
# ---

# %% [markdown]
# # 00 · Start here
#
# A low home robot drives through a living room. Ten times a second its camera sends a picture, on a ROS 2 topic with the name `/kachaka/front_camera/image_raw`. In a quarter of an hour those pictures arrive in this notebook and pass through a function that you wrote. You need no robot: the drive is a recording (a rendered one, made for this course), and everything else is real ROS 2.
#
# **You will be able to**
# - run a lesson, cell by cell, and start it afresh,
# - see whether your machine is ready, and what to do if it is not,
# - receive a camera's picture from a ROS 2 topic and look at it live,
# - do an exercise and have it checked.
#
# **Time** about 15 minutes. **You need** to have seen Python: variables, functions, lists.

# %% [markdown]
# ## 1 · How a lesson works (2 minutes)
#
# A lesson is a column of cells. Text cells like this one are for reading. Code cells run: click into one and press **Shift + Enter**. What it prints appears below it. Run them from top to bottom; each builds on the ones above.
#
# If you are lost, choose **Kernel → Restart Kernel and Run All Cells…** in the menu: the lesson starts afresh, and your own code stays. This file is your own copy. An update of the course never writes over it.

# %%
try:
    import imgproc_course
except ModuleNotFoundError:
    raise ModuleNotFoundError(
        "this notebook's kernel does not know the course: close it, and open the lessons with environment/lab, "
        "or choose Kernel > Change Kernel and take the Python of the course's folder .venv"
    ) from None

print("The course is here, version", imgproc_course.__version__)

# %% [markdown]
# ## 2 · Is this machine ready? (3 minutes)
#
# The doctor looks at everything that the lessons use. A line with ✗ names its remedy beside it; a line with ! may stay as it is. (The same in a terminal: `imgproc-course doctor`.)

# %% tags=["nbval-ignore-output"]
from imgproc_course.doctor import doctor

report = doctor()
report

# %%
assert report.ready, "a line above is marked ✗; do what it says, then run this cell again"
print("ready")

# %% [markdown]
# ## 3 · A picture from the recording (3 minutes)
#
# First without ROS. `open_recording` opens the drive; `frame(0)` is its first picture, as an array of numbers.
#
# **Predict.** The picture is 1280 pixels wide and 720 high. In which order will the array's shape name the two?

# %%
from imgproc_course.display import show
from imgproc_course.recording import open_recording

recording = open_recording("drive")
frame = recording.frame(0)
print("pictures:", len(recording))
print("type:", type(frame).__name__, "  shape:", frame.shape, "  dtype:", frame.dtype)

assert len(recording) == 90
assert frame.shape == (720, 1280, 3)

# %% [markdown]
# Rows first: 720 rows, 1280 columns, and 3 numbers (blue, green, red) for each pixel. The dtype `uint8` means whole numbers from 0 to 255.

# %%
height = recording.pose("camera", 0)[2]  # metres above the floor
show(frame, "the robot's first picture",
     caption="What a robot 20 cm above the floor sees: a lot of floor, furniture, and a ball in its way.",
     alt="A living room seen from close to the floor: wooden boards, a sofa, a ball ahead, a chair and boxes.")

assert round(height, 2) == 0.2

# %% [markdown]
# ## 4 · A picture from a topic (4 minutes)
#
# Now with ROS 2. `open_camera` plays the recording on the robot's topic, as the robot would. `ImageSubscriber` listens there. `wait` gives the next picture that arrives.
#
# Where ROS 2 is not installed (macOS, Windows without WSL), `ros_available()` says so and what to install, and the lesson goes on with the recording.

# %%
from imgproc_course.ros import ImageSubscriber, open_camera, ros_available

if ros_available():
    camera = open_camera("recording")
    subscriber = ImageSubscriber(camera.topic)
    received = subscriber.wait(timeout=10)
    print("topic:", camera.topic)
else:
    received = recording.frame(1)
print("shape:", received.shape, "  dtype:", received.dtype)

assert received.shape == frame.shape and received.dtype == frame.dtype

# %% [markdown]
# That picture went the whole way: read from the recording, put into a message, sent through the same middleware that a robot uses, received, and turned back into an array.
#
# **Look.** Here it is live. Move the slider while it runs: the function below is called for every picture, with the slider's value.

# %% tags=["nbval-ignore-output"]
from imgproc_course.display import live_view


def darken(frame, percent=100):
    return (frame.astype("uint16") * percent // 100).astype("uint8")


source = subscriber if ros_available() else recording
view = live_view(source, darken, percent=(0, 100), caption="The drive, as dark as the slider says.",
                 alt="The living room seen from close to the floor, while the robot drives.")

# %%
half = darken(frame, percent=50)
print("brightest value before:", frame.max(), "  after:", half.max())

assert frame.max() == 255 and half.max() == 127

# %% [markdown]
# ## 5 · Your turn: the first exercise (3 minutes)
#
# How many pixels does a picture have? Write `count_pixels(frame)`. It gets an array like the one above and gives back one whole number: rows × columns. Delete the line with `raise` and write your own; then run the cell, and the one below it.
#
# This one is practice. It gives no marks, but shows how every exercise goes.

# %% role="exercise"
exercise(
    "start-count",
    title="Count the pixels",
    function="count_pixels",
    practice=True,
    time_limit=5,
    hint="frame.shape holds the three numbers; the first two are rows and columns.",
)

# %% role="answer" exercise="start-count"
def count_pixels(frame):
    raise NotImplementedError("your turn: delete this line and write the function")


# %% role="solution" exercise="start-count"
def count_pixels(frame):
    return frame.shape[0] * frame.shape[1]


# %% role="check" exercise="start-count"
from imgproc_course.exercises import check

check("start-count", count_pixels)


# %% role="case" exercise="start-count" title="a small picture"
def inputs(rng):
    rows, columns = rng.integers(2, 9, size=2)
    return (rng.integers(0, 256, size=(rows, columns + 9, 3), dtype=np.uint8),)


# %% role="hidden" exercise="start-count" title="another picture" hint="Is every number read from the frame?"
def inputs(rng):
    rows, columns = rng.integers(10, 30, size=2)
    return (rng.integers(0, 256, size=(rows, columns + 30, 3), dtype=np.uint8),)


# %% role="mistake" exercise="start-count" name="numbers counted instead of pixels" says="Each pixel holds three numbers, and all of them were counted. frame.size counts numbers; a pixel is one row and one column."
def count_pixels(frame):
    return int(frame.size)


# %% role="mistake" exercise="start-count" name="rows counted instead of pixels" says="That is the number of rows alone. Multiply it by the number of columns."
def count_pixels(frame):
    return len(frame)


# %% [markdown]
# ## Recap
#
# Pictures are arrays of numbers, rows first. On a robot they arrive as messages on a topic, and a function of yours can stand in their way.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | *frame*, from the recording or the topic | (720, 1280, 3) | uint8 | 0 to 255 | gray level of blue, green, red |
#
# **Next:** lesson 01, what image processing is for.
