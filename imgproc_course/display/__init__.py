"""What a notebook shows: images, the live view of a camera, and sliders beside an image."""

from imgproc_course.display.controls import labelled
from imgproc_course.display.figures import draw, show, show_figure
from imgproc_course.display.live_view import LiveView, live_view
from imgproc_course.display.tuners import Tuner, tune

__all__ = ["LiveView", "Tuner", "draw", "labelled", "live_view", "show", "show_figure", "tune"]
