"""The room from above as an image, with what a robot did in it."""

import math
from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from .room import ROLLED, Room, recorded_room
from .wheels import BODY_CENTER, BODY_LENGTH, BODY_WIDTH

PIXELS = 60  # per metre
FLOOR, THINGS, SCALE = (245, 250, 250), (150, 140, 130), (40, 40, 40)  # blue, green, red
PATH, START, BUMP = (200, 90, 30), (60, 150, 0), (0, 0, 220)
MARK, GOAL, BALL = (0, 140, 255), START, (60, 60, 230)


def draw_map(
    path: Sequence[Sequence[float]],
    bumps: Sequence[Sequence[float]] = (),
    *,
    room: Room | None = None,
    goal: Sequence[float] | None = None,
    balls: Sequence[Sequence[float]] = (),
    mark: Sequence[float] | None = None,
) -> NDArray[np.uint8]:
    """The room from above with the path of a robot, (height, width, 3) uint8 BGR; x to the right, y up.

    Parameters
    ----------
    path : of the robot, (x, y, yaw) in metres and radians; a green dot at its start, the body at its end
    bumps : (step, x, y), where the robot was: red crosses
    room : the living room of the recorded drive, if omitted
    goal : (x, y, radius), a green circle
    balls : (x, y, dx, dy) of each: where it began, and a line to where it would roll
    mark : (x, y) or more, where the robot was at a moment: an orange ring around it
    """
    space = (room or recorded_room()).free_space
    x0, y0 = space.origin

    def pixels(points):
        return np.rint((np.asarray(points, float)[:, :2] - (x0, y0)) * PIXELS).astype(np.int32)

    def pixel(point):
        return pixels([point])[0].tolist()

    image = floor_plan(space.metres > 0, space.cell)
    cv2.polylines(image, [pixels(path)], False, PATH, 2, cv2.LINE_AA)
    cv2.circle(image, pixel(path[0]), 6, START, -1, cv2.LINE_AA)
    cv2.polylines(image, [pixels(body_at(*path[-1]))], True, PATH, 2, cv2.LINE_AA)
    if goal is not None:
        cv2.circle(image, pixel(goal), round(goal[2] * PIXELS), GOAL, 2, cv2.LINE_AA)
    for x, y, dx, dy in balls:
        cv2.circle(image, pixel((x, y)), round(0.11 * PIXELS), BALL, -1, cv2.LINE_AA)
        cv2.line(image, pixel((x, y)), pixel((x + ROLLED * dx, y + ROLLED * dy)), BALL, 2, cv2.LINE_AA)
    if mark is not None:
        cv2.circle(image, pixel(mark), round(0.55 * PIXELS), MARK, 2, cv2.LINE_AA)
    for _, *place in bumps:
        cv2.drawMarker(image, pixel(place), BUMP, cv2.MARKER_TILTED_CROSS, 16, 3)
    image = np.ascontiguousarray(image[::-1])
    x, y = 16, image.shape[0] - 16  # a bar of 1 m, at the bottom on the left
    cv2.rectangle(image, (x - 6, y - 18), (x + PIXELS + 6, y + 6), FLOOR, -1)
    cv2.rectangle(image, (x, y - 2), (x + PIXELS, y + 2), SCALE, -1)
    cv2.putText(image, "1 m", (x + 16, y - 5), cv2.FONT_HERSHEY_SIMPLEX, 0.4, SCALE, 1, cv2.LINE_AA)
    return image


def floor_plan(is_free, cell):
    """An image of cells (H, W) bool of this size in metres; its height and width are even, for videos."""
    size = [2 * round(count * cell * PIXELS / 2) for count in is_free.shape[::-1]]
    image = np.where(is_free[..., None], FLOOR, THINGS).astype(np.uint8)
    return cv2.resize(image, size, interpolation=cv2.INTER_NEAREST)


def body_at(x, y, yaw):
    """The outline of the robot's body, with its nose: points (5, 2) in metres."""
    c, s = math.cos(yaw), math.sin(yaw)
    front, back, side = BODY_CENTER + BODY_LENGTH / 2, BODY_CENTER - BODY_LENGTH / 2, BODY_WIDTH / 2
    corners = [(back, side), (back, -side), (front - side, -side), (front, 0.0), (front - side, side)]
    return [(x + a * c - b * s, y + a * s + b * c) for a, b in corners]
