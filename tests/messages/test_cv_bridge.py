"""CvBridge: the parameters, results and exceptions of cv_bridge's own class."""

import array
import inspect
from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from imgproc_course.messages import ConversionError
from imgproc_course.messages.cv_bridge import CvBridge, CvBridgeError, cvtColorForDisplay, getCvType

BRIDGE = CvBridge()
BGR = np.arange(18, dtype=np.uint8).reshape(2, 3, 3)


def message(encoding="bgr8", data=None, **changes):
    fields = {"height": 2, "width": 3, "encoding": encoding, "is_bigendian": 0, "step": 9}
    return SimpleNamespace(
        **{**fields, "data": array.array("B", BGR.tobytes()) if data is None else data, **changes}
    )


def test_parameters_have_cv_bridges_names():
    names = {
        name: list(inspect.signature(getattr(BRIDGE, name)).parameters)
        for name in dir(CvBridge)
        if "_to_" in name
    }
    assert names["imgmsg_to_cv2"] == ["img_msg", "desired_encoding"]
    assert names["cv2_to_imgmsg"] == ["cvim", "encoding", "header"]
    assert names["compressed_imgmsg_to_cv2"] == ["cmprs_img_msg", "desired_encoding"]
    assert names["cv2_to_compressed_imgmsg"][:2] == ["cvim", "dst_format"]
    assert names["encoding_to_cvtype2"] == ["encoding"]
    assert names["encoding_to_dtype_with_channels"] == ["encoding"]
    assert names["dtype_with_channels_to_cvtype2"] == ["dtype", "n_channels"]
    assert names["cvtype2_to_dtype_with_channels"] == ["cvtype"]
    assert list(inspect.signature(cvtColorForDisplay).parameters) == [
        *("source", "encoding_in", "encoding_out", "do_dynamic_scaling"),
        *("min_image_value", "max_image_value", "colormap"),
    ]


def test_there_and_back():
    msg = BRIDGE.cv2_to_imgmsg(BGR, encoding="bgr8", header=None)
    assert (msg.encoding, msg.height, msg.width, msg.step) == ("bgr8", 2, 3, 9)
    assert (BRIDGE.imgmsg_to_cv2(msg, desired_encoding="rgb8") == BGR[..., ::-1]).all()
    packed = BRIDGE.cv2_to_compressed_imgmsg(BGR, dst_format="PNG")
    assert packed.format == "PNG"
    assert (BRIDGE.compressed_imgmsg_to_cv2(packed, "rgb8") == BGR[..., ::-1]).all()
    assert BRIDGE.cv2_to_compressed_imgmsg(BGR).format == "jpg"


def test_passthrough_is_a_writable_view_as_in_cv_bridge():
    msg = message()
    BRIDGE.imgmsg_to_cv2(msg)[0, 0] = 77
    assert msg.data[:3].tolist() == [77, 77, 77]


@pytest.mark.parametrize("desired", ["passthrough", "bgr8", "", "rgb8", "8UC3"])
@pytest.mark.parametrize("container", [bytes, list, tuple, bytearray])
def test_every_result_is_writable(desired, container):
    msg = message(data=container(BGR.tobytes()))
    frame = BRIDGE.imgmsg_to_cv2(msg, desired)
    frame[:] = 0
    assert not frame.any()
    if desired != "passthrough" or container is not bytearray:
        assert bytes(msg.data) == BGR.tobytes()


def test_padded_and_big_endian_results_are_writable_copies():
    padded = message(data=bytes(20), step=10)
    BRIDGE.imgmsg_to_cv2(padded)[:] = 1
    swapped = message("mono16", bytes(range(12)), step=6, is_bigendian=1)
    frame = BRIDGE.imgmsg_to_cv2(swapped)
    frame[0, 0] += 1
    assert frame[0].tolist() == [2, 0x0203, 0x0405]


def test_errors_are_of_every_class_that_callers_catch():
    for kind in (CvBridgeError, TypeError, ConversionError, ValueError):
        with pytest.raises(kind, match="unknown encoding 'foo'"):
            BRIDGE.imgmsg_to_cv2(message("foo"))
    with pytest.raises(CvBridgeError, match="NumPy array"):
        BRIDGE.cv2_to_imgmsg([[1]])
    with pytest.raises(CvBridgeError, match="int64"):
        BRIDGE.cv2_to_imgmsg(np.zeros((2, 2), np.int64))
    with pytest.raises(CvBridgeError, match="'data' is empty"):
        BRIDGE.compressed_imgmsg_to_cv2(SimpleNamespace(format="jpg", data=b""))
    with pytest.raises(CvBridgeError, match="one of the formats jpg"):
        BRIDGE.cv2_to_compressed_imgmsg(BGR, "mp4")
    with pytest.raises(CvBridgeError, match="not 3 of uint16"):
        BRIDGE.cv2_to_compressed_imgmsg(BGR.astype("u2"), "jpg")
    with pytest.raises(CvBridgeError):
        BRIDGE.encoding_to_cvtype2("uyvy8")


def test_opencvs_types():
    assert BRIDGE.encoding_to_cvtype2("bgr8") == getCvType("8UC3") == cv2.CV_8UC3
    assert BRIDGE.encoding_to_cvtype2("64FC4") == cv2.CV_64FC4
    assert BRIDGE.encoding_to_cvtype2("bayer_rggb16") == cv2.CV_16UC1
    assert BRIDGE.encoding_to_dtype_with_channels("yuv422") == ("uint8", 2)
    assert BRIDGE.dtype_with_channels_to_cvtype2(np.dtype("float32"), 3) == "32FC3"
    assert BRIDGE.cvtype2_to_dtype_with_channels(cv2.CV_16SC2) == ("int16", 2)
    assert BRIDGE.cvtype2_to_dtype_with_channels(cv2.CV_8UC(7)) == ("uint8", 7)
    assert BRIDGE.cvtype_to_name[cv2.CV_32FC1] == "32FC1" and len(BRIDGE.cvtype_to_name) == 28
    assert BRIDGE.numpy_type_to_cvtype["uint8"] == "8U" and BRIDGE.numpy_type_to_cvtype["8U"] == "uint8"
    with pytest.raises(CvBridgeError):
        BRIDGE.cvtype2_to_dtype_with_channels(7)


# --- cvtColorForDisplay


@pytest.mark.parametrize(
    ("out", "shape"), [("bgr8", (2, 2, 3)), ("mono8", (2, 2)), ("bgra8", (2, 2, 4)), ("", (2, 2, 3))]
)
def test_a_constant_image_becomes_gray_with_the_desired_channels(out, shape):
    frame = cvtColorForDisplay(np.full((2, 2), 7, np.float32), "32FC1", out, do_dynamic_scaling=True)
    assert (frame.shape == shape and set(frame[..., :3].ravel()) == {128}) or out == "bgra8"
    assert out != "bgra8" or frame[0, 0].tolist() == [128, 128, 128, 255]


def test_scaling_stretches_the_finite_values():
    values = np.array([[1.0, 2.0, 3.0, np.nan, np.inf, -np.inf]], np.float32)
    frame = cvtColorForDisplay(values, "32FC1", "mono8", do_dynamic_scaling=True)
    assert frame.tolist() == [[0, 128, 255, 0, 255, 0]]
    colored = cvtColorForDisplay(values, "32FC1", "bgr8", True, colormap=cv2.COLORMAP_JET)
    jet = cv2.applyColorMap(np.array([[0, 128, 255]], np.uint8), cv2.COLORMAP_JET)
    assert (colored[0, :3] == jet[0]).all() and colored[0, 3].tolist() == [0, 0, 0]


def test_scaling_between_given_limits():
    depth = np.array([[0, 1000, 2000, 3000, 9000]], np.uint16)
    frame = cvtColorForDisplay(depth, "16UC1", "mono8", min_image_value=1000, max_image_value=3000)
    assert frame.tolist() == [[0, 0, 128, 255, 255]]
    signed = np.array([[-30000, 30000]], np.int16)
    assert cvtColorForDisplay(signed, "16SC1", "mono8", True).tolist() == [[0, 255]]


@pytest.mark.parametrize(
    ("encoding", "array_", "out", "expected"),
    [
        ("8UC1", BGR[..., 0], "mono8", BGR[..., 0]),
        ("8UC3", BGR, "bgr8", BGR),
        ("rgb8", BGR, "bgr8", BGR[..., ::-1]),
        ("16UC1", np.array([[257, 65535]], "u2"), "mono8", [[1, 255]]),
        ("mono8", BGR[..., :1], "bgr8", np.repeat(BGR[..., :1], 3, axis=2)),
    ],
)
def test_without_scaling_it_converts(encoding, array_, out, expected):
    frame = cvtColorForDisplay(array_, encoding, out)
    assert (frame == expected).all() and frame.flags.writeable and not np.shares_memory(frame, array_)


def test_every_label_has_its_own_color():
    labels = np.arange(-1, 256, dtype=np.int32).reshape(1, -1)
    colors = cvtColorForDisplay(labels, "32SC1", "bgr8")[0].tolist()
    assert colors[0] == [0, 0, 0] and len({tuple(color) for color in colors}) == 257


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((np.zeros((2, 2), "f4"), "32FC1", "bgr8"), "do_dynamic_scaling=True"),
        ((BGR, "bgr8", "mono16"), "encoding_out"),
        ((BGR, "bgr8", "8UC3"), "encoding_out"),
        ((BGR, "bgr8", "mono8", True), "one channel"),
        ((BGR, "mono8", "bgr8"), "'mono8' needs an array"),
    ],
)
def test_an_image_that_cannot_be_displayed_is_refused(arguments, words):
    with pytest.raises(CvBridgeError) as caught:
        cvtColorForDisplay(*arguments)
    assert words in str(caught.value)
