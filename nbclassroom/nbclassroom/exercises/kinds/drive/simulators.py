"""Let a learner's `control` drive in scenarios. It runs here; the robot is in simulators, other processes.

They live as long as it. While one computes its next observation, `control` answers another one.
"""

import atexit
import contextlib
import math
import pickle
import select
import subprocess
import sys
import warnings
from dataclasses import dataclass, field
from typing import Any

from ...running import CallResult, LimitedOutput, call_within, failure_fields
from .drive import STEP, STEP_SECONDS, Cost, form_of, seconds_of, speeds_of, steps_of

_SIMULATORS = 2
_SHOWN_STEPS = 20  # between two states of the progress bar
_KEPT_LINES = 13  # of what a drive prints: one more than is shown


class SimulatorError(RuntimeError):
    """A simulator ended, or could not do what it was asked for."""


class _Simulator:
    """One process that simulates, see `simulator`."""

    def __init__(self):
        # A session of its own: Ctrl-C and a kernel's interrupt are for the process that asks.
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", f"{__package__}.simulator"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        self._requests, self._replies = filter(None, (self._process.stdin, self._process.stdout))

    def ask(self, *request):
        """Send a request; its reply is to be read before the next one."""
        with contextlib.suppress(BrokenPipeError):  # `reply` tells
            pickle.dump(request, self._requests)
            self._requests.flush()

    def reply(self):
        try:
            is_right, reply = pickle.load(self._replies)
        except (EOFError, pickle.UnpicklingError) as error:
            raise SimulatorError("a simulator ended unexpectedly; check again") from error
        if not is_right:
            raise SimulatorError(reply)
        return reply

    def fileno(self):
        return self._replies.fileno()

    def close(self):
        self._process.kill()
        for pipe in (self._requests, self._replies):
            with contextlib.suppress(OSError):
                pipe.close()
        self._process.wait()


_simulators: list[_Simulator] = []  # of this process


@atexit.register
def close_simulators():
    """End the simulators of this process; the next drive starts others."""
    running, _simulators[:] = list(_simulators), []  # at once: a reply that waits is never read
    for simulator in running:
        simulator.close()


@contextlib.contextmanager
def _all_simulators():
    """The simulators, started if there are none; what interrupts a drive ends them."""
    try:
        while len(_simulators) < _SIMULATORS:
            _simulators.append(_Simulator())
        yield tuple(_simulators)
    except BaseException:
        close_simulators()
        raise


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

    def answer(self, observation, name):
        """The request to the simulator after an observation."""
        if self.excess:
            return self._end()
        try:
            speeds = self._call(observation)
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # noqa: BLE001 - the learner's code may raise anything
            self.failure = failure_fields(error, self.control)
            return "stop", _reason(self.failure, name)
        if excess := self.cost.excess(seconds_of(self.scenario)):
            self.excess.append(f"{name} {excess}")
            return self._end()
        try:
            return "act", *speeds_of(speeds)
        except ValueError as error:
            return "stop", str(error)

    def _end(self):
        """The last request, because the drives of this check cost too much; frees what it keeps."""
        self.control, self.memory = None, {}
        return "stop", self.excess[0]

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
        fields = self.failure or {"value": form_of(self.record)}
        end = math.inf if self.failure else self.record["decisive"] * STEP
        lines = [
            f"{seconds:.1f} s: {line}"
            for seconds, output in self.prints
            for line in output.getvalue().splitlines()
            if seconds <= end
        ]
        return CallResult(printed="\n".join(lines[-_KEPT_LINES:]), warning=self.warning, **fields)


def _reason(failure, name):
    if failure.get("timed_out"):
        return f"{name} took longer than {STEP_SECONDS} s for one step"
    text = ": ".join(filter(None, (f"{name} raised {failure['error']}", failure["message"])))
    return f"{text} (your {failure['line']})" if failure["line"] else text


def drive_scenarios(exercise, scenarios, make_control, progress=None):
    """Drive in scenarios; [(the record of the drive, its CallResult)].

    `make_control` gives a `control` for each: its globals are its own. `progress` takes the share that was
    driven, 0 to 1, now and then.
    """
    excess: list[str] = []
    runs = [_Run(make_control(), scenario, excess) for scenario in scenarios]
    waiting, steps = list(runs), 0
    driving: dict[_Simulator, _Run] = {}
    total = sum(map(steps_of, scenarios))
    with _all_simulators() as simulators:
        while waiting or driving:
            for simulator in set(simulators) - driving.keys():
                if waiting:
                    driving[simulator] = waiting.pop(0)
                    simulator.ask("begin", exercise.sensors, driving[simulator].scenario)
            for simulator in select.select(list(driving), [], [])[0]:
                reply, run = simulator.reply(), driving[simulator]
                if "record" in reply:
                    driving.pop(simulator).record = reply["record"]
                else:
                    simulator.ask(*run.answer(reply, exercise.answer_name))
                    steps += 1
                    if progress and steps % _SHOWN_STEPS == 0:
                        progress(steps / total)
    return [(run.record, run.result()) for run in runs]


def images_of_drive(request, call):
    """What a simulator draws of the drive of a CaseCall; the request names a function of `images`."""
    with _all_simulators() as simulators:
        simulators[0].ask(request, call.record, *call.arguments)
        return simulators[0].reply()
