"""The robot's limits, bumps and odometry, the movers that it meets, and the scan against the depth."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from imgproc_course.geometry import Pose
from imgproc_course.simulation import Simulation, furnished, recorded_room
from imgproc_course.simulation.laser import MOUNT, cast, cut
from imgproc_course.simulation.movers import BALL_RADIUS, Ball
from imgproc_course.simulation.wheels import ANGULAR_ACCELERATION, LINEAR_ACCELERATION, nearest_on_body

FREE = (0.4, -0.3, 0.0)  # two metres of free floor ahead at the time 0


def place(room):
    x, y, _, _, _, qz, qw = room.pose("robot")
    return x, y, 2 * math.atan2(qz, qw)


@pytest.mark.parametrize("room", [None, furnished(3)], ids=["recorded", "furnished"])
def test_whoever_touches_something_still_sees_it(room):
    with Simulation(1, room=room, start=(0, 0, math.pi) if room is None else None, movers=False) as drive:
        while not drive.bumped:
            drive.step(0.3, 0)
        depth, frame, labels = drive.depth(), drive.frame(), drive.labels()
        seen = drive.label_names[int(labels[180, 320])]
    assert 10 < depth.min() < 60
    assert frame.mean() > 50 and labels.min() > 0
    assert room is not None or (seen == "wall" and depth.min() == depth.max() == 24)


def test_speeds_stay_within_the_limits_and_grow_step_by_step():
    with Simulation(start=FREE) as room:
        speeds = []
        for _ in range(60):
            room.step(1e9, -1e9)
            speeds.append(room.speeds)
    linear, angular = np.transpose(speeds)
    assert linear.max() == 0.3
    assert angular.min() == -1.57
    assert np.diff(linear, prepend=0).max() <= LINEAR_ACCELERATION * 0.02 + 1e-9
    assert np.abs(np.diff(angular, prepend=0)).max() <= ANGULAR_ACCELERATION * 0.02 + 1e-9


def test_a_straight_way_and_the_stop():
    with Simulation(start=FREE) as room:
        for _ in range(50):
            room.step(0.2, 0)
        for _ in range(50):
            room.step(0, 0)
        assert room.time == 2.0
        x, y, yaw = place(room)
        assert room.speeds == (0, 0)
    # 0.2 m/s for a second, less the start: after the first third it has full speed; and the braking way
    assert x - FREE[0] == pytest.approx(0.2, abs=0.003)
    assert (y, yaw) == (FREE[1], 0)


def test_one_long_step_equals_many_short_ones():
    with Simulation(start=FREE) as one, Simulation(start=FREE) as many:
        one.step(0.3, 0.5, 0.5)
        for _ in range(25):
            many.step(0.3, 0.5)
        assert place(one) == place(many)
        assert one.time == many.time


@pytest.mark.parametrize(
    ("command", "message"),
    [
        ((math.nan, 0), "finite numbers, got linear nan"),
        ((0, math.inf), "angular inf"),
        ((0, 0, 0), "dt = 0"),
        ((0, 0, 2), "dt = 2"),
    ],
)
def test_impossible_commands(command, message):
    with Simulation() as room:
        with pytest.raises(ValueError, match=message):
            room.step(*command)
        assert room.time == 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"start": (3.5, 1.7, 0)}, "a wall or furniture is in its way"),
        ({"start": (2.25, -1.1, 0), "time": 0.5}, "is in its way"),
        ({"start": (0, 0)}, "three finite numbers"),
        ({"seed": -1}, "seed is a whole number"),
        ({"time": math.nan}, "time is between"),
        ({"size": (640, 480)}, "16:9"),
        ({"lighting": "night"}, '"day" or "evening"'),
    ],
)
def test_impossible_rooms(arguments, message):
    with pytest.raises(ValueError, match=message):
        Simulation(**arguments)


def test_a_wall_stops_the_robot_which_can_still_turn_and_leave():
    with Simulation(start=(0.0, -1.4, -math.pi / 2)) as room:
        for _ in range(200):
            room.step(0.3, 0)
        assert room.bumped
        x, y, _ = place(room)
        front = y - 0.0435 - 0.387 / 2
        assert -2.1 + 0.014 < front < -2.1 + 0.04  # at the skirting, 1.4 to 2 cm before the wall
        assert x == pytest.approx(0, abs=1e-6)
        assert room.speeds == (0, 0)
        for _ in range(50):
            room.step(-0.3, 0)
        assert not room.bumped
        assert place(room)[1] > y + 0.2


def test_inside_of_something_the_robot_may_leave_but_not_go_deeper():
    with Simulation(start=(0.0, -1.4, -math.pi / 2)) as room:
        room._wheels.place = (0.0, -1.93, -math.pi / 2)  # its front is now 6 cm in the wall
        for _ in range(30):
            room.step(0.3, 0)
        assert room.bumped
        assert place(room)[1] == -1.93
        for _ in range(60):
            room.step(-0.3, 0)
        assert not room.bumped
        assert place(room)[1] > -1.93 + 0.25


def test_the_ball_is_pushed_and_rolls_on():
    with Simulation(start=(2.84, 0.55, -math.pi / 2), time=60.0) as room:  # the ball rests ahead
        before = room.pose("ball")
        touched = False
        for _ in range(120):
            room.step(0.3, 0)
            touched |= room.bumped
        after = room.pose("ball")
        assert touched
        assert np.linalg.norm(after[:2] - before[:2]) > 0.1
        assert nearest_on_body(place(room), *after[:2])[1] >= BALL_RADIUS - 1e-6


def way_of(room, linear, angular, steps=100):
    """Metres that the robot moves, at most, while it is commanded so for `steps` steps of 0.02 s."""
    before, ways = place(room), [0.0]
    for _ in range(steps):
        room.step(linear, angular)
        ways.append(math.dist(before[:2], place(room)[:2]))
    return max(ways)


def test_from_a_wedged_ball_the_robot_can_move_away():
    with Simulation(start=(4.4, -1.55, -1.233), time=60.0) as room:
        room._wheels.place = (4.456305232, -1.671509979, -1.233024163)  # the ball is between it and a corner
        ball = room._movers.balls["ball"]
        ball.x, ball.y = 4.639998628, -1.974826058
        assert max(way_of(room, *command) for command in ((-0.3, 0), (0, 1), (0, -1), (0.3, 0))) > 0.1


def test_the_car_goes_back_for_a_robot_that_it_holds():
    with Simulation(start=(0.4, -0.3, 0), time=60.0) as room:
        room._wheels.place = (2.081686465, 0.955950364, 1.411943624)  # between furniture and car
        room._movers.walkers["toycar"].time = 7.6
        assert max(way_of(room, linear, 0, 200) for linear in (0.3, -0.3) * 2) > 0.1


def test_the_car_goes_back_for_a_robot_that_can_only_move_to_and_fro():
    with Simulation(1, room=furnished(32), sensor=False) as room:
        room._wheels.place = (-0.762153225, -1.628152218, -1.611798562)  # in a corner; the car is behind it
        room._held = room._wheels.place, 28.9, frozenset({1.0})  # after it has chased the ball
        room._movers.walkers["toycar"].time = 27.32
        ball = room._movers.balls["ball"]
        ball.x, ball.y = -0.773003969, -1.974999974
        assert max(way_of(room, linear, 0, 150) for linear in (0.3, -0.3) * 4) > 0.1


def test_a_robot_that_is_stuck_in_furniture_gets_some_play():
    with Simulation(start=FREE, time=60.0) as room:
        room._wheels.place = (1.963734977, -1.576336448, 1.14163877)  # every motion leads into something
        room.step(0.3, 0, 1.0)
        assert place(room)[:2] == pytest.approx((1.964, -1.576), abs=0.002)
        commands = ((-0.3, 0), (0.3, 0), (0, 1), (0, -1)) * 2
        assert max(way_of(room, *command) for command in commands) > 0.1


def test_the_car_waits_for_the_robot():
    with Simulation(start=(2.45, 0.1, math.pi / 2), time=62.0) as room:
        cars = []
        for _ in range(300):
            room.step(0, 0)
            cars.append(room.pose("toycar")[:2])
            assert nearest_on_body(place(room), *cars[-1])[1] >= 0.13 - 0.01
        assert not room.bumped
    assert (cars[-1] == cars[-2]).all()


def test_the_ball_rolls_by_the_recorded_formula_however_the_steps_are_cut():
    free_space, robot = SimpleNamespace(distance=lambda x, y: 9.0), (-9.0, 0.0, 0.0)
    ball = Ball.at(0.0, recorded_room().ball)
    for _ in range(450):
        ball.roll(0.02, free_space, robot)
    assert (ball.x, ball.y) == pytest.approx(recorded_room().ball.at(9.0)[0], abs=1e-6)


def test_odometry_drifts_by_its_seed():
    ends = []
    for seed in (1, 1, 2):
        with Simulation(seed, start=FREE) as room:
            for _ in range(5):
                room.step(0.3, 0.3, 1.0)
            true, counted = Pose.planar(*FREE).inverse() @ Pose.planar(*place(room)), room.odometry()
            ends.append(counted)
            error = math.hypot(counted.x - true.position[0], counted.y - true.position[1])
            assert 0.001 < error < 0.15  # of 1.5 m
    assert ends[0] == ends[1] != ends[2]


def test_uneven_wheels_count_a_turn_on_a_straight_way():
    turns = []
    for seed in range(5):
        with Simulation(seed, start=FREE, uneven=0.025) as room:
            room.step(0.3, 0.0, 1.0)
            way = math.dist(FREE[:2], place(room)[:2])
            turns.append(round(room.odometry().yaw / way, 1))
    assert {abs(turn) for turn in turns} <= {0.2, 0.3} and len({turn > 0 for turn in turns}) == 2


def test_rays_are_cast_exactly():
    wall = np.array([[(1, -1, 0), (1, 1, 0), (1, 1, 1)], [(1, -1, 0), (1, 1, 1), (1, -1, 1)]], float)
    segments = cut(wall, 0.5)
    assert np.unique(segments[..., 0]).tolist() == [1]
    distance = cast(segments, 0.0, 0.0, 0.0)
    degrees = np.arange(-44, 45)
    np.testing.assert_allclose(distance[degrees], 1 / np.cos(np.radians(degrees)), rtol=1e-9)
    assert np.isinf(distance[46:314]).all()


def test_scan_against_depth():
    """Points of the depth image at the scanner's height lie on the scan."""
    with Simulation(start=FREE, time=2.0, sensor=False) as room:
        scan, depth, robot = room.scan(), room.depth() / 1000, Pose.from_vector(room.pose("robot"))
        points = room.depth_camera().rays() * depth[..., None]
        points = robot.inverse().apply(Pose.from_vector(room.pose("camera")).apply(points))
    chosen = points[np.abs(points[..., 2] - MOUNT[1]) < 0.003]
    dx, dy = chosen[:, 0] - MOUNT[0], chosen[:, 1]
    ray = np.degrees(np.arctan2(dy, dx)) / math.degrees(scan.angle_increment)
    near = np.abs(ray - np.rint(ray)) < 0.1
    expected = scan.ranges[np.rint(ray[near]).astype(int) % len(scan.ranges)]
    error = np.abs(np.hypot(dx, dy)[near] - expected)
    assert near.sum() > 50
    assert np.median(error) < 0.005
    assert np.mean(error < 0.03) > 0.85  # the rest are edges


def test_who_does_not_take_part_is_nowhere():
    before_the_ball = (2.45, 0.0, 1.571)
    with (
        Simulation(start=before_the_ball, sensor=False) as everybody,
        Simulation(start=before_the_ball, movers=False) as alone,
        Simulation(start=before_the_ball, movers=["ball"]) as with_the_ball,
    ):
        numbers = {name: number for number, name in everybody.label_names.items()}
        counts = [
            [int((room.labels() == numbers[name]).sum()) for name in ("person", "ball")]
            for room in (everybody, alone, with_the_ball)
        ]
        assert counts[0][1] == counts[2][1] > 1000
        assert counts[1] == [0, 0] == [counts[2][0], 0]
        assert everybody.pose("ball").tolist() == with_the_ball.pose("ball").tolist()
        for _ in range(40):
            alone.step(0.3, 0.0, 0.05)
        assert not alone.bumped
        assert place(alone)[1] > 0.5
        with pytest.raises(ValueError, match="no pose of 'ball'; there are robot, camera, tof, marker"):
            alone.pose("ball")
    with pytest.raises(ValueError, match="the toy car is in its way"):
        Simulation(start=(2.54, -0.15, 0.0), time=4.0)
    Simulation(start=(2.54, -0.15, 0.0), time=4.0, movers=["ball", "person"])


@pytest.mark.parametrize("movers", ["ball", ["cat"], 3])
def test_movers_that_there_are_not(movers):
    with pytest.raises(ValueError, match="movers is True, False, or names of person, toycar, ball, got"):
        Simulation(movers=movers)
