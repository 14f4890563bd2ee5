"""What a drive's check cell calls: it gives the learner's controller one observation after another.

The robot is outside the sandbox. Out goes a message "action" for each step, with two numbers or with what
ended the drive; in comes an observation: its length in four bytes, then its arrays one after another. A
length of 0 ends the drive. What the controller returns is judged outside.
"""

import math
import numbers
import os
import signal
import struct

import numpy as np

from nbclassroom.autograder.sandbox.inside import MIME, check_cell, shell
from nbclassroom.exercises import running
from nbclassroom.exercises.kinds.drive.drive import Cost, speeds_of


def drive(control):
    """Let a controller drive until the robot outside ends it; returns its memory."""
    memory: dict = {}
    reply: dict = {}
    cost = Cost()
    running.set_handler(signal.SIGPROF, check_cell.raise_time_up)
    while True:
        shell.WRITER.send("action", **reply)
        data = _read(struct.unpack("<I", _read(4))[0])
        if not data:
            return memory
        with cost.of_call():
            reply = _look(control, _observation(data), memory)
        if "speeds" in reply and (excess := cost.excess()):
            reply = {"excess": excess}


def explore(control):
    """Let a controller drive; then show what stands in memory["found"], as plain data."""
    shell.WRITER.send_answer({MIME: _plain(drive(control).get("found"))})


def _plain(found):
    """What a controller found as {"markers": [[number, x, y], ...], "word": text}; None if it is no dict."""
    if not isinstance(found, dict):
        return None
    markers = found.get("markers")
    items = markers.items() if isinstance(markers, dict) else ()
    return {"markers": [place for item in items if (place := _place(*item))], "word": found.get("word")}


def _place(number, point):
    """[number, x, y] of a marker, None if it has another form."""
    try:
        x, y = map(float, point)
    except Exception:  # noqa: BLE001 - the learner's code may have made it
        return None
    return [int(number), x, y] if isinstance(number, numbers.Integral) else None


def _look(control, observation, memory):
    """What a controller does with an observation in its processor time, as the content of a message."""
    try:
        running.set_timer(signal.ITIMER_PROF, check_cell.CASE["seconds"], 0.1)
        try:
            value = control(observation, memory)
        finally:
            running.set_timer(signal.ITIMER_PROF, 0)
    except BaseException as error:  # noqa: BLE001 - the learner's code may raise anything
        return running.failure_fields(error, control)
    try:
        return {"speeds": speeds_of(value)}
    except ValueError as error:
        return {"refused": str(error)}


def _observation(data):
    observation, start = {}, 0
    for name, dtype, shape in check_cell.CASE["layout"]:
        values = np.frombuffer(data, dtype, math.prod(shape), start).reshape(shape)
        start += values.nbytes
        observation[name] = values.copy() if shape else values.item()
    return observation


def _read(count):
    """So many bytes; the process ends if there are no more, because then nobody reads what it says."""
    parts = []
    while count:
        parts.append(os.read(shell.WRITER.descriptor, min(count, 1 << 20)))
        if not parts[-1]:
            os._exit(0)
        count -= len(parts[-1])
    return b"".join(parts)
