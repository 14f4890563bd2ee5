"""Answers to the node exercises: in all styles that are right, and wrong in the ways of beginners.

`passes` names the cases that an answer passes: 1, 2, ... are the steps of the task, h is the hidden case.
`says` is a part of what `check` says about a wrong one.
"""

# ruff: noqa: E501 - the long lines are learners'

import textwrap
from dataclasses import dataclass


@dataclass(frozen=True)
class NodeAnswer:
    name: str
    source: str
    passes: str = "123h"
    says: str = ""
    exercise: str = "node-class"


IMPORTS = """import cv2
from cv_bridge import CvBridge, CvBridgeError
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Image

"""
ORIGINAL = f"""{IMPORTS}
class ImageGrayProcessor(Node):
    def __init__(self):
        super().__init__("image_gray_processor")
        qos = QoSProfile(
            depth=5,
            reliability=ReliabilityPolicy.BEST_EFFORT,
            durability=DurabilityPolicy.VOLATILE,
        )
        self.subscription = self.create_subscription(
            Image, "/kachaka/front_camera/image_raw", self.image_callback, qos
        )
        self.publisher = self.create_publisher(Image, "~/gray", qos)
        self.bridge = CvBridge()
        self.get_logger().info("The gray node has started.")

    def image_callback(self, msg):
        try:
            frame = self.bridge.imgmsg_to_cv2(msg, "bgr8")
        except CvBridgeError as error:
            self.get_logger().error(f"cannot convert: {{error}}")
            return
        gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
        gray_msg = self.bridge.cv2_to_imgmsg(gray, "mono8")
        gray_msg.header = msg.header
        self.publisher.publish(gray_msg)
"""
HIGH = '        self.declare_parameter("high", 150)\n'
DECLARE = '        self.declare_parameter("low", 50)\n' + HIGH
EDGES = (
    ORIGINAL.replace("ImageGrayProcessor", "EdgeDetector")
    .replace("image_gray_processor", "edge_detector")
    .replace("~/gray", "~/edges")
    .replace("        qos =", f"{DECLARE}        qos =", 1)
    .replace(
        "COLOR_BGR2GRAY)\n",
        'COLOR_BGR2GRAY)\n        low = self.get_parameter("low").value\n'
        '        high = self.get_parameter("high").value\n        edges = cv2.Canny(gray, low, high)\n',
    )
    .replace('(gray, "mono8")', '(edges, "mono8")')
)
TRY = ORIGINAL[ORIGINAL.index("        try:") : ORIGINAL.index("        gray = cv2")]
SUBSCRIBE = ORIGINAL[ORIGINAL.index("        self.subscription") : ORIGINAL.index("        self.publisher =")]
PUBLISH = "        self.publisher.publish(gray_msg)\n"
STARTED = '        self.get_logger().info("The gray node has started.")\n'


def changed(*changes, source=ORIGINAL):
    """The original with (old, new) changes, each of which must fit."""
    for old, new in changes:
        assert old in source, old
        source = source.replace(old, new)
    return source


def edges(*changes):
    return changed(*changes, source=EDGES)


INSIDE_INIT = ORIGINAL.index("    def image_callback")
SHORT_FORM = '''import cv2
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image
from imgproc_course.messages import ConversionError, array_to_image, image_to_array


class ImageGrayProcessor(Node):
    """Converts the camera's images to gray."""

    def __init__(self, context=None):
        super().__init__("image_gray_processor", context=context)
        self.publisher = self.create_publisher(Image, "~/gray", qos_profile_sensor_data)
        topic = "/kachaka/front_camera/image_raw"
        self.create_subscription(Image, topic, self.on_image, qos_profile_sensor_data)

    def on_image(self, msg):
        try:
            frame = image_to_array(msg, "bgr8")
        except ConversionError as error:
            self.get_logger().error(str(error))
            return
        gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
        self.publisher.publish(array_to_image(gray, "mono8", msg.header))
'''
NODE_INIT = """import cv2
from cv_bridge import CvBridge
from rclpy.node import Node
from rclpy.qos import QoSProfile, QoSReliabilityPolicy
from sensor_msgs.msg import Image


class ImageGrayProcessor(Node):
    def __init__(self):
        Node.__init__(self, "image_gray_processor")
        q = QoSProfile(depth=5, reliability=QoSReliabilityPolicy.BEST_EFFORT)
        self.cv = CvBridge()
        self.pub = self.create_publisher(Image, "image_gray_processor/gray", q)
        self.sub = self.create_subscription(
            Image, topic="kachaka/front_camera/image_raw", callback=self.cb, qos_profile=q
        )

    def cb(self, msg, info):
        try:
            gray = cv2.cvtColor(self.cv.imgmsg_to_cv2(msg, "bgr8"), cv2.COLOR_BGR2GRAY)
        except Exception as e:
            self.get_logger().error(str(e), throttle_duration_sec=5.0)
        else:
            out = self.cv.cv2_to_imgmsg(gray, "mono8")
            out.header.stamp = msg.header.stamp
            out.header.frame_id = msg.header.frame_id
            self.pub.publish(out)
"""
MAIN = """

def main(args=None):
    rclpy.init(args=args)
    node = ImageGrayProcessor()
    try:
        rclpy.spin(node)
    finally:
        node.destroy_node()
        rclpy.shutdown()


if __name__ == "__main__":
    main()
"""
ON_SET = """
    def on_set(self, parameters):
        for parameter in parameters:
            setattr(self, parameter.name, parameter.value)
        return SetParametersResult(successful=True)
"""
READ_ONCE = (
    ('        low = self.get_parameter("low").value\n        high = self.get_parameter("high").value\n', ""),
    ("Canny(gray, low, high)", "Canny(gray, self.low, self.high)"),
    (
        HIGH,
        f"{HIGH}"
        '        self.low = self.get_parameter("low").value\n        self.high = self.get_parameter("high").value\n',
    ),
)
TIMER = (
    ("        self.bridge = CvBridge()\n", "        self.bridge, self.newest = CvBridge(), None\n"
     "        self.create_timer(0.02, self.on_timer)\n"),
    (PUBLISH, "        self.newest = gray_msg\n\n    def on_timer(self):\n        if self.newest is not None:\n"
     "            self.publisher.publish(self.newest)\n            self.newest = None\n"),
)  # fmt: skip
BY_HAND = (
    (
        '        gray_msg = self.bridge.cv2_to_imgmsg(gray, "mono8")\n        gray_msg.header = msg.header\n',
        '        gray_msg = Image(header=msg.header, encoding="mono8")\n'
        "        gray_msg.height, gray_msg.width = gray.shape\n"
        "        gray_msg.step = gray.shape[1]\n        gray_msg.data = gray.tobytes()\n",
    ),
)
RIGHT = (
    ("the original", ORIGINAL),
    (
        "functools.partial",
        "from functools import partial\n\n"
        + changed(
            ("self.image_callback, qos", "partial(self.image_callback, 7), qos"),
            ("(self, msg)", "(self, number, msg)"),
        ),
    ),
    ("the course's short form", SHORT_FORM),
    ("Node.__init__, a callback with info, relative topics", NODE_INIT),
    ("main below", "import rclpy\n" + ORIGINAL + MAIN),
    ("main in one line", "import rclpy\n" + ORIGINAL + "\nrclpy.init()\nrclpy.spin(ImageGrayProcessor())\n"),
    ("a timer that publishes", changed(*TIMER)),
    ("a message made by hand", changed(*BY_HAND)),
    (
        "a parameter for the topic",
        changed(
            (
                "        qos =",
                '        self.declare_parameter("topic", "/kachaka/front_camera/image_raw")\n        qos =',
            ),
            (
                'Image, "/kachaka/front_camera/image_raw", self',
                'Image, self.get_parameter("topic").value, self',
            ),
        ),
    ),
    (
        "a callback group and the clock",
        "from rclpy.callback_groups import ReentrantCallbackGroup\n"
        + changed(
            ("self.image_callback, qos", "self.image_callback, qos, callback_group=ReentrantCallbackGroup()"),
            (PUBLISH, PUBLISH + '        self.get_logger().info(f"{self.get_clock().now().nanoseconds}")\n'),
        ),
    ),
    (
        "policies set afterwards, super with its arguments, % in the log",
        changed(
            ("super()", "super(ImageGrayProcessor, self)"),
            ("        self.subscription", "        qos.depth = 5\n        self.subscription"),
            ("            depth=5,\n", "            depth=1,\n"),
            ('f"cannot convert: {error}"', '"cannot convert: %s" % error'),
        ),
    ),
    (
        "keywords everywhere",
        changed(
            ('Image, "~/gray", qos', 'msg_type=Image, topic="~/gray", qos_profile=qos'),
            ('msg, "bgr8"', 'img_msg=msg, desired_encoding="bgr8"'),
            ("(frame, cv2", "(src=frame, code=cv2"),
            ('gray, "mono8"', 'cvim=gray, encoding="mono8", header=msg.header'),
            ("        gray_msg.header = msg.header\n", ""),
        ),
    ),
    (
        "whole modules",
        changed(("(Node)", "(rclpy.node.Node)"), ("(Image,", "(sensor_msgs.msg.Image,"))
        .replace("from rclpy.node import Node\n", "import rclpy.node\n")
        .replace("from sensor_msgs.msg import Image\n", "import sensor_msgs.msg\n")
        .replace("            Image,", "            sensor_msgs.msg.Image,"),
    ),
)
WRONG = (
    ("reliable", changed(("ReliabilityPolicy.BEST_EFFORT", "ReliabilityPolicy.RELIABLE")), "", "sensor offers best effort"),
    ("transient local", changed(("Policy.VOLATILE", "Policy.TRANSIENT_LOCAL")), "", "durability of your subscription"),
    ("depth 10", changed(("depth=5", "depth=10")), "23h", "The depth of your subscription is 10"),
    ("another topic", changed(("kachaka/front_camera/", "")), "", "You subscribe to /image_raw."),
    ("no depth", changed(("            depth=5,\n", "")), "", "QoSProfile needs a depth"),
    ("the callback called", changed(("self.image_callback, qos", "self.image_callback(), qos")), "", "without parentheses"),
    ("no subscription", changed((SUBSCRIBE, "")), "", "Your node has no subscription"),
    ("no publisher", changed(('        self.publisher = self.create_publisher(Image, "~/gray", qos)\n', "")), "", "has no publisher"),
    ("two subscriptions", changed((SUBSCRIBE, SUBSCRIBE * 2)), "", "more than one subscription"),
    ("compressed", changed(("Image, \"/k", "CompressedImage, \"/k"), ("msg import Image", "msg import CompressedImage, Image")), "", "sensor_msgs/msg/Image"),
    ("another name", changed(('"image_gray_processor"', '"gray"')), "", "Your node is called gray"),
    ("a publisher on /gray", changed(("~/gray", "/gray")), "", "You publish on /gray"),
    ("publishes in __init__", changed((STARTED, "        self.publisher.publish(Image())\n")), "23h", "before a message has arrived"),
    ("no super", changed(('        super().__init__("image_gray_processor")\n', "")), "", "super().__init__"),
    ("no node", changed(("ImageGrayProcessor(Node)", "ImageGrayProcessor")), "", "inherit from Node"),
    ("Image in quotes", changed(('Image, "/k', '"Image", "/k')), "", "is the class of the messages: Image"),
    ("no self", changed(("def image_callback(self, msg)", "def image_callback(msg)")), "", "def image_callback(self, msg)"),
    ("a local publisher", changed(("        self.publisher = self", "        publisher = self")), "1", "The node has no attribute publisher"),
    ("the callback in __init__", ORIGINAL[:INSIDE_INIT] + textwrap.indent(ORIGINAL[INSIDE_INIT:], "    "), "", "a method stands in the class"),
    ("try around publish", changed((TRY, '        frame = self.bridge.imgmsg_to_cv2(msg, "bgr8")\n'), (PUBLISH, "        try:\n    " + PUBLISH + "        except CvBridgeError as error:\n            self.get_logger().error(str(error))\n")), "12", "Put try: around the conversion"),
    ("red and blue exchanged", changed(("COLOR_BGR2GRAY", "COLOR_RGB2GRAY")), "1", "Red and blue are exchanged"),
    ("no encoding asked for", changed(('(msg, "bgr8")', "(msg)")), "13", "Ask for bgr8"),
    ("no header", changed(("        gray_msg.header = msg.header\n", "")), "1", "not its header"),
    ("no encoding", changed(('(gray, "mono8")', "(gray)")), "1", "says 8UC1"),
    ("half the size", changed((PUBLISH, PUBLISH), ("cv2.COLOR_BGR2GRAY)", "cv2.COLOR_BGR2GRAY)[::2, ::2].copy()")), "1", "The height of the published"),
    ("inverted", changed(('(gray, "mono8")', '(255 - gray, "mono8")')), "1", "pixels of the published image are wrong"),
    ("publishes an array", changed(("publish(gray_msg)", "publish(gray)")), "1", "publish takes a message"),
    ("nothing published", changed((PUBLISH, "")), "1", "published nothing"),
    ("published twice", changed((PUBLISH, PUBLISH * 2)), "1", "more than one message"),
    ("a name misspelled", changed(("publish(gray_msg)", "publish(grey_msg)")), "1", "grey_msg"),
    ("the logger is not called", changed(("self.get_logger().error", "self.get_logger.error")), "12", "Look at the line below except"),
    ("the exception escapes", changed((TRY, '        frame = self.bridge.imgmsg_to_cv2(msg, "bgr8")\n')), "12", "ends your node. Put try"),
    ("no return in except", changed(("            return\n", "")), "12", "Write return at the end of except"),
    ("an exception for a logger", changed(('f"cannot convert: {error}"', "error")), "12", "a logger takes a text"),
    ("silent", changed(('            self.get_logger().error(f"cannot convert: {error}")\n', "")), "12", "it logs nothing"),
    ("a warning", changed(("().error(", "().warning(")), "12", "the level warn"),
    ("the last image again", changed((PUBLISH, PUBLISH + "        self.last = gray_msg\n"), ("            return\n", "            self.publisher.publish(self.last)\n            return\n")), "12", "although the message cannot"),
    ("sleeps", changed(("        gray = cv2", "        time.sleep(60)\n        gray = cv2"), ("import cv2\n", "import time\n\nimport cv2\n")), "1", "Your node sleeps"),
    ("imshow", changed((PUBLISH, '        cv2.imshow("gray", gray)\n        cv2.waitKey(1)\n' + PUBLISH)), "1", "imshow and waitKey"),
    ("spin", changed((STARTED, "        rclpy.spin(self)\n"), ("import cv2\n", "import cv2\nimport rclpy\n")), "", "rclpy.spin"),
    ("a service", changed((STARTED, '        self.create_service(Image, "gray", self.image_callback)\n')), "", "This check does not know create_service"),
)  # fmt: skip
EDGE_ANSWERS = (
    ("read in the callback", EDGES, "123h", ""),
    (
        "a callback for parameters",
        "from rcl_interfaces.msg import SetParametersResult\n"
        + edges(
            *READ_ONCE,
            ("        qos =", "        self.add_on_set_parameters_callback(self.on_set)\n        qos ="),
        )
        + ON_SET,
        "123h",
        "",
    ),
    (
        "get_parameter_value",
        edges(
            ('("low").value', '("low").get_parameter_value().integer_value'),
            (DECLARE, '        self.declare_parameters("", [("low", 50), ("high", 150)])\n'),
        ),
        "123h",
        "",
    ),
    ("read once", edges(*READ_ONCE), "1", "does the callback read the new values?"),
    ("no super", edges(('        super().__init__("edge_detector")\n', "")), "", "super().__init__"),
    ("high is not declared", edges((HIGH, "")), "", "Declare the parameter high"),
    (
        "other first values",
        edges(('("low", 50)', '("low", 100)')),
        "3",
        "The first value of the parameter low is 100. The task asks for 50",
    ),
    (
        "properties, read together",
        edges(
            ('        low = self.get_parameter("low").value\n', "        low, high = self.limits\n"),
            ('        high = self.get_parameter("high").value\n', ""),
        )
        + "\n    @property\n    def limits(self):\n"
        '        return [parameter.value for parameter in self.get_parameters(["low", "high"])]\n',
        "123h",
        "",
    ),
    (
        "texts as first values",
        edges(('"low", 50', '"low", "50"'), ('"high", 150', '"high", "150"')),
        "",
        'declared with a number (50, not "50")',
    ),
    (
        "parameters, not their values",
        edges((".value", "")),
        "",
        'This argument must be a number: self.get_parameter("low").value',
    ),
    (
        "edges of the colour frame",
        edges(("Canny(gray,", "Canny(frame,")),
        "",
        "Compute the edges of the gray image itself",
    ),
    (
        "declared in the callback",
        edges((DECLARE, ""), ("        low =", f"{DECLARE}        low =")),
        "",
        "does not have the parameters {'high': 150, 'low': 50}",
    ),
    ("gray published", edges(('(edges, "mono8")', '(gray, "mono8")')), "", "has only the values 0 and 255"),
    (
        "a read-only parameter",
        "from rcl_interfaces.msg import ParameterDescriptor\n"
        + edges(('("low", 50)', '("low", 50, ParameterDescriptor(read_only=True))')),
        "1",
        "does not take a new value for the parameter low",
    ),
)
BRAKE = """import math
import time
import numpy as np
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data as qos
from sensor_msgs.msg import LaserScan

class BrakeNode(Node):
    def __init__(self):
        super().__init__("brake")
        self.commands = self.create_publisher(Twist, "/kachaka/manual_control/cmd_vel", qos)
        self.create_subscription(LaserScan, "/kachaka/lidar/scan", self.on_scan, qos)
        self.timer = self.create_timer(0.5, self.stop)

    def on_scan(self, msg):
        self.timer.reset()
        command = Twist()
        command.linear.x = 0.2
        for number, r in enumerate(msg.ranges):
            angle = msg.angle_min + number * msg.angle_increment + math.pi / 2
            if msg.range_min <= r <= msg.range_max and abs(r * math.sin(angle)) <= 0.2:
                if 0 < r * math.cos(angle) <= 0.4:
                    command.linear.x = 0.0
        self.commands.publish(command)

    def stop(self):
        self.commands.publish(Twist())
"""
RESET, STOP = "        self.timer.reset()\n", "        self.commands.publish(Twist())\n"


def brakes(*changes):
    return changed(*changes, source=BRAKE)


BRAKE_ANSWERS = (
    ("a timer that is reset", BRAKE, "1234h"),
    ("a flag", brakes((RESET, "        self.is_new = True\n"), ("        self.timer =", "        self.is_new = False\n        self.timer ="), (STOP, f"        if not self.is_new:\n    {STOP}        self.is_new = False\n")), "1234h"),
    ("the time of the computer", brakes((RESET, "        self.last = time.monotonic()\n"), ("        self.timer = self.create_timer(0.5", "        self.last = time.monotonic()\n        self.timer = self.create_timer(0.1"), (STOP, f"        if time.monotonic() > self.last + 0.5:\n    {STOP}")), "1234h"),
    ("looks behind", brakes(("+ math.pi / 2", "- math.pi / 2")), "1", "looks behind the robot"),
    ("no angle_min", brakes(("msg.angle_min + number * msg.angle_increment + math.pi / 2", "number * 2 * math.pi / len(msg.ranges) - math.pi / 2")), "134", "begins at angle_min = -1.57"),
    ("only what is new", brakes((", self.stop)\n", ", self.stop)\n        self.x = None\n"), ("        self.commands.publish(command)", "        if command.linear.x != self.x:\n            self.commands.publish(command)\n        self.x = command.linear.x")), "1", "none after this message"),
    ("never again", brakes((", self.stop)\n", ", self.stop)\n        self.speed = 0.2\n"), ("command.linear.x = 0.2", "command.linear.x = self.speed"), ("command.linear.x = 0.0", "command.linear.x = self.speed = 0.0")), "1", "After a stop it never drives again"),
    ("no timer", brakes(("        self.timer = self.create_timer(0.5, self.stop)\n", ""), (RESET, "")), "123", "drives on without seeing"),
)  # fmt: skip
ANSWERS = (
    *(NodeAnswer(name, source) for name, source in RIGHT),
    *(NodeAnswer(*answer) for answer in WRONG),
    *(NodeAnswer(*answer, exercise="edges-class") for answer in EDGE_ANSWERS),
    *(NodeAnswer(*answer, exercise="obstacles-brake") for answer in BRAKE_ANSWERS),
)
