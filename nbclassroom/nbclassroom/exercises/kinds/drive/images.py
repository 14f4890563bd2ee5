"""Images of a drive: the map with its path, and what the camera saw before the decisive moment."""

import numpy as np
from PIL import Image

from nbclassroom import course
from nbclassroom.exercises.answer_images import encode_image
from nbclassroom.exercises.kinds.drive.drive import STEP, Drive, decisive_moment

_MAP_WIDTH, _FRAME_WIDTH = 280, 208  # pixels on the page
_STEPS_BEFORE = (15, 10, 5, 0)  # the decisive moment
_FILM_MAP_WIDTH = 240  # pixels; the camera's image beside it has the same height
_FILM_SPEED, _FILM_LOOPS = 10, 3
_MOST_FILM = 150_000  # bytes


def draw_map(record, scenario):
    """The room from above with the path of a drive, as an AnswerImage."""
    path, room = record["path"], course.load(course.drive_room)(scenario.get("room"))
    marks = {"goal": scenario.get("goal"), "balls": scenario.get("balls", ())}
    if record["ended"] or record["missed"]:
        marks["mark"] = path[record["decisive"]]
    pixels = course.load(course.drive_map)(path, record["bumps"], room=room, **marks)
    (x, y, _), (end_x, end_y, _) = path[0], path[-1]
    alt = f"The room from above: the path begins at x {x:.1f} m, y {y:.1f} m and ends at x {end_x:.1f} m,"
    alt += f" y {end_y:.1f} m; bumps: {len(record['bumps'])}"
    return _encode(scenario["title"], alt, pixels, _MAP_WIDTH)


def look_back(env, record, scenario):
    """The last camera images up to the decisive moment of a drive: it is driven again from its actions.

    ValueError: the environment does not drive the same path again.
    """
    again, last, images = Drive(env, scenario), record["decisive"], []
    for step in _repeated(again, record["actions"][:last]):
        if last - step in _STEPS_BEFORE:
            seconds, moment = (last - step) * STEP, decisive_moment(record)
            caption = f"{seconds:.1f} s before" if step < last else moment
            alt = f"What the camera of the robot sees {seconds:.1f} s before {moment}"
            images.append(_encode(caption, alt, env.unwrapped.frame(), _FRAME_WIDTH))
    if again.record()["path"] != record["path"][: last + 1]:
        raise ValueError(f"the drive in the scenario {scenario['title']!r} takes another path if repeated")
    return images


def _repeated(drive, actions):
    """The number of each step, before which a drive repeats the actions until then."""
    for step, action in enumerate(actions):
        yield step
        drive.act(action)
    yield len(actions)


def draw_film(env, record, scenario):
    """A film of a drive, which is driven again: what the camera saw each second, and the path until then."""
    room, frames = course.load(course.drive_room)(scenario.get("room")), []
    for step in _repeated(Drive(env, scenario), record["actions"]):
        if step % round(1 / STEP) == 0:
            bumps = [bump for bump in record["bumps"] if bump[0] <= step]
            drawn = course.load(course.drive_map)(record["path"][: step + 1], bumps, room=room)
            frames.append(_side_by_side(env.unwrapped.frame(), drawn))
    seconds = record["steps"] * STEP
    alt = f"{seconds:.0f} s of a drive, {_FILM_SPEED} times as fast: what the camera sees, and the path"
    while True:
        first, *others = map(Image.fromarray, frames)
        milliseconds = round(1000 * seconds / _FILM_SPEED / len(frames))
        options = {"save_all": True, "append_images": others, "duration": milliseconds, "loop": _FILM_LOOPS}
        film = encode_image(scenario["title"], alt, first, kind="webp", quality=35, method=4, **options)
        if len(film.png) <= _MOST_FILM:
            return film
        frames = frames[::2]


def _side_by_side(frame, drawn):
    height = round(drawn.shape[0] * _FILM_MAP_WIDTH / drawn.shape[1])
    width = round(frame.shape[1] * height / frame.shape[0])
    images = _image_of(frame).resize((width, height)), _image_of(drawn).resize((_FILM_MAP_WIDTH, height))
    return np.hstack([np.asarray(image) for image in images])


def _image_of(bgr):
    return Image.fromarray(np.ascontiguousarray(bgr[..., ::-1]))


def _encode(caption, alt, bgr, width):
    return encode_image(caption, alt, _image_of(bgr), width, "webp", quality=75)
