"""A recording that the writer made is read back, byte for byte; it never replaces anything."""

import numpy as np
import pytest

from imgproc_course.messages import ConversionError
from imgproc_course.recording import NotRecordedError, RecordingError, RecordingWriter, open_recording

from .conftest import START, TYPES, gray_pixels, header, raw_image

IMAGE = "sensor_msgs/msg/Image"


def depth_image(k, stamp):
    return TYPES.types[IMAGE](
        header=header(stamp),
        height=2,
        width=3,
        encoding="16UC1",
        is_bigendian=0,
        step=6,
        data=np.arange(k, k + 6, dtype="<u2").view(np.uint8),
    )


def pose(k, stamp):
    types = TYPES.types
    point = types["geometry_msgs/msg/Point"](x=float(k), y=0.0, z=0.0)
    rotation = types["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=0.0, w=1.0)
    return types["geometry_msgs/msg/PoseStamped"](
        header=header(stamp, "world"),
        pose=types["geometry_msgs/msg/Pose"](position=point, orientation=rotation),
    )


def write(writer, topic, message, time):
    writer.write(topic, message.__msgtype__, bytes(TYPES.serialize_cdr(message, message.__msgtype__)), time)


def test_what_was_written_is_read_back(tmp_path):
    with RecordingWriter(tmp_path / "own") as writer:
        for k in range(5):
            stamp = START + k * 10**8
            write(writer, "/cam/image_raw", raw_image(k, stamp), stamp + 1000)
            if k != 2:  # lost on the way
                write(writer, "/cam/depth", depth_image(k, stamp), stamp + 2000)
            if k > 0:  # the poses were subscribed to later
                write(writer, "/truth/pose/robot", pose(k, stamp), stamp + 3000)
    assert writer.messages == 13 and writer.bytes > 13 * 20
    assert sorted(path.name for path in (tmp_path / "own").iterdir()) == ["metadata.yaml", "own.mcap"]
    for path in (tmp_path / "own", tmp_path / "own" / "own.mcap"):
        with open_recording(path) as recording:
            assert len(recording) == 5
            assert recording.stamps.tolist() == [START + k * 10**8 for k in range(5)]
            for k in range(5):
                assert (recording.frame(k, "mono8") == gray_pixels(k)).all()
            for k in (0, 1, 3, 4, -1):
                assert recording.depth(k).ravel().tolist() == list(range(k % 5, k % 5 + 6))
            with pytest.raises(NotRecordedError, match="holds no message on /cam/depth at frame 2"):
                recording.depth(2)
            assert [recording.pose("robot", k)[0] for k in (1, 2, 3, 4)] == [1, 2, 3, 4]
            with pytest.raises(NotRecordedError, match="at frame 0"):
                recording.pose("robot", 0)


def test_nothing_is_overwritten(tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("keep me")
    with pytest.raises(RecordingError, match="mine exists already and is not overwritten; choose another na"):
        RecordingWriter(tmp_path / "mine")
    assert (tmp_path / "mine" / "notes.txt").read_text() == "keep me"
    with pytest.raises(
        RecordingError, match=r"drive.mcap is the name of a file, but a recording is a folder"
    ):
        RecordingWriter(tmp_path / "drive.mcap")
    (tmp_path / "file").write_text("")
    with pytest.raises(RecordingError, match="cannot be written: Not a directory"):
        RecordingWriter(tmp_path / "file" / "own")


def test_an_empty_recording_leaves_no_folder_and_a_closed_one_takes_no_message(tmp_path):
    writer = RecordingWriter(tmp_path / "empty")
    writer.close()
    writer.close()
    assert not (tmp_path / "empty").exists()
    with pytest.raises(RecordingError, match="is closed"):
        writer.write("/a", IMAGE, b"", START)


def test_what_is_no_type_of_ros_and_no_image(tmp_path):
    with RecordingWriter(tmp_path / "own") as writer:
        with pytest.raises(RecordingError, match="/a cannot be recorded: mine/msg/Own is no message type of"):
            writer.write("/a", "mine/msg/Own", b"", START)
        with pytest.raises(ConversionError):
            writer.write_image("/robot/image_raw/compressed", np.zeros((4, 4, 7), np.uint8), 0)


def test_images_are_written_without_ros(tmp_path):
    images = [np.full((48, 64, 3), value, np.uint8) for value in (20, 200)] + [
        np.full((48, 64), 90, np.uint8)
    ]
    with RecordingWriter(tmp_path / "own") as writer:
        for k, image in enumerate(images):
            writer.write_image("/robot/image_raw/compressed", image, 5 * 10**9 + k * 10**8)
    with open_recording(tmp_path / "own") as recording:
        assert len(recording) == 3
        stamps = [recording.message(k).header.stamp for k in range(3)]
        assert [(stamp.sec, stamp.nanosec) for stamp in stamps] == [(5, 0), (5, 10**8), (5, 2 * 10**8)]
        for k, image in enumerate(images):
            gray = image if image.ndim == 2 else image[..., 0]
            assert np.abs(recording.frame(k, "mono8").astype(int) - gray).max() <= 2
