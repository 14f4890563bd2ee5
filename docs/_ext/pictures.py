"""The pictures and films of the site, made from the recorded drive and the simulated room.

    .venv/bin/python docs/_ext/pictures.py      writes docs/_static/live and docs/_static/films, in a minute

Each film has a still beside it, for readers who asked their system for less motion.
"""

import math

import cv2
import numpy as np
from lessons import ROOT
from PIL import Image

from imgproc_course.imaging import canny, to_gray
from imgproc_course.recording import open_recording
from imgproc_course.simulation.room_env import RoomEnv
from imgproc_course.simulation.room_map import draw_map

STATIC = ROOT / "docs/_static"
SIZE = (480, 270)
PERIOD = 100  # milliseconds from one image of a film to the next


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
    return cv2.cvtColor(canny(to_gray(small(frame)), low, high), cv2.COLOR_GRAY2BGR)


def live_stills(frame):
    """What stands for the live cells of the lessons."""
    shifted = frame.copy()
    shifted[..., 2] = np.roll(frame[..., 2], 20, axis=1)
    pictures = {
        "darken": small(frame) // 2,
        "edges": np.hstack([small(frame), edges_of(frame)]),
        "gray": cv2.cvtColor(to_gray(small(frame)), cv2.COLOR_GRAY2BGR),
        "channels": small(shifted),
    }
    for name, picture in pictures.items():
        save_still(STATIC / "live" / f"{name}.webp", picture)


def drive_room(control, seconds, **options):
    """The environment, and the images of a drive: the camera beside the map."""
    env = RoomEnv(("scan", "image"), image_size=SIZE)
    observation, _ = env.reset(seed=1, options={"duration": seconds} | options)
    frames, over = [], False
    while not over:
        observation, _, _, over, _ = env.step(control(observation))
        drawn = draw_map(env.path, room=env.room)
        width = round(SIZE[1] * drawn.shape[1] / drawn.shape[0])
        frames.append(np.hstack([env.frame(), small(drawn, (width, SIZE[1]))]))
    env.close()
    return frames


def curve(observation):
    return 0.25, 0.5 * math.sin(observation["time"][0])


def brake(observation):
    """Straight ahead, slower the nearer the next thing is."""
    ahead = min(observation["scan"][:15].min(), observation["scan"][-15:].min())
    return min(0.3, max(0.0, 0.5 * (ahead - 0.45))), 0.0


def main():
    recording = open_recording("drive")
    live_stills(recording.frame(30))
    film = [np.hstack([small(f), edges_of(f)]) for f in map(recording.frame, range(20, 56))]
    save_film("edges", film, 10)
    save_film("brakes", drive_room(brake, 6.0, start=(0.0, 0.0, 0.0), movers=["toycar", "person"]), -1)
    save_still(STATIC / "live" / "steer.webp", drive_room(curve, 6.0)[-1])


if __name__ == "__main__":
    main()
