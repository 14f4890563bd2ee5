"""The whole graph for a long time: camera, both nodes, a notebook. Is anything lost, does anything grow?"""

import json
import os
import signal
import statistics
import subprocess
import sys
import time
from pathlib import Path

import cv2
import psutil
from rich.console import Console
from rich.table import Table
from std_msgs.msg import String

import imgproc_course
from imgproc_course.ros.camera import TOPIC
from imgproc_course.ros.session import RosSession
from imgproc_course.ros.subscriber import ImageSubscriber

NODES = {"image_gray_processor": "gray", "image_edge_detection": "edges"}  # node -> the output that is heard
SAMPLES = 200  # of each process, however long the run
PATIENCE = 60.0  # seconds that a process may take to start
# Memory comes and goes by the working arrays of one picture (Canny's: 9 MiB), whichever moment is sampled;
# to keep one picture in 200 is 250 MB in 10 minutes.
MEMORY_SLACK = 20 << 20
_PLAY = "import sys; from imgproc_course.ros.player import play; sys.exit(play(topic={!r}, speed={!r}))"
_RUN = "import sys; sys.path.insert(0, {!r}); from {name}.{name} import main; sys.exit(main())"


def soak(minutes=10.0, speed=3.0, *, warm_up=25.0, say=print):
    """Runs the graph on topics of its own, and judges it.

    Parameters
    ----------
    minutes : how long, after the warm-up
    speed : times the drive's own 10 Hz
    warm_up : seconds before anything counts: processes start, buffers fill
    say : function of one line, for what happens meanwhile

    Returns
    -------
    int, the exit code: 0, or 1 when a picture was lost or failed, memory, threads or open files grew, or a
    process ended; Ctrl-C ends the run and judges what there is, or is 130 where nothing was measured yet

    Raises
    ------
    ValueError : a length, speed or warm-up that is none; the two packages are nowhere
    """
    for name, number in (("minutes", minutes), ("speed", speed)):
        if not 0 < number < float("inf"):
            raise ValueError(f"{name} must be a positive number, got {number!r}")
    if not 0 <= warm_up < float("inf"):
        raise ValueError(f"the warm-up must be 0 or more seconds, got {warm_up!r}")
    graph = _Graph(speed, say)
    # Ended by SIGTERM like by Ctrl-C, so that no camera and no node is left behind.
    former = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        graph.start()
        graph.run(warm_up)
        if graph.is_whole:
            graph.forget()
            say(f"warm after {warm_up:g} s; {minutes:g} minutes from now on (Ctrl-C ends them)")
            graph.run(minutes * 60)
            graph.catch_up()
    except KeyboardInterrupt:
        if not graph.is_warm:
            say("ended by Ctrl-C during the warm-up: nothing was measured")
            return 130
        say("ended by Ctrl-C")
    finally:
        graph.stop()
        signal.signal(signal.SIGTERM, former)
    return graph.report()


class _Graph:
    """Camera, nodes and subscribers, and what was seen of them."""

    def __init__(self, speed, say):
        self._say = say
        self._namespace = f"/soak_{os.getpid()}"
        self._topic = f"{self._namespace}/image_raw"
        rename = ["--ros-args", "-r", f"{TOPIC}:={self._topic}", "-r", f"__ns:={self._namespace}"]
        self._commands = {"camera": [sys.executable, "-c", _PLAY.format(self._topic, speed)]}
        self._commands |= {name: [*_command(name), *rename] for name in NODES}
        self._processes, self._watched, self._subscribers, self._before = {}, {}, {}, {}
        self._said = dict.fromkeys(self._commands, b"")  # the end of what each wrote to stderr
        self._numbers = {}
        self._problems = []
        self._seconds = 0.0
        self.is_warm = False

    @property
    def is_whole(self):
        return not self._problems

    def start(self):
        for name, command in self._commands.items():
            # In a session of their own, so that Ctrl-C on the terminal is ours alone.
            self._processes[name] = subprocess.Popen(
                command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True
            )
            os.set_blocking(self._processes[name].stderr.fileno(), False)
        self._session = RosSession.current()
        self._watched = {name: _Watched(process.pid) for name, process in self._processes.items()}
        self._watched["notebook"] = _Watched(os.getpid())
        for name, output in NODES.items():
            topic = f"{self._namespace}/{name}/{output}"
            # As a live view does: every frame becomes a JPEG.
            self._subscribers[name] = ImageSubscriber(topic, _as_jpeg, encoding="passthrough")
            self._session.node.create_subscription(
                String,
                f"{self._namespace}/{name}/statistics",
                lambda msg, name=name: self._numbers.update({name: json.loads(msg.data)}),
                1,
            )
        subscribers = self._subscribers.values()
        self._wait(lambda: all(subscriber.received for subscriber in subscribers), "no picture came")
        self._wait(lambda: len(self._numbers) == len(NODES), "no statistics came")

    def _wait(self, condition, otherwise):
        end = time.monotonic() + PATIENCE
        while not condition() and not self._problems:
            if time.monotonic() > end:
                self._problems.append(f"{otherwise} within {PATIENCE:g} s")
            self._look_for_ends()
            time.sleep(0.05)

    def run(self, seconds):
        """Watches for so long, or until something has ended."""
        began = time.monotonic()
        told = began
        pause = max(0.2, seconds / SAMPLES)
        self._seconds = 0.0
        while self._seconds < seconds and not self._problems:
            time.sleep(min(pause, seconds - self._seconds))
            self._seconds = time.monotonic() - began
            self._look_for_ends()
            for watched in self._watched.values():
                watched.sample()
            if time.monotonic() - told > max(10.0, seconds / 10):
                told = time.monotonic()
                self._say(f"{told - began:.0f} s: {self._line()}")

    def _look_for_ends(self):
        for name, process in self._processes.items():
            code = process.poll()  # before the pipe is read: what it said last is in there
            self._said[name] = (self._said[name] + (process.stderr.read() or b""))[-4000:]
            if code is not None and not self._problems:
                said = self._said[name].decode(errors="replace").strip().splitlines()
                self._problems.append(f"{name} ended with code {code}: {' / '.join(said[-2:])}")

    def _line(self):
        return "; ".join(f"{name} {self._frames(name)} frames, {self._losses(name)} lost" for name in NODES)

    def forget(self):
        """What came so far does not count."""
        self.is_warm = True
        for watched in self._watched.values():
            watched.samples.clear()
        self._before = {name: self._counts(name) for name in NODES}

    def catch_up(self):
        """Waits for statistics that are newer than the last picture that counts."""
        self._numbers.clear()
        self._wait(lambda: len(self._numbers) == len(NODES), "no statistics came")

    def _counts(self, name):
        numbers = self._numbers.get(name, {})
        subscriber = self._subscribers[name]
        return {
            "frames": numbers.get("processed", 0),
            "lost before the node": numbers.get("lost") or 0,
            "failed": numbers.get("failed", 0) + subscriber.failed,
            "lost before the notebook": subscriber.dropped or 0,
        }

    def _since(self, name):
        before = self._before.get(name, {})
        return {what: number - before.get(what, 0) for what, number in self._counts(name).items()}

    def _frames(self, name):
        return self._since(name)["frames"]

    def _losses(self, name):
        return sum(number for what, number in self._since(name).items() if what != "frames")

    def stop(self):
        self._final = {name: self._since(name) for name in self._subscribers}
        for process in self._processes.values():
            process.terminate()
        for process in self._processes.values():
            try:
                process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            process.stderr.close()
        RosSession().stop()

    def report(self):
        """Prints what was seen, and returns the exit code."""
        table = Table(title=f"{self._seconds:.0f} s, {self._topic}", title_justify="left")
        for column in ("process", "frames", "lost", "failed", "memory MiB", "threads", "files"):
            table.add_column(column, justify="left" if column == "process" else "right")
        for name, watched in self._watched.items():
            counts = self._final.get(name)
            lost = counts and counts["lost before the node"] + counts["lost before the notebook"]
            shown = [counts["frames"], lost, counts["failed"]] if counts else ["", "", ""]
            table.add_row(name, *map(str, shown), *watched.spans())
        Console(width=110).print(table)
        problems = list(self._problems)
        for name, counts in self._final.items():
            if not counts.pop("frames"):
                problems.append(f"{name}: no frame was processed")
            problems += [f"{name}: {number} {what}" for what, number in counts.items() if number]
        for name, watched in self._watched.items():
            problems += [f"{name}: {growth}" for growth in watched.growth()]
        for problem in problems:
            self._say(problem)
        self._say("something was lost, or grew" if problems else "no loss, no growth")
        return 1 if problems else 0


class _Watched:
    """Memory, threads and open files of a process, sampled."""

    def __init__(self, pid):
        self._process = psutil.Process(pid)
        self.samples = []

    def sample(self):
        try:
            with self._process.oneshot():
                memory = self._process.memory_info()
                # Without what is shared: DDS's shared-memory segment fills up with use, and has a fixed size.
                own = memory.rss - getattr(memory, "shared", 0)
                self.samples.append((own, self._process.num_threads(), self._process.num_fds()))
        except psutil.NoSuchProcess:
            pass  # the graph notices by itself

    def spans(self):
        """For the table: first and last of each."""
        if not self.samples:
            return ["", "", ""]
        early, late = self._early_and_late()
        pairs = zip((early[0] >> 20, *early[1:]), (late[0] >> 20, *late[1:]), strict=True)
        return [f"{before} → {now}" for before, now in pairs]

    def growth(self):
        """What is more in the last quarter than in the first: one line each."""
        if not self.samples:
            return
        early, late = self._early_and_late()
        if late[0] - early[0] > MEMORY_SLACK:
            yield f"memory grew by {(late[0] - early[0]) / (1 << 20):.1f} MiB"
        for what, before, now in zip(("threads", "open files"), early[1:], late[1:], strict=True):
            if now > before:
                yield f"{what} grew from {before} to {now}"

    def _early_and_late(self):
        quarter = max(1, len(self.samples) // 4)
        return tuple(
            tuple(int(statistics.median_high(column)) for column in zip(*part, strict=True))
            for part in (self.samples[:quarter], self.samples[-quarter:])
        )


def _as_jpeg(frame, msg):
    cv2.imencode(".jpg", frame)


def _command(name):
    """How a node is started: as installed in a sourced workspace, else from the sources of this checkout."""
    for prefix in filter(None, os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)):
        installed = Path(prefix) / "lib" / name / name
        if installed.is_file():
            return [str(installed)]
    sources = Path(imgproc_course.__file__).parents[1] / "environment" / "ros2_ws" / "src" / name
    if not sources.is_dir():
        raise ValueError(
            f"the package {name} is nowhere; source a workspace in which it is built (install/setup.bash), "
            "or run this in a checkout of the course"
        )
    return [sys.executable, "-c", _RUN.format(str(sources), name=name)]
