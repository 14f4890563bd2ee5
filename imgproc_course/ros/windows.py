"""Windows of OpenCV, where it has any. Only the main thread may call these."""

import os
import subprocess
import sys

import cv2

PATIENCE = 20  # seconds that a screen may take to answer
_PROBE = "import cv2; cv2.namedWindow('probe'); cv2.destroyAllWindows()"


def window_problem():
    """Why no window can be opened here, with the remedy, in one line; None where one can."""
    # Tried in a child: where no screen answers, OpenCV's window library ends the whole process.
    try:
        done = subprocess.run(
            [sys.executable, "-c", _PROBE], capture_output=True, text=True, timeout=PATIENCE
        )
    except subprocess.TimeoutExpired:
        return f"display needs a screen, and none has answered for {PATIENCE} s"
    if done.returncode == 0:
        return None
    if "not implemented" in done.stderr:
        return (
            "display needs an OpenCV with windows, and this one is headless: pip uninstall "
            "opencv-python-headless, then pip install opencv-python; or use live_view in a notebook"
        )
    screen = os.environ.get("WAYLAND_DISPLAY") or os.environ.get("DISPLAY") or "not set"
    return f"display needs a screen, and none answers (DISPLAY is {screen}); start the node on a desktop"


def show_windows(pictures):
    """Shows each picture in a window of its own, and lets the windows answer the mouse.

    Parameters
    ----------
    pictures : dict of window title -> (H, W) or (H, W, 3) bgr8 array; {} only lets the windows answer

    Raises
    ------
    cv2.error : OpenCV cannot show one
    """
    for title, picture in pictures.items():
        cv2.imshow(title, picture)
    cv2.waitKey(1)


def close_windows():
    """Closes all windows of this process."""
    cv2.destroyAllWindows()
