"""CompressedImage to array and back: the field `format`, the file itself, and what is refused."""

import gzip
import importlib
import struct
import sys
import zlib
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
from compressed_depth import depth_to_compressed, rvl_encode

from imgproc_course.messages import ConversionError, array_to_compressed, compressed_to_array, encoding_info
from imgproc_course.messages.depth import rvl_decode

BGR = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [9, 99, 199]]], np.uint8)
LEVELS = np.array([[0, 1, 256], [1000, 40000, 65535]], np.uint16)


def message(format, data):
    return SimpleNamespace(format=format, data=data)


def png(array, **options):
    flags = [part for name, value in options.items() for part in (getattr(cv2, f"IMWRITE_PNG_{name}"), value)]
    return cv2.imencode(".png", array, flags)[1].tobytes()


def jpeg(array):
    return cv2.imencode(".jpg", array, [cv2.IMWRITE_JPEG_QUALITY, 100])[1].tobytes()


def plain_png(width, height, depth, color_type, scanlines, *extra_chunks):
    """A PNG made by hand; `scanlines` is what the deflate stream holds."""

    def chunk(kind, content):
        return (
            struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
        )

    header = struct.pack(">IIBBBBB", width, height, depth, color_type, 0, 0, 0)
    chunks = [(b"IHDR", header), *extra_chunks, (b"IDAT", zlib.compress(scanlines)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunk(kind, content) for kind, content in chunks)


# --- cases in which cv_bridge is wrong


def test_gray_images_become_the_desired_encoding():
    gray = np.array([[0, 100], [200, 255]], np.uint8)
    msg = message("png", png(gray))
    assert compressed_to_array(msg).tolist() == gray.tolist()
    assert compressed_to_array(msg, "mono8").tolist() == gray.tolist()
    assert compressed_to_array(msg, "bgr8").tolist() == np.stack([gray] * 3, axis=-1).tolist()
    assert (
        compressed_to_array(message("jpeg", jpeg(np.full((8, 8), 70, "u1"))), "rgb8")[3, 3].tolist()
        == [70] * 3
    )


def test_16_bits_keep_their_values_and_scale_by_257():
    msg = message("png", png(LEVELS))
    assert compressed_to_array(msg).tolist() == LEVELS.tolist()
    assert compressed_to_array(msg, "mono16").tolist() == LEVELS.tolist()
    assert compressed_to_array(msg, "16UC1").tolist() == LEVELS.tolist()
    assert compressed_to_array(msg, "mono8").tolist() == np.rint(LEVELS / 257).tolist()
    color = np.stack([LEVELS, LEVELS[::-1], LEVELS], axis=-1)
    assert (compressed_to_array(message("png", png(color)), "rgb16") == color[..., ::-1]).all()


def test_alpha_is_dropped_or_kept():
    bgra = np.dstack([BGR, np.array([[0, 50], [100, 255]], np.uint8)])
    msg = message("png", png(bgra))
    assert (compressed_to_array(msg) == bgra).all()
    assert (compressed_to_array(msg, "bgr8") == BGR).all()
    assert (compressed_to_array(msg, "rgba8") == bgra[..., [2, 1, 0, 3]]).all()


def test_the_result_is_fresh_and_writable():
    frame = compressed_to_array(message("png", png(BGR)))
    frame[:] = 3
    assert (compressed_to_array(message("png", png(BGR))) == BGR).all()


# --- the field `format`


@pytest.mark.parametrize(
    ("format", "desired", "expected"),
    [
        ("png", "bgr8", BGR),
        ("rgb8; png compressed bgr8", "rgb8", BGR[..., ::-1]),
        ("rgb8; png compressed bgr8", "passthrough", BGR),
        ("rgb8; png compressed rgb8", "rgb8", BGR),  # the publisher did not swap the channels
        ("rgb8; png compressed rgb8", "bgr8", BGR[..., ::-1]),
        ("8UC3; png compressed bgr8", "bgr8", BGR),
        ("nonsense", "bgr8", BGR),
        ("jpeg", "bgr8", BGR),  # the file itself decides
    ],
)
def test_colors_by_format(format, desired, expected):
    assert (compressed_to_array(message(format, png(BGR)), desired) == expected).all()


# --- what compressed_image_transport publishes, by encoding and codec

BGR_OF = {"bgr": [0, 1, 2], "rgb": [2, 1, 0], "bgra": [0, 1, 2, 3], "rgba": [2, 1, 0, 3]}  # channels of each
COLORS = [f"{color}{bits}" for color in BGR_OF for bits in (8, 16)]
MOSAICS = [f"bayer_{rows}{bits}" for rows in ("rggb", "bggr", "gbrg", "grbg") for bits in (8, 16)]
GRAYS = ["mono8", "mono16", "8UC1", "16UC1"]
SIGNED = ["8SC1", "16SC1", "16SC3", "32SC1", "32FC1", "32FC3"]


def ramp(encoding):
    info = encoding_info(encoding)
    shape = info.shape(16, 24)
    low, high = (0, 250 if info.dtype == np.uint8 else 65000) if info.dtype.kind == "u" else (-120, 120)
    return np.linspace(low, high, np.prod(shape)).reshape(shape).astype(info.dtype)


def published(array, encoding, codec, stored=""):
    """The plugin's message: `stored` is the encoding to which it converts; the values as they are without."""
    info = encoding_info(encoding)
    if stored.startswith("bgr"):
        array = array[..., BGR_OF[info.color][: len(stored.rstrip("1268"))]]
    elif stored == "mono8" and info.color.startswith("bayer_"):  # OpenCV names the second row
        pattern = {"rggb": "BG", "bggr": "RG", "gbrg": "GR", "grbg": "GB"}[info.color.removeprefix("bayer_")]
        array = cv2.cvtColor(array, getattr(cv2, f"COLOR_Bayer{pattern}2GRAY"))
    if codec == "jpeg" and array.dtype == np.uint16:
        array = np.rint(array / 257).astype(np.uint8)
    data = cv2.imencode(f".{codec}", np.ascontiguousarray(array))[1].tobytes()
    return message(f"{encoding}; {codec} compressed {stored}", data)


@pytest.mark.parametrize("encoding", [*COLORS, *MOSAICS, *GRAYS, *SIGNED])
def test_a_tiff_holds_the_image_as_it_was(encoding):
    msg = published(ramp(encoding), encoding, "tiff")
    assert (compressed_to_array(msg, encoding) == ramp(encoding)).all()
    in_bgr = ramp(encoding)[..., BGR_OF[encoding.rstrip("168")]] if encoding in COLORS else ramp(encoding)
    assert (compressed_to_array(msg) == in_bgr).all()


PNG_ROWS = [(encoding, "") for encoding in [*MOSAICS, *GRAYS]]
PNG_ROWS += [
    (encoding, "bgr" + encoding.lstrip("rgba")) for encoding in COLORS
]  # up to ROS Jazzy without alpha
PNG_ROWS += [(encoding, "bgra" + encoding.lstrip("rgba")) for encoding in COLORS if "a" in encoding]


@pytest.mark.parametrize(("encoding", "stored"), PNG_ROWS)
def test_a_png_holds_colors_in_the_order_of_opencv(encoding, stored):
    array = ramp(encoding)
    frame = compressed_to_array(published(array, encoding, "png", stored), encoding)
    if "a" in encoding and stored in ("bgr8", "bgr16"):
        array[..., 3] = np.iinfo(array.dtype).max
    assert (frame == array).all()


@pytest.mark.parametrize("encoding", [*COLORS, *MOSAICS, "mono8", "mono16"])
def test_a_jpeg_holds_colors_or_gray_of_8_bits(encoding):
    msg = published(ramp(encoding), encoding, "jpeg", "bgr8" if encoding in COLORS else "mono8")
    decoded = cv2.imdecode(np.frombuffer(msg.data, np.uint8), cv2.IMREAD_UNCHANGED)
    frame = compressed_to_array(msg)
    assert (frame == decoded).all() and frame.ndim == (3 if encoding in COLORS else 2)
    gray = decoded if decoded.ndim == 3 else np.dstack([decoded] * 3)
    assert (compressed_to_array(msg, "bgr8") == gray).all()


def test_a_mosaic_in_a_jpeg_if_the_publisher_kept_it():
    """The plugin's parameter jpeg_compress_bayer (ROS Kilted). A mosaic of 16 bits saturates, and is lost."""
    mosaic = ramp("bayer_gbrg8")
    msg = published(mosaic, "bayer_gbrg8", "jpeg", "bayer_gbrg8")
    decoded = cv2.imdecode(np.frombuffer(msg.data, np.uint8), cv2.IMREAD_UNCHANGED)
    assert (compressed_to_array(msg, "bgr8") == cv2.cvtColor(decoded, cv2.COLOR_BayerGR2BGR)).all()
    with pytest.raises(ConversionError, match="lost the values of 'bayer_gbrg16'"):
        compressed_to_array(message("bayer_gbrg16; jpeg compressed bayer_gbrg16", msg.data))


def test_16uc1_in_a_png_is_not_gray():
    msg = message("16UC1; png compressed ", png(LEVELS))
    assert compressed_to_array(msg, "32FC1").tolist() == LEVELS.tolist()
    with pytest.raises(ConversionError, match="scale it yourself"):
        compressed_to_array(msg, "mono8")


def test_png_files_that_opencv_does_not_write():
    one_bit = plain_png(4, 2, 1, 0, b"\0\xa0\0\x50")
    assert compressed_to_array(message("png", one_bit)).tolist() == [[255, 0, 255, 0], [0, 255, 0, 255]]
    palette = (b"PLTE", bytes([1, 2, 3, 40, 50, 60]))
    indexed = plain_png(2, 1, 8, 3, b"\0\0\1", palette)
    assert compressed_to_array(message("png", indexed)).tolist() == [[[3, 2, 1], [60, 50, 40]]]


def test_chunks_without_pixels_are_dropped_without_warnings(capfd):
    extras = [(b"gAMA", b"\0"), (b"iCCP", b"?"), (b"tEXt", b"Comment\0hello"), (b"acTL", bytes(8))]
    data = plain_png(2, 1, 8, 0, b"\0\x05\x06", *extras)
    assert compressed_to_array(message("png", data)).tolist() == [[5, 6]]
    assert capfd.readouterr().err == ""


# --- array to message


@pytest.mark.parametrize(
    ("encoding", "array", "stored"),
    [
        ("bgr8", BGR, "bgr8"),
        ("rgb8", BGR, "bgr8"),
        ("8UC3", BGR, "bgr8"),
        ("mono8", BGR[..., 0], "mono8"),
        ("8UC1", BGR[..., 0], "mono8"),
        ("rgba8", np.dstack([BGR, BGR[..., :1]]), "bgra8"),
        ("mono16", LEVELS, "mono16"),
        ("16UC1", LEVELS, "mono16"),
        ("bayer_rggb8", BGR[..., 0], "mono8"),
        ("rgb16", np.dstack([LEVELS, LEVELS + 1, LEVELS]), "bgr16"),
    ],
)
def test_png_loses_nothing(encoding, array, stored):
    header = array_to_compressed(array, encoding, "png").header
    msg = array_to_compressed(array, encoding, "png", header)
    assert msg.format == f"{encoding}; png compressed {stored}" and msg.header is header
    assert (compressed_to_array(msg, encoding) == array).all()
    swapped = array.astype(array.dtype.newbyteorder(">"))
    assert bytes(array_to_compressed(swapped, encoding, "png").data) == bytes(msg.data)


def test_jpeg_keeps_the_colors_in_their_order():
    flat = np.full((16, 16, 3), (200, 100, 10), np.uint8)
    msg = array_to_compressed(flat, "rgb8")
    assert msg.format == "rgb8; jpeg compressed bgr8"
    assert np.abs(compressed_to_array(msg, "rgb8").astype(int) - flat).max() <= 3
    assert len(array_to_compressed(flat, quality=5).data) < len(msg.data)
    with_alpha = np.dstack([flat, flat[..., :1]])
    assert (
        np.abs(compressed_to_array(array_to_compressed(with_alpha, "bgra8"))[0, 0] - [200, 100, 10.0]).max()
        <= 3
    )


BAD_ARRAYS = {
    "16 bits to jpeg": ((LEVELS, "mono16"), "format='png'"),
    "a mosaic to jpeg": ((BGR[..., 0], "bayer_rggb8"), "format='png'"),
    "floats": ((LEVELS.astype("f4"), "32FC1", "png"), "fits into '16UC1'"),
    "two channels": ((BGR[..., :2], "8UC2", "png"), "convert it to 'bgr8'"),
    "yuv": ((BGR[..., :2], "uyvy", "png"), "convert it to 'bgr8'"),
    "gray called bgr8": ((BGR[..., 0],), "'bgr8' needs an array of uint8, (H, W, 3)"),
    "format": ((BGR, "bgr8", "gif"), "'jpeg' or 'png', got 'gif'"),
    "quality": ((BGR, "bgr8", "jpeg", None, 101), "1 to 100, got 101"),
    "empty": ((BGR[:0],), "shape (0, 2, 3)"),
    "too many rows": ((np.zeros((70000, 1), np.uint8), "mono8"), "65500"),
}


@pytest.mark.parametrize("case", BAD_ARRAYS)
def test_an_array_that_the_format_would_change_is_refused(case):
    arguments, words = BAD_ARRAYS[case]
    with pytest.raises(ConversionError) as caught:
        array_to_compressed(*arguments)
    assert words in str(caught.value)


# --- damaged data

WHOLE = png(np.arange(3000, dtype=np.uint8).reshape(30, 100))


def png_that_claims(width, height):
    return plain_png(width, height, 8, 0, bytes(100))


def jpeg_that_claims(width, height):
    data = bytearray(jpeg(BGR))
    at = data.index(b"\xff\xc0") + 5
    data[at : at + 4] = struct.pack(">HH", height, width)
    return bytes(data)


BROKEN = {
    "empty": (b"", "'data' is empty"),
    "text": (b"hello, world", "expected a JPEG, PNG or other"),
    "video": (b"\0\0\0\1gxx", "H.264"),
    "video with a short start code": (b"\0\0\1\x40\1x", "H.265"),
    "png cut": (WHOLE[:-20], "cut short"),
    "png cut within a chunk": (WHOLE[: len(WHOLE) // 2], "cut short"),
    "png, one bit flipped": (WHOLE[:100] + bytes([WHOLE[100] ^ 1]) + WHOLE[101:], "wrong checksum"),
    "png without header": (WHOLE[:8] + WHOLE[33:], "without a readable header"),
    "png of 7 bits": (plain_png(2, 2, 7, 0, bytes(6)), "without a readable header"),
    "png of no pixel": (plain_png(0, 2, 8, 0, bytes(6)), "no pixel"),
    "png that claims 4 billion rows": (png_that_claims(1, 2**32 - 1), "so many bytes"),
    "png that claims 64 TB": (png_that_claims(2**23, 2**23), "so many bytes"),
    "jpeg cut": (jpeg(BGR)[:-40], "do not decode"),
    "jpeg of two bytes": (b"\xff\xd8", "without a readable header"),
    "jpeg that claims 65535²": (jpeg_that_claims(65535, 65535), "so many bytes"),
    "jpeg without rows": (jpeg_that_claims(2, 0), "no pixel"),
}


@pytest.mark.parametrize("case", BROKEN)
def test_damaged_data_are_refused_without_warnings(case, capfd):
    data, words = BROKEN[case]
    with pytest.raises(ConversionError) as caught:
        compressed_to_array(message("jpeg", data), "bgr8")
    assert words in str(caught.value)
    assert capfd.readouterr().err == ""


def test_blank_images_in_very_few_bytes_are_decoded():
    """The limits on the claimed size must accept the smallest file of a large image."""
    blank = np.zeros((4000, 4000), np.uint8)
    options = [cv2.IMWRITE_JPEG_PROGRESSIVE, 1, cv2.IMWRITE_JPEG_OPTIMIZE, 1, cv2.IMWRITE_JPEG_QUALITY, 1]
    for data in (
        cv2.imencode(".jpg", blank, options)[1].tobytes(),
        cv2.imencode(".jpg", np.dstack([blank] * 3), options)[1].tobytes(),
        png(blank, COMPRESSION=9),
        png(blank, BILEVEL=1, COMPRESSION=9),
    ):
        frame = compressed_to_array(message("", data))
        assert frame.shape[:2] == (4000, 4000) and frame.max() <= 1  # JPEG of quality 1
    depth = depth_to_compressed(np.zeros((1080, 1920), np.uint16), format="rvl")
    assert len(depth.data) < 40 and not compressed_to_array(depth).any()


@pytest.mark.parametrize(
    "container", [lambda d: np.frombuffer(d, "u1").reshape(3, -1), lambda d: np.frombuffer(d, "i1")]
)
def test_data_may_be_bytes_of_any_shape(container):
    data = jpeg(np.full((8, 8, 3), 50, np.uint8))
    data += bytes(-len(data) % 3)
    assert compressed_to_array(message("jpeg", container(data)))[0, 0].tolist() == [50, 50, 50]


def test_arguments_that_are_not_compressed_images():
    with pytest.raises(ConversionError, match="image_to_array reads an Image"):
        compressed_to_array(SimpleNamespace(encoding="bgr8", data=b""))
    with pytest.raises(ConversionError, match="without 'data'"):
        compressed_to_array(SimpleNamespace(format="jpeg"))
    with pytest.raises(ConversionError, match="did you mean 'bgr8'"):
        compressed_to_array(message("png", WHOLE), "BGR8")


def test_the_remedy_for_values_without_a_meaning_names_a_field_of_the_message():
    msg = message("16UC1; png compressed ", png(np.full((2, 3), 25700, np.uint16)))
    with pytest.raises(ConversionError, match=r"set the encoding in msg\.format to 'mono16' first"):
        compressed_to_array(msg, "mono8")
    msg.format = msg.format.replace("16UC1", "mono16")
    assert compressed_to_array(msg, "mono8").tolist() == [[100] * 3] * 2


# --- compressedDepth

DEPTH = np.array([[0, 0, 500], [501, 499, 65535], [0, 1, 0]], np.uint16)


@pytest.mark.parametrize("format", ["png", "rvl"])
def test_depth_in_millimetres_comes_back_exactly(format):
    msg = depth_to_compressed(DEPTH, format=format)
    assert msg.format == f"16UC1; compressedDepth {format}"
    frame = compressed_to_array(msg)
    assert frame.dtype == np.uint16 and frame.tolist() == DEPTH.tolist()
    assert compressed_to_array(msg, "32FC1").tolist() == DEPTH.tolist()
    with pytest.raises(ConversionError, match="scale it yourself"):
        compressed_to_array(msg, "mono8")


@pytest.mark.parametrize("format", ["png", "rvl"])
def test_depth_in_metres_within_a_step(format):
    metres = np.array([[0.3, 1.0, 9.99], [np.nan, np.inf, -1.0], [0.0, 2.5, 10.5]], np.float32)
    back = compressed_to_array(depth_to_compressed(metres, "32FC1", format))
    assert back.dtype == np.float32
    is_measured = np.array([[1, 1, 1], [0, 0, 0], [0, 1, 0]], bool)
    assert (np.isnan(back) == ~is_measured).all()
    assert (np.abs(back - metres)[is_measured] <= 0.5 * metres[is_measured] ** 2 / 10100 * 1.01 + 1e-6).all()


def test_the_formula_of_inverse_depth():
    """depth = A / (q - B), by hand: 1000 / (501 - 1) = 2 m; q = 0 is NaN."""
    body = png(np.array([[501, 0, 1001]], np.uint16))
    msg = message("32FC1; compressedDepth png", struct.pack("<iff", 0, 1000.0, 1.0) + body)
    assert compressed_to_array(msg).tolist()[0][::2] == [2.0, 1.0]
    assert np.isnan(compressed_to_array(msg)[0, 1])
    old_name = message("32FC1; compressedDepth", msg.data)
    assert compressed_to_array(old_name)[0, 0] == 2.0


@pytest.mark.parametrize(("a", "b"), [(0, 1), (0, -np.inf), (np.nan, 1), (np.inf, 1), (-1, 1), (1, np.nan)])
def test_a_header_without_a_quantization_is_refused(a, b):
    """As depth_quantization 0 writes it: every stored value is 1, and every depth would be NaN."""
    body = png(np.ones((2, 3), np.uint16))
    with pytest.raises(ConversionError, match="depth_quantization and depth_max above 0"):
        compressed_to_array(message("32FC1; compressedDepth png", struct.pack("<iff", 0, a, b) + body))


def test_an_rvl_stream_calculated_by_hand():
    """Pixels 0 0 0 500 502 501 0: [3 zeros] [3 not] +500 +2 -1, [1 zero] [0 not].

    Differences with the sign lowest: 500 -> 1000, 2 -> 4, -1 -> 1. In groups of three bits, lowest first, and
    8 where more follow: 3 -> 3; 3 -> 3; 1000 = 0b1_111_101_000 -> 8 D F 1; 4 -> 4; 1 -> 1; 1 -> 1; 0 -> 0.
    The nibbles 3 3 8 D F 1 4 1 | 1 0 (padded with 0), each word's lowest byte first.
    """
    stream = bytes.fromhex("41f18d33 00000010".replace(" ", ""))
    assert rvl_decode(stream, 7).tolist() == [0, 0, 0, 500, 502, 501, 0]
    assert rvl_encode([0, 0, 0, 500, 502, 501, 0]) == stream
    body = struct.pack("<iffII", 0, 0.0, 0.0, 7, 1) + stream
    assert compressed_to_array(message("16UC1; compressedDepth rvl", body)).tolist() == [
        [0, 0, 0, 500, 502, 501, 0]
    ]


@pytest.mark.parametrize("format", ["", "16UC1", "png", "compressedDepth png", "16UC1; compressedDepth"])
def test_depth_whose_format_names_no_codec_is_png(format):
    data = depth_to_compressed(DEPTH).data
    assert compressed_to_array(message(format, data)).tolist() == DEPTH.tolist()


def test_depth_in_metres_without_its_encoding_is_refused():
    msg = depth_to_compressed(np.array([[0.5, 2.0]], np.float32), "32FC1")
    msg.format = "32FC1"
    assert np.abs(compressed_to_array(msg) - [0.5, 2.0]).max() < 0.01
    msg.format = ""
    with pytest.raises(ConversionError, match=r"set msg\.format to '32FC1; compressedDepth png' for metres"):
        compressed_to_array(msg)


def rvl_message(columns, rows, stream):
    return message("16UC1; compressedDepth rvl", struct.pack("<iffII", 0, 0, 0, columns, rows) + stream)


STREAM = rvl_encode([5] * 12)
BROKEN_DEPTH = {
    "no image": (message("16UC1; compressedDepth png", bytes(12)), "cut short"),
    "no png": (message("16UC1; compressedDepth png", bytes(40)), "expected a PNG"),
    "png of 8 bits": (
        message("16UC1; compressedDepth", bytes(12) + png(BGR[..., 0])),
        "16 bits, got uint8",
    ),
    "encoding": (message("bgr8; compressedDepth png", bytes(40)), "'16UC1', 'mono16' and '32FC1'"),
    "codec": (message("16UC1; compressedDepth jpeg", bytes(40)), "'png' or 'rvl', got"),
    "rvl without size": (message("16UC1; compressedDepth rvl", bytes(15)), "cannot hold its size"),
    "rvl cut": (rvl_message(4, 3, STREAM[:4]), "RVL"),
    "rvl of other size": (rvl_message(4, 4, STREAM), "RVL ends after"),
    "rvl too large for its image": (rvl_message(2, 3, STREAM), "do not make 6 pixels"),
    "rvl that claims 2**64": (rvl_message(2**32 - 1, 2**32 - 1, STREAM), "made to exhaust the memory"),
    "rvl that claims 200 MB": (rvl_message(10_000, 10_000, STREAM), "made to exhaust the memory"),
    "rvl of no pixel": (rvl_message(0, 3, STREAM), "no pixel"),
    "rvl of endless numbers": (rvl_message(4, 3, b"\xff" * 40), "RVL"),
    "rvl of empty runs": (rvl_message(4, 3, bytes(400)), "do not make 12 pixels"),
}


# --- zstd_image_transport


def raw_in_a_stream(body, encoding=b"rgb8", height=2, width=2, step=7, is_bigendian=0, length=None):
    fields = struct.pack("<IIBII", height, width, is_bigendian, step, length or len(encoding))
    return message("zstd", fields + encoding + body)


PADDED = np.pad(BGR.reshape(2, 6), ((0, 0), (0, 1)), constant_values=9).tobytes()


def zstandard(data):
    package = "compression.zstd" if sys.version_info >= (3, 14) else "backports.zstd"
    return importlib.import_module(package).compress(data)


@pytest.mark.parametrize("compress", [gzip.compress, zlib.compress, zstandard])
def test_a_raw_image_in_a_stream(compress):
    msg = raw_in_a_stream(compress(PADDED))
    frame = compressed_to_array(msg)
    frame[:] += 0  # writable
    assert (frame == BGR).all()
    assert (compressed_to_array(msg, "bgr8") == BGR[..., ::-1]).all()
    msg.format = "zlib"
    assert (compressed_to_array(msg, "rgb8") == BGR).all()
    depth = raw_in_a_stream(compress(LEVELS.astype(">u2").tobytes()), b"16UC1", 2, 3, 6, is_bigendian=1)
    assert compressed_to_array(depth).tolist() == LEVELS.tolist()


STREAM_OF_PIXELS = gzip.compress(PADDED)
BROKEN_STREAMS = {
    **{f"png of {e}": (published(ramp(e), e, "png"), f"lost the values of '{e}'") for e in SIGNED},
    "depth in a JPEG": (message("16UC1; jpeg compressed ", jpeg(BGR[..., 0])), "lost the values of '16UC1'"),
    "no fields": (message("zstd", bytes(16)), "cannot hold the fields"),
    "endless encoding": (raw_in_a_stream(STREAM_OF_PIXELS, length=2**32 - 1), "unknown encoding"),
    "no stream": (raw_in_a_stream(b"not compressed"), "does not decode"),
    "stream cut": (raw_in_a_stream(STREAM_OF_PIXELS[:20]), "cut short"),
    "one bit flipped": (raw_in_a_stream(STREAM_OF_PIXELS[:-6] + b"?" + STREAM_OF_PIXELS[-5:]), "decode"),
    "no Zstandard": (raw_in_a_stream(zstandard(PADDED)[:4] + b"?" * 20), "does not decode"),
    "claims 4 GB": (raw_in_a_stream(STREAM_OF_PIXELS, height=2**29, step=8), "claim an image of 4294967296"),
    "step": (raw_in_a_stream(STREAM_OF_PIXELS, step=5), "needs step >= 6"),
}


@pytest.mark.parametrize("case", [*BROKEN_DEPTH, *BROKEN_STREAMS])
def test_damaged_data_of_a_transport_are_refused(case):
    msg, words = (BROKEN_DEPTH | BROKEN_STREAMS)[case]
    with pytest.raises(ConversionError) as caught:
        compressed_to_array(msg)
    assert words in str(caught.value)


def test_without_a_decoder_of_zstandard_the_error_names_the_package(monkeypatch):
    msg = raw_in_a_stream(zstandard(PADDED))
    for name in ("compression.zstd", "backports.zstd"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ConversionError, match=r"pip install backports\.zstd, or subscribe to the raw topic"):
        compressed_to_array(msg)
