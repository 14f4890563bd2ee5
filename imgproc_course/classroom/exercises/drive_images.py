"""Images of a drive: the map with its path, and what the camera saw before the decisive moment.

`simulator` and grading draw them, where the environment is.
"""

import io

import numpy as np
from PIL import Image

from imgproc_course.classroom import course
from imgproc_course.classroom.exercises.answer_images import AnswerImage
from imgproc_course.classroom.exercises.drive import LOOK, Drive, decisive_moment, load

_MAP_WIDTH, _FRAME_WIDTH = 280, 208  # pixels on the page
_LOOKS_BEFORE = (15, 10, 5, 0)  # the decisive moment


def draw_map(record, scenario):
    """The room from above with the path of a drive, as an AnswerImage."""
    path, room = record["path"], load(course.DRIVE_ROOM)(scenario.get("room"))
    marks = {name: scenario.get(name) for name in ("goal", "ball")} | {"mark": path[record["decisive"]]}
    pixels = load(course.DRIVE_MAP)(path, record["bumps"], room=room, **marks)
    (x, y, _), (end_x, end_y, _) = path[0], path[-1]
    alt = f"The room from above: the path begins at x {x:.1f} m, y {y:.1f} m and ends at x {end_x:.1f} m,"
    alt += f" y {end_y:.1f} m; bumps: {len(record['bumps'])}"
    return _encode(scenario["title"], alt, pixels, _MAP_WIDTH)


def look_back(env, record, scenario):
    """The last camera images up to the decisive moment of a drive: it is driven again from its actions.

    ValueError: the environment does not drive the same path again.
    """
    again, frames = Drive(env, scenario), {}
    for look in range(record["decisive"] + 1):
        if record["decisive"] - look in _LOOKS_BEFORE:
            frames[record["decisive"] - look] = env.unwrapped.frame()
        if look < record["decisive"]:
            again.act(*record["actions"][look])
    if again.record()["path"] != record["path"][: record["decisive"] + 1]:
        raise ValueError(f"the drive in the scenario {scenario['title']!r} takes another path if repeated")
    moment = decisive_moment(record)
    return [_frame_image(frame, looks * LOOK, moment) for looks, frame in frames.items()]


def _frame_image(frame, seconds, moment):
    caption = f"{seconds:.1f} s before" if seconds else moment
    alt = f"What the camera of the robot sees {seconds:.1f} s before {moment}"
    return _encode(caption, alt, frame, _FRAME_WIDTH)


def _encode(caption, alt, bgr, width):
    """An image as an AnswerImage of this width on the page."""
    image, buffer = Image.fromarray(np.ascontiguousarray(bgr[..., ::-1])), io.BytesIO()
    image.save(buffer, format="webp", quality=75)
    height = round(image.height * width / image.width)
    return AnswerImage(caption, alt, buffer.getvalue(), width, height, "image/webp")
