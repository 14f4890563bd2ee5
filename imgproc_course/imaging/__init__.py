"""Image processing by hand, in NumPy: grayscale, noise, filters, binarization, gradients and Canny."""

from .binarization import adaptive_threshold, otsu_threshold, threshold
from .canny import CannyStages, canny_stages, double_threshold, hysteresis, suppress
from .canny_fast import canny
from .filters import bilateral_filter, box_blur, gaussian_blur, median_blur
from .gradients import direction, gradient_angle, magnitude, sobel
from .grayscale import average_gray, lightness_gray, linear_light_gray, to_gray
from .noise import add_gaussian_noise, add_salt_and_pepper
from .quality import psnr, ssim

__all__ = [
    "CannyStages",
    "adaptive_threshold",
    "add_gaussian_noise",
    "add_salt_and_pepper",
    "average_gray",
    "bilateral_filter",
    "box_blur",
    "canny",
    "canny_stages",
    "direction",
    "double_threshold",
    "gaussian_blur",
    "gradient_angle",
    "hysteresis",
    "lightness_gray",
    "linear_light_gray",
    "magnitude",
    "median_blur",
    "otsu_threshold",
    "psnr",
    "sobel",
    "ssim",
    "suppress",
    "threshold",
    "to_gray",
]
