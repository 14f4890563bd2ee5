"""Noise depends only on its seed, has the requested strength, and does not change the input."""

import cv2
import numpy as np
import pytest
import skimage.metrics

from imgproc_course.imaging import add_gaussian_noise, add_salt_and_pepper, psnr, ssim


def test_the_same_seed_gives_the_same_noise_and_another_seed_does_not():
    image = np.full((50, 60), 128, np.uint8)
    for add, amount in ((add_gaussian_noise, 12), (add_salt_and_pepper, 0.1)):
        assert np.array_equal(add(image, amount, seed=3), add(image, amount, seed=3))
        assert not np.array_equal(add(image, amount, seed=3), add(image, amount, seed=4))
        generator = np.random.default_rng(3)
        assert np.array_equal(add(image, amount, seed=generator), add(image, amount, seed=3))
        assert not np.array_equal(add(image, amount, seed=generator), add(image, amount, seed=3))
        assert (image == 128).all()


def test_gaussian_noise_has_the_requested_standard_deviation():
    noise = add_gaussian_noise(np.full((400, 400), 128, np.uint8), 12).astype(float) - 128
    assert abs(noise.mean()) < 0.1
    assert noise.std() == pytest.approx(12, abs=0.1)


def test_gaussian_noise_is_clipped_at_black_and_white():
    assert add_gaussian_noise(np.zeros((99, 99), np.uint8), 50).min() == 0
    bright = add_gaussian_noise(np.full((99, 99), 255, np.uint8), 50)
    assert bright.max() == 255 and 0.45 < (bright == 255).mean() < 0.55
    assert np.array_equal(add_gaussian_noise(bright, 0), bright)


def test_salt_and_pepper_change_the_requested_fraction_of_the_pixels():
    noisy = add_salt_and_pepper(np.full((400, 400), 128, np.uint8), 0.1)
    assert (noisy == 0).mean() == pytest.approx(0.05, abs=0.003)
    assert (noisy == 255).mean() == pytest.approx(0.05, abs=0.003)
    assert (noisy == 128).mean() == pytest.approx(0.9, abs=0.005)


def test_salt_and_pepper_change_all_channels_of_a_pixel():
    noisy = add_salt_and_pepper(np.full((99, 99, 3), 128, np.uint8), 0.5)
    assert (noisy == noisy[..., :1]).all() and set(np.unique(noisy)) == {0, 128, 255}


@pytest.mark.parametrize("fraction", [0, 1])
def test_salt_and_pepper_change_no_pixel_or_every_pixel(fraction):
    noisy = add_salt_and_pepper(np.full((99, 99), 128, np.uint8), fraction)
    assert set(np.unique(noisy)) == ({128} if fraction == 0 else {0, 255})


def test_psnr_of_known_errors():
    black = np.zeros((10, 10), np.uint8)
    assert psnr(black, black) == np.inf
    assert psnr(black, black + np.uint8(255)) == 0
    assert psnr(black, black + np.uint8(1)) == pytest.approx(48.1308, abs=1e-4)
    assert psnr(black + np.uint8(1), black) == psnr(black, black + np.uint8(1))


def test_psnr_equals_opencvs_and_ssim_equals_skimages(gray_frames, frames):
    for frame, colour in zip(gray_frames, frames, strict=True):
        noisy = add_gaussian_noise(frame, 10)
        assert psnr(frame, noisy) == pytest.approx(cv2.PSNR(frame, noisy), abs=1e-9)
        assert psnr(colour, colour[::-1]) == pytest.approx(cv2.PSNR(colour, colour[::-1].copy()), abs=1e-9)
    for size in (3, 7, 11):
        truth = skimage.metrics.structural_similarity(frame, noisy, win_size=size, data_range=255)
        assert ssim(frame, noisy, size=size) == pytest.approx(truth, abs=1e-12)


def test_ssim_equals_skimages_on_small_images(grays):
    for name, image in grays.items():
        if min(image.shape) < 7:
            continue
        noisy = add_salt_and_pepper(image, 0.2)
        assert ssim(image, image) == 1, name
        truth = skimage.metrics.structural_similarity(image, noisy, data_range=255)
        assert ssim(image, noisy) == pytest.approx(truth, abs=1e-12), name
