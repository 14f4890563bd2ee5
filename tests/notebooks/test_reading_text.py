"""The lesson "Reading text": its solutions give what the field's tools give, on many inputs."""

import cv2
import numpy as np
import pytest


def test_label_is_connected_components_up_to_the_order(solutions):
    rng = np.random.default_rng(0)
    for number in range(60):
        mask = rng.random((int(rng.integers(1, 30)), int(rng.integers(1, 40)))) < 0.1 + 0.01 * number
        labels = solutions["label"](mask)
        count, tool = cv2.connectedComponents(mask.astype(np.uint8), connectivity=8)
        pairs = np.unique(np.stack([labels.ravel(), tool.ravel()]), axis=1)
        assert pairs.shape[1] == len(set(pairs[0])) == len(set(pairs[1]))  # one to one
        assert labels.max() + 1 == count and (labels[~mask] == 0).all()
        firsts = [int(np.argmax(labels.ravel() == i)) for i in range(1, count)]
        assert firsts == sorted(firsts)


def test_ncc_is_match_template(solutions):
    rng = np.random.default_rng(1)
    for _ in range(100):
        a, b = rng.integers(0, 256, (2, 24, 24)).astype(np.float32)
        b = b + rng.uniform(-2, 2) * a
        tool = cv2.matchTemplate(a, b, cv2.TM_CCOEFF_NORMED)[0, 0]
        assert solutions["ncc"](a.astype(float), b.astype(float)) == pytest.approx(tool, abs=1e-4)
    assert solutions["ncc"](np.full((3, 3), 5.0), np.eye(3)) == 0.0
