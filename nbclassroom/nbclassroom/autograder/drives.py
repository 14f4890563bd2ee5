"""Drives in grading: the environment is in this process, the controller in a kernel of the sandbox.

Between them are observations and two numbers. All that comes from the kernel may be forged: each message can
at most be the next two numbers, and what is judged is the record that the environment gives.
"""

import struct
import time
from functools import lru_cache

import numpy as np

from nbclassroom import course
from nbclassroom.autograder.verdict import DriveVerdict
from nbclassroom.exercises.drive import LOOK_SECONDS, Drive
from nbclassroom.exercises.running import CallResult

CHECK = "from nbclassroom.autograder.sandbox.inside.drive_cell import drive\n\ndrive({function})"
_LONGEST = 2_000  # characters of a text from a kernel


@lru_cache(maxsize=4)
def environment(sensors):
    """This process's environment for these sensors: the next drive in it begins at once."""
    return course.load(course.drive_environment)(sensors)


class GradedDrive:
    """A drive through a scenario that a kernel controls by its messages."""

    def __init__(self, sensors, scenario):
        began = time.monotonic()
        self._drive, self._scenario = Drive(environment(tuple(sensors)), scenario), scenario
        self.layout = self._drive.layout  # (name, dtype, shape) of each array of an observation
        self.seconds = time.monotonic() - began  # that the robot took
        self._ending, self._has_begun = None, False

    def answer(self, action):
        """The bytes for the kernel after the content of its message "action"; the first one has no speeds."""
        began = time.monotonic()
        if self._has_begun and not self._drive.over:
            self._act(action)
        self._has_begun = True
        data = b"" if self._drive.over else self._observation()
        self.seconds += time.monotonic() - began
        return struct.pack("<I", len(data)) + data

    def _act(self, action):
        if "timed_out" in action:
            self._ending = CallResult(timed_out=True)
            self._drive.stop(f"one look took more than {LOOK_SECONDS:g} s of processor time")
        elif "error" in action:
            texts = {key: str(action.get(key, ""))[:_LONGEST] for key in ("error", "message", "line")}
            self._ending = call = CallResult(**texts)
            reason = ": ".join(filter(None, (call.error, call.message)))
            self._drive.stop(f"{reason} ({call.line})" if call.line else reason)
        elif "refused" in action:
            self._drive.stop(str(action["refused"])[:_LONGEST])
        else:
            self._drive.act(action.get("speeds"))

    def _observation(self):
        observation = self._drive.observation
        return b"".join(np.asarray(observation[name], dtype).tobytes() for name, dtype, _ in self.layout)

    def verdict(self):
        """The DriveVerdict on what the robot did until now."""
        return DriveVerdict(self._drive.record(), self._scenario, self._ending)
