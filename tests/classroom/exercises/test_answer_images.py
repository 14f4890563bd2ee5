"""Images of a call."""

import io

import numpy as np
import pytest
from nbclassroom.exercises.answer_images import answer_images, is_image
from nbclassroom.exercises.canonical import canonical
from PIL import Image


def pixels_of(image):
    return np.asarray(Image.open(io.BytesIO(image.png)))


def test_a_ring_marks_the_first_pixel_that_differs():
    gray = np.zeros((360, 640), np.uint8)
    wrong = np.zeros(gray.shape, bool)
    wrong[100, 500] = True
    form = canonical(gray)
    captions = [image.caption for image in answer_images(form, "[0]", form, form, wrong)]
    assert captions == [
        "given (black 0, white 1)",
        "returned [0] (black 0, white 1)",
        "expected [0] (black 0, white 1)",
        "red: differs (1 of 230400); the ring marks the first",
    ]
    difference = answer_images(None, "", form, form, wrong)[-1]
    assert (difference.width, difference.height) == (448, 252)
    ring_rows, ring_cols = np.nonzero((pixels_of(difference) == (239, 108, 0)).all(axis=2))
    assert abs(ring_rows.mean() - 100.5 * 0.7) < 1 and abs(ring_cols.mean() - 500.5 * 0.7) < 1
    assert ring_cols.max() - ring_cols.min() == pytest.approx(17, abs=2)


@pytest.mark.parametrize(
    ("shape", "drawn"),
    [((12, 12), False), ((13, 13), True), ((3, 100), False), ((20, 20, 3), True), ((20, 20, 2), False)],
)
def test_large_arrays_of_gray_levels_or_colours_are_images(shape, drawn):
    assert is_image(np.zeros(shape)) == drawn


def test_the_url_holds_the_png():
    form = canonical(np.zeros((20, 20), np.uint8))
    image = answer_images(form, "", None, None, None)[0]
    assert image.url.startswith("data:image/png;base64,iVBOR") and image.png.startswith(b"\x89PNG")
