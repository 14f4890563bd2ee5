"""The camera model of ROS and OpenCV: pinhole and plumb_bob distortion."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

UNDISTORTION_STEPS = 40


@dataclass(frozen=True)
class CameraModel:
    """Intrinsics of a camera: focal lengths and principal point in pixels, plumb_bob distortion.

    The center of the first pixel is (0, 0). `distortion` is (k1, k2, p1, p2, k3) of sensor_msgs/CameraInfo.

    Raises
    ------
    ValueError : a size or focal length that is not positive, a distortion that has not 5 numbers, NaN or
        infinity
    """

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    distortion: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0, 0.0)

    def __post_init__(self):
        if min(self.width, self.height, self.fx, self.fy) <= 0:
            raise ValueError(
                f"a camera needs a positive size and focal length, got {self.width}×{self.height} pixels, "
                f"fx {self.fx}, fy {self.fy}"
            )
        numbers = (self.fx, self.fy, self.cx, self.cy, *self.distortion)
        if not np.isfinite(numbers).all():
            raise ValueError(f"a camera needs finite numbers, got {', '.join(map(str, numbers))}")
        if len(self.distortion) != 5:
            raise ValueError(f"distortion is 5 numbers (k1, k2, p1, p2, k3), got {len(self.distortion)}")

    @property
    def matrix(self) -> NDArray[np.float64]:
        """K, (3, 3) float64."""
        return np.array([[self.fx, 0, self.cx], [0, self.fy, self.cy], [0, 0, 1]], float)

    def project(self, points: ArrayLike) -> NDArray[np.float64]:
        """Pixels (..., 2) as (column, row) of points (..., 3) in the optical frame; NaN for what lies behind.

        Source: OpenCV's projectPoints, https://docs.opencv.org/4.x/d9/d0c/group__calib3d.html
        """
        points = np.asarray(points, float)
        depth = np.where(points[..., 2] > 0, points[..., 2], np.nan)
        x, y = points[..., 0] / depth, points[..., 1] / depth
        radial, x_tangential, y_tangential = self._distortion_at(x, y)
        x, y = x * radial + x_tangential, y * radial + y_tangential
        return np.stack([x * self.fx + self.cx, y * self.fy + self.cy], -1)

    def unproject(self, pixels: ArrayLike) -> NDArray[np.float64]:
        """Rays (..., 3) with depth 1 in the optical frame, of pixels (..., 2) as (column, row).

        `ray * depth` is the point that has this depth along the optical axis. The distortion is undone by
        fixed-point iteration, as in OpenCV; for a field of view of more than about 100° it need not converge.
        """
        pixels = np.asarray(pixels, float)
        x_distorted, y_distorted = (pixels[..., 0] - self.cx) / self.fx, (pixels[..., 1] - self.cy) / self.fy
        x, y = x_distorted, y_distorted
        if any(self.distortion):
            for _ in range(UNDISTORTION_STEPS):
                radial, x_tangential, y_tangential = self._distortion_at(x, y)
                x, y = (x_distorted - x_tangential) / radial, (y_distorted - y_tangential) / radial
        return np.stack([x, y, np.ones_like(x)], -1)

    def resized(self, width: int, height: int) -> CameraModel:
        """The model of the image resized to width × height, as cv2.resize does: the corners stay corners."""
        horizontal, vertical = width / self.width, height / self.height
        fx, fy = self.fx * horizontal, self.fy * vertical
        cx, cy = (self.cx + 0.5) * horizontal - 0.5, (self.cy + 0.5) * vertical - 0.5
        return replace(self, width=width, height=height, fx=fx, fy=fy, cx=cx, cy=cy)

    def every(self, stride: int) -> CameraModel:
        """The model of image[::stride, ::stride]."""
        width, height = -(-self.width // stride), -(-self.height // stride)
        fx, fy, cx, cy = (pixels / stride for pixels in (self.fx, self.fy, self.cx, self.cy))
        return replace(self, width=width, height=height, fx=fx, fy=fy, cx=cx, cy=cy)

    def rays(self) -> NDArray[np.float64]:
        """The ray of each pixel, (height, width, 3) float64."""
        return self.unproject(np.stack(np.meshgrid(np.arange(self.width), np.arange(self.height)), -1))

    def _distortion_at(self, x, y):
        k1, k2, p1, p2, k3 = self.distortion
        r2 = x * x + y * y
        radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3))
        return radial, 2 * p1 * x * y + p2 * (r2 + 2 * x * x), p1 * (r2 + 2 * y * y) + 2 * p2 * x * y
