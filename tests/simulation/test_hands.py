"""Drawn hands and moving gestures are what their numbers say."""

import numpy as np
import pytest

from imgproc_course.simulation import GESTURES, Hand, draw_hand, gesture_track, hand_mask, random_hand


def test_a_hand_has_as_many_fingers_as_it_raises():
    tips = [(37, 88), (23, 110), (29, 135), (49, 156), (82, 66)]  # index finger to little finger, thumb
    for fingers in range(6):
        mask = hand_mask(Hand(fingers, 100, 120, 50))
        assert [mask[tip] for tip in tips] == [number < fingers for number in range(5)]
        assert mask[100, 120] and mask[179, 120] and not mask[179, 150]  # palm and arm


def test_a_hand_is_as_large_and_turned_and_placed_as_asked():
    hand = Hand(3, 120, 120, 20)
    mask = hand_mask(hand, (241, 241))[60:181, 60:181]
    turned = hand_mask(hand._replace(turn=np.pi / 2), (241, 241))[60:181, 60:181]
    np.testing.assert_array_equal(turned, np.rot90(mask, -1))  # clockwise
    moved = hand_mask(hand._replace(row=125, col=112), (241, 241))[65:186, 52:173]
    np.testing.assert_array_equal(moved, mask)
    larger = hand_mask(hand._replace(size=40), (241, 241))
    np.testing.assert_array_equal(larger[::2, ::2], mask)
    bent = hand_mask(hand._replace(bends=(-9, 0, 0, 0, 0)), (241, 241))[60:181, 60:181]
    assert bent[36, 43] and not mask[36, 43] and mask[34, 48] and not bent[34, 48]  # the index finger's tip


def test_a_glove_is_green_and_covers_the_mask_alone():
    rng = np.random.default_rng(0)
    frame = rng.integers(0, 256, (180, 240, 3)).astype(np.uint8)
    hand = random_hand(rng, 5)
    before, image = frame.copy(), draw_hand(frame, hand)
    changed, mask = (image != frame).any(axis=2), hand_mask(hand)
    assert changed[mask].mean() > 0.99 and (changed & ~mask).sum() < mask.sum() / 10  # mixed at the outline
    assert image[round(hand.row), round(hand.col)].tolist() == [60, 150, 70]
    noisy = draw_hand(frame * 0 + 128, hand, 12, rng)[:20].astype(float)
    assert noisy.std() == pytest.approx(12, abs=0.5) and noisy.mean() == pytest.approx(128, abs=0.5)
    assert (frame == before).all()


@pytest.mark.parametrize("gesture", GESTURES)
def test_a_track_is_the_gesture_that_it_is_called(gesture):
    way = {
        "swipe left": [(1, 0), (-1, 0)],
        "swipe right": [(-1, 0), (1, 0)],
        "raise": [(0, 1), (0, -1)],
        "wave": [(0, 0), (0, 0)],
        "circle": [(1, 0), (1, 0)],
        "stop": [(0, 0), (0, 0)],
    }[gesture]
    counts = set()
    for seed in range(60):
        even = gesture_track(gesture, np.random.default_rng(seed), noise=0, uneven=0)
        np.testing.assert_allclose(even[[0, -1]], way, atol=1e-6)
        uneven = gesture_track(gesture, np.random.default_rng(seed), noise=0, uneven=1)
        size = np.abs(uneven[0]).sum() or 1
        np.testing.assert_allclose(uneven[[0, -1]] / size, way, atol=1e-5)
        counts.add(len(even))
    assert min(counts) == 18 and max(counts) == 39
    steps = np.diff(even[:, 0])
    turns = np.count_nonzero(np.diff(np.sign(steps[np.abs(steps) > 1e-9])))
    assert turns == {"wave": 6, "circle": 1}.get(gesture, 0)
    noisy = gesture_track(gesture, np.random.default_rng(59), noise=0.1, uneven=0)
    assert (noisy - even).std() == pytest.approx(0.1, abs=0.03)


def test_an_unknown_gesture_is_refused():
    with pytest.raises(ValueError, match="unknown gesture 'salute'; use one of swipe left, swipe right"):
        gesture_track("salute", np.random.default_rng(0))
