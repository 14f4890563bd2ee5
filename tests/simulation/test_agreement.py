"""The room agrees with the recorded drive, at its poses and times."""

import cv2
import numpy as np

from imgproc_course.simulation import CAMERA, Simulation

PARAMETERS = cv2.aruco.DetectorParameters()
PARAMETERS.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX  # or the corners are whole pixels
DETECTOR = cv2.aruco.ArucoDetector(cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50), PARAMETERS)


def marker_corners(image, number=7):
    corners, ids, _ = DETECTOR.detectMarkers(image)
    return corners[ids.ravel().tolist().index(number)][0]


def test_the_camera_is_the_recorded_ones(drive):
    info = drive.camera_info
    np.testing.assert_array_equal(CAMERA.matrix.ravel(), info.k)
    np.testing.assert_allclose(CAMERA.distortion, info.d, atol=1e-12)


def test_marker_corners(at_frames, drive):
    errors = [
        np.linalg.norm(marker_corners(frame) - marker_corners(drive.frame(k)), axis=1).mean()
        for k, (frame, _, _) in at_frames.items()
    ]
    assert np.mean(errors) < 1, errors  # pixels


def test_depth(at_frames, drive):
    for k, (_, depth, _) in at_frames.items():
        error = np.abs(depth.astype(int) - drive.depth(k))
        assert np.median(error) <= 1, k  # millimetres
        assert np.mean(error <= 10) > 0.96, k


def test_labels(at_frames, drive):
    shares = [np.mean(labels == drive.labels(k)[::2, ::2]) for k, (_, _, labels) in at_frames.items()]
    assert np.mean(shares) > 0.985
    assert min(shares) > 0.98


def test_image(at_frames, drive):
    quality = [cv2.PSNR(frame, drive.frame(k)) for k, (frame, _, _) in at_frames.items()]
    assert min(quality) > 20, quality  # dB


def test_person_car_and_ball_move_as_recorded(drive):
    for k in (30, 89):
        with Simulation(time=k / 10) as room:
            assert room.label_names == drive.label_names
            for name in ("person", "toycar", "ball"):
                pose, recorded = room.pose(name), drive.pose(name, k)
                np.testing.assert_allclose(pose[:3], recorded[:3], atol=1e-4)
                # The recorded ball turns by 0.04 % too much: 3 milliradians at its end.
                assert abs(pose[3:] @ recorded[3:]) > 0.999998, (name, k)
