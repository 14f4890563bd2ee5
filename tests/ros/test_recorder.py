"""`record`: every message that arrives is in the recording; Ctrl-C leaves one that can be read."""

import signal
import threading

import pytest

pytest.importorskip("rclpy", reason="needs ROS 2")

from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image

from imgproc_course.recording import RecordingError, open_recording
from imgproc_course.ros import record, recorder
from imgproc_course.ros.robot_process import running_robot

pytestmark = pytest.mark.ros

TOPIC = "/kachaka/front_camera/image_raw"
RECORD = (
    "import sys\nfrom imgproc_course.ros.recorder import record_until_signal\n"
    "sys.exit(record_until_signal({}, {!r}, status_seconds=0.2))"
)


@pytest.fixture
def publish(session):
    """publish(topic, k): an Image whose only byte is k, with the stamp k; the publisher appears at once."""
    publishers = {}

    def send(topic, k=None):
        if topic not in publishers:
            publishers[topic] = session.start().node.create_publisher(Image, topic, qos_profile_sensor_data)
        if k is not None:
            msg = Image(height=1, width=1, step=1, encoding="mono8", data=bytes([k]))
            msg.header.stamp.sec = k + 1
            publishers[topic].publish(msg)

    return send


def test_what_arrives_is_recorded_in_order(publish, session, tmp_path, wait_until):
    for topic in ("/a/image_raw", "/b/image_raw", "/never"):
        publish(topic)
    with record(["/a/image_raw", "b/image_raw", "/never"], tmp_path / "own") as recorder:
        wait_until(lambda: session.node.count_subscribers("/b/image_raw"))
        for k in range(20):
            publish("/a/image_raw", k)
            publish("/b/image_raw", 100 + k)
            wait_until(lambda k=k: recorder.counts["/b/image_raw"] == k + 1)
    assert recorder.counts == {"/a/image_raw": 20, "/b/image_raw": 20, "/never": 0}
    assert (recorder.lost, recorder.last_error, recorder.running) == (0, None, False)
    with open_recording(tmp_path / "own", camera_topic="/b/image_raw") as recording:
        assert [int(recording.frame(k, "mono8")[0, 0]) for k in range(20)] == list(range(100, 120))
        assert recording.topics == dict.fromkeys(["/a/image_raw", "/b/image_raw"], "sensor_msgs/msg/Image")
    recorder.stop()


def test_all_topics_of_a_running_robot_are_recorded_from_the_beginning(
    publish, session, tmp_path, monkeypatch, drive_of_another_program
):
    monkeypatch.setattr(recorder, "SETTLING", 0.0)  # as on a busy machine, where the topics appear slowly
    with drive_of_another_program(1.0):
        domain = session.context.get_domain_id()
        session.stop()  # as after a restart: nothing is known of the robot
        publish("/kachaka/odometry/odometry")  # known at once
        with record(path=tmp_path / "own") as recording:
            counts = running_robot(domain)["subscribers"]
            expected = counts.keys() & set(recorder.ROBOT_TOPICS)
            assert len(expected) >= 3 and expected <= recording.topics.keys()
            assert [topic for topic in expected if counts[topic] == 0] == []


def test_it_begins_when_the_robot_has_found_its_subscriptions(
    session, tmp_path, monkeypatch, drive_of_another_program, robot_processes
):
    with drive_of_another_program(1.0):
        (robot,), has_gone_on = robot_processes(), threading.Event()

        def go_on():
            has_gone_on.set()
            robot.resume()

        def subscribe(self, topic, subscribe=recorder.Recorder._subscribe):
            robot.suspend()  # as on a busy machine: it finds nothing for a moment
            threading.Timer(0.5, go_on).start()
            return subscribe(self, topic)

        monkeypatch.setattr(recorder.Recorder, "_subscribe", subscribe)
        with record("/kachaka/front_camera/image_raw/compressed", tmp_path / "own"):
            assert has_gone_on.is_set()


@pytest.mark.parametrize("topics", [None, []])
def test_without_a_choice_the_topics_of_the_robot_are_recorded(publish, tmp_path, monkeypatch, topics):
    monkeypatch.setattr(recorder, "DISCOVERY_TIMEOUT", 2.0)
    publish("/kachaka/odometry/odometry")
    publish("/cam/image_raw")
    with record(topics, tmp_path / "own") as recording:
        assert recording.topics == {"/kachaka/odometry/odometry": "sensor_msgs/msg/Image"}


def test_a_recording_that_cannot_begin_leaves_nothing(publish, tmp_path, monkeypatch):
    monkeypatch.setattr(recorder, "DISCOVERY_TIMEOUT", 0.2)
    publish("/cam/image_raw")
    with pytest.raises(ValueError, match=r"nobody publishes /cam/image_ray; did you mean /cam/image_raw\?"):
        record("/cam/image_ray", tmp_path / "own")
    assert not (tmp_path / "own").exists()
    with pytest.raises(
        ValueError, match=r"nobody publishes /kachaka/.*; open_camera\(\"room\"\) starts a robot"
    ):
        record(path=tmp_path / "own")
    (tmp_path / "own").mkdir()
    with pytest.raises(RecordingError, match="exists already"):
        record("/cam/image_raw", tmp_path / "own")


def test_a_full_disk_stops_the_recording_with_a_warning(
    publish, session, tmp_path, monkeypatch, wait_until, caplog
):
    publish("/a")
    recorder = record("/a", tmp_path / "own")

    def full(*_):
        raise RecordingError("own cannot be written: No space left on device")

    wait_until(lambda: session.node.count_subscribers("/a"))
    monkeypatch.setattr(recorder._writer, "write", full)
    publish("/a", 1)
    wait_until(lambda: not recorder.running)
    wait_until(lambda: caplog.records)
    assert (
        caplog.records[0].message == "the recording stopped: own cannot be written: No space left on device"
    )
    assert recorder.last_error == "own cannot be written: No space left on device"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_completes_the_recording(publish, start_python, tmp_path, wait_until, number):
    publish("/cam/image_raw")
    process = start_python(RECORD.format("['/cam/image_raw']", str(tmp_path / "own")))
    assert process.stdout.readline() == f"recording 1 topics into {tmp_path / 'own'} (Ctrl-C stops)\n"
    k = 0
    while " 0 messages" in (line := process.stdout.readline()):
        publish("/cam/image_raw", k)
        k += 1
    assert " messages, 0.0 MB, 0 lost" in line
    process.send_signal(number)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, err) == (0, "")
    assert out.splitlines()[-1].endswith(f"open_recording('{tmp_path / 'own'}') reads it")
    with open_recording(tmp_path / "own") as recording:
        assert recording.frame(0, "mono8")[0, 0] == recording.stamps[0] // 10**9 - 1


def test_a_recording_without_messages_is_reported(publish, start_python, tmp_path):
    publish("/cam/image_raw")
    process = start_python(RECORD.format("['/cam/image_raw']", str(tmp_path / "own")))
    process.stdout.readline()
    process.stdout.readline()
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    assert process.returncode == 1 and not (tmp_path / "own").exists()
    assert out.splitlines()[-1] == "nothing was recorded: no message arrived"
