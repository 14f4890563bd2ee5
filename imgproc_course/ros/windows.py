"""OpenCV windows for a node's outputs. Only the main thread of a process may have windows."""

import contextlib
import os
import subprocess
import sys
import threading

import cv2
from rclpy.parameter import Parameter

SCREEN_TIMEOUT = 20  # seconds that a screen may take to answer
_PROBE = "import cv2; cv2.namedWindow('probe'); cv2.destroyAllWindows()"


def window_problem():
    """Why no window can be opened here, with the remedy, in one line; None if one can be opened."""
    # In a child process, because without a screen OpenCV's window library ends the whole process.
    try:
        probe = subprocess.run(
            [sys.executable, "-c", _PROBE], capture_output=True, text=True, timeout=SCREEN_TIMEOUT
        )
    except subprocess.TimeoutExpired:
        return f"display needs a screen, and no screen answered within {SCREEN_TIMEOUT} s"
    if probe.returncode == 0:
        return None
    if "not implemented" in probe.stderr:
        return (
            "display needs an OpenCV with windows, and this one is headless: pip uninstall "
            "opencv-python-headless, then pip install opencv-python; or use live_view in a notebook"
        )
    screen = os.environ.get("WAYLAND_DISPLAY") or os.environ.get("DISPLAY") or "not set"
    return f"display needs a screen, and no screen answers (DISPLAY is {screen}); start the node on a desktop"


class OutputWindows:
    """One window for each output of a node, while its parameter `display` is set.

    Parameters
    ----------
    node : rclpy Node; the windows are titled `<node>/<output>`
    log : NodeLog
    """

    def __init__(self, node, log):
        self._node = node
        self._log = log
        self._arrays = {}
        self._in_main_thread = False
        self._are_open = False

    def problem(self):
        """Why this node cannot have windows, with the remedy, in one line; None if it can."""
        if not self._in_main_thread:
            return "display needs a process for the node alone (ros2 run): windows belong to the main thread"
        return window_problem()

    def start(self, display):
        """Called in the thread that spins the node. Without a screen it switches `display` off."""
        self._in_main_thread = threading.current_thread() is threading.main_thread()
        problem = self.problem() if display else None
        if problem:
            self._switch_off(f"{problem}; the node continues without windows")

    def update(self, arrays):
        """Takes new images, {output: (H, W) or (H, W, 3) bgr8 array}; `refresh` draws them."""
        self._arrays = arrays

    def refresh(self, display):
        """Draws the new images and lets the windows react to the mouse; without display, closes them."""
        if not display:
            self.close()
            return
        self._are_open = True
        arrays, self._arrays = self._arrays, {}
        node_name = self._node.get_fully_qualified_name()
        try:
            draw({f"{node_name}/{output}": array for output, array in arrays.items()})
        except cv2.error as error:
            self._switch_off(f"OpenCV cannot show the images ({error.err}); display is switched off")

    def close(self):
        """Closes the windows and discards images that were not drawn yet."""
        self._arrays = {}
        if self._are_open:
            self._are_open = False
            with contextlib.suppress(cv2.error):  # the screen may be gone
                close_all()

    def _switch_off(self, reason):
        self._log.warn("windows", reason)
        self._node.set_parameters([Parameter("display", value=False)])


def draw(images):
    """Shows each array of {window title: array} in its window; OpenCV draws and reacts in waitKey."""
    for title, array in images.items():
        cv2.imshow(title, array)
    cv2.waitKey(1)


def close_all():
    """Closes all windows of this process."""
    cv2.destroyAllWindows()
