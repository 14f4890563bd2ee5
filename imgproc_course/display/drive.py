"""Driving the robot by hand: its camera, a map from above, and keys, buttons or a gamepad."""

import collections
import contextlib
import itertools
import logging
import math
import threading
import time
from pathlib import Path
from typing import Any

import anywidget
import numpy as np

from imgproc_course.display.controls import in_a_row
from imgproc_course.display.figures import split_text
from imgproc_course.display.live_view import LiveView
from imgproc_course.display.screen import Style

HERE = Path(__file__).parent
robot_log = logging.getLogger("imgproc_course.ros.robot")
STALE = 0.3  # seconds; a command that the kernel reads so late is of a key that may be up again
MAP_PERIOD = 0.1  # seconds
CELL = 0.05  # metres: of the map's obstacles
BEHIND = 0.2  # metres; if the rays around a cell reach so far behind it, what stood there has moved away
FARTHEST = 4.0  # metres: farther away, the odometry's error would make walls move
STILL = 30  # scans in which something that has come stays in a cell until it counts as a wall
FEW = 20  # cells that can disappear at once in the same room
FASTEST = 0.6  # m/s: what is farther from the last odometry is of a robot that has begun again
# Where the Kachaka's scanner stands on it: x in metres, and turned to the left.
SCANNER = (0.156, math.pi / 2)


def drive(robot: Any, source: Any = None, *, text: str | None = None) -> "DriveView":
    """Shows what the robot sees, and drives it: arrow keys or W A S D, buttons, or a gamepad.

    The keys work while the map beside the image has the focus: click on it, or reach it with Tab. The robot
    drives only while a key, a button or a stick is held (Shift: at half the speed). It stops when the key is
    released, and when the map loses the focus, the page is closed or the kernel is busy or gone. The map from
    above shows the path by odometry, and by the laser scanner walls and what moves, in the odometry's frame.

    Parameters
    ----------
    robot : Robot
    source : what the image shows, as in `live_view`. If omitted: the topic of the robot's front camera.
    text : as in `live_view`

    Returns
    -------
    DriveView : a LiveView; .stop() also stops the robot, .trace is the way so far

    Raises
    ------
    ValueError : no Robot
    """
    if not all(hasattr(robot, name) for name in ("drive", "stop", "odometry")):
        raise ValueError(f"drive needs a Robot, got {type(robot).__name__}: drive(Robot())")
    if source is None:
        from imgproc_course.ros.robot_topics import TOPIC

        source = TOPIC
    caption, alt = split_text(text)
    style = Style(width=480, caption=caption, alt=alt or "What the robot's camera sees")
    view = DriveView(robot, source, DrivePad(), style)
    view.start()
    view.publish()
    return view


class DrivePad(anywidget.AnyWidget):
    """The map and the buttons in the browser; it sends commands as long as a key is held."""

    _esm = HERE / "drive.js"
    _css = HERE / "drive.css"


class _RobotWarnings(logging.Handler):
    """Shows the robot's warnings in a view while it runs, and not in a cell too."""

    def __init__(self, say):
        super().__init__(logging.WARNING)
        self._say = say

    def emit(self, record):
        self._say(record.getMessage())


class DriveView(LiveView):
    """The robot's image, and its controls; `drive` makes one and starts it."""

    def __init__(self, robot: Any, source: Any, pad: DrivePad, style: Style):
        self._robot, self._pad = robot, pad
        self._pad.on_msg(self._on_message)
        self._command: tuple[float, float, float] | None = None  # time, linear, angular
        self._commanded = threading.Condition()
        self._fastest = math.inf  # seconds from the browser's clock to ours, at best
        self._map = _Map()
        self._restarts = getattr(robot, "restarts", 0)
        self._threads: list[threading.Thread] = []
        self._warnings = _RobotWarnings(lambda text: self._screen.say(text))
        super().__init__(source, None, style, {})
        self._box.layout.width = f"{(style.width or 0) + 8}px"  # the texts above the image must not widen it
        self._box = in_a_row(self._box, self._pad)

    @property
    def trace(self) -> list[tuple[float, float]]:
        """The way so far: (x, y) in metres, in the frame of the odometry."""
        return list(self._map.trace)

    def start(self) -> None:
        if self.running:
            return
        super().start()
        robot_log.addHandler(self._warnings)
        for loop in (self._send_commands, self._draw_map):
            self._threads.append(threading.Thread(target=loop, args=(self._stopping,), daemon=True))
            self._threads[-1].start()

    def stop(self) -> None:
        super().stop()
        robot_log.removeHandler(self._warnings)
        with self._commanded:
            self._commanded.notify_all()
        for thread in self._threads:
            if thread is not threading.current_thread():
                thread.join(timeout=3)
        self._threads.clear()
        self._robot.stop()

    def __repr__(self):
        return f"Drive: {self._name}"

    def _on_message(self, _, content, buffers):
        kind = content.get("kind")
        if kind == "hello":  # a page shows the pad: it needs all of the map
            self._fastest = math.inf
            self._map.begin_again()
            return
        if kind == "restart":
            threading.Thread(target=self._restart, daemon=True).start()
            return
        delay = time.time() - content["time"]
        self._fastest = min(self._fastest, delay)
        if kind == "drive" and delay - self._fastest > STALE:
            return
        with self._commanded:
            self._command = time.monotonic(), content["linear"], content["angular"]
            self._commanded.notify_all()

    def _send_commands(self, stopping):
        """Sends each command of the browser once: without new ones the robot stops by itself."""
        while not stopping.is_set():
            with self._commanded:
                self._commanded.wait_for(lambda: self._command or stopping.is_set())
                command, self._command = self._command, None
            if command is None or stopping.is_set():
                continue
            moment, linear, angular = command
            if time.monotonic() - moment > STALE:
                linear = angular = 0.0
            try:
                self._robot.drive(linear, angular)
            except (RuntimeError, ValueError) as error:
                self._say_error(str(error))

    def _restart(self):
        try:
            self._robot.restart()
        except (AttributeError, RuntimeError, TimeoutError, ValueError) as error:
            self._say_error(f"this robot cannot restart: {error}")

    def _draw_map(self, stopping):
        while not stopping.wait(MAP_PERIOD):
            if self._hidden:
                continue
            try:
                scan = self._scan()  # first: it is drawn between two odometries
                if self._restarts != (restarts := getattr(self._robot, "restarts", 0)):
                    self._restarts = restarts
                    self._map.forget()
                message = self._map.update(self._robot.odometry, scan)
                self._pad.send(message | {"bumps": getattr(self._robot, "bumps", None)})
            except (RuntimeError, TimeoutError) as error:
                if not stopping.is_set():
                    self._say_error(str(error))

    def _scan(self):
        """The newest scan; None from a robot without a scanner."""
        with contextlib.suppress(TimeoutError, AttributeError):
            return self._robot.scan
        return None

    def _count_views(self, change):
        super()._count_views(change)
        if self._hidden:
            self._robot.stop()


class _Map:
    """The way and the obstacles so far, and what of them the browser does not have yet."""

    def __init__(self):
        self.trace: list[tuple[float, float]] = []
        self._cells: set[tuple[int, int]] = set()
        self._passed: set[tuple[int, int]] = set()  # cells that were empty once
        # In the last scans, one by one.
        self._met: collections.Counter[tuple[int, int]] = collections.Counter()
        # (time, x, y, yaw): a scan is older than the odometry.
        self._places: collections.deque[tuple[float, ...]] = collections.deque(maxlen=20)
        self.begin_again()

    def begin_again(self):
        """The next update has everything. Any thread may call it."""
        self._begins = True

    def forget(self):
        self.trace = []
        self._forget_cells()
        self._places.clear()
        self.begin_again()

    def update(self, odometry, scan):
        """The message for the browser; of trace and cells, what is new since the message before."""
        x, y, yaw = self._follow(odometry)
        begins, self._begins = self._begins, False
        count, new_cells, gone, moving = len(self.trace), set(), set(), set()
        if not self.trace or math.dist(self.trace[-1], (x, y)) > 0.01:
            self.trace.append((x, y))
        if scan is not None and (place := self._place_at(seconds(scan.header.stamp))):
            met = cells_of(scan, *place)
            gone = seen_through(self._cells, scan, *place) - met
            if len(gone) > max(len(self._cells) / 2, FEW):  # this is another room
                self._forget_cells()
                gone, begins = set(), True
            met, moving = self._still_and_moving(met, scan, place)
            new_cells = met - self._cells
            self._cells = (self._cells | met) - gone
        if begins:
            count, new_cells = 0, self._cells
        twist = odometry.twist.twist
        return {
            "pose": [round(v, 3) for v in (x, y, yaw)],
            "speed": [round(twist.linear.x, 3), round(twist.angular.z, 3)],
            "trace": [[round(u, 3), round(v, 3)] for u, v in self.trace[count:]],
            "cells": [[round(i * CELL, 3), round(j * CELL, 3)] for i, j in sorted(new_cells)],
            "gone": [[round(i * CELL, 3), round(j * CELL, 3)] for i, j in sorted(gone)],
            "moving": [[round(i * CELL, 3), round(j * CELL, 3)] for i, j in sorted(moving)],
            "begins": begins,
        }

    def _still_and_moving(self, met, scan, place):
        """The cells in which something stands, and those in which something has come; both of `met`."""
        self._met = collections.Counter({cell: self._met[cell] + 1 for cell in met})
        at_walls = {(i + a, j + b) for i, j in self._cells for a in (-1, 0, 1) for b in (-1, 0, 1)}
        moving = {cell for cell in met & self._passed - at_walls if self._met[cell] < STILL}
        self._passed |= cells_before(scan, *place) - met
        return met - moving, moving

    def _forget_cells(self):
        self._cells, self._passed = set(), set()
        self._met.clear()

    def _follow(self, odometry):
        """(x, y, yaw) of the odometry; what it cannot have reached since the last one begins a new map."""
        moment, position = seconds(odometry.header.stamp), odometry.pose.pose.position
        turn = odometry.pose.pose.orientation
        place = position.x, position.y, 2 * math.atan2(turn.z, turn.w)
        if self._places:
            before, *last = self._places[-1]
            is_far = math.dist(last[:2], place[:2]) > FASTEST * abs(moment - before) + CELL
            if is_far or (not any(place) and any(last)):
                self.forget()
        self._places.append((moment, *place))
        return place

    def _place_at(self, moment):
        """(x, y, yaw) at a time, between two odometries; None if there are none around it."""
        for (start, *first), (end, *second) in itertools.pairwise(self._places):
            if start <= moment <= end and end > start:
                share = (moment - start) / (end - start)
                second[2] = first[2] + math.remainder(second[2] - first[2], 2 * math.pi)
                return [a + share * (b - a) for a, b in zip(first, second, strict=True)]
        return None


def seconds(stamp):
    return stamp.sec + stamp.nanosec / 1e9


def _rays(scan, x, y, yaw):
    """Place of the scanner and angles of its rays, in the map; its ranges, 0 where it met nothing."""
    ahead, turned = SCANNER
    ranges = np.array(scan.ranges, float)
    ranges[~((ranges >= scan.range_min) & (ranges <= scan.range_max))] = 0
    place = x + ahead * math.cos(yaw), y + ahead * math.sin(yaw)
    return place, yaw + turned + scan.angle_min + scan.angle_increment * np.arange(len(ranges)), ranges


def cells_of(scan, x, y, yaw):
    """The cells {(i, j)} of the map in which a LaserScan of a robot at (x, y, yaw) has met something."""
    place, angles, ranges = _rays(scan, x, y, yaw)
    points = (place + ranges[:, None] * np.stack([np.cos(angles), np.sin(angles)], -1))[ranges > 0]
    return set(map(tuple, np.floor(points / CELL).astype(int).tolist()))


def cells_before(scan, x, y, yaw):
    """The cells {(i, j)} that the scan's rays have passed, well before what they have met."""
    place, angles, ranges = _rays(scan, x, y, yaw)
    steps = np.arange(CELL, FARTHEST, CELL)
    # Along a wall, a ray touches what its neighbours have met.
    shortest = np.min([np.roll(ranges, k) for k in range(-3, 4)], axis=0)
    rows, columns = np.nonzero(steps < shortest[:, None] - BEHIND)
    points = place + steps[columns, None] * np.stack([np.cos(angles), np.sin(angles)], -1)[rows]
    return set(map(tuple, np.unique(np.floor(points / CELL).astype(int), axis=0).tolist()))


def seen_through(cells, scan, x, y, yaw):
    """Those of the cells {(i, j)} through which the scan's rays have passed."""
    place, (first, *_), ranges = _rays(scan, x, y, yaw)
    cells = np.array(sorted(cells), int).reshape(-1, 2)
    columns, rows = ((cells + 0.5) * CELL - place).T
    numbers = np.round((np.arctan2(rows, columns) - first) % (2 * math.pi) / scan.angle_increment).astype(int)
    around = np.append(ranges, 0)[np.clip(numbers[:, None] + range(-3, 4), -1, len(ranges))]
    return set(map(tuple, cells[around.min(axis=1) > np.hypot(columns, rows) + BEHIND].tolist()))
