"""image_to_array and array_to_image: cases in which cv_bridge is wrong, and all kinds of message data."""

import array
import os
import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import cv2
import numpy as np
import PIL.Image
import pytest

from imgproc_course.messages import (
    ConversionError,
    array_to_compressed,
    array_to_image,
    compressed_to_array,
    encoding_info,
    image_to_array,
)


def message(encoding, rows, width, data, *, step=None, is_bigendian=0):
    step = width * encoding_info(encoding).pixel_bytes if step is None else step
    return SimpleNamespace(
        header=None,
        height=rows,
        width=width,
        encoding=encoding,
        is_bigendian=is_bigendian,
        step=step,
        data=data,
    )


def test_passthrough_is_a_read_only_view():
    data = array.array("B", range(12))
    frame = image_to_array(message("bgr8", 2, 2, data))
    data[0] = 99
    assert frame[0, 0, 0] == 99
    with pytest.raises(ValueError, match="read-only"):
        frame[0, 0, 0] = 1
    assert image_to_array(message("bgr8", 2, 2, data), "bgr8").base is not None


@pytest.mark.parametrize("width", [1, 2])
def test_a_view_keeps_its_bytes_alive(width):
    data = array.array("B", range(12))
    frame = image_to_array(message("bgr8", 2, width, data, step=6))
    with pytest.raises(BufferError):
        data.frombytes(bytes(10_000_000))
    del data
    assert frame[1, 0].tolist() == [6, 7, 8]


@pytest.mark.parametrize(
    "container",
    [
        lambda data: memoryview(b"".join(bytes([b, 0]) for b in data))[::2],
        lambda data: np.frombuffer(data, np.uint8)[::-1].copy()[::-1],
    ],
)
def test_data_may_be_bytes_at_any_stride(container):
    values = np.array([[1, 515], [65535, 7]], "<u2")
    assert (image_to_array(message("16UC1", 2, 2, container(values.tobytes()))) == values).all()


def test_more_data_than_the_image_needs_is_ignored():
    assert image_to_array(message("mono8", 1, 2, b"abXXX")).tolist() == [[97, 98]]


@pytest.mark.parametrize("encoding", ["bgr8", "mono16", "nv12", "bayer_rggb8", "uyvy", "32FC1"])
@pytest.mark.parametrize("size", [(0, 0), (0, 4), (4, 0)])
def test_empty_images_have_the_shape_of_their_fields(encoding, size):
    msg = message(encoding, *size, b"")
    info = encoding_info(encoding)
    assert image_to_array(msg).shape == info.shape(*size)
    if info.color:
        frame = image_to_array(msg, "bgr16")
        assert frame.shape == (*size, 3) and frame.dtype == np.uint16


REFUSED = {  # case: (fields changed in a valid 4 × 4 bgr8 message, words that the error must contain)
    "step too short": ({"step": 11}, ["'bgr8'", "width 4", "step >= 12", "got 11", "mislabelled"]),
    "step 0": ({"step": 0}, ["step >= 12", "got 0"]),
    "data too short": ({"data": bytes(47)}, ["4 rows of 12 bytes need 48", "got 47", "cut short"]),
    "no data": ({"data": b""}, ["need 48 bytes of data, got 0"]),
    "is_bigendian 2": ({"is_bigendian": 2}, ["'is_bigendian' is 2", "0 or 1", "set it to 0"]),
    "is_bigendian 255": ({"is_bigendian": 255}, ["'is_bigendian' is 255"]),
    "negative": ({"height": -1}, ["'height' is -1", "uint32"]),
    "beyond uint32": ({"width": 2**32}, ["'width' is 4294967296", "uint32"]),
    "a product beyond 64 bits": (
        {"height": 2**32 - 1, "width": 2**32 - 1, "step": 2**32 - 1},
        ["'bgr8'", "step >= 12884901885"],
    ),
    "a product that NumPy's uint32 would wrap": (
        {"height": np.uint32(2**16), "width": np.uint32(2**16), "step": np.uint32(3 * 2**16)},
        ["need 12884901888 bytes", "got 48"],
    ),
    "a float": ({"height": 4.0}, ["'height' must be an int", "4.0"]),
    "a text": ({"step": "12"}, ["'step' must be an int", "'12'"]),
    "unknown encoding": ({"encoding": "BGR8"}, ["unknown encoding 'BGR8'", "did you mean 'bgr8'"]),
    "encoding no text": ({"encoding": None}, ["encoding: an encoding is a name", "None"]),
    "too many channels": ({"encoding": "8UC513"}, ["513 channels", "1 to 512"]),
    "no channels": ({"encoding": "8UC0"}, ["0 channels"]),
    "data no bytes": ({"data": "text"}, ["'data' must be bytes", "'text'"]),
    "data of 16 bits": ({"data": np.zeros(48, np.uint16)}, ["'data' must be bytes", "tobytes"]),
    "a list beyond 255": ({"data": [256] * 48}, ["'data' must be bytes", "0..255"]),
}


@pytest.mark.parametrize("change", REFUSED)
def test_a_message_that_contradicts_itself_is_refused(change):
    fields, words = REFUSED[change]
    msg = message("bgr8", 4, 4, bytes(48))
    assert not image_to_array(msg).any()  # its layout is remembered: 4.0 equals 4
    vars(msg).update(fields)
    with pytest.raises(ConversionError) as caught:
        image_to_array(msg)
    assert [word for word in words if word not in str(caught.value)] == []


@pytest.mark.parametrize("field", ["height", "width", "step", "encoding", "is_bigendian", "data"])
def test_a_missing_field_is_named(field):
    msg = message("bgr8", 4, 4, bytes(48))
    delattr(msg, field)
    with pytest.raises(ConversionError, match=f"without a field '{field}'"):
        image_to_array(msg)


def test_the_error_for_a_compressed_image_names_the_right_function():
    with pytest.raises(ConversionError, match="compressed_to_array"):
        image_to_array(SimpleNamespace(format="jpeg", data=b""))


REFUSALS = {  # (source, desired): the remedy that the error must name
    ("16UC1", "mono8"): "scale it yourself",
    ("8UC1", "mono8"): "set msg.encoding to 'mono8'",
    ("8UC3", "bgr8"): "'rgb8' or 'bgr8'",
    ("32FC1", "bgr8"): "scale it yourself",
    ("rgb8", "mono"): "did you mean 'mono8'",
    ("rgb8", "16UC1"): "select channels with NumPy",
    ("bgr8", "uyvy"): "ask for 'bgr8'",
    ("bayer_rggb8", "bgra8"): "no alpha; ask for 'bgr8'",
    ("bgr8", None): "desired_encoding: an encoding is a name such as",
}


@pytest.mark.parametrize(("source", "desired"), REFUSALS)
def test_a_conversion_without_meaning_names_the_remedy(source, desired):
    msg = message(source, 4, 4, bytes(4 * 4 * 8))
    with pytest.raises(ConversionError) as caught:
        image_to_array(msg, desired)
    assert REFUSALS[source, desired] in str(caught.value)


@pytest.mark.parametrize("values", [[500, 2000, 0, 1000], [0.5, 2.0, np.nan, np.inf], [0.5, 2.0, -1.0, -9]])
def test_the_remedy_for_depth_makes_measured_values_visible(values):
    a = np.array([values], np.uint16 if isinstance(values[0], int) else np.float32)
    with pytest.raises(ConversionError) as caught:
        image_to_array(array_to_image(a), "mono8")
    recipe = re.search(r"as in (cv2\.convertScaleAbs\(.*\))(?:;|$)", str(caught.value))[1]
    visible = eval(recipe, {"a": a, "cv2": cv2, "np": np})[0].tolist()
    assert visible[:2] == [64, 255] and (visible[2] == 0 or not values[2] < 0)


def test_16_to_8_bits_rounds_on_every_value():
    levels = np.arange(65536, dtype=np.uint16)[None]
    expected = np.rint(levels / 257).astype(int)
    assert (image_to_array(array_to_image(levels, "mono16"), "mono8") == expected).all()
    signed = np.arange(-32768, 32768, dtype=np.int16)[None]
    assert (image_to_array(array_to_image(signed), "8SC1") == np.rint(signed / 257)).all()


# --- YUV: compared with the formula of BT.601, limited range; OpenCV rounds it


def bt601_bgr(y, u, v):
    y, u, v = 1.164383 * (np.maximum(y, 16.0) - 16), u - 128.0, v - 128.0
    bgr = np.stack([y + 2.017232 * u, y - 0.391762 * u - 0.812968 * v, y + 1.596027 * v], axis=-1)
    return np.clip(bgr, 0, 255)


@pytest.fixture
def yuv():
    rng = np.random.default_rng(3)
    return rng.integers(0, 256, (6, 8)), rng.integers(0, 256, (6, 8)), rng.integers(0, 256, (6, 8))


def laid_out(encoding, y, u, v):
    """(bytes of the planes in the order of an encoding, u per pixel, v per pixel)."""
    if encoding in ("uyvy", "yuyv", "yuv422", "yuv422_yuy2"):
        u, v = np.repeat(u[:, ::2], 2, axis=1), np.repeat(v[:, ::2], 2, axis=1)
        chroma = np.where(np.arange(8) % 2, v, u)
        pair = (chroma, y) if encoding in ("uyvy", "yuv422") else (y, chroma)
        return np.stack(pair, axis=-1).astype("u1").tobytes(), u, v
    if encoding == "nv24":
        return np.concatenate([y.ravel(), np.stack([u, v], axis=-1).ravel()]).astype("u1").tobytes(), u, v
    small_u, small_v = u[::2, ::2], v[::2, ::2]
    pair = (small_u, small_v) if encoding == "nv12" else (small_v, small_u)
    data = np.concatenate([y.ravel(), np.stack(pair, axis=-1).ravel()]).astype("u1").tobytes()
    return data, *(np.repeat(np.repeat(c, 2, axis=0), 2, axis=1) for c in (small_u, small_v))


YUV = ["uyvy", "yuyv", "yuv422", "yuv422_yuy2", "nv12", "nv21", "nv24"]


@pytest.mark.parametrize("encoding", YUV)
def test_yuv_to_colors_and_gray(encoding, yuv):
    y, u, v = yuv
    data, u, v = laid_out(encoding, y, u, v)
    msg = message(encoding, 6, 8, data)
    bgr = image_to_array(msg, "bgr8")
    assert np.abs(bgr - bt601_bgr(y, u, v)).max() <= 1
    assert (image_to_array(msg, "rgb8") == bgr[..., ::-1]).all()
    assert (image_to_array(msg, "bgra8")[..., :3] == bgr).all()
    assert (image_to_array(msg, "rgba8")[..., 3] == 255).all()
    assert (image_to_array(msg, "mono8") == y).all()
    assert (image_to_array(msg, "bgr16") == bgr.astype(int) * 257).all()


def test_odd_sizes_for_which_opencv_reads_beyond_the_row():
    with pytest.raises(ConversionError, match="width 3 is odd"):
        image_to_array(message("uyvy", 2, 3, bytes(12)), "bgr8")
    assert image_to_array(message("uyvy", 2, 3, bytes(12))).shape == (2, 3, 2)
    with pytest.raises(ConversionError, match="both must be even"):
        image_to_array(message("nv12", 3, 4, bytes(100)))
    with pytest.raises(ConversionError, match="step is the length of a row of Y"):
        image_to_array(message("nv12", 4, 4, bytes(24), step=6))


# --- array to message


def test_a_message_describes_its_array():
    array_ = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)
    header = array_to_image(array_).header
    msg = array_to_image(array_, "rgb8", header)
    assert (msg.height, msg.width, msg.encoding, msg.is_bigendian, msg.step) == (2, 4, "rgb8", 0, 12)
    assert bytes(msg.data) == bytes(range(24)) and msg.header is header
    array_[0] = 99
    assert bytes(msg.data) == bytes(range(24))


U1 = np.zeros((4, 6, 3), np.uint8)
BAD_ARRAYS = {  # array, encoding, words of the error
    "no array": ([[1]], "mono8", ["expected a NumPy array", "a list", "np.asarray"]),
    "None": (None, "bgr8", ["got None", "the file or the camera gave no image", "cv2.imread"]),
    "array of None": (np.asarray(None), "bgr8", ["got None", "gave no image"]),
    "VideoCapture.read": ((True, U1), "bgr8", ["a tuple", "(ok, frame)"]),
    "path": (Path("a.png"), "bgr8", ["Path", "call cv2.imread(...) first"]),
    "VideoCapture": (cv2.VideoCapture(), "bgr8", ["call .read() first"]),
    "bytes of a file": (b"\xff\xd8", "bgr8", ["cv2.imdecode"]),
    "buffer of a file": (bytearray(b"\xff\xd8"), "bgr8", ["cv2.imdecode"]),
    "PIL image": (PIL.Image.new("RGB", (3, 2)), "rgb8", ["np.asarray(image.convert('RGB'))", "'rgb8'"]),
    "PyTorch": (type("Tensor", (), {})(), "rgb8", ["a Tensor", ".permute(1, 2, 0).cpu().numpy()"]),
    "UMat": (cv2.UMat(U1), "bgr8", ["a UMat", "call .get() first"]),
    "message": (SimpleNamespace(encoding="bgr8", data=b""), "bgr8", ["call image_to_array(...) first"]),
    "channels first": (U1.transpose(2, 0, 1), "bgr8", ["(3, 4, 6)", "np.transpose(array, (1, 2, 0))"]),
    "channels first, large": (np.zeros((3, 40, 640), "u1"), "rgb8", ["np.transpose(array, (1, 2, 0))"]),
    "channels first, passthrough": (np.zeros((3, 40, 64), "u1"), "passthrough", ["np.transpose"]),
    "0..1": (U1 / 255, "bgr8", ["np.rint(np.nan_to_num(array) * 255)", "lie in 0 to 0"]),
    "-1..1": (U1 - 0.5, "bgr8", ["np.rint((np.nan_to_num(array) + 1) * 127.5)", "-0.5 to -0.5"]),
    "0..300": (U1 + 300.5, "bgr8", ["np.clip(np.rint(np.nan_to_num(array)), 0, 255)", "300.5 to 300.5"]),
    "metres": (U1[..., 0] + 1.5, "16UC1", ["array) * 1000), 0, 65535).astype('uint16')"]),
    "negative depth": (U1[..., 0] - np.int16(5), "16UC1", ["np.clip(np.rint(array), 0, 65535)", "-5 to -5"]),
    "16 bits": (U1[..., 0].astype("u2"), "mono8", ["np.rint(array * (255 / 65535))"]),
    "one axis": (U1[0, 0], "passthrough", ["(H, W)", "(3,)"]),
    "four axes": (U1[None], "passthrough", ["(1, 4, 6, 3)", "one image per message"]),
    "bool": (np.zeros((2, 2), bool), "mono8", ["bool", "* 255"]),
    "int64": (np.zeros((2, 2), np.int64), "mono8", ["int64", "astype('uint8')"]),
    "float16": (np.zeros((2, 2), np.float16), "32FC1", ["float16", "astype('float32')"]),
    "channels": (U1, "rgba8", ["'rgba8'", "(H, W, 4)", "(4, 6, 3)", "'rgb8' or 'bgr8'"]),
    "depth": (U1, "bgr16", ["'bgr16'", "uint16", "convert the values to uint16"]),
    "unknown": (U1, "bgr", ["unknown encoding 'bgr'", "did you mean 'bgr8'"]),
    "encoding no text": (U1, None, ["encoding: an encoding is a name"]),
    "no channels": (U1[..., :0], "passthrough", ["0 channels"]),
    "600 channels": (np.zeros((1, 1, 600), "u1"), "passthrough", ["600 channels", "512"]),
    "nv12 of odd width": (U1[:3, :3, 0], "nv12", ["(3, 3)", "'nv12'", "(H * 3 / 2, W)"]),
    "masked": (np.ma.masked_equal(U1[..., 0], 0), "mono8", ["mask", "filled(0)"]),
    "too large": (np.broadcast_to(np.uint8(0), (2**20, 2**20)), "mono8", ["too large", "4294967295"]),
}


@pytest.mark.parametrize("case", BAD_ARRAYS)
def test_an_array_that_no_message_can_hold_is_refused(case):
    array_, encoding, words = BAD_ARRAYS[case]
    with pytest.raises(ConversionError) as caught:
        array_to_image(array_, encoding)
    assert [word for word in words if word not in str(caught.value)] == []


# --- with and without ROS


def run_python(code, **environment):
    process = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert process.returncode == 0, process.stderr
    return process.stdout.strip()


def test_importing_the_package_imports_no_message_classes():
    code = "import sys, imgproc_course.messages as m; print([n for n in sys.modules if n.split('.')[0] in "
    assert run_python(code + "('rclpy', 'sensor_msgs', 'rosbags', 'imgproc_course.imaging')])") == "[]"


ROUND_TRIP = """
import numpy as np
from imgproc_course.messages import *
a = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)
msg = array_to_image(a, "bgr8")
assert (image_to_array(msg) == a).all()
assert (compressed_to_array(array_to_compressed(a, format="png")) == a).all()
print(type(msg).__module__.split(".")[0], type(msg.header).__module__.split(".")[0])
"""


def test_without_sensor_msgs_messages_are_those_of_rosbags():
    hide_ros = "import sys; sys.modules['sensor_msgs'] = None\n"
    assert run_python(hide_ros + ROUND_TRIP) == "rosbags rosbags"


@pytest.mark.ros
@pytest.mark.parametrize("checks", ["0", "1"])
def test_with_sensor_msgs_in_every_configuration_of_rclpy(checks):
    assert run_python(ROUND_TRIP, ROS_PYTHON_CHECK_FIELDS=checks) == "sensor_msgs std_msgs"


@pytest.mark.ros
def test_a_wrong_header_is_refused_where_rclpy_checks_fields():
    code = "import numpy as np\nfrom imgproc_course.messages import *\n"
    code += "try: array_to_image(np.zeros((1, 1), 'u1'), header=3)\nexcept ConversionError as e: print(e)"
    assert "header must be a std_msgs/Header" in run_python(code, ROS_PYTHON_CHECK_FIELDS="1")


@pytest.mark.parametrize(
    ("argument", "remedy"),
    [
        ("hello", "pass the message itself, as in a subscriber's on_image(frame, msg)"),
        (np.zeros((2, 2), np.uint8), "it is an array already: use it directly"),
        (SimpleNamespace(format="jpeg", data=b""), "compressed_to_array reads a CompressedImage"),
    ],
)
def test_an_argument_that_is_no_message_gets_its_own_remedy(argument, remedy):
    with pytest.raises(ConversionError) as error:
        image_to_array(argument)
    quoted = "'hello'" if isinstance(argument, str) else f"a {type(argument).__name__}"
    assert (
        str(error.value) == f"expected a sensor_msgs/Image, got {quoted} without a field 'encoding'; {remedy}"
    )


@pytest.mark.parametrize(
    "mistake",
    [
        lambda: image_to_array("hello"),
        lambda: image_to_array(array_to_image(np.zeros((2, 2), np.uint8)), "bgr9"),
        lambda: array_to_image("hello"),
        lambda: array_to_image(np.zeros((2, 2), bool)),
        lambda: compressed_to_array("hello"),
        lambda: array_to_compressed(np.zeros((2, 2), bool)),
    ],
)
def test_the_traceback_of_an_error_ends_at_the_public_function(mistake):
    with pytest.raises(ConversionError) as error:
        mistake()
    _, _, last = error.traceback  # this test, the lambda, and the public function
    assert last.name in ("image_to_array", "array_to_image", "compressed_to_array", "array_to_compressed")
    assert error.value.__suppress_context__ and error.value.__cause__ is None
