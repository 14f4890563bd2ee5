"""Detects edges in the camera's images with Canny's method, and publishes them on ~/edges."""

import cv2

from imgproc_course.ros import ImageProcessor, NumericParameter, run_processor

# The unit of both thresholds: the L1 norm of the gradient, by Sobel's 3×3 kernels. A straight step of h gray
# levels gives 4 h; 1530 is the maximum of any image.
PARAMETERS = [
    NumericParameter(
        "low",
        50,
        0,
        1530,
        "a pixel above it is an edge if it is connected to one above high (step of h: 4 h)",
    ),
    NumericParameter(
        "high", 150, 0, 1530, "a pixel above it is always an edge (a step of h gray levels gives 4 h)"
    ),
    NumericParameter(
        "sigma", 0.0, 0.0, 10.0, "standard deviation of the Gaussian blur, in pixels; 0: no blur"
    ),
]


def process(frame, low, high, sigma):
    """Edges of a bgr8 frame.

    Returns
    -------
    dict of "gray" and "edges", (H, W) uint8, and "view", a function that returns (H, 3 W, 3) uint8 bgr8
    """
    # OpenCV's functions: the same pixels as imgproc_course.imaging.canny, in a quarter of the time.
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    smoothed = cv2.GaussianBlur(gray, (0, 0), sigma) if sigma else gray
    edges = cv2.Canny(smoothed, low, high)
    return {"gray": gray, "edges": edges, "view": lambda: side_by_side(frame, gray, edges)}


def side_by_side(frame, gray, edges):
    """The original, gray, and edges side by side in one image: (H, 3 W, 3) uint8, bgr8."""
    return cv2.hconcat([frame, *(cv2.cvtColor(image, cv2.COLOR_GRAY2BGR) for image in (gray, edges))])


def check(low, high, sigma):
    """Refuses thresholds in the wrong order. OpenCV would swap them silently."""
    if low > high:
        raise ValueError(f"low ({low}) must not be above high ({high}); set both at once, or high first")


def make_node(**node_options):
    return ImageProcessor(
        "image_edge_detection",
        process,
        ["gray", "edges", "view"],
        parameters=PARAMETERS,
        check=check,
        **node_options,
    )


def main(args=None):
    return run_processor(make_node, args)
