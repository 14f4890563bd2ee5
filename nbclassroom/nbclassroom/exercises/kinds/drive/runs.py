"""Let a learner's `control` drive in scenarios, one after another, in this process."""

import contextlib
import copy
import functools
import math
import types
import warnings
from dataclasses import dataclass, field
from typing import Any

from ...names_read import NamesRead
from ...progress_bar import progress_bar
from ...running import NONE, CallResult, LimitedOutput, attempt, call_within, failure_fields, globals_of
from .drive import STEP, STEP_SECONDS, Cost, Drive, environment, seconds_of, steps_of

_SHOWN_STEPS = 20  # between two states of the progress bar
_KEPT_LINES = 13  # of what a drive prints: one more than is shown


class _Observation(dict):
    """An observation that notes what is read of it."""

    def __init__(self, values, read):
        super().__init__(values)
        self._read = read

    def __getitem__(self, name):
        self._read.add(name)
        return super().__getitem__(name)

    def get(self, name, default=None):
        self._read.add(name)
        return super().get(name, default)


@dataclass
class _Run:
    """One drive of a `control`: what it was told, what it printed, and why it failed."""

    control: Any  # the function; None after all drives cost too much
    scenario: dict
    excess: list  # why no drive of this check goes on; empty if they do
    memory: dict = field(default_factory=dict)
    cost: Cost = field(default_factory=Cost)
    prints: list = field(default_factory=list)  # (seconds after the start, LimitedOutput) of each call
    warning: str = ""
    failure: dict = field(default_factory=dict)
    record: dict = field(default_factory=dict)
    read: set = field(default_factory=set)  # the names in its observations that it read

    def step(self, drive, name):
        """Let `control` answer what the robot sees now, and the robot drive until the next step."""
        try:
            if not self.excess:
                speeds = self._call(_Observation(copy.deepcopy(drive.observation), self.read))
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # noqa: BLE001 - the learner's code may raise anything
            self.failure = failure_fields(error, self.control)
            drive.stop(_reason(self.failure, name))
            return
        if excess := self.cost.excess(seconds_of(self.scenario)):
            self.excess.append(f"{name} {excess}")
        if self.excess:  # frees what it keeps
            self.control, self.memory = None, {}
            drive.stop(self.excess[0])
        else:
            self.failure = {"value": NONE} if speeds is None else {}
            drive.act(speeds)

    def _call(self, observation):
        output = LimitedOutput()
        self.prints.append((observation["time"], output))
        with warnings.catch_warnings(record=True) as caught_warnings:
            warnings.simplefilter("always")
            with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output), self.cost.of_call():
                speeds = call_within(lambda: self.control(observation, self.memory), STEP_SECONDS)
        self.warning = self.warning or (str(caught_warnings[0].message) if caught_warnings else "")
        return speeds

    def result(self):
        """What it did as a CallResult; it printed the last lines before the moment that is shown."""
        end = math.inf if self.failure else self.record["decisive"] * STEP
        lines = [
            f"{seconds:.1f} s: {line}"
            for seconds, output in self.prints
            for line in output.getvalue().splitlines()
            if seconds <= end
        ]
        return CallResult(printed="\n".join(lines[-_KEPT_LINES:]), warning=self.warning, **self.failure)


def _reason(failure, name):
    if failure.get("timed_out"):
        return f"{name} took longer than {STEP_SECONDS} s for one step"
    text = ": ".join(filter(None, (f"{name} raised {failure['error']}", failure["message"])))
    return f"{text} (your {failure['line']})" if failure["line"] else text


def drive_scenarios(exercise, scenarios, make_control):
    """Drive in scenarios; [(the record of the drive, its CallResult)].

    `make_control` gives a `control` for each: its globals are its own.
    """
    excess: list[str] = []
    runs, steps, total = [], 0, sum(map(steps_of, scenarios))
    with progress_bar(f"Driving {len(scenarios)} scenarios") as progress:
        for scenario in scenarios:
            drive = Drive(environment(exercise.sensors), scenario)
            runs.append(run := _Run(make_control(), scenario, excess))
            while not drive.over:
                run.step(drive, exercise.answer_name)
                steps += 1
                if progress and steps % _SHOWN_STEPS == 0:
                    progress(steps / total)
            run.record = drive.record() | {"read": sorted(run.read)}
    return [(run.record, run.result()) for run in runs]


def with_own_globals(function):
    """A function that begins with copies of the values that it reads: no drive continues another one."""
    namespace = globals_of(function)
    if not isinstance(function, types.FunctionType):
        return function
    own = dict(namespace)
    for name, value in NamesRead(function).names.items():
        if isinstance(value, types.FunctionType) and value.__globals__ is namespace:
            own[name] = _copied(value, own)
        elif not isinstance(value, (types.ModuleType, type)):
            own[name] = attempt(functools.partial(copy.deepcopy, value), value)
    return _copied(function, own)


def _copied(function, namespace):
    parts = function.__name__, function.__defaults__, function.__closure__
    copied = types.FunctionType(function.__code__, namespace, *parts)
    copied.__kwdefaults__ = function.__kwdefaults__
    return copied
