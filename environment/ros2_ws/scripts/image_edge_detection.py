#!/usr/bin/env python3
"""Detects the edges in every image of the robot's camera, and shows the original, gray and edges."""

import signal

import cv2
import numpy as np
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Image
from windows import window_problem

# On a robot with cv_bridge: from cv_bridge import CvBridge, CvBridgeError
from imgproc_course.messages.cv_bridge import CvBridge, CvBridgeError


class ImageEdgeDetection(Node):
    """Subscribes to the camera, converts each message, detects its edges, and shows three images."""

    def __init__(self):
        super().__init__("image_edge_detection")
        qos = QoSProfile(
            depth=5, reliability=ReliabilityPolicy.BEST_EFFORT, durability=DurabilityPolicy.VOLATILE
        )
        self.bridge = CvBridge()
        self.create_subscription(Image, "/kachaka/front_camera/image_raw", self.image_callback, qos)
        self.view = self.create_publisher(Image, "~/view", qos)
        self.no_window = window_problem()
        if self.no_window:
            self.get_logger().warning(f"{self.no_window}; the node publishes ~/view instead")
        self.get_logger().info("The edge detection has started.")

    def image_callback(self, msg):
        try:
            frame = self.bridge.imgmsg_to_cv2(msg, "bgr8")
            gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
            # Above 150 an edge is strong. Between 50 and 150 it stays if it is connected to a strong one.
            edges = cv2.Canny(gray, 50, 150)
        except (CvBridgeError, cv2.error) as error:
            self.get_logger().error(f"An image was not processed: {error}")
            return
        if self.no_window:
            three = np.hstack([frame, cv2.merge([gray] * 3), cv2.merge([edges] * 3)])
            self.view.publish(self.bridge.cv2_to_imgmsg(three, "bgr8", header=msg.header))
        else:
            cv2.imshow("original", frame)
            cv2.imshow("gray", gray)
            cv2.imshow("edges", edges)
            cv2.waitKey(1)  # milliseconds: gives OpenCV the time to draw


def main():
    # Ctrl-C ends ROS, and with it spin. It must not raise KeyboardInterrupt too, in the middle of an image.
    signal.signal(signal.SIGINT, lambda *_: None)
    rclpy.init()
    node = ImageEdgeDetection()
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
