# ---
# jupyter:
#   imgproc_course:
#     title: Start here
#     minutes: 15
# ---

# %% [markdown]
# # 00 · Start here
#
# A small robot drives through a living room. Its camera is 20 cm above the floor and takes ten images per second. One image of such a stream is called a *frame*. The robot *publishes* (sends) every frame on a ROS 2 *topic*: a named stream of messages. Any program can *subscribe* to a topic, and then receives its messages. Here each message contains one frame. The name of this topic is `/kachaka/front_camera/image_raw`.
#
# In about 15 minutes, these frames will arrive in this notebook, and your own function will process each of them. You need no robot. The drive is a recording that a computer rendered for this course; everything else is real ROS 2. (ROS 2, the Robot Operating System, is a collection of libraries and tools for robot programs.)
#
# **You will be able to**
# - run a lesson cell by cell, and restart it,
# - check whether your computer is ready for the course, and repair what is missing,
# - receive a camera's frames from a ROS 2 topic and watch them live,
# - do an exercise and check your answer.
#
# **Time** about 15 minutes. **You need** a little Python: variables, functions, lists.

# %% [markdown]
# ## 1 · How a lesson works (2 minutes)
#
# A lesson is a list of cells. Text cells like this one are for reading. Code cells contain Python: click into a code cell and press **Shift + Enter** to run it. Its output appears below it. Run the cells from top to bottom, because a cell uses results of the cells above it.
#
# A line that begins with `assert` checks a condition. If the condition is false, the cell stops with an error. The words in bold guide you. **Ask** begins with a question. At **Predict**, decide on your own answer before you run the next cell. At **Try**, **Look** and **Check**, run the cell and compare the result with your answer.
#
# The *kernel* is the Python process that runs the cells of a notebook. If something goes wrong, choose **Kernel → Restart Kernel and Run All Cells…** in the menu. Then the lesson starts again from the first cell, and your own code stays. This file is your own copy: an update of the course never overwrites it.

# %%
# This cell checks whether the course is installed.
try:
    import imgproc_course
except ModuleNotFoundError:
    raise ModuleNotFoundError(
        "this notebook's kernel cannot import the course: close it, and open the lessons with environment/lab, "
        "or choose Kernel > Change Kernel and the Python in the course's folder .venv"
    ) from None

print("The course is installed, version", imgproc_course.__version__)

# %% [markdown]
# ## 2 · Is your computer ready? (3 minutes)
#
# The next cell runs the *doctor*, a program of this course that checks everything the lessons need. If a line shows ✗, it also says how to fix the problem. You can ignore a line that shows !. (In a terminal, the command `imgproc-course doctor` does the same.)

# %% tags=["nbval-ignore-output"]
from imgproc_course.doctor import doctor

report = doctor()
report

# %%
assert report.ready, "a line above shows ✗; do what it says, then run both cells again"
print("ready")

# %% [markdown]
# ## 3 · An image from the recording (3 minutes)
#
# We begin without ROS. `open_recording` opens the recording of the drive, and `frame(0)` is its first frame. An image is an *array*: a table of numbers. Its smallest part is a *pixel*: one small square of one colour. The `shape` of an array says how many rows, columns and so on it has. Its `dtype` (data type) says what kind of numbers it contains.
#
# **Predict.** The image is 1280 pixels wide and 720 pixels high. Will its shape be `(720, 1280, …)` or `(1280, 720, …)`?

# %%
from imgproc_course.display import show
from imgproc_course.recording import open_recording

recording = open_recording("drive")
frame = recording.frame(0)
print("frames:", len(recording))
print("type:", type(frame).__name__, "  shape:", frame.shape, "  dtype:", frame.dtype)

assert len(recording) == 90
assert frame.shape == (720, 1280, 3)

# %% [markdown]
# Rows come first: 720 rows, 1280 columns, and 3 numbers for each pixel. The three numbers belong to three *channels*: blue, green and red. Each number is an *intensity*: 0 means no light of this colour, 255 means the most light. The dtype `uint8` holds whole numbers from 0 to 255.

# %%
height = recording.pose("camera", 0)[2]  # metres above the floor
show(frame, "the robot's first frame",
     caption="The robot's camera, 20 cm above the floor, sees a lot of floor, some furniture, and a ball in front of the robot.",
     alt="A living room seen from close to the floor: wooden boards, a sofa, a ball ahead, a chair and boxes.")

assert round(height, 2) == 0.2

# %% [markdown]
# ## 4 · A frame from a topic (4 minutes)
#
# Now we use ROS 2. `open_camera` publishes the recording on the robot's topic, as the robot does. `ImageSubscriber` subscribes to this topic, so it receives every frame that is published there. `wait` waits for the next frame and returns it.
#
# If ROS 2 is not installed (macOS, Windows without WSL), `ros_available()` returns `False`, and the lesson uses the recording instead. The doctor above says what to install.

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
# This frame went through every step. It was read from the recording and converted to a *message* (one unit of data on a topic). The same middleware as on a robot sent it to this notebook. (The *middleware* is the software that carries messages from one program to another.) Here the message was received and converted back to an array.
#
# **Look.** Here are the frames live. The view calls the function `darken` for every frame, with the value of the slider. Move the slider while the view runs.

# %% tags=["nbval-ignore-output"]
from imgproc_course.display import live_view


def darken(frame, percent=100):
    # uint16 holds numbers up to 65535, so 255 * 100 fits; uint8 ends at 255
    return (frame.astype("uint16") * percent // 100).astype("uint8")


source = subscriber if ros_available() else recording
view = live_view(source, darken, percent=(0, 100), caption="The drive. The slider sets the brightness in percent.",
                 alt="The living room seen from close to the floor, while the robot drives.")

# %%
half = darken(frame, percent=50)
print("brightest value before:", frame.max(), "  after:", half.max())

assert frame.max() == 255 and half.max() == 127

# %% [markdown]
# ## 5 · Your turn: the first exercise (3 minutes)
#
# How many pixels does an image have? Write the function `count_pixels(frame)`. It gets an image, an array like `frame` above, and returns one whole number: rows × columns. Delete the line with `raise`, and write your own code there. Then run this cell and the cell below it, which checks your answer.
#
# This exercise is for practice: it gives no points, but it shows how every exercise works.

# %% role="exercise"
exercise(
    "start-count",
    title="Count the pixels",
    function="count_pixels",
    practice=True,
    time_limit=5,
    hint="frame.shape has three numbers. The first two are the number of rows and the number of columns.",
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


# %% role="case" exercise="start-count" title="a small image"
def inputs(rng):
    rows, columns = rng.integers(2, 9, size=2)
    return (rng.integers(0, 256, size=(rows, columns + 9, 3), dtype=np.uint8),)


# %% role="hidden" exercise="start-count" title="another image" hint="Does your function read both numbers from frame.shape?"
def inputs(rng):
    rows, columns = rng.integers(10, 30, size=2)
    return (rng.integers(0, 256, size=(rows, columns + 30, 3), dtype=np.uint8),)


# %% role="mistake" exercise="start-count" name="numbers counted instead of pixels" says="Your function counts all numbers, and each pixel has three. frame.size is the number of numbers. The number of pixels is rows × columns."
def count_pixels(frame):
    return int(frame.size)


# %% role="mistake" exercise="start-count" name="rows counted instead of pixels" says="That is only the number of rows. Multiply it by the number of columns."
def count_pixels(frame):
    return len(frame)


# %% [markdown]
# ## Recap
#
# Images are arrays of numbers: rows first, then columns, then channels. On a robot, images arrive as messages on a topic, and your own function can process each of them.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | *frame*, from the recording or the topic | (720, 1280, 3) | uint8 | 0 to 255 | intensity of blue, green, red |
#
# **Next:** lesson 01, what image processing is for.
