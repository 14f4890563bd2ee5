"""The lesson "Recognising objects": its solutions give what the field's tools give, on many inputs."""

import cv2
import numpy as np
from skimage.feature import hog
from sklearn.neighbors import NearestCentroid

from imgproc_course.recording import open_recording


def test_hog_of_solved_cells_is_skimage(solutions):
    def normalized(block):
        return block / np.sqrt((block * block).sum() + 1e-10)

    gray = cv2.cvtColor(open_recording("drive").frame(0), cv2.COLOR_BGR2GRAY)
    rng = np.random.default_rng(0)
    for _ in range(30):
        row, col = rng.integers(0, (720 - 64, 1280 - 64))
        crop = gray[row : row + 64, col : col + 64].astype(float)
        grad_row, grad_col = np.zeros((2, 64, 64))
        grad_row[1:-1] = crop[2:] - crop[:-2]
        grad_col[:, 1:-1] = crop[:, 2:] - crop[:, :-2]
        cells = np.zeros((8, 8, 9))
        for i, j in np.ndindex(8, 8):
            part = slice(8 * i, 8 * i + 8), slice(8 * j, 8 * j + 8)
            cells[i, j] = solutions["cell_histogram"](grad_row[part], grad_col[part])
        blocks = [
            normalized(np.minimum(normalized(cells[i : i + 2, j : j + 2].ravel()), 0.2))
            for i in range(7)
            for j in range(7)
        ]
        tool = hog(crop, orientations=9, pixels_per_cell=(8, 8), cells_per_block=(2, 2), block_norm="L2-Hys")
        assert tool.max() > 0.1
        np.testing.assert_allclose(np.concatenate(blocks), tool, atol=1e-6)


def test_an_orientation_that_is_rounded_to_180_degrees_is_in_the_last_bin(solutions):
    grad_row, grad_col = np.array([[-1e-20, 0.0]]), np.array([[1.0, 1.0]])
    assert np.degrees(np.arctan2(grad_row, grad_col))[0, 0] % 180 == 180
    assert solutions["cell_histogram"](grad_row, grad_col).tolist() == [0.5, *[0] * 7, 0.5]


def test_nearest_mean_is_nearest_centroid(solutions):
    rng = np.random.default_rng(1)
    for _ in range(40):
        classes = rng.permutation(np.repeat([2, 3, 7, 11], rng.integers(2, 9, 4)))
        vectors = rng.normal(0, 1, (12, 20))[classes] + rng.normal(0, 1, (len(classes), 20))
        new = rng.normal(0, 1, (50, 20))
        tool = NearestCentroid().fit(vectors, classes).predict(new)
        assert (solutions["nearest_mean"](vectors, classes, new) == tool).all()
        assert len(set(tool.tolist())) > 2
