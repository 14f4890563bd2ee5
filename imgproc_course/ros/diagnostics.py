"""Why no image arrives on a topic, and what to do."""

import difflib
import os

import psutil
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.qos import QoSCompatibility, qos_check_compatible

from imgproc_course.messages.compressed import TRANSPORTS
from imgproc_course.ros.profile import lost_ports
from imgproc_course.ros_domain import discovery_problem, discovery_range, users_in

IMAGE_TYPES = ("sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage")
VIDEO_TYPES = ("theora_image_transport/msg/Packet", "ffmpeg_image_transport_msgs/msg/FFMPEGPacket")


def explain_missing_messages(
    node, subscription, seconds, received, *, failure=None, qos_problem=None, node_error=None, own_topics=()
):
    """Why no image came in so many seconds, and the remedy, in one line.

    Before, `received` messages have come. `failure` is what happened to those that came meanwhile, the next
    two what ROS has reported and what went wrong in the publishing node. `own_topics` are not proposed.
    """
    topic, message_type = subscription.topic_name, subscription.msg_type
    start = f"no image arrived on {topic} in {seconds:g} s: "
    if failure:
        return start + failure
    if lost_ports():
        return start + "the shared-memory port of this program was removed; wait again, or restart the kernel"
    publishers = node.get_publishers_info_by_topic(topic)
    if not publishers:
        return start + _no_publisher(node, topic, own_topics)
    expected_type = f"{message_type.__module__.split('.')[0]}/msg/{message_type.__name__}"
    of_expected_type = [publisher for publisher in publishers if publisher.topic_type == expected_type]
    if not of_expected_type:
        return start + _wrong_type(publishers[0].topic_type, expected_type, topic)
    if not subscription.get_publisher_count():
        return start + (qos_problem or _not_matched(of_expected_type[0], subscription.qos_profile))
    reason = _other_user(node, of_expected_type) or node_error
    return start + (reason or _silent_publisher(node, of_expected_type, topic, received))


def _no_publisher(node, topic, own_topics):
    types_of = dict(node.get_topic_names_and_types())
    image_topics = [
        name
        for name, types in types_of.items()
        if name not in (topic, *own_topics) and set(types) & set(IMAGE_TYPES) and node.count_publishers(name)
    ]
    similar = difflib.get_close_matches(topic, image_topics, n=3, cutoff=0.5) or image_topics
    similar = sorted(similar, key=lambda name: name.rpartition("/")[2] in TRANSPORTS[1:])[:3]
    network = f"domain {node.context.get_domain_id()}, discovery range {discovery_range()}"
    problem = discovery_problem()
    if similar or problem:
        others = f"images are published on {', '.join(similar)}" if similar else None
        return "; ".join(filter(None, [f"no node publishes this topic ({network})", others, problem]))
    return (
        f"no node publishes this topic or any other image ({network}); run open_camera(), or imgproc-course "
        "play in a terminal; for a robot, use its ROS_DOMAIN_ID and the discovery range SUBNET"
    )


def _wrong_type(actual_type, expected_type, topic):
    remedy = "this topic carries no images"
    if actual_type == IMAGE_TYPES[1]:
        remedy = "its name must end in /compressed: remap it, or publish it under such a name"
    elif actual_type == IMAGE_TYPES[0] or actual_type in VIDEO_TYPES:
        remedy = f"subscribe to {topic.rpartition('/')[0]} for raw images"
    return f"the topic carries {actual_type}, but the subscription expects {expected_type}; {remedy}"


def _not_matched(publisher, qos):
    if reason := _incompatible(publisher.qos_profile, qos):
        return f'the QoS policies are incompatible ({reason}); use qos="sensor_data"'
    return "it is published, but publisher and subscription have not found each other yet; wait again"


def _incompatible(publisher_qos, subscription_qos):
    """Why a publisher's images do not reach a subscription, in a few words; None if they do."""
    compatibility, reason = qos_check_compatible(publisher_qos, subscription_qos)
    reason = reason.replace("ERROR: ", "").strip("; ").replace(";", ", ")
    return reason[0].lower() + reason[1:] if compatibility == QoSCompatibility.ERROR else None


def process_of(endpoint):
    """The psutil.Process of this machine that has an endpoint of the graph; None if it is not known."""
    number = int.from_bytes(bytes(endpoint.endpoint_gid[4:6]), "little")  # Fast DDS: its id's last 16 bits
    pids = [pid for pid in psutil.pids() if pid & 0xFFFF == number]
    return psutil.Process(pids[0]) if len(pids) == 1 else None


def _other_user(node, publishers):
    """That other users' processes publish the topic, and the remedy; None if not only they do."""
    others = [user for user in users_in(node.context.get_domain_id()) if user != os.getuid()]
    processes = [process for info in publishers if others and (process := process_of(info))]
    foreign = [process for process in processes if process.uids().real in others]
    if not foreign or len(foreign) < len(publishers):
        return None
    names = ", ".join(f"{process.username()} (process {process.pid})" for process in foreign)
    return (
        f"another user of this machine publishes it, {names}, and images pass through shared memory, which "
        "is each user's own; run both programs as one user, or open_camera() with another ROS_DOMAIN_ID"
    )


def _input_problem(node, publisher):
    """Why the publishing node itself receives no image, and the remedy; None if nothing is wrong."""
    name = publisher.node_name, publisher.node_namespace
    try:
        topics = node.get_subscriber_names_and_types_by_node(*name)
    except rclpy_implementation.NodeNameNonExistentError:
        return None
    for topic, types in topics:
        sources = node.get_publishers_info_by_topic(topic)
        if not sources and set(types) & set(IMAGE_TYPES):
            return f"it subscribes to {topic}, which no node publishes; run open_camera()"
        for subscription in node.get_subscriptions_info_by_topic(topic):
            reasons = [_incompatible(source.qos_profile, subscription.qos_profile) for source in sources]
            if (subscription.node_name, subscription.node_namespace) == name and all(reasons) and reasons:
                return (
                    f"it receives nothing from {topic}: the QoS policies are incompatible ({reasons[0]}); "
                    "in its create_subscription write qos_profile_sensor_data in place of a number such as 10"
                )
    return None


def _silent_publisher(node, publishers, topic, received):
    known = [info for info in publishers if "UNKNOWN_" not in info.node_name]
    names = {f"{info.node_namespace.rstrip('/')}/{info.node_name}" for info in known}
    nodes = ", ".join(sorted(names)) or "a node whose name is not known yet"
    if problem := next(filter(None, (_input_problem(node, info) for info in known)), None):
        return f"{nodes} publishes it, but {problem}"
    if received:
        return (
            f"{nodes} publishes it, but the images have stopped; the node is paused, was killed, or is cut "
            "off (ROS notices this only after about 20 s)"
        )
    reason = "the node is paused, or still starting (a Kachaka's depth camera is silent on its charger)"
    if topic.rpartition("/")[2] not in TRANSPORTS:
        reason += (
            f", or its big images get lost on the way: subscribe to {topic}/compressed, and run "
            "imgproc-course doctor"
        )
    return f"{nodes} publishes it, but no image came; {reason}"
