"""The lesson "Where am I?": its solutions give what the field's tools give, on many inputs."""

import importlib.util
from pathlib import Path

import cv2
import numpy as np
from scipy.spatial.transform import Rotation

from imgproc_course.geometry import CameraModel, Pose, homography, rigid_motion

NODES = Path(__file__).parents[1] / "ros" / "lesson_nodes.py"


def test_find_homography_is_get_perspective_transform_and_the_packages(solutions):
    rng = np.random.default_rng(0)
    square = np.array([(-1.0, 1), (1, 1), (1, -1), (-1, -1)])
    for _ in range(200):
        points, pixels = (square + rng.uniform(-0.4, 0.4, (4, 2)) for _ in range(2))
        points, pixels = points * 3, (pixels * 40 + rng.uniform(60, 400, 2)).astype(np.float32).astype(float)
        points = points.astype(np.float32).astype(float)
        result = solutions["find_homography"](points, pixels)
        tool = cv2.getPerspectiveTransform(points.astype(np.float32), pixels.astype(np.float32))
        np.testing.assert_allclose(result, homography(points, pixels), rtol=0, atol=1e-8)
        np.testing.assert_allclose(result, tool, rtol=0, atol=1e-4)  # the tool's own error is up to 1e-5


def test_find_motion_is_scipys_align_vectors_and_the_packages(solutions):
    rng = np.random.default_rng(1)
    for number in range(200):
        before = rng.normal(0, 1, (int(rng.integers(4, 60)), 3)) * (1, 1, 0.01 if number % 2 else 1)
        turn, shift = Rotation.random(rng=rng), rng.normal(0, 2, 3)
        after = turn.apply(before) + shift + rng.normal(0, 0.02, before.shape)
        rotation, translation = solutions["find_motion"](before, after)
        tool, _ = Rotation.align_vectors(after - after.mean(axis=0), before - before.mean(axis=0))
        np.testing.assert_allclose(rotation, tool.as_matrix(), rtol=0, atol=1e-9)
        package = rigid_motion(before, after)
        np.testing.assert_allclose(rotation, package.rotation, rtol=0, atol=1e-9)
        np.testing.assert_allclose(translation, package.position, rtol=0, atol=1e-9)


def test_in_front_of_a_bare_wall_the_pose_stays():
    spec = importlib.util.spec_from_file_location("lesson_nodes", NODES)
    lesson_nodes = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(lesson_nodes)
    start = Pose.planar(1.0, 2.0, 0.5)
    odometry = lesson_nodes.lesson_definitions("where_am_i", detector=None)["VisualOdometry"](start)
    camera = CameraModel(640, 360, 352, 352, 320, 180, (0,) * 5)
    wall, depth = np.full((360, 640), 180, np.uint8), np.full((360, 640), 900, np.uint16)
    for number in (1, 2, 3):
        np.testing.assert_allclose(odometry.step(wall, depth, camera).vector, start.vector, rtol=0, atol=0)
        assert odometry.count == number  # each look begins again
