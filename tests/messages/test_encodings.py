"""encoding_info: every name of sensor_msgs/image_encodings, and the error for a wrong name."""

import numpy as np
import pytest

from imgproc_course.messages import ConversionError, EncodingInfo, encoding_info


@pytest.mark.parametrize(
    ("name", "dtype", "channels", "color"),
    [
        ("bgr8", "uint8", 3, "bgr"),
        ("rgba16", "uint16", 4, "rgba"),
        ("mono16", "uint16", 1, "gray"),
        ("bayer_gbrg8", "uint8", 1, "bayer_gbrg"),
        ("yuv422", "uint8", 2, "uyvy"),
        ("uyvy", "uint8", 2, "uyvy"),
        ("yuv422_yuy2", "uint8", 2, "yuyv"),
        ("nv12", "uint8", 1, "nv12"),
        ("32FC1", "float32", 1, None),
        ("8U", "uint8", 1, None),
        ("16SC7", "int16", 7, None),
        ("8UC00003", "uint8", 3, None),
        ("64FC512", "float64", 512, None),
    ],
)
def test_the_meaning_of_a_name(name, dtype, channels, color):
    assert encoding_info(name) == EncodingInfo(name, np.dtype(dtype), channels, color)


def test_sizes():
    assert encoding_info("bgr16").pixel_bytes == 6
    assert encoding_info("bgr8").shape(4, 6) == (4, 6, 3)
    assert encoding_info("nv21").shape(4, 6) == (6, 6)
    assert encoding_info("nv24").shape(4, 6) == (12, 6)
    assert encoding_info("nv12").height(6) == 4 and encoding_info("mono8").height(6) == 6


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("BGR8", "did you mean 'bgr8'"),
        ("rgb8 ", "did you mean 'rgb8'"),
        ("gray8", "did you mean 'mono8'"),
        ("Greyscale16", "did you mean 'mono16'"),
        ("depth", "names are case-sensitive"),
        ("8uc3", "did you mean '8UC3'"),
        ("yuyv422", "did you mean 'yuyv'"),
        ("UYVY422", "did you mean 'uyvy'"),
        *((name, "ROS has no name for") for name in ("yuv420", "I420", "yv12", "NV16", "yuv444", "rgb565")),
        ("8UC", "unknown encoding '8UC'; did you mean"),
        ("16FC1", "did you mean"),
        ("8UC0", "0 channels; expected 1 to 512"),
        ("8UC513", "as in '8UC3'"),
        ("8UC" + "9" * 5000, "5003 in all"),
        ("8UC３", "unknown encoding"),
        ("", "unknown encoding ''"),
        (None, "got None"),
        (b"bgr8", "got b'bgr8'"),
        (["bgr8"], "got a list"),
    ],
)
def test_the_error_for_a_wrong_name_suggests_the_right_one(name, words):
    with pytest.raises(ConversionError) as caught:
        encoding_info(name)
    assert words in str(caught.value) and len(str(caught.value)) < 250
