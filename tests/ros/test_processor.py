"""ImageProcessor in a notebook's session: how `process` is called, and what happens to its errors."""

import re
import threading

import numpy as np
import pytest

pytestmark = pytest.mark.ros

TOPIC = "/kachaka/front_camera/image_raw"


@pytest.fixture
def nodes():
    """The nodes that `make_node` has made."""
    return []


@pytest.fixture
def make_node(session, nodes):
    """Makes an ImageProcessor that the session spins."""

    def make(process, outputs=("gray",), **options):
        from imgproc_course.ros import ImageProcessor

        node = ImageProcessor("learner", process, outputs, context=session.context, **options)
        nodes.append(session.add_node(node))
        return node

    return make


@pytest.fixture
def publish(session, nodes, wait_until):
    """Publishes a frame on the camera's topic, with a stamp that counts from 1; returns when it has arrived.

    So a busy machine loses none: of images that wait, a node keeps the last five.
    """
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import Image
    from std_msgs.msg import Header

    from imgproc_course.messages import array_to_image

    publisher = session.node.create_publisher(Image, TOPIC, qos_profile_sensor_data)
    count = 0

    def send(frame, encoding="bgr8"):
        nonlocal count
        count += 1
        header = Header(frame_id="camera_front")
        header.stamp.sec = count
        (node,) = nodes
        wait_until(lambda: publisher.get_subscription_count() and node._subscription.get_publisher_count())
        received = node.statistics()["received"]
        publisher.publish(array_to_image(frame, encoding, header))
        wait_until(lambda: node.statistics()["received"] > received)

    return send


@pytest.fixture
def subscribe(collect):
    from sensor_msgs.msg import Image

    return lambda topic="/learner/gray": collect(topic, Image)


FRAME = np.arange(4 * 6 * 3, dtype=np.uint8).reshape(4, 6, 3)


def send_until(condition, publish, wait_until, frame=FRAME, encoding="bgr8"):
    wait_until(lambda: condition() or publish(frame, encoding) or condition())


def test_the_frame_is_bgr_and_may_be_drawn_on_whatever_the_camera_sends(
    make_node, publish, subscribe, wait_until
):
    def process(frame):
        before = frame.copy()
        frame[:] = 0
        return {"gray": before}

    make_node(process)
    messages = subscribe()
    for frame, encoding in ((FRAME, "bgr8"), (FRAME[..., ::-1].copy(), "rgb8")):
        messages.clear()
        send_until(lambda: messages, publish, wait_until, frame, encoding)
        assert bytes(messages[-1].data) == FRAME.tobytes()
        assert (messages[-1].encoding, messages[-1].header.frame_id) == ("bgr8", "camera_front")


@pytest.mark.parametrize(
    "result, encoding",
    [(np.full((2, 3), 7, np.uint8), "mono8"), (np.full((2, 3), 0.5, np.float32), "32FC1")],
    ids=["mono8", "32FC1"],
)
def test_the_encoding_follows_from_the_array_that_process_returns(
    make_node, publish, subscribe, wait_until, result, encoding
):
    make_node(lambda frame: {"gray": result})
    messages = subscribe()
    send_until(lambda: messages, publish, wait_until)
    assert (messages[0].encoding, messages[0].height, messages[0].width) == (encoding, 2, 3)
    assert bytes(messages[0].data) == result.tobytes()


def divides_by_zero(frame):
    return {"gray": 1 // 0}


def stops(frame):
    raise StopIteration


@pytest.mark.parametrize(
    "process, error",
    [
        (divides_by_zero, r"process failed in line \d+ of test_processor.py \(return .* 1 // 0\}\): ZeroDiv"),
        (stops, r"process failed in line \d+ of test_processor.py \(raise StopIteration\): StopIteration"),
        (lambda frame: frame, r"must return a dict with the keys \['gray'\], but it returned a ndarray"),
        (lambda frame: {"grey": frame}, r"keys \['gray'\], but it returned \['grey'\]"),
        (lambda frame: {"gray": None}, r"process did not return an image: expected a NumPy array, got None"),
        (lambda frame: {"gray": lambda: 1 // 0}, r"process failed in line \d+ .*: ZeroDivisionError"),
        (lambda: {}, r"process failed .*: TypeError: .*takes 0 positional arguments but 1 was given"),
    ],
)
def test_a_mistake_in_process_is_counted_and_logged_and_the_node_continues(
    make_node, publish, subscribe, wait_until, process, error
):
    node = make_node(process)
    messages = subscribe()
    send_until(lambda: node.statistics()["failed"] >= 2, publish, wait_until)
    assert re.search(error, node.statistics()["last_error"])
    node._process = lambda frame: {"gray": frame}
    send_until(lambda: messages, publish, wait_until)

    def every_image_is_counted_once():
        counts = node.statistics()
        return counts["received"] == counts["processed"] + counts["failed"] + counts["ignored"]

    wait_until(every_image_is_counted_once)  # the last one may be in the node still


def test_only_outputs_with_a_subscriber_are_computed(make_node, publish, subscribe, wait_until):
    computed = []

    def output(key):
        def compute():
            computed.append(key)
            return FRAME

        return compute

    node = make_node(lambda frame: {key: output(key) for key in ("gray", "view")}, ("gray", "view"))
    send_until(lambda: node.statistics()["ignored"] >= 2, publish, wait_until)
    assert computed == []
    messages = subscribe("/learner/view")
    send_until(lambda: messages, publish, wait_until)
    assert set(computed) == {"view"}


def test_the_oldest_waiting_images_are_dropped_first(session, make_node, subscribe, wait_until):
    """Twenty images arrive while the first is processed; then the last five are processed, in order."""
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import Image

    from imgproc_course.messages import array_to_image

    started, may_continue, levels = threading.Event(), threading.Event(), []

    def process(frame):
        started.set()
        may_continue.wait(60)
        levels.append(int(frame[0, 0, 0]))
        return {"gray": frame}

    def send(level):
        camera.publish(array_to_image(np.full((2, 2, 3), level, np.uint8), "bgr8"))

    def every_image_is_counted():
        counts = node.statistics()
        return counts["received"] + (counts["lost"] or 0) == 21

    node = make_node(process)
    subscribe()
    camera = session.node.create_publisher(Image, TOPIC, qos_profile_sensor_data)
    gray_subscribers = node._outputs.publishers["gray"].get_subscription_count
    wait_until(
        lambda: (
            gray_subscribers()
            and camera.get_subscription_count()
            and node._subscription.get_publisher_count()
        )
    )
    send(100)
    assert started.wait(60)
    for k in range(20):
        send(k)
    may_continue.set()
    wait_until(every_image_is_counted)
    wait_until(lambda: len(levels) >= 6)
    assert levels == [100, 15, 16, 17, 18, 19]


def test_parameters_reach_process_and_a_check_refuses_values_that_do_not_fit_together(
    make_node, publish, subscribe, wait_until
):
    from rclpy.parameter import Parameter

    from imgproc_course.ros import NumericParameter

    def check(gain, offset):
        if gain * 100 + offset > 255:
            raise ValueError(f"gain {gain} and offset {offset} leave the range")

    values = []

    def process(frame, gain, offset):
        values.append((gain, offset))
        return {"gray": frame}

    parameters = [
        NumericParameter("gain", 1.0, 0, 4, "factor"),
        NumericParameter("offset", 5, 0, 255, "gray levels"),
    ]
    node = make_node(process, parameters=parameters, check=check)
    messages = subscribe()
    send_until(lambda: messages, publish, wait_until)
    assert set(values) == {(1.0, 5)}
    result = node.set_parameters_atomically([Parameter("gain", value=3), Parameter("offset", value=6)])
    assert (result.successful, result.reason) == (False, "gain 3.0 and offset 6 leave the range")
    assert node.set_parameters_atomically(
        [Parameter("gain", value=2), Parameter("offset", value=6)]
    ).successful
    send_until(lambda: values[-1] == (2.0, 6), publish, wait_until)
    assert isinstance(values[-1][0], float)


def test_initial_values_that_do_not_fit_together_are_refused(session):
    from imgproc_course.ros import ImageProcessor, NumericParameter

    def check(low):
        raise ValueError("never")

    with pytest.raises(ValueError, match="never"):
        ImageProcessor(
            "refused",
            print,
            ["gray"],
            parameters=[NumericParameter("low", 1, 0, 2, "")],
            check=check,
            context=session.context,
        )


SIGNALS = """
import os, signal
from imgproc_course.ros.node_process import EXPECTED_SIGNALS
from imgproc_course.ros.stop_signals import stop_signals
with stop_signals(EXPECTED_SIGNALS) as stopping:
    print(stopping.is_set())
    for number in (signal.SIGINT, signal.SIGTERM):
        os.kill(os.getpid(), number)
        print(stopping.is_set(), flush=True)
    os.kill(os.getpid(), signal.SIGINT)
"""


def test_two_signals_wait_for_the_current_image_and_the_third_does_not(run_python):
    code, out, err = run_python(SIGNALS)
    assert (code, out.split()) == (-2, ["False", "True", "True"])
    assert err.splitlines()[-1] == "KeyboardInterrupt"
