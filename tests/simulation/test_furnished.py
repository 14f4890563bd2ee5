"""Furnished rooms: rules of placement, the same physics as computed apart, the same bytes everywhere."""

import math

import cv2
import numpy as np
import pytest
from independent_room import IndependentRoom, compare, first_hit, planar

from imgproc_course.geometry import Pose
from imgproc_course.simulation import Simulation, furnished, recorded_room
from imgproc_course.simulation.furnished import WORDS, outwards
from imgproc_course.simulation.pieces import load_pieces
from imgproc_course.simulation.simulation import OPTICAL
from imgproc_course.simulation.wheels import clearance

SEEDS = range(24)
HALF_SIZES = {"sign": (0.31, 0.15), "wall_marker": (0.167, 0.167), "marker": (0.167, 0.167)}  # metres
FLAT = ("rug", "sign", "wall_marker", "picture")


def corners(name, room):
    """(N, 2) of a piece's hull in the map."""
    x, y, yaw = room.places[name]
    c, s = math.cos(yaw), math.sin(yaw)
    return load_pieces().hulls[name] @ np.array([(c, s), (-s, c)]) + (x, y)


def gap(first, second):
    """Metres between two convex polygons that do not overlap; negative if they do."""
    polygons = [polygon.astype(np.float32)[:, None] for polygon in (first, second)]
    return min(
        -cv2.pointPolygonTest(polygons[1 - k], point.tolist(), True)
        for k in (0, 1)
        for a, b in zip(polygons[k][:, 0], np.roll(polygons[k][:, 0], -1, 0), strict=True)
        for point in np.linspace(a, b, 15)
    )


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_scan_depth_labels_and_free_space_are_those_of_rays_in_the_pieces_own_frames(seed):
    with Simulation(room=furnished(seed), sensor=False, movers=False) as simulation:
        found = compare(simulation, np.random.default_rng(seed))
    assert len(found["scan"]) > 80 and np.abs(found["scan"]).max() < 2e-5
    errors = np.abs(found["depth"])
    assert len(errors) > 110 and np.quantile(errors, 0.95) < 0.6
    assert (errors > 20).sum() <= 3  # a silhouette is half a pixel wide
    assert (~found["labels"]).sum() <= 3
    assert len(found["free"]) > 150 and np.abs(found["free"]).max() < 0.012


def test_the_robot_bumps_where_its_body_touches():
    room = furnished(3)
    apart = IndependentRoom(room.places)
    for yaw in np.arange(8) * math.pi / 4:
        with Simulation(room=room, movers=False, start=(*room.start[:2], yaw)) as simulation:
            while not simulation.bumped:
                before = planar(simulation.pose("robot"))
                simulation.step(0.3, 0.0, 0.1)
                assert simulation.time < 30
            assert -0.005 < apart.body_distance(planar(simulation.pose("robot"))) < 0.02
            assert -0.005 < apart.body_distance(before) < 0.05


def test_the_rules_of_placement_hold():
    for seed in SEEDS:
        room = furnished(seed)
        assert set(room.places) == set(load_pieces().origins)
        hulls = {name: corners(name, room) for name in room.places}
        standing = [name for name in hulls if name not in FLAT]
        for k, name in enumerate(standing):
            assert (hulls[name] > (-0.9, -2.1)).all() and (hulls[name] < (5.6, 2.3)).all()
            assert all(gap(hulls[name], hulls[other]) > 0.45 for other in standing[:k]), (seed, name)
        door = np.array([(5.6, -1.55), (4.75, -1.55), (4.75, -0.72), (5.6, -0.72)])
        assert all(gap(hulls[name], door) > 0 for name in standing)
        small = ("slippers", "blocks", "bin", "carton", "cartons", "plant", "stand")
        assert all(gap(hulls[name], hulls["rug"]) > 0 for name in small)
        for shown, size in (("sign", 0.62), ("wall_marker", 0.33), ("marker", 0.35)):
            pose = Pose.from_vector(room.poses[shown])
            before = [
                pose.apply(np.array((u, -v, 0.0)))[:2] for u in (-size / 2, size / 2) for v in (0.08, 0.7)
            ]
            zone = cv2.convexHull(np.array(before, np.float32))[:, 0]
            tall = [name for name in standing if name not in ("slippers", "blocks")]
            tall = [name for name in tall if (name, shown) != ("stand", "marker")]
            assert all(gap(hulls[name], zone) > 0 for name in tall), (seed, shown)


def test_what_moves_has_room_and_the_robot_starts_free():
    for seed in list(SEEDS)[:6]:
        room = furnished(seed)
        free = room.free_space.distance
        for time in np.arange(0, 60, 0.25).tolist():
            assert free(*room.person.at(time)[0][:2]) > 0.28
            assert free(*room.car.at(time, room.rug)[0][:2]) > 0.15
        assert clearance(free, *room.start) > 0.03
        ahead = [
            (room.start[0] + d * math.cos(room.start[2]), room.start[1] + d * math.sin(room.start[2]))
            for d in (0.3, 0.6, 0.9)
        ]
        assert min(free(*place) for place in ahead) > 0.18
        assert free(*room.ball.at(30.0)[0]) > 0.18 and math.dist(room.ball.start, room.start[:2]) > 0.55
        with Simulation(room=room) as simulation:
            for _ in range(100):
                simulation.step(0.0, 0.5, 0.3)
                assert not simulation.bumped


def test_sign_and_markers_are_where_their_poses_say():
    poses = []
    for seed in (0, 1, 2):
        room = furnished(seed)
        apart = IndependentRoom(room.places)
        poses += [(apart.cast, pose, name) for name, pose in room.poses.items()]
    model = recorded_room().model
    still = model.joint < 0

    def cast(origin, direction):
        distance, row = first_hit(origin, direction, model.triangles[still].astype(float))
        return distance, model.label[still][row]

    poses += [(cast, pose, name) for name, pose in recorded_room().poses.items()]
    for cast_there, vector, name in poses:
        pose, (half_width, half_height) = Pose.from_vector(vector), HALF_SIZES[name]
        label = 12 if name == "sign" else 13
        for u, v in ((0, 0), (0.96, 0), (-0.96, 0), (0, 0.96), (0, -0.96)):
            place = pose.apply(np.array([u * half_width, -0.5, v * half_height]))
            assert cast_there(place, pose.rotation[:, 1]) == (pytest.approx(0.5, abs=1e-3), label), name
        for u, v in ((1.04, 0), (-1.04, 0), (0, 1.04), (0, -1.04)):
            place = pose.apply(np.array([u * half_width, -0.5, v * half_height]))
            distance, met = cast_there(place, pose.rotation[:, 1])
            assert abs(distance - 0.5) > 1e-3 or met != label, name


def test_rooms_differ_and_are_kept():
    assert furnished(5) is furnished(np.int64(5))
    assert furnished(5).name == "room 5" and recorded_room().name == "recorded"
    assert len({furnished(seed).places["sofa"] for seed in SEEDS}) == len(SEEDS)
    assert {furnished(seed).word for seed in SEEDS} <= set(WORDS)
    assert len({furnished(seed).word for seed in SEEDS}) > 5


@pytest.mark.parametrize("seed", [-1, 1.5, "17", None, True])
def test_a_seed_that_is_no_whole_number(seed):
    with pytest.raises(ValueError, match=r"has a whole number from 0 on, such as 17, got"):
        furnished(seed)


def test_a_start_that_is_not_free():
    room = furnished(0)
    sofa = room.places["sofa"]
    with pytest.raises(ValueError, match=r"a wall or furniture is in its way; choose another start, such as"):
        Simulation(room=room, start=sofa)


def test_a_number_keeps_its_room():
    """Scenarios are stored with numbers of rooms: a change of the rules would be another room."""
    room = furnished(17)
    assert room.places["sofa"] == (1.687, 1.72, 0.0) and room.places["blocks"] == (2.314, -1.25, 2.741)
    assert (room.start, room.ball.start) == ((4.898, -0.703, -2.616), (0.655, -0.297))
    assert furnished(0).start == (0.786, -0.441, 1.986)
    assert (room.word, furnished(0).word) == ("LIBRARY", "LAUNDRY")
    assert room.markers == {"marker": 45, "wall_marker": 20} and {7, 12}.isdisjoint(room.markers.values())


def test_the_sign_has_its_word_and_the_markers_are_read_where_they_are():
    detector = cv2.aruco.ArucoDetector(cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50))
    room = furnished(2)
    with Simulation(room=room, size=(1280, 720), movers=False) as simulation:
        for name, number in room.markers.items():
            pose = Pose.from_vector(room.poses[name])
            u, v = outwards(room.poses[name])
            eye = Pose.planar(*(pose.position[:2] + 1.1 * np.array([u, v])), math.atan2(-v, -u))
            camera = eye @ Pose(OPTICAL, np.array([0, 0, 0.20]))
            simulation.look(camera.vector)
            corners, ids, _ = detector.detectMarkers(simulation.frame())
            square = 0.125 * np.array([(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)])
            expected = simulation.camera.project(camera.inverse().apply(pose.apply(square)))
            found = corners[ids.ravel().tolist().index(number)][0]
            assert np.abs(found - expected).max() < 2.5
