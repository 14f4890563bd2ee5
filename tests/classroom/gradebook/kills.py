"""kill -9 of each kind of process of `imgproc-course grade`, at random moments; what is left afterwards."""

import contextlib
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import psutil
from submissions import answers_of, notebook, write

FORK_SERVER = "fork_server.main"


def _command_line(process):
    with contextlib.suppress(psutil.Error):
        return " ".join(process.cmdline())
    return ""


def _is_nbval(process):
    return "nbval_plugin.main" in _command_line(process)


def _is_bubblewrap(process):
    return process.name() == "bwrap"


def _is_fork_server(process):
    return FORK_SERVER in _command_line(process) and process.name() != "bwrap" == process.parent().name()


def _is_kernel(process):
    parent = process.parent()
    return FORK_SERVER in _command_line(process) and parent.name() != "bwrap" != process.name()


def _is_reader(process):
    return "submission_reader.py" in _command_line(process)


COMMAND = "the command itself"
KINDS = {  # every process that a run starts, in that order
    COMMAND: None,
    "the reader of notebooks": _is_reader,
    "the nbval process": _is_nbval,
    "bubblewrap": _is_bubblewrap,
    "the fork server": _is_fork_server,
    "a kernel": _is_kernel,
}
ANSWERS = ("right", "raising", "untouched", 0, 1)


def write_submissions(folder, master, count):
    """Submissions of which no two are equal; some end their process, and each takes a moment."""
    for number in range(count):
        answers = answers_of(master, ANSWERS[number % len(ANSWERS)])
        pause = f"import time\ntime.sleep({0.05 + number / 1000})\n"
        answers = {id: pause + source for id, source in answers.items()}
        if number % 7 == 6:
            first = min(answers)
            answers[first] = f"import os\nos._exit({number})\n"
        write(folder / f"learner {number:03}" / f"{master.name}.ipynb", notebook(master, answers))


class Run:
    """A run of `grade` in a process group of its own, and the environment that marks all its processes."""

    def __init__(self, submissions, key, out, *options):
        program = Path(sys.executable).with_name("imgproc-course")
        command = [str(program), "grade", str(submissions), "--key", str(key)]
        self._command = [*command, "--out", str(out), "--workers", "2", *options]
        self.temporary = Path(tempfile.mkdtemp(prefix="runs-"))
        self.process, self._seen = None, {}

    def start(self):
        self.process = subprocess.Popen(
            self._command,
            env=os.environ | {"TMPDIR": str(self.temporary)},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )

    def processes(self, kind):
        """The run's processes of that kind; all that were ever seen are remembered for `survivors`."""
        with contextlib.suppress(psutil.Error):
            root = psutil.Process(self.process.pid)
            below = root.children(recursive=True)
            self._seen |= {process.pid: process for process in below}
            return [root] if kind == COMMAND else [each for each in below if self._is(kind, each)]
        return []

    def _is(self, kind, process):
        with contextlib.suppress(psutil.Error, AttributeError):  # it has ended, or its parent has
            return KINDS[kind](process)
        return False

    def kill(self, kind, rng):
        """Kill one of them, if there is one; returns whether."""
        matching = self.processes(kind)
        with contextlib.suppress(psutil.Error, IndexError):
            rng.choice(matching).kill()
            return True
        return False

    def finish(self):
        """Wait for the end; (exit code, what it printed)."""
        text, _ = self.process.communicate(timeout=900)
        return self.process.returncode, text

    def survivors(self, seconds):
        """Its processes that are left after so many seconds at most, as texts."""
        end = time.monotonic() + seconds
        while (left := self._left()) and time.monotonic() < end:
            time.sleep(0.1)
        return left

    def _left(self):
        left = []
        for process in self._seen.values():
            with contextlib.suppress(psutil.Error):
                if process.is_running() and process.status() != psutil.STATUS_ZOMBIE:
                    left.append(f"{process.pid} {_command_line(process)[:60]}")
        return left


def run_with_kills(run, kind, count, pause, rng):
    """Run, kill a process of that kind so many times, and let the last run finish.

    Parameters
    ----------
    run : Run; its `--fresh` decides what a run does that is started again
    kind : key of KINDS
    count : int
    pause : (least, most) seconds before each kill
    rng : random.Random

    Returns
    -------
    list of (exit code, printed) of every run; a run that was killed itself is not in it
    """
    endings = []
    run.start()
    while count:
        time.sleep(rng.uniform(*pause))
        while not (killed := run.kill(kind, rng)) and run.process.poll() is None:
            time.sleep(0.01)
        count -= killed
        if killed and kind == COMMAND:
            run.process.communicate()
            run.start()
        elif run.process.poll() is not None:
            endings.append(run.finish())
            run.start()
    return [*endings, run.finish()]
