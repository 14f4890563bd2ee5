"""The comparisons that the right functions pass detect every mistake in wrong_answers.py."""

import importlib.util
from pathlib import Path

import cv2
import numpy as np
import pytest

from imgproc_course import imaging


def _wrong_answers():
    path = Path(__file__).with_name("wrong_answers.py")
    spec = importlib.util.spec_from_file_location("wrong_answers", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


ANSWERS = _wrong_answers()
WRONG = ANSWERS.WRONG
ALL_MISTAKES = [(subject, name) for subject, mistakes in WRONG.items() for name in mistakes]


def opencvs_sobel(gray):
    options = {"ddepth": cv2.CV_32F, "ksize": 3, "borderType": cv2.BORDER_REPLICATE}
    return tuple(cv2.Sobel(gray, dx=dx, dy=1 - dx, **options).astype(np.int32) for dx in (0, 1))


def noisy(gray):
    return imaging.add_gaussian_noise(gray, 40)


def true_stages(gray):
    return imaging.canny_stages(gray, 100, 300)


# subject -> (right function, its arguments for a sample, the truth, from OpenCV if it has the function)
ON_BGR = {
    "to_gray": (imaging.to_gray, lambda bgr: cv2.cvtColor(bgr, cv2.COLOR_BGR2GRAY)),
    "average_gray": (imaging.average_gray, lambda bgr: np.rint(bgr.mean(axis=2)).astype(np.uint8)),
    "lightness_gray": (
        imaging.lightness_gray,
        lambda bgr: np.floor(bgr.max(axis=2) / 2 + bgr.min(axis=2) / 2 + 0.5).astype(np.uint8),
    ),
}
ON_GRAY = {
    "box_blur": (imaging.box_blur, lambda gray: (gray,), lambda gray: cv2.blur(gray, (3, 3))),
    "gaussian_blur": (
        lambda gray: imaging.gaussian_blur(gray, 1.4),
        lambda gray: (gray,),
        lambda gray: cv2.GaussianBlur(gray, (0, 0), 1.4),
    ),
    "median_blur": (imaging.median_blur, lambda gray: (gray,), lambda gray: cv2.medianBlur(gray, 3)),
    "psnr": (imaging.psnr, lambda gray: (gray, noisy(gray)), lambda gray: cv2.PSNR(gray, noisy(gray))),
    "threshold": (
        imaging.threshold,
        lambda gray: (gray, 90),
        lambda gray: cv2.threshold(gray, 90, 255, cv2.THRESH_BINARY)[1],
    ),
    "otsu_threshold": (
        imaging.otsu_threshold,
        lambda gray: (gray,),
        lambda gray: int(cv2.threshold(gray, 0, 255, cv2.THRESH_OTSU)[0]),
    ),
    "adaptive_threshold": (
        lambda gray: imaging.adaptive_threshold(gray, 7, 3),
        lambda gray: (gray,),
        lambda gray: cv2.adaptiveThreshold(gray, 255, cv2.ADAPTIVE_THRESH_MEAN_C, cv2.THRESH_BINARY, 7, 3),
    ),
    "sobel": (imaging.sobel, lambda gray: (gray,), opencvs_sobel),
    "magnitude": (imaging.magnitude, lambda gray: true_stages(gray)[1:3], lambda gray: true_stages(gray)[3]),
    "direction": (imaging.direction, lambda gray: true_stages(gray)[1:3], lambda gray: true_stages(gray)[4]),
    "suppress": (imaging.suppress, lambda gray: true_stages(gray)[3:5], lambda gray: true_stages(gray)[5]),
    "double_threshold": (
        imaging.double_threshold,
        lambda gray: (true_stages(gray).thinned, 100, 300),
        lambda gray: true_stages(gray)[6:8],
    ),
    "hysteresis": (
        imaging.hysteresis,
        lambda gray: true_stages(gray)[6:8],
        lambda gray: cv2.Canny(gray, 100, 300),
    ),
    "canny": (
        lambda gray, low, high, _: imaging.canny(gray, low, high, sigma=1.4),
        lambda gray: (gray, 40, 120, imaging),
        lambda gray: cv2.Canny(cv2.GaussianBlur(gray, (0, 0), 1.4), 40, 120),
    ),
}


def agree(result, truth):
    if isinstance(truth, float):
        return result == truth or abs(result - truth) < 1e-9
    if isinstance(truth, tuple):
        return all(agree(*pair) for pair in zip(result, truth, strict=True))
    return np.array_equal(result, truth)


def differing_samples(subject, function, grays, colours):
    """Names of the samples on which the result of the function differs from the truth."""
    if subject in ON_BGR:
        truth = ON_BGR[subject][1]
        return [name for name, bgr in colours.items() if not agree(function(bgr), truth(bgr.copy()))]
    _, arguments, truth = ON_GRAY[subject]
    return [name for name, gray in grays.items() if not agree(function(*arguments(gray)), truth(gray.copy()))]


@pytest.mark.parametrize("subject", [*ON_BGR, *ON_GRAY])
def test_the_right_function_is_right_on_every_sample(subject, grays, colours):
    right = (ON_BGR if subject in ON_BGR else ON_GRAY)[subject][0]
    assert differing_samples(subject, right, grays, colours) == []


@pytest.mark.parametrize(("subject", "name"), ALL_MISTAKES, ids=[" - ".join(pair) for pair in ALL_MISTAKES])
def test_the_mistake_is_detected(subject, name, grays, colours):
    samples = differing_samples(subject, WRONG[subject][name], grays, colours)
    print(f"{subject}: {name}: detected on {len(samples)} samples, first on {samples[:3]}")
    assert samples


def test_the_shared_helpers_are_right_without_a_mistake(grays):
    # Otherwise a mistake could be detected for another reason than the one in its name.
    for name, gray in grays.items():
        stages = true_stages(gray)
        right = {
            "mean of nine": (ANSWERS._mean_of_nine(gray, "reflect"), imaging.box_blur(gray)),
            "windows": (np.sort(ANSWERS._windows(gray, "edge"), axis=0)[4], imaging.median_blur(gray)),
            "local mean": (
                gray > ANSWERS._local_mean(gray, "nearest") - 3,
                imaging.adaptive_threshold(gray, 7, 3) > 0,
            ),
            "sobel": (ANSWERS._sobel(gray, "edge"), stages[1:3]),
            "sector": (ANSWERS._sector(stages.grad_row, stages.grad_col), stages.direction),
            "suppress": (ANSWERS._suppress(*stages[3:5], ANSWERS._is_maximum), stages.thinned),
            "grow": (ANSWERS._grow(stages.weak, stages.strong, np.ones((3, 3)), -1), stages.edges),
            "edges": (ANSWERS._edges(stages[1:3], 100, 300, imaging), stages.edges),
        }
        assert [helper for helper, (result, truth) in right.items() if not agree(result, truth)] == [], name
    noise = grays["noise"]
    best = max(range(256), key=lambda level: ANSWERS._between(noise, level))
    assert best == imaging.otsu_threshold(noise)


def test_every_subject_has_mistakes_and_a_truth():
    assert set(WRONG) == {*ON_BGR, *ON_GRAY}
    print(f"{len(ALL_MISTAKES)} mistakes in {len(WRONG)} subjects")
