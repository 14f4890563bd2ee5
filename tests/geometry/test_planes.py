"""Planes, and the homography and pose of a plane in an image, against OpenCV's."""

import cv2
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from imgproc_course.geometry import CameraModel, Pose, homography, homography_pose, triangle_planes

CAMERA = CameraModel(640, 360, 352.0, 350.0, 319.5, 179.5)
SQUARE = np.array([(-0.125, 0.125), (0.125, 0.125), (0.125, -0.125), (-0.125, -0.125)])
MORE = np.random.default_rng(7).uniform(-0.3, 0.3, (30, 2))


def views(points, count=20):
    """(true Pose of a plane before the camera, its points (N, 3), their pixels (N, 2)), from all sides."""
    random = np.random.default_rng(8)
    solid = np.column_stack([points, np.zeros(len(points))])
    for _ in range(count):
        tilt = Rotation.from_euler("xyz", [np.pi + random.uniform(-1, 1), *random.uniform(-1, 1, 2)])
        pose = Pose(tilt.as_matrix(), np.array([*random.uniform(-0.5, 0.5, 2), random.uniform(1, 4)]))
        yield pose, solid, CAMERA.project(pose.apply(solid))


@pytest.mark.parametrize("points", [SQUARE, MORE], ids=["four corners", "30 points"])
def test_a_homography_equals_opencv_on_exact_points(points):
    points = points.astype(np.float32)  # findHomography computes with nothing finer
    for _, _, pixels in views(points):
        pixels = pixels.astype(np.float32)
        matrix = homography(points, pixels)
        expected, _ = cv2.findHomography(points, pixels, 0)
        assert matrix[2, 2] == 1
        tolerance = 1e-9 if len(points) == 4 else 1e-5
        np.testing.assert_allclose(matrix, expected, rtol=tolerance, atol=tolerance)


def test_a_homography_of_noisy_points_is_nearly_as_good_as_opencvs():
    """OpenCV goes on to the smallest error in pixels; the linear transform stops at the algebraic one."""
    random = np.random.default_rng(9)
    for _, _, pixels in views(MORE):
        noisy = pixels + random.normal(scale=0.5, size=pixels.shape)
        errors = [
            np.square(cv2.perspectiveTransform(MORE[None], matrix)[0] - noisy).mean()
            for matrix in (homography(MORE, noisy), cv2.findHomography(MORE, noisy, 0)[0])
        ]
        assert errors[1] <= errors[0] < 1.02 * errors[1]


@pytest.mark.parametrize("points", [SQUARE, MORE], ids=["four corners", "30 points"])
def test_the_pose_of_a_plane_equals_opencvs(points):
    for truth, solid, pixels in views(points):
        pose = homography_pose(homography(points, pixels), CAMERA.matrix)
        _, turn, position = cv2.solvePnP(solid, pixels, CAMERA.matrix, None, flags=cv2.SOLVEPNP_IPPE)
        np.testing.assert_allclose(pose.rotation, cv2.Rodrigues(turn)[0], atol=1e-6)
        np.testing.assert_allclose(pose.position, position.ravel(), atol=1e-6)
        np.testing.assert_allclose(pose.rotation, truth.rotation, atol=1e-9)
        np.testing.assert_allclose(pose.position, truth.position, atol=1e-9)


def test_the_pose_of_a_noisy_marker_equals_opencvs():
    """Where the two poses that OpenCV finds fit about equally, either may be taken."""
    random = np.random.default_rng(10)
    clear = 0
    for _, solid, pixels in views(SQUARE, 100):
        noisy = pixels + random.normal(scale=0.3, size=pixels.shape)
        pose = homography_pose(-3 * homography(SQUARE, noisy), CAMERA.matrix)
        _, turns, positions, errors = cv2.solvePnPGeneric(
            solid, noisy, CAMERA.matrix, None, flags=cv2.SOLVEPNP_IPPE
        )
        k = int(np.argmin([np.abs(cv2.Rodrigues(turn)[0] - pose.rotation).max() for turn in turns]))
        np.testing.assert_allclose(pose.rotation, cv2.Rodrigues(turns[k])[0], atol=1e-6)
        assert np.linalg.norm(pose.position - positions[k].ravel()) < 0.01 * pose.position[2]
        clear += bool(errors[0] < 0.7 * errors[1])
        assert k == 0 or errors[0] > 0.7 * errors[1]
    assert clear > 50


@pytest.mark.parametrize(
    ("points", "image_points", "message"),
    [
        (SQUARE[:3], SQUARE[:3], r"\(N, 2\) with N >= 4, got \(3, 2\) and \(3, 2\)"),
        (SQUARE, SQUARE * np.nan, "finite"),
        ([(0, 0), (1, 0), (2, 0), (0, 1)], [(0, 0), (1, 0), (2, 0), (0, 1)], "4 pairs .* no homography"),
        ([(0, 0), (1, 0), (2, 0), (0, 1)], SQUARE, "determine no homography"),
        (SQUARE, [(0, 0), (1, 0), (2, 0), (0, 1)], "determine no homography"),
        (np.ones((4, 2)), SQUARE, "determine no homography"),
    ],
)
def test_points_without_a_homography(points, image_points, message):
    with pytest.raises(ValueError, match=message):
        homography(points, image_points)


@pytest.mark.parametrize("matrix", [np.zeros((3, 3)), np.eye(4), np.full((3, 3), np.nan)])
def test_what_is_no_homography(matrix):
    with pytest.raises(ValueError, match="a homography is 3×3"):
        homography_pose(matrix, CAMERA.matrix)
    with pytest.raises(ValueError, match="a camera matrix is 3×3"):
        homography_pose(np.eye(3), matrix)


def test_planes_of_triangles():
    triangles = [[(0, 0, 2), (1, 0, 2), (0, 1, 2)], [(3, 0, 0), (3, 0, 1), (3, 1, 0)], [(1, 1, 1)] * 3]
    normals, offsets = triangle_planes(triangles)
    np.testing.assert_array_equal(normals, [(0, 0, 1), (-1, 0, 0), (0, 0, 0)])
    np.testing.assert_array_equal(offsets, [2, -3, 0])
