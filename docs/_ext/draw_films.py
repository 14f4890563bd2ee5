"""The stills and films of the site, made from the recorded drive and the simulated room.

    .venv/bin/python docs/_ext/draw_films.py     writes docs/_static/live and docs/_static/films, in a minute

Each film has a still beside it, for readers who asked their system for less motion.
"""

import base64
import json
import math

import cv2
import numpy as np
from lessons import EMBEDDED, LESSONS, ROOT
from PIL import Image

from imgproc_course.geometry import LocalMap
from imgproc_course.imaging import canny, to_gray
from imgproc_course.recording import open_recording
from imgproc_course.simulation.room_env import RoomEnv
from imgproc_course.simulation.room_map import draw_map

STATIC = ROOT / "docs/_static"
SIZE = (480, 270)
FILM = (320, 180)  # of a film's left half
PERIOD = 100  # milliseconds from one image of a film to the next
SCANNER = 0.156  # metres from the axle to the scanner


def small(frame, size=SIZE):
    return cv2.resize(frame, size, interpolation=cv2.INTER_AREA)


def pil(bgr):
    return Image.fromarray(np.ascontiguousarray(bgr[..., ::-1]))


def save_still(path, bgr):
    path.parent.mkdir(exist_ok=True)
    pil(bgr).save(path, quality=75, method=6)


def save_film(name, frames, still):
    """An animated WebP, and the image of number `still` alone."""
    first, *others = map(pil, frames)
    path = STATIC / "films" / f"{name}.webp"
    path.parent.mkdir(exist_ok=True)
    first.save(path, save_all=True, append_images=others, duration=PERIOD, loop=0, quality=45, method=6)
    save_still(path.with_name(f"{name}_still.webp"), frames[still])


def edges_of(frame, low=100, high=250):
    """White edges of a BGR frame, as BGR."""
    return cv2.cvtColor(canny(to_gray(frame), low, high), cv2.COLOR_GRAY2BGR)


def live_stills(frame):
    """What stands for the live cells of the lessons."""
    gray = cv2.cvtColor(to_gray(small(frame)), cv2.COLOR_GRAY2BGR)
    stills = {
        "bright": np.hstack([small(frame), np.where(gray > 100, 255, 0).astype(np.uint8)]),
        "darken": small(frame) // 2,
        "edges": np.hstack([small(frame), edges_of(small(frame))]),
        "gray": gray,
        "gray_beside": np.hstack([small(frame), gray]),
    }
    for name, image in stills.items():
        save_still(STATIC / "live" / f"{name}.webp", image)


def beside(frame, image):
    """A frame, and an image of the same height to the right of it."""
    width = round(frame.shape[0] * image.shape[1] / image.shape[0])
    return np.hstack([frame, small(image, (width, frame.shape[0]))])


def drive_room(control, seconds, *, size=FILM, draw_beside=None, **options):
    """The images of a drive: the camera beside the map, or what draw_beside(env, observation) returns."""
    env = RoomEnv(("scan", "image"), image_size=size)
    observation, _ = env.reset(seed=1, options={"duration": seconds} | options)
    frames, over = [], False
    while not over:
        observation, _, _, over, _ = env.step(control(observation))
        drawn = draw_beside(env, observation) if draw_beside else draw_map(env.path, room=env.room)
        frames.append(beside(env.frame(), drawn))
    env.close()
    return frames


def curve(observation):
    return 0.25, 0.25 * math.sin(observation["time"][0])


def brake(observation):
    """Straight ahead, slower the nearer the next thing is."""
    ahead = min(observation["scan"][:15].min(), observation["scan"][-15:].min())
    return min(0.3, max(0.0, 0.5 * (ahead - 0.45))), 0.0


def follow(observation):
    """Towards the largest red thing, while it is small: the ball."""
    blue, green, red = np.moveaxis(observation["image"].astype(int), -1, 0)
    is_red = (red > 110) & (red > 1.7 * green) & (red > 1.7 * blue)
    _, _, boxes, centers = cv2.connectedComponentsWithStats(is_red.astype(np.uint8))
    if len(boxes) == 1:
        return 0.0, 0.0
    largest = 1 + boxes[1:, cv2.CC_STAT_AREA].argmax()
    speed = 0.3 if boxes[largest, cv2.CC_STAT_WIDTH] < 60 else 0.0
    return speed, 2.0 * (0.5 - centers[largest][0] / FILM[0])


def wander(observation):
    ahead = min(observation["scan"][:25].min(), observation["scan"][-25:].min())
    return (0.3, -0.1) if ahead > 0.8 else (0.0, -0.9)


class GrowingMap:
    """The map that the scans of a drive draw: white is free, black is occupied, gray is not seen yet."""

    def __init__(self):
        self.map = LocalMap((-1.2, -2.6), (104, 150))

    def __call__(self, env, observation):
        scan = np.where(observation["scan"] > 9.9, np.inf, observation["scan"])
        self.map.add_scan(env.path[-1], SCANNER, scan)
        gray = 255 - 255 / (1 + np.exp(-self.map.log_odds))
        return cv2.cvtColor(gray[::-1].astype(np.uint8), cv2.COLOR_GRAY2BGR)


def stored_image(lesson, cell_id):
    """The first image of a cell's stored output, as BGR."""
    (path,) = (path for path in LESSONS if path.stem.endswith(lesson))
    (cell,) = (cell for cell in json.loads(path.read_text("utf-8"))["cells"] if cell["id"] == cell_id)
    data = EMBEDDED.search(json.dumps(cell).replace('\\"', '"'))[2]
    return cv2.imdecode(np.frombuffer(base64.b64decode(data), np.uint8), cv2.IMREAD_COLOR)


def main():
    recording = open_recording("drive")
    live_stills(recording.frame(30))
    shots = [small(recording.frame(number), FILM) for number in range(20, 50)]
    save_film("edges", [np.hstack([shot, edges_of(shot)]) for shot in shots], 10)
    save_film("brakes", drive_room(brake, 5.0, start=(0.0, 0.0, 0.0), movers=["toycar", "person"])[::2], -1)
    balls = [(1.0, 0.0, 1.2, -0.4)]
    save_film("follows", drive_room(follow, 8.0, start=(0.0, 0.0, 0.0), balls=balls)[::2], -1)
    save_film("maps", drive_room(wander, 18.0, start=(0.0, 0.0, 0.0), draw_beside=GrowingMap())[::6], -1)
    sign = stored_image("reading_text", "reading_text-82")
    height, width = sign.shape[:2]
    inside = sign[height * 4 // 100 : height * 80 // 100, width * 8 // 100 : width * 98 // 100]  # no axes
    save_still(STATIC / "films" / "reads.webp", small(inside, SIZE))
    steered = drive_room(curve, 6.0, size=SIZE, start=(0.0, 0.0, 0.0))
    save_still(STATIC / "live" / "steer.webp", steered[-1])


if __name__ == "__main__":
    main()
