"""Turns the camera's pictures gray, and publishes them on ~/gray."""

from imgproc_course.imaging import to_gray
from imgproc_course.ros import ImageProcessor, run_processor


def process(frame):
    """Gray of a bgr8 frame: {"gray": (H, W) uint8}."""
    return {"gray": to_gray(frame)}


def make_node(**node_options):
    return ImageProcessor("image_gray_processor", process, ["gray"], **node_options)


def main(args=None):
    return run_processor(make_node, args)
