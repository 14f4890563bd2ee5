#!/usr/bin/env python3
"""Converts every image of the robot's camera to gray, and shows it in a window."""

import signal

import cv2
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Image
from windows import window_problem

# On a robot with cv_bridge: from cv_bridge import CvBridge, CvBridgeError
from imgproc_course.messages.cv_bridge import CvBridge, CvBridgeError


class ImageGrayProcessor(Node):
    """Subscribes to the camera, converts each message, computes its gray image, and shows it."""

    def __init__(self):
        super().__init__("image_gray_processor")
        qos = QoSProfile(
            depth=5, reliability=ReliabilityPolicy.BEST_EFFORT, durability=DurabilityPolicy.VOLATILE
        )
        self.bridge = CvBridge()
        self.create_subscription(Image, "/kachaka/front_camera/image_raw", self.image_callback, qos)
        self.view = self.create_publisher(Image, "~/view", qos)
        self.no_window = window_problem()
        if self.no_window:
            self.get_logger().warning(f"{self.no_window}; the node publishes ~/view instead")
        self.get_logger().info("The gray processor has started.")

    def image_callback(self, msg):
        try:
            frame = self.bridge.imgmsg_to_cv2(msg, "bgr8")
            gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
        except (CvBridgeError, cv2.error) as error:
            self.get_logger().error(f"An image was not processed: {error}")
            return
        if self.no_window:
            self.view.publish(self.bridge.cv2_to_imgmsg(gray, "mono8", header=msg.header))
        else:
            cv2.imshow("gray", gray)
            cv2.waitKey(1)  # milliseconds: gives OpenCV the time to draw


def main():
    # Ctrl-C ends ROS, and with it spin. It must not raise KeyboardInterrupt too, in the middle of an image.
    signal.signal(signal.SIGINT, lambda *_: None)
    rclpy.init()
    node = ImageGrayProcessor()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except RuntimeError:
        if rclpy.ok():  # else Ctrl-C has ended ROS in the middle of a call, such as publish
            raise
    finally:
        if not node.no_window:
            cv2.destroyAllWindows()
        node.destroy_node()
        rclpy.try_shutdown()  # like rclpy.shutdown(), but Ctrl-C may have done it already


if __name__ == "__main__":
    main()
