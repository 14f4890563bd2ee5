"""Poses against SciPy's rotations."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from imgproc_course.geometry import Pose, triangle_planes
from imgproc_course.geometry.poses import rotation_about


def random_vectors(count):
    random = np.random.default_rng(3)
    rotations = Rotation.random(count, random_state=3).as_quat()
    return np.column_stack([random.uniform(-3, 3, (count, 3)), rotations * np.sign(rotations[:, 3:])])


@pytest.mark.parametrize("vector", [*random_vectors(20), *np.column_stack([np.zeros((4, 3)), np.eye(4)])])
def test_a_pose_and_its_vector(vector):
    pose = Pose.from_vector(vector)
    np.testing.assert_allclose(pose.rotation, Rotation.from_quat(vector[3:]).as_matrix(), atol=1e-12)
    back = pose.vector
    assert min(np.abs(back - vector).max(), np.abs(back[3:] + vector[3:]).max()) < 2e-9


def test_composition_and_inverse():
    a, b = (Pose.from_vector(v) for v in random_vectors(2))
    points = np.random.default_rng(4).normal(size=(5, 3))
    np.testing.assert_allclose((a @ b).apply(points), a.apply(b.apply(points)), atol=1e-12)
    np.testing.assert_allclose(a.inverse().apply(a.apply(points)), points, atol=1e-12)


@pytest.mark.parametrize("axis", "xyz")
def test_rotations_about_an_axis(axis):
    expected = Rotation.from_euler(axis, 0.7).as_matrix()
    np.testing.assert_allclose(rotation_about(axis, 0.7), expected, atol=1e-11)


def test_a_body_on_the_floor():
    pose = Pose.planar(1.0, 2.0, math.pi / 2)
    np.testing.assert_allclose(pose.apply([1.0, 0, 0]), (1, 3, 0), atol=1e-11)
    np.testing.assert_allclose(pose.vector, (1, 2, 0, 0, 0, math.sqrt(0.5), math.sqrt(0.5)), atol=1e-9)


@pytest.mark.parametrize(
    ("vector", "message"),
    [
        ([0, 0, 0], "7 finite numbers"),
        ([0, 0, np.nan, 0, 0, 0, 1], "7 finite numbers"),
        ([0] * 7, "no rotation is 0 0 0 1"),
    ],
)
def test_impossible_poses(vector, message):
    with pytest.raises(ValueError, match=message):
        Pose.from_vector(vector)


def test_planes_of_triangles():
    triangles = [[(0, 0, 2), (1, 0, 2), (0, 1, 2)], [(3, 0, 0), (3, 0, 1), (3, 1, 0)], [(1, 1, 1)] * 3]
    normals, offsets = triangle_planes(triangles)
    np.testing.assert_array_equal(normals, [(0, 0, 1), (-1, 0, 0), (0, 0, 0)])
    np.testing.assert_array_equal(offsets, [2, -3, 0])
