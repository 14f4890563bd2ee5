"""Poses against SciPy's rotations."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from imgproc_course.geometry import Pose, ate, rigid_motion
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


@pytest.mark.parametrize("depth", [1, 1e-3, 0], ids=["solid", "nearly flat", "flat"])
def test_a_rigid_motion_equals_scipy(depth):
    random = np.random.default_rng(5)
    for truth in random_vectors(20):
        before = random.normal(size=(random.integers(3, 40), 3)) * (1, 1, depth)
        after = Pose.from_vector(truth).apply(before) + random.normal(scale=0.01, size=before.shape) * depth
        motion = rigid_motion(before, after)
        expected, _ = Rotation.align_vectors(after - after.mean(0), before - before.mean(0))
        np.testing.assert_allclose(motion.rotation, expected.as_matrix(), atol=1e-12)
        np.testing.assert_allclose(motion.apply(before).mean(0), after.mean(0), atol=1e-12)


def test_a_rigid_motion_is_never_a_reflection():
    before = np.random.default_rng(6).normal(size=(10, 3))
    motion = rigid_motion(before, before * (1, 1, -1))
    assert np.linalg.det(motion.rotation) == pytest.approx(1)


def test_the_error_of_a_path():
    path = np.array([(0, 0, 0), (1, 0, 0), (2, 0, 0)])
    assert ate(path + np.array([0.3, 0, 0.4]), path) == pytest.approx(0.5)
    assert ate(path[:, :2] + np.array([(0, 0), (0, 0.3), (0, 0.6)]), path[:, :2]) == pytest.approx(0.15**0.5)


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        (np.eye(3)[:2], np.eye(3)[:2], r"\(N, 3\) with N >= 3, got \(2, 3\) and \(2, 3\)"),
        (np.eye(3), np.eye(3)[:2], r"got \(3, 3\) and \(2, 3\)"),
        (np.eye(3), np.full((3, 3), np.nan), "finite"),
        (np.outer(range(5), (1, 2, 3)), np.outer(range(5), (3, 2, 1)), "5 points lie on one line"),
        (np.ones((4, 3)), np.ones((4, 3)), "lie on one line"),
    ],
)
def test_points_without_a_rigid_motion(before, after, message):
    with pytest.raises(ValueError, match=message):
        rigid_motion(before, after)


@pytest.mark.parametrize("path", [np.zeros((0, 3)), np.zeros(3), np.zeros((4, 4))])
def test_what_is_no_path(path):
    with pytest.raises(ValueError, match="point sets of one shape"):
        ate(path, path)
