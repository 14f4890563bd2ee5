"""Converts the camera's images to gray, and publishes them on ~/gray."""

import cv2
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Image

# On a robot with cv_bridge: from cv_bridge import CvBridge, CvBridgeError
from imgproc_course.messages.cv_bridge import CvBridge, CvBridgeError


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
        topic = "/kachaka/front_camera/image_raw"
        self.create_subscription(Image, topic, self.image_callback, qos)
        self.get_logger().info("The node has started.")

    def image_callback(self, msg):
        try:
            frame = self.bridge.imgmsg_to_cv2(msg, "bgr8")
        except CvBridgeError as error:
            self.get_logger().error(str(error))
            return
        gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
        self.publisher.publish(self.bridge.cv2_to_imgmsg(gray, "mono8", msg.header))


def main(args=None):
    rclpy.init(args=args)
    node = ImageGrayProcessor()
    try:
        rclpy.spin(node)  # until Ctrl-C
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
