"""Live view in JupyterLab: how many published images Chromium decodes, and how soon `tune` follows a slider.

Needs Debian's chromium. A camera of 1280 × 720 at 30 Hz (the recorded drive, three times as fast) goes
through ROS if rclpy is installed, else directly from the recording; each frame goes through the course's
to_gray and canny; then one slider of `tune` moves right and left. Exits with 1 below 25 frames/s, or above
50 ms from key to image (median).
"""

import os
import statistics
import sys
import tempfile
from pathlib import Path

from rich.console import Console
from rich.table import Table

sys.path.insert(0, str(Path(__file__).parents[1] / "browser"))
from jupyter_page import NotebookPage, running_chromium, running_lab, write_notebook

SECONDS, PRESSES = 10, 60
LEAST_RATE, MOST_MILLISECONDS = 25, 50
IMPORTS = """
from imgproc_course.display import live_view, tune
from imgproc_course.imaging import canny, to_gray
from imgproc_course.recording import open_recording
from imgproc_course.ros import open_camera, ros_available
"""
CAMERA = "camera = open_camera(speed=3.0) if ros_available() else open_recording()"
LIVE = """
def edges(frame, low=100, high=200):
    return canny(to_gray(frame), low, high)
view = live_view(camera, edges, thresholds=(0, 1020), rate=30.0)
"""
PUBLISHED = "print('ROS 2' if ros_available() else 'recording', f'{view.rate:.1f}')"
TUNE = """
tuner = tune(canny, open_recording().frame(30, encoding="mono8"), thresholds=(0, 400, 20))
"""


def measure_live_view(browser, address):
    page = NotebookPage(browser, address, "live.ipynb")
    page.run_all()
    page.wait_for_image()
    page.page.wait_for_timeout(3000)
    rates = page.images_per_second(SECONDS)
    page.run_cell(3)
    source, sent_rate = page.outputs(3)[0].split("\n")[0].rsplit(" ", 1)
    _exit_on_errors(page)
    page.screenshot("bench_live_view")
    page.close()
    return source, float(sent_rate), rates


def measure_tune(browser, address):
    page = NotebookPage(browser, address, "tune.ipynb")
    page.run_all()
    page.wait_for_image()
    latencies = page.slider_latencies(PRESSES, number=1)[10:]  # the first are slow
    _exit_on_errors(page)
    page.close()
    return latencies


def _exit_on_errors(page):
    if page.errors():
        sys.exit("the notebook failed:\n" + "\n".join(page.errors()))


def main():
    os.environ.setdefault("ROS_DOMAIN_ID", "77")
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "lessons"
        folder.mkdir()
        write_notebook(folder / "live.ipynb", [IMPORTS, CAMERA, LIVE, PUBLISHED])
        write_notebook(folder / "tune.ipynb", [IMPORTS, TUNE])
        with running_lab(folder, Path(scratch)) as address, running_chromium() as browser:
            # The still image first: the camera of the other notebook keeps playing in its kernel.
            latencies = measure_tune(browser, address)
            source, sent_rate, rates = measure_live_view(browser, address)
    median = statistics.median(latencies)
    table = Table("what", "measured", "budget", title="Live view and tune in Chromium", title_justify="left")
    table.add_row(f"camera at 30 Hz from {source}: frames/s sent to the browser", f"{sent_rate:.1f}", "")
    table.add_row("frames/s decoded by the browser", f"{rates['loads']:.1f}", f"≥ {LEAST_RATE}")
    table.add_row("of these, different from the last", f"{rates['changes']:.1f}", "")
    table.add_row("decoded of 30 published", f"{rates['loads'] / 30:.2f}", "")
    table.add_row("tune, from key to decoded image: median", f"{median:.0f} ms", f"≤ {MOST_MILLISECONDS} ms")
    table.add_row("nine of ten within", f"{statistics.quantiles(latencies, n=10)[-1]:.0f} ms", "")
    Console(width=110).print(table)
    return int(rates["loads"] < LEAST_RATE or median > MOST_MILLISECONDS)


if __name__ == "__main__":
    sys.exit(main())
