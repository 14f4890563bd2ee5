"""What the tests of this room share: a session that ends with its test, and processes of their own."""

import os
import signal
import subprocess
import sys
import time

import pytest


@pytest.fixture
def session():
    from imgproc_course.ros import RosSession

    with RosSession.current() as running:
        yield running


@pytest.fixture
def wait_until():
    """Waits for something that other threads or processes bring about; fails when it does not come."""

    def wait(condition, seconds=20.0):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                pytest.fail("waited in vain")
            time.sleep(0.01)

    return wait


@pytest.fixture
def run_python():
    """Runs code in a process of its own and returns (exit code, stdout, stderr)."""

    def run(code, *, seconds=60, cwd=None, **environment):
        done = subprocess.run(
            [sys.executable, "-c", code],
            capture_output=True,
            text=True,
            timeout=seconds,
            cwd=cwd,
            env=_environment(environment),
        )
        return done.returncode, done.stdout, done.stderr

    return run


@pytest.fixture
def start_python():
    """Starts code in a process of its own; the process ends with the test."""
    running = []

    def start(code, *, cwd=None, **environment):
        process = subprocess.Popen(
            [sys.executable, "-u", "-c", code],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=cwd,
            env=_environment(environment),
        )
        running.append(process)
        return process

    yield start
    for process in running:
        if process.poll() is None:
            process.send_signal(signal.SIGKILL)
        process.communicate()


def _environment(changes):
    """This process's environment with changes; None takes a variable away."""
    merged = {**os.environ, **changes}
    return {name: value for name, value in merged.items() if value is not None}
