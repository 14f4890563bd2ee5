"""Faults in a graph: ImageProcessors survive each of them, and log what happened."""

import re
import signal
import sys

import cv2
import numpy as np
import pytest

pytestmark = pytest.mark.ros

GRAY, EDGE = "image_gray_processor", "image_edge_detection"
PLAY = "from imgproc_course.ros.player import play; play(speed=2.0)"
NO_IMAGE = r"\[WARN\].*no image arrived on \S+ in 3 s"
AGAIN = r"images arrive again, after \d+\.\d s without"


def gray_of(frame):
    return cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)


def count_of(pattern, process):
    return len(re.findall(pattern, process.output))


def last_line(process):
    return process.output.splitlines()[-1]


def count(name, process):
    """A number of the last line: `12 received, 10 processed, ...`."""
    return int(re.search(rf"(\d+) {name}\b", last_line(process))[1])


def broken_messages(tools):
    """A message for each way in which an image can be broken."""
    good = tools.make_frame(5)
    cut = tools.message_of(good)
    cut.data = cut.data[:100]
    unknown = tools.message_of(good)
    unknown.encoding = "bgr9"
    narrow = tools.message_of(good)
    narrow.step = 3
    endless = tools.message_of(good)
    endless.height = 2**32 - 1
    empty = tools.message_of(np.zeros((0, 0, 3), np.uint8))
    return [cut, unknown, narrow, endless, empty]


def test_malformed_images_are_counted_and_logged_and_the_next_good_one_is_processed(
    start_node, collect, camera, tools
):
    process = start_node(GRAY)
    collector = collect(f"/{GRAY}/gray")
    frame = tools.make_frame(5)
    camera.get_result(collector, tools.message_of(frame))
    for message in broken_messages(tools):
        for _ in range(3):  # best effort may lose some
            camera.send(message)
        result = camera.get_result(collector, tools.message_of(frame))
        assert (tools.pixels(result) == gray_of(frame)).all()
    process.wait_for(r"\[WARN\].* cannot be converted: 48 rows .* got 100.*\(skipped; 1 of \d+ failed\)")
    assert process.leave() == 0
    assert count("failed", process) >= 5
    assert count("processed", process) + count("failed", process) + count("ignored", process) == count(
        "received", process
    )
    # Logged only now and then: the five kinds follow each other faster than the log period.
    assert process.output.count("skipped;") < count("failed", process)
    assert last_line(process).endswith(
        "last error: an empty image on /kachaka/front_camera/image_raw (0×0); is the camera switched on? A "
        "Kachaka's depth camera sends such images on its charger"
    )


def test_size_encoding_and_time_may_change_in_mid_stream(start_node, collect, camera, tools):
    process = start_node(GRAY)
    collector = collect(f"/{GRAY}/gray")
    frame = tools.make_frame(6, 48, 64)
    small = tools.make_frame(7, 31, 17)
    deep = np.full((20, 30), 51 * 257, np.uint16)
    cases = [
        (tools.message_of(frame), gray_of(frame)),
        (tools.message_of(small[..., ::-1].copy(), "rgb8"), gray_of(small)),
        (tools.message_of(gray_of(frame), "mono8"), gray_of(frame)),
        (tools.message_of(deep, "mono16"), np.full((20, 30), 51, np.uint8)),
    ]
    for message, expected in cases:
        result = camera.get_result(collector, message)
        assert (tools.pixels(result) == expected).all()
    past = camera.stamp - 10**10
    result = camera.send_until(lambda: collector.with_stamp(past), tools.message_of(frame), stamp=past)
    assert (tools.pixels(result) == gray_of(frame)).all()
    assert process.leave() == 0
    assert count("failed", process) == 0


def test_the_camera_is_killed_and_comes_back(start, start_node, collect, wait_until):
    node = start_node(EDGE)
    collector = collect(f"/{EDGE}/edges")
    camera = start(sys.executable, "-c", PLAY)
    wait_until(lambda: len(collector.messages) >= 3, state=lambda: camera.output + node.output)
    camera.kill()
    # On a busy machine images may have been missing before; each pause has its two lines.
    wait_until(lambda: count_of(NO_IMAGE, node) == count_of(AGAIN, node) + 1)
    count_before = len(collector.messages)
    again = start(sys.executable, "-c", PLAY)
    wait_until(lambda: len(collector.messages) >= count_before + 3)
    wait_until(lambda: count_of(NO_IMAGE, node) == count_of(AGAIN, node))
    again.leave()
    assert node.leave() == 0
    assert count("failed", node) == 0


def test_at_200_hz_every_image_is_counted_and_the_newest_is_processed(start_node, collect, camera, tools):
    node = start_node(EDGE)
    collector = collect(f"/{EDGE}/edges")
    frame = tools.make_frame(8, 720, 1280)
    message = tools.message_of(frame)
    camera.get_result(collector, message)
    first = camera.sent
    camera.send_until(lambda: camera.sent >= first + 200, message, every=0.005)
    newest = camera.get_result(collector, message)
    assert (tools.pixels(newest) == cv2.Canny(gray_of(frame), 50, 150)).all()
    stamps = collector.stamps()
    assert stamps == sorted(stamps)  # dropped or not, never out of order
    assert node.leave() == 0
    assert count("received", node) + count("lost", node) > 200 and count("failed", node) == 0


def test_two_nodes_of_one_name_both_work_and_both_warn(start_node, collect, camera, tools):
    first, second = start_node(GRAY), start_node(GRAY)
    for node in (first, second):
        node.wait_for(rf"another node has the name /{GRAY} too .* rename one: --ros-args -r __node:=")
    collector = collect(f"/{GRAY}/gray")
    frame = tools.make_frame(9)

    def received_twice():
        stamps = collector.stamps()
        return len(stamps) - len(set(stamps)) >= 2

    camera.send_until(received_twice, tools.message_of(frame))
    assert all((tools.pixels(message) == gray_of(frame)).all() for message in collector.messages)
    assert (first.leave(), second.leave()) == (0, 0)


SHORT_LEASE = """<?xml version="1.0"?>
<dds xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles"><profiles>
  <participant profile_name="dies_early" is_default_profile="true"><rtps><builtin><discovery_config>
    <leaseDuration><sec>1</sec></leaseDuration>
    <leaseAnnouncement><sec>0</sec><nanosec>300000000</nanosec></leaseAnnouncement>
  </discovery_config></builtin></rtps></participant>
</profiles></dds>"""

SUBSCRIBES = """
import sys
from imgproc_course.ros import ImageSubscriber
subscriber = ImageSubscriber(sys.argv[1])
subscriber.wait(60)
print("received one", flush=True)
for frame in subscriber: pass
"""


def test_a_dead_subscriber_is_noticed_and_the_others_still_receive(
    start, start_node, collect, camera, tools, tmp_path
):
    # Fast DDS forgets a killed process after its lease duration: by default 20 s, here 1 s.
    profile = tmp_path / "short_lease.xml"
    profile.write_text(SHORT_LEASE)
    node = start_node(GRAY)
    dying = start(
        sys.executable, "-c", SUBSCRIBES, f"/{GRAY}/gray", FASTRTPS_DEFAULT_PROFILES_FILE=str(profile)
    )
    message = tools.message_of(tools.make_frame(10))
    camera.send_until(lambda: "received one" in dying.output, message)
    collector = collect(f"/{GRAY}/gray")
    camera.get_result(collector, message)
    node.wait_for(rf"/{GRAY}/gray has 2 subscribers")
    dying.kill()
    result = camera.get_result(collector, message)
    assert result.header.frame_id == "camera_front"
    node.wait_for(rf"/{GRAY}/gray has 2 subscribers[\s\S]*/{GRAY}/gray has 1 subscriber\n")
    camera.get_result(collector, message)
    assert node.leave() == 0


def test_a_node_without_images_logs_its_profile_and_why_nothing_arrives_or_leaves(start_node, collect):
    no_choice = dict.fromkeys(("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE"))
    node = start_node(GRAY, **no_choice)
    node.wait_for(r"DDS profile: the course's fastdds(_small)?\.xml: \d+ MiB shared memory, and UDP")
    collect(f"/{GRAY}/gray", qos=10)
    node.wait_for(
        rf"a subscriber of /{GRAY}/gray requests an incompatible QoS policy \(RELIABILITY\) and receives no"
    )
    node.wait_for(r"no node publishes this topic or any other image \(domain \d+, .*imgproc-course play")
    assert node.leave() == 0
    assert count("received", node) == 0


@pytest.mark.parametrize(
    "name, signals",
    [
        (GRAY, (signal.SIGINT,)),
        (GRAY, (signal.SIGTERM,)),
        (EDGE, (signal.SIGINT, signal.SIGINT)),
        (EDGE, (signal.SIGTERM, signal.SIGINT)),
    ],
    ids=["gray-SIGINT", "gray-SIGTERM", "edge-SIGINT-twice", "edge-SIGTERM-SIGINT"],
)
def test_a_node_stopped_in_mid_stream_ends_quietly_and_prints_its_statistics(
    start_node, collect, camera, tools, name, signals
):
    node = start_node(name)
    collector = collect(f"/{name}/gray")
    message = tools.message_of(tools.make_frame(13, 240, 320))
    camera.send_until(lambda: len(collector.messages) >= 3, message, every=0.01)
    for number in signals:
        node.send(number)
    camera.send_until(lambda: not node.running, message, every=0.005)
    assert node.wait() == 0
    assert not re.search(r"Traceback|terminate called|RCLError|Error", node.output)
    assert re.match(
        rf"{name}: \d+ received, \d+ processed, 0 failed, \d+ ignored, \d+ lost$",
        last_line(node),
    )
    assert count("processed", node) >= 3
