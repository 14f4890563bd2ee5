"""The functions of imaging compared with OpenCV and scikit-image, on frames of the drive.

python tests/benchmarks/bench_imaging.py            tables of ratios; exits 1 if one exceeds its budget
python tests/benchmarks/bench_imaging.py --growth   also draws growth_imaging.png, times by size
"""

import argparse
import math
import sys
import time
from pathlib import Path

import cv2
import numpy as np
import skimage.feature
import skimage.metrics
from matplotlib.figure import Figure
from rich.console import Console
from side_by_side import print_ratios, time_in_turns

from imgproc_course import imaging
from imgproc_course.recording import open_recording

THRESHOLDS = [(50, 150), (100, 200)]
CANNY_BUDGET = 4  # times cv2.Canny
SKIMAGE_BUDGET = 1 / 8  # of the time of skimage.feature.canny
GRAY_BUDGET = 6  # times cv2.cvtColor
TURN_SECONDS = 0.02
SIZES = [(160, 120), (320, 240), (640, 480), (1280, 720), (1920, 1080), (2560, 1440), (3840, 2160)]
GROWTH = Path(__file__).with_name("growth_imaging.png")


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
        "linear_light_gray": imaging.linear_light_gray,
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


def bench_filters(grays, rounds):
    pairs = {
        "box 5": (lambda g: cv2.blur(g, (5, 5)), lambda g: imaging.box_blur(g, 5)),
        "Gaussian, sigma 1.4": (
            lambda g: cv2.GaussianBlur(g, (0, 0), 1.4),
            lambda g: imaging.gaussian_blur(g, 1.4),
        ),
        "median 3": (lambda g: cv2.medianBlur(g, 3), lambda g: imaging.median_blur(g, 3)),
        "median 5": (lambda g: cv2.medianBlur(g, 5), lambda g: imaging.median_blur(g, 5)),
        "bilateral 5": (
            lambda g: cv2.bilateralFilter(g, 5, 30, 2),
            lambda g: imaging.bilateral_filter(g, 30, 2, 5),
        ),
        "Sobel 3": (
            lambda g: (cv2.Sobel(g, cv2.CV_32F, 0, 1), cv2.Sobel(g, cv2.CV_32F, 1, 0)),
            lambda g: imaging.sobel(g),
        ),
        "fixed threshold": (
            lambda g: cv2.threshold(g, 100, 255, cv2.THRESH_BINARY),
            lambda g: imaging.threshold(g, 100),
        ),
        "Otsu": (
            lambda g: cv2.threshold(g, 0, 255, cv2.THRESH_OTSU),
            lambda g: imaging.threshold(g, imaging.otsu_threshold(g)),
        ),
        "adaptive mean 31": (
            lambda g: cv2.adaptiveThreshold(g, 255, cv2.ADAPTIVE_THRESH_MEAN_C, cv2.THRESH_BINARY, 31, 5),
            lambda g: imaging.adaptive_threshold(g, 31, 5),
        ),
        "adaptive Gaussian 31": (
            lambda g: cv2.adaptiveThreshold(g, 255, cv2.ADAPTIVE_THRESH_GAUSSIAN_C, cv2.THRESH_BINARY, 31, 5),
            lambda g: imaging.adaptive_threshold(g, 31, 5, weights="gaussian"),
        ),
        "PSNR": (lambda g: cv2.PSNR(g, g[::-1]), lambda g: imaging.psnr(g, g[::-1])),
    }
    for name, (opencv, by_hand) in pairs.items():
        compare(f"{name}, 1280×720", {"cv2": opencv, "ours": by_hand}, grays, max(3, rounds // 4))
    similarity = {
        "skimage": lambda g: skimage.metrics.structural_similarity(g, g[::-1], data_range=255),
        "ours": lambda g: imaging.ssim(g, g[::-1]),
    }
    compare("SSIM, 1280×720", similarity, grays[:1], 3)


def measure_growth(frame):
    """Return a dict: name of a function -> milliseconds at each of SIZES."""
    ways = {
        "canny 100/200": lambda _, gray: imaging.canny(gray, 100, 200),
        "cv2.Canny 100/200": lambda _, gray: cv2.Canny(gray, 100, 200),
        "to_gray": lambda bgr, _: imaging.to_gray(bgr),
        "cv2.cvtColor": lambda bgr, _: cv2.cvtColor(bgr, cv2.COLOR_BGR2GRAY),
        "gaussian_blur 1.4": lambda _, gray: imaging.gaussian_blur(gray, 1.4),
        "cv2.GaussianBlur 1.4": lambda _, gray: cv2.GaussianBlur(gray, (0, 0), 1.4),
        "threshold, Otsu": lambda _, gray: imaging.threshold(gray, imaging.otsu_threshold(gray)),
        "cv2.threshold, Otsu": lambda _, gray: cv2.threshold(gray, 0, 255, cv2.THRESH_OTSU),
    }
    growth = {name: [] for name in ways}
    for cols, rows in SIZES:
        bgr = cv2.resize(frame, (cols, rows), interpolation=cv2.INTER_AREA)
        gray = cv2.cvtColor(bgr, cv2.COLOR_BGR2GRAY)
        bound = {name: lambda way=way, bgr=bgr, gray=gray: way(bgr, gray) for name, way in ways.items()}
        for name, seconds in median_seconds(bound, 7).items():
            growth[name].append(seconds * 1e3)
    return growth


def draw_growth(growth, path):
    """Draw one measurement in two panels: milliseconds per image, and nanoseconds per pixel."""
    pixels = np.array([cols * rows for cols, rows in SIZES])
    figure = Figure(figsize=(11, 4.6), layout="constrained")
    per_image, per_pixel = figure.subplots(1, 2)
    for k, (name, milliseconds) in enumerate(growth.items()):
        style = {"color": f"C{k // 2}", "linestyle": "--" if name.startswith("cv2") else "-", "marker": "."}
        per_image.loglog(pixels / 1e6, milliseconds, **style, label=name)
        per_pixel.loglog(pixels / 1e6, np.array(milliseconds) * 1e6 / pixels, **style)
    per_image.axhline(1000 / 30, color="gray", linewidth=0.8)
    per_image.annotate("one frame at 30 Hz", (pixels[0] / 1e6, 1000 / 30), va="bottom", color="gray")
    per_image.set(title="time per image", xlabel="size of the image", ylabel="milliseconds")
    per_pixel.set(title="time per pixel", xlabel="size of the image", ylabel="nanoseconds")
    for axes in (per_image, per_pixel):
        axes.set_xticks(pixels / 1e6, [f"{cols}×{rows}" for cols, rows in SIZES], rotation=60, fontsize=7)
        axes.minorticks_off()
        axes.grid(alpha=0.3)
    per_image.legend(fontsize=7)
    figure.suptitle("A frame of the drive at seven sizes, one thread; dashed: OpenCV")
    figure.savefig(path, dpi=72, pil_kwargs={"optimize": True})


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--growth", action="store_true", help=f"also draw {GROWTH.name}")
    parser.add_argument("--rounds", type=int, default=25, help="timed turns of each way (default 25)")
    options = parser.parse_args()
    cv2.setNumThreads(1)

    frames = frames_of_the_drive()
    grays = [cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY) for frame in frames]
    over_budget = bench_gray(frames, options.rounds)
    over_budget += bench_canny(grays, options.rounds)
    over_budget += bench_canny_against_skimage(grays, options.rounds)
    bench_filters(grays, options.rounds)
    if options.growth:
        draw_growth(measure_growth(frames[1]), GROWTH)
        print(f"drawn: {GROWTH.name}")
    console = Console()
    for name in over_budget:
        console.print(f"over its budget: {name}", style="red")
    return 1 if over_budget else 0


if __name__ == "__main__":
    sys.exit(main())
