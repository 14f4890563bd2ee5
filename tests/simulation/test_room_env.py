"""RoomEnv: as Gymnasium asks for it, the same bytes again, metrics that are true, and clear errors."""

import hashlib
import inspect
import math
import re
import sys
import textwrap
import types
from pathlib import Path

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.wrappers import RecordVideo, TimeLimit

from imgproc_course.simulation import Simulation, furnished, recorded_room, room_map
from imgproc_course.simulation.room_env import NO_RANGE, SENSORS, RoomEnv, controller_observation
from imgproc_course.simulation.room_map import BUMP, PIXELS, START, draw_map
from imgproc_course.simulation.wheels import BODY_CENTER, BODY_LENGTH, BODY_WIDTH

PAGE = Path(__file__).parents[2] / "docs/reference/room_env.md"
FREE = (0.0, 0.0, 0.0)  # a start with nothing near
BALL = [1.0, 0.0, 0.8, 0.2]


@pytest.fixture
def env():
    made = RoomEnv(SENSORS, render_mode="rgb_array")
    yield made
    made.close()


def drive(env, seed, actions, **options):
    """SHA-256 of all that a drive gives, and its last info."""
    observation, info = env.reset(seed=seed, options=options)
    total = hashlib.sha256()
    for action in (*actions, None):
        for name in sorted(observation):
            total.update(observation[name].tobytes())
        total.update(repr((info, env.path[-1])).encode())
        if action is not None:
            observation, _, _, _, info = env.step(action)
    return total.hexdigest(), info


# One warning that no space of speeds in m/s and rad/s avoids.
@pytest.mark.filterwarnings("ignore:.*we recommend using a symmetric and normalized space")
@pytest.mark.parametrize("sensors", [(), ("scan",), SENSORS], ids=str)
def test_gymnasium_accepts_it(sensors):
    env = gymnasium.make("imgproc_course/Room-v0", sensors=sensors, render_mode="rgb_array")
    check_env(env.unwrapped)
    env.close()


def test_the_ten_lines_of_its_documentation_drive_it(capsys):
    lines = inspect.getdoc(RoomEnv).split("::\n", 1)[1].split("\n\nAn action", 1)[0]
    exec(compile(textwrap.dedent(lines), "RoomEnv", "exec"), names := {})
    names["env"].close()
    bumps, metres = capsys.readouterr().out.split()
    assert int(bumps) == 0 and 0.5 < float(metres) < 2.1 and names["info"]["time"] == 10.0


def test_time_limit_ends_it_earlier(env):
    limited = TimeLimit(env, max_episode_steps=3)
    limited.reset(seed=1)
    assert [limited.step((0.1, 0.0))[3] for _ in range(3)] == [False, False, True]


@pytest.fixture
def videos(monkeypatch):
    """What RecordVideo films: (frames, fps) of each. moviepy, which it writes with, needs an older pillow."""
    videos = []
    clips = types.ModuleType("moviepy.video.io.ImageSequenceClip")
    clips.ImageSequenceClip = lambda frames, fps: (
        videos.append((list(frames), fps)) or types.SimpleNamespace(write_videofile=lambda path, logger: None)
    )
    for name in ("moviepy", "moviepy.video", "moviepy.video.io", clips.__name__):
        monkeypatch.setitem(sys.modules, name, clips)
    return videos


def test_the_program_of_its_page_films_twenty_looks(videos, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (program,) = re.findall(r"<!-- tested: wrappers -->\n```python\n(.*?)```", PAGE.read_text("utf-8"), re.S)
    exec(compile(program, PAGE, "exec"), {})
    ((frames, fps),) = videos
    assert (len(frames), fps) == (21, 10)


def test_record_video_gets_the_camera_beside_the_map(env, videos, tmp_path):
    filmed = RecordVideo(env, str(tmp_path / "videos"))
    filmed.reset(seed=2, options={"start": FREE, "duration": 0.3})
    while not filmed.step((0.3, 0.0))[3]:
        pass
    camera = env.frame()
    filmed.close()
    ((frames, fps),) = videos
    assert (len(frames), fps) == (4, 10)
    assert {frame.shape for frame in frames} == {(276, 892, 3)} and frames[0].dtype == np.uint8
    drawn = draw_map(env.path)[..., ::-1]
    assert (frames[-1][:, -drawn.shape[1] :] == drawn).all()
    assert abs(frames[-1][:, :490].mean((0, 1)) - camera[..., ::-1].mean((0, 1))).max() < 1


def test_the_same_seed_gives_the_same_bytes_again_and_in_another_environment(env):
    actions = [(0.3, 0.5), (0.2, -1.0), (-0.1, 0.3)] * 2
    first = drive(env, 3, actions, balls=[BALL], movers=["person"])
    drive(env, 4, actions[:2], lighting="evening")
    other = RoomEnv(SENSORS)
    assert drive(env, 3, actions, balls=[BALL], movers=["person"]) == first
    assert drive(other, 3, actions, balls=[BALL], movers=["person"]) == first
    assert drive(other, 5, actions, balls=[BALL], movers=["person"]) != first
    other.close()


def test_environments_side_by_side_do_not_disturb_each_other(env):
    actions = [(0.3, 0.5)] * 4
    expected = [drive(env, 6, actions), drive(env, 7, actions, balls=[BALL])]
    envs = [RoomEnv(SENSORS), RoomEnv(SENSORS)]
    results = [envs[0].reset(seed=6)[0], envs[1].reset(seed=7, options={"balls": [BALL]})[0]]
    totals = [hashlib.sha256(), hashlib.sha256()]
    infos = [other._metrics.info() for other in envs]
    for action in (*actions, None):
        for k, other in enumerate(envs):
            for name in sorted(results[k]):
                totals[k].update(results[k][name].tobytes())
            totals[k].update(repr((infos[k], other.path[-1])).encode())
            if action is not None:
                results[k], _, _, _, infos[k] = other.step(action)
    assert [(total.hexdigest(), info) for total, info in zip(totals, infos, strict=True)] == expected
    for other in envs:
        other.close()


def test_it_sees_what_a_simulation_of_its_own_sees(env):
    observation, _ = env.reset(seed=8, options={"start": FREE, "balls": [BALL], "uneven": 0.02})
    seed = int(np.random.default_rng(8).integers(1 << 31))
    options = {"movers": [], "balls": [BALL], "uneven": 0.02, "size": (320, 180), "depth_size": (160, 90)}
    with Simulation(seed, start=FREE, **options) as plain:
        for _ in range(3):
            assert (observation["depth"] == plain.depth()).all()
            assert (observation["image"] == plain.frame()).all()
            assert observation["odometry"].tolist() == list(plain.odometry()[:3])
            assert (controller_observation(observation)["scan"] == plain.scan().ranges).all()
            observation, *_ = env.step((0.3, 0.4))
            plain.step(0.3, 0.4, 0.1)


def test_the_scan_of_an_observation_is_bounded_and_a_controllers_has_inf(env):
    observation, _ = env.reset(seed=1, options={"start": FREE})
    observation["scan"][5] = NO_RANGE
    given = controller_observation(observation)
    assert np.flatnonzero(np.isinf(given["scan"])).tolist() == [5] and given["scan"].dtype == np.float32
    assert given["time"] == 0.0 and isinstance(given["time"], float)


def test_starts_are_drawn_free_and_another_one_without_a_seed(env):
    starts = []
    for k in range(30):
        env.reset(seed=0 if k == 0 else None, options={"movers": ["person", "toycar", "ball"]})
        starts.append(env.path[0])
        assert min(env._simulation.gaps().values()) > 0.45
    assert len(set(starts)) == 30


@pytest.mark.parametrize("uneven, is_there", [(None, True), (0.2, False)])
def test_goal_is_a_place_of_the_odometry(uneven, is_there):
    env = RoomEnv(())
    goal = {"goal": (1.2, -1.3, 0.03)} | ({"uneven": uneven} if uneven else {})
    env.reset(seed=0, options={"start": (0.95, -1.3, 0.0)} | goal)
    times = [env.step((0.3, 0.0))[4]["goal_time"] for _ in range(20)]
    assert any(times) == is_there
    assert min(math.dist(place[:2], (1.2, -1.3)) for place in env.path) < 0.02
    env.close()


def test_metrics_of_a_drive_into_the_boxes():
    env = RoomEnv(())
    _, info = env.reset(
        seed=0, options={"start": (0.95, -1.3, 0.0), "duration": 5.0, "goal": (1.2, -1.3, 0.1)}
    )
    assert (info["clearance"], info["bumps"], info["time"], info["bumped_into"]) == (None, 0, 0.0, "")
    overs = [env.step((0.3, 0.0))[3] for _ in range(50)]
    info = env._metrics.info()
    assert overs == [False] * 49 + [True]
    assert (info["bumps"], info["bumped_into"], info["places"]) == (1, "box", 2)
    assert 0 <= info["clearance"] < 0.005 and info["nearest_to"] == "box"
    for action in (0.3, [], (0.1, 0.2, 0.3)):
        with pytest.raises(ValueError, match="an action is two numbers"):
            env.step(action)
    x, y, _ = env.path[-1]
    assert info["reach"] == info["distance"] == pytest.approx(math.dist((0.95, -1.3), (x, y)), abs=1e-3)
    first = next(k for k, (x, _, _) in enumerate(env.path) if abs(x - 1.2) < 0.1)
    assert info["goal_time"] == pytest.approx(first * 0.1)
    ((look, place),) = env.bump_places
    assert place == env.path[look] and place == pytest.approx(env.path[-1], abs=0.02)
    env.close()


def test_home_and_answer_are_those_of_the_end():
    env = RoomEnv(())
    _, info = env.reset(seed=0, options={"start": (1.4, -0.1, 0.0), "answer": -30.0})
    to_sign = math.degrees(math.atan2(-0.29 + 0.1, 5.59 - 1.4))
    assert info["home"] == 0 and info["answer_error"] == pytest.approx(abs(0 - to_sign + 30), abs=0.2)
    for speed in (0.2, -0.2):
        for _ in range(20):
            *_, info = env.step((speed, 0.0))
    assert info["reach"] > 0.3 and info["home"] < 0.1
    for _ in range(20):
        *_, info = env.step((0.0, -0.3))
    x, y, yaw = env.path[-1]
    right = math.degrees(math.atan2(-0.29 - y, 5.59 - x)) - 30
    assert info["answer_error"] == pytest.approx(abs(math.degrees(yaw) - right), abs=0.2)
    assert env.reset(seed=0, options={"start": (1.4, -0.1, 0.0)})[1]["answer_error"] is None
    env.close()


def test_clearance_is_the_true_distance_of_the_body(env):
    """Against points of the body's outline, in a drive past furniture."""
    env.reset(seed=11, options={"start": (2.2, -0.6, -1.2)})
    along, aside = BODY_LENGTH / 2 * np.linspace(-1, 1, 60), BODY_WIDTH / 2 * np.linspace(-1, 1, 40)
    outline = [(a, side * BODY_WIDTH / 2) for a in along for side in (-1, 1)]
    outline += [(side * BODY_LENGTH / 2, b) for b in aside for side in (-1, 1)]
    distance, least = recorded_room().free_space.distance, math.inf
    for _ in range(12):
        env.step((0.2, 0.6))
        x, y, yaw = env.path[-1]
        c, s = math.cos(yaw), math.sin(yaw)
        points = [(x + (a + BODY_CENTER) * c - b * s, y + (a + BODY_CENTER) * s + b * c) for a, b in outline]
        if env._simulation.speeds[0] > 0.02:
            least = min(least, *(distance(*point) for point in points))
    assert env._metrics.info()["clearance"] == pytest.approx(least, abs=0.003)


def test_what_moves_counts_as_a_bump_but_not_for_the_clearance():
    env = RoomEnv(())
    env.reset(seed=0, options={"start": FREE, "balls": [[0.5, 0.0, 0.0, 0.0]], "duration": 8.0})
    for _ in range(80):
        *_, info = env.step((0.1, 0.0))
    assert info["bumps"] >= 1 and info["bumped_into"] == "ball" and info["clearance"] > 0.3
    assert 0.2 < info["ball_gap"] < 0.5  # it pushes the ball: about 0.14 m, not 0.6 m
    assert info["ball_angle"] < 30
    env.close()


@pytest.mark.parametrize(
    ("balls", "speeds", "remarks"),
    [
        ([(1.1, 0.0)], (0.08, 0.0), {"it is too near": "On average it was 0.23 m too near."}),
        ([(2.5, 0.0)], (0.08, 0.0), {"it is too far away": "On average it was 1.17 m too far away."}),
        ([(1.0, 0.0)], (0.25, 0.0), {"it is too near": ""}),
        (
            [(1.5, 0.0), (1.06, 1.06)],
            (0.0, 0.12),
            {"another ball": "It looked at the second ball: 6° past it, on average."},
        ),
        (
            [(1.5, 0.5)],
            (0.0, -0.3),
            {"it turns away from the ball": "When it began to turn, it turned away from the ball."},
        ),
        ([(1.5, 0.5)], (0.0, 0.05), {}),
    ],
)
def test_what_only_the_truth_shows_of_a_ball_is_remarked(balls, speeds, remarks):
    env = RoomEnv(())
    env.reset(seed=0, options={"start": FREE, "balls": [[x, y, 0.0, 0.0] for x, y in balls], "duration": 8.0})
    for _ in range(80):
        *_, info = env.step(speeds)
    assert info["remarks"] == remarks and not info["low"]
    env.close()


def test_who_stands_is_not_judged_by_the_clearance():
    env = RoomEnv(())
    env.reset(seed=0, options={"start": FREE, "movers": ["person"]})
    for _ in range(20):
        *_, info = env.step((0.0, 0.5))
    assert info["clearance"] is None and info["distance"] == 0.0 and info["reach"] == 0.0
    env.close()


def test_the_map_shows_path_and_bumps():
    drawn = draw_map([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)], [(3, 0.5, 0.5)], balls=[(0.5, -0.5, 1.0, 0.0)])
    x0, y0 = recorded_room().free_space.origin

    def color(x, y):
        return tuple(drawn[drawn.shape[0] - 1 - round((y - y0) * PIXELS), round((x - x0) * PIXELS)].tolist())

    assert color(0, 0) == START and color(0.5, 0.5) == BUMP
    assert color(0.5, -0.5) == color(1.35, -0.5) == room_map.BALL != color(1.5, -0.5)
    assert color(0.5, 0.0) not in (color(0.5, 0.2), START) and color(1.75, -1.2) != color(0.5, 0.2)


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        ({"sensors": ("sonar",)}, {}, "sensors are a tuple of some of scan, depth, image, odometry, got"),
        ({"sensors": "scan"}, {}, "sensors are a tuple of some of"),
        ({"depth_size": (100, 100)}, {}, "depth_size is (width, height), 16:9, 160 to 1920 pixels wide"),
        ({"image_size": (64, 36)}, {}, "image_size is (width, height)"),
        ({"render_mode": "human"}, {}, "render_mode is None or \"rgb_array\", got 'human'"),
        ({}, {"strat": FREE}, "unknown option 'strat'; expected some of room, start"),
        ({}, {"start": (2.0, -1.5, 0.0)}, "the robot cannot start at (2.0, -1.5, 0.0): a wall or furniture"),
        ({}, {"start": (1.0, 2.0)}, "start is three finite numbers"),
        ({}, {"balls": [[1.75, -1.2, 0, 0]]}, "a ball cannot begin at (1.75, -1.2): there is no room"),
        ({}, {"balls": [[2.0]]}, "a ball is four finite numbers"),
        ({}, {"goal": (1.0, 2.0)}, "goal is (x, y, radius) in metres"),
        ({}, {"duration": 0}, "duration is 0.1 seconds or more, got 0"),
        ({}, {"lighting": "night"}, 'lighting is "day" or "evening", got \'night\''),
        ({}, {"movers": ["cat"]}, "movers is True, False, or names of person, toycar, ball"),
        ({}, {"room": "kitchen"}, "'kitchen'"),
    ],
)
def test_errors_say_what_to_do(arguments, options, message):
    with pytest.raises(ValueError) as error:
        RoomEnv(**{"sensors": (), **arguments}).reset(seed=0, options=options)
    assert message in str(error.value)


def test_driving_before_the_reset():
    with pytest.raises(gymnasium.error.ResetNeeded, match="call reset"):
        RoomEnv(()).step((0.1, 0.0))


def test_a_furnished_room_by_its_number():
    room = furnished(17)
    with Simulation(room=room, movers=False, sensor=False) as simulation:
        expected = simulation.scan().ranges
    env = RoomEnv(("scan",))
    observation, _ = env.reset(seed=1, options={"room": 17, "start": [*room.start]})
    ranges = controller_observation(observation)["scan"]
    assert np.isfinite(ranges).sum() > 300
    np.testing.assert_allclose(ranges, expected, atol=0.04)  # its noise is 0.005 m
    env.reset(seed=2, options={"room": 18})
    start = env.path[0]
    assert furnished(18).free_space.distance(*start[:2]) > 0.2
    env.close()


def test_a_drive_that_cannot_begin_ends_the_one_before():
    """Otherwise the old robot would drive on, in a room that `room` no longer is."""
    env = RoomEnv(())
    env.reset(seed=1, options={"start": FREE})
    with pytest.raises(ValueError, match="cannot start"):
        env.reset(seed=1, options={"start": (2.0, -1.5, 0.0)})
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step((0.1, 0.0))
    env.close()
