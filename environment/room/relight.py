"""What imgproc_course/simulation/room_light.py must know of light and tone curve, as arrays."""

import itertools
import math

import bpy
import cv2
import numpy as np
from scene import drive

STEPS = 512  # of ratios of light, see ratio_tables
ONE = {"floor": 256, "room": 256}  # what stands for the ratio 1 of values; of the others 128
CURVE_LIGHT = np.geomspace(2.0**-13, 64, 1024, dtype=np.float32)  # of the tone curve
WINDOW = ((1.7, 3.5), (0.85, 2.15))  # metres, x and z
LAMP, LAMP_RADIUS = (1.6, -0.2, 2.4), 0.25  # metres
# Of the window, with what is seen through it, and of the lamp.
POWER = {"day": (110.0, 26.0), "evening": (1.2, 60.0)}
SAMPLES = {"day": ((6, 4), 8), "evening": ((1, 1), 16)}  # points of light on them
SUN, SUN_RADIUS = np.array([0.10, 1, 1.02]) / np.linalg.norm([0.10, 1, 1.02]), 0.009  # towards it
SKY_DIRECTIONS = 28
GOLDEN_ANGLE = 2.399963
LEVELS = 31  # heights of the probes, between those that were baked


def ratio_tables(image, name, out):
    """(3, 64, STEPS) uint8: how a value / 4 of blue, green, red changes with a step of light.

    A step is a square root of the ratio of light: STEPS - 1 is 1 for the floor and the room, which only get
    darker, and STEPS is 16 for the others.
    """
    curve = tone_curve(image, out) / 257
    one = ONE.get(name.split("_")[0], 128)
    ratio = (np.arange(STEPS) / (STEPS - 1 if one == 256 else STEPS / 4)) ** 2
    value = np.arange(64)[:, None] * 4 + 1.5
    tables = []
    for channel in curve.T:
        after = np.interp(np.interp(value, channel, CURVE_LIGHT) * ratio, CURVE_LIGHT, channel)
        tables.append(np.clip(np.round(one * (after + 1) / (value + 1)), 0, 255).astype(np.uint8))
    return np.stack(tables)


def tone_curve(image, out):
    """What the tone curve makes of a linear image's mean, lighter and darker: (1024, 3) uint16 BGR."""
    color = image.reshape(-1, 3).mean(0, dtype=float)
    strip = np.ones((len(CURVE_LIGHT), 4), np.float32)
    strip[:, :3] = CURVE_LIGHT[:, None] * (color / color.max())
    strip_image = bpy.data.images.new("curve", len(strip), 1, float_buffer=True)
    strip_image.colorspace_settings.name = "Linear Rec.709"
    strip_image.pixels.foreach_set(strip.ravel())
    settings, path = bpy.context.scene.render.image_settings, out / "curve.png"
    settings.file_format, settings.color_mode, settings.color_depth = "PNG", "RGB", "16"
    strip_image.save_render(str(path), scene=bpy.context.scene)
    values = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)[0]
    path.unlink()
    return np.maximum.accumulate(values)


def sources(lighting):
    """What is the same in all rooms, by names."""
    return {
        f"lamps_{lighting}": lamps(lighting),
        "sky": sky(),
        "sun": SUN.round(6),
        "sun_slopes": sun_slopes(),
    }


def lamps(lighting):
    """Points of light on window and lamp: place, direction, power, (N, 7)."""
    (columns, rows), count = SAMPLES[lighting]
    window, lamp = POWER[lighting]
    (x0, x1), (z0, z1) = WINDOW
    points = []
    for i, k in itertools.product(range(columns), range(rows)):
        place = x0 + (x1 - x0) * (i + 0.5) / columns, drive.Y1 + 0.1, z0 + (z1 - z0) * (k + 0.5) / rows
        points.append((*place, 0, -1, 0, window / (columns * rows)))
    for k in range(count):
        x, y = on_circle(LAMP_RADIUS * math.sqrt((k + 0.5) / count), k)
        points.append((LAMP[0] + x, LAMP[1] + y, LAMP[2], 0, 0, -1, lamp / count))
    return np.array(points).round(6)


def on_circle(radius, k):
    """The place of the k-th of many points around a center."""
    return radius * math.cos(k * GOLDEN_ANGLE), radius * math.sin(k * GOLDEN_ANGLE)


def sky():
    """Directions from which as much light comes each: ways along x and y for each unit of height, (N, 2)."""
    heights = [max(math.sqrt(1 - (k + 0.5) / SKY_DIRECTIONS), 0.25) for k in range(SKY_DIRECTIONS)]
    return np.array([on_circle(math.sqrt(1 - z * z) / z, k) for k, z in enumerate(heights)]).round(6)


def sun_slopes():
    """Ways along x and y for each unit of height, of four points of the sun."""
    points = [SUN + SUN_RADIUS * np.array([i, 0, k]) for i, k in itertools.product((-1, 1), repeat=2)]
    return np.array([point[:2] / point[2] for point in points]).round(6)


def finer_probes(light):
    """The light on the probes, blue, green, red, at LEVELS heights, float16."""
    place = np.linspace(0, light.shape[2] - 1, LEVELS)
    first = np.minimum(place.astype(int), light.shape[2] - 2)
    after = (place - first)[:, None, None]
    return (light[:, :, first] * (1 - after) + light[:, :, first + 1] * after)[..., ::-1].astype(np.float16)
