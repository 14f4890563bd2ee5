"""The recorded drive: every number that a lesson may state about it."""

import hashlib
import subprocess
import sys
import threading
from collections import Counter

import cv2
import numpy as np
import pytest

from imgproc_course.messages.message_classes import installed_class
from imgproc_course.recording import FrameIndexError, RecordingError, open_recording

CAMERA = "/kachaka/front_camera/image_raw/compressed"
POSES = ["camera", "person", "ball", "toycar", "marker"]
START = 1_767_600_000 * 10**9


def digest(data):
    return hashlib.sha256(data).hexdigest()[:16]


def test_every_topic_has_its_type_and_its_count(drive):
    image, pose = "sensor_msgs/msg/CompressedImage", "geometry_msgs/msg/PoseStamped"
    assert drive.topics == {
        CAMERA: image,
        "/kachaka/front_camera/camera_info": "sensor_msgs/msg/CameraInfo",
        "/truth/depth": image,
        "/truth/labels": image,
        "/truth/scene": "std_msgs/msg/String",
        **{f"/truth/pose/{name}": pose for name in POSES},
    }
    counts = Counter(topic for topic, _ in drive)
    assert counts == {**dict.fromkeys(drive.topics, 90), "/truth/scene": 1}
    assert len(drive) == 90
    assert drive.camera_topic == CAMERA


def test_the_stamps_are_ten_per_second(drive):
    assert drive.stamps.dtype == np.int64
    assert drive.stamps.tolist() == [START + k * 10**8 for k in range(90)]
    assert drive.rate == pytest.approx(10.0, abs=1e-12)


@pytest.mark.parametrize(
    ("k", "size", "jpeg"),
    [(0, 159329, "a7bbcde3737e6f49"), (45, 179165, "eef1bf3b4f4e85af"), (89, 179989, "725cf85255590950")],
)
def test_a_message_holds_the_rendered_jpeg(drive, k, size, jpeg):
    message = drive.message(k)
    assert message.format == "jpeg"
    assert message.header.frame_id == "camera_front"
    data = np.frombuffer(message.data, np.uint8)
    assert (data.size, digest(data)) == (size, jpeg)
    np.testing.assert_array_equal(drive.frame(k), cv2.imdecode(data, cv2.IMREAD_COLOR))


def test_a_frame_has_the_requested_encoding(drive):
    bgr = drive.frame(45)
    assert (bgr.shape, bgr.dtype) == ((720, 1280, 3), np.uint8)
    assert (
        np.abs(bgr[360, 640].astype(int) - [143, 156, 170]).max() <= 2
    )  # JPEG decoders differ by a level or two
    np.testing.assert_array_equal(drive.frame(45, "rgb8"), bgr[..., ::-1])
    np.testing.assert_array_equal(drive.frame(45, "mono8"), cv2.cvtColor(bgr, cv2.COLOR_BGR2GRAY))


def test_numbers_count_from_the_end_too(drive):
    np.testing.assert_array_equal(drive.frame(np.int64(-90)), drive.frame(0))


def test_camera_info_is_the_true_lens(drive):
    info = drive.camera_info
    assert (info.header.frame_id, info.width, info.height) == ("camera_front", 1280, 720)
    assert info.distortion_model == "plumb_bob"
    assert list(info.d) == [-0.17, 0.035, 0.0004, -0.0003, 0.0]
    assert list(info.k) == [705.0, 0, 639.5, 0, 705.0, 359.5, 0, 0, 1]
    assert list(info.r) == [1, 0, 0, 0, 1, 0, 0, 0, 1]
    assert list(info.p) == [705.0, 0, 639.5, 0, 0, 705.0, 359.5, 0, 0, 0, 1, 0]


@pytest.mark.parametrize(
    ("k", "millimetres", "whole"),
    [
        (0, [1813, 5398, 533, 322], "030c00e35679a560"),
        (45, [2883, 4586, 505, 323], "cb79257c8082111c"),
        (89, [1997, 350, 501, 321], "51da41e2662d0b4a"),
    ],
)
def test_depth_is_in_millimetres(drive, k, millimetres, whole):
    depth = drive.depth(k)
    assert (depth.shape, depth.dtype) == ((360, 640), np.uint16)
    assert [int(depth[at]) for at in ((0, 0), (180, 320), (300, 100), (359, 639))] == millimetres
    assert digest(depth.tobytes()) == whole


@pytest.mark.parametrize(
    ("k", "counts", "whole"),
    [
        (0, {"floor": 391050, "ball": 2890, "marker": 3449, "person": 6760}, "83c946e06ba3c62a"),
        (45, {"floor": 234623, "ball": 8144, "marker": 5936, "person": 14550}, "f4b75590fd1d339f"),
        (89, {"floor": 163888, "ball": 111941, "marker": 16341, "person": 17506}, "9bf884e80b9e635d"),
    ],
)
def test_labels_are_the_classes_of_the_pixels(drive, k, counts, whole):
    labels = drive.labels(k)
    assert (labels.shape, labels.dtype) == ((720, 1280), np.uint8)
    number = {name: number for number, name in drive.label_names.items()}
    assert {name: int((labels == number[name]).sum()) for name in counts} == counts
    assert digest(labels.tobytes()) == whole


def test_the_scene_has_label_names_and_marker(drive):
    assert len(drive.label_names) == 20
    assert (drive.label_names[0], drive.label_names[16], drive.label_names[19]) == (
        "background",
        "person",
        "clutter",
    )
    assert drive.scene["marker"] == {"dictionary": "DICT_4X4_50", "id": 7, "side": 0.25}
    assert "rendered" in drive.scene["made_by"]


@pytest.mark.parametrize(
    ("name", "k", "expected"),
    [
        ("camera", 45, [1.215000033378601, 0.05510295554995537, 0.20006459951400757]),
        ("ball", 45, [2.7365245819091797, 0.14327868819236755, 0.12200000137090683]),
        ("marker", 45, [4.338639736175537, -0.6213698387145996, 0.2255185842514038]),
    ],
)
def test_poses_are_the_rendered_ones(drive, name, k, expected):
    pose = drive.pose(name, k)
    assert (pose.shape, pose.dtype) == ((7,), np.float64)
    assert pose[:3].tolist() == expected
    assert np.linalg.norm(pose[3:]) == pytest.approx(1, abs=1e-6)


def test_messages_are_of_the_classes_that_publishers_accept(drive):
    for topic, message in _first_messages(drive):
        package, _, kind = drive.topics[topic].split("/")
        wanted = installed_class(drive.topics[topic])
        assert type(message).__name__.endswith(kind)
        if wanted is not None:
            assert type(message) is wanted
            assert type(message).__module__.startswith(f"{package}.msg")


@pytest.mark.parametrize("k", [90, -91, 10**30])
def test_the_error_for_a_number_out_of_range_names_the_range(drive, k):
    for read in (drive.frame, drive.message, drive.depth, drive.labels):
        with pytest.raises(
            FrameIndexError, match=r"^drive has frames 0 to 89, got -?\d+; choose one of these$"
        ):
            read(k)
    with pytest.raises(IndexError, match="0 to 89"):
        drive.pose("ball", k)


@pytest.mark.parametrize("k", [1.0, "3", None])
def test_a_number_that_is_not_an_int_is_refused(drive, k):
    with pytest.raises(FrameIndexError, match="the number of a frame must be an int"):
        drive.frame(k)


def test_the_error_for_an_unknown_pose_names_the_poses(drive):
    with pytest.raises(KeyError) as caught:
        drive.pose("cat", 0)
    assert str(caught.value) == "drive holds no pose of 'cat'; it holds camera, person, ball, toycar, marker"


def test_a_closed_recording_raises_an_error():
    recording = open_recording()
    recording.frame(0)
    recording.close()
    recording.close()
    for read in (lambda: recording.frame(0), lambda: next(iter(recording)), lambda: recording.stamps):
        with pytest.raises(RecordingError, match="is closed; open it again"):
            read()


def test_many_threads_read_the_right_messages(drive):
    expected = [digest(drive.message(k).data) for k in range(90)]
    with open_recording() as shared:
        found, wrong = threading.Semaphore(0), []

        def read(seed):
            for k in np.random.default_rng(seed).permutation(90):
                if digest(shared.message(int(k)).data) != expected[k]:
                    wrong.append(k)
            found.release()

        threads = [threading.Thread(target=read, args=(seed,)) for seed in range(4)]
        for thread in threads:
            thread.start()
        assert sum(1 for _ in shared) == 811
        for thread in threads:
            thread.join()
        assert wrong == []
        assert all(found.acquire(blocking=False) for _ in threads)


def _first_messages(recording):
    first_messages = {}
    for topic, message in recording:
        first_messages.setdefault(topic, message)
        if len(first_messages) == len(recording.topics):
            return list(first_messages.items())
    raise AssertionError(f"the recording has only {list(first_messages)}")


def test_without_apsw_the_package_can_be_imported_and_opening_says_what_is_missing():
    lines = (
        "import sys; sys.modules['apsw'] = None",
        "from imgproc_course.recording import RecordingError, open_recording",
        "try: open_recording('drive')",
        "except RecordingError as error: print(error)",
    )
    process = subprocess.run([sys.executable, "-c", "\n".join(lines)], capture_output=True, text=True)
    assert process.stdout.startswith("recordings cannot be read: apsw is missing;"), process.stderr
