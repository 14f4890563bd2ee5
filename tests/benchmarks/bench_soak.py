"""Camera, both nodes and a notebook for a long time: is an image lost, and does memory or anything else grow?

Camera and nodes are processes of their own; the notebook (this process) subscribes to both results. It fails
if an image was lost or failed, if memory, threads or open files grew, or if a process ended.

Run it with `environment/test --benchmarks soak`; MINUTES=1 and WARM_UP=5 (seconds) in the environment make
it shorter than 10 minutes after 25 seconds. Ctrl-C ends it and reports what was measured.
"""

import os
import re
import signal
import statistics
import subprocess
import sys
import threading
import time
from pathlib import Path

import cv2
import psutil
from rich.console import Console
from rich.table import Table

from imgproc_course.ros.camera import ROOM
from imgproc_course.ros.robot_body import open_body
from imgproc_course.ros.robot_topics import TOPIC
from imgproc_course.ros.session import RosSession
from imgproc_course.ros.subscriber import ImageSubscriber

MINUTES = float(os.environ.get("MINUTES", "10"))
WARM_UP = float(os.environ.get("WARM_UP", "25"))  # seconds that are not measured: buffers fill
SPEED = float(os.environ.get("SPEED", "3"))  # factor on the drive's own 10 Hz
NODES = {"image_gray_processor": "gray", "image_edge_detection": "edges"}  # node -> its subscribed output
SAMPLES = 200  # per process, however long the run
START_TIMEOUT = 60.0  # seconds that a process may take to start, or to end
# Memory varies by the working arrays of one image (Canny's: 9 MiB), depending on the moment of the sample.
# A leak of one image in 200 would add 250 MB in 10 minutes.
MEMORY_SLACK = 20 << 20
PLAY = f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r}); from bench_soak import publish; "
PROCESSOR_NODE = Path(__file__).parents[1] / "processor_node.py"


def soak(source="recording"):
    """Runs the graph on topics of its own, and prints what was lost and what grew. Returns the exit code.

    The other topics of the source "room" have the robot's names: take a domain of your own for it.
    """
    run = SoakRun(source)
    try:
        run.start()
        run.watch(WARM_UP)
        if not run.problems:
            run.end_warm_up()
            print(f"warm after {WARM_UP:g} s; measuring {MINUTES:g} minutes (Ctrl-C ends it)", flush=True)
            run.watch(MINUTES * 60)
    except KeyboardInterrupt:
        print("ended by Ctrl-C")
    finally:
        run.stop()
    return run.report()


def publish(topic, source):
    """Publishes the drive, or the room, as a camera of its own, on a topic of its own, until SIGTERM."""
    cv2.setNumThreads(1)  # as the robot process does
    signal.signal(signal.SIGTERM, lambda *_: sys.exit())
    options = {"recording": "drive", "camera_topic": None, "speed": SPEED, "loop": True, "stamps": "now"}
    if source == "room":
        options = ROOM | {"rate": 10.0 * SPEED}
    open_body({"source": source, "topic": topic} | options).start(on_end=lambda: None)
    threading.Event().wait()


class SoakRun:
    """Camera, nodes and subscribers of one run, and what was measured."""

    def __init__(self, source):
        self._namespace = f"/soak_{os.getpid()}"
        self._topic = f"{self._namespace}/image_raw"
        remapping = ["--ros-args", "-r", f"{TOPIC}:={self._topic}", "-r", f"__ns:={self._namespace}"]
        self._commands = {"camera": [sys.executable, "-c", f"{PLAY}publish({self._topic!r}, {source!r})"]}
        self._commands |= {name: [*node_command(name), *remapping] for name in NODES}
        self._processes, self._samples, self._subscribers, self._counts_before = {}, {}, {}, {}
        self._stderr = dict.fromkeys(self._commands, b"")  # the end of each process's stderr
        self._seconds = 0.0
        self.problems = []

    def start(self):
        for name, command in self._commands.items():
            # In their own process sessions, so that Ctrl-C in the terminal reaches this process only.
            self._processes[name] = subprocess.Popen(
                command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True
            )
            os.set_blocking(self._processes[name].stderr.fileno(), False)
        self._session = RosSession.current()
        self._samples = {name: ProcessSamples(process.pid) for name, process in self._processes.items()}
        self._samples["notebook"] = ProcessSamples(os.getpid())
        for name, output in NODES.items():
            self._subscribe(name, output)
        subscribers = self._subscribers.values()
        self._wait(lambda: all(subscriber.received for subscriber in subscribers), "no image arrived")

    def _subscribe(self, name, output):
        topic = f"{self._namespace}/{name}/{output}"
        # Every frame is compressed, as a live view does.
        self._subscribers[name] = ImageSubscriber(topic, _compress, encoding="passthrough")

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
                print(f"{last_line - start:.0f} s: {self._progress()}", flush=True)

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
        for samples in self._samples.values():
            samples.clear()
        self._counts_before = {name: self._counts(name) for name in NODES}

    def _counts(self, name):
        subscriber = self._subscribers[name]
        return {
            "frames": subscriber.received,
            "not converted": subscriber.failed,
            "lost before the notebook": subscriber.dropped or 0,
        }

    def _node_counts(self, name):
        """What a node that has ended printed in its last line, with the warm-up."""
        lines = self._stderr[name].decode(errors="replace")
        *_, (failed, lost) = re.findall(r"(\d+) failed, \d+ ignored, (\d+) lost", lines) or [(0, 0)]
        return {"failed": int(failed), "lost before the node": int(lost)}

    def _counts_since_warm_up(self, name):
        before = self._counts_before.get(name, {})
        return {key: count - before.get(key, 0) for key, count in self._counts(name).items()}

    def stop(self):
        self._final_counts = {name: self._counts_since_warm_up(name) for name in self._subscribers}
        for process in self._processes.values():
            process.terminate()
        for name, process in self._processes.items():
            try:
                process.wait(START_TIMEOUT)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            self._stderr[name] += process.stderr.read() or b""
            process.stderr.close()
        for name, counts in self._final_counts.items():
            counts |= self._node_counts(name)
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
            print(problem)
        print("something was lost or grew" if problems else "no loss, no growth")
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


class ProcessSamples:
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


def node_command(name):
    """The command that starts a node, as an ImageProcessor."""
    return [sys.executable, str(PROCESSOR_NODE), name]


if __name__ == "__main__":
    raise SystemExit(soak())
