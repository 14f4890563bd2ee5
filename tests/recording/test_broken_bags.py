"""Damaged bags: each raises an error of one line that says what to do, and no other error."""

import re
import shutil
import warnings

import numpy as np
import pytest
from rosbags.rosbag2 import CompressionFormat, CompressionMode

from imgproc_course.messages import ConversionError
from imgproc_course.recording import RecordingError, open_recording, recording

from .conftest import START, TYPES, BagWriter, raw_image, write_gray_mcap, write_raw_bag


def error_of(path, **options):
    with pytest.raises(RecordingError) as caught:
        open_recording(path, **options)
    line = str(caught.value)
    assert "\n" not in line
    assert len(line) < 600
    return line


def test_no_path_and_an_empty_folder(tmp_path):
    assert error_of(tmp_path / "no") == (
        f"there is no recording {tmp_path / 'no'}; give the path of a rosbag2 folder, .mcap or .db3"
    )
    assert "holds no recording: no metadata.yaml, no .mcap, no .db3" in error_of(tmp_path)


TIME = "2026_05_22-09_30_07.mcap"


@pytest.mark.parametrize(
    "names",
    [
        ("a.mcap", "b.mcap"),
        (f"0_run_1_{TIME}", f"1_run_2_{TIME}"),
        (f"0_run_{TIME}", "0_run_2026_05_23-08_00_00.mcap"),
    ],
)
def test_a_folder_of_several_files_without_metadata(tmp_path, names):
    for name in names:
        (tmp_path / name).write_bytes(b"\x89MCAP0\r\n")
    assert error_of(tmp_path) == (
        f"{tmp_path} holds several recordings; give the path of one of them: {', '.join(names)}"
    )


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("a.txt", "is not a rosbag2 recording; give a folder"),
        ("a.bag", "is a ROS 1 bag; convert it: rosbags-convert"),
        ("a.mcap.zstd", "it is cut short or not a bag: copy it again"),
        ("a.mcap", "it is cut short or not a bag: copy it again"),
        ("a.db3", "it is cut short or not a bag: copy it again"),
    ],
)
def test_a_file_that_is_not_a_bag(tmp_path, name, words):
    (tmp_path / name).write_bytes(b"Once upon a time there was a robot. " * 9)
    assert words in error_of(tmp_path / name)
    if "cut short" in words:
        (tmp_path / name).write_bytes(b"")
        assert "is empty; the recording stopped before its first message" in error_of(tmp_path / name)


def test_a_file_in_the_metadata_that_does_not_exist(tmp_path):
    path = write_raw_bag(tmp_path / "mine")
    (path / "mine.mcap").unlink()
    assert error_of(path) == (
        f"{path} lacks mine.mcap, which its metadata.yaml names; copy the whole folder again"
    )


def test_an_unknown_compression_of_chunks(tmp_path):
    path = write_raw_bag(tmp_path / "mine", compression=(CompressionMode.STORAGE, CompressionFormat.ZSTD))
    file = path / "mine.mcap"
    file.write_bytes(file.read_bytes().replace(b"\x04\0\0\0zstd", b"\x04\0\0\0gzip"))
    with open_recording(path) as bag:
        for _ in range(2):  # the second time, the error has the same reason
            with pytest.raises(RecordingError, match="compression that rosbags knows"):
                bag.frame(0)


def test_no_topic_of_images(tmp_path):
    with BagWriter(tmp_path / "mine") as bag:
        bag.write("/chatter", TYPES.types["std_msgs/msg/String"](data="hello"), START)
    assert error_of(tmp_path / "mine") == (
        "mine holds no camera topic, only /chatter (std_msgs/msg/String); record one: ros2 bag record TOPIC"
    )
    untyped = write_gray_mcap(tmp_path / "a.mcap", per_chunk=0)
    untyped.write_bytes(untyped.read_bytes().replace(b"\1\0\1\0\7\0\0\0/my/cam", b"\1\0\0\0\7\0\0\0/my/cam"))
    assert "no camera topic, only /my/cam (type not stated); record" in error_of(untyped)


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_no_message_on_the_camera_topic(tmp_path, storage):
    path = write_raw_bag(tmp_path / "mine", storage, images=0)  # without any topic
    with BagWriter(tmp_path / "silent", storage) as bag:
        bag.topic("/cam", "sensor_msgs/msg/Image")
        bag.write("/chatter", TYPES.types["std_msgs/msg/String"](data="hello"), START)
    assert "holds no camera topic, only nothing" in error_of(path)
    assert error_of(tmp_path / "silent").startswith(
        "silent holds no message on /cam; a reliable recorder receives nothing from a best-effort camera"
    )
    assert "no message on /cam;" in error_of(tmp_path / "silent", camera_topic="/cam")


def test_the_recorded_drive_is_missing(tmp_path, monkeypatch):
    monkeypatch.setattr(recording, "DRIVE", tmp_path / "drive")
    assert error_of("drive").startswith(
        "the course's own recording is missing or damaged; restore it: "
        "git checkout -- imgproc_course/recording/drive (there is no recording"
    )


def test_a_bag_that_may_not_be_read(tmp_path, monkeypatch):
    path = write_raw_bag(tmp_path / "mine")
    monkeypatch.setattr("os.access", lambda *_: False)  # root may read everything
    assert error_of(path) == f"you may not read {path}; change its permissions: chmod -R u+rwX {path}"


def read_everything(path):
    """Opens a recording, and reads what it has; errors of single frames are of one line."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # that it was cut off, and what is skipped
        with open_recording(path) as opened:
            for k in range(min(len(opened), 8)):
                try:
                    opened.frame(k)
                except (ConversionError, RecordingError) as error:
                    assert "\n" not in str(error)
            assert len(opened.stamps) == len(opened)
            assert len(list(opened)) <= len(opened)


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_bag_cut_anywhere_opens_or_raises_an_error_of_one_line(tmp_path, storage):
    path = write_raw_bag(tmp_path / "mine", storage)
    (file,) = [path for path in path.iterdir() if path.suffix in (".mcap", ".db3")]
    data = file.read_bytes()
    refused = 0
    for length in np.linspace(1, len(data) - 1, 60).astype(int):
        file.write_bytes(data[:length])
        for opened in (path, file):
            try:
                read_everything(opened)
            except RecordingError as error:
                refused += 1
                assert re.search(r"[:;] ", str(error))
                assert "\n" not in str(error)
    assert refused >= {"mcap": 40, "sqlite3": 80}[storage]


@pytest.mark.parametrize(
    ("storage", "compression"),
    [("mcap", None), ("sqlite3", None), ("mcap", (CompressionMode.STORAGE, CompressionFormat.ZSTD))],
)
def test_a_bag_with_wrong_bytes_opens_or_says_one_line(tmp_path, storage, compression):
    path = write_raw_bag(tmp_path / "mine", storage, compression=compression)
    (file,) = [path for path in path.iterdir() if path.suffix in (".mcap", ".db3")]
    data = np.frombuffer(file.read_bytes(), np.uint8)
    random, refused = np.random.default_rng(3), 0
    for _ in range(150):
        damaged = data.copy()
        damaged[random.integers(0, len(data), 4)] = random.integers(0, 256, 4)
        file.write_bytes(damaged.tobytes())
        try:
            read_everything(file)
        except RecordingError as error:
            refused += 1
            assert "\n" not in str(error)
    assert refused >= 5


def test_a_bag_that_is_taken_away_while_it_is_open(tmp_path):
    path = write_raw_bag(tmp_path / "mine")
    with open_recording(path) as opened:
        opened.frame(0)
        shutil.rmtree(path)
        assert len(list(opened)) == 6


def test_two_raw_images_of_which_one_is_malformed(tmp_path):
    bad = raw_image(1, START)
    bad.step = 2
    with BagWriter(tmp_path / "mine") as bag:
        bag.write("/cam", raw_image(0, START), START)
        bag.write("/cam", bad, START + 1)
    with open_recording(tmp_path / "mine") as opened:
        assert opened.frame(0, "mono8")[3, 4] == 19
        with pytest.raises(ConversionError, match="step"):
            opened.frame(1, "mono8")


def test_a_definition_of_a_message_that_is_not_ros_s(tmp_path):
    path = write_raw_bag(tmp_path / "mine")
    file = path / "mine.mcap"
    file.write_bytes(file.read_bytes().replace(b"uint8[] data", b"uint8[] date"))
    assert "its definition of sensor_msgs/msg/Image differs from that of ROS" in error_of(file)
