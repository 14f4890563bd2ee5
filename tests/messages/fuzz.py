"""Malformed messages by the million: only ConversionError may be raised, and memory stays bounded.

    python tests/messages/fuzz.py --count 1000000 [--seed 0]

Prints the outcomes, the slowest case, and the largest allocation as a multiple of the message's bytes. Stops
at the first message that breaks a rule, prints it, and exits with 1. test_fuzz.py does a short run.
"""

import argparse
import array
import contextlib
import itertools
import os
import random
import re
import resource
import struct
import sys
import tempfile
import time
import tracemalloc
import warnings
import zlib
from collections import Counter
from types import SimpleNamespace

import cv2
import numpy as np
from compressed_depth import depth_to_compressed

from imgproc_course.messages import (
    ConversionError,
    array_to_compressed,
    array_to_image,
    compressed_to_array,
    encoding_info,
    image_to_array,
)
from imgproc_course.messages.encodings import ENCODINGS
from imgproc_course.messages.image_files import FILE_EXTENSIONS
from imgproc_course.messages.image_headers import BLANK_PIXELS, PNG_EXPANSION

SMALL_CHANGE = 64 * 1024  # bytes: error texts, views, caches of Python's own
IMAGE_MULTIPLE = 24  # of the message's bytes: 1-byte pixels to 16-bit rgba, with one step between, and lists
PIXEL_BYTES = 64  # of a decoded image: up to 4 values of 2 bytes, and the steps of a conversion
DECODER_BYTES = 2**26  # what a decoder may take for itself
SECONDS = 5.0  # of processor time, for any one message

COMMON = ["bgr8", "rgb8", "mono8", "bgra8", "mono16", "rgba16", "8UC1", "16UC1", "32FC3", "64FC1"]
NUMBERS = [
    *(0, 1, 2, 3, 4, 5, 7, 8, 12, 24, 255, 256, 65535, 65536),
    *(2**31 - 1, 2**31, 2**32 - 1, 2**32, 2**33, 2**63 - 1, 2**63, 2**64, 10**30, -1, -8, -(2**31)),
    *(True, None, 1.5, "3", b"4", float("nan")),
    *(np.uint32(4), np.uint32(2**32 - 1), np.uint8(2), np.int64(-1)),
    *([4], (1,), np.array([2, 2])),
]
NAMES = [
    *ENCODINGS,
    *("8U", "32F", "8UC5", "8UC512", "64FC512", "8UC0", "8UC513", "16UC00002", "8UC99999999999999999999"),
    *("", "passthrough", "BGR8", "bgr8 ", "foo", "8UC", "C3", "16FC1", "mono", "\0"),
    *("ä" * 500, "8UC" + "9" * 5000),
    *(None, 8, b"bgr8", ["bgr8"], ("mono8",), float("nan")),
]

SIZE_POSITIONS = (12, 16, 18, 20, 22, 26, 28, 32, *range(150, 170))
HUGE_SIZES = (
    *(b"\xff\xff\xff\xff", b"\x7f\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\1\0\0", b"\0\0\1\0", b"\0\0\0\0"),
    *(b"\0\x10\0\0", b"\0\0\x10\0", b"\xff\xff\0\0", b"\0\0\xff\xff"),
)
FORMATS = [
    *("", "jpeg", ";", "rgb8; jpeg compressed rgb8", "bayer_rggb8; png", "x" * 900, None, 3, b"jpeg"),
    *("32FC1; compressedDepth rvl", "mono16; compressedDepth", "8UC1; compressedDepth png"),
]
DTYPES = [
    *("?", "i1", "u1", "u1", "u1", "u1", "i2", "u2", ">u2", "i4", "u4", "i8"),
    *("f2", "f4", ">f4", "f8", "c8", "O", "S3", "M8[s]"),
]


class Fuzzer:
    """Makes malformed cases from a seed, runs them, and counts the outcomes."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.outcomes = Counter()
        self.slowest = (0.0, "none")
        self.largest = {"image": (0.0, "none"), "compressed": (0.0, "none"), "array": (0.0, "none")}
        self.files = list(_whole_files())

    def run(self, count):
        tracemalloc.start()
        try:
            for number in range(count):
                self.one(number)
        finally:
            tracemalloc.stop()

    def one(self, number):
        make_case = self.random.choices((self.image, self.compressed, self.array), (6, 3, 1))[0]
        name, function, arguments, size, limit = make_case()
        tracemalloc.reset_peak()
        resident = _peak_of_process()  # the decoders' own memory, which tracemalloc does not see
        before, started = tracemalloc.get_traced_memory()[0], time.process_time()
        try:
            result = function(*arguments)
            outcome = "converted"
        except ConversionError as error:
            result, outcome = None, "refused"
            assert str(error) and len(str(error)) < 1000, f"case {number}: {error}"
        seconds = time.process_time() - started
        peak = tracemalloc.get_traced_memory()[1] - before
        case = f"case {number} of {name}: {_described(arguments)}"
        assert seconds < SECONDS, f"{case} took {seconds:.1f} s"
        assert peak <= limit, f"{case}: {size} bytes, peak of {peak}, limit {limit}"
        growth = _peak_of_process() - resident
        assert growth <= limit + DECODER_BYTES, f"{case}: the process grew by {growth} bytes, limit {limit}"
        assert not isinstance(result, np.ndarray) or result.dtype.isnative, case
        self.outcomes[f"{name} {outcome}"] += 1
        self.slowest = max(self.slowest, (seconds, case))
        if peak > SMALL_CHANGE:
            self.largest[name] = max(self.largest[name], ((peak - SMALL_CHANGE) / max(size, 1), case))

    def image(self):
        pick = self.random
        name = pick.choice(list(ENCODINGS))
        sides = (0, 1, 2, 3, 4, 4, 6, 6, 8, 8) if pick.random() < 0.99 else (100, 128)
        info, height, width = encoding_info(name), pick.choice(sides), pick.choice(sides)
        step = width * info.pixel_bytes + pick.choice((0, 0, 0, 1, 2, 5))
        data = pick.randbytes(step * info.rows(height))
        msg = SimpleNamespace(
            encoding=name, height=height, width=width, step=step, is_bigendian=pick.randrange(2), data=data
        )
        for _ in range(pick.choice((0, 0, 1, 1, 2, 3))):
            self.damage(msg)
        desired = pick.choice((pick.choice(NAMES), pick.choice(COMMON), "passthrough"))
        size = _size(getattr(msg, "data", b""))
        return "image", image_to_array, (msg, desired), size, SMALL_CHANGE + IMAGE_MULTIPLE * size

    def damage(self, msg):
        pick = self.random
        field = pick.choice(("encoding", "height", "width", "step", "is_bigendian", "data", "data"))
        if not hasattr(msg, field):
            return
        if pick.random() < 0.02:
            delattr(msg, field)
        elif field == "encoding":
            msg.encoding = pick.choice(NAMES)
        elif field == "data":
            msg.data = self.damaged_data(msg.data)
        else:
            setattr(msg, field, pick.choice(NUMBERS))

    def damaged_data(self, data):
        pick = self.random
        if not isinstance(data, bytes):
            return data
        if pick.random() < 0.5:
            return data[: pick.randrange(len(data) + 1)] if pick.random() < 0.7 else data + b"more"
        return pick.choice(
            (
                lambda: array.array("B", data),
                lambda: bytearray(data),
                lambda: memoryview(data),
                lambda: memoryview(data)[::2],
                lambda: memoryview(data)[::-1],
                lambda: list(data),
                lambda: tuple(data),
                lambda: np.frombuffer(data, np.uint8),
                lambda: np.frombuffer(data, np.uint8).reshape(1, -1)[:, ::-1],
                lambda: np.frombuffer(data, np.uint8).astype(np.uint16),
                lambda: array.array("d", [1.0, 2.0]),
                lambda: np.array(["2020-01-01"], "M8[D]"),
                lambda: np.array([None, {}], object),
                lambda: [1, 2, 300],
                lambda: [1, -2],
                lambda: [10**30],
                lambda: ["a", None],
                lambda: "text",
                lambda: None,
                lambda: 10**9,
                lambda: {1: 2},
            )
        )()

    def compressed(self):
        pick = self.random
        format, data = pick.choice(self.files)
        for _ in range(pick.randrange(4)):
            data = self.damaged_file(data)
        if pick.random() < 0.2:
            format = pick.choice(FORMATS)
        msg = SimpleNamespace(format=format, data=pick.choice((bytes, bytearray, list, memoryview))(data))
        desired = pick.choice(NAMES) if pick.random() < 0.4 else "passthrough"
        # The most pixels that so many bytes can be: deflate of 1-bit pixels, or a blank image.
        pixels = 8 * PNG_EXPANSION * len(data)
        can_be_blank = (isinstance(format, str) and "rvl" in format) or data[:4] in (b"RIFF", b"\0\0\0\x0c")
        limit = SMALL_CHANGE + PIXEL_BYTES * (pixels + BLANK_PIXELS * can_be_blank)
        return "compressed", compressed_to_array, (msg, desired), len(data), limit

    def damaged_file(self, data):
        pick, data = self.random, bytearray(data)
        damage = pick.randrange(7)
        at = pick.randrange(len(data) + 1)
        if damage == 0:
            return bytes(data[:at])
        if damage == 1:
            return bytes(data[:at] + pick.randbytes(pick.randrange(1, 9)) + data[at:])
        if damage == 2:
            return _with_checksums(bytes(data[:at] + pick.randbytes(4) + data[at + 4 :]))
        if damage == 3:  # a huge size where a header may have it: in the first bytes, or in TIFF's directory
            at = pick.choice((pick.randrange(200), *SIZE_POSITIONS, max(0, len(data) - pick.randrange(160))))
            data[at : at + 4] = pick.choice(HUGE_SIZES)
            return _with_checksums(bytes(data))
        if damage == 6:  # digits of a text header
            choices = [b"0", b"9", b"65536", b"99999999"]
            return re.sub(rb"\d+", lambda _: pick.choice(choices), bytes(data), count=3)
        if damage == 4 and data:
            data[pick.randrange(len(data))] ^= 1 << pick.randrange(8)
            return bytes(data)
        return bytes(data[: pick.randrange(len(data) + 1)] + data[at:])

    def array(self):
        pick = self.random
        shape = tuple(pick.randrange(7) for _ in range(pick.choice((0, 1, 2, 2, 2, 3, 3, 3, 3, 4))))
        values = np.zeros(shape, pick.choice(DTYPES))
        values = pick.choice((values, values.T, values[::-1] if shape else values, values.tolist(), None, 3))
        if pick.random() < 0.02:
            values = np.broadcast_to(np.uint8(0), (2**20, 2**20, 3))  # 3 TB in one byte
        encoding = pick.choice((pick.choice(NAMES), pick.choice(COMMON), "mono8", "passthrough"))
        function, extra = pick.choice(
            (
                (array_to_image, ()),
                (array_to_compressed, (pick.choice(("jpeg", "png", "jpg", "gif", None, 3)),)),
            )
        )
        return "array", function, (values, encoding, *extra), 0, SMALL_CHANGE * 4


def _whole_files():
    """(format, bytes) of whole files, to be damaged."""
    ramp = np.arange(8 * 10 * 3, dtype=np.uint8).reshape(8, 10, 3)
    depth = (np.arange(80, dtype=np.uint16) * 50).reshape(8, 10)
    for msg in (
        array_to_compressed(ramp),
        array_to_compressed(np.ascontiguousarray(ramp[..., 0]), "mono8"),
        array_to_compressed(ramp, "rgb8", "png"),
        array_to_compressed(depth, "16UC1", "png"),
        depth_to_compressed(depth),
        depth_to_compressed(depth, format="rvl"),
        depth_to_compressed(depth.astype(np.float32) / 1000, "32FC1"),
        depth_to_compressed(depth.astype(np.float32) / 1000, "32FC1", format="rvl"),
    ):
        yield msg.format, bytes(msg.data)
    yield "zstd", struct.pack("<IIBII", 8, 10, 0, 30, 4) + b"rgb8" + zlib.compress(ramp.tobytes())
    progressive = cv2.imencode(".jpg", ramp, [cv2.IMWRITE_JPEG_PROGRESSIVE, 1])[1]
    yield "jpeg", progressive.tobytes()
    yield "png", cv2.imencode(".png", ramp[..., 0], [cv2.IMWRITE_PNG_BILEVEL, 1])[1].tobytes()
    large = cv2.resize(ramp, (40, 36))  # JPEG 2000 needs 32 pixels
    for extension, (dtypes, channel_counts) in FILE_EXTENSIONS.items():
        for dtype, channels in itertools.product(dtypes, channel_counts):
            frame = (large if extension == "jp2" else ramp).astype(dtype)
            frame = np.dstack([frame, frame[..., :1]])[..., :channels]
            yield extension, cv2.imencode(f".{extension}", frame)[1].tobytes()
    for compression in (1, 8, 32773):
        yield "tiff", cv2.imencode(".tiff", ramp, [cv2.IMWRITE_TIFF_COMPRESSION, compression])[1].tobytes()
    yield "webp", cv2.imencode(".webp", ramp, [cv2.IMWRITE_WEBP_QUALITY, 50])[1].tobytes()
    yield "ppm", cv2.imencode(".ppm", ramp, [cv2.IMWRITE_PXM_BINARY, 0])[1].tobytes()


def _with_checksums(data):
    """The same bytes with correct PNG checksums, so that the damage is not found by them alone."""
    start = data.find(b"\x89PNG\r\n\x1a\n")
    if start < 0:
        return data
    data, at = bytearray(data), start + 8
    while at + 12 <= len(data):
        length = int.from_bytes(data[at : at + 4], "big")
        end = at + 8 + length
        if end + 4 > len(data):
            break
        struct.pack_into(">I", data, end, zlib.crc32(data[at + 4 : end]))
        at = end + 4
    return bytes(data)


def _peak_of_process():
    """Bytes of memory that this process held at most so far."""
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def _size(data):
    try:
        return memoryview(data).nbytes
    except (TypeError, ValueError, BufferError):
        return 8 * len(data) if isinstance(data, list | tuple) else getattr(data, "nbytes", 0)


def _described(arguments):
    def text(value):
        if isinstance(value, SimpleNamespace):
            return ", ".join(f"{field}={text(part)}" for field, part in vars(value).items())
        return f"{value.dtype}{value.shape}" if isinstance(value, np.ndarray) else repr(value)[:600]

    return "; ".join(map(text, arguments))


@contextlib.contextmanager
def captured_stderr():
    """Sends stderr, also that of the decoders, to a temporary file, and yields the file."""
    with tempfile.TemporaryFile("w+") as file:
        original = os.dup(2)
        sys.stderr.flush()
        os.dup2(file.fileno(), 2)
        try:
            yield file
        finally:
            os.dup2(original, 2)
            os.close(original)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    warnings.simplefilter("error")
    fuzzer, started = Fuzzer(options.seed), time.perf_counter()
    with captured_stderr() as printed:
        fuzzer.run(options.count)
        printed.seek(0)
        lines = Counter(line.split(":")[0].strip() for line in printed)
    seconds = time.perf_counter() - started
    print(
        f"{options.count:,} messages, seed {options.seed}, {seconds:.0f} s: only ConversionError was raised"
    )
    for name, count in sorted(fuzzer.outcomes.items()):
        print(f"  {name}: {count:,}")
    print(f"slowest: {fuzzer.slowest[0] * 1e3:.1f} ms, {fuzzer.slowest[1][:300]}")
    for name, (multiple, case) in fuzzer.largest.items():
        print(f"largest allocation of {name}: {multiple:.1f} x the message's bytes, {case[:200]}")
    print(f"peak of the process: {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MiB")
    print(f"printed by the decoders: {lines.total()} lines, {dict(lines.most_common(5))}")


if __name__ == "__main__":
    main()
