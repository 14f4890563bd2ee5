"""What an ImageProcessor logs about its stream, its losses, its publishers and its subscribers."""

from rclpy.event_handler import PublisherEventCallbacks
from rclpy.qos import qos_policy_name_from_kind

from imgproc_course.ros.session import Throttle

DUPLICATE_NAME_PERIOD = 60.0  # seconds without a second node of the same name until it is news again


class NodeLog:
    """Logs in the name of a node: a warning once for each cause, and one of a kind every few seconds."""

    def __init__(self, node):
        self._node = node
        self._may_log = Throttle()
        self._causes = set()
        self._may_log_duplicate = Throttle(DUPLICATE_NAME_PERIOD, while_it_lasts=True)

    def info(self, text):
        self._node.get_logger().info(text)

    def warn(self, kind, cause, details=""):
        if cause not in self._causes and self._may_log(kind):
            self._causes.add(cause)
            self._node.get_logger().warning(f"{cause}{details}")

    def warn_about_duplicate_name(self):
        node = self._node
        own_name = (node.get_name(), node.get_namespace())
        if node.get_node_names_and_namespaces().count(own_name) > 1 and self._may_log_duplicate():
            node.get_logger().warning(
                f"another node has the name {node.get_fully_qualified_name()} too (or had it, and was killed "
                "just now): both publish on the same topics; rename one: --ros-args -r __node:=another",
            )

    def count_changed(self, topic, count, role):
        """Logs the new number of a topic's publishers or subscribers."""
        self.info(f"{topic} has {count or 'no'} {role}{'' if count == 1 else 's'}")

    def publisher_events(self, topic):
        """PublisherEventCallbacks that log who subscribes to the topic, and with which QoS in vain."""

        def on_incompatible_qos(event):
            policy = qos_policy_name_from_kind(event.last_policy_kind)
            self.warn(
                f"{topic} qos",
                f"a subscriber of {topic} requests an incompatible QoS policy ({policy}) and receives "
                "nothing; images are published BEST_EFFORT: subscribe with qos_profile_sensor_data",
            )

        def on_matched(event):
            self.count_changed(topic, event.current_count, "subscriber")

        return PublisherEventCallbacks(incompatible_qos=on_incompatible_qos, matched=on_matched)
