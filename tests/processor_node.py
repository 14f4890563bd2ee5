"""The gray node and the edge node as ImageProcessors, for tests and benchmarks.

python processor_node.py image_gray_processor|image_edge_detection [--ros-args ...]
"""

import sys

import cv2

from imgproc_course.ros import ImageProcessor, NumericParameter, run_processor

PARAMETERS = [
    NumericParameter("low", 50, 0, 1530, "a pixel above it is a weak edge (a step of h gray levels: 4 h)"),
    NumericParameter("high", 150, 0, 1530, "a pixel above it is a strong edge (a step of h: 4 h)"),
    NumericParameter(
        "sigma", 0.0, 0.0, 10.0, "standard deviation of the Gaussian blur, in pixels; 0: no blur"
    ),
]


def make_gray(frame):
    return {"gray": cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)}


def detect_edges(frame, low, high, sigma):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    edges = cv2.Canny(cv2.GaussianBlur(gray, (0, 0), sigma) if sigma else gray, low, high)
    three = [frame, *(cv2.cvtColor(image, cv2.COLOR_GRAY2BGR) for image in (gray, edges))]
    return {"gray": gray, "edges": edges, "view": lambda: cv2.hconcat(three)}


def refuse_swapped(low, high, sigma):
    if low > high:
        raise ValueError(f"low ({low}) must not be above high ({high}); set both at once, or high first")


def make_node(name):
    if name == "image_gray_processor":
        return ImageProcessor(name, make_gray, ["gray"])
    outputs = ["gray", "edges", "view"]
    return ImageProcessor(name, detect_edges, outputs, parameters=PARAMETERS, check=refuse_swapped)


if __name__ == "__main__":
    node_name = sys.argv.pop(1)
    raise SystemExit(run_processor(lambda: make_node(node_name)))
