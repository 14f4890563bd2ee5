"""The same seed and commands give the same bytes in every process, thread and fork, on every processor."""

import hashlib
import multiprocessing
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from imgproc_course.simulation import (
    CAMERA,
    GESTURES,
    Simulation,
    draw_hand,
    furnished,
    gesture_track,
    random_hand,
)
from imgproc_course.simulation.renderer import BALL_LIGHT, ColorRenderer, NumberRenderer
from imgproc_course.simulation.room import recorded_room

# Older instruction sets: of NumPy, of the C library and of OpenCV.
OLDER = {
    "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4 AVX512_ICL AVX512_SPR",  # its names since NumPy 2.4
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX512F",
    "OPENCV_CPU_DISABLE": "AVX2,FP16,AVX512-SKX,AVX512-COMMON",
    "OPENCV_IPP": "disabled",
}


def digest(steps=12, lighting="day"):
    """SHA-256 of everything that a short drive gives, and of a hand and gestures."""
    with Simulation(7, time=1.0, lighting=lighting) as room:
        total = hashlib.sha256()
        for k in range(steps):
            room.step(0.3, 0.8, 0.1)
            if k % 6 == 5:
                for array in (
                    room.frame(),
                    room.depth(),
                    room.labels(),
                    room.depth("tof"),
                    room.scan().ranges,
                ):
                    total.update(np.ascontiguousarray(array).tobytes())
        random = np.random.default_rng(7)
        hand = random_hand(random, 4, (360, 640))
        total.update(draw_hand(room.frame(), hand, 12, random).tobytes())
        for gesture in GESTURES:
            total.update(gesture_track(gesture, random).tobytes())
        total.update(
            repr((room.odometry(), room.pose("ball").tolist(), room.pose("robot").tolist())).encode()
        )
    return total.hexdigest()


def digest_of_furnished_rooms():
    """SHA-256 of everything that decides in some rooms, and of an image."""
    total = hashlib.sha256()
    for seed in (0, 1, 2, 3, 2**64 + 5):
        room = furnished(seed)
        total.update(repr((room.places, room.start, room.person, room.car, room.ball, room.word)).encode())
        total.update(room.model.triangles.tobytes() + repr(room.free_space._millimetres).encode())
        total.update(b"".join(room.poses[name].tobytes() for name in sorted(room.poses)))
    with Simulation(room=furnished(3)) as simulation:
        simulation.step(0.2, 0.3, 0.5)
        for array in (simulation.frame(), simulation.depth(), simulation.scan().ranges):
            total.update(np.ascontiguousarray(array).tobytes())
    return total.hexdigest()


@pytest.fixture(scope="module")
def expected():
    return digest()


def in_a_child(connection, room):
    room.step(0.1, 0.2)
    connection.send((digest(), hashlib.sha256(room.frame().tobytes()).hexdigest()))


def test_again_and_beside_another_one_in_threads(expected):
    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(digest, (12, 12))) == [expected] * 2


def test_one_thread_draws_the_frame_while_another_draws_depth_and_labels():
    with Simulation(7) as alone, Simulation(7) as shared, ThreadPoolExecutor(1) as pool:
        for _ in range(15):
            for room in (alone, shared):
                room.step(0.3, 0.8, 0.1)
            others = pool.submit(lambda: (shared.depth(), shared.labels(), shared.depth("tof")))
            assert (shared.frame() == alone.frame()).all()
            expected = (alone.depth(), alone.labels(), alone.depth("tof"))
            for array, other in zip(expected, others.result(), strict=True):
                assert (array == other).all()


def test_two_rooms_draw_in_two_threads_what_each_draws_alone():
    starts = {"a": (0.7, -0.9, 0.3), "b": (1.0, 1.0, -0.5)}
    rooms = {name: Simulation(1, start=start, sensor=False) for name, start in starts.items()}
    alone = {name: (room.frame(), room.depth()) for name, room in rooms.items()}

    def differences(name):
        room = rooms[name]
        count = 0
        for _ in range(60):
            room.look(room.pose("camera"))  # nothing has moved
            count += int((room.frame() != alone[name][0]).any() or (room.depth() != alone[name][1]).any())
        return count

    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(differences, rooms)) == [0, 0]
    for room in rooms.values():
        room.close()


def test_no_two_renderers_share_what_panda3d_converts_vertices_with():
    renderers = [
        ColorRenderer(recorded_room(), "day"),
        ColorRenderer(recorded_room(), "day"),
        NumberRenderer(recorded_room().model),
    ]
    formats = []
    for renderer in renderers:
        renderer.add_view(CAMERA.resized(160, 90))
        nodes = [path.node() for path in renderer._root.find_all_matches("**/+GeomNode")]
        all_formats = {node.get_geom(0).get_vertex_data().get_format() for node in nodes}
        formats.append({str(f) for f in all_formats if f.get_array(0).get_num_columns() > 2})
        # Four floats are read where they lie.
        for column in (f.get_array(0).get_column(k) for f in all_formats for k in range(2)):
            assert column.get_name().get_name() != "vertex" or column.get_num_components() == 4
    assert [len(own) for own in formats] == [3, 3, 1]  # textured, lit, shining; textured blinders
    assert not (formats[0] & formats[1] or formats[1] & formats[2] or formats[0] & formats[2])
    for renderer in renderers:
        renderer.close()


def test_the_lamps_of_the_ball_are_added_in_a_fixed_order():
    for lighting in ("day", "evening"):
        renderer = ColorRenderer(recorded_room(), lighting)
        lamps = [path.node() for path in renderer._root.find_all_matches("**/+DirectionalLight")]
        lamps = lamps[: len(BALL_LIGHT[lighting]) - 1]  # of the first ball
        ordered = sorted(lamps, key=lambda lamp: -lamp.get_priority())
        expected = [direction for direction, _ in BALL_LIGHT[lighting][1:]]
        assert [tuple(lamp.get_direction()) for lamp in ordered] == [pytest.approx(d) for d in expected]
        assert len({lamp.get_priority() for lamp in lamps}) == 2
        renderer.close()


@pytest.mark.filterwarnings("ignore:This process .* is multi-threaded:DeprecationWarning")
def test_after_a_fork_inherited_and_new(expected):
    with Simulation(3) as room:
        room.frame()
        ours, theirs = multiprocessing.Pipe()
        child = multiprocessing.get_context("fork").Process(target=in_a_child, args=(theirs, room))
        child.start()
        new, inherited = ours.recv()
        child.join()
        room.step(0.1, 0.2)
        assert (new, inherited) == (expected, hashlib.sha256(room.frame().tobytes()).hexdigest())


def test_another_process_with_older_instruction_sets(expected):
    program = """if True:
        import sys
        sys.path.insert(0, sys.argv[1])
        import cv2, test_determinism
        from numpy._core._multiarray_umath import __cpu_features__
        print(__cpu_features__["X86_V3"] or cv2.checkHardwareSupport(11))  # cv::CPU_AVX2
        print(test_determinism.digest(), test_determinism.digest_of_furnished_rooms())
    """
    result = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", program, str(Path(__file__).parent)],
        env={**os.environ, **OLDER},
        capture_output=True,
        text=True,
    )
    assert result.returncode == 0, result.stderr
    assert result.stdout.split() == ["False", expected, digest_of_furnished_rooms()]


def test_the_sensor_can_be_switched_off_and_the_seed_changes_its_noise():
    frames = {}
    for name, arguments in (("a", {}), ("b", {"seed": 1}), ("clean", {"sensor": False})):
        with Simulation(**arguments) as room:
            first, second = room.frame(), room.frame()
            assert (first == second).all()  # looking changes nothing
            frames[name] = first.astype(int)
    noise = (frames["a"] - frames["b"])[100:260, 200:440]
    assert 1 < noise.std() < 5
    assert np.abs(noise.mean()) < 0.2
    assert (frames["clean"] != frames["a"]).mean() > 0.5
