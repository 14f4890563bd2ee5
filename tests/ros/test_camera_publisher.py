"""The camera: the recording's own pixels, headers and stamps, at any speed, on the robot's topics."""

import itertools
import time
import types

import cv2
import numpy as np
import pytest

pytest.importorskip("rclpy", reason="needs ROS 2")

from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from sensor_msgs.msg import CameraInfo, CompressedImage, Image

from imgproc_course.messages import array_to_compressed, compressed_to_array, image_to_array
from imgproc_course.recording import NotRecordedError, RecordingError, open_recording
from imgproc_course.ros import ImageSubscriber, open_camera
from imgproc_course.ros.camera_publisher import CameraPublisher
from imgproc_course.ros.image_sources import RecordedImages, Webcam
from imgproc_course.ros.robot_topics import camera_topics

pytestmark = pytest.mark.ros

TOPIC = "/kachaka/front_camera/image_raw"
CLOSED = []


class FakeRecording:
    """Four images of one value each, 0.1 s apart except the last gap of 0.3 s; records what is decoded."""

    def __init__(self, stamps=(0.0, 0.1, 0.2, 0.5), frame_id="camera_front"):
        self.stamps = np.array([1_700_000_000_000_000_000 + round(s * 1e9) for s in stamps], np.int64)
        self.rate = (len(stamps) - 1) / stamps[-1] if len(stamps) > 1 else 0.0
        self.frame_id = frame_id
        self.decoded = []
        self.closed = False
        self.depth_topic = None

    def __len__(self):
        return len(self.stamps)

    def frame(self, k, encoding="bgr8"):
        self.decoded.append(k)
        return np.full((2, 3, 3), k, np.uint8)

    def message(self, k):
        msg = array_to_compressed(np.full((2, 3, 3), k, np.uint8), "bgr8", format="png")
        assert isinstance(msg, CompressedImage)
        msg.header.frame_id = self.frame_id
        return msg

    @property
    def camera_info(self):
        info = CameraInfo(height=2, width=3, distortion_model="plumb_bob", d=[0.1, 0.2, 0.3, 0.4, 0.5])
        info.k[0] = 500.0
        return info

    def close(self):
        self.closed = True


@pytest.fixture
def start_camera(session):
    """Starts a publisher of a FakeRecording, or of other images; it stops with the test."""
    started = []

    def start(topic=TOPIC, *, images=None, speed=1.0, loop=True, stamps="now"):
        images = images or RecordedImages(FakeRecording(), speed, loop, stamps)
        started.append(CameraPublisher(topic, images))
        started[-1].start()
        return started[-1]

    yield start
    for camera in started:
        camera.stop()


def open_images(recording, *, camera_topic=None, speed=1.0, stamps="now"):
    return RecordedImages(open_recording(recording, camera_topic=camera_topic), speed, True, stamps)


def stamp_of(msg):
    return msg.header.stamp.sec * 1_000_000_000 + msg.header.stamp.nanosec


def test_the_pixels_are_those_of_the_recording(start_camera, wait_until):
    frames = {}
    start_camera(images=open_images("drive", stamps="recorded", speed=3.0))
    with ImageSubscriber(TOPIC, lambda frame, msg: frames.update({stamp_of(msg): frame})) as subscriber:
        wait_until(lambda: len(frames) >= 5)
    with open_recording("drive") as drive:
        numbers = {int(stamp): k for k, stamp in enumerate(drive.stamps)}
        for stamp, frame in list(frames.items())[:5]:
            assert np.array_equal(frame, drive.frame(numbers[stamp]))
    assert subscriber.failed == 0


def test_another_of_the_recordings_cameras_can_be_played(start_camera):
    with open_recording("drive", camera_topic="/truth/labels") as labels:
        recorded_frames = {labels.frame(k).tobytes() for k in range(len(labels))}
    start_camera(images=open_images("drive", camera_topic="/truth/labels"))
    with ImageSubscriber(TOPIC) as subscriber:
        assert subscriber.wait(60).tobytes() in recorded_frames
    with pytest.raises(NotRecordedError, match="holds no images on /back, but on: "):
        open_images("drive", camera_topic="/back")


def test_all_four_topics_carry_the_robots_encoding_and_one_header(start_camera, collect, wait_until):
    raw = collect(TOPIC, Image)
    compressed = collect(f"{TOPIC}/compressed", CompressedImage)
    infos = [
        collect("/kachaka/front_camera/camera_info", CameraInfo),
        collect(f"{TOPIC}/camera_info", CameraInfo),
    ]
    start_camera(images=open_images("drive", speed=3.0))
    wait_until(lambda: all(len(messages) > 8 for messages in (raw, compressed, *infos)))
    image = raw[-1]
    assert (image.encoding, image.height, image.width, image.step) == ("rgb8", 720, 1280, 3840)
    assert (image.is_bigendian, len(image.data), image.header.frame_id) == (0, 2_764_800, "camera_front")
    stamps = [{stamp_of(msg) for msg in messages} for messages in (raw, compressed, *infos)]
    assert len(set.intersection(*stamps)) >= 5
    assert {msg.header.frame_id for msg in (*compressed, *infos[0], *infos[1])} == {"camera_front"}
    with open_recording("drive") as drive:
        recorded_bytes = {bytes(drive.message(k).data) for k in range(len(drive))}
        recorded = drive.camera_info
    assert {bytes(msg.data) for msg in compressed} <= recorded_bytes
    for msg in (infos[0][-1], infos[1][-1]):
        assert (list(msg.k), list(msg.d)) == (list(recorded.k), list(recorded.d))
        assert (msg.width, msg.height, msg.distortion_model) == (1280, 720, "plumb_bob")


def test_the_depth_of_the_recording_comes_with_its_images(start_camera, collect, wait_until):
    messages = collect("/kachaka/front_camera/depth", Image)
    start_camera(images=open_images("drive", stamps="recorded", speed=3.0))
    wait_until(lambda: len(messages) > 2)
    with open_recording("drive") as drive:
        numbers = {int(stamp): k for k, stamp in enumerate(drive.stamps)}
        for msg in messages[:3]:
            assert (msg.encoding, msg.header.frame_id) == ("16UC1", "camera_front")
            assert np.array_equal(image_to_array(msg), drive.depth(numbers[stamp_of(msg)]))


def test_the_publishers_offer_sensor_data_qos(start_camera, session, wait_until):
    camera = start_camera()
    compressed_topic, info_topics = camera_topics(camera.topic)
    for topic in (camera.topic, compressed_topic, *info_topics):
        wait_until(lambda topic=topic: session.node.count_publishers(topic) == 1)
        (publisher,) = session.node.get_publishers_info_by_topic(topic)
        assert publisher.qos_profile.reliability is ReliabilityPolicy.BEST_EFFORT
        assert publisher.qos_profile.durability is DurabilityPolicy.VOLATILE


def test_stamps_are_now_unless_the_recorded_ones_are_asked_for(start_camera, collect, session, wait_until):
    before = session.node.get_clock().now().nanoseconds
    now = collect("/now", Image)
    start_camera("/now")
    wait_until(lambda: len(now) >= 3)
    stamps = [stamp_of(msg) for msg in now]
    assert before < stamps[0] and stamps == sorted(set(stamps))
    recorded = collect("/recorded", Image)
    start_camera("/recorded", stamps="recorded", speed=4)
    wait_until(lambda: len(recorded) >= 9)
    stamps_by_value = {int(msg.data[0]): stamp_of(msg) for msg in recorded}
    assert stamps_by_value == dict(enumerate(FakeRecording().stamps.tolist()))


def test_without_loop_each_image_comes_once_and_then_the_camera_has_ended(start_camera, collect, wait_until):
    raw = collect(TOPIC, Image)
    camera = start_camera(loop=False, speed=0.25)
    wait_until(lambda: not camera.running, seconds=60)
    wait_until(lambda: raw and raw[-1].data[0] == 3)
    values = [int(msg.data[0]) for msg in raw]
    assert values == [0, 1, 2, 3][-len(values) :] and len(values) >= 3
    assert (camera.running, camera.played, camera.last_error) == (False, 4, None)
    assert (camera.published, camera._images.recording.closed) == (len(values), True)


def test_nothing_is_decoded_without_a_subscriber(start_camera, collect, wait_until):
    camera = start_camera(speed=10)
    recording = camera._images.recording
    wait_until(lambda: camera.played > 6)
    assert (recording.decoded, camera.published) == ([], 0)
    counts = camera.status()["subscribers"]
    assert counts.keys() > {TOPIC, f"{TOPIC}/compressed"} and set(counts.values()) == {0}
    raw = collect(TOPIC, Image)
    wait_until(lambda: raw)
    assert recording.decoded and camera.status()["subscribers"][TOPIC] == 1


def due_times(speed=1.0, loop=True, count=12, clock=lambda: 100.0, **recording):
    from imgproc_course.ros import image_sources as module

    patch = pytest.MonkeyPatch()
    patch.setattr(module, "time", types.SimpleNamespace(monotonic=clock))
    try:
        images = module.RecordedImages(FakeRecording(**recording), speed, loop, "now")
        return [round(float(due), 9) for due, _ in itertools.islice(images, count)]
    finally:
        patch.undo()


def test_images_are_due_as_recorded_counted_from_the_start():
    # 4 images in 0.5 s: the mean period of 1/6 s passes before the recording starts again.
    duration = 0.5 + 1 / 6
    expected = [100 + duration * n + s for n in range(3) for s in (0.0, 0.1, 0.2, 0.5)]
    assert due_times() == pytest.approx(expected)


@pytest.mark.parametrize("speed", [0.5, 2.0, 3.0])
def test_speed_divides_every_time(speed):
    normal = np.array(due_times()) - 100
    assert np.array(due_times(speed)) - 100 == pytest.approx(normal / speed)


def test_after_the_machine_slept_it_continues_from_there():
    clock = iter([100.0, 100.0, 100.1, 900.2, 900.2, 900.3])
    assert due_times(count=4, clock=lambda: next(clock)) == pytest.approx([100.0, 100.1, 900.2, 900.5])


def test_a_single_image_and_stamps_that_jump_back_can_be_played():
    assert due_times(stamps=(0.0,), count=3) == [100.0, 101.0, 102.0]
    assert due_times(stamps=(0.0, 0.3, 0.2, 0.4), count=4) == pytest.approx([100.0, 100.3, 100.3, 100.4])
    # The robot's clock was set while it recorded.
    assert due_times(stamps=(0.0, 0.3, 1.8e9, 1.8e9 + 0.4), count=4) == pytest.approx(
        [100, 100.3, 100.3, 100.7]
    )
    assert due_times(stamps=(1.8e9, 1.8e9 + 0.3, 0.0, 0.4), count=4) == pytest.approx(
        [100, 100.3, 100.3, 100.7]
    )


@pytest.mark.parametrize("encoding", ["16UC1", "32FC1", "8UC3"])
def test_a_recording_of_depth_cannot_be_played_as_a_camera(encoding):
    class Depth(FakeRecording):
        name, camera_topic = "tof", "/tof/image_raw"

        def message(self, k):
            return Image(encoding=encoding)

    with pytest.raises(ValueError) as caught:
        RecordedImages(Depth(), 1.0, True, "now")
    assert str(caught.value) == (
        f"tof cannot be played as a camera: the images on /tof/image_raw are {encoding}, neither colour "
        "nor gray (depth?); record a colour camera's topic too, or read these with "
        "open_recording(...).frame(k, 'passthrough')"
    )


def test_a_recording_of_raw_images_without_camera_info_can_be_played(start_camera, collect, wait_until):
    class RawRecording(FakeRecording):
        @property
        def camera_info(self):
            raise NotRecordedError("no camera info")

        def message(self, k):
            return Image(encoding="rgb8")

    images, infos = collect("/own/compressed", CompressedImage), collect("/camera_info", CameraInfo)
    start_camera("/own", images=RecordedImages(RawRecording(), 1.0, True, "now"))
    wait_until(lambda: images and infos)
    assert compressed_to_array(images[0], "bgr8").shape == (2, 3, 3)
    assert images[0].header.frame_id == "camera_front"
    assert (infos[0].height, infos[0].width, infos[0].k[0]) == (2, 3, 0.0)


def test_it_stops_twice_and_with_the_session(start_camera, session, wait_until):
    camera = start_camera()
    camera.stop()
    camera.stop()
    wait_until(lambda: session.node.count_publishers(TOPIC) == 0)
    camera = start_camera()
    session.stop()
    assert (camera.running, camera.last_error) == (False, None)


def test_a_publisher_of_the_topic_that_stays_is_logged_once(
    start_camera, another_process, wait_until, caplog, monkeypatch
):
    from imgproc_course.ros import camera_publisher as module

    monkeypatch.setattr(module, "CHECK_PERIOD", 0.0)  # a check after each image
    another_process.create_publisher(Image, TOPIC, 1)
    camera = start_camera(speed=10)
    wait_until(lambda: caplog.records)
    played = camera.played
    wait_until(lambda: camera.played > played + 2 * module.CHECKS)
    (record,) = caplog.records
    assert record.message.startswith(f"{TOPIC} is also published by another, which is no camera of ")
    assert played >= module.CHECKS and "ROS_DOMAIN_ID" in record.message


def break_frames(monkeypatch, *broken):
    """Lets these frames of a FakeRecording be damaged."""
    whole = FakeRecording.frame

    def frame(self, k, encoding="bgr8"):
        if k in broken:
            raise RecordingError("the file is damaged here")
        return whole(self, k, encoding)

    monkeypatch.setattr(FakeRecording, "frame", frame)


def test_frames_that_cannot_be_read_are_logged_once_and_the_others_are_played(
    start_camera, collect, wait_until, monkeypatch, caplog
):
    break_frames(monkeypatch, 0, 2)
    raw = collect(TOPIC, Image)
    camera = start_camera(speed=10)
    wait_until(lambda: len(raw) >= 6)
    assert {int(msg.data[0]) for msg in raw} == {1, 3}
    assert {record.message for record in caplog.records} == {
        f"the camera on {TOPIC} goes on after frame {k}: the file is damaged here" for k in (0, 2)
    }
    assert len(caplog.records) == 2 and (camera.running, camera.last_error) == (True, None)


def test_a_recording_of_which_no_frame_can_be_read_stops_with_the_reason(
    start_camera, collect, wait_until, monkeypatch, caplog
):
    break_frames(monkeypatch, 0, 1, 2, 3)
    collect(TOPIC, Image)
    camera = start_camera()
    wait_until(lambda: not camera.running)
    assert camera.last_error == "the file is damaged here"
    assert caplog.records[-1].message == f"the camera on {TOPIC} stopped: {camera.last_error}"


def test_the_first_frame_that_can_be_read_describes_the_camera():
    class Damaged(FakeRecording):
        def message(self, k):
            if k < 2:
                raise RecordingError("the file is damaged here")
            return super().message(k)

    assert RecordedImages(Damaged(frame_id="lens"), 1.0, True, "now").frame_id == "lens"


def test_a_topic_that_a_robot_publishes_is_used_unchanged(session):
    camera = open_camera("topic", topic="/er_kachaka/front_camera/image_raw")
    assert camera.topic == "/er_kachaka/front_camera/image_raw"
    assert camera.compressed_topic == "/er_kachaka/front_camera/image_raw/compressed"
    assert (camera.rate, camera.running, camera.subscribers()) == (None, False, {})
    assert (camera.wait(), camera.played, camera.other_users) == (True, 0, [])
    camera.stop()


class FakeCapture:
    """A cv2.VideoCapture that gives images of one value, and after some none."""

    def __init__(self, number, images=40):
        self.remaining = images

    def isOpened(self):
        return True

    def get(self, property_id):
        return 15.0

    def read(self):
        self.remaining -= 1
        frame = np.empty((2, 3, 3), np.uint8)
        frame[:] = (10, 20, 30)
        time.sleep(0.05)
        return self.remaining >= 0, frame

    def release(self):
        CLOSED.append(self)


def test_a_webcam_is_published_like_the_robots_camera(start_camera, collect, wait_until, monkeypatch, caplog):
    monkeypatch.setattr(cv2, "VideoCapture", FakeCapture)
    raw, compressed = collect(TOPIC, Image), collect(f"{TOPIC}/compressed", CompressedImage)
    infos = collect(f"{TOPIC}/camera_info", CameraInfo)
    CLOSED.clear()
    camera = start_camera(images=Webcam())
    assert camera.status()["rate"] == 15.0
    wait_until(lambda: raw and compressed and infos)
    assert (raw[0].encoding, bytes(raw[0].data), raw[0].header.frame_id) == (
        "rgb8",
        bytes([30, 20, 10]) * 6,
        "webcam",
    )
    assert (compressed[0].format, infos[0].width, infos[0].k[0]) != ("", 0, 1.0)
    wait_until(lambda: not camera.running)
    assert camera.last_error.startswith("the webcam sends no more images; plug one in")
    assert len(CLOSED) == 1


def test_without_a_webcam_only_the_error_appears(capfd):
    with pytest.raises(RuntimeError, match=r"camera 97\).*open_camera\(\) for the recorded drive"):
        Webcam(97)
    assert capfd.readouterr().err == ""  # OpenCV would print lines of its own
