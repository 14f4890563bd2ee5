"""Common to all tests: a DDS domain for each worker on loopback, and the reasons to skip."""

import contextlib
import importlib.util
import os
import shutil
import signal
import sys
import tempfile
import time
from pathlib import Path

import pytest
from hypothesis import settings

sys.path.insert(0, str(Path(__file__).parent))  # for the modules beside this one
from progress import Progress
from selection import IS_SHORT, ONLY_IN_ALL, is_left_out, is_of_lesson, places_of, scope_of

# The same examples in each run, and no test asserts on a clock.
settings.load_profile("ci")


def _take_domain():
    """A ROS domain that no other run of the tests uses, by a file's lock; lessons are built in 1 to 59."""
    with contextlib.suppress(ImportError):  # Windows has no fcntl
        import fcntl

        folder = Path(tempfile.gettempdir()) / "imgproc_course-tests"
        folder.mkdir(exist_ok=True)
        for domain in range(60, 102):
            file = os.open(folder / f"domain-{domain}", os.O_WRONLY | os.O_CREAT, 0o666)
            with contextlib.suppress(BlockingIOError):
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                return domain  # the file stays open, and locked, until this process ends
            os.close(file)
    return 60


# Before anything imports rclpy. Only the first load of this file in a process takes a domain.
if not hasattr(sys, "_ros_domain_of_tests"):
    sys._ros_domain_of_tests = _take_domain()
os.environ["ROS_DOMAIN_ID"] = str(sys._ros_domain_of_tests)
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
os.environ.pop("ROS_LOCALHOST_ONLY", None)
os.environ.setdefault("MPLBACKEND", "agg")
# Processes that tests start in folders of their own belong to this course, too.
os.environ["NBCLASSROOM_COURSE"] = str(Path(__file__).parents[1] / "notebooks" / "course.toml")
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


@pytest.fixture(scope="session")
def drive():
    """The recording of the drive."""
    from imgproc_course.recording import open_recording

    with open_recording("drive") as recording:
        yield recording


@pytest.fixture
def session():
    from imgproc_course.ros import RosSession

    with RosSession.current() as running:
        yield running


@pytest.fixture
def wait_until():
    """Waits for the value of a condition that others fulfil; fails after a timeout, with `state()`."""

    def wait(condition, seconds=60.0, state=lambda: ""):
        end = time.monotonic() + seconds
        while not (result := condition()):
            if time.monotonic() > end:
                pytest.fail(f"the condition did not become true in time {state()}")
            time.sleep(0.01)
        return result

    return wait


def pytest_runtest_setup(item):
    for marker, (is_missing, reason) in MISSING.items():
        if item.get_closest_marker(marker) and is_missing():
            pytest.skip(reason)


def pytest_configure(config):
    """Without a path and without --all: the tests of a newcomer."""
    has_paths = config.args_source != pytest.Config.ArgsSource.TESTPATHS
    config.stash[IS_SHORT] = not (has_paths or config.getoption("--all"))
    is_whole = config.stash[IS_SHORT] or config.getoption("--all")
    if is_whole and config.get_verbosity() <= 0 and not hasattr(config, "workerinput"):
        config.pluginmanager.register(Progress(config.pluginmanager))


def pytest_ignore_collect(collection_path, config):
    """A file of which no test will run is not even read."""
    path = collection_path.relative_to(config.rootpath).as_posix()
    return (config.stash[IS_SHORT] and is_left_out(path)) or None


def pytest_collection_modifyitems(config, items):
    chosen = items
    if config.stash[IS_SHORT]:
        chosen = [item for item in chosen if not is_left_out(item.nodeid)]
    if lessons := config.getoption("--lesson"):
        chosen = [item for item in chosen if any(is_of_lesson(item.nodeid, number) for number in lessons)]
    if config.getoption("--first-of-each-file"):
        firsts = {item.nodeid.partition("::")[0]: item for item in reversed(chosen)}.values()
        chosen = [item for item in chosen if item in firsts]
    kept = set(chosen)
    config.hook.pytest_deselected(items=[item for item in items if item not in kept])
    places = places_of(dict.fromkeys(scope_of(item.nodeid) for item in chosen))
    items[:] = sorted(chosen, key=lambda item: places[scope_of(item.nodeid)])


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
    parser.addoption("--all", action="store_true", help="run every test, not only those of a newcomer")
    parser.addoption("--lesson", action="append", help="of the paths, what belongs to a lesson, as 04")
    parser.addoption(
        "--no-skips", action="store_true", help="count a skipped test as a failure (as in .ci/run)"
    )
    parser.addoption(
        "--first-of-each-file", action="store_true", help="run one test of each kind, the first of each file"
    )


def pytest_terminal_summary(terminalreporter, config):
    if config.getoption("--no-skips") and terminalreporter.stats.get("skipped"):
        terminalreporter.write_line("--no-skips: skipped tests count as failures here", red=True)


def pytest_sessionfinish(session):
    reporter = session.config.pluginmanager.get_plugin("terminalreporter")
    if session.config.getoption("--no-skips") and reporter and reporter.stats.get("skipped"):
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_unconfigure(config):
    """The last line of a newcomer's run."""
    reporter = config.pluginmanager.get_plugin("terminalreporter")
    if config.stash.get(IS_SHORT, False) and reporter and not hasattr(config, "workerinput"):
        reporter.write_line(f"Left out: {'; '.join(ONLY_IN_ALL.values())}. environment/test --all runs them.")
