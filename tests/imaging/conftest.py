"""Images for the tests of imaging, and the counts that the exactness tests print (shown by -rP)."""

import importlib.util
from pathlib import Path

import cv2
import numpy as np
import pytest

from imgproc_course.recording import open_recording


def load(name):
    """Import a module from this folder; pytest's importlib mode does not put the folder on sys.path."""
    spec = importlib.util.spec_from_file_location(name, Path(__file__).with_name(f"{name}.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def grays():
    return load("sample_images").gray_samples()


@pytest.fixture
def colours():
    return load("sample_images").bgr_samples()


@pytest.fixture(scope="session")
def frames():
    """Five colour frames, spread evenly over the drive."""
    with open_recording("drive") as drive:
        return [drive.frame(k) for k in np.linspace(0, len(drive) - 1, 5).astype(int)]


@pytest.fixture(scope="session")
def gray_frames(frames):
    return [cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY) for frame in frames]


class PixelCount:
    """Compares results with the expected ones, pixel by pixel, and counts the differences."""

    def __init__(self):
        self.images = self.pixels = self.differing = 0
        self.failures = []

    def compare(self, result, truth, case):
        result, truth = np.asarray(result), np.asarray(truth)
        assert result.shape == truth.shape, case
        assert result.dtype == truth.dtype, case
        differing = int((result != truth).sum())
        self.images += 1
        self.pixels += truth.size
        self.differing += differing
        if differing:
            self.failures.append((case, differing))

    def report(self, title):
        print(
            f"{title}: OpenCV {cv2.__version__}, {self.images:,} images × parameters, "
            f"{self.pixels:,} values, differing: {self.differing}"
        )
        assert self.failures == []


@pytest.fixture
def count():
    return PixelCount()


@pytest.fixture(params=[1, 4], ids=["one thread", "four threads"])
def opencv_threads(request):
    """OpenCV cuts an image into one stripe per thread: the results must not depend on it."""
    threads_before = cv2.getNumThreads()
    cv2.setNumThreads(request.param)
    yield request.param
    cv2.setNumThreads(threads_before)
