"""Typical mistakes of learners, each as a function that contains it.

`WRONG` maps the name of the right function to {name of the mistake: wrong function}. test_wrong_answers.py
checks that the tests of imaging detect every one of them.
"""

import numpy as np
from scipy import ndimage

WRONG = {}


def mistake(subject, name):
    """Register a wrong function under the name of the right one and the name of the mistake."""

    def register(function):
        WRONG.setdefault(subject, {})[name] = function
        return function

    return register


# Grayscale


@mistake("to_gray", "uint8 wraps in the products")
def _(bgr):
    blue, green, red = (bgr[..., k] for k in range(3))
    return ((blue * np.uint8(29) + green * np.uint8(150) + red * np.uint8(77)) >> np.uint8(7)).astype(
        np.uint8
    )


@mistake("to_gray", "weights swapped: blue as red")
def _(bgr):
    wide = bgr.astype(np.int64)
    return ((9798 * wide[..., 0] + 19235 * wide[..., 1] + 3735 * wide[..., 2] + 16384) >> 15).astype(np.uint8)


@mistake("to_gray", "truncated instead of rounded")
def _(bgr):
    wide = bgr.astype(np.int64)
    return ((3735 * wide[..., 0] + 19235 * wide[..., 1] + 9798 * wide[..., 2]) >> 15).astype(np.uint8)


@mistake("to_gray", "real weights, rounded")
def _(bgr):
    return np.rint(bgr @ np.array([0.114, 0.587, 0.299])).astype(np.uint8)


@mistake("to_gray", "real weights, truncated")
def _(bgr):
    return (bgr @ np.array([0.114, 0.587, 0.299])).astype(np.uint8)


@mistake("to_gray", "BT.709 weights")
def _(bgr):
    return np.rint(bgr @ np.array([0.0722, 0.7152, 0.2126])).astype(np.uint8)


@mistake("to_gray", "mean of the channels")
def _(bgr):
    return np.rint(bgr.mean(axis=2)).astype(np.uint8)


@mistake("to_gray", "one channel")
def _(bgr):
    return bgr[..., 1].copy()


@mistake("to_gray", "shifted one place too far")
def _(bgr):
    wide = bgr.astype(np.int64)
    return ((3735 * wide[..., 0] + 19235 * wide[..., 1] + 9798 * wide[..., 2] + 16384) >> 16).astype(np.uint8)


@mistake("average_gray", "uint8 wraps in the sum")
def _(bgr):
    return (bgr[..., 0] + bgr[..., 1] + bgr[..., 2]) // np.uint8(3)


@mistake("average_gray", "truncated instead of rounded")
def _(bgr):
    return (bgr.sum(axis=2) // 3).astype(np.uint8)


@mistake("lightness_gray", "uint8 wraps in the sum")
def _(bgr):
    return (bgr.max(axis=2) + bgr.min(axis=2)) // np.uint8(2)


@mistake("lightness_gray", "truncated instead of rounded")
def _(bgr):
    return ((bgr.max(axis=2).astype(int) + bgr.min(axis=2)) // 2).astype(np.uint8)


# Noise


@mistake("box_blur", "border zero instead of mirrored")
def _(gray):
    return _mean_of_nine(gray, "constant")


@mistake("box_blur", "border replicated instead of mirrored")
def _(gray):
    return _mean_of_nine(gray, "edge")


@mistake("box_blur", "mirrored with the outermost pixel twice")
def _(gray):
    return _mean_of_nine(gray, "symmetric")


@mistake("box_blur", "truncated instead of rounded")
def _(gray):
    return _windows(gray, "reflect").sum(axis=0, dtype=int).__floordiv__(9).astype(np.uint8)


@mistake("box_blur", "uint8 wraps in the sum")
def _(gray):
    return _windows(gray, "reflect").sum(axis=0, dtype=np.uint8) // np.uint8(9)


@mistake("box_blur", "the middle pixel left out")
def _(gray):
    return np.rint(np.delete(_windows(gray, "reflect"), 4, axis=0).mean(axis=0)).astype(np.uint8)


@mistake("gaussian_blur", "sigma taken for the variance")
def _(gray):
    return _rounded(ndimage.gaussian_filter(gray.astype(float), 1.4**0.5, mode="mirror"))


@mistake("gaussian_blur", "border zero instead of mirrored")
def _(gray):
    return _rounded(ndimage.gaussian_filter(gray.astype(float), 1.4, mode="constant"))


@mistake("gaussian_blur", "weights that add up to less than 1")
def _(gray):
    distance = np.arange(-4, 5)
    weights = np.exp(-(distance**2) / (2 * 1.4**2)) / (1.4 * np.sqrt(2 * np.pi))
    rows = ndimage.correlate1d(gray.astype(float), weights, axis=0, mode="mirror")
    return _rounded(ndimage.correlate1d(rows, weights, axis=1, mode="mirror") * 0.99)


@mistake("gaussian_blur", "along the rows only")
def _(gray):
    return _rounded(ndimage.gaussian_filter1d(gray.astype(float), 1.4, axis=1, mode="mirror"))


@mistake("median_blur", "mean instead of median")
def _(gray):
    return np.rint(_windows(gray, "edge").mean(axis=0)).astype(np.uint8)


@mistake("median_blur", "border zero instead of replicated")
def _(gray):
    return np.sort(_windows(gray, "constant"), axis=0)[4]


@mistake("median_blur", "border mirrored instead of replicated")
def _(gray):
    return np.sort(_windows(gray, "reflect"), axis=0)[4]


@mistake("median_blur", "not sorted: the middle pixel itself")
def _(gray):
    return _windows(gray, "edge")[4].copy()


@mistake("median_blur", "one off after sorting")
def _(gray):
    return np.sort(_windows(gray, "edge"), axis=0)[5]


@mistake("median_blur", "four neighbours instead of eight")
def _(gray):
    return np.sort(_windows(gray, "edge")[[1, 3, 4, 5, 7]], axis=0)[2]


@mistake("psnr", "uint8 wraps in the difference")
def _(reference, image):
    return _decibels(np.mean((reference - image).astype(float) ** 2))


@mistake("psnr", "uint8 wraps in the square")
def _(reference, image):
    difference = np.maximum(reference, image) - np.minimum(reference, image)
    return _decibels(np.mean(difference * difference))


@mistake("psnr", "20 log instead of 10 log")
def _(reference, image):
    return 2 * _decibels(np.mean((reference.astype(float) - image) ** 2))


@mistake("psnr", "peak of 1 instead of 255")
def _(reference, image):
    return _decibels(255**2 * np.mean((reference.astype(float) - image) ** 2))


@mistake("psnr", "mean absolute error")
def _(reference, image):
    return _decibels(np.mean(np.abs(reference.astype(float) - image)))


# Binarization


@mistake("threshold", ">= for >")
def _(gray, level):
    return np.where(gray >= level, 255, 0).astype(np.uint8)


@mistake("threshold", "black and white swapped")
def _(gray, level):
    return np.where(gray > level, 0, 255).astype(np.uint8)


@mistake("threshold", "1 for white")
def _(gray, level):
    return (gray > level).astype(np.uint8)


@mistake("otsu_threshold", "variance within, largest instead of smallest")
def _(gray):
    return _otsu(gray, lambda dark, bright: dark.size * dark.var() + bright.size * bright.var())


@mistake("otsu_threshold", "variance between, smallest instead of largest")
def _(gray):
    return _otsu(gray, lambda dark, bright: -dark.size * bright.size * (dark.mean() - bright.mean()) ** 2)


@mistake("otsu_threshold", "classes not weighted by their size")
def _(gray):
    return _otsu(gray, lambda dark, bright: (dark.mean() - bright.mean()) ** 2)


@mistake("otsu_threshold", "distance of the means not squared")
def _(gray):
    return _otsu(gray, lambda dark, bright: dark.size * bright.size * abs(dark.mean() - bright.mean()))


@mistake("otsu_threshold", "last of equal levels instead of first")
def _(gray):
    between = [_between(gray, level) for level in range(256)]
    return 255 - int(np.argmax(np.round(between[::-1], 6)))


@mistake("otsu_threshold", "the level itself counted as bright")
def _(gray):
    return int(np.argmax(np.round([_between(gray, level) for level in range(256)], 6))) + 1


@mistake("otsu_threshold", "mean of the image")
def _(gray):
    return round(float(gray.mean()))


@mistake("adaptive_threshold", "offset added instead of subtracted")
def _(gray):
    return np.where(gray > _local_mean(gray, "nearest") + 3, 255, 0).astype(np.uint8)


@mistake("adaptive_threshold", "border mirrored instead of replicated")
def _(gray):
    return np.where(gray > _local_mean(gray, "mirror") - 3, 255, 0).astype(np.uint8)


@mistake("adaptive_threshold", ">= for >")
def _(gray):
    return np.where(gray >= _local_mean(gray, "nearest") - 3, 255, 0).astype(np.uint8)


@mistake("adaptive_threshold", "mean of the whole image")
def _(gray):
    return np.where(gray > np.rint(gray.mean()) - 3, 255, 0).astype(np.uint8)


@mistake("adaptive_threshold", "uint8 wraps below the offset")
def _(gray):
    mean = _local_mean(gray, "nearest").astype(np.uint8)
    return np.where(gray > mean - np.uint8(3), 255, 0).astype(np.uint8)


# Canny, stage by stage


@mistake("sobel", "x and y swapped")
def _(gray):
    return _sobel(gray, "edge")[::-1]


@mistake("sobel", "convolution instead of correlation: signs flipped")
def _(gray):
    return tuple(-grad for grad in _sobel(gray, "edge"))


@mistake("sobel", "border zero instead of replicated")
def _(gray):
    return _sobel(gray, "constant")


@mistake("sobel", "border mirrored instead of replicated")
def _(gray):
    return _sobel(gray, "reflect")


@mistake("sobel", "uint8 wraps")
def _(gray):
    return tuple(grad.astype(np.uint8).astype(np.int32) for grad in _sobel(gray, "edge"))


@mistake("sobel", "clipped to 0..255")
def _(gray):
    return tuple(grad.clip(0, 255) for grad in _sobel(gray, "edge"))


@mistake("sobel", "Prewitt: no double weight in the middle")
def _(gray):
    return _sobel(gray, "edge", (1, 1, 1))


@mistake("sobel", "no smoothing across")
def _(gray):
    return _sobel(gray, "edge", (0, 4, 0))


@mistake("sobel", "Scharr's weights")
def _(gray):
    return _sobel(gray, "edge", (3, 10, 3))


@mistake("sobel", "divided by 8")
def _(gray):
    return tuple(grad // 8 for grad in _sobel(gray, "edge"))


@mistake("magnitude", "L2 norm instead of L1 norm")
def _(grad_row, grad_col):
    return np.sqrt(grad_row.astype(float) ** 2 + grad_col**2).astype(np.int32)


@mistake("magnitude", "no absolutes")
def _(grad_row, grad_col):
    return grad_row + grad_col


@mistake("magnitude", "absolute of the sum")
def _(grad_row, grad_col):
    return np.abs(grad_row + grad_col)


@mistake("magnitude", "larger of the two")
def _(grad_row, grad_col):
    return np.maximum(np.abs(grad_row), np.abs(grad_col))


@mistake("magnitude", "uint8 wraps")
def _(grad_row, grad_col):
    return (np.abs(grad_row) + np.abs(grad_col)).astype(np.uint8).astype(np.int32)


@mistake("magnitude", "clipped to 255")
def _(grad_row, grad_col):
    return (np.abs(grad_row) + np.abs(grad_col)).clip(0, 255)


@mistake("direction", "rows and columns swapped")
def _(grad_row, grad_col):
    return _sector(grad_col, grad_row)


@mistake("direction", "up for down: diagonals swapped")
def _(grad_row, grad_col):
    return _sector(-grad_row, grad_col)


@mistake("direction", "along the edge instead of across")
def _(grad_row, grad_col):
    return (_sector(grad_row, grad_col) + 2) % 4


@mistake("direction", "diagonals left out")
def _(grad_row, grad_col):
    return np.where(np.abs(grad_row) > np.abs(grad_col), 2, 0).astype(np.uint8)


@mistake("direction", "angle floored instead of rounded")
def _(grad_row, grad_col):
    angle = np.degrees(np.arctan2(grad_row, grad_col))
    return (np.floor(angle / 45) % 4).astype(np.uint8)


@mistake("direction", "opposite directions distinguished")
def _(grad_row, grad_col):
    angle = np.degrees(np.arctan2(grad_row, grad_col))
    return (np.round(angle / 45) % 8).astype(np.uint8)


@mistake("direction", "arctan of a ratio: division by zero taken for zero")
def _(grad_row, grad_col):
    ratio = np.divide(grad_row, grad_col, out=np.zeros(grad_row.shape), where=grad_col != 0)
    return (np.round(np.degrees(np.arctan(ratio)) / 45) % 4).astype(np.uint8)


@mistake("suppress", "against all 8 neighbours")
def _(magnitude, direction):
    largest = ndimage.maximum_filter(magnitude, 3, mode="constant")
    return np.where((magnitude == largest) & (magnitude > 0), magnitude, 0)


@mistake("suppress", ">= on both sides")
def _(magnitude, direction):
    return _suppress(
        magnitude,
        direction,
        lambda magnitude, behind, ahead, straight: (magnitude >= behind) & (magnitude >= ahead),
    )


@mistake("suppress", "> on both sides")
def _(magnitude, direction):
    return _suppress(
        magnitude,
        direction,
        lambda magnitude, behind, ahead, straight: (magnitude > behind) & (magnitude > ahead),
    )


@mistake("suppress", ">= on one side of diagonals too")
def _(magnitude, direction):
    return _suppress(
        magnitude,
        direction,
        lambda magnitude, behind, ahead, straight: (magnitude > behind) & (magnitude >= ahead),
    )


@mistake("suppress", "> and >= the other way round")
def _(magnitude, direction):
    def is_maximum(magnitude, behind, ahead, straight):
        return np.where(
            straight, (magnitude >= behind) & (magnitude > ahead), (magnitude > behind) & (magnitude > ahead)
        )

    return _suppress(magnitude, direction, is_maximum)


@mistake("suppress", "along the edge instead of across")
def _(magnitude, direction):
    return _suppress(magnitude, (direction + 2) % 4, _is_maximum)


@mistake("suppress", "diagonals swapped")
def _(magnitude, direction):
    return _suppress(magnitude, np.array([0, 3, 2, 1], np.uint8)[direction], _is_maximum)


@mistake("suppress", "one neighbour only")
def _(magnitude, direction):
    return _suppress(magnitude, direction, lambda magnitude, behind, ahead, straight: magnitude > behind)


@mistake("suppress", "the outermost pixels left out")
def _(magnitude, direction):
    thinned = np.zeros_like(magnitude)
    thinned[1:-1, 1:-1] = _suppress(magnitude, direction, _is_maximum)[1:-1, 1:-1]
    return thinned


@mistake("suppress", "the image wraps around at its border")
def _(magnitude, direction):
    return _suppress(magnitude, direction, _is_maximum, "wrap")


@mistake("suppress", "border replicated instead of zero")
def _(magnitude, direction):
    return _suppress(magnitude, direction, _is_maximum, "edge")


@mistake("suppress", "True and False instead of magnitudes")
def _(magnitude, direction):
    return (_suppress(magnitude, direction, _is_maximum) > 0).astype(magnitude.dtype)


@mistake("double_threshold", ">= for >")
def _(thinned, low, high):
    return (thinned >= low) & (thinned < high), thinned >= high


@mistake("double_threshold", "weak contains the strong pixels too")
def _(thinned, low, high):
    return thinned > low, thinned > high


@mistake("double_threshold", "a magnitude equal to high is neither weak nor strong")
def _(thinned, low, high):
    return (thinned > low) & (thinned < high), thinned > high


@mistake("double_threshold", "weak and strong swapped")
def _(thinned, low, high):
    return thinned > high, (thinned > low) & (thinned <= high)


@mistake("double_threshold", "one threshold: half-way")
def _(thinned, low, high):
    above = thinned > (low + high) / 2
    return np.zeros_like(above), above


@mistake("hysteresis", "4-connectivity")
def _(weak, strong):
    return _grow(weak, strong, ndimage.generate_binary_structure(2, 1), -1)


@mistake("hysteresis", "one step instead of until nothing changes")
def _(weak, strong):
    return _grow(weak, strong, np.ones((3, 3)), 1)


@mistake("hysteresis", "one sweep from top left")
def _(weak, strong):
    edges = np.pad(strong, 1)
    for row, col in np.argwhere(weak):
        edges[row + 1, col + 1] |= edges[row : row + 3, col : col + 3].any()
    return edges[1:-1, 1:-1].astype(np.uint8) * 255


@mistake("hysteresis", "strong pixels only")
def _(weak, strong):
    return strong.astype(np.uint8) * 255


@mistake("hysteresis", "all weak pixels")
def _(weak, strong):
    return (weak | strong).astype(np.uint8) * 255


@mistake("hysteresis", "grows beyond the weak pixels")
def _(weak, strong):
    return ndimage.binary_dilation(_grow(weak, strong, np.ones((3, 3)), -1)).astype(np.uint8) * 255


@mistake("hysteresis", "1 for an edge")
def _(weak, strong):
    return _grow(weak, strong, np.ones((3, 3)), -1) // 255


@mistake("hysteresis", "strong pixels lost while growing")
def _(weak, strong):
    return np.where(weak, _grow(weak, strong, np.ones((3, 3)), -1), 0).astype(np.uint8)


# Canny as a whole: these functions get the right stages of imaging and combine them wrongly.


@mistake("canny", "blur after gradient")
def _(gray, low, high, stages):
    grads = [ndimage.gaussian_filter(grad.astype(float), 1.4) for grad in stages.sobel(gray)]
    return _edges([np.rint(grad).astype(np.int32) for grad in grads], low, high, stages)


@mistake("canny", "no blur")
def _(gray, low, high, stages):
    return _edges(stages.sobel(gray), low, high, stages)


@mistake("canny", "blurred twice")
def _(gray, low, high, stages):
    return _edges(stages.sobel(stages.smooth(stages.smooth(gray, 1.4), 1.4)), low, high, stages)


@mistake("canny", "no suppression")
def _(gray, low, high, stages):
    magnitude = stages.magnitude(*stages.sobel(stages.smooth(gray, 1.4)))
    return stages.hysteresis(*stages.double_threshold(magnitude, low, high))


@mistake("canny", "no hysteresis: all above low")
def _(gray, low, high, stages):
    return _edges(stages.sobel(stages.smooth(gray, 1.4)), low, low, stages)


@mistake("canny", "no hysteresis: only above high")
def _(gray, low, high, stages):
    return _edges(stages.sobel(stages.smooth(gray, 1.4)), high, high, stages)


@mistake("canny", "x and y swapped in the direction only")
def _(gray, low, high, stages):
    grad_row, grad_col = stages.sobel(stages.smooth(gray, 1.4))
    thinned = stages.suppress(stages.magnitude(grad_row, grad_col), stages.direction(grad_col, grad_row))
    return stages.hysteresis(*stages.double_threshold(thinned, low, high))


@mistake("canny", "thresholds in gray levels: a quarter of the unit")
def _(gray, low, high, stages):
    return _edges(stages.sobel(stages.smooth(gray, 1.4)), low / 4, high / 4, stages)


@mistake("canny", "L2 for L1")
def _(gray, low, high, stages):
    grad_row, grad_col = stages.sobel(stages.smooth(gray, 1.4))
    magnitude = stages.magnitude(grad_row, grad_col, "L2")
    thinned = stages.suppress(magnitude, stages.direction(grad_row, grad_col))
    return stages.hysteresis(*stages.double_threshold(thinned, low, high))


# Shared by the wrong functions.


def _windows(gray, border):
    rows, cols = gray.shape
    wide = np.pad(gray, 1, mode=border)
    return np.stack([wide[i : i + rows, j : j + cols] for i in range(3) for j in range(3)])


def _mean_of_nine(gray, border):
    return np.rint(_windows(gray, border).mean(axis=0)).astype(np.uint8)


def _rounded(values):
    return np.rint(values).clip(0, 255).astype(np.uint8)


def _decibels(error):
    return np.inf if error == 0 else 10 * np.log10(255**2 / error)


def _between(gray, level):
    dark, bright = gray[gray <= level].astype(float), gray[gray > level].astype(float)
    if not dark.size or not bright.size:
        return 0.0
    return dark.size * bright.size * (dark.mean() - bright.mean()) ** 2 / gray.size**2


def _otsu(gray, score):
    scores = np.full(256, -np.inf)
    for level in range(256):
        dark, bright = gray[gray <= level].astype(float), gray[gray > level].astype(float)
        if dark.size and bright.size:
            scores[level] = score(dark, bright)
    return int(np.argmax(scores))


def _local_mean(gray, border):
    return np.rint(ndimage.uniform_filter(gray.astype(float), 7, mode=border))


def _sobel(gray, border, smoothing=(1, 2, 1)):
    wide = np.pad(gray.astype(np.int32), 1, mode=border)
    down, right = wide[2:] - wide[:-2], wide[:, 2:] - wide[:, :-2]
    weight = smoothing
    grad_row = weight[0] * down[:, :-2] + weight[1] * down[:, 1:-1] + weight[2] * down[:, 2:]
    grad_col = weight[0] * right[:-2] + weight[1] * right[1:-1] + weight[2] * right[2:]
    return grad_row, grad_col


def _sector(grad_row, grad_col):
    angle = np.degrees(np.arctan2(grad_row, grad_col))
    sector = (np.round(angle / 45) % 4).astype(np.uint8)
    sector[(grad_row == 0) & (grad_col == 0)] = 1
    return sector


def _is_maximum(magnitude, behind, ahead, straight):
    return (magnitude > behind) & np.where(straight, magnitude >= ahead, magnitude > ahead)


def _suppress(magnitude, direction, is_maximum, border="constant"):
    rows, cols = magnitude.shape
    wide = np.pad(magnitude, 1, mode=border)
    thinned = np.zeros_like(magnitude)
    for sector, (down, right) in enumerate([(0, 1), (1, 1), (1, 0), (1, -1)]):
        ahead = wide[1 + down : 1 + down + rows, 1 + right : 1 + right + cols]
        behind = wide[1 - down : 1 - down + rows, 1 - right : 1 - right + cols]
        keep = (direction == sector) & is_maximum(magnitude, behind, ahead, sector % 2 == 0)
        thinned[keep] = magnitude[keep]
    return thinned


def _grow(weak, strong, neighbours, steps):
    edges = ndimage.binary_dilation(strong, neighbours, iterations=steps, mask=weak | strong)
    return edges.astype(np.uint8) * 255


def _edges(gradient, low, high, stages):
    thinned = stages.suppress(stages.magnitude(*gradient), stages.direction(*gradient))
    return stages.hysteresis(*stages.double_threshold(thinned, low, high))
