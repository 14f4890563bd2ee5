"""The subscriber: frames with the right pixels, correct counts, and the reason if no image arrives."""

import gc
import importlib
import os
import re
import struct
import threading
import types
import weakref
import zlib

import numpy as np
import pytest

pytest.importorskip("rclpy", reason="needs ROS 2")

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import String

from imgproc_course.messages import array_to_compressed, array_to_image
from imgproc_course.ros import ImageSubscriber, diagnostics
from imgproc_course.ros.diagnostics import VIDEO_TYPES, _wrong_type

pytestmark = pytest.mark.ros

TOPIC = "/images/image_raw"


@pytest.fixture
def send(session, wait_until):
    """send(array, ...) publishes an image on TOPIC as soon as it has a subscriber."""
    publisher = session.node.create_publisher(Image, TOPIC, qos_profile_sensor_data)

    def publish(array, encoding="rgb8", subscribers=1):
        wait_until(lambda: publisher.get_subscription_count() >= subscribers)
        msg = array if isinstance(array, Image) else array_to_image(array, encoding)
        publisher.publish(msg)

    publish.publisher = publisher
    return publish


@pytest.fixture
def subscribe(session):
    """Creates subscribers that end with the test."""
    subscribers = []

    def make(*arguments, **options):
        subscribers.append(ImageSubscriber(*arguments, **options))
        return subscribers[-1]

    yield make
    for subscriber in subscribers:
        subscriber.stop()


def colours():
    return np.arange(4 * 5 * 3, dtype=np.uint8).reshape(4, 5, 3)


def broken_image():
    msg = Image(height=4, width=5, encoding="rgb8", step=15)
    msg.data.frombytes(bytes(10))
    return msg


def send_soon(send, *arguments):
    threading.Timer(0.2, send, arguments).start()


def test_wait_returns_the_image_in_the_requested_encoding(send, subscribe):
    subscriber = subscribe(TOPIC)
    assert subscriber.latest() is None
    send_soon(send, colours())
    frame = subscriber.wait(60)
    assert np.array_equal(frame, colours()[:, :, ::-1])
    assert subscriber.latest() is frame
    assert (subscriber.received, subscriber.failed, subscriber.dropped) == (1, 0, 0)


@pytest.mark.parametrize("encoding", ["rgb8", "passthrough"])
def test_frames_come_in_other_encodings(send, subscribe, encoding):
    subscriber = subscribe(TOPIC, encoding=encoding)
    send_soon(send, colours())
    assert np.array_equal(subscriber.wait(60), colours())


def test_a_topic_ending_in_compressed_is_read_as_compressed(session, subscribe, wait_until):
    topic = f"{TOPIC}/compressed"
    publisher = session.node.create_publisher(CompressedImage, topic, qos_profile_sensor_data)
    subscriber = subscribe(topic)
    wait_until(lambda: publisher.get_subscription_count())
    publisher.publish(array_to_compressed(colours(), "bgr8", format="png"))
    wait_until(lambda: subscriber.latest() is not None)
    assert np.array_equal(subscriber.latest(), colours())


def test_on_image_gets_frame_and_message_in_order(send, subscribe, wait_until):
    values = []
    subscribe(TOPIC, lambda frame, msg: values.append((int(frame[0, 0, 0]), msg.encoding)))
    for value in (1, 2, 3):
        send(np.full((2, 2), value, np.uint8), "mono8")
        wait_until(lambda value=value: len(values) == value)
    assert values == [(1, "mono8"), (2, "mono8"), (3, "mono8")]


def test_a_message_that_cannot_be_converted_is_logged_counted_and_skipped(
    send, subscribe, wait_until, caplog
):
    frames = []
    subscriber = subscribe(TOPIC, lambda frame, msg: frames.append(frame))
    send(broken_image())
    send(colours())
    wait_until(lambda: frames)
    assert (subscriber.received, subscriber.failed, len(frames)) == (2, 1, 1)
    assert np.array_equal(subscriber.latest(), colours()[:, :, ::-1])
    assert subscriber.last_error.startswith(f"a message of {TOPIC} cannot be converted: ")
    assert [record.message for record in caplog.records] == [
        f"{subscriber.last_error} (skipped; 1 failed so far)"
    ]


def test_the_same_fault_over_and_over_is_logged_now_and_then(send, subscribe, wait_until, caplog):
    subscriber = subscribe(TOPIC)
    for count in range(1, 21):
        send(broken_image())
        wait_until(lambda count=count: subscriber.failed == count)
    assert len(caplog.records) == 1


def test_an_exception_in_on_image_is_logged_counted_and_kills_nothing(send, subscribe, wait_until, caplog):
    frames = []

    def on_image(frame, msg):
        frames.append(frame)
        if len(frames) == 1:
            frame.no_such_thing  # noqa: B018

    subscriber = subscribe(TOPIC, on_image)
    send(colours())
    wait_until(lambda: subscriber.failed == 1)
    send(colours())
    wait_until(lambda: len(frames) == 2)
    assert (subscriber.received, subscriber.failed) == (2, 1)
    assert "(frame.no_such_thing" in subscriber.last_error
    ending = "AttributeError: 'numpy.ndarray' object has no attribute 'no_such_thing'"
    assert subscriber.last_error.endswith(ending)
    (record,) = caplog.records
    heading, line, error = record.message.splitlines()
    assert heading == "on_image failed; the subscriber continues" and error == ending
    assert line.startswith("in on_image, line ") and line.endswith(":  frame.no_such_thing  # noqa: B018")


def test_an_on_image_that_fails_with_every_frame_is_shown_once(send, subscribe, wait_until, caplog):
    subscriber = subscribe(TOPIC, lambda frame, msg: frame[frame.shape[0] + subscriber.failed])
    for count in range(1, 13):
        send(colours())
        wait_until(lambda count=count: subscriber.failed == count)
    first, again = [record.message for record in caplog.records]
    assert "\nIndexError: index " in first
    assert again.startswith("again, 10 times: IndexError: index ")


def test_a_reliable_subscriber_learns_why_it_receives_nothing(send, subscribe, wait_until, caplog):
    subscriber = subscribe(TOPIC, qos="reliable")
    wait_until(lambda: subscriber.incompatible_qos)
    text = (
        f"{TOPIC} is published with an incompatible QoS policy: this subscription requests RELIABLE, "
        'the publisher offers BEST_EFFORT; use qos="sensor_data"'
    )
    assert subscriber.incompatible_qos == text
    # Who waits for the report has the line in its output already, and a notebook's next cell does not get it.
    assert [record.message for record in caplog.records] == [text]
    with pytest.raises(TimeoutError) as error:
        subscriber.wait(0.1)
    assert str(error.value) == f"no image arrived on {TOPIC} in 0.1 s: {text}"


def test_another_incompatible_policy_is_named(send, subscribe, wait_until):
    subscriber = subscribe(
        TOPIC,
        qos=QoSProfile(
            depth=1,
            reliability=ReliabilityPolicy.BEST_EFFORT,
            durability=DurabilityPolicy.TRANSIENT_LOCAL,
        ),
    )
    wait_until(lambda: subscriber.incompatible_qos)
    assert "requests TRANSIENT_LOCAL" in subscriber.incompatible_qos


def reason(subscriber, seconds=0.3):
    with pytest.raises(TimeoutError) as error:
        subscriber.wait(seconds)
    start = f"no image arrived on {subscriber.topic} in {seconds:g} s: "
    assert str(error.value).startswith(start)
    assert "\n" not in str(error.value)
    return str(error.value).removeprefix(start)


def test_waiting_for_a_report_of_incompatible_qos_ends_with_it(send, subscribe):
    reliable = subscribe(TOPIC, qos="reliable")
    assert 'use qos="sensor_data"' in reliable.wait_for_incompatible_qos()
    with pytest.raises(TimeoutError, match=r"no incompatible QoS policy on /images/image_raw in 0\.1 s"):
        subscribe(TOPIC).wait_for_incompatible_qos(0.1)


def test_no_publisher_but_a_similar_topic(send, subscribe, session):
    session.node.create_publisher(type(broken_image()), "/images/other", 5)
    text = reason(subscribe("/images/image_rw"))
    domain = session.context.get_domain_id()
    assert text.startswith(
        f"no node publishes this topic (domain {domain}, discovery range LOCALHOST); images are published on "
    )
    assert text.split("images are published on ")[1].split(", ")[0] == TOPIC


def test_a_lossless_transport(send, subscribe, session, wait_until):
    publisher = session.node.create_publisher(CompressedImage, f"{TOPIC}/zstd", qos_profile_sensor_data)
    assert f"images are published on {TOPIC}, {TOPIC}/zstd" in reason(subscribe(f"{TOPIC}/zst"))
    subscriber = subscribe(f"{TOPIC}/zstd", encoding="rgb8")
    wait_until(lambda: publisher.get_subscription_count() == 1)
    assert "/compressed" not in reason(subscriber)
    data = struct.pack("<IIBII", 4, 5, 0, 15, 4) + b"rgb8" + zlib.compress(colours().tobytes())
    publisher.publish(CompressedImage(format="zstd", data=data))
    wait_until(lambda: subscriber.latest() is not None)
    assert (subscriber.latest() == colours()).all()


def test_no_publisher_at_all(subscribe):
    text = reason(subscribe(TOPIC))
    assert text.startswith("no node publishes this topic or any other image (domain ")
    assert "open_camera()" in text and "imgproc-course play" in text and "ROS_DOMAIN_ID" in text


def test_the_publisher_is_silent(send, subscribe, session, wait_until):
    subscriber = subscribe(TOPIC)
    wait_until(lambda: subscriber.matched == 1)
    text = reason(subscriber)
    assert text.startswith(f"/{session.node.get_name()} publishes it, but no image came; the node is paused")
    assert f"subscribe to {TOPIC}/compressed" in text


def test_a_callback_of_the_publishing_node_has_failed(subscribe, session, wait_until):
    subscriber = subscribe("/by_hand/gray")

    def make(callback):
        node = session.add_node(Node("by_hand", context=session.context))
        publisher = node.create_publisher(Image, "~/gray", subscriber.qos)
        node.create_timer(0.01, lambda: callback(publisher))
        wait_until(lambda: subscriber.matched == 1)

    make(lambda publisher: None)
    assert "a callback failed" not in reason(subscriber)
    make(lambda publisher: publisher.publish("gray"))  # raises in rclpy
    expected = (
        r'/by_hand publishes it, but a callback failed in line \d+ \(.*publisher.publish\("gray"\).*\): Type'
    )
    assert re.match(expected, reason(subscriber))
    make(lambda publisher: None)  # the mended class takes its place
    assert "a callback failed" not in reason(subscriber)


def test_the_publishing_node_itself_receives_nothing(send, subscribe, session, wait_until):
    node = session.add_node(Node("by_hand", context=session.context))
    node.create_publisher(Image, "~/gray", 10)
    subscriber = subscribe("/by_hand/gray")
    wait_until(lambda: subscriber.matched == 1)
    node.create_subscription(Image, TOPIC, print, 10)
    start = (
        f"/by_hand publishes it, but it receives nothing from {TOPIC}: the QoS policies are incompatible ("
    )
    assert reason(subscriber).startswith(
        start + "best effort publisher and reliable subscription); in its create"
    )
    session.run(lambda: session.node.destroy_publisher(send.publisher))
    wait_until(lambda: not session.node.count_publishers(TOPIC))
    assert f"it subscribes to {TOPIC}, which no node publishes; run open_camera()" in reason(subscriber)


def test_the_publisher_is_another_user(send, subscribe, session, wait_until, monkeypatch):
    subscriber = subscribe(TOPIC)
    wait_until(lambda: subscriber.matched == 1)
    assert diagnostics.process_of(session.node.get_publishers_info_by_topic(TOPIC)[0]).pid == os.getpid()
    monkeypatch.setattr(diagnostics, "users_in", lambda domain: {os.getuid() + 1})
    assert "another user" not in reason(subscriber)  # who is in the domain, and publishes something else
    uids = types.SimpleNamespace(real=os.getuid() + 1)
    process = types.SimpleNamespace(pid=7, uids=lambda: uids, username=lambda: "ada")
    monkeypatch.setattr(diagnostics, "process_of", lambda endpoint: process)
    assert reason(subscriber).startswith(
        "another user of this machine publishes it, ada (process 7), and images "
    )


def test_a_publisher_whose_name_is_not_known_yet(session):
    names = {"node_name": "_NODE_NAME_UNKNOWN_", "node_namespace": "_NODE_NAMESPACE_UNKNOWN_"}
    publishers = [types.SimpleNamespace(**names)]  # as ROS gives it until it has heard of the node
    text = diagnostics._silent_publisher(session.node, publishers, TOPIC, 0)
    assert text.startswith("a node whose name is not known yet publishes it, but no image came")


ALONE = """
from imgproc_course.ros import ImageSubscriber, open_camera
with open_camera() as camera:
    try:
        ImageSubscriber(camera.topic).wait(2)
    except TimeoutError as error:
        print(error)
"""


def test_what_the_environment_keeps_apart_is_named(run_python):
    code, out, _ = run_python(ALONE, ROS_AUTOMATIC_DISCOVERY_RANGE="OFF")
    cause = "; ROS_AUTOMATIC_DISCOVERY_RANGE=OFF: programs do not discover"
    assert code == 0 and cause in out and "unset ROS_" in out


def test_the_publisher_has_become_silent(send, subscribe, session):
    subscriber = subscribe(TOPIC)
    send_soon(send, colours())
    subscriber.wait(60)
    assert reason(subscriber) == (
        f"/{session.node.get_name()} publishes it, but the images have stopped; the node is paused, was "
        "killed, or is cut off (ROS notices this only after about 20 s)"
    )


def test_messages_arrive_and_none_can_be_converted(send, subscribe, wait_until):
    subscriber = subscribe(TOPIC)
    wait_until(lambda: send.publisher.get_subscription_count())
    send_soon(send, broken_image())
    text = reason(subscriber, seconds=3)
    assert text.startswith(f"1 arrived and failed; a message of {TOPIC} cannot be converted: ")


@pytest.mark.parametrize(
    "message_type, remedy",
    [
        ("sensor_msgs/msg/CompressedImage", "its name must end in /compressed: remap it, or publish it"),
        ("std_msgs/msg/String", "this topic carries no images"),
    ],
)
def test_another_type_is_on_the_topic(another_process, session, subscribe, wait_until, message_type, remedy):
    package, name = message_type.split("/msg/")
    another_process.create_publisher(getattr(importlib.import_module(f"{package}.msg"), name), TOPIC, 5)
    subscriber = subscribe(TOPIC)
    wait_until(lambda: session.node.count_publishers(TOPIC))
    text = reason(subscriber)
    assert text.startswith(
        f"the topic carries {message_type}, but the subscription expects sensor_msgs/msg/Image; {remedy}"
    )


def test_a_topic_of_video_proposes_the_raw_one():
    text = _wrong_type(VIDEO_TYPES[0], "sensor_msgs/msg/Image", f"{TOPIC}/theora")
    assert text.endswith(f"subscribe to {TOPIC} for raw images")


def test_a_compressed_topic_that_carries_raw_images_is_explained(
    another_process, session, subscribe, wait_until
):
    topic = f"{TOPIC}/compressed"
    another_process.create_publisher(type(broken_image()), topic, 5)
    subscriber = subscribe(topic)
    wait_until(lambda: session.node.count_publishers(topic))
    assert reason(subscriber) == (
        "the topic carries sensor_msgs/msg/Image, but the subscription expects "
        f"sensor_msgs/msg/CompressedImage; subscribe to {TOPIC} for raw images"
    )


def test_another_type_in_this_process_is_refused(session):
    session.node.create_publisher(String, "/words", 5)
    with pytest.raises(ValueError, match="cannot subscribe to /words as Image: this process already uses"):
        ImageSubscriber("/words")


def test_waiting_on_a_stopped_subscriber_is_an_error(subscribe):
    subscriber = subscribe(TOPIC)
    subscriber.stop()
    subscriber.stop()
    with pytest.raises(RuntimeError, match="is stopped; make a new ImageSubscriber"):
        subscriber.wait()


def test_waiting_ends_when_the_session_stops(subscribe, session):
    subscriber = subscribe(TOPIC)
    threading.Timer(0.2, session.stop).start()
    with pytest.raises(RuntimeError, match="is stopped; make a new ImageSubscriber"):
        subscriber.wait(60)
    assert subscriber.stopped


def test_waiting_in_a_callback_is_refused(subscribe, session):
    subscriber = subscribe(TOPIC)
    with pytest.raises(RuntimeError, match=r"use on_image or latest\(\)"):
        session.run(subscriber.wait)


def test_stopping_within_on_image(send, subscribe, wait_until):
    frames = []

    def on_image(frame, msg):
        frames.append(frame)
        subscriber.stop()

    subscriber = subscribe(TOPIC, on_image)
    send(colours())
    wait_until(lambda: send.publisher.get_subscription_count() == 0)
    assert (len(frames), subscriber.stopped) == (1, True)


def test_iteration_yields_the_newest_and_ends_with_stop(send, subscribe, wait_until):
    subscriber = subscribe(TOPIC)
    values = []

    def read():
        for frame in subscriber:
            values.append(int(frame[0, 0]))
            if values == [1]:  # three more arrive meanwhile, and only the last is read
                for value in (2, 3, 4):
                    send(np.full((2, 2), value, np.uint8), "mono8")
                    wait_until(lambda value=value: subscriber.received == value)

    subscriber.encoding = "mono8"
    reader = threading.Thread(target=read)
    reader.start()
    send(np.full((2, 2), 1, np.uint8), "mono8")
    wait_until(lambda: values == [1, 4])
    assert subscriber.dropped == 0
    subscriber.stop()
    reader.join(60)
    assert not reader.is_alive()


def test_the_rate_is_measured_from_the_arrival_times(subscribe, monkeypatch):
    from imgproc_course.ros import subscriber as module

    clock = [100.0]
    monkeypatch.setattr(module, "time", types.SimpleNamespace(monotonic=lambda: clock[0]))
    subscriber = subscribe(TOPIC)
    assert subscriber.measured_rate == 0.0
    image = module.Image(height=1, width=1, encoding="mono8", step=1)
    image.data.frombytes(b"\0")
    for _ in range(100):
        clock[0] += 0.125
        subscriber._on_message(image, {})
    assert subscriber.measured_rate == 8.0
    clock[0] += 0.5
    assert subscriber.measured_rate == 8.0
    clock[0] += 2.0
    assert subscriber.measured_rate == 0.0


def test_dropped_messages_are_the_gaps_in_the_publishers_numbers(subscribe):
    from imgproc_course.ros import subscriber as module

    subscriber = subscribe(TOPIC, encoding="mono8")
    image = module.Image(height=1, width=1, encoding="mono8", step=1)
    image.data.frombytes(b"\0")

    def arrive(*sequence):
        for number in sequence:
            subscriber._on_message(image, {"publication_sequence_number": number})

    arrive(7, 8, 11)
    assert subscriber.dropped == 2
    subscriber._losses.on_matched(types.SimpleNamespace(current_count=1))  # another publisher starts again
    arrive(1, 2, 4)
    assert subscriber.dropped == 3
    subscriber._losses.on_matched(types.SimpleNamespace(current_count=2))
    arrive(5, 900, 6)
    assert subscriber.dropped is None
    subscriber._losses.on_matched(types.SimpleNamespace(current_count=1))
    arrive(7, 9)
    assert subscriber.dropped == 4
    arrive(None)
    assert subscriber.dropped is None
    assert subscriber.received == 12


def test_messages_overwritten_while_the_thread_is_busy_count_as_dropped(send, subscribe, wait_until):
    gate, entered = threading.Event(), threading.Event()

    def on_image(frame, msg):
        entered.set()
        gate.wait(60)

    subscriber = subscribe(TOPIC, on_image)
    send(colours())
    assert entered.wait(60)
    for _ in range(12):  # the queue holds 5
        send(colours())
    gate.set()
    wait_until(lambda: subscriber.received + (subscriber.dropped or 0) == 13)
    assert (subscriber.received, subscriber.dropped) == (6, 7)


def test_a_subscriber_without_references_is_deleted(send, subscribe, session, wait_until):
    subscriber = ImageSubscriber(TOPIC)
    wait_until(lambda: send.publisher.get_subscription_count() == 1)
    watch = weakref.ref(subscriber)
    del subscriber
    wait_until(lambda: gc.collect() >= 0 and watch() is None)  # a callback may just hold it
    wait_until(lambda: send.publisher.get_subscription_count() == 0)


RERUN = """
from imgproc_course.ros import ImageSubscriber, RosSession
cell = '''
def on_image(frame, msg): calls.append(1)
subscriber{number} = ImageSubscriber("/p", on_image)
'''
calls = []
for number in range(3):
    exec(cell.format(number=number))
print(subscriber0.stopped, subscriber1.stopped, subscriber2.stopped)
def another(frame, msg): pass
other = ImageSubscriber("/p", another)
print(subscriber2.stopped, other.stopped)
"""


def test_running_the_cell_again_replaces_the_subscriber(run_python):
    code, out, err = run_python(RERUN)
    assert (code, out) == (0, "True True False\nFalse False\n")
    assert err == "replaced the subscriber that called on_image on /p\n" * 2


def test_a_modules_function_may_be_called_by_two_subscribers(send, subscribe, wait_until):
    calls = []

    def on_image(frame, msg):
        calls.append(1)

    subscribe(TOPIC, on_image)
    subscribe(TOPIC, on_image)
    send(colours(), subscribers=2)
    wait_until(lambda: len(calls) == 2)


@pytest.mark.parametrize(
    "arguments, options, message",
    [
        (
            (TOPIC,),
            {"qos": "best"},
            "qos must be 'sensor_data', 'reliable' or an rclpy.qos.QoSProfile, got 'best'",
        ),
        ((TOPIC,), {"encoding": "bgr9"}, "bgr9"),
        (("/two words",), {}, "'/two words' is not a topic name"),
        ((None,), {}, "None is not a topic name"),
    ],
)
def test_bad_arguments_are_refused_in_one_line(session, arguments, options, message):
    with pytest.raises(ValueError) as error:
        ImageSubscriber(*arguments, **options)
    assert message in str(error.value) and "\n" not in str(error.value)
