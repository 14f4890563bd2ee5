"""Reading text: rapidocr over the recorded drive's 90 frames, and the lesson's node for a minute in the room.

Printed per line of the sign: frames read without an error, and the share of characters that is right (edit
distance), from whole frames and from the sign enlarged four times; and what the table `network_errors` of the
lesson must hold. What is read by hand, the lesson computes itself.

Required: the lesson's table is what is measured; live, the subscriber receives what the node published.

Run it with `environment/test --benchmarks reading_text`; SECONDS_IN_THE_ROOM=20 is shorter, and 0 leaves the
live minute out. STRIDE=6 reads every sixth frame only.
"""

import os

import cv2
import numpy as np
from in_the_room import SECONDS, Topics, nanoseconds, print_rows, program, room, verdict
from lesson_nodes import names_of_reading_text, run_assignments
from sensor_msgs.msg import Image
from std_msgs.msg import String
from tqdm import tqdm

from imgproc_course.recording import open_recording

STRIDE = int(os.environ.get("STRIDE", "1"))
LINES = ("KITCHEN", "ROOM 204", "Please keep the floor clear")
TABLE = "network_errors"  # in the lesson
SIGN = 12  # its label
MARGIN = 12  # pixels around the sign that is cut out
TEXTS, IMAGES = "/text_reader/text", "/kachaka/front_camera/image_raw"


def network_errors(lesson):
    """{"way, line": the smallest edit distance to one of the texts in each frame, at most its length}."""
    recording = open_recording("drive")
    errors = {f"{way}, {line}": [] for way in ("whole frame", "enlarged") for line in LINES}
    for k in tqdm(range(0, 90, STRIDE), "network"):
        frame, (rows, cols) = recording.frame(k), np.nonzero(recording.labels(k) == SIGN)
        top, left = max(rows.min() - MARGIN, 0), max(cols.min() - MARGIN, 0)
        part = frame[top : rows.max() + MARGIN + 1, left : cols.max() + MARGIN + 1]
        enlarged = cv2.resize(part, None, fx=4, fy=4, interpolation=cv2.INTER_CUBIC)
        for way, image in (("whole frame", frame), ("enlarged", enlarged)):
            texts = lesson["read_text"](image)
            for line in LINES:
                distances = [lesson["edit_distance"](text, line) for text in texts]
                errors[f"{way}, {line}"].append(min([len(line), *distances]))
    return errors


def print_network(lesson):
    """Prints the scores and what the lesson's table must hold; whether it holds something else."""
    errors = network_errors(lesson)
    rows = [
        (name, f"{distances.count(0)} of {len(distances)}", 1 - np.mean(distances) / len(name.split(", ")[1]))
        for name, distances in errors.items()
    ]
    print_rows([(*row, f"{share:.3f}") for *row, share in rows], "way, line", "without error", "right")
    digits = {name: "".join(np.base_repr(e, 36).lower() for e in row) for name, row in errors.items()}
    for name in lesson[TABLE]:
        print(f'    "{name}":\n        "{digits[name][:45]}"\n        "{digits[name][45:]}",')
    return any(row[::STRIDE] != digits[name] for name, row in lesson[TABLE].items())


def print_live():
    """Prints what the node read in the room, from another process; whether messages were lost."""
    with room((3.4, -0.3, 0.0), rate=10, size=(1280, 720)):
        topics = Topics({TEXTS: String, IMAGES: Image})
        with program("lesson_nodes.py", "reading_text", SECONDS) as node:
            node.process.wait()
    looks = int(node.printed)
    texts = [msg.data.split(maxsplit=3) for msg in topics.messages[TEXTS]]
    counts = {line: sum(text[3] == line for text in texts) for line in LINES}
    first, last = float(texts[0][0]), float(texts[-1][0])
    sent = sum(first <= nanoseconds(msg) / 1e9 <= last for msg in topics.messages[IMAGES])
    print(f"{last - first:.0f} s live: {looks} of {sent} images read, {len(texts)} texts: {counts}")
    return not looks or not counts["KITCHEN"] or looks >= sent


if __name__ == "__main__":
    has_failed = print_network(run_assignments("reading_text", {TABLE}, names_of_reading_text()))
    has_failed |= SECONDS > 0 and print_live()
    raise SystemExit(verdict(has_failed))
