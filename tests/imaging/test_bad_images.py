"""Bad input raises ValueError. The message states what was passed, what was expected, and the remedy."""

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
    lightness_gray,
    linear_light_gray,
    median_blur,
    otsu_threshold,
    psnr,
    sobel,
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
    "gaussian_blur": lambda image: gaussian_blur(image, 1.0),
    "median_blur": median_blur,
    "add_gaussian_noise": lambda image: add_gaussian_noise(image, 5),
    "add_salt_and_pepper": lambda image: add_salt_and_pepper(image, 0.1),
    "psnr": lambda image: psnr(image, image),
    "ssim": lambda image: ssim(image, image),
}
ALL_FUNCTIONS = {**ON_GRAY, **ON_BGR, **ON_BOTH}

CONVERT = "convert it to uint8 first: its values go from 0 to 0, so "
FLOATS, INTEGERS = ("float64", "float32", "float16"), ("uint16", "int8", "int16", "int32", "uint32", "int64")
WRONG_DTYPES = {
    **dict.fromkeys(FLOATS, CONVERT + r"np.rint\((\w+) \* 255\).astype\(np.uint8\)"),
    **dict.fromkeys(INTEGERS, CONVERT + r"\w+.astype\(np.uint8\)"),
    "bool": r"make True white: \w+.astype\(np.uint8\) \* 255",
    "complex64": "scale real numbers to 0..255 and convert them to uint8 first",
    "object": "scale real numbers to 0..255 and convert them to uint8 first",
}


def image_for(name, dtype=np.uint8):
    return np.zeros((9, 9, 3) if name in ON_BGR else (9, 9), dtype)


@pytest.mark.parametrize("dtype", WRONG_DTYPES)
@pytest.mark.parametrize("name", ALL_FUNCTIONS)
def test_every_dtype_except_uint8_raises_with_the_remedy(name, dtype):
    with pytest.raises(ValueError, match=rf"must be .* uint8.*, got .* {dtype}; {WRONG_DTYPES[dtype]}$"):
        ALL_FUNCTIONS[name](image_for(name, dtype))


@pytest.mark.parametrize("name", ALL_FUNCTIONS)
def test_a_value_that_is_not_a_plain_array_raises_with_the_remedy(name):
    good = image_for(name)
    with pytest.raises(
        ValueError, match=r"got a list; convert it to an array: np.array\(.*, dtype=np.uint8\)"
    ):
        ALL_FUNCTIONS[name](good.tolist())
    with pytest.raises(ValueError, match="got None; check the code that made it"):
        ALL_FUNCTIONS[name](None)
    with pytest.raises(ValueError, match=r"masked array; its mask would be lost: .*filled\(0\)"):
        ALL_FUNCTIONS[name](np.ma.masked_less(good, 5))
    ALL_FUNCTIONS[name](good)


@pytest.mark.parametrize(
    ("values", "remedy"),
    [
        (np.array([0.0, 1.0]), "its values go from 0 to 1, so np.rint(bgr * 255).astype(np.uint8)"),
        (np.array([0.0, 200.4]), "its values go from 0 to 200.4, so np.rint(bgr).astype(np.uint8)"),
        (
            np.array([-3.0, 300.0]),
            "its values go from -3 to 300, so np.clip(np.rint(bgr), 0, 255).astype(np.uint8)",
        ),
        (np.array([0, 255]), "its values go from 0 to 255, so bgr.astype(np.uint8)"),
        (np.array([0, 256]), "its values go from 0 to 256, so np.clip(bgr, 0, 255).astype(np.uint8)"),
        (
            np.uint16([0, 65535]),
            "its values go from 0 to 65535, so (bgr >> 8).astype(np.uint8) if it uses all 16 bits,"
            " or np.clip(bgr, 0, 255).astype(np.uint8)",
        ),
    ],
)
def test_the_remedy_for_another_dtype_fits_the_range_of_the_values(values, remedy):
    frame = np.resize(values, (4, 5, 3))
    with pytest.raises(ValueError) as error:
        to_gray(frame)
    complaint = f"bgr must be (H, W, 3) uint8, got (4, 5, 3) {values.dtype}; convert it to uint8 first: "
    assert str(error.value) == complaint + remedy
    # The remedy is code: to_gray accepts its result.
    for expression in remedy.partition(", so ")[2].replace(" if it uses all 16 bits,", "").split(" or "):
        assert to_gray(eval(expression, {"np": np, "bgr": frame})).shape == (4, 5)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_the_remedy_for_nan_and_infinity_is_to_replace_them(value):
    with pytest.raises(ValueError, match=r"replace NaN and infinite values first: np.nan_to_num\(gray\)"):
        sobel(np.array([[value, 1.0]]))


@pytest.mark.parametrize(
    ("message", "remedy"),
    [
        (SimpleNamespace(encoding="rgb8", data=b""), "image_to_array"),
        (SimpleNamespace(format="jpeg", data=b""), "compressed_to_array"),
    ],
)
def test_a_message_instead_of_an_image_names_its_converter(message, remedy):
    with pytest.raises(ValueError) as error:
        to_gray(message)
    assert str(error.value) == (
        "bgr must be (H, W, 3) uint8, got a message (SimpleNamespace); convert it first:"
        f" {remedy}(bgr, 'bgr8')"
    )
    with pytest.raises(ValueError, match=rf"{remedy}\(gray, 'mono8'\)"):
        sobel(message)


def test_any_other_value_instead_of_an_image_is_shown():
    with pytest.raises(ValueError, match=r"got 'frame.png' of type str; pass the array of an image"):
        to_gray("frame.png")


@pytest.mark.parametrize("name", ALL_FUNCTIONS)
@pytest.mark.parametrize("shape", [(0, 5), (5, 0), (0, 0)])
def test_an_empty_image_raises(name, shape):
    with pytest.raises(ValueError, match="it has no pixels"):
        ALL_FUNCTIONS[name](np.zeros((*shape, 3) if name in ON_BGR else shape, np.uint8))


@pytest.mark.parametrize("name", ALL_FUNCTIONS)
@pytest.mark.parametrize("shape", [(), (5,), (5, 5, 2), (2, 5, 5, 3)])
def test_a_wrong_number_of_axes_or_channels_raises(name, shape):
    with pytest.raises(ValueError, match=r"must be .* uint8"):
        ALL_FUNCTIONS[name](np.zeros(shape, np.uint8))


@pytest.mark.parametrize("name", ON_GRAY)
def test_a_colour_image_instead_of_a_gray_one_names_to_gray(name):
    with pytest.raises(ValueError, match=r"got \(5, 5, 3\) uint8; make it gray first: to_gray\(gray\)"):
        ON_GRAY[name](np.zeros((5, 5, 3), np.uint8))


@pytest.mark.parametrize("name", ON_BGR)
def test_a_gray_image_and_a_fourth_channel_raise_where_colour_is_expected(name):
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
    # cv2.Canny swaps them silently, so a learner would not notice the mistake.
    "low above high": (lambda: canny(GRAY, 150, 50), "must not be above high, got low=150, high=50; swap"),
    "high below low": (lambda: canny_stages(GRAY, 150, 50), "got low=150, high=50; swap them"),
    "sigma below 0": (lambda: canny(GRAY, 1, 2, sigma=-1), "sigma must be a number, at least 0"),
    "sigma infinite": (lambda: gaussian_blur(GRAY, np.inf), "sigma must be a number, got inf"),
    "no sigma, no size": (lambda: gaussian_blur(GRAY, 0), "sigma must be above 0 if size is omitted"),
    "even size": (lambda: box_blur(GRAY, 4), "size must be an odd whole number"),
    "size 0": (lambda: median_blur(GRAY, 0), "size must be an odd whole number"),
    "size with a fraction": (lambda: gaussian_blur(GRAY, 1, 3.5), "size must be an odd whole number"),
    "adaptive size 1": (lambda: adaptive_threshold(GRAY, 1, 0), "at least 3"),
    "level NaN": (lambda: threshold(GRAY, np.nan), "level must be a number"),
    "sigma_color 0": (lambda: bilateral_filter(GRAY, 0, 3), "sigma_color must be above 0"),
    "sigma_space -1": (lambda: bilateral_filter(GRAY, 3, -1), "sigma_space must be above 0"),
    "noise sigma": (lambda: add_gaussian_noise(GRAY, -1), "sigma must be a number, at least 0"),
    "fraction 5": (lambda: add_salt_and_pepper(GRAY, 5), "5 percent are 0.05"),
    "two shapes": (lambda: psnr(GRAY, GRAY[1:]), r"must have the same shape, got \(9, 9\) and \(8, 9\)"),
    "ssim of colour": (lambda: ssim(np.zeros((9, 9, 3), np.uint8), np.zeros((9, 9, 3), np.uint8)), "to_gray"),
    "ssim of a small image": (lambda: ssim(GRAY[:5], GRAY[:5]), "at least 7×7 pixels"),
}


@pytest.mark.parametrize("case", BAD_NUMBERS)
def test_a_bad_parameter_raises_with_the_remedy(case):
    call, text = BAD_NUMBERS[case]
    with pytest.raises(ValueError, match=text) as error:
        call()
    assert ";" in str(error.value) and "\n" not in str(error.value)
