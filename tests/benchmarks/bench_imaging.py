"""to_gray and canny compared with OpenCV and scikit-image, on frames of the drive.

python tests/benchmarks/bench_imaging.py     prints tables of ratios; exits 1 if one exceeds its budget
"""

import argparse
import math
import sys
import time

import cv2
import skimage.feature
from rich.console import Console
from side_by_side import print_ratios, time_in_turns

from imgproc_course import imaging
from imgproc_course.recording import open_recording

THRESHOLDS = [(50, 150), (100, 200)]
CANNY_BUDGET = 4  # times cv2.Canny
SKIMAGE_BUDGET = 1 / 8  # of the time of skimage.feature.canny
GRAY_BUDGET = 6  # times cv2.cvtColor
TURN_SECONDS = 0.02


def frames_of_the_drive():
    """A frame near the start, in the middle and near the end, each (720, 1280, 3) uint8."""
    with open_recording("drive") as drive:
        return [drive.frame(round(share * (len(drive) - 1))) for share in (0.1, 0.5, 0.9)]


def on_all(function, images):
    """Return a function without arguments that calls the function on every image."""

    def way():
        for image in images:
            function(image)

    return way


def median_seconds(ways, rounds):
    """Return a dict: name -> median seconds per call; each turn lasts 20 ms or more.

    A busy machine interrupts long turns more often than short ones. With turns of equal length the ratios
    remain correct.
    """
    calls = {}
    for name, way in ways.items():
        way()
        start = time.perf_counter()
        way()
        calls[name] = math.ceil(TURN_SECONDS / (time.perf_counter() - start))
    turns = {name: on_all(lambda _, way=way: way(), range(calls[name])) for name, way in ways.items()}
    return {name: seconds / calls[name] for name, seconds in time_in_turns(turns, rounds=rounds).items()}


def compare(title, ways, images, rounds, budgets=None):
    """Time each way on all images; the first way is the peer. Return the names that exceed their budget."""
    medians = median_seconds({name: on_all(way, images) for name, way in ways.items()}, rounds)
    medians = {name: seconds / len(images) for name, seconds in medians.items()}
    over_budget = print_ratios(title, medians, next(iter(ways)), budgets)
    return [f"{title}: {name}" for name in over_budget]


def bench_gray(frames, rounds):
    ways = {
        "cv2": lambda frame: cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY),
        "to_gray": imaging.to_gray,
        "average_gray": imaging.average_gray,
        "lightness_gray": imaging.lightness_gray,
    }
    return compare("gray, 1280×720", ways, frames, rounds, {"to_gray": GRAY_BUDGET})


def bench_canny(grays, rounds):
    over_budget = []
    for low, high in THRESHOLDS:
        ways = {
            "cv2": lambda gray, low=low, high=high: cv2.Canny(gray, low, high),
            "canny": lambda gray, low=low, high=high: imaging.canny(gray, low, high),
            "canny_stages": lambda gray, low=low, high=high: imaging.canny_stages(gray, low, high),
        }
        title = f"Canny {low}/{high}, aperture 3, L1, 1280×720"
        over_budget += compare(title, ways, grays, rounds, {"canny": CANNY_BUDGET})
    for aperture, scale in ((3, 1), (5, 12), (7, 160)):
        for l2 in (False, True):
            if (aperture, l2) == (3, False):
                continue
            options = {"apertureSize": aperture, "L2gradient": l2}
            our_options = {"aperture": aperture, "l2_gradient": l2}
            pair = (50 * scale, 150 * scale)
            ways = {
                "cv2": lambda gray, pair=pair, options=options: cv2.Canny(gray, *pair, **options),
                "canny": lambda gray, pair=pair, our_options=our_options: imaging.canny(
                    gray, *pair, **our_options
                ),
            }
            title = f"Canny {pair[0]}/{pair[1]}, aperture {aperture}, {'L2' if l2 else 'L1'}"
            compare(title, ways, grays, rounds)
    return over_budget


def bench_canny_against_skimage(grays, rounds):
    # scikit-image always smooths, and compares the L2 norm of Sobel / 4: 100/200 here is 25/50 there.
    def skimage_canny(gray):
        return skimage.feature.canny(gray, sigma=1.0, low_threshold=25, high_threshold=50)

    ways = {
        "skimage": skimage_canny,
        "canny": lambda gray: imaging.canny(gray, 100, 200),
        "canny, sigma=1": lambda gray: imaging.canny(gray, 100, 200, sigma=1.0),
        "canny, sigma=1, L2": lambda gray: imaging.canny(gray, 100, 200, sigma=1.0, l2_gradient=True),
    }
    budgets = dict.fromkeys(["canny", "canny, sigma=1"], SKIMAGE_BUDGET)  # the L2 norm has none
    return compare(
        "Canny compared with skimage.feature.canny, 1280×720", ways, grays, max(3, rounds // 5), budgets
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=25, help="timed turns of each way (default 25)")
    options = parser.parse_args()
    cv2.setNumThreads(1)

    frames = frames_of_the_drive()
    grays = [cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY) for frame in frames]
    over_budget = bench_gray(frames, options.rounds)
    over_budget += bench_canny(grays, options.rounds)
    over_budget += bench_canny_against_skimage(grays, options.rounds)
    console = Console()
    for name in over_budget:
        console.print(f"over its budget: {name}", style="red")
    return 1 if over_budget else 0


if __name__ == "__main__":
    sys.exit(main())
