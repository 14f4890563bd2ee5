"""What a function cannot work on raises; the message says what came, what was expected, and the remedy."""

from types import SimpleNamespace

import numpy as np
import pytest

from imgproc_course.imaging import (
    adaptive_threshold,
    add_gaussian_noise,
    add_salt_and_pepper,
    average_gray,
    bilateral_filter,
    box_blur,
    canny,
    canny_stages,
    gaussian_blur,
    gaussian_weights,
    lightness_gray,
    linear_light,
    linear_light_gray,
    median_blur,
    otsu_threshold,
    psnr,
    smooth,
    sobel,
    srgb_levels,
    ssim,
    threshold,
    to_gray,
)

ON_GRAY = {
    "sobel": sobel,
    "canny": lambda gray: canny(gray, 50, 150),
    "canny, smoothed": lambda gray: canny(gray, 50, 150, sigma=1.0),
    "canny_stages": lambda gray: canny_stages(gray, 50, 150),
    "canny_stages, smoothed": lambda gray: canny_stages(gray, 50, 150, sigma=1.0),
    "smooth": smooth,
    "threshold": lambda gray: threshold(gray, 100),
    "otsu_threshold": otsu_threshold,
    "adaptive_threshold": lambda gray: adaptive_threshold(gray, 5, 2),
    "bilateral_filter": lambda gray: bilateral_filter(gray, 20, 2),
}
ON_BGR = {
    "to_gray": to_gray,
    "average_gray": average_gray,
    "lightness_gray": lightness_gray,
    "linear_light_gray": linear_light_gray,
}
ON_BOTH = {
    "box_blur": box_blur,
    "gaussian_blur": lambda picture: gaussian_blur(picture, 1.0),
    "median_blur": median_blur,
    "add_gaussian_noise": lambda picture: add_gaussian_noise(picture, 5),
    "add_salt_and_pepper": lambda picture: add_salt_and_pepper(picture, 0.1),
    "psnr": lambda picture: psnr(picture, picture),
    "ssim": lambda picture: ssim(picture, picture),
}
EVERY = {**ON_GRAY, **ON_BGR, **ON_BOTH}

FIRST = "make it uint8 first: its values go from 0 to 0, so "
WRONG_DTYPES = {
    "float64": FIRST + r"np.rint\((\w+) \* 255\).astype\(np.uint8\)",
    "float32": FIRST + r"np.rint\((\w+) \* 255\).astype\(np.uint8\)",
    "float16": FIRST + r"np.rint\((\w+) \* 255\).astype\(np.uint8\)",
    "uint16": FIRST + r"\w+.astype\(np.uint8\)",
    "int8": FIRST + r"\w+.astype\(np.uint8\)",
    "int16": FIRST + r"\w+.astype\(np.uint8\)",
    "int32": FIRST + r"\w+.astype\(np.uint8\)",
    "uint32": FIRST + r"\w+.astype\(np.uint8\)",
    "int64": FIRST + r"\w+.astype\(np.uint8\)",
    "bool": r"make True white: \w+.astype\(np.uint8\) \* 255",
    "complex64": "scale real numbers to 0..255 and make them uint8 first",
    "object": "scale real numbers to 0..255 and make them uint8 first",
}


def picture_for(name, dtype=np.uint8):
    return np.zeros((9, 9, 3) if name in ON_BGR else (9, 9), dtype)


@pytest.mark.parametrize("dtype", WRONG_DTYPES)
@pytest.mark.parametrize("name", EVERY)
def test_every_dtype_but_uint8_raises_with_the_cure(name, dtype):
    with pytest.raises(ValueError, match=rf"must be .* uint8.*, got .* {dtype}; {WRONG_DTYPES[dtype]}$"):
        EVERY[name](picture_for(name, dtype))


@pytest.mark.parametrize("name", EVERY)
def test_what_is_no_plain_array_raises_with_the_cure(name):
    good = picture_for(name)
    with pytest.raises(ValueError, match=r"got a list; make an array of it: np.array\(.*, dtype=np.uint8\)"):
        EVERY[name](good.tolist())
    with pytest.raises(ValueError, match="got None; look at what made it"):
        EVERY[name](None)
    with pytest.raises(ValueError, match=r"masked array; its mask would be lost: .*filled\(0\)"):
        EVERY[name](np.ma.masked_less(good, 5))
    EVERY[name](good)


@pytest.mark.parametrize(
    ("values", "remedy"),
    [
        (np.array([0.0, 0.8]), "its values go from 0 to 0.8, so np.rint(bgr * 255).astype(np.uint8)"),
        (np.array([0.0, 200.4]), "its values go from 0 to 200.4, so np.rint(bgr).astype(np.uint8)"),
        (
            np.array([-3.0, 300.0]),
            "its values go from -3 to 300, so np.clip(np.rint(bgr), 0, 255).astype(np.uint8)",
        ),
        (np.array([0, 255]), "its values go from 0 to 255, so bgr.astype(np.uint8)"),
        (np.array([0, 256]), "its values go from 0 to 256, so np.clip(bgr, 0, 255).astype(np.uint8)"),
        (
            np.uint16([0, 65535]),
            "its values go from 0 to 65535, so (bgr >> 8).astype(np.uint8) when it uses all 16 bits,"
            " or np.clip(bgr, 0, 255).astype(np.uint8)",
        ),
    ],
)
def test_the_cure_for_numbers_of_another_type_fits_their_range(values, remedy):
    frame = np.resize(values, (4, 5, 3))
    with pytest.raises(ValueError) as error:
        to_gray(frame)
    given = f"bgr must be (H, W, 3) uint8, got (4, 5, 3) {values.dtype}; make it uint8 first: "
    assert str(error.value) == given + remedy
    # The remedy is code: what it makes is taken.
    for each in remedy.partition(", so ")[2].replace(" when it uses all 16 bits,", "").split(" or "):
        assert to_gray(eval(each, {"np": np, "bgr": frame})).shape == (4, 5)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_what_is_no_number_is_to_be_replaced_first(value):
    with pytest.raises(ValueError, match=r"no number, or infinite, first: np.nan_to_num\(gray\)"):
        sobel(np.array([[value, 1.0]]))


@pytest.mark.parametrize(
    ("message", "remedy"),
    [
        (SimpleNamespace(encoding="rgb8", data=b""), "image_to_array"),
        (SimpleNamespace(format="jpeg", data=b""), "compressed_to_array"),
    ],
)
def test_a_message_for_a_frame_is_told_how_to_become_one(message, remedy):
    with pytest.raises(ValueError) as error:
        to_gray(message)
    assert str(error.value) == (
        "bgr must be (H, W, 3) uint8, got a message (SimpleNamespace); take its pixels first:"
        f" {remedy}(bgr, 'bgr8')"
    )
    with pytest.raises(ValueError, match=rf"{remedy}\(gray, 'mono8'\)"):
        sobel(message)


def test_anything_else_for_a_frame_is_shown():
    with pytest.raises(ValueError, match=r"got 'frame.png' of type str; give the array of a picture"):
        to_gray("frame.png")


@pytest.mark.parametrize("name", EVERY)
@pytest.mark.parametrize("shape", [(0, 5), (5, 0), (0, 0)])
def test_an_empty_picture_raises(name, shape):
    with pytest.raises(ValueError, match="it has no pixel"):
        EVERY[name](np.zeros((*shape, 3) if name in ON_BGR else shape, np.uint8))


@pytest.mark.parametrize("name", EVERY)
@pytest.mark.parametrize("shape", [(), (5,), (5, 5, 2), (2, 5, 5, 3)])
def test_a_wrong_number_of_axes_or_channels_raises(name, shape):
    with pytest.raises(ValueError, match=r"must be .* uint8"):
        EVERY[name](np.zeros(shape, np.uint8))


@pytest.mark.parametrize("name", ON_GRAY)
def test_colour_for_gray_names_to_gray(name):
    with pytest.raises(ValueError, match=r"got \(5, 5, 3\) uint8; make it gray first: to_gray\(gray\)"):
        ON_GRAY[name](np.zeros((5, 5, 3), np.uint8))


@pytest.mark.parametrize("name", ON_BGR)
def test_gray_for_colour_and_a_fourth_channel_raise(name):
    with pytest.raises(ValueError, match="it is gray already"):
        ON_BGR[name](np.zeros((5, 5), np.uint8))
    with pytest.raises(ValueError, match=r"drop the fourth channel: bgr\[..., :3\]"):
        ON_BGR[name](np.zeros((5, 5, 4), np.uint8))


GRAY = np.zeros((9, 9), np.uint8)
BAD_NUMBERS = {
    "aperture 4": (lambda: sobel(GRAY, 4), "aperture must be 3, 5 or 7"),
    "aperture 3.0": (lambda: canny(GRAY, 1, 2, aperture=3.0), "aperture must be 3, 5 or 7"),
    "aperture [3]": (lambda: canny_stages(GRAY, 1, 2, aperture=[3]), "aperture must be 3, 5 or 7"),
    "aperture 9": (lambda: canny(GRAY, 1, 2, aperture=9), "aperture must be 3, 5 or 7"),
    "low NaN": (lambda: canny(GRAY, np.nan, 2), "low must be a number, got nan"),
    "high text": (lambda: canny_stages(GRAY, 1, "2"), "high must be a number, got '2'"),
    "high bool": (lambda: canny(GRAY, 0, True), "high must be a number, got True"),
    "sigma below 0": (lambda: canny(GRAY, 1, 2, sigma=-1), "sigma must be a number, at least 0"),
    "sigma infinite": (lambda: gaussian_blur(GRAY, np.inf), "sigma must be a number, got inf"),
    "no sigma, no size": (lambda: gaussian_weights(0), "sigma must be above 0 when no size is given"),
    "even size": (lambda: box_blur(GRAY, 4), "size must be an odd whole number"),
    "size 0": (lambda: median_blur(GRAY, 0), "size must be an odd whole number"),
    "size with a fraction": (lambda: gaussian_blur(GRAY, 1, 3.5), "size must be an odd whole number"),
    "adaptive size 1": (lambda: adaptive_threshold(GRAY, 1, 0), "at least 3"),
    "adaptive weights": (lambda: adaptive_threshold(GRAY, 3, 0, weights="box"), 'weights must be "mean"'),
    "level NaN": (lambda: threshold(GRAY, np.nan), "level must be a number"),
    "sigma_color 0": (lambda: bilateral_filter(GRAY, 0, 3), "sigma_color must be above 0"),
    "sigma_space -1": (lambda: bilateral_filter(GRAY, 3, -1), "sigma_space must be above 0"),
    "noise sigma": (lambda: add_gaussian_noise(GRAY, -1), "sigma must be a number, at least 0"),
    "fraction 5": (lambda: add_salt_and_pepper(GRAY, 5), "5 percent are 0.05"),
    "two shapes": (lambda: psnr(GRAY, GRAY[1:]), r"must have one shape, got \(9, 9\) and \(8, 9\)"),
    "ssim of colour": (lambda: ssim(np.zeros((9, 9, 3), np.uint8), np.zeros((9, 9, 3), np.uint8)), "to_gray"),
    "ssim of a crumb": (lambda: ssim(GRAY[:5], GRAY[:5]), "at least 7×7 pixels"),
    "float levels": (lambda: linear_light(np.zeros(3)), "levels must be uint8"),
    "light NaN": (lambda: srgb_levels(np.array([np.nan])), "nan_to_num"),
}


@pytest.mark.parametrize("case", BAD_NUMBERS)
def test_a_bad_parameter_raises_with_the_cure(case):
    call, text = BAD_NUMBERS[case]
    with pytest.raises(ValueError, match=text) as error:
        call()
    assert ";" in str(error.value) and "\n" not in str(error.value)
