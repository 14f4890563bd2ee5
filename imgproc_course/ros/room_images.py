"""The room in real time: a simulated robot that follows commands, and an image for each time that is due."""

import collections
import functools
import math
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, wait

from imgproc_course.messages import array_to_image
from imgproc_course.ros.image_sources import FRAME_ID, FrameImage
from imgproc_course.ros.room_messages import camera_info, sensor_topics
from imgproc_course.ros.session import log
from imgproc_course.simulation import Simulation
from imgproc_course.simulation.furnished import room_of

STAND_STILL = (0.0, 0.0, -math.inf)  # m/s, rad/s, and when this was commanded
COMMAND_TIMEOUT = 0.5  # seconds: an older command stops the robot, on the real one too
MOTION_RATE = 30  # steps of the motion per second, at least
LONGEST_DELAY = 1.0  # seconds: behind by more, the room's time waits instead of catching up
RESTART_TIMEOUT = 10.0  # seconds that a restart waits for the new room's first image
RATE_WINDOW = 5.0  # seconds over which the reached rate is measured
SLOW = 0.9  # of the intended rate: below it, the robot says that it is slow


class RoomImages:
    """Yields (due, image) for each image of a simulated robot's camera, as RecordedImages does.

    The robot moves between the images too, at MOTION_RATE or more. Its time is real time: where drawing takes
    too long, images are left out, and the motion catches up. If the image before was asked for its depth, a
    second thread computes the depth while the first draws the colors.

    `options` are of `Simulation`: seed, size, lighting, start; and room, the number of a furnished one, or
    None. Only the thread that iterates may use the `simulation`, and that of the depth. `on_motion(stamp in
    ns)` is called after each step of the motion.
    """

    def __init__(self, rate, *, room=None, start=None, **options):
        self.rate = rate
        # Of the simulation that runs, or begins next.
        self.options = options | {"room": room, "start": start or room_of(room).start}
        self.simulation = begun(self.options)
        self.simulation.frame()  # the first one takes a second, which the robot would miss while it drives
        self.on_motion: Callable[[int], None] = lambda stamp: None
        self.bumps = 0
        # Other threads set the command, and append to the restarts.
        self._command = STAND_STILL
        self._restarts: collections.deque[tuple[Simulation, threading.Event]] = collections.deque()
        self._is_reported = False
        self._times: list[float] = []  # of the images of this RATE_WINDOW
        self._depth_thread = ThreadPoolExecutor(1, "depth of the room")

    def command(self, linear, angular):
        """Sets the speeds (m/s, rad/s) that the robot strives for. Any thread may call it."""
        self._command = (linear, angular, time.monotonic())

    def restart(self, **changes):
        """Begins again with other options. Any other thread may call it.

        Person, car and ball begin again with a seed or a room, and otherwise go on. With another lighting
        alone the robot stays where it is; with another room alone it starts where that room says. Its
        odometry begins at zero in any case. After a ValueError the running one goes on.
        """
        if changes.keys() == {"lighting"}:
            changes["start"] = self.simulation.place
        if "room" in changes and "start" not in changes:
            changes["start"] = room_of(changes["room"]).start
        options = self.options | changes
        simulation = begun(options, 0.0 if changes.keys() & {"seed", "room"} else self.simulation.time)
        is_taken = threading.Event()
        self.options = options
        self._command = STAND_STILL
        self._restarts.append((simulation, is_taken))
        is_taken.wait(RESTART_TIMEOUT)

    def __iter__(self):
        steps_per_image = max(1, math.ceil(MOTION_RATE / self.rate))
        period = 1 / (self.rate * steps_per_image)
        start, steps, was_bumped = time.monotonic(), 0, False
        is_depth_wanted = False
        while True:
            delay = time.monotonic() - start - steps * period
            if delay > LONGEST_DELAY:
                start, delay = start + delay, 0.0
            time.sleep(max(0.0, -delay))
            if self._restarts:
                self._begin_again(*self._restarts.popleft())
            linear, angular, since = self._command
            if time.monotonic() - since > COMMAND_TIMEOUT:
                linear = angular = 0.0
            self.simulation.step(linear, angular, period)
            self.bumps += self.simulation.bumped and not was_bumped
            was_bumped = self.simulation.bumped
            stamp = time.time_ns()
            self.on_motion(stamp)
            # If the next image is due already, this one would only be late.
            if steps % steps_per_image == 0 and delay < steps_per_image * period:
                image = RoomImage(self.simulation, stamp)
                if is_depth_wanted:
                    image.begin_depth(self._depth_thread)
                yield time.monotonic(), image
                is_depth_wanted = image.end_depth()
                self._measure_rate()
            steps += 1

    def _begin_again(self, simulation, is_taken):
        self.simulation.close()
        self.simulation = simulation
        self.simulation.frame()
        is_taken.set()
        self._times.clear()

    def _measure_rate(self):
        """Counts an image; warns once, at the end of a RATE_WINDOW, if the reached rate is low."""
        self._times.append(time.monotonic())
        seconds = self._times[-1] - self._times[0]
        if seconds < RATE_WINDOW:
            return
        rate = (len(self._times) - 1) / seconds
        del self._times[:-1]
        if rate < SLOW * self.rate and not self._is_reported:
            self._is_reported = True
            log.warning(
                "the room reaches %.1f of %g images per second on this machine; ask for a lower rate, "
                'open_camera("room", rate=%d, switch=True), or subscribe to fewer topics',
                rate,
                self.rate,
                max(1, math.floor(rate)),
            )

    other_topics = staticmethod(sensor_topics)

    def close(self):
        self._depth_thread.shutdown()  # waits for what it draws
        self.simulation.close()


def begun(options, time=0.0):
    """A Simulation with a number in place of its room."""
    return Simulation(**options | {"room": room_of(options["room"])}, time=time)


class RoomImage(FrameImage):
    """What the robot's sensors give at one time; computed only when it is asked for."""

    frame_id = FRAME_ID

    def __init__(self, simulation, stamp):
        self.simulation, self.stamp = simulation, stamp
        self._depth, self._is_depth_wanted = None, False

    def begin_depth(self, thread):
        """Lets another thread, an Executor, compute the front camera's depth."""
        self._depth = thread.submit(self.simulation.depth)

    def end_depth(self):
        """Waits for that thread; returns whether the depth was asked for."""
        if self._depth is not None:
            wait([self._depth])
        return self._is_depth_wanted

    @functools.cached_property
    def _frame(self):
        return self.simulation.frame()

    def camera_info(self, header):
        return camera_info(self.simulation.camera, header)

    def depth(self, header, camera="front"):
        if camera == "front":
            self._is_depth_wanted = True
            if self._depth is not None:
                return array_to_image(self._depth.result(), "16UC1", header)
        elif self._depth is not None:
            wait([self._depth])  # the two depth cameras share a renderer
        return array_to_image(self.simulation.depth(camera), "16UC1", header)
