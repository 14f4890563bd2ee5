# ---
# jupyter:
#   imgproc_course:
#     title: The grayscale node
#     minutes: 50
# ---

# %% [markdown]
# # 04 · The grayscale node
#
# A function turns one frame gray. A *node* does it for every picture that the camera sends, as long as the robot runs, and publishes the result for others. Between the two lie few lines and some traps.
#
# **You will be able to**
# - write a ROS 2 node that subscribes, processes and publishes, and say what each line is for,
# - say why `rclpy.spin` in a notebook never returns, and what to do instead,
# - choose a QoS, copy a header, and keep a node alive when a picture is bad.
#
# **Time** about 50 minutes. **You need** lessons 02 and 03. This lesson needs a running ROS 2; without one (macOS, Windows without WSL) read along, and do the exercise in section 5.

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
# ## 1 · A callback is a function that somebody else calls (6 minutes)
#
# **Ask.** Until now you asked for a picture and waited. A node does not wait. It hands ROS a function, a *callback*, and ROS calls it whenever a picture arrives. **Predict** how often the function below is called in two seconds; the camera sends ten pictures a second.

# %%
seen = []


def remember(frame, msg):
    seen.append(msg.header.stamp)


# %% tags=["nbval-ignore-output"]
import time

if ros_available():
    listener = ImageSubscriber(camera.topic, remember)
    listener.wait(timeout=10)
    seen.clear()
    time.sleep(2)
    cameras = listener.session.node.count_publishers(camera.topic)
    listener.stop()
    print("called", len(seen), "times in two seconds; cameras:", cameras)
    assert 10 <= len(seen) <= 25 * cameras

# %% [markdown]
# About twenty times, while this cell did nothing but sleep (forty where another lesson is still open and plays the drive, too: then there are two cameras). Somebody must have called the function: a thread in the background that *spins*, which means: waits for messages and calls callbacks, for ever.
#
# ## 2 · The node, line by line (10 minutes)
#
# Now the whole node, as it would run on a robot.

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
# 1. The node's name. Others see it in the graph.
# 2. It will publish pictures on `~/gray`. The `~` stands for the node's own name: `/gray_by_hand/gray`. A second node of another name does not get in its way.
# 3. It subscribes to the camera. `qos_profile_sensor_data` is **best effort, depth 5, volatile**: what cameras offer. Best effort, since a late picture is worth nothing; depth 5, so that at most five wait and the oldest is dropped first; volatile: nothing is kept for latecomers.
# 4. The message becomes a frame, blue first, whatever encoding the robot sends.
# 5. A picture that does not convert is *logged*, at most every five seconds, and skipped. A node must not die of one bad picture.
# 6. The one line that computes. It knows nothing of ROS.
# 7. The result becomes a message. The **header is copied**, so that whoever receives it knows when the picture was taken.
#
# ## 3 · Planned failure: the cell that never returns (7 minutes)
#
# Every ROS tutorial ends with `rclpy.spin(node)`. In a script that is right: it runs until Ctrl-C. **Predict** what it does in a notebook cell.
#
# You would sit before a `[*]` that never goes away, with every other cell waiting behind it. (The remedy for that is **Kernel → Interrupt Kernel**.) So that this lesson goes on, the next cell spins for three seconds only. Try to run another cell meanwhile.

# %% tags=["nbval-ignore-output"]
if ros_available():
    from rclpy.executors import SingleThreadedExecutor

    session = RosSession.current()
    node = GrayNode(context=session.context)
    executor = SingleThreadedExecutor(context=session.context)  # what rclpy.spin uses, too
    executor.add_node(node)

# %% tags=["nbval-ignore-output"]
if ros_available():
    started = time.monotonic()
    while time.monotonic() < started + 3:  # rclpy.spin(node) has no such end
        executor.spin_once(timeout_sec=0.1)
    blocked = time.monotonic() - started
    executor.remove_node(node)
    print(f"for {blocked:.0f} seconds no other cell could run")
    assert blocked >= 3

# %% [markdown]
# **Repair it**: let somebody else spin. `RosSession` is that somebody: one thread in the background that spins every node of this notebook. Starting it twice does no harm, and it leaves when the kernel does.

# %% tags=["nbval-ignore-output"]
if ros_available():
    session.add_node(node)
    gray_frames = ImageSubscriber("/gray_by_hand/gray", encoding="mono8")
    gray = gray_frames.wait(timeout=10)
    print("received from my own node:", gray.shape, gray.dtype)
    assert gray.shape == (720, 1280) and gray.dtype == np.uint8

# %% [markdown]
# **Look** at it live. The picture goes the long way: camera → topic → your node → topic → this page. (Without ROS there is a short way alone: recording → `to_gray` → this page.)

# %% tags=["nbval-ignore-output"]
caption = "Gray, live: every picture of the drive, ten a second."
alt = "The living room in gray, while the robot drives."
if ros_available():
    view = live_view(gray_frames, encoding="mono8", caption=caption, alt=alt)
else:
    view = live_view(open_recording("drive"), to_gray, caption=caption, alt=alt)
assert view.running

# %% [markdown]
# ## 4 · The same node for every function (6 minutes)
#
# Six of the seven lines would be the same in an edge node. So the course has them once, in `ImageProcessor`: you give it a name, a function and the names of what the function returns. The function, `process`, gets a frame and returns a dictionary; each key becomes a topic.

# %%
def make_gray(frame):
    return {"gray": to_gray(frame)}


result = make_gray(frame)
print({key: (array.shape, str(array.dtype)) for key, array in result.items()})

assert (result["gray"] == cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)).all()

# %% [markdown]
# On a robot nobody waits for arithmetic by hand, so a real node calls OpenCV's `cvtColor` here. The assert says that it is the same gray, on every pixel.
#
# Bad pictures and bad functions are counted, and the node lives on. Here is a function that fails on every second picture, by design. The lines on red ground are the node's *log*: a terminal would show them, and a notebook shows them under the cell that runs. `INFO` tells, `WARN` warns.

# %% tags=["nbval-ignore-output"]
calls = []


def clumsy(frame):
    calls.append(1)
    if len(calls) % 2:
        raise ValueError("every second time I fail")
    return make_gray(frame)


# %% tags=["nbval-ignore-output"]
if ros_available():
    from imgproc_course.ros import ImageProcessor

    clumsy_node = session.add_node(ImageProcessor("clumsy", clumsy, ["gray"], context=session.context))
    survivors = ImageSubscriber("/clumsy/gray", encoding="mono8")
    for _ in range(3):
        survivors.wait(timeout=10)
    counted = clumsy_node.statistics()
    print("processed", counted["processed"], " failed", counted["failed"])
    assert counted["processed"] >= 3 and counted["failed"] >= 2
    session.remove_node(clumsy_node)

# %% [markdown]
# ## 5 · Your turn: the node's function (8 minutes)
#
# Write `process(frame)` for a grayscale node: a (height, width, 3) uint8 frame in, blue first; a dictionary out with one key, `"gray"`, and the (height, width) uint8 luma as its value. The frame must stay as it is: others may look at it too. `cv2` is allowed.

# %% role="exercise"
exercise(
    "node-process",
    title="The grayscale node's function",
    function="process",
    time_limit=5,
    refused=(),
    hint="cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY) computes it; put the result into a dictionary.",
)

# %% role="answer"
def process(frame):
    raise NotImplementedError("your turn: delete this line and write the function")


# %% role="solution"
def process(frame):
    return {"gray": cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)}


# %% role="check"
check("node-process", process)


# %% role="case" title="a small frame" points=1 hint="The node asks for the key \"gray\"."
def inputs(rng):
    return (rng.integers(0, 256, size=(6, 8, 3), dtype=np.uint8),)


# %% role="hidden" title="any frame" points=1 hint="Blue comes first: which of OpenCV's codes starts with BGR?"
def inputs(rng):
    return (rng.integers(0, 256, size=(30, 40, 3), dtype=np.uint8),)


# %% role="mistake" name="the array without its dictionary" says="That is the picture itself. A node needs to know on which topic it goes: return a dictionary, {\"gray\": picture}."
def process(frame):
    return cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)


# %% role="mistake" name="red and blue exchanged" says="The weights of red and blue are exchanged: the frame is BGR, so the code is COLOR_BGR2GRAY."
def process(frame):
    return {"gray": cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY)}


# %% role="mistake" name="gray with three channels" says="The picture is gray but has three equal channels. A gray picture has one number a pixel: (height, width)."
def process(frame):
    return {"gray": cv2.cvtColor(cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), cv2.COLOR_GRAY2BGR)}


# %% role="mistake" name="another key" says="The picture is right, but its key is not \"gray\": nobody listens to that topic."
def process(frame):
    return {"grey": cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)}


# %% [markdown]
# ## 6 · Practice: your node, live (8 minutes)
#
# Put your own `process` into a node and watch it. In the next cell write `process` in place of `make_gray`, run it, and then make it do something of your own: turn the picture upside down, draw a frame around it, keep only the red. Run the cell again after each change: the new node replaces the old one.

# %% tags=["nbval-ignore-output"]
if ros_available():
    mine = session.add_node(ImageProcessor("my_node", make_gray, ["gray"], context=session.context))
    my_pictures = ImageSubscriber("/my_node/gray", encoding="mono8")
    mine_received = my_pictures.wait(timeout=10)
    my_view = live_view(my_pictures, encoding="mono8", caption="What my node publishes.",
                        alt="The pictures of my own node, live.")
    assert mine_received.shape == (720, 1280)

# %% [markdown]
# ## Recap
#
# A node is a callback with a name: subscribe, convert, process, publish with the header copied, log what fails. In a notebook somebody else must spin it.
#
# | stage | shape | dtype | range | unit |
# |---|---|---|---|---|
# | `msg.data` | (2764800,) | uint8 | 0 to 255 | byte |
# | *frame*, `bgr8` | (720, 1280, 3) | uint8 | 0 to 255 | gray level of blue, green, red |
# | *gray*, published as `mono8` | (720, 1280) | uint8 | 0 to 255 | gray level |

# %%
assert frame.shape == (720, 1280, 3) and frame.size == 2_764_800
assert make_gray(frame)["gray"].shape == (720, 1280)
