"""A node that keeps what it creates, publishes and logs; nothing is sent.

`RecordingNode` has the methods of rclpy's Node that image nodes use. Messages, QoS profiles and errors come
from modules named rclpy, sensor_msgs, ...: from ROS, or from `ros_double`. What it does not have raises
NotGradedError where it is used: that is no mistake.
"""

import importlib
import inspect
import re


class NotGradedError(Exception):
    """A node uses a part of ROS that the check does not have."""


class NodeError(Exception):
    """A class does not make a node that can be driven; the message says what to do."""


class NodeStopped(BaseException):
    """Ends a drive from inside the learner's code, whatever that code catches; `error` says why."""

    is_driven = False

    def __init__(self, error):
        self.error = error


UNKNOWN_PART = "This check does not know"  # how the messages of NotGradedError begin
LEVELS = ("debug", "info", "warn", "error", "fatal")


def stop(error):
    """Raise an error of ours; in a drive no `except Exception` of the learner's catches it."""
    raise NodeStopped(error) if NodeStopped.is_driven else error


def refuse(name):
    advice = "Write the node without it, or ask your teacher to look at it."
    stop(NotGradedError(f"{UNKNOWN_PART} {name} (is it spelled right?). {advice}"))


def ros_name(module, name):
    return getattr(importlib.import_module(module), name)


class NodeRecord:
    """What a node created, published as (topic, fields), and logged as (level, text)."""

    def __init__(self):
        self.publishers, self.subscriptions, self.timers = [], [], []
        self.published, self.logged = [], []


class _Logger:
    def __init__(self, name, logged):
        self.name, self._logged = name, logged

    def __getattr__(self, name):
        if name in ("log", "get_child", "set_level", "get_effective_level", "is_enabled_for"):
            refuse(f"{name}() of a logger")
        level = "warn" if name == "warning" else name
        if level not in LEVELS:
            raise AttributeError(f"'RcutilsLogger' object has no attribute {name!r}")

        def log(message, **_filters):
            if level != "debug" and not isinstance(message, str):
                raise TypeError(f"{name}() takes a text, got a value of type {type(message).__name__}")
            self._logged.append((level, message))
            return True

        return log


class _Endpoint:
    """A publisher or a subscription."""

    def __init__(self, record, msg_type, topic, qos_profile, callback=None):
        self._record, self.msg_type, self.topic_name = record, msg_type, topic
        self.topic, self.qos_profile, self.callback = topic, qos_profile, callback

    def publish(self, msg):
        if not isinstance(msg, self.msg_type):
            raise TypeError(f"Expected {self.msg_type}, got {type(msg)}")
        self._record.published.append((self.topic_name, fields_of(msg)))

    def call(self, msg):
        """Call the callback of a subscription, with its message alone or with {} as message info."""
        return self.callback(*([msg, {}][: _argument_count(self.callback)]))

    def get_subscription_count(self):
        return 1

    get_publisher_count = get_subscription_count


def fields_of(msg):
    """What an Image holds now, as plain values; of another message only its type."""
    if type_text(type(msg)) != "sensor_msgs/msg/Image":
        return {"type": type_text(type(msg))}
    values = {name: getattr(msg, name) for name in ("encoding", "height", "width", "step")}
    stamp = msg.header.stamp
    header = {"stamp": (stamp.sec, stamp.nanosec), "frame_id": msg.header.frame_id}
    return values | header | {"data": bytes(msg.data)}


def type_text(kind):
    """`sensor_msgs/msg/Image` of a message class."""
    return f"{kind.__module__.partition('.')[0]}/msg/{kind.__name__}"


def _argument_count(callback):
    for count in (1, 2):
        try:
            inspect.signature(callback).bind(*[None] * count)
        except TypeError:
            continue
        return count
    raise RuntimeError(
        "Subscription.__init__(): callback should be either be callable with one argument(to get only the"
        " message) or two (to get message and message info)"
    )


class RecordingNode:
    """The methods of rclpy's Node that image nodes use."""

    def __init__(self, node_name, *, context=None, namespace=None, parameter_overrides=None, **_options):
        ros_name("rclpy.validate_node_name", "validate_node_name")(node_name)
        self._node_record = NodeRecord()
        self._node_name, self._node_namespace = node_name, "/" + (namespace or "").strip("/")
        self._node_context, self._node_logger = context, _Logger(node_name, self._node_record.logged)
        self._declared, self._set_callbacks = {}, []
        self._overrides = {parameter.name: parameter for parameter in parameter_overrides or ()}

    def __getattr__(self, name):
        if name == "_node_record":
            text = "__init__ of your class must begin with super().__init__(...), and the node's name."
            stop(NodeError(text))
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    context = property(lambda self: self._node_context)

    def get_name(self):
        return self._node_name

    def get_namespace(self):
        return self._node_namespace

    def get_fully_qualified_name(self):
        return f"{self._node_namespace.rstrip('/')}/{self._node_name}"

    def get_logger(self):
        return self._node_logger

    def get_clock(self):
        return ros_name("rclpy.clock", "Clock")()

    def resolve_topic_name(self, topic, *, only_expand=False):
        ros_name("rclpy.validate_topic_name", "validate_topic_name")(topic)
        expand = ros_name("rclpy.expand_topic_name", "expand_topic_name")
        return expand(topic, self._node_name, self._node_namespace)

    def create_publisher(self, msg_type, topic, qos_profile, **_options):
        return self._create(self._node_record.publishers, msg_type, topic, qos_profile)

    def create_subscription(self, msg_type, topic, callback, qos_profile, *, raw=False, **_options):
        if raw:
            refuse("raw=True")
        endpoint = self._create(self._node_record.subscriptions, msg_type, topic, qos_profile, callback)
        _argument_count(callback)
        return endpoint

    def _create(self, endpoints, msg_type, topic, qos_profile, callback=None):
        profile_class = ros_name("rclpy.qos", "QoSProfile")
        if isinstance(qos_profile, int) and qos_profile >= 0:
            qos_profile = profile_class(depth=qos_profile)
        if isinstance(qos_profile, int):
            raise ValueError("history depth must be greater than or equal to zero")
        if not isinstance(qos_profile, profile_class):
            raise TypeError(f"Expected QoSProfile or int, but received {type(qos_profile)!r}")
        name = self.resolve_topic_name(topic)
        ros_name("rclpy.type_support", "check_is_valid_msg_type")(msg_type)
        endpoints.append(_Endpoint(self._node_record, msg_type, name, qos_profile, callback))
        return endpoints[-1]

    def create_timer(self, timer_period_sec, callback, *_arguments, autostart=True, **_options):
        self._node_record.timers.append(_Timer(callback, is_on=autostart))
        return self._node_record.timers[-1]

    def destroy_node(self):
        pass

    # ------------------------------------------------------------ parameters

    def declare_parameter(self, name, value=None, descriptor=None, ignore_override=False):
        if name in self._declared:
            raise ros_name("rclpy.exceptions", "ParameterAlreadyDeclaredException")([name])
        parameter_class = ros_name("rclpy.parameter", "Parameter")
        is_type = isinstance(value, parameter_class.Type)
        kind = value if is_type else parameter_class.Type.from_parameter_value(value)
        if name in self._overrides and not ignore_override:
            value = self._overrides[name].value
        parameter = parameter_class(name, value=None if isinstance(value, parameter_class.Type) else value)
        descriptor = descriptor or ros_name("rcl_interfaces.msg", "ParameterDescriptor")()
        # Like rclpy: a refused value is no declaration.
        result = self._store([parameter], {name: (kind, descriptor)})
        if not result.successful:
            error = ros_name("rclpy.exceptions", "InvalidParameterValueException")
            raise error(name, parameter.value, result.reason)
        return parameter

    def declare_parameters(self, namespace, parameters, ignore_override=False):
        prefix = f"{namespace}." if namespace else ""
        options = {"ignore_override": ignore_override}
        return [self.declare_parameter(prefix + name, *others, **options) for name, *others in parameters]

    def has_parameter(self, name):
        return name in self._declared

    def get_parameter(self, name):
        if name not in self._declared:
            raise ros_name("rclpy.exceptions", "ParameterNotDeclaredException")(name)
        parameter, kind, _ = self._declared[name]
        if parameter.value is None and kind.name != "NOT_SET":
            raise ros_name("rclpy.exceptions", "ParameterUninitializedException")(name)
        return parameter

    def get_parameters(self, names):
        return [self.get_parameter(name) for name in names]

    def add_on_set_parameters_callback(self, callback):
        self._set_callbacks.insert(0, callback)

    def set_parameters(self, parameter_list):
        return [self.set_parameters_atomically([parameter]) for parameter in parameter_list]

    def set_parameters_atomically(self, parameter_list):
        missing = [parameter.name for parameter in parameter_list if parameter.name not in self._declared]
        if missing:
            raise ros_name("rclpy.exceptions", "ParameterNotDeclaredException")(missing)
        return self._store(parameter_list)

    def _store(self, parameters, new=None):
        """Set parameters, or declare them with `new` {name: (type, descriptor)}; a SetParametersResult."""
        result_class = ros_name("rcl_interfaces.msg", "SetParametersResult")
        for parameter in parameters:
            kind, descriptor = new[parameter.name] if new else self._declared[parameter.name][1:]
            reason = _problem_of(parameter, kind, descriptor, is_new=bool(new))
            if reason:
                return result_class(successful=False, reason=reason)
        for callback in self._set_callbacks:
            result = callback(parameters)
            if not isinstance(result, result_class):
                return result_class(successful=False, reason="Callback returned an invalid type")
            if not result.successful:
                return result
        for parameter in parameters:
            about = new[parameter.name] if new else self._declared[parameter.name][1:]
            self._declared[parameter.name] = (parameter, *about)
        return result_class(successful=True)


class _Timer:
    """A timer; its period has no meaning in a drive."""

    def __init__(self, callback, is_on):
        self.callback, self.is_on = callback, is_on

    def cancel(self):
        self.is_on = False

    def reset(self):
        self.is_on = True


def _problem_of(parameter, kind, descriptor, is_new):
    """Why a value of a parameter is refused, "" if it is not."""
    if descriptor.read_only and not is_new:
        return f"Trying to set a read-only parameter: {parameter.name}."
    has_type = kind.name != "NOT_SET" and not descriptor.dynamic_typing
    if has_type and parameter.type_ != kind and not (is_new and parameter.value is None):
        return f"Wrong parameter type, expected '{kind}' got '{parameter.type_}'"
    if getattr(descriptor, "integer_range", ()) or getattr(descriptor, "floating_point_range", ()):
        refuse("the range of a parameter")
    return ""


# Names of rclpy's Node that RecordingNode does not have.
_UNKNOWN = re.findall(
    r"\w+",
    """
    PARAM_REL_TOL add_post_set_parameters_callback add_pre_set_parameters_callback add_waitable clients
    count_clients count_publishers count_services count_subscribers create_client create_guard_condition
    create_rate create_service default_callback_group describe_parameter describe_parameters
    destroy_client destroy_guard_condition destroy_publisher destroy_rate destroy_service
    destroy_subscription destroy_timer executor get_client_names_and_types_by_node
    get_fully_qualified_node_names get_node_names get_node_names_and_namespaces
    get_node_names_and_namespaces_with_enclaves get_parameter_or get_parameter_type get_parameter_types
    get_parameters_by_prefix get_publisher_names_and_types_by_node get_publishers_info_by_topic
    get_service_names_and_types get_service_names_and_types_by_node get_subscriber_names_and_types_by_node
    get_subscriptions_info_by_topic get_topic_names_and_types guards handle list_parameters publishers
    remove_on_set_parameters_callback remove_post_set_parameters_callback
    remove_pre_set_parameters_callback remove_waitable resolve_service_name services set_descriptor
    subscriptions timers undeclare_parameter wait_for_node waitables
    """,
)


def refusals(names=()):
    """Attributes that raise NotGradedError in a drive, {name: property}: the unknown ones, and these."""
    names = {*_UNKNOWN, *names}
    return {name: property(lambda _self, name=name: refuse(f"{name} of a node")) for name in names}
