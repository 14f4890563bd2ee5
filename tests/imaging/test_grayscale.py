"""Luma equals OpenCV's; the other grays follow their formulas."""

import cv2
import numpy as np

from imgproc_course.imaging import average_gray, lightness_gray, linear_light_gray, to_gray


def every_colour():
    """Yield all 16,777,216 colours of 8 bits per channel as 256 frames of shape (256, 256, 3)."""
    frame = np.empty((256, 256, 3), np.uint8)
    frame[..., 1], frame[..., 2] = np.mgrid[:256, :256]
    for blue in range(256):
        frame[..., 0] = blue
        yield frame


def test_luma_equals_opencvs_on_every_colour(count):
    for frame in every_colour():
        count.compare(to_gray(frame), cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), frame[0, 0])
    assert count.pixels == 16_777_216
    count.report("to_gray on all colours")


def test_luma_equals_opencvs_for_every_memory_layout(colours, frames, count):
    for name, frame in [*colours.items(), *enumerate(frames)]:
        before = frame.copy()
        gray = to_gray(frame)
        count.compare(gray, cv2.cvtColor(np.ascontiguousarray(frame), cv2.COLOR_BGR2GRAY), name)
        assert np.array_equal(frame, before), name
        assert gray.flags.c_contiguous and gray.flags.writeable, name
    count.report("to_gray on images")


def test_average_is_the_nearest_level_to_the_mean():
    for frame in every_colour():
        if frame[0, 0, 0] % 15 == 0:
            assert np.array_equal(average_gray(frame), np.rint(frame.mean(axis=2)))


def test_lightness_is_the_mean_of_the_extremes_rounded_half_up():
    for frame in every_colour():
        if frame[0, 0, 0] % 15 == 0:
            middle = (frame.max(axis=2) / 2) + (frame.min(axis=2) / 2)
            assert np.array_equal(lightness_gray(frame), np.floor(middle + 0.5))


def test_the_other_grays_do_not_change_their_input(colours):
    for name, frame in colours.items():
        for convert in (average_gray, lightness_gray, linear_light_gray):
            before = frame.copy()
            gray = convert(frame)
            assert gray.dtype == np.uint8 and gray.shape == frame.shape[:2], name
            assert np.array_equal(frame, before), name
            assert np.array_equal(gray, convert(before)), name


def test_gamma_makes_luma_of_saturated_colours_too_dark():
    gray = np.repeat(np.arange(256, dtype=np.uint8)[None, :, None], 3, axis=2)
    assert np.array_equal(linear_light_gray(gray), to_gray(gray))
    red, green, blue = ([[[0, 0, 255]]], [[[0, 255, 0]]], [[[255, 0, 0]]])
    assert [int(linear_light_gray(np.uint8(colour))[0, 0]) for colour in (red, green, blue)] == [127, 220, 76]
    assert [int(to_gray(np.uint8(colour))[0, 0]) for colour in (red, green, blue)] == [76, 150, 29]
