"""Pictures for the tests of this room, and the counts that its exactness tests print (shown by -rP)."""

import importlib.util
from pathlib import Path

import cv2
import numpy as np
import pytest

from imgproc_course.recording import open_recording


def load(name):
    """A module that lies beside this file; pytest's importlib mode has no other way to it."""
    spec = importlib.util.spec_from_file_location(name, Path(__file__).with_name(f"{name}.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def grays():
    return load("sample_pictures").gray_samples()


@pytest.fixture
def colours():
    return load("sample_pictures").bgr_samples()


@pytest.fixture(scope="session")
def frames():
    """Five colour frames of the drive, spread over all of it."""
    with open_recording("drive") as drive:
        return [drive.frame(k) for k in np.linspace(0, len(drive) - 1, 5).astype(int)]


@pytest.fixture(scope="session")
def gray_frames(frames):
    return [cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY) for frame in frames]


class Count:
    """Compares answers with the truth, pixel by pixel, and keeps count."""

    def __init__(self):
        self.pictures = self.pixels = self.differing = 0
        self.where = []

    def compare(self, answer, truth, what):
        answer, truth = np.asarray(answer), np.asarray(truth)
        assert answer.shape == truth.shape, what
        assert answer.dtype == truth.dtype, what
        differing = int((answer != truth).sum())
        self.pictures += 1
        self.pixels += truth.size
        self.differing += differing
        if differing:
            self.where.append((what, differing))

    def report(self, title):
        print(
            f"{title}: OpenCV {cv2.__version__}, {self.pictures:,} pictures × parameters, "
            f"{self.pixels:,} values, differing: {self.differing}"
        )
        assert self.where == []


@pytest.fixture
def count():
    return Count()


@pytest.fixture(params=[1, 4], ids=["one thread", "four threads"])
def opencv_threads(request):
    """OpenCV cuts a picture into one stripe a thread: its answers must not depend on it."""
    before = cv2.getNumThreads()
    cv2.setNumThreads(request.param)
    yield request.param
    cv2.setNumThreads(before)
