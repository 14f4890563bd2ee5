"""Drives in grading: the environment is in this process, the controller in a kernel of the sandbox.

Between them are observations and two numbers. All that comes from the kernel may be forged: each message can
at most be the next two numbers, and what is judged is the record that the environment gives.
"""

import struct
import time

import numpy as np

from ...comparison import Difference
from ...running import CallResult, CaseCall, Verdict
from .drive import (
    LARGE,
    METRICS,
    SLOW,
    STEP,
    STEP_SECONDS,
    Drive,
    environment,
    metric_text,
    passes,
    seconds_of,
    steps_of,
)
from .sentences import sentences_of

_LONGEST = 2_000  # characters of a text from a kernel


class GradedDrive:
    """A drive through a scenario that a kernel controls by its messages."""

    def __init__(self, exercise, scenario):
        began = time.monotonic()
        self._drive, self._scenario = Drive(environment(exercise.sensors), scenario), scenario
        self.record = self._drive.record  # what the robot did until now
        self.layout = self._drive.layout  # (name, dtype, shape) of each array of an observation
        self.cpu_seconds, self.call_seconds = seconds_of(scenario), STEP_SECONDS  # for all its calls, for one
        self.seconds = time.monotonic() - began  # that the robot took
        self._name, self._ending, self._has_begun = exercise.answer_name, CallResult(), False
        self.is_slow = False  # then other drives are not worth their time

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
            self._end(f"one step took more than {STEP_SECONDS:g} s of processor time", timed_out=True)
        elif action.get("excess") == LARGE:
            self._end(f"{self._name} {LARGE}", error="MemoryError")
        elif "excess" in action:
            self.is_slow = True
            self._end(f"{self._name} {SLOW}", timed_out=True)
        elif "error" in action:
            texts: dict = {key: str(action.get(key, ""))[:_LONGEST] for key in ("error", "message", "line")}
            reason = ": ".join(filter(None, (texts["error"], texts["message"])))
            self._end(f"{reason} ({texts['line']})" if texts["line"] else reason, **texts)
        elif "refused" in action:
            self._drive.stop(str(action["refused"])[:_LONGEST])
        else:
            self._drive.act(action.get("speeds"))

    def _end(self, reason, **fields):
        self._ending = CallResult(**{"message": reason} | fields)
        self._drive.stop(reason)

    def _observation(self):
        observation = self._drive.observation
        return b"".join(np.asarray(observation[name], dtype).tobytes() for name, dtype, _ in self.layout)

    def verdict(self, case):
        """The Verdict on what the robot did until now; its metrics are the environment's."""
        record, scenario = self.record(), self._scenario
        sentence = " ".join(sentences_of(record, scenario))
        is_whole = record["steps"] == steps_of(scenario)  # it drove as long as the scenario asks for
        values, names = record["metrics"], scenario["thresholds"] if is_whole else ()
        return Verdict(
            [case_call(case, record, self._ending)],
            forged="" if is_whole or record["ended"] else sentence,
            when=f"{record['steps'] * STEP:.1f} s after the start",
            measured=", ".join(f"{METRICS[name].title} {metric_text(name, values[name])}" for name in names),
            # Without any text of the learner's, such as a part of a value that was returned.
            told_of_hidden="it returned something else than two numbers" if record["ended"] else sentence,
        )


def case_call(case, record, result):
    """The CaseCall of the one drive of a case: its record, and the CallResult of the controller."""
    (expected,) = case.calls
    (scenario,) = expected.arguments
    is_wrong = result.finished and not passes(record, scenario)
    difference = Difference("drive", "", " ".join(sentences_of(record, scenario))) if is_wrong else None
    return CaseCall(case, expected.arguments, expected.result, result, difference, record)
