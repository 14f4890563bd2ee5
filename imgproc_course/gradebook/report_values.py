"""Values in a report: an answer's canonical form as a small table, a line of words, or a picture.

Pictures are drawn here from pixels; no byte of a learner's becomes part of a page.
"""

import base64
import io
from dataclasses import dataclass

import numpy as np
from PIL import Image

from imgproc_course.exercises.canonical import array_of
from imgproc_course.exercises.values import MOST_NUMBERS, in_words, rows_of
from imgproc_course.gradebook.sanitize import visible_line

_SMALLEST = 4  # rows and cols of a picture
_SIDE = 200  # pixels on the page, about: a small picture is made larger by whole factors
_LARGEST = 448
_WORDS = 400
_BEHIND, _DIFFERS = (238, 240, 243), (200, 40, 40)


@dataclass(frozen=True)
class Value:
    """A value to be shown: `label`, `words`, and `rows` of (text, marked), empty where words are enough."""

    label: str
    words: str
    rows: tuple = ()


@dataclass(frozen=True)
class Picture:
    """A picture to be shown: `data` is a data: URL of a PNG drawn here."""

    caption: str
    alt: str
    data: str
    width: int
    height: int


def value_of(label, form, wrong=None):
    """How a canonical form is shown.

    Parameters
    ----------
    label : str, "came back"
    form : dict, canonical form, or None where nothing came back
    wrong : bool array, which elements differ, or None

    Returns
    -------
    Value
    """
    if form is None:
        return Value(label, "nothing came back")
    return Value(label, visible_line(in_words(form), _WORDS), rows_of(form, wrong))


# ---------------------------------------------------------------- pictures


def pictures_of(given, name, expected, actual, wrong):
    """What was given, came back, was expected, and where the two differ, as pictures.

    Parameters
    ----------
    given : canonical form, or None where it is not to be shown
    name : str, the part of the answer
    expected, actual : canonical forms, or None
    wrong : bool array, from `wrong_of`, or None

    Returns
    -------
    list of Picture, empty where nothing is a picture
    """
    given, actual, expected = array_of(given), array_of(actual), array_of(expected)
    pictures = [_picture("given", given, _limits(given))] if _is_picture(given) else []
    shown = [values for values in (actual, expected) if _is_picture(values)]
    limits = _limits(*shown) if shown else None
    for caption, values in (("came back", actual), ("expected", expected)):
        if _is_picture(values):
            pictures.append(_picture(f"{caption}{name}", values, limits))
    if wrong is not None and _is_picture(actual) and wrong.any():
        pictures.append(_difference(wrong))
    return pictures


def _is_picture(values):
    if not isinstance(values, np.ndarray) or values.size <= MOST_NUMBERS:
        return False
    colours = values.ndim == 3 and values.shape[2] in (3, 4)
    return (values.ndim == 2 or colours) and min(values.shape[:2]) >= _SMALLEST


def _limits(*arrays):
    """What is black and what is white: the same for pictures that are to be compared."""
    if all(values.dtype == np.uint8 for values in arrays):
        highest = max(int(values.max()) for values in arrays)
        return (0.0, 255.0) if highest > 1 else (0.0, 1.0)
    finite = [values[np.isfinite(values)] for values in arrays]
    finite = [values for values in finite if values.size]
    if not finite:
        return 0.0, 1.0
    low, high = min(float(v.min()) for v in finite), max(float(v.max()) for v in finite)
    return (low, high) if high > low else (low, low + 1.0)


def _picture(caption, values, limits):
    low, high = limits
    if values.ndim == 3:
        values = values[..., 2::-1]  # blue, green, red as in the course's messages
    with np.errstate(all="ignore"):
        scaled = (values.astype(np.float64) - low) / (high - low) * 255.0
    pixels = np.clip(np.nan_to_num(scaled, posinf=255.0, neginf=0.0), 0, 255).round().astype(np.uint8)
    range_told = "" if (low, high) == (0.0, 255.0) else f" (black {low:.4g}, white {high:.4g})"
    rows, cols = pixels.shape[:2]
    return _encoded(f"{caption}{range_told}", f"{caption}: {rows} rows, {cols} cols", pixels)


def _difference(wrong):
    where = wrong.any(axis=2) if wrong.ndim == 3 else wrong
    pixels = np.where(where[..., np.newaxis], np.uint8(_DIFFERS), np.uint8(_BEHIND))
    row, col = (int(k) for k in np.argwhere(where)[0])
    count = int(where.sum())
    return _encoded(
        f"red: differs ({count} of {where.size})",
        f"{count} of {where.size} pixels differ, the first at row {row}, col {col}",
        pixels,
    )


def _encoded(caption, alt, pixels):
    image = Image.fromarray(np.ascontiguousarray(pixels))
    factor = _SIDE // max(image.size)
    if factor > 1:
        image = image.resize((image.width * factor, image.height * factor), Image.Resampling.NEAREST)
    elif max(image.size) > _LARGEST:
        image.thumbnail((_LARGEST, _LARGEST), Image.Resampling.BOX)
    buffer = io.BytesIO()
    image.save(buffer, format="png", optimize=True)
    data = base64.b64encode(buffer.getvalue()).decode("ascii")
    return Picture(caption, alt, f"data:image/png;base64,{data}", image.width, image.height)
