"""The messages of a simulated robot's sensors, in the robot's own frames."""

import functools
import math

import numpy as np
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion, Twist, Vector3
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, Image, LaserScan
from std_msgs.msg import Header

from imgproc_course.recording.topics import CAMERA_FRAME, POSE_PREFIX, POSES, WORLD_FRAME
from imgproc_course.ros.robot_topics import SCAN, TOF
from imgproc_course.simulation.laser import RAYS
from imgproc_course.simulation.simulation import CAMERA_MOUNT, LASER_MOUNT, TOF_MOUNT

# As on the robot, whose scanner is turned to the left by 90 degrees.
ODOM_FRAME, BASE_FRAME, LASER_FRAME, TOF_FRAME = "odom", "base_footprint", "laser_frame", "tof_camera"
# Poses in BASE_FRAME, as /tf_static has them.
MOUNTS = {CAMERA_FRAME: CAMERA_MOUNT, TOF_FRAME: TOF_MOUNT, LASER_FRAME: LASER_MOUNT}


def sensor_topics(base):
    """What is published with each RoomImage: (message type, topic, function(image, header))."""
    yield Image, f"{base}/depth", lambda image, header: image.depth(header)
    yield Image, f"{TOF}/image_raw", lambda image, header: image.depth(framed(header, TOF_FRAME), "tof")
    yield CameraInfo, f"{TOF}/camera_info", tof_camera_info
    yield LaserScan, SCAN, lambda image, header: scan_message(image.simulation.scan(), header)
    for name in ("robot", *POSES):
        yield PoseStamped, POSE_PREFIX + name, functools.partial(pose_message, name)


def tof_camera_info(image, header):
    return camera_info(image.simulation.depth_camera("tof"), framed(header, TOF_FRAME))


def framed(header, frame_id):
    return Header(stamp=header.stamp, frame_id=frame_id)


def odometry_message(odometry, header):
    msg = Odometry(header=header, child_frame_id=BASE_FRAME)
    msg.pose.pose.position = Point(x=odometry.x, y=odometry.y)
    half = odometry.yaw / 2
    msg.pose.pose.orientation = Quaternion(z=math.sin(half), w=math.cos(half))
    msg.twist.twist = Twist(linear=Vector3(x=odometry.linear), angular=Vector3(z=odometry.angular))
    return msg


def scan_message(scan, header):
    """The sensor_msgs/LaserScan of a simulation.LaserScan, in the frame of the scanner."""
    return LaserScan(
        header=framed(header, LASER_FRAME),
        angle_min=-math.pi,
        angle_max=-math.pi + (RAYS - 1) * scan.angle_increment,
        angle_increment=scan.angle_increment,
        range_min=scan.range_min,
        range_max=scan.range_max,
        # The first ray of the message points to the right of the robot, that of the simulation ahead.
        ranges=np.roll(scan.ranges, RAYS // 4).tolist(),
    )


def pose_message(name, image, header):
    """The geometry_msgs/PoseStamped of something in the room, as the recorded drive has it."""
    x, y, z, qx, qy, qz, qw = image.simulation.pose(name).tolist()
    pose = Pose(position=Point(x=x, y=y, z=z), orientation=Quaternion(x=qx, y=qy, z=qz, w=qw))
    return PoseStamped(header=framed(header, WORLD_FRAME), pose=pose)


def camera_info(model, header):
    (fx, _, cx), (_, fy, cy), _ = model.matrix.tolist()
    return CameraInfo(
        header=header,
        height=model.height,
        width=model.width,
        distortion_model="plumb_bob",
        d=[float(value) for value in model.distortion],
        k=[fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0],
        r=[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        p=[fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0],
    )
