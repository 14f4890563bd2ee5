"""Runs camera, both nodes and a notebook for a long time, and reports what is lost and what grows."""

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

NODES = {"image_gray_processor": "gray", "image_edge_detection": "edges"}  # node -> its subscribed output
SAMPLES = 200  # per process, however long the run
START_TIMEOUT = 60.0  # seconds that a process may take to start, or to end
# Memory varies by the working arrays of one image (Canny's: 9 MiB), depending on the moment of the sample.
# A leak of one image in 200 would add 250 MB in 10 minutes.
MEMORY_SLACK = 20 << 20
_PLAY = "from imgproc_course.ros.player import publish; publish({!r}, {!r}, {!r})"
_RUN = "import sys; sys.path.insert(0, {!r}); from {name}.{name} import main; sys.exit(main())"


def soak(minutes=10.0, speed=3.0, *, source="recording", warm_up=25.0, say=print):
    """Runs the graph on its own topics, and reports losses and growth.

    Parameters
    ----------
    minutes : duration after the warm-up
    speed : factor on the drive's own 10 Hz
    source : "recording", or "room", whose other topics have the robot's names: take a domain of its own
    warm_up : seconds that are not measured: processes start, buffers fill
    say : function of one line, which prints the progress

    Returns
    -------
    int, the exit code: 0; 1 if an image was lost or failed, if memory, threads or open files grew, or if a
    process ended. Ctrl-C ends the run and reports what was measured, or returns 130 if nothing was

    Raises
    ------
    ValueError : a bad duration, speed or warm-up, or the two packages are not found
    """
    for name, number in (("minutes", minutes), ("speed", speed)):
        if not 0 < number < float("inf"):
            raise ValueError(f"{name} must be a positive number, got {number!r}")
    if not 0 <= warm_up < float("inf"):
        raise ValueError(f"the warm-up must be 0 or more seconds, got {warm_up!r}")
    soak_run = _SoakRun(source, speed, say)
    # SIGTERM ends the run as Ctrl-C does, so that no camera and no node keeps running.
    previous_handler = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        soak_run.start()
        soak_run.watch(warm_up)
        if not soak_run.problems:
            soak_run.end_warm_up()
            say(f"warm after {warm_up:g} s; measuring {minutes:g} minutes (Ctrl-C ends it)")
            soak_run.watch(minutes * 60)
            soak_run.wait_for_statistics()
    except KeyboardInterrupt:
        if not soak_run.is_warm:
            say("ended by Ctrl-C during the warm-up: nothing was measured")
            return 130
        say("ended by Ctrl-C")
    finally:
        soak_run.stop()
        signal.signal(signal.SIGTERM, previous_handler)
    return soak_run.report()


class _SoakRun:
    """Camera, nodes and subscribers of one run, and what was measured."""

    def __init__(self, source, speed, say):
        self._say = say
        self._namespace = f"/soak_{os.getpid()}"
        self._topic = f"{self._namespace}/image_raw"
        remapping = ["--ros-args", "-r", f"{TOPIC}:={self._topic}", "-r", f"__ns:={self._namespace}"]
        self._commands = {"camera": [sys.executable, "-c", _PLAY.format(self._topic, speed, source)]}
        self._commands |= {name: [*_command(name), *remapping] for name in NODES}
        self._processes, self._samples, self._subscribers, self._counts_before = {}, {}, {}, {}
        self._stderr = dict.fromkeys(self._commands, b"")  # the end of each process's stderr
        self._statistics = {}
        self._seconds = 0.0
        self.problems = []
        self.is_warm = False

    def start(self):
        for name, command in self._commands.items():
            # In their own process sessions, so that Ctrl-C in the terminal reaches this process only.
            self._processes[name] = subprocess.Popen(
                command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True
            )
            os.set_blocking(self._processes[name].stderr.fileno(), False)
        self._session = RosSession.current()
        self._samples = {name: _ProcessSamples(process.pid) for name, process in self._processes.items()}
        self._samples["notebook"] = _ProcessSamples(os.getpid())
        for name, output in NODES.items():
            self._subscribe(name, output)
        subscribers = self._subscribers.values()
        self._wait(lambda: all(subscriber.received for subscriber in subscribers), "no image arrived")
        self._wait(lambda: len(self._statistics) == len(NODES), "no statistics arrived")

    def _subscribe(self, name, output):
        topic = f"{self._namespace}/{name}/{output}"
        # Every frame is compressed, as a live view does.
        self._subscribers[name] = ImageSubscriber(topic, _compress, encoding="passthrough")
        self._session.node.create_subscription(
            String,
            f"{self._namespace}/{name}/statistics",
            lambda msg: self._statistics.update({name: json.loads(msg.data)}),
            1,
        )

    def _wait(self, condition, problem):
        end = time.monotonic() + START_TIMEOUT
        while not condition() and not self.problems:
            if time.monotonic() > end:
                self.problems.append(f"{problem} within {START_TIMEOUT:g} s")
            self._check_processes()
            time.sleep(0.05)

    def watch(self, seconds):
        """Takes samples for so many seconds, or until a process has ended."""
        start = last_line = time.monotonic()
        pause = max(0.2, seconds / SAMPLES)
        self._seconds = 0.0
        while self._seconds < seconds and not self.problems:
            time.sleep(min(pause, seconds - self._seconds))
            self._seconds = time.monotonic() - start
            self._check_processes()
            for samples in self._samples.values():
                samples.take()
            if time.monotonic() - last_line > max(10.0, seconds / 10):
                last_line = time.monotonic()
                self._say(f"{last_line - start:.0f} s: {self._progress()}")

    def _check_processes(self):
        for name, process in self._processes.items():
            code = process.poll()  # before the pipe is read: it holds the last lines of the process
            self._stderr[name] = (self._stderr[name] + (process.stderr.read() or b""))[-4000:]
            if code is not None and not self.problems:
                lines = self._stderr[name].decode(errors="replace").strip().splitlines()
                self.problems.append(f"{name} ended with code {code}: {' / '.join(lines[-2:])}")

    def _progress(self):
        parts = []
        for name in NODES:
            counts = self._counts_since_warm_up(name)
            frames = counts.pop("frames")
            parts.append(f"{name} {frames} frames, {sum(counts.values())} lost")
        return "; ".join(parts)

    def end_warm_up(self):
        """Discards what was measured so far."""
        self.is_warm = True
        for samples in self._samples.values():
            samples.clear()
        self._counts_before = {name: self._counts(name) for name in NODES}

    def wait_for_statistics(self):
        """Waits for statistics that include the last image of the run."""
        self._statistics.clear()
        self._wait(lambda: len(self._statistics) == len(NODES), "no statistics arrived")

    def _counts(self, name):
        node_statistics = self._statistics.get(name, {})
        subscriber = self._subscribers[name]
        return {
            "frames": node_statistics.get("processed", 0),
            "lost before the node": node_statistics.get("lost") or 0,
            "failed": node_statistics.get("failed", 0) + subscriber.failed,
            "lost before the notebook": subscriber.dropped or 0,
        }

    def _counts_since_warm_up(self, name):
        before = self._counts_before.get(name, {})
        return {key: count - before.get(key, 0) for key, count in self._counts(name).items()}

    def stop(self):
        self._final_counts = {name: self._counts_since_warm_up(name) for name in self._subscribers}
        for process in self._processes.values():
            process.terminate()
        for process in self._processes.values():
            try:
                process.wait(START_TIMEOUT)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            process.stderr.close()
        RosSession().stop()

    def report(self):
        """Prints the measurements, and returns the exit code."""
        table = Table(title=f"{self._seconds:.0f} s, {self._topic}", title_justify="left")
        for column in ("process", "frames", "lost", "failed", "memory MiB", "threads", "files"):
            table.add_column(column, justify="left" if column == "process" else "right")
        for name, samples in self._samples.items():
            table.add_row(name, *self._count_cells(name), *samples.ranges())
        Console(width=110).print(table)
        problems = [*self.problems, *self._count_problems()]
        for name, samples in self._samples.items():
            problems += [f"{name}: {growth}" for growth in samples.growth()]
        for problem in problems:
            self._say(problem)
        self._say("something was lost or grew" if problems else "no loss, no growth")
        return 1 if problems else 0

    def _count_cells(self, name):
        counts = self._final_counts.get(name)
        if not counts:
            return ["", "", ""]
        lost_frames = counts["lost before the node"] + counts["lost before the notebook"]
        return [str(counts["frames"]), str(lost_frames), str(counts["failed"])]

    def _count_problems(self):
        for name, counts in self._final_counts.items():
            if not counts["frames"]:
                yield f"{name}: no frame was processed"
            for key, count in counts.items():
                if key != "frames" and count:
                    yield f"{name}: {count} {key}"


class _ProcessSamples:
    """Samples of a process: (own memory in bytes, threads, open files)."""

    def __init__(self, pid):
        self._process = psutil.Process(pid)
        self.values = []

    def take(self):
        try:
            with self._process.oneshot():
                memory = self._process.memory_info()
                # Without shared memory: DDS's segment fills up with use, and its size is fixed.
                own = memory.rss - getattr(memory, "shared", 0)
                self.values.append((own, self._process.num_threads(), self._process.num_fds()))
        except psutil.NoSuchProcess:
            pass  # the run notices this by itself

    def clear(self):
        self.values.clear()

    def ranges(self):
        """For the table: the first and the last value of memory, threads and files."""
        if not self.values:
            return ["", "", ""]
        early, late = self._early_and_late()
        pairs = zip((early[0] >> 20, *early[1:]), (late[0] >> 20, *late[1:]), strict=True)
        return [f"{before} → {after}" for before, after in pairs]

    def growth(self):
        """Yields one line for each value that is larger in the last quarter than in the first."""
        if not self.values:
            return
        early, late = self._early_and_late()
        if late[0] - early[0] > MEMORY_SLACK:
            yield f"memory grew by {(late[0] - early[0]) / (1 << 20):.1f} MiB"
        for name, before, after in zip(("threads", "open files"), early[1:], late[1:], strict=True):
            if after > before:
                yield f"{name} grew from {before} to {after}"

    def _early_and_late(self):
        quarter = max(1, len(self.values) // 4)
        return tuple(
            tuple(int(statistics.median_high(column)) for column in zip(*part, strict=True))
            for part in (self.values[:quarter], self.values[-quarter:])
        )


def _compress(frame, msg):
    cv2.imencode(".jpg", frame)


def _command(name):
    """The command that starts a node: installed in a sourced workspace, or from this checkout's sources."""
    for prefix in filter(None, os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)):
        executable = Path(prefix) / "lib" / name / name
        if executable.is_file():
            return [str(executable)]
    sources = Path(imgproc_course.__file__).parents[1] / "environment" / "ros2_ws" / "src" / name
    if not sources.is_dir():
        raise ValueError(
            f"the package {name} is not found; source a workspace in which it is built (install/setup.bash), "
            "or run this in a checkout of the course"
        )
    return [sys.executable, "-c", _RUN.format(str(sources), name=name)]
