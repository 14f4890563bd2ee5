"""A learner's own bags: both storages, folder or file, raw or compressed images, any topic name."""

import gc
import shutil
import sqlite3
import struct
import sys
import warnings

import cv2
import numpy as np
import pytest
from backports import zstd
from rosbags.rosbag2 import CompressionFormat, CompressionMode

from imgproc_course.messages.message_classes import installed_class
from imgproc_course.recording import NotRecordedError, RecordingError, open_recording

from .conftest import (
    START,
    TYPES,
    BagWriter,
    compressed,
    gray_pixels,
    header,
    image_channel,
    raw_image,
    write_gray_mcap,
    write_mcap,
    write_raw_bag,
)


@pytest.fixture(params=["mcap", "sqlite3"])
def storage(request):
    return request.param


@pytest.fixture
def raw_bag(tmp_path, storage):
    return write_raw_bag(tmp_path / "mine", storage)


def bag_file(folder):
    (file,) = [path for path in folder.iterdir() if path.suffix in (".mcap", ".db3")]
    return file


def assert_holds_the_raw_images(recording):
    assert len(recording) == 6
    assert recording.camera_topic == "/my/cam"
    assert recording.topics == {"/my/cam": "sensor_msgs/msg/Image"}
    for k in (5, 0, 3):
        np.testing.assert_array_equal(recording.frame(k, "mono8"), gray_pixels(k))
        np.testing.assert_array_equal(recording.frame(k), np.repeat(gray_pixels(k)[..., None], 3, axis=2))
    assert recording.stamps.tolist() == [START + k * 10**8 for k in range(6)]
    assert recording.rate == pytest.approx(10)


def test_a_folder_its_metadata_a_file_alone_and_a_path_in_the_home_folder(raw_bag, tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(raw_bag.parent))
    monkeypatch.setenv("USERPROFILE", str(raw_bag.parent))
    alone = shutil.copy(bag_file(raw_bag), tmp_path / bag_file(raw_bag).name)
    for path in (raw_bag, raw_bag / "metadata.yaml", alone, "~/mine"):
        with open_recording(path) as recording:
            assert_holds_the_raw_images(recording)


@pytest.mark.parametrize("mode", CompressionMode)
def test_a_compressed_bag(tmp_path, storage, mode):
    mode = mode if storage == "mcap" else min(mode, CompressionMode.MESSAGE)
    path = write_raw_bag(tmp_path / "mine", storage, compression=(mode, CompressionFormat.ZSTD))
    with open_recording(path) as recording:
        assert_holds_the_raw_images(recording)


QOS = "- history: 1\\n  depth: 5\\n  reliability: 2\\n  durability: 2\\n  deadline: {sec: 0, nsec: 0}"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("offered_qos_profiles: ''", f'offered_qos_profiles: "{QOS}"'),
        ("message_count: 6", "message_count: 0"),
        ("version: 8", "version: 99"),
        ("storage_identifier: ", "storage_identifier: my_"),
        ("serialization_format: cdr", "serialization_format: other"),
        ("relative_file_paths:\n  - mine", "relative_file_paths:\n  - other"),
        ("topics_with_message_count:", "topics: ["),
        ("rosbag2_bagfile_information:\n", "3: 4\n"),
    ],
)
def test_metadata_that_differ_from_the_file_cost_nothing(raw_bag, old, new):
    text = (raw_bag / "metadata.yaml").read_text()
    assert old in text
    (raw_bag / "metadata.yaml").write_text(text.replace(old, new))
    with open_recording(raw_bag) as recording:
        assert_holds_the_raw_images(recording)
        assert len(list(recording)) == 6


def write_split_bag(folder, storage, packed=False, name="mine_{k}", parts=tuple((k,) for k in range(12))):
    """Twelve images in several files, as rosbag2 numbers them."""
    folder.mkdir()
    for k, images in enumerate(parts):
        with BagWriter(folder / "part", storage) as bag:
            for image in images:
                bag.write("/cam", raw_image(image, START + image), START + image)
        file = bag_file(folder / "part")
        data = zstd.compress(file.read_bytes()) if packed else file.read_bytes()
        (folder / f"{name.format(k=k)}{file.suffix}{'.zstd' * packed}").write_bytes(data)
        shutil.rmtree(folder / "part")
    return folder


@pytest.mark.parametrize("packed", [False, True])
@pytest.mark.parametrize("name", ["mine_{k}", "{k}_mine_2026_05_22-09_{k:02}_07"])
def test_a_split_bag_without_metadata_is_read_in_the_order_of_its_numbers(tmp_path, storage, packed, name):
    folder = write_split_bag(tmp_path / "mine", storage, packed, name)
    with open_recording(folder) as recording:
        assert recording.stamps.tolist() == [START + k for k in range(12)]
        assert [topic for topic, _ in recording] == ["/cam"] * 12
        for k in (11, 2, 10):
            np.testing.assert_array_equal(recording.frame(k, "mono8"), gray_pixels(k))


@pytest.mark.parametrize("parts", [range(9, -3, -3), [[2, 3, 5, 6, 7, 11], [0, 4, 8, 10], [1, 9]]])
def test_a_split_bag_whose_files_are_out_of_order_or_overlap_is_read_in_the_order_of_time(
    tmp_path, storage, parts
):
    parts = [range(part, part + 3) if isinstance(part, int) else part for part in parts]
    with open_recording(write_split_bag(tmp_path / "mine", storage, parts=parts)) as recording:
        assert recording.stamps.tolist() == [START + k for k in range(12)]
        assert recording.rate == pytest.approx(1e9)
        for k in (11, 2, 10):
            np.testing.assert_array_equal(recording.frame(k, "mono8"), gray_pixels(k))
        assert [msg.data[0] for _, msg in recording] == [40 * k % 256 for k in range(12)]


def test_files_that_are_missing_or_empty_do_not_cost_the_others(tmp_path, storage):
    folder = write_split_bag(tmp_path / "mine", storage)
    suffix = {"mcap": ".mcap", "sqlite3": ".db3"}[storage]
    names = [f"mine_{k}{suffix}" for k in range(12)]
    lines = ["rosbag2_bagfile_information:", "  message_count: 12", "  relative_file_paths:"]
    (folder / "metadata.yaml").write_text("\n".join([*lines, *(f"  - {name}" for name in names)]))
    (folder / names[3]).unlink()
    (folder / names[5]).write_bytes(b"")
    with pytest.warns(UserWarning, match="2 of 12 messages are missing") as caught:
        recording = open_recording(folder)
    assert f"{names[3]} is missing" in str(caught[0].message)
    assert f"{names[5]} cannot be read" in str(caught[0].message)
    assert recording.stamps.tolist() == [START + k for k in range(12) if k not in (3, 5)]
    recording.close()


@pytest.mark.parametrize("name", ["A#B", "a?b=c", "100% of it", "Übung 1", "mode=ro&x"])
def test_any_name_of_a_folder_and_a_file(raw_bag, name):
    (raw_bag / "metadata.yaml").unlink()
    file = bag_file(raw_bag)
    (raw_bag / f"._{name}{file.suffix}").write_bytes(b"\0\5\x16\7")  # macOS writes it beside
    file.rename(raw_bag / f"{name}{file.suffix.upper() if name.isupper() else file.suffix}")
    with open_recording(raw_bag.rename(raw_bag.with_name(name))) as recording:
        assert_holds_the_raw_images(recording)


def test_a_recorder_that_was_killed_leaves_images_in_its_log(tmp_path):
    """SQLite keeps what was written last in a second file, and moves it when the recorder ends."""
    file = bag_file(write_raw_bag(tmp_path / "mine", "sqlite3"))
    database = sqlite3.connect(file)
    database.execute("PRAGMA journal_mode = wal")
    (tmp_path / "killed").mkdir()
    with database:
        for k in range(6, 10):
            data = TYPES.serialize_cdr(raw_image(k, START + k * 10**8), "sensor_msgs/msg/Image")
            database.execute("INSERT INTO messages VALUES (NULL, 1, ?, ?)", (START + k * 10**8, bytes(data)))
    for path in (file, file.with_name(f"{file.name}-wal")):
        shutil.copy(path, tmp_path / "killed")
    database.close()
    before = {path.name: path.read_bytes() for path in (tmp_path / "killed").iterdir()}
    with open_recording(tmp_path / "killed") as recording:
        assert recording.stamps.tolist() == [START + k * 10**8 for k in range(10)]
        np.testing.assert_array_equal(recording.frame(9, "mono8"), gray_pixels(9))
    assert {path.name: path.read_bytes() for path in (tmp_path / "killed").iterdir()} == before


UNION = "module a { module msg { union U switch(long) { case 1: long x; }; }; };"
FOREIGN = {
    "protobuf": ("/other", "foxglove.Log", "protobuf", "protobuf", bytes(range(256))),
    "json": ("/other", "Log", "json", "jsonschema", "{}"),
    "ros1": ("/other", "sensor_msgs/Image", "ros1", "ros1msg", "uint8 x"),
    "service event": ("/other", "a/srv/B_Event", "cdr", "ros2msg", "int64 a\n---\nint64 b"),
    "idl union": ("/other", "a/msg/U", "cdr", "ros2idl", UNION),
    "no definition": ("/other", "a/msg/Own", "cdr", "", ""),
    "unknown language": ("/other", "a/msg/Own", "cdr", "x", "x"),
    "unreadable": ("/other", "std_msgs/msg/String", "cdr", "ros2msg", "string data"),
}


def warnings_of_iterating(recording):
    """(the number of messages, the warnings) of iterating twice: each topic is named once."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        count = len(list(recording))
        assert len(list(recording)) == count
    return count, [str(warning.message) for warning in caught]


@pytest.mark.parametrize("kind", FOREIGN)
def test_a_foreign_channel_costs_nothing_and_is_named_once(tmp_path, kind):
    with open_recording(write_gray_mcap(tmp_path / "a.mcap", [FOREIGN[kind]])) as recording:
        assert [int(recording.frame(k, "mono8")[0, 0]) for k in range(6)] == [40 * k % 256 for k in range(6)]
        count, texts = warnings_of_iterating(recording)
    assert count == 6
    assert len(texts) == 1 and texts[0].startswith("skipped: /other of a.mcap cannot be read: ")


@pytest.mark.parametrize("kind", ["a/msg/Own", "a/srv/B_Event"])
@pytest.mark.parametrize("distribution", ["Humble", "Jazzy"])
def test_a_type_that_a_db3_does_not_define_costs_nothing_and_is_named_once(tmp_path, kind, distribution):
    folder = write_raw_bag(tmp_path / "mine", "sqlite3")
    with sqlite3.connect(bag_file(folder)) as database:
        if distribution == "Humble":  # it stored no definitions
            database.execute("DROP TABLE message_definitions")
        columns = "id, name, type, serialization_format, offered_qos_profiles, type_description_hash"
        database.execute(f"INSERT INTO topics ({columns}) VALUES (7, '/other', '{kind}', 'cdr', '', '')")
        database.execute("INSERT INTO messages VALUES (NULL, 7, ?, x'00010000')", (START,))
    database.close()
    with open_recording(folder) as recording:
        assert len(recording) == 6
        count, texts = warnings_of_iterating(recording)
    assert count == 6
    assert len(texts) == 1 and texts[0].startswith("skipped: /other of mine cannot be read: its type")


FIELDS = "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\n"


@pytest.mark.parametrize("kind", ["sensor_msgs/msg/Image", "sensor_msgs/Image"])
@pytest.mark.parametrize("text", ["", "bool[", FIELDS + "uint32 step\nuint8[] data"])
def test_a_definition_that_is_missing_wrong_or_incomplete_costs_nothing(tmp_path, kind, text):
    messages = [(("/log", "std_msgs/msg/Header", "cdr", "ros2msg", "string data"), START, header(START))]
    messages += [(("/cam", kind, "cdr", "ros2msg", text), START + k, raw_image(k, START)) for k in range(3)]
    with open_recording(write_mcap(tmp_path / "a.mcap", messages)) as recording:
        assert [int(recording.frame(k, "mono8")[0, 0]) for k in range(3)] == [0, 40, 80]
        assert [topic for topic, _ in recording] == ["/log", "/cam", "/cam", "/cam"]


def test_a_definition_with_line_ends_of_windows_is_read(tmp_path):
    part = "=" * 80 + "\r\nMSG: a/Point\r\nfloat64 x\r\n"
    own = ("/own", "a/msg/Own", "cdr", "ros2msg", f"a/Point at\r\nint32 k\r\n{part}")
    raw = b"\0\1\0\0" + struct.pack("<di", 2.5, 7)
    messages = [(image_channel(), START, raw_image(0, START)), (own, START + 1, raw)]
    with open_recording(write_mcap(tmp_path / "a.mcap", messages)) as recording:
        message = dict(recording)["/own"]
    assert (message.at.x, message.k) == (2.5, 7)


def write_images_and(tmp_path, tail):
    """Two images, each followed by other bytes."""
    images = [bytes(TYPES.serialize_cdr(raw_image(k, START), "sensor_msgs/msg/Image")) for k in range(2)]
    messages = [(image_channel(), START + k, image + tail) for k, image in enumerate(images)]
    return write_mcap(tmp_path / "a.mcap", messages)


@pytest.mark.parametrize("zeros", [3, 4, 100])
def test_zeros_after_a_message_cost_nothing(tmp_path, zeros):
    """Some recorders store the whole buffer that held the message."""
    with open_recording(write_images_and(tmp_path, bytes(zeros))) as recording:
        assert [int(recording.frame(k, "mono8")[0, 0]) for k in range(2)] == [0, 40]


def test_other_bytes_after_a_message_are_damage(tmp_path):
    path = write_images_and(tmp_path, b"\0\0\0\1")
    with open_recording(path) as recording, pytest.raises(RecordingError, match="a message is damaged"):
        recording.frame(1)


@pytest.mark.parametrize("first", [3, 9, 10, 11, 18])
def test_an_encapsulation_that_is_not_cdr_is_named(tmp_path, first):
    image = bytes([0, first]) + bytes(TYPES.serialize_cdr(raw_image(0, START), "sensor_msgs/msg/Image"))[2:]
    path = write_mcap(tmp_path / "a.mcap", [(image_channel(), START, image)])
    name = {3: "PL_CDR_LE", 9: "D_CDR2_LE", 10: "PL_CDR2_BE", 11: "PL_CDR2_LE", 18: "PL_CDR2_BE"}[first]
    words = f"DDS's encapsulation {name}, and only .*; record again"
    with open_recording(path) as recording, pytest.raises(RecordingError, match=words):
        recording.frame(0)


def test_cdr2_is_read_where_it_has_the_bytes_of_cdr(tmp_path):
    """It aligns values of 8 bytes to 4: here the second one."""
    stamped = TYPES.types["geometry_msgs/msg/PointStamped"]
    point = stamped(header(START), TYPES.types["geometry_msgs/msg/Point"](1.0, 2.0, 3.0))
    messages = [
        (image_channel(topic, message.__msgtype__), START + k, bytes([0, 6 + little]) + bytes(raw)[2:])
        for k, (topic, message, little) in enumerate(
            [("/cam", raw_image(2, START), 1), ("/cam", raw_image(3, START), 0), ("/point", point, 1)]
        )
        for raw in [TYPES.serialize_cdr(message, message.__msgtype__, little_endian=bool(little))]
    ]
    with open_recording(write_mcap(tmp_path / "a.mcap", messages)) as recording:
        assert recording.stamps.tolist() == [START, START]
        assert [int(recording.frame(k, "mono8")[0, 0]) for k in range(2)] == [80, 120]
        with pytest.warns(UserWarning, match="skipped: /point .* encapsulation CDR2_LE"):
            assert len(list(recording)) == 2


@pytest.mark.parametrize("profile", ["ros2", ""])
@pytest.mark.parametrize("per_chunk", [0, 1, 4])
@pytest.mark.parametrize("indexed", [0, 1, 2])
@pytest.mark.parametrize("repeated", [True, False])
@pytest.mark.parametrize("packed", ["", "lz4"])
def test_an_mcap_of_any_writer(tmp_path, profile, per_chunk, indexed, repeated, packed):
    options = {"per_chunk": per_chunk, "indexed": indexed, "repeated": repeated, "packed": packed}
    path = write_gray_mcap(tmp_path / "a.mcap", [FOREIGN["json"]], profile=profile, **options)
    with open_recording(path) as recording:
        assert recording.missing is None
        assert recording.stamps.tolist() == [START + k * 10**8 for k in range(6)]
        for k in (5, 0, 3):
            np.testing.assert_array_equal(recording.frame(k, "mono8"), gray_pixels(k))


@pytest.mark.parametrize("per_chunk", [0, 2])
def test_a_clock_that_jumps_back_costs_no_image(tmp_path, per_chunk):
    times = [START + jump for jump in (5, 6, 7, 1, 2, 3)]
    messages = [(image_channel(), time, raw_image(k, 0)) for k, time in enumerate(times)]
    with open_recording(write_mcap(tmp_path / "a.mcap", messages, per_chunk=per_chunk)) as recording:
        assert recording.stamps.tolist() == sorted(times)
        assert [int(recording.frame(k, "mono8")[0, 0]) // 40 for k in range(6)] == [3, 4, 5, 0, 1, 2]


def test_lists_in_messages_keep_their_elements(tmp_path):
    point, quaternion = (TYPES.types[f"geometry_msgs/msg/{kind}"] for kind in ("Point", "Quaternion"))
    pose = TYPES.types["geometry_msgs/msg/Pose"]
    poses = [pose(point(i, 0.0, 0.0), quaternion(0.0, 0.0, 0.0, 1.0)) for i in (1.5, 2.5)]
    joints = TYPES.types["sensor_msgs/msg/JointState"]
    empty = np.zeros(0)
    with BagWriter(tmp_path / "mine") as bag:
        bag.write("/poses", TYPES.types["geometry_msgs/msg/PoseArray"](header(START), poses), START)
        bag.write(
            "/joints", joints(header(START), ["left", "right"], np.array([0.5, 1.0]), empty, empty), START + 1
        )
        bag.write("/cam", raw_image(0, START), START + 2)
    with open_recording(tmp_path / "mine") as recording:
        (_, pose_array), (_, joint_state), _ = recording
    assert [pose.position.x for pose in pose_array.poses] == [1.5, 2.5]
    assert list(joint_state.name) == ["left", "right"]
    assert list(joint_state.position) == [0.5, 1.0]
    pose_class = installed_class("geometry_msgs/msg/Pose")
    if pose_class is not None:
        assert {type(pose) for pose in pose_array.poses} == {pose_class}


def test_two_recordings_iterate_side_by_side(raw_bag):
    with open_recording(raw_bag) as recording:
        pairs = [
            (np.array(a.data)[0], np.array(b.data)[0])
            for (_, a), (_, b) in zip(recording, recording, strict=True)
        ]
        assert pairs == [(40 * k % 256, 40 * k % 256) for k in range(6)]


@pytest.mark.parametrize("is_in_a_cycle", [False, True])
def test_a_recording_that_is_deleted_half_read_raises_nothing(raw_bag, monkeypatch, is_in_a_cycle):
    errors = []
    monkeypatch.setattr(sys, "unraisablehook", lambda event: errors.append(event.exc_value))
    recordings = [open_recording(raw_bag)]
    np.testing.assert_array_equal(recordings[0].frame(1, "mono8"), gray_pixels(1))
    if is_in_a_cycle:
        recordings.append(recordings)
    del recordings
    gc.collect()
    assert errors == []


def test_images_recorded_in_the_same_instant_stay_apart(tmp_path, storage):
    with BagWriter(tmp_path / "burst", storage) as bag:
        for k in range(6):
            bag.write("/cam", raw_image(k, START + k), START + k // 3)
    with open_recording(tmp_path / "burst") as recording:
        for k in (4, 1, 5, 0, 2, 3):
            np.testing.assert_array_equal(recording.frame(k, "mono8"), gray_pixels(k))


def test_a_stamp_of_zero_becomes_the_time_of_recording(tmp_path):
    with BagWriter(tmp_path / "mine") as bag:
        for k in range(3):
            bag.write("/cam", raw_image(k, 0), START + k * 10**8)
    with open_recording(tmp_path / "mine") as recording:
        assert recording.stamps.tolist() == [START + k * 10**8 for k in range(3)]


@pytest.mark.parametrize("first, then", [(0, START), (START, 10**9)])
def test_a_clock_that_was_set_while_recording_does_not_count_for_the_rate(tmp_path, first, then):
    with BagWriter(tmp_path / "mine") as bag:
        for k, start in enumerate([first] * 6 + [then] * 6):
            bag.write("/cam", raw_image(k, start + (k + 1) * 10**8), START + k * 10**8)
    with open_recording(tmp_path / "mine") as recording:
        assert recording.rate == pytest.approx(10)


def test_a_single_image_has_no_rate(tmp_path):
    with open_recording(write_raw_bag(tmp_path / "mine", images=1)) as recording:
        assert recording.rate == 0.0
        assert len(recording) == 1


@pytest.fixture
def robot_bag(tmp_path, storage):
    """The recording of a robot: depth first, a camera without messages, a compressed camera with its info."""
    png = cv2.imencode(".png", np.full((2, 3, 3), (10, 20, 30), np.uint8))[1].tobytes()
    info = TYPES.types["sensor_msgs/msg/CameraInfo"]
    region = TYPES.types["sensor_msgs/msg/RegionOfInterest"](0, 0, 0, 0, False)

    def camera_info(fx):
        k = np.array([fx, 0, 1, 0, fx, 1, 0, 0, 1.0])
        p = np.zeros(12)
        return info(header(START), 2, 3, "plumb_bob", np.array([0.5]), k, np.eye(3).ravel(), p, 0, 0, region)

    with BagWriter(tmp_path / "robot", storage) as bag:
        bag.write("/tof/image_raw/compressedDepth", compressed(b"no image", START), START)
        bag.topic("/back/image_raw", "sensor_msgs/msg/Image")
        bag.write("/tof/camera_info", camera_info(80), START)
        for k in range(4):
            bag.write("/front/image_raw/compressed", compressed(png, START + k, "png"), START + k)
            bag.write("/front/camera_info", camera_info(500), START + k)
    return tmp_path / "robot"


@pytest.mark.parametrize("encoding, bytes_per_pixel", [("16UC1", 2), ("32FC1", 4), ("no such", 1)])
def test_raw_depth_recorded_first_is_not_the_camera(tmp_path, encoding, bytes_per_pixel):
    depth = raw_image(0, START)
    depth.encoding, depth.step, depth.data = (
        encoding,
        5 * bytes_per_pixel,
        np.zeros(20 * bytes_per_pixel, "u1"),
    )
    with BagWriter(tmp_path / "realsense") as bag:
        bag.write("/camera/depth/image_rect_raw", depth, START)
        bag.write("/camera/color/image_raw", raw_image(2, START), START)
    with open_recording(tmp_path / "realsense") as recording:
        assert recording.camera_topic == "/camera/color/image_raw"
        np.testing.assert_array_equal(recording.frame(0, "mono8"), gray_pixels(2))


PNG = {
    "color": ("bgr8; png compressed bgr8", np.full((2, 3, 3), 9, np.uint8)),
    "gray": ("mono8; png compressed mono8", np.full((2, 3), 9, np.uint8)),
    "depth": ("16UC1; png compressed ", np.full((2, 3), 900, np.uint16)),
}


@pytest.mark.parametrize(
    ("topics", "camera"),
    [
        ({"/cam/image_raw/zstd": None, "/cam/image_raw/compressed": "color"}, "/cam/image_raw/compressed"),
        ({"/a/compressed": "depth", "/b/compressed": "gray", "/c/compressed": "color"}, "/c/compressed"),
        ({"/a/depth/compressed": "color", "/b/image/compressed": "gray"}, "/b/image/compressed"),
        ({"/infra1/image": "gray", "/left/image": "gray"}, "/left/image"),
        ({"/right/image": "color", "/left/image": "color"}, "/left/image"),
        ({"/depth_camera/color": "color", "/tof": "depth"}, "/depth_camera/color"),
        ({"/depth/compressed": "depth"}, "/depth/compressed"),
        ({"/cam/image/ffmpeg": None}, "/cam/image/ffmpeg"),
    ],
)
def test_the_camera_is_chosen_by_images_and_name_not_by_order(tmp_path, topics, camera):
    for order in (list(topics), list(reversed(topics))):
        with BagWriter(tmp_path / str(len(list(tmp_path.iterdir())))) as bag:
            for topic in order:
                format, pixels = PNG.get(topics[topic], ("other", None))
                data = b"\0" * 40 if pixels is None else cv2.imencode(".png", pixels)[1].tobytes()
                bag.write(topic, compressed(data, START, format), START)
        with open_recording(bag.path) as recording:
            assert recording.camera_topic == camera


@pytest.mark.parametrize("depth", ["/cam/depth", "/cam/aligned_depth_to_color/image_raw"])
@pytest.mark.parametrize("delay", [3_000_000, -3_000_000, 40_000_000, 60_000_000])
def test_depth_of_another_stamp_is_the_nearest_within_half_a_period(tmp_path, delay, depth):
    with BagWriter(tmp_path / "realsense") as bag:
        for k in range(5):
            stamp = START + k * 10**8
            bag.write("/cam/color", raw_image(k, stamp), stamp)
            if k != 2:  # lost on the way
                bag.write(depth, raw_image(k, stamp + delay), stamp + 1)
    with open_recording(tmp_path / "realsense") as recording:
        assert recording.camera_topic == "/cam/color"
        if delay == 60_000_000:  # of frame 1 it is 60 ms away, of frame 2 40 ms
            assert recording.depth(2)[0, 0] == 40
            with pytest.raises(
                NotRecordedError, match="the nearest is 60 ms from it, and half a period is 50"
            ):
                recording.depth(0)
        else:
            assert [recording.depth(k)[0, 0] // 40 for k in (0, 1, 3, 4)] == [0, 1, 3, 4]


def test_depth_is_the_camera_if_there_is_no_other_image(tmp_path):
    depth = raw_image(0, START)
    depth.encoding, depth.step, depth.data = "16UC1", 10, np.arange(20, dtype=np.uint16).view("u1")
    with BagWriter(tmp_path / "tof") as bag:
        bag.write("/left/image", depth, START)
        bag.write("/right/image", depth, START)
    with open_recording(tmp_path / "tof") as recording:
        assert recording.camera_topic == "/left/image"
        np.testing.assert_array_equal(
            recording.frame(0, "passthrough"), np.arange(20, dtype=np.uint16).reshape(4, 5)
        )


def test_the_camera_and_its_info_and_another_topic_in_its_place(robot_bag):
    with open_recording(robot_bag) as recording:
        assert list(recording.camera_info.k) == [500, 0, 1, 0, 500, 1, 0, 0, 1]
        assert list(recording.camera_info.d) == [0.5]
    with open_recording(robot_bag, camera_topic="/tof/image_raw/compressedDepth") as recording:
        assert len(recording) == 1
        assert bytes(recording.message(0).data) == b"no image"
    with pytest.raises(NotRecordedError) as caught:
        open_recording(robot_bag, camera_topic="/front")
    assert str(caught.value) == (
        "robot holds no images on /front, but on: "
        "/tof/image_raw/compressedDepth, /back/image_raw, /front/image_raw/compressed"
    )


def test_damaged_first_messages_cost_neither_the_camera_nor_its_info(tmp_path):
    region = TYPES.types["sensor_msgs/msg/RegionOfInterest"](0, 0, 0, 0, False)
    k, p = np.eye(3).ravel(), np.zeros(12)
    info = TYPES.types["sensor_msgs/msg/CameraInfo"](header(START), 4, 5, "", p[:0], k, k, p, 0, 0, region)
    messages = [(image_channel("/b/image"), START, raw_image(0, START))]
    for topic, message in (("/a/image", raw_image(1, START)), ("/a/camera_info", info)):
        channel = image_channel(topic, message.__msgtype__)
        messages += [(channel, START, b"\0\1\0\0cut"), (channel, START + 1, message)]
    with open_recording(write_mcap(tmp_path / "a.mcap", messages)) as recording:
        assert recording.camera_topic == "/a/image"
        assert (recording.camera_info.height, recording.camera_info.width) == (4, 5)


@pytest.mark.parametrize(
    ("read", "missing"),
    [
        (lambda r: r.depth(0), r"holds no depth \(/truth/depth\)"),
        (lambda r: r.labels(0), r"holds no labels \(/truth/labels\)"),
        (lambda r: r.label_names, "holds no facts about the scene"),
        (lambda r: r.pose("ball", 0), "holds no pose of 'ball'; it holds none"),
        (lambda r: r.camera_info, "holds no camera info of /my/cam; record /my/camera_info with it"),
    ],
)
def test_the_error_for_missing_data_names_them(raw_bag, read, missing):
    with open_recording(raw_bag) as recording, pytest.raises(NotRecordedError, match=missing):
        read(recording)
