"""The lesson on tracking: its solutions give what the field's tools give, on many inputs."""

import cv2
import numpy as np
import pytest
from nbclassroom.exercises import read_exercises, run_cases


def test_iou_is_that_of_the_masks(solutions):
    rng = np.random.default_rng(1)
    values = []
    for _ in range(300):
        boxes = [(*rng.integers(0, 20, 2).tolist(), *rng.integers(1, 20, 2).tolist()) for _ in range(2)]
        masks = np.zeros((2, 40, 40), bool)
        for mask, (col, row, width, height) in zip(masks, boxes, strict=True):
            mask[row : row + height, col : col + width] = True
        values.append((masks[0] & masks[1]).sum() / (masks[0] | masks[1]).sum())
        assert solutions["iou"](*boxes) == pytest.approx(values[-1], abs=1e-12)
    assert min(values) == 0 and max(values) > 0.5


def test_predict_and_update_are_opencvs_kalman_filter(solutions):
    rng = np.random.default_rng(2)
    tool = cv2.KalmanFilter(4, 2, 0, cv2.CV_64F)
    F, H = np.eye(4) + np.diag([0.1, 0.1], 2), np.eye(2, 4)
    Q, R = np.diag([0.001, 0.002, 0.03, 0.04]), np.array([[0.01, 0.002], [0.002, 0.02]])
    tool.transitionMatrix, tool.measurementMatrix = F, H
    tool.processNoiseCov, tool.measurementNoiseCov = Q, R
    tool.errorCovPost, tool.statePost = np.eye(4), np.ones((4, 1))
    state, covariance = np.ones(4), np.eye(4)
    for measurement in rng.normal(0, 1, (200, 2)):
        state, covariance = solutions["predict"](state, covariance, F, Q)
        np.testing.assert_allclose(tool.predict().ravel(), state, rtol=0, atol=1e-12)
        np.testing.assert_allclose(tool.errorCovPre, covariance, rtol=0, atol=1e-12)
        state, covariance = solutions["update"](state, covariance, measurement, H, R)
        np.testing.assert_allclose(tool.correct(measurement.reshape(2, 1)).ravel(), state, rtol=0, atol=1e-12)
        np.testing.assert_allclose(tool.errorCovPost, covariance, rtol=0, atol=1e-12)


def test_feedback_on_matrices_does_not_explain_their_product(master):
    def predict(state, covariance, F, Q):
        return F @ state, F @ covariance

    exercise = next(e for e in read_exercises(master) if e.function == "predict")
    feedback = repr(run_cases(exercise, predict))
    assert "tracking-predict: 0 of 2 checks pass" in feedback and "value by value" not in feedback
