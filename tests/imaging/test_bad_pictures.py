"""What a function cannot work on raises; the message says what came, what was expected, and the cure."""

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

WRONG_DTYPES = {
    "float64": "scale it to uint8 first",
    "float32": "scale it to uint8 first",
    "float16": "scale it to uint8 first",
    "uint16": "scale it to uint8 first",
    "int8": "np.clip",
    "int16": "np.clip",
    "int32": "np.clip",
    "uint32": "np.clip",
    "int64": "np.clip",
    "bool": r"astype\(np.uint8\) \* 255",
    "complex64": "scale real numbers",
    "object": "scale real numbers",
}


def picture_for(name, dtype=np.uint8):
    return np.zeros((9, 9, 3) if name in ON_BGR else (9, 9), dtype)


@pytest.mark.parametrize("dtype", WRONG_DTYPES)
@pytest.mark.parametrize("name", EVERY)
def test_every_dtype_but_uint8_raises_with_the_cure(name, dtype):
    with pytest.raises(ValueError, match=rf"must be .* uint8.*, got .* {dtype}; .*{WRONG_DTYPES[dtype]}"):
        EVERY[name](picture_for(name, dtype))


@pytest.mark.parametrize("name", EVERY)
def test_what_is_no_plain_array_raises_with_the_cure(name):
    good = picture_for(name)
    with pytest.raises(ValueError, match=r"got a list; make an array of it: np.array\(.*, dtype=np.uint8\)"):
        EVERY[name](good.tolist())
    with pytest.raises(ValueError, match="got a NoneType"):
        EVERY[name](None)
    with pytest.raises(ValueError, match=r"masked array; its mask would be lost: .*filled\(0\)"):
        EVERY[name](np.ma.masked_less(good, 5))
    EVERY[name](good)


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
