# ---
# jupyter:
#   imgproc_course:
#     title: The grayscale node
# ---

# %% [markdown]
# # The grayscale node
#
# A function converts one frame to gray. A *node* is a program that takes part in ROS. A grayscale node converts every image that the camera sends, and publishes the results for other nodes. To make a node from the function, you need only a few lines, but some mistakes are easy to make.
#
# **You will be able to**
# - read a Python *class*, and pass a function to it as a *callback*,
# - write a ROS 2 node that subscribes, converts, processes and publishes, and explain each of its lines,
# - choose QoS policies (rules for how messages are delivered), copy a header, and keep a node running when an image cannot be converted,
# - deeper: explain what `rclpy.spin` does in a script and in a notebook (`rclpy` is the Python library of ROS 2).
#
# **Time** [[minutes]], with a pause after section 3. **You need** [[images_as_messages]] and [[grayscale]]. This lesson needs a running ROS 2. Without ROS 2 (macOS, Windows without WSL), the cells that begin with `if ros_available():` do nothing: their results, and still images of the live views, are on the page that `environment/site --serve` opens. Read the lesson, and do the exercises: their checks work without ROS 2.

# %% role="given" exercise=["node-process"]
import cv2
import numpy as np

# %%
from imgproc_course.display import live_view
from imgproc_course.exercises import check, compare_guess, hint
from imgproc_course.exercises import offer_modules, solution
from imgproc_course.imaging import to_gray
from imgproc_course.recording import open_recording
from imgproc_course.ros import ImageSubscriber, RosSession
from imgproc_course.ros import open_camera, ros_available

offer_modules()  # for the exercise in section 7
frame = open_recording("drive").frame(30)
if ros_available():
    camera = open_camera("recording")
    print("the camera publishes", camera.topic)

# %% role="texts"
figure_texts = {
    "gray": (
        "The drive in gray, live, with ten images per second.",
        "The living room in gray, while the robot drives.",
    ),
    "mine": (
        "The images that my node publishes.",
        "The images of my own node, live.",
    ),
}

# %% [markdown]
# ## 1 · A callback is a function that ROS calls ([[minutes]])
#
# **Ask.** Until now you called `wait` and waited for an image. A node does not wait. It subscribes to a topic and passes a function, its *[[term:callback]]*. ROS calls this function for every message that arrives. This is what happens to an image in a grayscale node:
#
# ```mermaid
# %%{init: {"theme": "base", "themeVariables": {"primaryColor": "#e3eefc", "primaryTextColor": "#111", "lineColor": "#777", "tertiaryColor": "#ededed", "edgeLabelBackground": "#ededed"}}}%%
# flowchart TB
#     accTitle: What happens to an image
#     accDescr: The camera publishes the topic image_raw. The gray node subscribes to it and publishes the topic gray. This page subscribes to gray and shows the images.
#     camera(["camera"]) -->|publishes| raw["topic<br>.../image_raw"]
#     raw -->|subscription calls on_image| node(["gray node"])
#     node -->|publishes| gray["topic<br>.../gray"]
#     gray -->|subscription| view(["live view<br>in this page"])
# ```

# %% [markdown]
# ### How often is it called? ([[minutes]], deeper)
#
# The next cell defines a callback. It has two arguments: the frame, and the message from which the frame was made. It stores the message's *stamp*: the time at which the image was taken.

# %%
stamps = []


def on_image(frame, msg):
    stamps.append(msg.header.stamp)

# %% [markdown]
# The camera sends ten images per second. **Predict** how often ROS calls this function while the next cell sleeps for two seconds.

# %% role="predict"
guess_calls = None  # your guess: how many calls in two seconds?

# %% tags=["nbval-ignore-output"]
import time

if ros_available():
    subscriber = ImageSubscriber(camera.topic, on_image)
    subscriber.wait(timeout=10)
    stamps.clear()
    time.sleep(2)
    subscriber.stop()
compare_guess(guess_calls, len(stamps))

# %%
# Check: ten images per second, and never two calls for one image
assert not ros_available() or camera.rate == 10
assert len({(stamp.sec, stamp.nanosec) for stamp in stamps}) == len(stamps)

# %% [markdown]
# ROS called the function about twenty times, although your cell only slept.
#
# How can this be? The callback ran in a background *[[term:thread]]*. A thread is a part of a program that runs at the same time as the other parts. Your cells run in the main thread. In the background thread, an *[[term:executor]]* waits for messages and calls the callbacks, again and again. This is called *[[term:spin|spinning]]*.
#
# ```mermaid
# %%{init: {"theme": "base", "themeVariables": {"primaryColor": "#e3eefc", "primaryTextColor": "#111", "lineColor": "#777", "tertiaryColor": "#ededed", "edgeLabelBackground": "#ededed"}}}%%
# flowchart TB
#     accTitle: Executor, callback and thread
#     accDescr: The main thread runs your cells. At the same time, the executor in a background thread waits for a message from the topic, calls on_image, and waits for the next message.
#     topic["topic<br>.../image_raw"] -->|message| background
#     subgraph background ["background thread"]
#         executor(["executor:<br>waits for a message"]) -->|calls| callback["on_image(frame, msg)"]
#         callback -->|returns| executor
#     end
#     subgraph main ["main thread"]
#         cells["your cells:<br>time.sleep(2)"]
#     end
# ```

# %% [markdown]
# ## 2 · A class in ten lines ([[minutes]])
#
# In Python, a node is written as a *[[term:class]]*. If you know classes already, go on with section 3. This section does not use ROS. A class describes objects: which values they have, and what they can do. Here is a bell. If you want to know when it rings, you give it a callback.

# %%
class Bell:
    def __init__(self, name):
        self.name = name
        self.callbacks = []

    def subscribe(self, callback):
        self.callbacks.append(callback)

    def ring(self):
        for callback in self.callbacks:
            callback(self.name)

# %% [markdown]
# - `class Bell:` begins the class. The functions inside it are its *[[term:method|methods]]*.
# - `Bell("front door")` will create an object. Python then calls the method `__init__`.
# - `self` is the object itself. Python passes it as the first argument of every method; you do not write it in the call.
# - `self.name` is a value that belongs to the object, an *attribute*. Each bell has its own name and its own list of callbacks.
# - `callback(self.name)` calls a function that somebody else wrote. The bell does not know what the function does.
#
# The next cell makes a bell and subscribes a function. Look at `on_ring`: it is written *without* parentheses, because we pass the function itself and do not call it. Then the bell rings twice. **Predict** how many names are in the list at the end.

# %% role="predict"
guess_rings = None  # your guess: how many names are in the list?

# %%
rung = []


def on_ring(name):
    rung.append(name)


bell = Bell("front door")
bell.subscribe(on_ring)
bell.ring()
bell.ring()
print(rung)
compare_guess(guess_rings, len(rung))

# %%
# Check: subscribe does not call the function, each ring calls it once
assert rung == ["front door", "front door"]

# %% [markdown]
# You never called `on_ring`. The bell called it, once for each ring. In the same way, ROS calls your callback once for each message.
#
# A class can extend another class. `CountingBell(Bell)` *[[term:inherit|inherits]]* from `Bell`: it has everything that `Bell` has, and more. `super().__init__(name)` runs the `__init__` of `Bell` first, which sets the name and the list. A method can be a callback too: `self.on_ring`.

# %%
class CountingBell(Bell):
    def __init__(self, name):
        super().__init__(name)
        self.rings = 0
        self.subscribe(self.on_ring)

    def on_ring(self, name):
        self.rings = self.rings + 1


back_door = CountingBell("back door")
for _ in range(3):
    back_door.ring()
print(back_door.name, "rang", back_door.rings, "times")

# %%
# Check: what the counting bell has of its own, and what it has from Bell
assert (back_door.name, back_door.rings, len(back_door.callbacks)) == ("back door", 3, 1)

# %% [markdown]
# Remember this form: a class that inherits, an `__init__` that begins with `super().__init__(...)` and subscribes, and a method that is the callback. The node in the next section has exactly this form.

# %% [markdown]
# ## 3 · The node, line by line ([[minutes]])
#
# A node that works with images does four things: it **subscribes** to a topic, **converts** each message to an array, **processes** the array, and **publishes** (or displays) the result.
#
# It needs `rclpy` (nodes, topics and the log), `sensor_msgs` (the message types of sensors, such as `Image`), a converter between messages and arrays (`cv_bridge`, or here the course's `image_to_array` and `array_to_image`), OpenCV and NumPy.
#
# **The steps of the implementation**
# 1. Choose the QoS policies.
# 2. Write a class that inherits from `Node`, and give the node a name.
# 3. Create a publisher for the results, and a subscription to the camera's topic with a callback.
# 4. In the callback, convert the message to an array, and log an error if this fails.
# 5. Process the array, convert the result to a message with the same header, and publish it.
# 6. Create the node and *[[term:spin]]* it: wait for messages and call the callbacks, again and again.
#
# Step 1: the *QoS policies* (quality of service) say how messages are delivered. The next cell states the three that matter for a camera:

# %%
if ros_available():
    from rclpy.node import Node
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import Image

    camera_qos = QoSProfile(
        depth=5,
        reliability=ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.VOLATILE,
    )

# %%
# Check: these are the policies of qos_profile_sensor_data
for policy in ("reliability", "durability", "history", "depth"):
    assert not ros_available() or getattr(camera_qos, policy) == getattr(qos_profile_sensor_data, policy)

# %% [markdown]
# - **reliability: best effort.** A lost image is not sent again, because a late image is useless.
# - **durability: volatile.** Images that were published before the subscription existed are not delivered.
# - **depth: 5.** At most five messages wait in a queue until the callback has time for them.
#
# `rclpy` has a ready profile with the same policies: `qos_profile_sensor_data`.
#
# Steps 2 to 5: here is the whole node, as it would run on a robot. The numbers at the ends of the lines refer to the list below.

# %% tags=["long"]
if ros_available():
    from imgproc_course.messages import ConversionError
    from imgproc_course.messages import array_to_image, image_to_array

    TOPIC = camera.topic

    class GrayNode(Node):
        """Converts the camera's images to gray and publishes them."""

        def __init__(self, context=None):
            super().__init__("gray_by_hand", context=context)                # 1
            self.publisher = self.create_publisher(                          # 2
                Image, "~/gray", camera_qos
            )
            self.create_subscription(                                        # 3
                Image, TOPIC, self.on_image, camera_qos
            )
            self.get_logger().info("The gray node has started.")             # 4

        def on_image(self, msg):
            """Called by ROS for every image."""
            try:
                frame = image_to_array(msg, "bgr8")                          # 5
            except ConversionError as error:
                self.get_logger().error(str(error))                          # 6
                return
            gray = to_gray(frame)                                            # 7
            gray_msg = array_to_image(gray, "mono8", msg.header)             # 8
            self.publisher.publish(gray_msg)                                 # 9

# %% [markdown]
# **The code, explained**
# 1. `GrayNode` inherits from ROS's class `Node`. `"gray_by_hand"` is the node's name. Other programs see it in the *[[term:ROS graph]]*: the network of all running nodes and topics. You can ignore the *[[term:context]]*: it holds the state of ROS in one program, and a script does not pass one.
# 2. The node creates a *[[term:publisher]]* for messages of the type `Image` on `~/gray`. ROS replaces `~` by the node's name: `/gray_by_hand/gray`. So a node with another name publishes on another topic.
# 3. The node creates a *[[term:subscription]]* to the camera's topic. The callback is the method `on_image`, without parentheses.
# 4. The node *[[term:log|logs]]* one line of information when it starts. A node does not use `print`: a log line also has a time, a level (`INFO`, `WARN`, `ERROR`) and the node's name.
# 5. `image_to_array` converts the message to an array with the channels blue, green, red, whatever the message's encoding is.
# 6. If an image cannot be converted, the node logs the error and skips the image. One wrong message must not end the node. `try` runs the lines below it. If they raise a `ConversionError`, Python goes on at `except`, and `return` then leaves the callback.
# 7. This is the only line that processes the image. It does not use ROS.
# 8. The node converts the result to a message. It **copies the header**, so that the receiver knows when the image was taken.
# 9. The node publishes the message.
#
# **What other tutorials write.** Most tutorials convert with `cv_bridge`. Its two methods are `imgmsg_to_cv2` (message to array, as in line 5) and `cv2_to_imgmsg` (array to message, as in line 8; its third argument can be a header). If it is not installed, `offer_modules()` in the cell with the imports makes this import work too: you get the course's own class.

# %%
from cv_bridge import CvBridge, CvBridgeError

bridge = CvBridge()
msg = bridge.cv2_to_imgmsg(frame, "bgr8")  # an array becomes a message
array = bridge.imgmsg_to_cv2(msg, "bgr8")  # a message becomes an array
print(msg.encoding, msg.height, msg.width, "->", array.shape, array.dtype)

# %%
# Check: both conversions together change no pixel
assert (array == frame).all() and msg.encoding == "bgr8"

# %% [markdown]
# Older files write `QoSReliabilityPolicy` and `QoSDurabilityPolicy`. They are the same classes as `ReliabilityPolicy` and `DurabilityPolicy`.
#
# In many files you see `except Exception` around the whole callback. Do not copy it: it also catches your own mistakes. If you misspell a name in the callback, such a node logs an error for every image, and you look for the fault in the camera. Put only the conversion inside `try`, and catch only what a bad message causes: `ConversionError`, or `CvBridgeError` if you convert with `CvBridge`. Every other error ends the node, and shows you the line.
#
# Step 6: a script ends with a function `main`:
#
# ```python
# def main(args=None):
#     rclpy.init(args=args)
#     node = ImageGrayProcessor()
#     try:
#         rclpy.spin(node)
#     except (KeyboardInterrupt, ExternalShutdownException):
#         pass
#     finally:
#         node.destroy_node()
#         rclpy.try_shutdown()
# ```
#
# `ImageGrayProcessor` is the node that you write in section 7. `args` are the arguments of the command line, such as [[term:remapping|remappings]]; `None` means: those with which the program was started. In a script `rclpy.spin(node)` is right: it runs until Ctrl-C raises one of these exceptions, which most tutorials forget. (You run such a script in [[ros2_packages]].)
#
# **Pause?** Then choose **Run → Run All Above Selected Cell** when you come back.

# %% [markdown]
# ### A full queue ([[minutes]], deeper)
#
# What happens when the callback is slow and the queue is full? Python has such a queue too: `deque(maxlen=5)`. The next cell puts the images 1 to 7 into it. **Predict** which image is the first one in the queue at the end.

# %% role="predict"
guess_oldest = None  # your guess: the number of the first image in the queue?

# %%
from collections import deque

queue = deque(maxlen=5)
for number in range(1, 8):  # 1, 2, ..., 7
    queue.append(number)
print(queue)
compare_guess(guess_oldest, queue[0])

# %%
# Check: the two oldest images are gone
assert list(queue) == [3, 4, 5, 6, 7]

# %% [markdown]
# The oldest images are dropped. For a robot this is right: the newest image is the most useful one.
#
# ### Windows ([[minutes]], deeper)
#
# Most tutorials also show the image in a window. `cv2.imshow("gray", gray)` draws it, `cv2.waitKey(1)` gives the window one millisecond to react to mouse and keyboard, and `cv2.destroyAllWindows()` closes all windows at the end. A notebook runs in a browser, maybe on another computer than the node, and cannot open such windows. So here you use `live_view`.
#
# ## 4 · rclpy.spin in a notebook ([[minutes]], deeper)
#
# What does `rclpy.spin` do in a notebook? We make the node first:

# %% tags=["nbval-ignore-output"]
if ros_available():
    from rclpy.executors import SingleThreadedExecutor

    session = RosSession.current()
    node = GrayNode(context=session.context)
    executor = SingleThreadedExecutor(context=session.context)
    executor.add_node(node)

# %%
# Check: the node has its name
assert not ros_available() or node.get_name() == "gray_by_hand"

# %% [markdown]
# The line that begins with `[INFO]` is the node's log. A script writes its log to the terminal; a notebook shows it below the cell that made the node.
#
# `rclpy.spin` uses such an executor too. The next cell spins for three seconds; `rclpy.spin(node)` does the same without a limit. (In the f-string, `{blocked:.0f}` writes the number without digits after the point; `:.2f` writes two digits.) **Predict**: while a cell spins, can you run another cell?

# %% role="predict"
guess_other_cells = None  # your guess: can another cell run, "yes" or "no"?

# %% tags=["nbval-ignore-output"]
started = time.monotonic()
while time.monotonic() < started + 3:
    if ros_available():
        executor.spin_once(timeout_sec=0.1)
blocked = time.monotonic() - started
print(f"this cell ran for {blocked:.0f} seconds")
compare_guess(guess_other_cells, blocked < 3)

# %%
# Check: the cell did not return earlier
assert blocked >= 3

# %% [markdown]
# This was the **planned failure**. While the cell runs, it shows `[*]`, and all other cells wait. A cell with `rclpy.spin(node)` never ends by itself; **Kernel → Interrupt Kernel** stops it.
#
# **Repair it**: spin in a background thread. The course's `RosSession` has such a thread, and its executor spins all nodes of this notebook. The thread stops when the kernel stops.

# %% tags=["nbval-ignore-output"]
if ros_available():
    executor.remove_node(node)
    session.add_node(node)
    gray_frames = ImageSubscriber("/gray_by_hand/gray", encoding="mono8")
    gray = gray_frames.wait(timeout=10)
    print("received from my own node:", gray.shape, gray.dtype)

# %%
# Check: the node publishes gray images of the camera's size
assert not ros_available() or (gray.shape == (720, 1280) and gray.dtype == np.uint8)

# %% [markdown]
# **Look** at the result live. The camera publishes each image on a topic. Your node subscribes to this topic and publishes the gray image on a second topic. This page shows the images of the second topic. (Without ROS, the page shows the frames of the recording, converted by `to_gray`.)

# %% tags=["nbval-ignore-output"]
if ros_available():
    view = live_view(gray_frames, encoding="mono8", text="grayscale_node/gray")
else:
    drive = open_recording("drive")
    view = live_view(drive, to_gray, text="grayscale_node/gray")

# %%
# Check: the live view has no error
assert view.error is None

# %% [markdown]
# ## 5 · The same node for every function ([[minutes]], deeper)
#
# An edge-detection node needs the same lines; only the names and line 7 are different. So the course has one class for all such nodes: `ImageProcessor`. You give it the node's name, a function, and the names of the function's results. The function gets a frame and returns a dictionary. The node publishes each value of the dictionary on the topic that its key names: `"gray"` goes to `~/gray`.

# %%
def make_gray(frame):
    return {"gray": to_gray(frame)}


result = make_gray(frame)
print("keys:", list(result))
print("gray:", result["gray"].shape, result["gray"].dtype)

# %%
# Check: OpenCV computes the same gray level for every pixel
assert (result["gray"] == cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)).all()

# %% [markdown]
# On a robot, speed is important, so a real node calls OpenCV's `cvtColor` here. Both functions give the same gray level for every pixel.
#
# If a message cannot be converted, or if your function raises an error, `ImageProcessor` counts the failure, logs it, and the node continues. The next function fails for every second image, on purpose. So the log below the second cell has a line with `[WARN]`.

# %%
calls = []


def failing(frame):
    calls.append(1)
    if len(calls) % 2 == 1:
        raise ValueError("I fail on every second image")
    return make_gray(frame)

# %% tags=["nbval-ignore-output"]
if ros_available():
    from imgproc_course.ros import ImageProcessor

    failing_node = session.add_node(
        ImageProcessor("failing", failing, ["gray"], context=session.context)
    )
    gray_images = ImageSubscriber("/failing/gray", encoding="mono8")
    for _ in range(6):
        gray_images.wait(timeout=10)
    statistics = failing_node.statistics()
    print("processed", statistics["processed"], " failed", statistics["failed"])
    session.remove_node(failing_node)

# %%
# Check: the node failed again and again, and continued
assert not ros_available() or (statistics["processed"] >= 6 and statistics["failed"] >= 5)

# %% [markdown]
# ## 6 · Your turn: the node's function ([[minutes]], deeper)
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
    exact_type=True,
    time_limit=5,
    allowed=("cv2", "imgproc_course.imaging"),
    hint="cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY) computes it; put the result into a dictionary.",
    hints=(
        "What does make_gray in section 5 return: an array, or an array with a name? And which call of OpenCV"
        " gives the same gray image as to_gray?",
        "1. Convert the frame with cv2.cvtColor and the conversion code cv2.COLOR_BGR2GRAY.\n"
        "2. Put the result into a dictionary: the key is the text \"gray\", the value is the image.\n"
        "3. Return the dictionary.",
        'gray = cv2.cvtColor(frame, ...)\nreturn {"gray": ...}',
    ),
    explanation="cv2.cvtColor makes a new array, so the frame does not change. The conversion code begins with"
    " BGR, because the node reads every image as bgr8. The node takes the key as the name of the topic: the image"
    " under \"gray\" is published on ~/gray.",
    border_hint="Every pixel gets its gray level from its own three channels, also at the border of the image. Do you"
    " change or leave out the first or last rows or columns?",
    another_way="You can also call to_gray(frame), if you write its import line"
    " (from imgproc_course.imaging import to_gray) in the answer cell.",
)

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
    frame = rng.integers(0, 256, size=(30, 40, 3), dtype=np.uint8)
    frame[0, :2] = [128, 1, 78], [65, 168, 127]  # colours for which decimal weights give another gray level
    return (frame,)

# %% [markdown]
# ## 7 · Your turn: the whole node ([[minutes]])
#
# Write the class `ImageGrayProcessor`, as you would write it for a robot. The check makes a node of your class, sends it images, and looks at what it publishes and logs. Do one step after the other, and run the check after each step. The check shows one line for each step.
#
# 1. **Subscribe.** `__init__` gives the node the name `image_gray_processor`. It creates a publisher for `Image` on `~/gray`, and a subscription to `Image` on `/kachaka/front_camera/image_raw` with the callback `self.image_callback`, best effort, volatile, depth 5. *Afterwards* ROS connects the camera with your node.
# 2. **Answer.** `image_callback` converts the message to a frame with `self.bridge.imgmsg_to_cv2(msg, "bgr8")`, makes it gray with `cv2.cvtColor`, and publishes it as `mono8` with the header of `msg`. *Afterwards* each image of the camera gives one gray image.
# 3. **Survive.** If a message cannot be converted, the node logs an error with `self.get_logger().error(...)` and publishes nothing. *Afterwards* a bad message costs one image, and not the node.
#
# The answer cell must work alone: define your `QoSProfile` in it. The node must not call `rclpy.spin`, `time.sleep` or `cv2.imshow`.

# %% role="exercise"
exercise(
    "node-class",
    subject="node",
    title="The grayscale node",
    function="ImageGrayProcessor",
    time_limit=2,
    allowed=("cv2", "imgproc_course.messages", "imgproc_course.imaging"),
    hint="Compare your class with GrayNode in section 3, line by line.",
    hints=(
        "Compare with GrayNode in section 3. Which of its nine lines belong to step 1, which to step 2, and"
        " which to step 3?",
        "1. In __init__, call super().__init__ with the name, make a QoSProfile with depth, reliability and durability,"
        " then the publisher and the subscription.\n"
        "2. In image_callback, convert the message, convert to gray, convert back with the header, publish.\n"
        "3. Put try: and except CvBridgeError: around the first conversion. In except, log and return.",
        "qos = QoSProfile(depth=5, reliability=..., durability=...)\n"
        "self.publisher = self.create_publisher(Image, ..., qos)\n"
        "self.create_subscription(Image, ..., self.image_callback, qos)\n\n"
        'try:\n    frame = self.bridge.imgmsg_to_cv2(msg, "bgr8")\n'
        "except CvBridgeError as error:\n    ...\n    return",
    ),
    explanation="__init__ only creates; the callback only answers. The node keeps the publisher and the bridge as"
    " attributes, because the callback needs them. try contains the conversion alone, so that a mistake of yours is not"
    " taken for a bad message. The header is copied, so a receiver knows when the image was taken.",
    another_way="You can also write image_to_array and array_to_image with ConversionError instead of CvBridge, and"
    " qos_profile_sensor_data instead of a QoSProfile of your own.",
)


def blocks(rng):
    """A frame of coloured blocks."""
    colours = rng.integers(0, 256, size=(4, 6, 3), dtype=np.uint8)
    return colours.repeat(8, axis=0).repeat(8, axis=1)


def sent(image, number, encoding="bgr8", **more):
    """A step of a drive: an image of the camera."""
    return {
        "image": image,
        "encoding": encoding,
        "topic": "/kachaka/front_camera/image_raw",
        "stamp": (100 + number, 1000 * number + 7),
        "frame_id": f"camera_{number}",
    } | more


# %% role="answer"
import cv2
from cv_bridge import CvBridge, CvBridgeError
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Image


class ImageGrayProcessor(Node):
    def __init__(self):
        raise NotImplementedError("step 1: delete this line, and write it")
        self.bridge = CvBridge()

    def image_callback(self, msg):
        pass  # steps 2 and 3


# %% role="solution"
import cv2
from cv_bridge import CvBridge, CvBridgeError
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Image


class ImageGrayProcessor(Node):
    def __init__(self):
        super().__init__("image_gray_processor")
        self.bridge = CvBridge()
        qos = QoSProfile(
            depth=5,
            reliability=ReliabilityPolicy.BEST_EFFORT,
            durability=DurabilityPolicy.VOLATILE,
        )
        self.publisher = self.create_publisher(Image, "~/gray", qos)
        self.create_subscription(
            Image, "/kachaka/front_camera/image_raw", self.image_callback, qos
        )

    def image_callback(self, msg):
        try:
            frame = self.bridge.imgmsg_to_cv2(msg, "bgr8")
        except CvBridgeError as error:
            self.get_logger().error(str(error))
            return
        gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
        gray_msg = self.bridge.cv2_to_imgmsg(gray, "mono8", msg.header)
        self.publisher.publish(gray_msg)


# %% role="check"
check("node-class", ImageGrayProcessor)


# %% role="case" title="step 1: subscribe" points=1 hint="Compare the name, the topics and the three policies, letter by letter."
def inputs(rng):
    return ("setup", [])


# %% role="case" title="step 2: answer" points=1 hint="Does image_callback publish a mono8 image with the header of msg?"
def inputs(rng):
    return ("images", [sent(blocks(rng), 1), sent(blocks(rng), 2)])


# %% role="case" title="step 3: survive" points=1 hint="Put try around imgmsg_to_cv2. In except, log the error and return."
def inputs(rng):
    bad = sent(blocks(rng), 2, "bgr16", bad=True)
    return ("images", [sent(blocks(rng), 1), bad, sent(blocks(rng), 3)])


# %% role="hidden" title="other encodings, other bad messages" points=1 hint="Is bgr8 the second argument of imgmsg_to_cv2?"
def inputs(rng):
    gray = rng.integers(0, 256, size=(10, 12), dtype=np.uint8)
    return (
        "images",
        [
            sent(blocks(rng), 4, "rgb8"),
            sent(blocks(rng), 5, cut=True, bad=True),
            sent(gray, 6, "mono8"),
        ],
    )


# %% [markdown]
# **Run it.** If all three steps show ✓, the next cell makes a node of your class, and spins it in the background. The images below are those that your node publishes.

# %% tags=["nbval-ignore-output"]
if ros_available() and check("node-class", ImageGrayProcessor).passed:
    my_node = RosSession.current().add_node(ImageGrayProcessor)
    my_images = ImageSubscriber("/image_gray_processor/gray", encoding="mono8")
    my_view = live_view(my_images, encoding="mono8", text="grayscale_node/mine")
else:
    print("first all three steps of your class must pass; this also needs ROS 2")

# %% [markdown]
# ### Change your node ([[minutes]], deeper)
#
# Change your class, and run its cell and the cell above again; the new node replaces the old one. (If you run the check too, it shows ✗ for step 2, because it expects luma.) Ideas for the callback:
#
# - turn the image upside down: `gray[::-1]`,
# - invert it: `255 - gray`,
# - make the first twenty rows white: `gray[:20] = 255`,
# - publish the red channel alone: `gray = frame[..., 2]`. Red objects become bright.

# %% [markdown]
# ## Recap
#
# A node subscribes to a topic with a callback. The callback converts the message, processes the frame, publishes the result with the copied header, and logs failures. Deeper: in a notebook, spin the node in a background thread.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | `msg.data` | (2764800,) | uint8 | 0 to 255 | byte |
# | *frame*, `bgr8` | (720, 1280, 3) | uint8 | 0 to 255 | gray level of blue, green, red |
# | *gray*, published as `mono8` | (720, 1280) | uint8 | 0 to 255 | gray level |
#
# **Next:** [[noise_removal]], or [[canny_stages]] if you have one day. Before you go on, choose **File → Close and Shut Down Notebook**: otherwise this lesson continues to use the camera.

# %%
# Check: the numbers in the table
assert frame.shape == (720, 1280, 3) and len(msg.data) == frame.size == 2_764_800
assert to_gray(frame).shape == (720, 1280)
