"""`check` drives in the room: the same drive each time, and again from its actions."""

import re

import numpy as np
import pytest
from nbclassroom.exercises.checking import run_check
from nbclassroom.exercises.declaration import read_exercises
from nbclassroom.exercises.kinds.drive.runs import drive_scenarios
from nbclassroom.exercises.lesson import check_data_of

BLIND = "def control(observation, memory):\n    return 0.3, 0.0\n"
LOOKS = """def control(observation, memory):
    scan, depth = observation["scan"], observation["depth"]
    assert (scan.shape, scan.dtype, depth.shape, depth.dtype) == ((360,), np.float32, (90, 160), np.uint16)
    assert set(observation) == {"scan", "depth", "time"} and isinstance(observation["time"], float)
    assert 300 < np.median(depth) < 6000
    return (0.25 if min(scan[:30].min(), scan[-30:].min()) > 0.6 else 0.0), 0.3
"""
CASE = """# %% role="{role}" title="{title}"
def inputs(rng):
    limits = {{"bumps": ["<=", 0], "reach": [">=", 0.2]}}
    scenario = {{"seed": int(rng.integers(100)), "start": [-0.2067, -0.0367, {yaw}], "duration": {seconds}}}
    return (scenario | {{"thresholds": limits}},)
"""


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    """Two scenarios: towards the middle of the room, and towards a wall."""
    path = tmp_path_factory.mktemp("masters") / "80_driving.py"
    declaration = 'exercise("room-drive", function="control", subject="drive", sensors=("scan", "depth"))'
    cells = [f'# %% role="exercise"\n{declaration}', f'# %% role="answer"\n{BLIND}']
    cells.append(f'# %% role="solution"\n{LOOKS}')
    cells += [CASE.format(role="case", title="middle", yaw=0.1757, seconds=2.0)] * 2
    cells.append(CASE.format(role="case", title="wall", yaw=3.1, seconds=6.0))
    path.write_text("\n\n".join(cells), encoding="utf-8")
    (declared,) = read_exercises(path)
    return check_data_of(declared)


def control_in(source):
    names = {"np": np}
    exec(source, names)
    return names["control"]


def checked(data, source):
    return run_check(data, control_in(source))


def test_a_controller_gets_what_its_sensors_see(data):
    result = checked(data, LOOKS)
    assert [drive.record["ended"] for drive in result.calls] == [""] * 3
    assert result.results[0].passed and result.calls[0].record["metrics"]["bumps"] == 0


def test_a_drive_is_the_same_again(data):
    scenario = data.cases[0].calls[0].arguments[0]
    results = drive_scenarios(data, [scenario, scenario, scenario], lambda: control_in(LOOKS))
    assert results[0][0] == results[1][0] == results[2][0] and results[0][0]["steps"] == 20


def test_a_bump_is_shown_with_what_the_camera_saw_before(data):
    blind = BLIND.replace("0.0", "0.0  # on and on", 1)
    result = checked(data, blind.replace("return", "memory['on'] = 1\n    return"))
    assert [case.passed for case in result.results] == [True, True, False]
    assert re.search(r"The robot bumped into the wall at \d\.\d s", repr(result))
    page = result._repr_html_()
    captions = re.findall("<figcaption>(.*?)</figcaption>", page)
    assert captions[3:] == ["1.5 s before", "1.0 s before", "0.5 s before", "the bump"]
