"""Finds edges in the camera's pictures with Canny's method, and publishes them on ~/edges."""

import cv2

from imgproc_course.ros import ImageProcessor, Setting, run_processor

# The unit of both thresholds: |gradient down| + |gradient right|, by Sobel's 3×3 windows. A straight step of
# h gray levels gives 4 h; 1530 is the most that any picture gives.
SETTINGS = [
    Setting(
        "low", 50, 0, 1530, "a pixel above it is an edge if it is joined to one above high (step of h: 4 h)"
    ),
    Setting(
        "high", 150, 0, 1530, "a pixel above it is an edge in any case (a step of h gray levels gives 4 h)"
    ),
    Setting("sigma", 0.0, 0.0, 10.0, "standard deviation of the Gaussian blur before, in pixels; 0: no blur"),
]


def process(frame, low, high, sigma):
    """Edges of a bgr8 frame.

    Returns
    -------
    dict of "gray" and "edges", (H, W) uint8, and "view", a function that returns (H, 3 W, 3) uint8 bgr8
    """
    # OpenCV's own: the same pixels as imgproc_course.imaging computes by hand, in a quarter of the time.
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    smoothed = cv2.GaussianBlur(gray, (0, 0), sigma) if sigma else gray
    edges = cv2.Canny(smoothed, low, high)
    return {"gray": gray, "edges": edges, "view": lambda: side_by_side(frame, gray, edges)}


def side_by_side(frame, gray, edges):
    """The original, gray, and edges in one picture of three times the width: (H, 3 W, 3) uint8, bgr8."""
    return cv2.hconcat([frame, *(cv2.cvtColor(picture, cv2.COLOR_GRAY2BGR) for picture in (gray, edges))])


def check(low, high, sigma):
    """Refuses thresholds in the wrong order, which OpenCV would swap in silence."""
    if low > high:
        raise ValueError(f"low ({low}) must not be above high ({high}); set both at once, or high first")


def make_node(**node_options):
    return ImageProcessor(
        "image_edge_detection",
        process,
        ["gray", "edges", "view"],
        settings=SETTINGS,
        check=check,
        **node_options,
    )


def main(args=None):
    return run_processor(make_node, args)
