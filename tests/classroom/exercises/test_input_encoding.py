"""Arguments reach the kernel exactly."""

import json
import types

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst
from nbclassroom.exercises.canonical import decode, encode

NUMBERS = st.one_of(
    npst.integer_dtypes(endianness="?"), npst.floating_dtypes(endianness="?"), npst.boolean_dtypes()
)
ARRAYS = NUMBERS.flatmap(
    lambda dtype: npst.arrays(dtype, npst.array_shapes(min_dims=0, min_side=0, max_side=4))
)
LEAVES = st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(), st.binary(), ARRAYS)
VALUES = st.recursive(
    LEAVES,
    lambda inner: st.one_of(
        st.lists(inner, max_size=3),
        st.lists(inner, max_size=3).map(tuple),
        st.dictionaries(st.text(max_size=3), inner, max_size=3),
        st.dictionaries(st.from_regex(r"[a-z]{1,3}", fullmatch=True), inner, max_size=3).map(
            lambda fields: types.SimpleNamespace(**fields)
        ),
    ),
    max_leaves=8,
)


def same(one, other):
    if type(one) is not type(other):
        return False
    if isinstance(one, np.ndarray):
        return (one.dtype, one.shape, one.tobytes()) == (other.dtype, other.shape, other.tobytes())
    if isinstance(one, types.SimpleNamespace):
        return same(vars(one), vars(other))
    if isinstance(one, dict):
        return list(one) == list(other) and all(same(one[key], other[key]) for key in one)
    if isinstance(one, (list, tuple)):
        return len(one) == len(other) and all(map(same, one, other))
    return repr(one) == repr(other)


@given(VALUES)
def test_a_value_is_decoded_unchanged(value):
    assert same(decode(json.loads(json.dumps(encode(value)))), value)


def test_layout_and_byte_order_survive():
    columns = np.asfortranarray(np.arange(6, dtype=">u2").reshape(2, 3))
    back = decode(encode(columns))
    assert back.flags.f_contiguous and not back.flags.c_contiguous
    assert back.dtype.str == ">u2"
    assert back.flags.writeable
    assert back.tolist() == columns.tolist()
    assert type(decode(encode(np.float32(0.1)))) is np.float32


@pytest.mark.parametrize("value", [print, object(), np.array([object()]), {1, 2}, np.ma.masked_array([1])])
def test_a_value_that_is_not_data_is_named(value):
    with pytest.raises(TypeError, match="cannot be sent to a kernel as data; use numbers"):
        encode([value])
