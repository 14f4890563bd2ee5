#!/usr/bin/env python3
"""Makes the course's recording (one rosbag2 in MCAP) of the raw material of the rendered drive.

    python environment/drive/record.py RAW_MATERIAL [--out FOLDER] [--force]

RAW_MATERIAL holds camera/NNNN.jpg, depth_mm/NNNN.png, labels/NNNN.png and truth.json. README.md in this
folder says how they were made. Their bytes are stored unchanged, and two runs give the same recording.
"""

import argparse
import json
import shutil
import struct
import sys
from pathlib import Path

import numpy as np
from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from imgproc_course.recording import topics

DEFAULT_OUT = Path(__file__).parents[2] / "imgproc_course" / "recording" / "drive"
TYPES = get_typestore(Stores.ROS2_JAZZY)
# Version 8 of rosbag2's metadata is the newest that `ros2 bag` of both Humble and Jazzy reads.
METADATA_VERSION = 8
# Monday 2026-01-05, 08:00:00 UTC: a fixed start of the robot's clock, so that two runs agree.
START_NS = 1_767_600_000 * 10**9
STEP_NS = 10**8  # 10 Hz
COMPRESSED_DEPTH_HEADER = struct.pack("<iff", 0, 0.0, 0.0)  # the two parameters have no meaning for 16UC1
FOREVER = QosTime(9223372036, 854775807)
TRUTH_KEYS = {"camera": "camera_optical"}


def qos(reliability, durability, depth):
    return Qos(
        QosHistory.KEEP_LAST,
        depth,
        reliability,
        durability,
        FOREVER,
        FOREVER,
        QosLiveliness.AUTOMATIC,
        FOREVER,
        avoid_ros_namespace_conventions=False,
    )


# The Kachaka's bridge publishes its cameras with rclcpp::SensorDataQoS.
SENSOR_DATA = qos(QosReliability.BEST_EFFORT, QosDurability.VOLATILE, 5)
RELIABLE = qos(QosReliability.RELIABLE, QosDurability.VOLATILE, 10)
LATCHED = qos(QosReliability.RELIABLE, QosDurability.TRANSIENT_LOCAL, 1)

CONNECTIONS = {
    topics.CAMERA: ("sensor_msgs/msg/CompressedImage", SENSOR_DATA),
    topics.CAMERA_INFO: ("sensor_msgs/msg/CameraInfo", SENSOR_DATA),
    topics.DEPTH: ("sensor_msgs/msg/CompressedImage", RELIABLE),
    topics.LABELS: ("sensor_msgs/msg/CompressedImage", RELIABLE),
    topics.SCENE: ("std_msgs/msg/String", LATCHED),
    **{topics.POSE_PREFIX + name: ("geometry_msgs/msg/PoseStamped", RELIABLE) for name in topics.POSES},
}


def message(kind, **fields):
    return TYPES.types[kind](**fields)


def header(stamp_ns, frame_id):
    stamp = message("builtin_interfaces/msg/Time", sec=stamp_ns // 10**9, nanosec=stamp_ns % 10**9)
    return message("std_msgs/msg/Header", stamp=stamp, frame_id=frame_id)


def compressed_image(stamp_ns, format, data):
    return message(
        "sensor_msgs/msg/CompressedImage",
        header=header(stamp_ns, topics.CAMERA_FRAME),
        format=format,
        data=np.frombuffer(data, np.uint8),
    )


def camera_info(stamp_ns, truth):
    k = np.array(truth["K"], np.float64)
    no_region = message(
        "sensor_msgs/msg/RegionOfInterest", x_offset=0, y_offset=0, height=0, width=0, do_rectify=False
    )
    return message(
        "sensor_msgs/msg/CameraInfo",
        header=header(stamp_ns, topics.CAMERA_FRAME),
        height=truth["height"],
        width=truth["width"],
        distortion_model=truth["distortion_model"],
        d=np.array(truth["D"], np.float64),
        k=k,
        r=np.eye(3).ravel(),
        p=np.hstack([k.reshape(3, 3), np.zeros((3, 1))]).ravel(),
        binning_x=0,
        binning_y=0,
        roi=no_region,
    )


def pose(stamp_ns, values):
    x, y, z, qx, qy, qz, qw = values
    return message(
        "geometry_msgs/msg/PoseStamped",
        header=header(stamp_ns, topics.WORLD_FRAME),
        pose=message(
            "geometry_msgs/msg/Pose",
            position=message("geometry_msgs/msg/Point", x=x, y=y, z=z),
            orientation=message("geometry_msgs/msg/Quaternion", x=qx, y=qy, z=qz, w=qw),
        ),
    )


def scene(truth):
    facts = {
        "label_names": truth["labels"],
        "marker": truth["marker"],
        "made_by": "rendered with Blender by environment/drive/render_scene.py; no real room, no real person",
    }
    return message("std_msgs/msg/String", data=json.dumps(facts))


def messages_of_frame(raw, truth, k):
    """Yields (topic, message) of one moment of the drive, in the order of recording."""
    stamp = START_NS + k * STEP_NS
    number = f"{k:04d}"
    depth = COMPRESSED_DEPTH_HEADER + (raw / "depth_mm" / f"{number}.png").read_bytes()
    yield topics.CAMERA, compressed_image(stamp, "jpeg", (raw / "camera" / f"{number}.jpg").read_bytes())
    yield topics.CAMERA_INFO, camera_info(stamp, truth)
    yield topics.DEPTH, compressed_image(stamp, "16UC1; compressedDepth png", depth)
    yield (
        topics.LABELS,
        compressed_image(stamp, "mono8; png compressed ", (raw / "labels" / f"{number}.png").read_bytes()),
    )
    for name in topics.POSES:
        yield topics.POSE_PREFIX + name, pose(stamp, truth["frames"][str(k)][TRUTH_KEYS.get(name, name)])


def record(raw, out):
    """Writes the recording of the raw material in folder `raw` into the new folder `out`."""
    truth = json.loads((raw / "truth.json").read_text(encoding="utf-8"))
    if truth["fps"] * STEP_NS != 10**9:
        raise ValueError(f"truth.json gives {truth['fps']} frames/s, this script expects 10; change STEP_NS")
    with Writer(out, version=METADATA_VERSION, storage_plugin=StoragePlugin.MCAP) as writer:
        connections = {
            topic: writer.add_connection(topic, kind, typestore=TYPES, offered_qos_profiles=[profile])
            for topic, (kind, profile) in CONNECTIONS.items()
        }

        def write(topic, stamp, msg):
            writer.write(connections[topic], stamp, TYPES.serialize_cdr(msg, connections[topic].msgtype))

        write(topics.SCENE, START_NS, scene(truth))
        for k in range(len(truth["frames"])):
            for topic, msg in messages_of_frame(raw, truth, k):
                write(topic, START_NS + k * STEP_NS, msg)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("raw", type=Path, help="the folder with camera/, depth_mm/, labels/ and truth.json")
    parser.add_argument(
        "--out",
        type=Path,
        default=DEFAULT_OUT,
        help="the folder of the recording (default: the one in the package)",
    )
    parser.add_argument("--force", action="store_true", help="replace an existing recording")
    options = parser.parse_args()
    if not (options.raw / "truth.json").is_file():
        sys.exit(f"{options.raw} has no truth.json: give the folder with the raw material (see README.md)")
    if options.out.exists():
        if not options.force:
            sys.exit(f"{options.out} exists already: give --force to replace it, or --out for another folder")
        shutil.rmtree(options.out)
    record(options.raw, options.out)
    size = sum(path.stat().st_size for path in options.out.iterdir())
    print(f"{options.out}: {size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
