"""Properties of every image: round trips, padding, both byte orders, any memory layout."""

from types import SimpleNamespace

import numpy as np
from compressed_depth import depth_to_compressed
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from imgproc_course.messages import (
    array_to_compressed,
    array_to_image,
    compressed_to_array,
    encoding_info,
    image_to_array,
)
from imgproc_course.messages.encodings import ENCODINGS

profile = settings(max_examples=60)
names = st.sampled_from([*ENCODINGS, "8UC5", "16SC9", "32FC70"])
HEADER = array_to_image(np.zeros((1, 1), np.uint8)).header


@st.composite
def images(draw, encodings=names):
    """(encoding, array) of any size from 0, in any byte order and memory layout."""
    name = draw(encodings)
    info = encoding_info(name)
    even = 2 if info.is_planar else 1
    height, width = (draw(st.integers(0, 4)) * even for _ in range(2))
    values = draw(npst.arrays(info.dtype, info.shape(height, width)))
    values = values.astype(info.dtype.newbyteorder(draw(st.sampled_from("<>"))))
    layout = draw(st.sampled_from(["C", "F", "reversed", "sliced"]))
    if layout == "F":
        values = np.asfortranarray(values)
    elif layout == "reversed":
        values = values[::-1, ::-1].copy()[::-1, ::-1]
    elif layout == "sliced":
        values = np.repeat(values, 2, axis=1)[:, ::2]
    return name, values


def same(a, b):
    """Whether the bytes in native order are equal: NaN equals NaN, and -0.0 differs from 0.0."""
    a, b = (x.astype(x.dtype.newbyteorder("=")) for x in (a, b))
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


@profile
@given(images())
def test_there_and_back(image):
    name, values = image
    before = values.tobytes()
    msg = array_to_image(values, name, HEADER)
    assert msg.header is HEADER and msg.encoding == name
    assert len(msg.data) == msg.step * encoding_info(name).rows(msg.height)
    assert same(image_to_array(msg), values)
    assert same(image_to_array(msg, name), values)
    assert values.tobytes() == before


@profile
@given(images(), st.integers(1, 9), st.data())
def test_padding_changes_nothing(image, padding, data):
    name, values = image
    msg = array_to_image(values, name)
    info = encoding_info(name)
    step = msg.step + padding
    if name == "nv24":
        luma = np.frombuffer(msg.data, "u1")[: msg.height * msg.width].reshape(msg.height, msg.width)
        chroma = np.frombuffer(msg.data, "u1")[msg.height * msg.width :].reshape(msg.height, 2 * msg.width)
        filled = [np.full((msg.height, step), 7, "u1"), np.full((msg.height, 2 * step), 7, "u1")]
        filled[0][:, : msg.width], filled[1][:, : 2 * msg.width] = luma, chroma
        padded = b"".join(part.tobytes() for part in filled)
    else:
        rows = np.full((info.rows(msg.height), step), 7, "u1")
        rows[:, : msg.step] = np.frombuffer(msg.data, "u1").reshape(info.rows(msg.height), msg.step)
        padded = rows.tobytes()
    fields = {field: getattr(msg, field) for field in ("height", "width", "encoding", "is_bigendian")}
    assert same(image_to_array(SimpleNamespace(step=step, data=padded, **fields)), values)


@profile
@given(images(st.sampled_from(["rgb8", "bgra8", "rgba16", "mono8", "mono16", "16UC1"])))
def test_png_there_and_back(image):
    name, values = image
    if values.size:
        assert same(compressed_to_array(array_to_compressed(values, name, "png"), name), values)


@profile
@given(images(st.just("16UC1")), st.sampled_from(["png", "rvl"]))
def test_depth_there_and_back(image, format):
    _, values = image
    if values.size:
        assert same(compressed_to_array(depth_to_compressed(values, format=format)), values)


@profile
@given(images(st.sampled_from(["rgb8", "bgr8", "rgba8", "bgra8", "mono8"])))
def test_colors_survive_16_bits_and_the_other_order(image):
    name, values = image
    other = {"rgb8": "bgr16", "bgr8": "rgb16", "rgba8": "bgra16", "bgra8": "rgba16", "mono8": "mono16"}[name]
    wide = image_to_array(array_to_image(values, name), other)
    assert same(image_to_array(array_to_image(wide, other), name), values)
