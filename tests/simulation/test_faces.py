"""Drawn faces: what their numbers, the light and the turn change, and that a face detector finds them."""

import cv2
import numpy as np
import pytest

from imgproc_course.simulation import draw_face, put_face, random_identity
from imgproc_course.simulation.faces import RANGES

CASCADE = cv2.data.haarcascades + "haarcascade_frontalface_default.xml"


def identity(seed=0, **numbers):
    values = random_identity(np.random.default_rng(seed))
    for name, value in numbers.items():
        values[list(RANGES).index(name.replace("_", " "))] = value
    return values


def gray(seed=0, *, size=100, side_light=0.0, yaw=0.0, **numbers):
    face = draw_face(identity(seed, **numbers), size, side_light, yaw)
    return cv2.cvtColor(face, cv2.COLOR_BGR2GRAY).astype(float)


def iris_columns(image):
    """The middle columns of the two irises: the darkest of the eyes' row, in either half."""
    rows = image[40:50].min(axis=0)
    return [half.start + int(np.argmin(rows[half])) for half in (slice(20, 50), slice(50, 80))]


def test_a_face_from_the_front_is_symmetric_and_its_numbers_move_its_parts():
    face = gray()
    assert face.shape == (100, 100) and face[0, 0] == 120 == face[-1, -1]
    assert np.abs(face - face[:, ::-1]).max() <= 1
    assert gray(skin=1.0)[65:70].mean() > gray(skin=0.6)[65:70].mean() + 30
    near, far = (iris_columns(gray(eye_distance=value, eye_row=-0.1)) for value in (0.28, 0.33))
    assert far[0] < near[0] < near[1] < far[1]
    mouths = [int(np.argmin(gray(mouth_row=row)[65:80, 50])) for row in (0.46, 0.56)]
    assert mouths[1] - mouths[0] in (4, 5)  # 0.1 of 2.1 in 100 pixels


def test_light_from_the_right_and_a_turn_to_the_right():
    front, right, left = (gray(side_light=light) for light in (0.0, 0.6, -0.6))
    assert right[:, 50:].mean() > front[:, 50:].mean() > left[:, 50:].mean()
    assert right[30:80, 60:75].mean() > right[30:80, 25:40].mean() + 40
    np.testing.assert_allclose(right, left[:, ::-1], atol=1)
    straight, turned = (iris_columns(gray(eye_row=-0.1, yaw=yaw)) for yaw in (0.0, 0.2))
    assert all(4 <= after - before <= 9 for before, after in zip(straight, turned, strict=True))


def test_a_face_changes_its_square_of_the_frame_alone():
    frame = np.random.default_rng(1).integers(0, 256, (120, 200, 3), dtype=np.uint8)
    before = frame.copy()
    changed, (left, top, width, height) = put_face(frame, identity(), 70, 15, 80)
    assert (frame == before).all()
    outside = np.ones((120, 200), bool)
    outside[15:95, 70:150] = False
    assert (changed[outside] == before[outside]).all()
    alone = draw_face(identity(), 80)
    assert (changed[15:95, 70:150][20:60, 25:55] == alone[20:60, 25:55]).all()  # where no background is left
    assert (left, top, width, height) == (80, 25, 59, 59)
    for place in ((121, 0), (-1, 0), (0, 41)):
        with pytest.raises(ValueError, match=r"does not lie in a frame of 200 × 120; choose left up to 120"):
            put_face(frame, identity(), *place, 80)


def test_a_cascade_finds_the_box():
    detector, errors = cv2.CascadeClassifier(CASCADE), []
    for seed in range(30):
        size = 80 + 4 * seed
        frame, box = put_face(np.full((240, 320, 3), 90, np.uint8), identity(seed), 60, 20, size)
        faces = detector.detectMultiScale(cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY), 1.1, 4)
        if len(faces):
            errors.append(np.abs(np.subtract(faces[0], box)).max() / size)
    assert len(errors) >= 27 and np.median(errors) < 0.05
