"""The pose graph against GTSAM's."""

import gtsam
import numpy as np
import pytest

from imgproc_course.geometry import Pose, compose_poses, optimize_pose_graph, relative_pose, wrap_angle


def drifted_loop(seed, count=40):
    """Poses as odometry adds them up, and edges: of the odometry, and between poses of the same place."""
    random = np.random.default_rng(seed)
    motion = np.array([0.2, random.uniform(-0.05, 0.05), 2 * np.pi / count])
    truth = [np.array([1.0, -2.0, 3.0])]
    for _ in range(count):
        truth.append(compose_poses(truth[-1], motion))
    pairs = [(k, k + 1) for k in range(count)] + [(count, 0), (3, count - 2), (10, 30)]
    edges = []
    for i, j in pairs:
        noise = random.normal(scale=(0.005, 0.005, 0.01))
        weights = random.uniform(50, 5000, 2)
        edges.append((i, j, relative_pose(truth[i], truth[j]) + noise, weights))
    poses = [truth[0]]
    for i, _, motion, _ in edges[:count]:
        poses.append(compose_poses(poses[i], motion))
    return np.array(poses), edges


def gtsam_graph(poses, edges):
    graph = gtsam.NonlinearFactorGraph()
    loose = gtsam.noiseModel.Diagonal.Sigmas(np.full(3, 1e-3))  # nothing else pulls at the first pose
    graph.add(gtsam.PriorFactorPose2(0, gtsam.Pose2(*poses[0]), loose))
    for i, j, motion, weights in edges:
        noise = gtsam.noiseModel.Diagonal.Sigmas(1 / np.sqrt(np.take(weights, [0, 0, 1])))
        graph.add(gtsam.BetweenFactorPose2(i, j, gtsam.Pose2(*motion), noise))
    return graph


def gtsam_values(poses):
    values = gtsam.Values()
    for k, pose in enumerate(poses):
        values.insert(k, gtsam.Pose2(*pose))
    return values


@pytest.mark.parametrize("seed", range(10))
def test_the_graph_equals_gtsams(seed):
    poses, edges = drifted_loop(seed)
    graph = gtsam_graph(poses, edges)
    optimizer = gtsam.GaussNewtonOptimizer(graph, gtsam_values(poses))
    for _ in range(20):
        optimizer.iterate()
    best = [optimizer.values().atPose2(k) for k in range(len(poses))]
    expected = np.array([(pose.x(), pose.y(), pose.theta()) for pose in best])
    optimized = optimize_pose_graph(poses, edges)
    # GTSAM measures an edge's error along an arc: another square, by the twelfth part of its yaw squared.
    assert np.abs(optimized[:, :2] - expected[:, :2]).max() < 1e-6
    assert np.abs(wrap_angle(optimized[:, 2] - expected[:, 2])).max() < 1e-6
    np.testing.assert_array_equal(optimized[0], poses[0])
    assert np.abs(optimized - poses).max() > 0.01


def test_relative_poses_equal_those_in_space():
    random = np.random.default_rng(3)
    first, second = random.uniform(-3, 3, (2, 50, 3))
    relative = relative_pose(first, second)
    for a, b, (dx, dy, turn) in zip(first, second, relative, strict=True):
        expected = Pose.planar(*a).inverse() @ Pose.planar(*b)
        np.testing.assert_allclose(Pose.planar(dx, dy, turn).vector, expected.vector, atol=1e-8)
    np.testing.assert_allclose(compose_poses(first, relative), second, atol=1e-12)
    np.testing.assert_allclose(relative_pose((1, 2, 3), (1, 2, -3)), (0, 0, 2 * np.pi - 6), atol=1e-12)


def test_two_measurements_of_one_pose_are_weighed():
    poses = [(0, 0, 0), (1, 0, 0)]
    edges = [(0, 1, (1, 0, 0), (30, 1)), (0, 1, (2, 0, 0.4), (10, 3))]
    np.testing.assert_allclose(optimize_pose_graph(poses, edges), [(0, 0, 0), (1.25, 0, 0.3)], atol=1e-9)


LINE = np.zeros((3, 3))
EDGE = (0, 1, (1, 0, 0), (1, 1))


@pytest.mark.parametrize(
    ("poses", "edges", "message"),
    [
        (np.zeros((3, 2)), [EDGE], r"poses \(N, 3\)"),
        (LINE * np.nan, [EDGE], "finite poses"),
        (LINE, [(0, 3, (1, 0, 0), (1, 1))], "poses 0 to 2, got 0 and 3"),
        (LINE, [(1, 1, (1, 0, 0), (1, 1))], "got 1 and 1"),
        (LINE, [(0, 1, (1, 0), (1, 1))], "3 numbers of motion"),
        (LINE, [(0, 1, (1, 0, 0), (1, 0))], "weights above 0"),
        (LINE, [EDGE], "no edges connect pose 2"),
        (LINE, [], "no edges connect pose 1"),
    ],
)
def test_what_is_no_graph(poses, edges, message):
    with pytest.raises(ValueError, match=message):
        optimize_pose_graph(poses, edges)
