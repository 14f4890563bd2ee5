"""What every test shares: a DDS domain of its own on loopback, and the reasons to skip."""

import importlib.util
import os
import shutil
import zlib

import pytest

# A domain for each pytest-xdist worker, and others for another run beside this one; set before anything
# imports rclpy. ROS allows 0 to 101: 20 runs of 4 workers, from 20 on.
_worker = int(os.environ.get("PYTEST_XDIST_WORKER", "gw0").removeprefix("gw"))
_run = zlib.crc32(os.environ.get("PYTEST_XDIST_TESTRUNUID", str(os.getpid())).encode())
os.environ["ROS_DOMAIN_ID"] = str(20 + _run % 20 * 4 + _worker % 4)
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
os.environ.pop("ROS_LOCALHOST_ONLY", None)
os.environ.setdefault("MPLBACKEND", "agg")

MISSING = {
    "ros": (
        lambda: importlib.util.find_spec("rclpy") is None,
        "rclpy is missing; its wheels are for Linux x86-64",
    ),
    "browser": (lambda: not shutil.which("chromium"), "chromium is missing: sudo apt-get install chromium"),
    "sandbox": (lambda: not shutil.which("bwrap"), "bubblewrap is missing: sudo apt-get install bubblewrap"),
}


def pytest_runtest_setup(item):
    for marker, (is_missing, reason) in MISSING.items():
        if item.get_closest_marker(marker) and is_missing():
            pytest.skip(reason)


def pytest_addoption(parser):
    parser.addoption("--no-skips", action="store_true", help="a skipped test is a failure (as in .ci/run)")


def pytest_terminal_summary(terminalreporter, config):
    if config.getoption("--no-skips") and terminalreporter.stats.get("skipped"):
        terminalreporter.write_line("--no-skips: skipped tests count as failures here", red=True)


def pytest_sessionfinish(session):
    reporter = session.config.pluginmanager.get_plugin("terminalreporter")
    if session.config.getoption("--no-skips") and reporter and reporter.stats.get("skipped"):
        session.exitstatus = pytest.ExitCode.TESTS_FAILED
