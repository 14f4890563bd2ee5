# ---
# jupyter:
#   imgproc_course:
#     title: Nodes
#     minutes: 5
# ---

# %% [markdown]
# # Nodes
# A lesson for the tests: a node that makes images twice as bright.

# %% role="given" exercise="nodes-double"
import numpy as np

LIMIT = 255

# %%
from imgproc_course.exercises import check

# %% role="exercise"
exercise(
    "nodes-double",
    title="Twice as bright",
    function="Doubler",
    subject="node",
    hints=("What?", "How?", "The code."),
    explanation="Because.",
    another_way="Otherwise.",
)


def sent(rng):
    image = rng.integers(0, 256, (4, 3), dtype=np.uint8)
    return {"image": image, "encoding": "mono8", "topic": "/camera", "stamp": (1, 2), "frame_id": "camera"}


# %% role="answer"
from array import array
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image


class Doubler(Node):
    def __init__(self):
        raise NotImplementedError("step 1")
        self.factor = 2

    def callback(self, msg):
        pass  # step 2


# %% role="solution"
from array import array
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image


class Doubler(Node):
    def __init__(self):
        super().__init__("doubler")
        self.publisher = self.create_publisher(Image, "~/double", 5)
        self.create_subscription(Image, "/camera", self.callback, qos_profile_sensor_data)

    def callback(self, msg):
        wide = np.array(msg.data, np.uint16) * 2
        msg.data = array("B", np.minimum(wide, LIMIT).astype(np.uint8).tobytes())
        self.publisher.publish(msg)


# %% role="check"
check("nodes-double", Doubler)


# %% role="case" title="Step 1" points=1 hint="Which topic?"
def inputs(rng):
    return ("setup", [])


# %% role="case" title="Step 2" points=1 hint="Widen before you multiply."
def inputs(rng):
    return ("images", [sent(rng)])


# %% role="hidden" title="Two images" points=2 hint="What does 200 become?"
def inputs(rng):
    return ("images", [sent(rng), sent(rng)])
