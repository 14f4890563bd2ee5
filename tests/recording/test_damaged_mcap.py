"""A recording that was cut off opens with what it has; a damaged chunk is named; a full disk is let go."""

import os
import resource
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from imgproc_course.recording import RecordingError, RecordingWriter, open_recording
from imgproc_course.recording.mcap import CHUNK, HEAD, records

from .conftest import START, TYPES, raw_image

IMAGES = 6


def large_image(k, stamp):
    """An image of its own chunk: 1.2 MB, each pixel is k."""
    image = raw_image(0, stamp)
    image.height, image.width, image.step = 1000, 1200, 1200
    image.data = np.full(1_200_000, k, np.uint8)
    return image


def write(writer, k):
    message, stamp = large_image(k, START + k * 10**8), START + k * 10**8
    kind = message.__msgtype__
    writer.write("/cam/image_raw", kind, bytes(TYPES.serialize_cdr(message, kind)), stamp)


@pytest.fixture
def own(tmp_path):
    """The folder of a recording with six images, each in a chunk of its own, and its .mcap file."""
    with RecordingWriter(tmp_path / "own") as writer:
        for k in range(IMAGES):
            write(writer, k)
    return tmp_path / "own", tmp_path / "own" / "own.mcap"


def chunks_of(file):
    """(its place, its data) of each chunk."""
    data = file.read_bytes()
    found = records(lambda place, size: data[place : place + size], 8, len(data))
    return [(place, data[place : place + size]) for kind, place, size in found if kind == CHUNK]


def frames(recording):
    return [int(recording.frame(k, "mono8")[3, 4]) for k in range(len(recording))]


def test_a_file_that_was_cut_off_opens_with_what_it_has(own):
    folder, file = own
    os.truncate(file, chunks_of(file)[4][0] - HEAD.size + 700_000)
    for path, lost in (
        (folder, "2 of 6 messages are missing"),
        (file, "how many messages are missing is not"),
    ):
        with pytest.warns(UserWarning, match=rf"was cut off: it has 4 messages of 0.3 s; {lost}") as caught:
            recording = open_recording(path)
        assert caught[0].filename == __file__
        assert "its last 0.70 MB cannot be read" in recording.missing
        assert frames(recording) == [0, 1, 2, 3] and len(list(recording)) == 4
        assert recording.frame(-1, "mono8")[0, 0] == 3
        assert recording.stamps.tolist() == [START + k * 10**8 for k in range(4)]
        recording.close()


def test_only_the_index_is_missing(own):
    folder, file = own
    os.truncate(file, file.stat().st_size - 40)
    (folder / "metadata.yaml").unlink()  # as after a kill
    with pytest.warns(UserWarning, match="it has 6 messages of 0.5 s"), open_recording(folder) as recording:
        assert frames(recording) == [0, 1, 2, 3, 4, 5]


DAMAGED = r"is damaged from 0\.3 to 0\.3 s after its first message"


def damage(file):
    """Changes a byte in the chunk of image 3."""
    with file.open("r+b") as opened:
        opened.seek(chunks_of(file)[3][0] + 600_000)
        opened.write(b"\xff")


def assert_only_image_3_is_lost(recording):
    assert [int(recording.frame(k, "mono8")[3, 4]) for k in (0, 1, 2, 4, 5)] == [0, 1, 2, 4, 5]
    with pytest.raises(RecordingError, match=DAMAGED):
        recording.frame(3)
    with pytest.warns(UserWarning, match="skipped: own.mcap is damaged from 0.3"):
        assert len(list(recording)) == 5


def test_a_damaged_chunk_is_named_with_its_time(own):
    folder, file = own
    damage(file)
    for path in (folder, file):
        with open_recording(path) as recording:
            assert_only_image_3_is_lost(recording)


def test_a_damaged_chunk_of_a_file_that_was_cut_off_is_named_too(own):
    _, file = own
    damage(file)
    os.truncate(file, file.stat().st_size - 40)
    with pytest.warns(UserWarning, match="it has 6 messages"), open_recording(file) as recording:
        assert_only_image_3_is_lost(recording)


@pytest.mark.parametrize("lost", range(IMAGES))
def test_a_chunk_whose_head_is_overwritten_does_not_cost_the_others(own, lost):
    folder, file = own
    with file.open("r+b") as opened:
        opened.seek(chunks_of(file)[lost][0] - HEAD.size)
        opened.write(bytes(4096))
    with pytest.warns(UserWarning, match="is damaged: .* 1 of 6 messages are missing"):
        recording = open_recording(folder)
    assert frames(recording) == [k for k in range(IMAGES) if k != lost]
    recording.close()


def test_a_full_disk_is_let_go_and_what_came_before_opens(tmp_path):
    writer = RecordingWriter(tmp_path / "own")
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(
        resource.RLIMIT_FSIZE, (3_000_000, limits[1])
    )  # each file: as a disk with so much room
    try:
        write(writer, 0)
        write(writer, 1)
        with pytest.raises(RecordingError, match="own cannot be written: File too large"):
            write(writer, 2)
        with pytest.raises(
            RecordingError, match=r"cannot be completed: .*; open_recording opens what it has"
        ):
            writer.close()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    opened = [link.readlink() for link in Path("/proc/self/fd").iterdir() if link.exists()]
    assert [path for path in opened if path.is_relative_to(tmp_path)] == []
    writer.close()
    with pytest.warns(UserWarning, match="2 messages"), open_recording(tmp_path / "own") as recording:
        assert frames(recording) == [0, 1]


KILLED = """
import os, signal, sys
import numpy as np
from imgproc_course.recording import RecordingWriter
writer = RecordingWriter(sys.argv[1])
for k in range(40):
    noise = np.random.default_rng(k).integers(0, 256, (300, 400, 3), dtype=np.uint8)
    writer.write_image("/cam/image_raw/compressed", noise, (k + 1) * 10**8)
os.kill(os.getpid(), signal.SIGKILL)
"""


def test_the_recording_of_a_killed_program_opens(tmp_path):
    ended = subprocess.run([sys.executable, "-c", KILLED, str(tmp_path / "own")], check=False)
    assert ended.returncode == -9
    with (
        pytest.warns(UserWarning, match="own.mcap was cut off"),
        open_recording(tmp_path / "own") as recording,
    ):
        assert 30 <= len(recording) <= 40  # the last MB was not yet on the disk
        assert recording.frame(-1).shape == (300, 400, 3)
