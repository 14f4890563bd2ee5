"""Whether OpenCV can open windows here."""

import os
import subprocess
import sys

SCREEN_TIMEOUT = 20  # seconds that a screen may take to answer
PROBE = "import cv2; cv2.namedWindow('probe'); cv2.destroyAllWindows()"


def window_problem():
    """Why no window can be opened here, with the remedy, in one line; None if one can be opened."""
    # In a child process, because without a screen OpenCV's window library ends the whole process.
    try:
        probe = subprocess.run(
            [sys.executable, "-c", PROBE], capture_output=True, text=True, timeout=SCREEN_TIMEOUT
        )
    except subprocess.TimeoutExpired:
        return f"windows need a screen, and no screen answered within {SCREEN_TIMEOUT} s"
    if probe.returncode == 0:
        return None
    if "not implemented" in probe.stderr:
        return (
            "windows need an OpenCV that has them, and this one is headless: pip uninstall "
            "opencv-python-headless, then pip install opencv-python; or use live_view in a notebook"
        )
    screen = os.environ.get("WAYLAND_DISPLAY") or os.environ.get("DISPLAY") or "not set"
    return f"windows need a screen, and no screen answers (DISPLAY is {screen}); start the node on a desktop"
