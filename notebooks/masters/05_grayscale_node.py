# ---
# jupyter:
#   imgproc_course:
#     title: The grayscale node
# ---

# %% [markdown]
# # The grayscale node
#
# A *node* is a program that takes part in ROS. A grayscale node converts every image that the camera sends to gray, and publishes the results for other nodes.
#
# **You will be able to**
# - write a ROS 2 node that subscribes, converts, processes and publishes, and explain each of its lines,
# - choose QoS policies (rules for how messages are delivered), copy a header, and keep a node running when an image cannot be converted,
# - change a node, and predict what it publishes then,
# - deeper: read a Python *class*, and explain what `rclpy.spin` does.
#
# **Time** [[minutes]]. **You need** [[images_as_messages]] and [[grayscale]], and ROS 2. (The exercises can be checked without it.)

# %%
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

offer_modules()  # for the exercise in section 4
frame = open_recording("drive").frame(30)
if ros_available():
    camera = open_camera("recording")
    print("the camera publishes", camera.topic)

# %% role="texts"
figure_texts = {
    "gray": (
        "What the camera sends, and what the gray node publishes, live.",
        "The living room in colour, and beside it in gray, while the robot drives.",
    ),
    "mine": (
        "What the camera sends, and what my node publishes, live.",
        "The living room in colour, and beside it the images of my own node.",
    ),
}

# %% [markdown]
# ## 1 · A callback is a function that ROS calls ([[minutes]])
#
# Until now you called `wait` and waited for an image. A node does not wait. It subscribes to a topic and passes a function, its *[[term:callback]]*. ROS calls this function for every message that arrives:
#
# ```mermaid
# %%{init: {"theme": "base", "themeVariables": {"primaryColor": "#e3eefc", "primaryTextColor": "#111", "lineColor": "#777", "tertiaryColor": "#ededed", "edgeLabelBackground": "#ededed"}}}%%
# flowchart LR
#     accTitle: What happens to an image
#     accDescr: The camera publishes the topic image_raw. The gray node subscribes to it and publishes the topic gray. This page subscribes to gray and shows the images.
#     camera(["camera"]) --> raw["topic<br>image_raw"]
#     raw -->|calls<br>on_image| node(["gray node"])
#     node --> gray["topic<br>gray"]
#     gray --> view(["live view"])
# ```

# %% [markdown]
# ### How often is it called? ([[minutes]], deeper)
#
# This callback gets a frame, and the message from which it was made. It stores the message's *stamp*: the time at which the image was taken.

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
# ROS called the function about twenty times, although your cell only slept. If you have the command `ros2`, it counts the same in a terminal:
#
# ```
# $ ros2 topic hz /kachaka/front_camera/image_raw/compressed
# average rate: 10.002
# ```
#
# The callback ran in a background *[[term:thread]]*: a part of a program that runs at the same time as the other parts. There, an *[[term:executor]]* waits for messages and calls the callbacks, again and again. This is called *[[term:spin|spinning]]*. Your cells run in the main thread.
#
# ```mermaid
# %%{init: {"theme": "base", "themeVariables": {"primaryColor": "#e3eefc", "primaryTextColor": "#111", "lineColor": "#777", "tertiaryColor": "#ededed", "edgeLabelBackground": "#ededed"}}}%%
# flowchart LR
#     accTitle: Executor, callback and thread
#     accDescr: The main thread runs your cells. At the same time, the executor in a background thread waits for a message from the topic, calls on_image, and waits for the next message.
#     topic["topic<br>image_raw"] -->|message| background
#     subgraph background ["background thread"]
#         executor(["executor"]) -->|calls| callback["on_image"]
#         callback -->|returns| executor
#     end
#     subgraph main ["main thread"]
#         cells["your cells"]
#     end
# ```

# %% [markdown]
# ## 2 · A class in ten lines ([[minutes]], deeper)
#
# In Python, a node is written as a *[[term:class]]*. (If you know classes, go on with section 3.) A class says which values its objects have, and what they can do. Here is a bell, without ROS. To learn when it rings, give it a callback.

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
# - `self` is the object itself. Python passes it to every method; you do not write it in the call.
# - `self.name` is a value of this object, an *attribute*. Each bell has its own name and its own callbacks.
# - `callback(self.name)` calls a function that somebody else wrote.
#
# The next cell subscribes the function `on_ring`, *without* parentheses: we pass the function itself, and do not call it. Then the bell rings twice. **Predict** how many names are in the list at the end.

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
# You never called `on_ring`: the bell did, once for each ring. So ROS calls your callback once for each message.
#
# A class can extend another class. `CountingBell(Bell)` *[[term:inherit|inherits]]* everything that `Bell` has, and has more. `super().__init__(name)` runs the `__init__` of `Bell` first. A method can be a callback too: `self.on_ring`.

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
# A node has exactly this form: a class that inherits, an `__init__` that begins with `super().__init__(...)` and subscribes, and a method that is the callback.

# %% [markdown]
# ## 3 · The node, line by line ([[minutes]])
#
# A node that works with images does four things: it **subscribes** to a topic, **converts** each message to an array, **processes** the array, and **publishes** (or displays) the result. It needs `rclpy` (nodes, topics and the log), `sensor_msgs` (the message types of sensors, such as `Image`), a converter between messages and arrays, OpenCV and NumPy.
#
# First, choose the *QoS policies* (quality of service): they say how messages are delivered. Three matter for a camera:

# %%
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
    assert getattr(camera_qos, policy) == getattr(qos_profile_sensor_data, policy)

# %% [markdown]
# - **reliability: best effort.** A lost image is not sent again: a late image is useless.
# - **durability: volatile.** Images from before the subscription are not delivered.
# - **depth: 5.** At most five messages wait until the callback has time.
#
# `qos_profile_sensor_data` is a ready profile with the same policies. Older files write `QoSReliabilityPolicy` and `QoSDurabilityPolicy`.
#
# Here is the whole node. It is a *class*: if you have never written one, read section 2 first. The numbers refer to the list below.

# %% tags=["long"]
from imgproc_course.messages import ConversionError
from imgproc_course.messages import array_to_image, image_to_array

TOPIC = "/kachaka/front_camera/image_raw"


class GrayNode(Node):
    def __init__(self):
        super().__init__("gray_by_hand")  # 1
        self.publisher = self.create_publisher(  # 2
            Image, "~/gray", camera_qos
        )
        self.create_subscription(  # 3
            Image, TOPIC, self.on_image, camera_qos
        )
        self.get_logger().info("The node has started.")  # 4

    def on_image(self, msg):
        try:
            frame = image_to_array(msg, "bgr8")  # 5
        except ConversionError as error:
            self.get_logger().error(str(error))  # 6
            return
        gray = to_gray(frame)  # 7
        gray_msg = array_to_image(gray, "mono8", msg.header)  # 8
        self.publisher.publish(gray_msg)  # 9

# %% [markdown]
# 1. `GrayNode` inherits from ROS's class `Node`. `"gray_by_hand"` is the node's name in the *[[term:ROS graph]]*: the network of all running nodes and topics.
# 2. The node creates a *[[term:publisher]]* for messages of the type `Image` on `~/gray`. ROS replaces `~` by the node's name: `/gray_by_hand/gray`.
# 3. It creates a *[[term:subscription]]* to the camera's topic. The callback is the method `on_image`, without parentheses.
# 4. It *[[term:log|logs]]* a line when it starts, with a time, a level (`INFO`, `WARN`, `ERROR`) and the node's name.
# 5. The message becomes an array with the channels blue, green, red, whatever its encoding is.
# 6. If this fails, Python goes on at `except`: the node logs the error, and `return` leaves the callback. One bad message must not end the node.
# 7. Only this line processes the image. It does not use ROS.
# 8. The result becomes a message. It gets a **copy of the header**, so that the receiver knows when the image was taken.
# 9. The node publishes the message.

# %% [markdown]
# **Catch only what a bad message causes.** Many files put `except Exception` around the whole callback. Do not copy it: it also catches your own mistakes. If you misspell a name, such a node logs an error for every image, and you look for the fault in the camera. In a script, every other error should end the node, and show you the line.
#
# **Look** at the camera's frame and at what the node publishes. `RosSession.current()` is the part of the course that runs ROS in this notebook. Its method `add_node` makes a node of the class, and *[[term:spin|spins]]* it in the background: it waits for messages and calls the callbacks, again and again.

# %% tags=["nbval-ignore-output"]
def beside(frame):
    newest = published.latest()  # None until the first image has arrived
    return [frame] if newest is None else [frame, newest]


if ros_available():
    RosSession.current().add_node(GrayNode)
    published = ImageSubscriber("/gray_by_hand/gray")
    view = live_view(camera, beside, text="grayscale_node/gray")
else:
    view = live_view(open_recording("drive"), to_gray, text="grayscale_node/gray")

# %%
# Check: the live view has no error
assert view.error is None

# %% [markdown]
# The line that begins with `[INFO]` is the node's log.
#
# A script has no session. It ends with a function `main`, which spins the node until you press Ctrl-C. Then `rclpy` raises one of the two exceptions, and the node ends without an error:
#
# ```python
# import rclpy
# from rclpy.executors import ExternalShutdownException
#
# def main(args=None):
#     rclpy.init(args=args)
#     node = GrayNode()
#     try:
#         rclpy.spin(node)
#     except (KeyboardInterrupt, ExternalShutdownException):
#         pass
#     finally:
#         node.destroy_node()
#         rclpy.try_shutdown()
# ```
#
# `args` are the arguments of the command line, such as [[term:remapping|remappings]]. You run such a script in [[ros2_packages]].
#
# **Pause?** Afterwards choose **Run → Run All Above Selected Cell**.

# %% [markdown]
# ## 4 · Your turn: the whole node ([[minutes+6]])
#
# Most tutorials convert with `CvBridge` of *[[term:cv_bridge]]*. It has two methods: `imgmsg_to_cv2` (message to array) and `cv2_to_imgmsg` (array to message, with the header as its third argument). A message that cannot be converted raises `CvBridgeError`. (If `cv_bridge` is not installed, `offer_modules()` above makes the import work: you get the course's own class, and its `CvBridgeError` is another name of the `ConversionError` of section 3.)

# %%
from cv_bridge import CvBridge, CvBridgeError

bridge = CvBridge()
msg = bridge.cv2_to_imgmsg(frame, "bgr8")
array = bridge.imgmsg_to_cv2(msg, "bgr8")
print(msg.encoding, msg.height, msg.width, "->", array.shape, array.dtype)

# %%
# Check: both conversions together change no pixel
assert (array == frame).all() and msg.encoding == "bgr8"

# %% [markdown]
# Write the class `ImageGrayProcessor`, as you would write it for a robot. `__init__` makes one bridge for the node, `self.bridge`; the callback uses it. The check makes a node of your class, sends it images, and looks at what it publishes and logs. Run it after each step.
#
# 1. **Subscribe.** `__init__` gives the node the name `image_gray_processor`. It creates a publisher for `Image` on `~/gray`, and a subscription to `Image` on `/kachaka/front_camera/image_raw` with the callback `self.image_callback`, best effort, volatile, depth 5.
# 2. **Answer.** `image_callback` converts the message to a frame with `self.bridge.imgmsg_to_cv2(msg, "bgr8")`, makes it gray with `cv2.cvtColor`, and publishes it as `mono8` with the header of `msg`.
# 3. **Survive.** If a message cannot be converted, the node logs an error with `self.get_logger().error(...)` and publishes nothing.
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
        raise NotImplementedError("step 1: delete this line; first comes super().__init__")
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
    return ("images", [sent(blocks(rng), 1), sent(blocks(rng), 2, "rgb8")])


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
# **Run it.** The next cell shows what your node publishes, beside the frame. Below it, the check says what differs from the task.

# %% tags=["nbval-ignore-output"]
view.stop()
if ros_available():
    try:
        my_node = RosSession.current().add_node(ImageGrayProcessor)
        published = ImageSubscriber(f"/{my_node.get_name()}/gray")
        view = live_view(camera, beside, text="grayscale_node/mine")
    except NotImplementedError:
        print("write step 1 of your class first")
check("node-class", ImageGrayProcessor)

# %%
# Check: the live view has no error
assert view.error is None

# %% [markdown]
# ### Change your node, and observe ([[minutes+11]])
#
# Make one change after the other. Write down your guess, change your class, run its cell, and run the cell above: the new node replaces the old one. Was your guess right? Does the check see the change?
#
# | Change | Guess first | Look at |
# |---|---|---|
# | below `cv2.cvtColor`: `gray = 255 - gray` | What is bright now? | the lamps and the shadows |
# | instead of `cv2.cvtColor`: `gray = frame[..., 2]`, the red channel | Is the red ball brighter or darker than before? | the ball, and the blue things |
# | in your `QoSProfile`: `ReliabilityPolicy.RELIABLE` | How many images arrive? | whether a second image appears; what the check says |
#
# At the end, undo your changes: your class is graded as it stands.

# %% [markdown]
# ### Write down what you saw ([[minutes]], deeper)
#
# What did you see at each change, and why? Write one or two sentences each. Save (Ctrl+S) before you run the check: it shows an answer, and what to look for in yours. In a class, a person grades it.

# %% role="exercise"
exercise(
    "node-observe",
    subject="written",
    title="Three changes, observed",
    points=3,
    rubric=(
        ("255 - gray: dark and bright change places; 255 minus a small number is a large one", 1),
        ("red channel: the ball is brighter than in gray, because its red value is high", 1),
        ("RELIABLE: no image arrives; the camera publishes best effort, and the policies do not fit", 1),
        ("says that with RELIABLE all images arrive", -1),
    ),
)

# %% [markdown] role="answer"
# *Write your answer here (double-click), in place of this line.*

# %% [markdown] role="solution"
# 1. The lamps are dark and the shadows are bright: 255 minus a large number is a small one.
# 2. The ball is brighter than before, because it is red: its red value is high, and luma counts red only with the weight 0.299. Blue things are darker.
# 3. No image arrives. My subscription asks for a reliable publisher, and the camera publishes best effort: ROS does not connect them. Step 1 of the check says so, too.

# %% role="check"
check("node-observe")

# %%
# Check: the ball in the red channel, against luma
ball = open_recording("drive").labels(30) == 9
assert ball.any() and frame[ball][:, 2].mean() > to_gray(frame)[ball].mean() + 40

# %% [markdown]
# ## 5 · rclpy.spin in a notebook ([[minutes]], deeper)
#
# `rclpy.spin(node)` has an executor, and calls its `spin_once` again and again. The next cell does this for three seconds. **Predict**: while a cell spins, can you run another cell?

# %% role="predict"
guess_other_cells = None  # your guess: can another cell run, "yes" or "no"?

# %% tags=["nbval-ignore-output"]
started = time.monotonic()
if ros_available():
    from rclpy.executors import SingleThreadedExecutor

    executor = SingleThreadedExecutor(context=RosSession.current().context)
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
# This was the **planned failure**. While the cell runs, it shows `[*]`, and all other cells wait. A cell with `rclpy.spin(node)` never ends by itself; **Kernel → Interrupt Kernel** stops it. **The repair**: spin in a background thread, as `RosSession` does. Its thread stops when the kernel stops. (If the `__init__` of your class has arguments, make the node yourself, with `context=RosSession.current().context`. A *[[term:context]]* holds the state of ROS in one program.)
#
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
# Most tutorials also show the image in a window: `cv2.imshow("gray", gray)` draws it, `cv2.waitKey(1)` gives the window one millisecond to react, and `cv2.destroyAllWindows()` closes all windows. A notebook runs in a browser, maybe on another computer than the node, so here you use `live_view`.

# %% [markdown]
# ## Recap
#
# A node subscribes with a callback. It converts the message, processes the frame, publishes the result with the copied header, and logs failures.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | `msg.data` | (2764800,) | uint8 | 0 to 255 | byte |
# | *frame*, `bgr8` | (720, 1280, 3) | uint8 | 0 to 255 | gray level of blue, green, red |
# | *gray*, published as `mono8` | (720, 1280) | uint8 | 0 to 255 | gray level |
#
# **Next:** [[noise_removal]], or [[canny_stages]] if you have one day. First choose **File → Close and Shut Down Notebook**: it frees the camera.

# %%
# Check: the numbers in the table
assert frame.shape == (720, 1280, 3) and len(msg.data) == frame.size == 2_764_800
assert to_gray(frame).shape == (720, 1280)
