"""Why no frame came: the one question that every camera lesson ends in."""

import difflib
import os

from rclpy.qos import QoSCompatibility, qos_check_compatible

IMAGE_TYPES = ("sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage")


def why_nothing_came(subscriber, waited, failed):
    """The cause and the remedy, in one line.

    Parameters
    ----------
    subscriber : ImageSubscriber, running (or what has its attributes); `received` tells one that has heard
        pictures before from one that never has
    waited : seconds that it waited in vain
    failed : frames that arrived meanwhile and did not convert
    """
    start = f"no frame on {subscriber.topic} in {waited:g} s: "
    if failed:
        return f"{start}{failed} arrived and failed; {subscriber.last_error}"
    node = subscriber.session.node
    if node is None:
        return f"{start}the ROS session is stopped; make a new ImageSubscriber"
    publishers = node.get_publishers_info_by_topic(subscriber.topic)
    if not publishers:
        return start + _nobody(node, subscriber.topic)
    wanted = "/".join(
        (subscriber.message_type.__module__.split(".")[0], "msg", subscriber.message_type.__name__)
    )
    of_our_type = [publisher for publisher in publishers if publisher.topic_type == wanted]
    if not of_our_type:
        return start + _wrong_type(publishers[0].topic_type, wanted, subscriber.topic)
    if not subscriber.matched:
        return start + (subscriber.incompatible_qos or _unmatched(of_our_type[0], subscriber))
    return start + _silent(of_our_type, subscriber)


def _nobody(node, topic):
    names = {name: types for name, types in node.get_topic_names_and_types() if name != topic}
    pictures = [name for name, types in names.items() if set(types) & set(IMAGE_TYPES)]
    published = [name for name in pictures if node.count_publishers(name)]
    close = difflib.get_close_matches(topic, published, n=3, cutoff=0.5) or published[:3]
    where = f"domain {node.context.get_domain_id()}, discovery range {_discovery_range()}"
    if close:
        return f"nobody publishes it ({where}); pictures come on {', '.join(close)}"
    return (
        f"nobody publishes it, nor any picture ({where}); run open_camera(), or imgproc-course play in a "
        "terminal, or give a robot's machine and this one the same ROS_DOMAIN_ID, and the range SUBNET"
    )


def _discovery_range():
    return os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE") or "SUBNET (the default)"


def _wrong_type(found, wanted, topic):
    remedy = "no pictures there"
    if found == IMAGE_TYPES[1]:
        remedy = (
            "its name must end in /compressed to be read as that: remap it, or publish it under such a name"
        )
    elif found == IMAGE_TYPES[0]:
        remedy = f"subscribe to {topic.rpartition('/')[0]} for raw pictures"
    return f"it carries {found}, and {wanted} was expected; {remedy}"


def _unmatched(publisher, subscriber):
    verdict, reason = qos_check_compatible(publisher.qos_profile, subscriber.qos)
    if verdict is QoSCompatibility.OK:
        return "it is published, but the two ends have not found each other yet; wait again"
    return f'the QoS does not match ({reason.strip("; ")}); use qos="sensor_data"'


def _silent(publishers, subscriber):
    known = {
        f"{p.node_namespace.rstrip('/')}/{p.node_name}" for p in publishers if "UNKNOWN_" not in p.node_name
    }
    who = ", ".join(sorted(known)) or "a node whose name is not known yet"
    if subscriber.received:
        return (
            f"{who} publishes it, and nothing came any more; it is paused, or was killed or cut off (ROS "
            "notices only after some 20 s)"
        )
    compressed = subscriber.topic.endswith("compressed")
    lost = (
        ""
        if compressed
        else (
            ", or its big pictures get lost on the way: subscribe to "
            f"{subscriber.topic}/compressed, and see imgproc_course.ros.dds_profile() where it is published"
        )
    )
    return (
        f"{who} publishes it, but nothing came; it is paused, or still starting (a Kachaka's depth camera is "
        f"silent on its charger){lost}"
    )
