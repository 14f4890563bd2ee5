"""Common to all tests: a DDS domain for each worker on loopback, and the reasons to skip."""

import contextlib
import importlib.util
import os
import shutil
import signal
import sys
import tempfile
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # for accessibility.py


def _take_domain():
    """A ROS domain, from 20 to 101, that no other run of the tests uses: each locks a file."""
    with contextlib.suppress(ImportError):  # Windows has no fcntl
        import fcntl

        folder = Path(tempfile.gettempdir()) / "imgproc_course-tests"
        folder.mkdir(exist_ok=True)
        for domain in range(20, 102):
            file = os.open(folder / f"domain-{domain}", os.O_WRONLY | os.O_CREAT, 0o666)
            with contextlib.suppress(BlockingIOError):
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                return domain  # the file stays open, and locked, until this process ends
            os.close(file)
    return 20


# Before anything imports rclpy. Only the first load of this file in a process takes a domain.
if not hasattr(sys, "_ros_domain_of_tests"):
    sys._ros_domain_of_tests = _take_domain()
os.environ["ROS_DOMAIN_ID"] = str(sys._ros_domain_of_tests)
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
os.environ.pop("ROS_LOCALHOST_ONLY", None)
os.environ.setdefault("MPLBACKEND", "agg")
# In the background of a script pytest ignores Ctrl-C, and its child processes would too; some tests send it.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

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


# Long tests start first: if they started last, the other workers would wait for them without work.
LONGEST_FIRST = ("ros_packages", "browser", "classroom/gradebook/test_teach", "classroom", "notebooks", "ros")
# A worker takes one file at a time. Of WHOLE_FOLDERS it takes all files, because what they share (a colcon
# workspace, a JupyterLab with its browser) takes long to make. Of SINGLE_TESTS it takes one test, a lesson.
WHOLE_FOLDERS = ("ros_packages", "browser")
SINGLE_TESTS = ("notebooks",)


def _folder(nodeid):
    """The folder below tests/, or the file if it is in none."""
    return nodeid.partition("::")[0].removeprefix("tests/").partition("/")[0]


def pytest_collection_modifyitems(config, items):
    if config.getoption("--first-of-each-file"):
        firsts = {item.nodeid.partition("::")[0]: item for item in reversed(items)}.values()
        config.hook.pytest_deselected(items=[item for item in items if item not in firsts])
        items[:] = [item for item in items if item in firsts]
    if config.getoption("--once-more"):
        for item in items:
            if item.get_closest_marker("ros") or item.get_closest_marker("browser"):
                item.add_marker(pytest.mark.flaky(reruns=1))
    items.sort(key=lambda item: _place_of(item.nodeid))


def _place_of(nodeid):
    """The place in LONGEST_FIRST of the first name with which its path below tests/ begins."""
    begins = (nodeid.removeprefix("tests/").startswith(name) for name in LONGEST_FIRST)
    return next((place for place, is_it in enumerate(begins) if is_it), len(LONGEST_FIRST))


def scope_of(nodeid):
    """A name; one worker runs all tests of one name, one after another."""
    if (folder := _folder(nodeid)) in SINGLE_TESTS:
        return nodeid
    return folder if folder in WHOLE_FOLDERS else nodeid.partition("::")[0]


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    if config.getoption("dist") != "loadfile":
        return None
    from xdist.scheduler import LoadScopeScheduling

    class Scheduling(LoadScopeScheduling):
        def _split_scope(self, nodeid):
            return scope_of(nodeid)

    return Scheduling(config, log)


def pytest_addoption(parser):
    parser.addoption(
        "--no-skips", action="store_true", help="count a skipped test as a failure (as in .ci/run)"
    )
    parser.addoption(
        "--first-of-each-file", action="store_true", help="run one test of each kind, the first of each file"
    )
    # DDS and JupyterLab have races of their own on a busy machine. The summary lists every such test: what
    # it lists is looked into, it is no habit.
    parser.addoption(
        "--once-more",
        action="store_true",
        help="run a failed test of ROS or of the browser once more, and list it (as in .ci/run)",
    )


def pytest_terminal_summary(terminalreporter, config):
    for report in terminalreporter.stats.get("rerun", ()):
        terminalreporter.section(f"first run of {report.nodeid}")
        terminalreporter.write_line(report.longreprtext)
    if config.getoption("--no-skips") and terminalreporter.stats.get("skipped"):
        terminalreporter.write_line("--no-skips: skipped tests count as failures here", red=True)


def pytest_sessionfinish(session):
    reporter = session.config.pluginmanager.get_plugin("terminalreporter")
    if session.config.getoption("--no-skips") and reporter and reporter.stats.get("skipped"):
        session.exitstatus = pytest.ExitCode.TESTS_FAILED
