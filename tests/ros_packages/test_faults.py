"""What goes wrong in a graph: whatever it is, the installed nodes run on, and say what happened."""

import re
import signal
import sys

import cv2
import numpy as np
import pytest

pytestmark = pytest.mark.ros

GRAY, EDGE = "image_gray_processor", "image_edge_detection"
PLAY = "from imgproc_course.ros.player import play; play(speed=2.0)"


def gray_of(frame):
    return cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)


def last_line(process):
    return process.said.splitlines()[-1]


def count(what, process):
    """A number of the last line: `12 received, 10 processed, ...`."""
    return int(re.search(rf"(\d+) {what}\b", last_line(process))[1])


def broken_pictures(tools):
    """(what is said of it, message) of each way to break a picture."""
    good = tools.picture(5)
    cut = tools.image(good)
    cut.data = cut.data[:100]
    unknown = tools.image(good)
    unknown.encoding = "bgr9"
    narrow = tools.image(good)
    narrow.step = 3
    endless = tools.image(good)
    endless.height = 2**32 - 1
    empty = tools.image(np.zeros((0, 0, 3), np.uint8))
    return [
        (r"does not convert: 48 rows of 192 bytes need 9216 bytes of data, got 100", cut),
        (r"does not convert: .*unknown encoding 'bgr9'; did you mean 'bgr8'", unknown),
        (r"does not convert: encoding 'bgr8' with width 64 needs step >= 192 bytes, got 3", narrow),
        (r"does not convert: 4294967295 rows of 192 bytes need", endless),
        (r"an empty picture on /kachaka/front_camera/image_raw \(0×0\); is the camera switched on\?", empty),
    ]


def test_malformed_pictures_are_counted_and_said_and_the_next_good_one_is_processed(
    start_node, listen, camera, tools, statistics_of
):
    process = start_node(GRAY)
    numbers, ear = statistics_of(GRAY), listen(f"/{GRAY}/gray")
    frame = tools.picture(5)
    camera.get_answer(ear, tools.image(frame))
    for pattern, message in broken_pictures(tools):

        def said(pattern=pattern):
            return re.search(pattern, (numbers() or {}).get("last_error") or "")

        camera.send_until(said, message, every=0.1)
    answer = camera.get_answer(ear, tools.image(frame))
    assert (tools.pixels(answer) == gray_of(frame)).all()
    process.wait_for(r"\[WARN\].* does not convert: .*\(skipped; 1 of \d+ failed\)")
    assert process.leave() == 0
    assert count("failed", process) >= 5
    assert count("processed", process) + count("failed", process) + count("unheard", process) == count(
        "received", process
    )
    # Once a while, not thirty times a second: the five kinds took far less than a complaint each.
    assert process.said.count("skipped;") < count("failed", process)


def test_size_encoding_and_time_change_in_mid_stream(start_node, listen, camera, tools):
    process = start_node(GRAY)
    ear = listen(f"/{GRAY}/gray")
    frame = tools.picture(6, 48, 64)
    small = tools.picture(7, 31, 17)
    deep = np.full((20, 30), 51 * 257, np.uint16)
    pictures = [
        (tools.image(frame), gray_of(frame), "size and encoding: 64×48 bgr8"),
        (tools.image(small[..., ::-1].copy(), "rgb8"), gray_of(small), "17×31 rgb8 (were 64×48 bgr8)"),
        (tools.image(gray_of(frame), "mono8"), gray_of(frame), None),
        (tools.image(deep, "mono16"), np.full((20, 30), 51, np.uint8), None),
    ]
    for message, expected, said in pictures:
        answer = camera.get_answer(ear, message)
        assert (tools.pixels(answer) == expected).all()
        if said:
            process.wait_for(re.escape(said))
    past = camera.stamp - 10**10
    answer = camera.send_until(lambda: ear.of(past), tools.image(frame), stamp=past)
    assert (tools.pixels(answer) == gray_of(frame)).all()
    process.wait_for(r"stamps went back by 10\.000 s: the camera was restarted, its recording began anew")
    assert process.leave() == 0
    assert count("failed", process) == 0


def test_the_camera_is_killed_and_comes_back(start, start_node, listen, wait_until, statistics_of):
    node = start_node(EDGE)
    numbers, ear = statistics_of(EDGE), listen(f"/{EDGE}/edges")
    camera = start(sys.executable, "-c", PLAY)
    wait_until(lambda: len(ear.messages) >= 3)
    camera.kill()
    node.wait_for(r"\[WARN\].*no frame on \S+ in 3 s: .* it is paused, or was killed")
    seen = len(ear.messages)
    again = start(sys.executable, "-c", PLAY)
    wait_until(lambda: len(ear.messages) >= seen + 3)
    node.wait_for(r"pictures come, after \d+\.\d s without")
    again.leave()
    wait_until(lambda: numbers() is not None)
    assert node.leave() == 0
    assert count("failed", node) == 0


def test_nobody_publishes_at_all(start_node):
    node = start_node(GRAY)
    node.wait_for(r"nobody publishes it, nor any picture \(domain \d+, .*imgproc-course play")
    assert node.leave() == 0
    assert count("received", node) == 0


def test_at_200_hz_every_picture_is_accounted_for_and_the_newest_is_processed(
    start_node, listen, camera, tools, statistics_of
):
    node = start_node(EDGE)
    numbers, ear = statistics_of(EDGE), listen(f"/{EDGE}/edges")
    frame = tools.picture(8, 720, 1280)
    message = tools.image(frame)
    camera.get_answer(ear, message)
    first = camera.sent
    camera.send_until(lambda: camera.sent >= first + 200, message, every=0.005)
    newest = camera.get_answer(ear, message)
    assert (tools.pixels(newest) == cv2.Canny(gray_of(frame), 50, 150)).all()

    def settled():
        found = numbers()
        return found and found["received"] + (found["lost"] or 0) >= first + 200 and found

    found = camera.send_until(settled, message, every=0.1)
    assert found["failed"] == 0
    stamps = ear.stamps()
    assert stamps == sorted(stamps)  # dropped or not, never out of order
    assert node.leave() == 0


def test_two_nodes_of_one_name_both_work_and_both_say_it(start_node, listen, camera, tools):
    first, second = start_node(GRAY), start_node(GRAY)
    for node in (first, second):
        node.wait_for(rf"another node is named /{GRAY} too .* name one otherwise: --ros-args -r __node:=")
    ear = listen(f"/{GRAY}/gray")
    frame = tools.picture(9)

    def heard_twice():
        stamps = ear.stamps()
        return len(stamps) - len(set(stamps)) >= 2

    camera.send_until(heard_twice, tools.image(frame))
    assert all((tools.pixels(message) == gray_of(frame)).all() for message in ear.messages)
    assert (first.leave(), second.leave()) == (0, 0)


SHORT_LEASE = """<?xml version="1.0"?>
<dds xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles"><profiles>
  <participant profile_name="dies_early" is_default_profile="true"><rtps><builtin><discovery_config>
    <leaseDuration><sec>1</sec></leaseDuration>
    <leaseAnnouncement><sec>0</sec><nanosec>300000000</nanosec></leaseAnnouncement>
  </discovery_config></builtin></rtps></participant>
</profiles></dds>"""

LISTENS = """
import sys
from imgproc_course.ros import ImageSubscriber
subscriber = ImageSubscriber(sys.argv[1])
subscriber.wait(60)
print("heard one", flush=True)
for frame in subscriber: pass
"""


def test_a_dead_listener_is_noticed_and_the_others_hear_on(
    start, start_node, listen, camera, tools, tmp_path
):
    # Fast DDS forgets a killed process after the time that it promised to answer in: 20 s, and here 1 s.
    profile = tmp_path / "short_lease.xml"
    profile.write_text(SHORT_LEASE)
    node = start_node(GRAY)
    dying = start(sys.executable, "-c", LISTENS, f"/{GRAY}/gray", FASTRTPS_DEFAULT_PROFILES_FILE=str(profile))
    message = tools.image(tools.picture(10))
    camera.send_until(lambda: "heard one" in dying.said, message)
    ear = listen(f"/{GRAY}/gray")
    camera.get_answer(ear, message)
    node.wait_for(rf"/{GRAY}/gray has 2 listeners")
    dying.kill()
    answer = camera.get_answer(ear, message)
    assert answer.header.frame_id == "camera_front"
    node.wait_for(rf"/{GRAY}/gray has 2 listeners[\s\S]*/{GRAY}/gray has 1 listener\n")
    camera.get_answer(ear, message)
    assert node.leave() == 0


def test_a_profile_that_does_not_exist_is_said_and_pictures_come_nevertheless(
    start_node, listen, camera, tools, tmp_path
):
    node = start_node(GRAY, FASTRTPS_DEFAULT_PROFILES_FILE=str(tmp_path / "lost.xml"))
    node.wait_for(r"\[WARN\].*DDS profile: your own choice .*names a file that does not exist; unset it")
    frame = tools.picture(11)
    answer = camera.get_answer(listen(f"/{GRAY}/gray"), tools.image(frame))
    assert (tools.pixels(answer) == gray_of(frame)).all()
    assert node.leave() == 0


def test_the_profile_of_the_course_is_in_force_in_the_installed_executables(start_node):
    nobody_chose = dict.fromkeys(("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE"))
    node = start_node(GRAY, **nobody_chose)
    node.wait_for(r"DDS profile: the course's fastdds(_small)?\.xml: \d+ MiB shared memory, and UDP")
    assert node.leave() == 0


def test_a_reliable_listener_hears_nothing_and_the_node_says_why(start_node, listen):
    node = start_node(GRAY)
    listen(f"/{GRAY}/gray", qos=10)
    node.wait_for(
        rf"somebody asks for /{GRAY}/gray with a QoS that does not match \(RELIABILITY\), and gets nothing"
    )
    assert node.leave() == 0


def test_while_nobody_listens_nothing_is_processed(start_node, camera, tools, statistics_of):
    node = start_node(EDGE)
    numbers = statistics_of(EDGE)
    found = camera.send_until(
        lambda: (numbers() or {}).get("received", 0) >= 3 and numbers(), tools.image(tools.picture(12))
    )
    assert found["unheard"] == found["received"]
    assert (found["processed"], found["failed"], found["latency_ms"]) == (0, 0, None)
    assert node.leave() == 0


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
def test_leaving_in_mid_stream_is_quiet_and_tells_the_figures(
    start_node, listen, camera, tools, name, signals
):
    node = start_node(name)
    ear = listen(f"/{name}/gray")
    message = tools.image(tools.picture(13, 240, 320))
    camera.send_until(lambda: len(ear.messages) >= 3, message, every=0.01)
    for number in signals:
        node.send(number)
    camera.send_until(lambda: not node.running, message, every=0.005)
    assert node.wait() == 0
    assert not re.search(r"Traceback|terminate called|RCLError|Error", node.said)
    assert re.match(
        rf"{name}: \d+ received, \d+ processed, 0 failed, \d+ unheard, \d+ lost, [\d.]+ Hz, "
        r"latency [\d.]+ ms \(median\), [\d.]+ ms \(99 %\)$",
        last_line(node),
    )
    assert count("processed", node) >= 3
