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


def spread(corners):
    """Whether no three of four points lie nearly on one line: each triangle is large."""
    triangles = np.array([np.delete(corners, i, axis=0) for i in range(4)])
    sides = triangles[:, 1:] - triangles[:, :1]
    return abs(np.linalg.det(sides)).min() > 500


def test_find_inliers_finds_what_opencv_finds(solutions):
    rng = np.random.default_rng(3)
    for _ in range(20):
        points = rng.uniform(0, 200, (60, 2))
        H = np.array([[1, 0.2, 50], [-0.1, 0.9, 80], [0.001, 0.0005, 1]]) + rng.normal(0, 1e-4, (3, 3))
        pixels = cv2.perspectiveTransform(points[None], H)[0] + rng.normal(0, 0.1, (60, 2))
        pixels[40:] = rng.uniform(600, 1200, (20, 2))
        samples = np.array([rng.choice(40, 4, replace=False) for _ in range(20)])
        samples[::2] = rng.integers(0, 10, (10, 1)) + np.array([0, 10, 20, 45])  # one of four is wrong
        samples = np.array([s for s in samples if spread(points[s]) and spread(pixels[s])])
        mask = solutions["find_inliers"](points, pixels, samples, 5.0)
        assert len(samples) > 4
        _, tool = cv2.findHomography(points, pixels, cv2.RANSAC, 5.0)
        assert mask.tolist() == [True] * 40 + [False] * 20 == (tool.ravel() == 1).tolist()
