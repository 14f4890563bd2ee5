# ---
# jupyter:
#   imgproc_course:
#     title: The grayscale node
#     minutes: 50
# ---

# %% [markdown]
# # The grayscale node
#
# A function converts one frame to gray. A *node* is a program that takes part in ROS. A grayscale node converts every image that the camera sends, and publishes the results for other nodes. To make a node from the function, you need only a few lines, but some mistakes are easy to make.
#
# **You will be able to**
# - write a ROS 2 node that subscribes, processes and publishes, and explain each of its lines,
# - explain why a notebook cell with `rclpy.spin` never ends, and what to do instead (`rclpy` is the Python library of ROS 2),
# - choose QoS policies, copy a header, and keep a node running when an image cannot be converted.
#
# **Time** about 50 minutes. **You need** [[images_as_messages]] and [[grayscale]]. This lesson needs a running ROS 2. Without ROS 2 (macOS, Windows without WSL), read the lesson and do the exercise in section 5.

# %% role="given" exercise=["node-process"]
import cv2
import numpy as np

# %%
from imgproc_course.display import live_view
from imgproc_course.exercises import check
from imgproc_course.imaging import to_gray
from imgproc_course.recording import open_recording
from imgproc_course.ros import ImageSubscriber, RosSession, open_camera, ros_available

frame = open_recording("drive").frame(30)
if ros_available():
    camera = open_camera("recording")
    print("the camera publishes", camera.topic)

# %% [markdown]
# ## 1 · A callback is a function that ROS calls (7 minutes)
#
# **Ask.** Until now you called `wait` and waited for an image. A node does not wait. It subscribes to a topic and passes a function, its *callback*. ROS calls this function for every message that arrives. The camera sends ten images per second. **Predict** how often ROS calls the function below in two seconds.

# %%
stamps = []


def on_image(frame, msg):
    stamps.append(msg.header.stamp)


# %% tags=["nbval-ignore-output"]
import time

if ros_available():
    subscriber = ImageSubscriber(camera.topic, on_image)
    subscriber.wait(timeout=10)
    stamps.clear()
    time.sleep(2)
    cameras = subscriber.session.node.count_publishers(camera.topic)
    subscriber.stop()
    print("called", len(stamps), "times in two seconds; cameras:", cameras)
    assert 10 <= len(stamps) <= 25 * cameras

# %% [markdown]
# ROS called it about twenty times, although this cell only slept. If another lesson is still open, it publishes the drive too. Then there are two cameras, and you see about forty calls.
#
# The callback ran in a background *thread*: a part of the program that runs at the same time as your cells. An *executor* runs in this thread. It waits for messages and calls the callbacks, again and again. This is called *spinning*.
#
# ## 2 · The node, line by line (14 minutes)
#
# Here is the whole node, as it would run on a robot. In Python, a node is a *class*: a description of objects that have data and functions. `GrayNode(Node)` means that `GrayNode` has everything that ROS's class `Node` has. `__init__` runs when a node is created, `self` is the node itself, and `super().__init__` runs the `__init__` of `Node`. `**options` passes all further named arguments to `Node`. The numbers at the ends of the lines refer to the explanations below.

# %% tags=["long"]
if ros_available():
    from rclpy.node import Node
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import Image

    from imgproc_course.messages import ConversionError, array_to_image, image_to_array

    class GrayNode(Node):
        def __init__(self, **options):
            super().__init__("gray_by_hand", **options)                                             # 1
            self.gray = self.create_publisher(Image, "~/gray", qos_profile_sensor_data)             # 2
            self.create_subscription(Image, camera.topic, self.on_image, qos_profile_sensor_data)   # 3

        def on_image(self, msg):
            try:
                frame = image_to_array(msg, "bgr8")                                                 # 4
            except ConversionError as error:
                self.get_logger().error(str(error), throttle_duration_sec=5)                        # 5
                return
            gray = to_gray(frame)                                                                   # 6
            self.gray.publish(array_to_image(gray, "mono8", msg.header))                            # 7

# %% [markdown]
# 1. `"gray_by_hand"` is the node's name. Other programs see it in the *ROS graph*, the network of all running nodes and topics.
# 2. The node creates a *publisher* for images on `~/gray`. ROS replaces `~` by the node's name: `/gray_by_hand/gray`. So a node with another name publishes on another topic.
# 3. The node creates a *subscription* to the camera's topic, with the callback `on_image`. `qos_profile_sensor_data` is the set of *QoS policies* that cameras offer:
#    - **reliability: best effort.** A lost image is not sent again, because a late image is useless.
#    - **history: keep last, depth: 5.** At most five images wait in the queue. If a sixth image arrives, the oldest one is dropped.
#    - **durability: volatile.** Images that were published before the subscription existed are not delivered.
# 4. `image_to_array` converts the message to an array with the channels blue, green, red, whatever its encoding is.
# 5. If an image cannot be converted, the node *logs* the error, at most every five seconds, and skips the image. One wrong message must not end the node.
# 6. This is the only line that processes the image. It does not use ROS.
# 7. The node converts the result to a message and publishes it. It **copies the header**, so that the receiver knows when the image was taken.
#
# ## 3 · Planned failure: the cell that never returns (7 minutes)
#
# Most ROS tutorials end with `rclpy.spin(node)`. In a script this is right: the script runs until you press Ctrl-C. **Predict** what it does in a notebook cell.
#
# A cell with `rclpy.spin(node)` shows `[*]` and never ends, and all other cells have to wait. (**Kernel → Interrupt Kernel** stops it.) The second of the next two cells spins for only three seconds, so that this lesson can continue. During these seconds, try to run another cell.

# %% tags=["nbval-ignore-output"]
if ros_available():
    from rclpy.executors import SingleThreadedExecutor

    session = RosSession.current()
    node = GrayNode(context=session.context)  # a context holds the state of ROS in this program
    executor = SingleThreadedExecutor(context=session.context)  # rclpy.spin uses this executor too
    executor.add_node(node)

# %% tags=["nbval-ignore-output"]
if ros_available():
    started = time.monotonic()
    while time.monotonic() < started + 3:  # rclpy.spin(node) has no such limit
        executor.spin_once(timeout_sec=0.1)
    blocked = time.monotonic() - started
    executor.remove_node(node)
    print(f"for {blocked:.0f} seconds no other cell could run")
    assert blocked >= 3

# %% [markdown]
# **Repair it**: spin in a background thread. The course's `RosSession` has such a thread, and its executor spins all nodes of this notebook. The thread stops when the kernel stops.

# %% tags=["nbval-ignore-output"]
if ros_available():
    session.add_node(node)
    gray_frames = ImageSubscriber("/gray_by_hand/gray", encoding="mono8")
    gray = gray_frames.wait(timeout=10)
    print("received from my own node:", gray.shape, gray.dtype)
    assert gray.shape == (720, 1280) and gray.dtype == np.uint8

# %% [markdown]
# **Look** at the result live. The camera publishes each image on a topic. Your node subscribes to this topic and publishes the gray image on a second topic. This page shows the images of the second topic. (Without ROS, the page shows the frames of the recording, converted by `to_gray`.)

# %% tags=["nbval-ignore-output"]
caption = "The drive in gray, live, with ten images per second."
alt = "The living room in gray, while the robot drives."
if ros_available():
    view = live_view(gray_frames, encoding="mono8", caption=caption, alt=alt)
else:
    view = live_view(open_recording("drive"), to_gray, caption=caption, alt=alt)
assert view.running

# %% [markdown]
# ## 4 · The same node for every function (6 minutes)
#
# An edge-detection node needs the same lines; only the names and line 6 are different. So the course has one class for all such nodes: `ImageProcessor`. You give it the node's name, a function, and the names of the function's results. The function gets a frame and returns a dictionary. The node publishes each value of the dictionary on the topic that its key names: `"gray"` goes to `~/gray`.

# %%
def make_gray(frame):
    return {"gray": to_gray(frame)}


result = make_gray(frame)
print({key: (array.shape, str(array.dtype)) for key, array in result.items()})

assert (result["gray"] == cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)).all()

# %% [markdown]
# On a robot, speed is important, so a real node calls OpenCV's `cvtColor` here. The assert checks that both functions give the same gray level for every pixel.
#
# If a message cannot be converted, or if your function raises an error, `ImageProcessor` counts the failure and the node continues. The next function fails for every second image, on purpose. The lines on a red background are the node's *log*. A script writes its log to the terminal; a notebook shows it under the running cell. `INFO` lines are information, `WARN` lines are warnings.

# %% tags=["nbval-ignore-output"]
calls = []


def failing(frame):
    calls.append(1)
    if len(calls) % 2:
        raise ValueError("I fail on every second image")
    return make_gray(frame)


# %% tags=["nbval-ignore-output"]
if ros_available():
    from imgproc_course.ros import ImageProcessor

    failing_node = session.add_node(ImageProcessor("failing", failing, ["gray"], context=session.context))
    gray_images = ImageSubscriber("/failing/gray", encoding="mono8")
    for _ in range(3):
        gray_images.wait(timeout=10)
    statistics = failing_node.statistics()
    print("processed", statistics["processed"], " failed", statistics["failed"])
    assert statistics["processed"] >= 3 and statistics["failed"] >= 2
    session.remove_node(failing_node)

# %% [markdown]
# ## 5 · Your turn: the node's function (8 minutes)
#
# Write `process(frame)`, the function of a grayscale node. You may use `cv2` and `np`, which are imported already. If you use something else (for example `to_gray`), import it in this cell. Do not change the frame, because other code may use it too. The key, the shape and the dtype must be exactly as in the table.
#
# | Input | Output | Example call |
# |---|---|---|
# | `frame`: (height, width, 3) uint8, channels blue, green, red | a dictionary with one key, `"gray"`; its value is the luma, (height, width) uint8 | `process(frame)["gray"].shape` is `(720, 1280)` |

# %% role="exercise"
exercise(
    "node-process",
    title="The grayscale node's function",
    function="process",
    time_limit=5,
    refused=(),
    hint="cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY) computes it; put the result into a dictionary.",
    hints=(
        "What does `make_gray` in section 4 return: an array, or an array with a name? And which call of OpenCV"
        " gives the same gray image as `to_gray`?",
        "Convert the frame with `cv2.cvtColor` and the conversion code `cv2.COLOR_BGR2GRAY`. Put the result into a"
        " dictionary: the key is the text `\"gray\"`, the value is the image. Return the dictionary.",
        'gray = cv2.cvtColor(frame, ...)\nreturn {"gray": ...}',
    ),
    explanation="`cv2.cvtColor` makes a new array, so the frame does not change. The conversion code begins with"
    " BGR, because the node reads every image as bgr8. The node takes the key as the name of the topic: the image"
    " under `\"gray\"` is published on `~/gray`.",
    another_way="You can also call `to_gray(frame)`, if you write its import line"
    " (`from imgproc_course.imaging import to_gray`) in the answer cell.",
)


def gray_of(frame):
    return cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)


def weighted(frame, blue, green, red):
    return blue * frame[..., 0] + green * frame[..., 1] + red * frame[..., 2]


# %% role="answer"
def process(frame):
    raise NotImplementedError("your turn: delete this line and write the function")


# %% role="solution"
def process(frame):
    return {"gray": cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)}


# %% role="check"
check("node-process", process)


# %% role="case" title="a small frame" points=1 hint="Is the image the luma of the frame? cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY) computes it."
def inputs(rng):
    return (rng.integers(0, 256, size=(6, 8, 3), dtype=np.uint8),)


# %% role="case" title="a larger frame" points=0 hint="Is every value equal to OpenCV's? cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY) computes it."
def inputs(rng):
    return (rng.integers(0, 256, size=(48, 64, 3), dtype=np.uint8),)


# %% role="hidden" title="any frame" points=1 hint="Blue comes first. Which of OpenCV's conversion codes starts with BGR?"
def inputs(rng):
    return (rng.integers(0, 256, size=(30, 40, 3), dtype=np.uint8),)


# %% role="mistake" name="the array without its dictionary" says="You return the image itself. The node also needs the name of its topic: return a dictionary, {\"gray\": image}."
def process(frame):
    return gray_of(frame)


# %% role="mistake" name="a tuple of name and image" says="You return a tuple with the name and the image. Return a dictionary: {\"gray\": image}, with curly brackets and a colon."
def process(frame):
    return "gray", gray_of(frame)


# %% role="mistake" name="a list with the dictionary" says="You return a list with the dictionary in it. Return the dictionary alone: {\"gray\": image}."
def process(frame):
    return [{"gray": gray_of(frame)}]


# %% role="mistake" name="the gray image as a list" says="The value under \"gray\" is a list of lists. It must be an array: leave out tolist()."
def process(frame):
    return {"gray": gray_of(frame).tolist()}


# %% role="mistake" name="red and blue exchanged" says="The weights of red and blue are exchanged: the frame is BGR (blue first), not RGB. Use COLOR_BGR2GRAY."
def process(frame):
    return {"gray": cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY)}


# %% role="mistake" name="decimal weights of red and blue exchanged" says="The weights of red and blue are exchanged: the frame is BGR (blue first), not RGB. Use COLOR_BGR2GRAY."
def process(frame):
    return {"gray": np.round(weighted(frame, 0.299, 0.587, 0.114)).astype(np.uint8)}


# %% role="mistake" name="decimal weights of red and blue exchanged, truncated" says="The weights of red and blue are exchanged: the frame is BGR (blue first), not RGB. Use COLOR_BGR2GRAY."
def process(frame):
    return {"gray": weighted(frame, 0.299, 0.587, 0.114).astype(np.uint8)}


# %% role="mistake" name="red and blue exchanged, without a dictionary" says="The weights of red and blue are exchanged: the frame is BGR (blue first), not RGB. Use COLOR_BGR2GRAY. And return a dictionary, {\"gray\": image}."
def process(frame):
    return cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY)


# %% role="mistake" name="gray with three channels" says="Your image is gray, but it has three equal channels. A gray image has one number per pixel: (height, width)."
def process(frame):
    return {"gray": cv2.cvtColor(gray_of(frame), cv2.COLOR_GRAY2BGR)}


# %% role="mistake" name="the frame itself" says="Your value is the frame itself, with its three channels. Convert it first: one number per pixel, (height, width). Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame.copy()}


# %% role="mistake" name="the key grey" says="Your image is right, but its key is \"grey\" and not \"gray\", so it would go to a topic without subscribers."
def process(frame):
    return {"grey": gray_of(frame)}


# %% role="mistake" name="the key Gray" says="Your image is right, but its key is \"Gray\" and not \"gray\", so it would go to a topic without subscribers. Keys are compared letter by letter: no capital letter."
def process(frame):
    return {"Gray": gray_of(frame)}


# %% role="mistake" name="the key image" says="Your image is right, but its key is \"image\" and not \"gray\", so it would go to a topic without subscribers."
def process(frame):
    return {"image": gray_of(frame)}


# %% role="mistake" name="the key mono8" says="Your image is right, but its key is \"mono8\" and not \"gray\", so it would go to a topic without subscribers."
def process(frame):
    return {"mono8": gray_of(frame)}


# %% role="mistake" name="the topic as the key" says="Your image is right, but its key is \"~/gray\" and not \"gray\", so it would go to a topic without subscribers. The node writes the ~/ itself."
def process(frame):
    return {"~/gray": gray_of(frame)}


# %% role="mistake" name="the frame as a second key" says="The image under \"gray\" is right, but there is another key, \"frame\". The task asks for one key only, \"gray\"."
def process(frame):
    return {"frame": frame.copy(), "gray": gray_of(frame)}


# %% role="mistake" name="the average" says="This is the average of the three channels. Luma is a weighted sum: green counts most. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame.mean(axis=2).astype(np.uint8)}


# %% role="mistake" name="the average, rounded" says="This is the average of the three channels. Luma is a weighted sum: green counts most. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": np.round(frame.mean(axis=2)).astype(np.uint8)}


# %% role="mistake" name="the average, as float" says="This is the average of the three channels. Luma is a weighted sum: green counts most. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame.mean(axis=2)}


# %% role="mistake" name="the average, added as uint8" says="This is the average of the three channels, and the sum was computed in uint8: above 255 it starts again at 0 (overflow). Luma is a weighted sum. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": (frame[..., 0] + frame[..., 1] + frame[..., 2]) // np.uint8(3)}


# %% role="mistake" name="decimal weights, truncated" says="The values are truncated, not rounded: the fraction is dropped. Round before you narrow, or let cv2.cvtColor do it."
def process(frame):
    return {"gray": weighted(frame, 0.114, 0.587, 0.299).astype(np.uint8)}


# %% role="mistake" name="integer weights, truncated" says="The values are truncated, not rounded: the fraction is dropped. Round before you narrow, or let cv2.cvtColor do it."
def process(frame):
    return {"gray": (weighted(frame.astype(np.uint32), 3735, 19235, 9798) >> 15).astype(np.uint8)}


# %% role="mistake" name="decimal weights, rounded" says="Nearly all values are right; a few differ by one gray level. This is the effect of decimal weights (0.114, 0.587, 0.299): with cv2.cvtColor, all values are right."
def process(frame):
    return {"gray": np.round(weighted(frame, 0.114, 0.587, 0.299)).astype(np.uint8)}


# %% role="mistake" name="decimal weights, as float" says="The values still have fractions, and the dtype is float. The image must be uint8. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": weighted(frame, 0.114, 0.587, 0.299)}


# %% role="mistake" name="the blue channel" says="You return the blue channel alone. Luma is a weighted sum of blue, green and red. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame[..., 0].copy()}


# %% role="mistake" name="the green channel" says="You return the green channel alone. Luma is a weighted sum of blue, green and red. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame[..., 1].copy()}


# %% role="mistake" name="the red channel" says="You return the red channel alone. Luma is a weighted sum of blue, green and red. Use cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), which computes luma."
def process(frame):
    return {"gray": frame[..., 2].copy()}


# %% role="mistake" name="upside down" says="The gray image is right, but upside down: [::-1] reverses the rows. Here, return the gray image as it is; section 6 is for such changes."
def process(frame):
    return {"gray": gray_of(frame)[::-1].copy()}


# %% role="mistake" name="left and right exchanged" says="The gray image is right, but flipped from left to right. Here, return the gray image as it is; section 6 is for such changes."
def process(frame):
    return {"gray": gray_of(frame)[:, ::-1].copy()}


# %% role="mistake" name="the negative" says="The gray image is inverted (255 - gray). Here, return the gray image as it is; section 6 is for such changes."
def process(frame):
    return {"gray": 255 - gray_of(frame)}


# %% role="mistake" name="a call that OpenCV refuses" says="OpenCV could not use these arguments. cv2.cvtColor takes an array and a conversion code: cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY). (cv2.imread reads a file, and frame is an array already.)"
def process(frame):
    return {"gray": cv2.cvtColor(frame)}


# %% [markdown]
# ## 6 · Practice: your node, live (8 minutes)
#
# Run your own `process` in a node and watch its images. In the second of the next two cells, replace `make_gray` by `process` and run the cell. Then change `process` in your answer cell: turn the image upside down, draw a border around it, or keep only the red channel. After each change, run the answer cell and then the second cell again. The second cell removes the old node before it starts the new one.

# %%
my_node = None

# %% tags=["nbval-ignore-output"]
if ros_available():
    session.remove_node(my_node)  # the node of the previous run of this cell; on the first run there is none
    my_node = session.add_node(ImageProcessor("my_node", make_gray, ["gray"], context=session.context))
    my_images = ImageSubscriber("/my_node/gray", encoding="mono8")
    my_image = my_images.wait(timeout=10)
    my_view = live_view(my_images, encoding="mono8", caption="The images that my node publishes.",
                        alt="The images of my own node, live.")
    assert my_image.shape == (720, 1280)

# %% [markdown]
# ## Recap
#
# A node subscribes to a topic with a callback. The callback converts the message, processes the frame, publishes the result with the copied header, and logs failures. In a notebook, spin the node in a background thread.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | `msg.data` | (2764800,) | uint8 | 0 to 255 | byte |
# | *frame*, `bgr8` | (720, 1280, 3) | uint8 | 0 to 255 | gray level of blue, green, red |
# | *gray*, published as `mono8` | (720, 1280) | uint8 | 0 to 255 | gray level |

# %%
assert frame.shape == (720, 1280, 3) and frame.size == 2_764_800
assert make_gray(frame)["gray"].shape == (720, 1280)
