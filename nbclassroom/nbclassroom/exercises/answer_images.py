"""Images of one call: the input, the returned and the expected values, and where they differ.

`check` and the graded report show the same images. They are drawn here, from pixels: no byte of a learner's
becomes part of a page.
"""

import base64
import io
from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageDraw

from .canonical import array_of, canonical
from .values import MOST_NUMBERS, answer_parts, differing_elements

_SMALLEST = 4  # rows and cols of an image
_SIDE = 200  # pixels on the page, about: a smaller image is enlarged by a whole factor
_LARGEST = 448
_EQUAL, _DIFFERS, _RING = (238, 240, 243), (200, 40, 40), (239, 108, 0)
_RING_RADIUS = 8  # pixels on the page, beside the enlarged pixel


@dataclass(frozen=True)
class AnswerImage:
    """An image of a value: a caption, an alternative text, its file, width and height in pixels."""

    caption: str
    alt: str
    png: bytes
    width: int
    height: int
    type: str

    @property
    def url(self):
        return f"data:{self.type};base64,{base64.b64encode(self.png).decode('ascii')}"


def answer_images(argument, name, expected, actual, wrong):
    """The input, the returned and the expected values and their difference as AnswerImages, if images."""
    argument, actual, expected = array_of(argument), array_of(actual), array_of(expected)
    images = [_draw_values("given", argument, _limits(argument))] if is_image(argument) else []
    answers = [values for values in (actual, expected) if is_image(values)]
    limits = _limits(*answers) if answers else None
    for label, values in (("returned", actual), ("expected", expected)):
        if is_image(values):
            images.append(_draw_values(f"{label} {name}".rstrip(), values, limits))
    if wrong is not None and is_image(actual) and wrong.any():
        images.append(_draw_difference(wrong))
    return images


def images_of_call(names, call):
    """The images of the first part of a CaseCall's answer that is a wrong image; else those that it got."""
    for part_name, expected, actual in answer_parts(call.expected.value, call.result.value):
        wrong = differing_elements(expected, actual, call.case.tolerance)
        if wrong is not None and wrong.any() and is_image(array_of(actual)):
            argument_form = canonical(call.arguments[0]) if call.arguments else None
            return answer_images(argument_form, part_name, expected, actual, wrong)
    images = [(name, value) for name, value in zip(names, call.arguments, strict=False) if is_image(value)]
    return [_draw_values(f"given {name}", value, _limits(value)) for name, value in images]


def is_image(values):
    """Whether values are drawn: (H, W), (H, W, 3) or (H, W, 4), and too many for a table of numbers."""
    if not isinstance(values, np.ndarray) or values.size <= MOST_NUMBERS:
        return False
    is_colour = values.ndim == 3 and values.shape[2] in (3, 4)
    return (values.ndim == 2 or is_colour) and min(values.shape[:2]) >= _SMALLEST


def _limits(*arrays):
    """The values drawn black and white; images that are compared share them."""
    values = np.concatenate([array.ravel() for array in arrays])
    if all(array.dtype == np.uint8 for array in arrays):
        return (0.0, 255.0) if values.max() > 1 else (0.0, 1.0)
    values = values[np.isfinite(values)]
    low, high = (float(values.min()), float(values.max())) if values.size else (0.0, 1.0)
    return (low, high) if high > low else (low, low + 1.0)


def _draw_values(caption, values, limits):
    low, high = limits
    if values.ndim == 3:
        values = values[..., 2::-1]  # blue, green, red as in the course's messages
    with np.errstate(all="ignore"):
        scaled = (values.astype(np.float64) - low) / (high - low) * 255.0
    pixels = np.clip(np.nan_to_num(scaled, posinf=255.0, neginf=0.0), 0, 255).round().astype(np.uint8)
    value_range = "" if (low, high) == (0.0, 255.0) else f" (black {low:.4g}, white {high:.4g})"
    rows, cols = pixels.shape[:2]
    alt = f"{caption}: {rows} rows, {cols} cols"
    return encode_image(f"{caption}{value_range}", alt, _fit_to_page(pixels), optimize=True)


def _draw_difference(wrong):
    """Red where a pixel differs, with a ring around the first one: a single pixel is easily overlooked."""
    differs = wrong.any(axis=2) if wrong.ndim == 3 else wrong
    row, col = (int(k) for k in np.argwhere(differs)[0])
    image = _fit_to_page(np.array([_EQUAL, _DIFFERS], np.uint8)[differs.astype(int)])
    scale = image.width / differs.shape[1]
    center = (col + 0.5) * scale, (row + 0.5) * scale
    ImageDraw.Draw(image).circle(center, _RING_RADIUS + scale, outline=_RING, width=2)
    count = int(differs.sum())
    caption = f"red: differs ({count} of {differs.size}); the ring marks the first"
    alt = f"{count} of {differs.size} pixels differ, the first at row {row}, col {col}"
    return encode_image(caption, alt, image, optimize=True)


def _fit_to_page(pixels):
    image = Image.fromarray(np.ascontiguousarray(pixels))
    factor = _SIDE // max(image.size)
    if factor > 1:
        return image.resize((image.width * factor, image.height * factor), Image.Resampling.NEAREST)
    if max(image.size) > _LARGEST:
        image.thumbnail((_LARGEST, _LARGEST), Image.Resampling.BOX)
    return image


def encode_image(caption, alt, image, width=None, kind="png", **options):
    """An image of Pillow's as an AnswerImage of this width on the page."""
    buffer, width = io.BytesIO(), width or image.width
    image.save(buffer, format=kind, **options)
    height = round(image.height * width / image.width)
    return AnswerImage(caption, alt, buffer.getvalue(), width, height, f"image/{kind}")
