"""What `check` does with a controller: it drives, and says and shows what the robot did."""

import io
import linecache
import re

import numpy as np
import pytest
from nbclassroom.authoring.lesson_files import lesson_files
from nbclassroom.authoring.masters import read_master
from nbclassroom.authoring.validation import validate_exercise
from nbclassroom.exercises import progress
from nbclassroom.exercises.check_files import read_check_file
from nbclassroom.exercises.checking import check, run_cases, run_check
from nbclassroom.exercises.declaration import MasterError, exercise, read_exercises
from nbclassroom.exercises.kinds.drive.drive import METRICS, SENSORS, STEP, Drive
from nbclassroom.exercises.kinds.drive.images import draw_map, look_back
from nbclassroom.exercises.kinds.drive.runs import drive_scenarios
from nbclassroom.exercises.kinds.drive.scenario import read_scenario
from nbclassroom.exercises.lesson import check_data_of
from PIL import Image
from plane_env import BLIND, LATE, PARTS, RIGHT, PlaneEnv, driving_on_a_plane

from imgproc_course.simulation import room_env


@pytest.fixture(scope="module", autouse=True)
def on_a_plane():
    """Drives in the environment of this folder."""
    with driving_on_a_plane():
        yield


@pytest.fixture
def master(write_master):
    return lambda **changed: write_master("80_driving", **(PARTS | changed))


@pytest.fixture
def data(master):
    (declared,) = read_exercises(master())
    return check_data_of(declared)


def control_in(source):
    names, file = {"np": np}, "<control>"
    linecache.cache[file] = (len(source), None, source.splitlines(keepends=True), file)
    exec(compile(source, file, "exec"), names)
    return names["control"]


def checked(data, source):
    return run_check(data, control_in(source))


def test_the_environment_of_the_room_is_as_a_drive_expects():
    assert (room_env.SENSORS, room_env.STEP) == (SENSORS, STEP)
    _, info = room_env.RoomEnv(()).reset(seed=1, options={"duration": 1.0})
    assert {*METRICS, "bumped_into", "nearest_to", "low", "remarks"} == {*info}


def test_a_scenario_has_the_defaults_of_the_environment():
    scenario = {"seed": 1, "title": "t", "thresholds": {"bumps": ["<=", 0]}}
    assert read_scenario(scenario) | {"uneven": 0.0} == scenario | room_env.OPTIONS


@pytest.mark.parametrize(
    ("subject", "sensors"), [("drive", ()), ("drive", "scan"), ("drive", ("radar",)), ("function", ("scan",))]
)
def test_an_exercise_that_drives_names_its_sensors(subject, sensors):
    expected = "a tuple with some of scan, depth, image, odometry" if subject == "drive" else "none"
    message = f"exercise a-drive: sensors=.*, expected {expected} for subject='{subject}'"
    with pytest.raises(MasterError, match=message):
        exercise("a-drive", function="control", subject=subject, sensors=sensors)


@pytest.mark.parametrize(
    ("returned", "message"),
    [
        ("(1, 2)", r"inputs\(rng\) of a drive returns one scenario, a dict: return \(scenario,\)"),
        ("[(scenario(9),), (scenario(9),)]", r"inputs\(rng\) of a drive returns one scenario"),
        ("(LIMITS,)", "a scenario is wrong: Object contains unknown field `bumps`"),
        ('(scenario("17"),)', "a scenario is wrong: Expected `int | null`, got `str`"),
    ],
)
def test_a_case_that_is_no_scenario_is_refused(master, returned, message):
    (declared,) = read_exercises(
        master(case=f'# %% role="case" title="near"\ndef inputs(rng):\n    return {returned}')
    )
    with pytest.raises(MasterError, match=rf"^80_driving.py, line \d+: case-test-drive-1: {message}"):
        check_data_of(declared)


def test_a_scenario_has_the_title_of_its_case(data):
    (call,) = data.cases[0].calls
    assert call.arguments[0]["title"] == "near" and data.names == ("observation", "memory")


def test_the_check_cell_of_a_drive_is_not_compared(master):
    cells = {cell.id: cell for cell in read_master(master()).cells}
    assert cells["check-test-drive-1"].varies and not cells["answer-test-drive"].varies


def test_the_files_of_a_lesson_hold_scenarios_and_mistakes(master, tmp_path):
    path = tmp_path / "driving.json"
    path.write_text(lesson_files(read_master(master()))["checks/driving.json"])
    stored = read_check_file(path).exercise("test-drive")
    assert (stored.subject, stored.sensors) == ("drive", ("scan", "odometry"))
    assert stored.cases[1].calls[0].arguments[0]["room"] == 16
    assert checked(stored, RIGHT).passed and checked(stored, LATE).mistake.says == "It brakes too late."


@pytest.mark.parametrize(
    ("changes", "problem"),
    [
        ({}, None),
        (
            {"solution": f'# %% role="solution"\n{LATE}'},
            "case-test-drive-1: the solution does not pass it. The robot came as near as 0.10 m",
        ),
        (
            {"answer": f'# %% role="answer"\n{RIGHT}'},
            "test-drive: the stub passes a public case; let it drive",
        ),
        (
            {"second mistake": f'# %% role="mistake" name="right" says="No."\n{RIGHT}'},
            "test-drive: the mistake 'right' passes every public case",
        ),
        (
            {"second mistake": f'# %% role="mistake" name="same" says="No."\n{LATE}'},
            "test-drive: the mistake 'same' is taken for 'it comes too near'",
        ),
        (
            {"hidden": '# %% role="hidden" title="any"\ndef inputs(rng):\n    return (scenario(9),)'},
            "hidden-test-drive-1: inputs(rng) ignores rng",
        ),
    ],
)
def test_an_exercise_that_drives_is_validated(master, changes, problem):
    (declared,) = read_exercises(master(**changes))
    problems = validate_exercise(declared)
    assert [text.startswith(problem) for text in problems[:1]] == ([True] if problem else [])


def test_a_right_controller_earns_its_points(data):
    result = checked(data, RIGHT)
    assert result.passed and result.points == 4
    assert [drive.record["path"][-1][0] for drive in result.calls] == pytest.approx([0.6, 1.02, 0.51])


def test_a_drive_that_fails_costs_its_case_alone(data):
    result = checked(data, RIGHT.replace("0.6", 'observation["odometry"][0] + 0.1'))
    assert [case.passed for case in result.results] == [True, True, True]
    result = checked(
        data, "def control(observation, memory):\n    return min(0.3, observation['scan'][0] - 0.85), 0"
    )
    assert [case.passed for case in result.results] == [False, True, False] and result.points == 1


def test_each_scenario_has_memory_and_globals_of_its_own(data):
    source = (
        "COUNT = [0]\ndef control(observation, memory):\n"
        "    COUNT[0] += 1\n    memory['count'] = memory.get('count', 0) + 1\n"
        "    assert memory['count'] == COUNT[0] == round(observation['time'] * 10) + 1\n    return 0.0, 0.0\n"
    )
    assert [drive.record["ended"] for drive in checked(data, source).calls] == [""] * 3


def test_a_controller_cannot_change_what_the_robot_does(data):
    source = RIGHT.replace(
        "    return", "    ahead = observation['scan'][0]\n    observation['odometry'][:] = 9\n    return"
    )
    assert checked(data, source).passed


@pytest.mark.parametrize(
    ("body", "sentence", "advice"),
    [
        (
            "return 1 / (observation['time'] - 1), 0",
            "1.0 s: control() raised ZeroDivisionError: float division by zero"
            " (your line 2: return 1 / (observation['time'] - 1), 0).",
            "is 0 for this input",
        ),
        ("return None", "0.0 s: control returned None: expected two numbers, (linear, angular).", "Stuck?"),
        ("return 0.1, float('nan')", "0.0 s: control returned (0.1, nan): expected two numbers", "Stuck?"),
        (
            "while observation['time'] > 1: pass\n    return 0, 0",
            "1.1 s: control() took longer than 0.5 s for one step.",
            "A while loop may be endless",
        ),
        ("raise SystemExit", "0.0 s: control() raised SystemExit (your line 2: raise SystemExit).", "Stuck?"),
        ("return observation['sonar']", "0.0 s: control() raised KeyError: 'sonar'", "sonar"),
    ],
)
def test_what_ends_a_drive_is_said(data, body, sentence, advice):
    source = f"def control(observation, memory):\n    {body}\n"
    linecache.cache["<answer>"] = (len(source), None, source.splitlines(keepends=True), "<answer>")
    result = checked(data, source)
    assert [case.passed for case in result.results] == [False] * 3
    text = repr(result)
    assert text.count("The drive ended after") == 1 and advice in text
    assert f"In all 3 scenarios, as in the first: The drive ended after {sentence}" in text


@pytest.mark.parametrize(
    ("line", "sentence", "most"),
    [
        ("while time.thread_time() < end: pass", "0.05 s for a step on average: do less in each call", 24),
        ("if memory['n'] % 2: time.sleep(0.2)", "0.05 s for a step on average", 48),
        ("memory[end] = np.ones(60_000_000, np.uint8)", "takes more than 1 GB of memory: keep only what", 20),
    ],
)
def test_a_controller_that_costs_too_much_ends_all_drives_early(data, line, sentence, most):
    body = f"    end = time.thread_time() + 0.08\n    memory['n'] = memory.get('n', 0) + 1\n    {line}\n"
    result = checked(data, f"import time\ndef control(observation, memory):\n{body}    return 0, 0\n")
    assert [sentence in drive.record["ended"] for drive in result.calls] == [True] * 3
    steps = [drive.record["steps"] for drive in result.calls]
    assert max(steps) <= most and steps[2] == 0
    assert repr(result).count("The drive ended after") == 1


def test_a_controller_that_is_slow_now_and_then_drives_to_the_end(data):
    source = "import time\nCOUNT = [0]\n" + RIGHT.replace(
        "    return",
        "    COUNT[0] += 1\n    time.sleep(0.06 if COUNT[0] < 10 or COUNT[0] % 9 == 0 else 0)\n    return",
        1,
    )
    assert checked(data, source).passed


def test_a_controller_with_other_arguments_is_told_which(data):
    text = repr(checked(data, "def control(scan):\n    return 0, 0\n"))
    assert "begin your function with def control(observation, memory): and use these arguments." in text


def test_what_a_controller_prints_until_the_moment_that_is_shown_and_what_numpy_warns(data):
    source = BLIND.replace(
        "    return", "    print('now', round(observation['time'], 1))\n    np.float64(1) / 0\n    return"
    )
    result = checked(data, source)
    text = repr(result)
    printed = re.findall(r"^    (\d+\.\d) s: now (\d+\.\d)$", text, re.M)
    end = result.calls[0].record["decisive"] * 0.1
    assert "Your function printed:\n    …\n" in text and len(printed) == 12
    assert [times[0] for times in printed] == [times[1] for times in printed]
    assert float(printed[-1][0]) == pytest.approx(end) and end < result.calls[0].record["steps"] * 0.1
    assert "NumPy or Python warned: divide by zero" in text


def test_a_controller_that_waits_for_its_author_is_not_attempted(data):
    result = checked(data, "def control(observation, memory):\n    raise NotImplementedError\n")
    assert not result.attempted and result.results == ()


def test_the_stub_drives_and_is_no_try(data):
    result = checked(data, BLIND)
    assert not result.attempted and not result.passed
    text = repr(result)
    assert text.startswith("test-drive: not attempted yet; the function drives as you got it.")
    assert "The robot bumped into the wall at 3.4 s." in text and "Write control() in its cell" in text


def test_lines_below_the_return_of_the_stub_are_a_try_that_is_explained(data):
    source = BLIND.rstrip() + "\n    return 0.0, 0.0\n"
    linecache.cache["<answer>"] = (len(source), None, source.splitlines(keepends=True), "<answer>")
    result = checked(data, source)
    assert result.attempted
    assert "The last lines of control() are never run." in repr(result)


def test_check_in_a_notebook_drives_and_notes_a_try(master, tmp_path, monkeypatch):
    folder = tmp_path / "checks"
    folder.mkdir()
    (folder / "driving.json").write_text(lesson_files(read_master(master()))["checks/driving.json"])
    monkeypatch.setenv("NBCLASSROOM_CHECKS", str(folder))
    monkeypatch.setattr(progress, "_of_this_process", {})
    assert check("test-drive", control_in(RIGHT)).passed
    assert progress.progress_of("test-drive").passed
    with pytest.raises(TypeError, match="needs your function control itself"):
        check("test-drive", (0.3, 0.0))


def test_a_mistake_is_known_by_the_first_drive_that_fails(master):
    def of(name, source):
        return f'# %% role="mistake" name="{name}" says="{name}!"\n{source}'

    first, stands = of("it drives the same way", BLIND), of("it stands", BLIND.replace("0.3", "0"))
    second = of("it comes too near", LATE)
    (declared,) = read_exercises(master(mistake=first, **{"second mistake": f"{stands}\n\n{second}"}))
    late = run_cases(declared, control_in(LATE))
    assert late.mistake.says == "it comes too near!" and "    it comes too near!\n" in repr(late)
    assert validate_exercise(declared) == []
    assert run_cases(declared, control_in(RIGHT)).mistake is None


def test_the_table_has_metrics_thresholds_and_points(data):
    lines = [re.sub(r" +", " ", line).strip() for line in repr(checked(data, LATE)).splitlines()]
    assert lines[1:5] == [
        "scenario bumps clearance reach points",
        "✗ near 0 (≤ 0) 0.10 m (≥ 0.25 m)* 0.90 m (≥ 0.50 m) 0 of 2",
        "✗ far 0 (≤ 0) 0.08 m (≥ 0.25 m)* 1.32 m (≥ 0.50 m) 0 of 1",
        "✗ nearest 0 (≤ 0) 0.09 m (≥ 0.25 m)* 0.81 m (≥ 0.50 m) 0 of 1",
    ]


def test_the_page_shows_each_map_and_what_the_camera_saw_before(data):
    page = checked(data, BLIND)._repr_html_()
    captions = re.findall("<figcaption>(.*?)</figcaption>", page)
    assert captions == ["near", "far", "nearest", "1.5 s before", "1.0 s before", "0.5 s before", "the bump"]
    alts = re.findall('alt="(.*?)"', page)
    assert alts[0].startswith("The room from above: the path begins at x 0.0 m, y 0.0 m and ends at x 1.0 m")
    assert alts[3] == "What the camera of the robot sees 1.5 s before the bump"
    assert page.count("data:image/webp;base64,") == 7 and page.count('<th scope="col"') == 5
    assert page == checked(data, BLIND)._repr_html_()


def test_the_page_of_a_right_controller_has_maps_alone(data):
    page = checked(data, RIGHT)._repr_html_()
    assert re.findall("<figcaption>(.*?)</figcaption>", page) == ["near", "far", "nearest"]


def test_a_drive_that_ended_early_has_no_images_before(data):
    page = checked(data, "def control(observation, memory):\n    return None\n")._repr_html_()
    assert page.count("<figcaption>") == 3


def test_a_repeated_drive_must_take_the_same_path():
    env, scenario = PlaneEnv(()), {"seed": 1, "title": "near", "room": 9, "duration": 6.0, "thresholds": {}}
    drive = Drive(PlaneEnv(()), scenario)
    while not drive.over:
        drive.act((0.3, 0.0))
    record = drive.record()
    assert [image.caption for image in look_back(env, record, scenario)][-1] == "the bump"
    record["actions"][4] = [0.0, 0.0]
    with pytest.raises(ValueError, match="the drive in the scenario 'near' takes another path if repeated"):
        look_back(env, record, scenario)


def test_the_map_of_a_drive_that_passes_has_no_ring():
    record = {"path": [[0, 0, 0], [1, 0, 0]], "bumps": [], "ended": "", "missed": [], "decisive": 0}
    maps = [draw_map(record | {"missed": missed}, {"title": "near"}) for missed in ([], [["bumps"]])]
    values = [np.unique(Image.open(io.BytesIO(drawn.png)).convert("L")).tolist() for drawn in maps]
    assert len(values[0]) == 1 and len(values[1]) > 1


def test_an_error_of_the_environment_is_not_the_learners(data):
    (call,) = data.cases[0].calls
    scenario = call.arguments[0] | {"start": ["left"]}
    with pytest.raises(ValueError, match="not enough values to unpack"):
        drive_scenarios(data, [scenario], lambda: control_in(RIGHT))
    assert checked(data, RIGHT).passed
