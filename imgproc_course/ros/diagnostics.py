"""Why no image arrives on a topic, and what to do."""

import difflib
import os

from rclpy.qos import QoSCompatibility, qos_check_compatible

from imgproc_course.messages.compressed import TRANSPORTS

IMAGE_TYPES = ("sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage")
VIDEO_TYPES = ("theora_image_transport/msg/Packet", "ffmpeg_image_transport_msgs/msg/FFMPEGPacket")


def explain_missing_messages(
    node,
    subscription,
    seconds,
    received,
    *,
    failure=None,
    qos_problem=None,
    publisher_error=None,
    own_topics=(),
):
    """Why no image came in so many seconds, and the remedy, in one line.

    Before, `received` messages have come. `failure` is what happened to those that came meanwhile, the next
    two what ROS has reported and what went wrong in the publishing node. `own_topics` are not proposed.
    """
    topic, message_type = subscription.topic_name, subscription.msg_type
    start = f"no image arrived on {topic} in {seconds:g} s: "
    if failure:
        return start + failure
    publishers = node.get_publishers_info_by_topic(topic)
    if not publishers:
        return start + _no_publisher(node, topic, own_topics)
    expected_type = f"{message_type.__module__.split('.')[0]}/msg/{message_type.__name__}"
    of_expected_type = [publisher for publisher in publishers if publisher.topic_type == expected_type]
    if not of_expected_type:
        return start + _wrong_type(publishers[0].topic_type, expected_type, topic)
    if not subscription.get_publisher_count():
        return start + (qos_problem or _not_matched(of_expected_type[0], subscription.qos_profile))
    return start + (publisher_error or _silent_publisher(of_expected_type, topic, received))


def _no_publisher(node, topic, own_topics):
    types_of = dict(node.get_topic_names_and_types())
    image_topics = [
        name
        for name, types in types_of.items()
        if name not in (topic, *own_topics) and set(types) & set(IMAGE_TYPES) and node.count_publishers(name)
    ]
    similar = difflib.get_close_matches(topic, image_topics, n=3, cutoff=0.5) or image_topics
    similar = sorted(similar, key=lambda name: name.rpartition("/")[2] in TRANSPORTS[1:])[:3]
    discovery_range = os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE") or "SUBNET (the default)"
    network = f"domain {node.context.get_domain_id()}, discovery range {discovery_range}"
    if similar:
        return f"no node publishes this topic ({network}); images are published on {', '.join(similar)}"
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
    compatibility, reason = qos_check_compatible(publisher.qos_profile, qos)
    if compatibility is QoSCompatibility.OK:
        return "it is published, but publisher and subscription have not found each other yet; wait again"
    return f'the QoS policies are incompatible ({reason.strip("; ")}); use qos="sensor_data"'


def _silent_publisher(publishers, topic, received):
    names = {
        f"{info.node_namespace.rstrip('/')}/{info.node_name}"
        for info in publishers
        if "UNKNOWN_" not in info.node_name
    }
    nodes = ", ".join(sorted(names)) or "a node whose name is not known yet"
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
