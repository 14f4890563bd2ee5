"""The results of the real cv_bridge for 4569 messages and arrays, and every intended difference from them.

cv_bridge_golden.json.gz: cases and results of cv_bridge 1.16.2 (the same code as Jazzy's) under OpenCV 4.6.
cv_bridge_pairs.csv.gz: the outcome of Jazzy's cv_bridge 4.1.0 for every pair of encodings, with yuv422_yuy2.
"""

import array
import base64
import csv
import gzip
import json
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from imgproc_course.messages import ConversionError, array_to_image, encoding_info, image_to_array

HERE = Path(__file__).parent
NEW_NAMES = {"uyvy", "yuyv", "nv21", "nv24"}


def is_small_bayer(case):
    is_small = case["kind"] == "image" and min(case["height"], case["width"]) < 3
    return (
        is_small
        and case["encoding"].startswith("bayer_")
        and encoding_info(case["desired"]).color is not None
    )


def is_float_to_integer(case, outcome):
    is_float = case["kind"] == "image" and case["encoding"][:3] in ("32F", "64F")
    return is_float and outcome[0] == "array" and np.dtype(outcome[1]).kind in "iu"


def same_mosaic(case):
    names = case["encoding"], case.get("desired", "")
    return all(name.startswith("bayer_") for name in names) and names[0][:10] == names[1][:10]


# name -> (reason, whether it applies to a case). An outcome is ("array" | "message" | "raise", ...).
DIFFERENCES = {
    "a Bayer image with a side under 3": (
        "cv_bridge returns an image of zeros without an error; here a ConversionError says that 3 are needed",
        lambda case, expected, actual: (
            expected[0] == "array" and not any(expected[-1]) and actual[0] == "raise" and is_small_bayer(case)
        ),
    ),
    "float beyond int32 to an integer": (
        "cv_bridge turns +inf and values from 2**31 on into the lowest value; here they saturate",
        lambda case, expected, actual: expected[:3] == actual[:3] and is_float_to_integer(case, actual),
    ),
    "uyvy and yuyv": (
        "cv_bridge does not know these names, which replace the deprecated yuv422 and yuv422_yuy2",
        lambda case, expected, actual: (
            expected[0] == "raise"
            and actual[0] != "raise"
            and NEW_NAMES & {case["encoding"], case.get("desired")}
        ),
    ),
    "a depth alone": (
        "cv_bridge reads '8U' but converts it to nothing but itself; here it is 8UC1 everywhere",
        lambda case, expected, actual: (
            expected[0] == "raise"
            and actual[0] == "array"
            and {"8U", "16U", "16S", "32F", "64F"} & {case["encoding"], case.get("desired")}
        ),
    ),
    "one mosaic in another depth": (
        "cv_bridge refuses bayer_rggb8 -> bayer_rggb16 and back; here its values scale like others",
        lambda case, expected, actual: expected[0] == "raise" and actual[0] == "array" and same_mosaic(case),
    ),
}


CONTAINERS = {
    "array": lambda data: array.array("B", data),
    "bytes": bytes,
    "bytearray": bytearray,
    "memoryview": memoryview,
    "ndarray": lambda data: np.frombuffer(data, np.uint8),
    "list": list,
    "tuple": tuple,
}


def from_base64(field):
    return base64.b64decode(field["b64"])


def message_of(case):
    fields = ("encoding", "height", "width", "step", "is_bigendian")
    data = CONTAINERS[case["container"]](from_base64(case["data"]))
    return SimpleNamespace(**{field: case[field] for field in fields}, data=data)


def array_of(case):
    """The case's array, in the memory layout that it asks for."""
    values = np.frombuffer(from_base64(case["data"]), case["dtype"]).reshape(case["shape"])
    if case["layout"] == "every-other-column":
        wide = np.repeat(values, 2, axis=1)
        return wide[:, ::2]
    return {
        "C": lambda: values,
        "F": lambda: np.asfortranarray(values),
        "rows-reversed": lambda: values[::-1].copy()[::-1],
        "channels-reversed": lambda: values[..., ::-1].copy()[..., ::-1],
        "big-endian": lambda: values.astype(values.dtype.newbyteorder(">")),
    }[case["layout"]]()


def actual_outcome(case):
    try:
        if case["kind"] == "image":
            frame = image_to_array(message_of(case), case["desired"])
            return "array", frame.dtype.str, list(frame.shape), frame.tobytes()
        msg = array_to_image(array_of(case), case["encoding"])
        return (
            *("message", msg.height, msg.width, msg.encoding, bool(msg.is_bigendian), msg.step),
            bytes(msg.data),
        )
    except ConversionError as error:
        assert len(str(error)) > 30
        return ("raise",)


def expected_outcome(answer):
    if answer[0] == "raise":
        return ("raise",)
    return (*answer[:-1], from_base64(answer[-1]))


@pytest.fixture(scope="module")
def outcomes():
    """(case, expected, actual, names of the table's rows that it falls under) of every golden case."""
    with gzip.open(HERE / "cv_bridge_golden.json.gz") as file:
        golden = json.load(file)
    compared = []
    for case, answer in zip(golden["cases"], golden["answers"], strict=True):
        if (
            answer[0] == "skip"
        ):  # yuv422_yuy2, which that version does not know: cv_bridge_pairs.csv covers it
            continue
        expected, actual = expected_outcome(answer), actual_outcome(case)
        rows = [name for name, (_, applies) in DIFFERENCES.items() if applies(case, expected, actual)]
        compared.append((case, expected, actual, rows))
    return compared


def test_every_case_outside_the_table_is_equal(outcomes, capsys):
    equal = sum(expected == actual for _, expected, actual, _ in outcomes)
    by_row = Counter(row for _, expected, actual, rows in outcomes if expected != actual for row in rows)
    with capsys.disabled():
        print(f"\n{len(outcomes)} golden cases, {equal} equal, {by_row.total()} in the table: {dict(by_row)}")
    unexplained = [
        (case, expected, actual)
        for case, expected, actual, rows in outcomes
        if expected != actual and not rows
    ]
    assert unexplained == []
    assert equal + by_row.total() == len(outcomes) == 4442  # each difference falls under one row only


@pytest.mark.parametrize("row", DIFFERENCES)
def test_every_row_of_the_table_is_a_real_difference(outcomes, row):
    assert [case for case, expected, actual, rows in outcomes if row in rows and expected != actual]


def test_floats_differ_only_beyond_int32(outcomes):
    """The one difference in values: they are equal wherever int32 can hold the rounded float."""
    checked = 0
    for case, expected, actual, rows in outcomes:
        if rows != ["float beyond int32 to an integer"]:
            continue
        floats = image_to_array(message_of(case))
        dtype, shape = np.dtype(actual[1]), actual[2]
        expected, actual = (
            np.frombuffer(outcome[-1], dtype).reshape(shape) for outcome in (expected, actual)
        )
        is_held = np.isnan(floats) | (np.abs(np.rint(floats.astype("f8"))) < 2**31)
        assert (expected == actual)[is_held].all()
        assert (actual[floats >= 2**31] == np.iinfo(dtype).max).all()
        assert (actual[floats < -(2**31)] == np.iinfo(dtype).min).all()
        checked += (floats >= 2**31).sum()
    assert checked > 1000


def pairs():
    with gzip.open(HERE / "cv_bridge_pairs.csv.gz", "rt", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def small_message(encoding):
    info = encoding_info(encoding)
    step = 4 * info.pixel_bytes
    data = bytes(info.rows(4) * step)
    return SimpleNamespace(encoding=encoding, height=4, width=4, step=step, is_bigendian=0, data=data)


@pytest.mark.parametrize("source", sorted({row["source"] for row in pairs()}))
def test_every_pair_converts_or_is_refused_as_in_cv_bridge(source):
    for row in (row for row in pairs() if row["source"] == source):
        desired = row["desired"]
        try:
            frame = image_to_array(small_message(source), desired)
        except ConversionError:
            assert row["outcome"] != "array", row
            continue
        if row["outcome"] != "array":  # cv_bridge refuses it: only the rows of the table may convert
            assert NEW_NAMES & {source, desired} or same_mosaic({"encoding": source, "desired": desired}), row
            continue
        channels = frame.shape[2] if frame.ndim == 3 else 1
        assert (frame.dtype.name, channels) == (row["dtype"], int(row["channels"])), row


def test_the_table_has_all_pairs():
    assert len(pairs()) == 2756
