"""What a small camera adds to a clean image: lens blur, motion blur, vignette, noise."""

import cv2
import numpy as np

EXPOSURE = 0.02  # seconds, as in the recorded drive
# Standard deviation in gray levels, for an image of 640 columns; in the evening the gain is higher.
NOISE = {"day": 1.6, "evening": 4.0}
LENS_BLUR = 0.6  # pixels
NOISE_MARGIN = 64  # pixels by which the noise is larger than the image, so that it can be shifted


class Sensor:
    """The camera's own defects; its noise depends on the seed and on the number of the step alone."""

    def __init__(self, model, seed, lighting):
        self._model, self._seed = model, seed
        random = np.random.default_rng([seed, 2])
        shape = (model.height + NOISE_MARGIN, model.width + NOISE_MARGIN, 3)
        sigma = NOISE[lighting] * (model.width / 640) ** 0.5
        noise = np.rint(sigma * random.standard_normal(shape, np.float32))
        # Apart, each in one byte, they are added three times as fast.
        self._brighter, self._darker = (np.clip(n, 0, 255).astype(np.uint8) for n in (noise, -noise))
        self._vignette = np.repeat(vignette(model)[..., None], 3, 2)

    def __call__(self, image, step, angular):
        """The image (H, W, 3) uint8 as the sensor gives it, while the robot turns by `angular` rad/s."""
        image = cv2.GaussianBlur(image, (3, 3), LENS_BLUR)
        width = round(abs(angular) * EXPOSURE * self._model.fx)
        if width > 1:
            image = cv2.blur(image, (width, 1))
        image = cv2.multiply(image, self._vignette, scale=1 / 255)
        row, col = np.random.default_rng([self._seed, 3, step]).integers(0, NOISE_MARGIN, 2)
        part = slice(row, row + image.shape[0]), slice(col, col + image.shape[1])
        return cv2.subtract(cv2.add(image, self._brighter[part]), self._darker[part])


def vignette(model):
    """(H, W) uint8: 255 at the center, less in the corners; the recorded drive's, on gamma-coded values."""
    row, col = np.arange(model.height)[:, None] - model.cy, np.arange(model.width)[None] - model.cx
    squared = (row * row + col * col) / (model.cx**2 + model.cy**2)
    linear = 1 - 0.30 * squared + 0.06 * squared * squared
    return np.rint(255 * np.sqrt(linear) ** 0.9).astype(np.uint8)
