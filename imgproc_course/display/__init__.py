"""What a notebook shows: images, a camera live, sliders beside an image, and a robot to drive."""

from imgproc_course.extras import naming_extra

with naming_extra():
    from imgproc_course.display.controls import labelled
    from imgproc_course.display.drive import DriveView, drive
    from imgproc_course.display.figures import draw, show, show_figure
    from imgproc_course.display.live_view import LiveView, live_view
    from imgproc_course.display.tuners import Tuner, tune

__all__ = [
    "DriveView",
    "LiveView",
    "Tuner",
    "draw",
    "drive",
    "labelled",
    "live_view",
    "show",
    "show_figure",
    "tune",
]
