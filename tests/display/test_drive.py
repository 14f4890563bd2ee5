"""The kernel's side of drive(robot), without a browser: which commands it sends, and the map it draws."""

import logging
import math
import sys
import threading
import time

import numpy as np
import pytest

pytestmark = pytest.mark.ros

PATIENCE = 60


class Commands:
    """Replaces a Robot: it notes the commands."""

    odometry = scan = None

    def __init__(self):
        self.received = []

    def drive(self, linear, angular):
        self.received.append((linear, angular))

    def stop(self):
        self.received.append("stop")


@pytest.fixture
def view(monkeypatch):
    """A view without threads: what it would show does not matter here."""
    from imgproc_course.display.drive import DrivePad, DriveView
    from imgproc_course.display.screen import Style

    view = DriveView(Commands(), "/camera", DrivePad(), Style(width=480))
    stopping = threading.Event()
    thread = threading.Thread(target=view._send_commands, args=(stopping,))
    thread.start()
    yield view
    stopping.set()
    view._on_message(None, {"kind": "stop", "linear": 0, "angular": 0, "time": time.time()}, [])
    thread.join()


def message(linear, delay=0.0, kind="drive"):
    return {"kind": kind, "linear": linear, "angular": 0.0, "time": time.time() - 1000 - delay}


def wait_for(view, count):
    pause = threading.Event()
    for _ in range(PATIENCE * 100):
        if len(view._robot.received) >= count:
            return view._robot.received
        pause.wait(0.01)
    raise AssertionError(f"{view._robot.received} within {PATIENCE} s")


def test_commands_that_waited_for_a_busy_kernel_are_not_sent_but_a_stop_is(view):
    view._on_message(None, message(0.3), [])  # the browser's clock may be wrong: here by 1000 s
    wait_for(view, 1)
    with view._commanded:  # so that the thread cannot take a command yet
        view._on_message(None, message(0.2, delay=5.0), [])
        assert view._command is None
        view._on_message(None, message(0.0, delay=5.0, kind="stop"), [])
    assert wait_for(view, 2) == [(0.3, 0.0), (0.0, 0.0)]


def test_who_hides_the_view_stops_the_robot(view):
    view._screen.image._view_count = 1
    assert view._robot.received == []
    view._screen.image._view_count = 0
    assert view._robot.received == ["stop"]


def test_a_warning_of_the_robot_appears_in_the_view_as_long_as_it_runs(view):
    robot_log = logging.getLogger("imgproc_course.ros.robot")
    view._hidden = True  # nothing is drawn here
    view.start()
    robot_log.warning("%s", "2 publishers send commands")
    view.stop()
    robot_log.warning("%s", "somebody has switched the robot")
    message = view._screen.box.children[-1].value
    assert "2 publishers send commands" in message and "switched" not in message
    assert robot_log.handlers == []


def test_what_is_no_robot_cannot_be_driven():
    from imgproc_course.display import drive

    with pytest.raises(ValueError, match="drive needs a Robot, got str"):
        drive("/kachaka")


def odometry_at(moment, x, y, yaw):
    from builtin_interfaces.msg import Time
    from nav_msgs.msg import Odometry

    msg = Odometry()
    msg.header.stamp = Time(sec=int(moment), nanosec=round(moment % 1 * 1e9))
    msg.pose.pose.position.x, msg.pose.pose.position.y = x, y
    msg.pose.pose.orientation.z, msg.pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return msg


def scan_at(moment, ranges):
    """A scan all around: its first ray goes to the robot's right, the others follow counterclockwise."""
    from builtin_interfaces.msg import Time
    from sensor_msgs.msg import LaserScan

    increment = 2 * math.pi / len(ranges)
    msg = LaserScan(angle_min=-math.pi, angle_increment=increment, range_min=0.05, range_max=8.0)
    msg.header.stamp = Time(sec=int(moment), nanosec=round(moment % 1 * 1e9))
    msg.ranges = ranges
    return msg


def test_a_scan_is_drawn_from_where_the_robot_was_when_it_was_taken():
    from imgproc_course.display.drive import _Map

    map_ = _Map()
    first = map_.update(odometry_at(10.0, 1.0, 0.02, math.pi - 0.2), None)
    assert (first["pose"], first["trace"], first["begins"]) == ([1.0, 0.02, 2.942], [[1.0, 0.02]], True)
    # Half a second later it has turned on by 0.4; in the middle it looked to -x. Ahead, 2.03 m away: a wall.
    inf = math.inf
    second = map_.update(odometry_at(10.5, 1.0, 0.02, -math.pi + 0.2), scan_at(10.25, [inf, 2.03, inf, inf]))
    assert second["cells"] == [[-1.2, 0.0]]  # x = 1 - 0.156 - 2.03
    assert (second["begins"], second["trace"]) == (False, [])
    assert map_.update(odometry_at(10.6, 1.02, 0.0, 0.0), None)["cells"] == []
    map_.begin_again()  # another page opens
    assert map_.update(odometry_at(10.7, 1.02, 0.0, 0.0), None)["cells"] == second["cells"]
    for moment, place in ((10.8, (3.0, 0.0, 0.1)), (14.0, (3.1, 0.0, 0.1)), (20.0, (0.0, 0.0, 0.0))):
        last = map_.update(odometry_at(moment, *place), None)
        # Too far away, then near, then at zero: the robot has begun again.
        assert (last["begins"], last["cells"]) == (place[0] != 3.1, [])
        assert last["trace"] == [[*place[:2]]]


def test_the_map_begins_again_in_another_room():
    from imgproc_course.display.drive import _Map

    map_, still = _Map(), (0.5, 0.0, 0.0)
    map_.update(odometry_at(10.0, *still), None)
    assert len(map_.update(odometry_at(10.2, *still), scan_at(10.1, [1.0] * 360))["cells"]) > 50
    assert map_.update(odometry_at(10.4, *still), scan_at(10.3, [1.0] * 360))["begins"] is False
    other = map_.update(odometry_at(10.6, *still), scan_at(10.5, [2.0] * 360))
    assert (other["begins"], other["gone"]) == (True, [])
    assert all(1.9 < math.hypot(x - 0.6, y) < 2.2 for x, y in other["cells"])


def test_what_comes_is_no_wall_until_it_stays(monkeypatch):
    from imgproc_course.display.drive import _Map

    def scan(moment, ball):
        ranges = np.full(360, 2.0)
        ranges[ball : ball + 10] = 1.0
        return scan_at(moment, ranges.tolist())

    monkeypatch.setattr(sys.modules[_Map.__module__], "STILL", 4)
    map_, messages = _Map(), []
    map_.update(odometry_at(10.0, 0.0, 0.0, 0.0), None)
    for k, ball in enumerate([90, 60, 60, 60, 60]):  # it rolls once, and then it stays
        moment = 10.5 + k / 2
        messages.append(map_.update(odometry_at(moment, 0.0, 0.0, 0.0), scan(moment - 0.25, ball)))
    near = [[c for c in m["cells"] if math.hypot(c[0] - 0.156, c[1]) < 1.5] for m in messages]
    moving = [len(m["moving"]) for m in messages]
    assert near[0] and not any(near[1:4]) and near[4]  # at first, nobody knows what moves
    assert moving[0] == 0 and min(moving[1:4]) >= 3 and moving[4] == 0
    assert len(messages[1]["gone"]) >= 3  # where it was


def test_what_has_moved_away_disappears_from_the_map_and_walls_stay():
    from imgproc_course.display.drive import _Map

    def scan(moment, *, ball):
        angles = np.radians(np.arange(360) - 180)
        # A wall 2 m to the right of the scanner, which one sees almost along its surface far away.
        ranges = np.where(np.cos(angles) > 0.3, 2 / np.maximum(np.cos(angles), 0.3), math.inf)
        if ball:
            ranges[175:186] = 1.0
        return scan_at(moment, ranges.tolist())

    map_, moments = _Map(), (10.25, 10.75, 11.25)
    map_.update(odometry_at(10.0, 0.0, 0.0, 0.0), None)
    first, second, third = (
        map_.update(odometry_at(moment + 0.25, 0.0, 0.0, 0.0), scan(moment, ball=moment == 10.25))
        for moment in moments
    )
    ball = [cell for cell in first["cells"] if abs(cell[1]) < 1.5 and abs(cell[0]) < 0.5]
    assert (first["gone"], second["gone"], third["gone"]) == ([], ball, [])
    assert len(ball) in range(4, 9)
    map_.begin_again()
    everything = map_.update(odometry_at(12.0, 0.0, 0.0, 0.0), None)["cells"]
    assert not [cell for cell in everything if cell in ball] and len(everything) > 60
