"""Graded drives: what ends them, whose fault it is, what attacks gain, and the scenarios of a key."""

import time
from dataclasses import replace

import pytest
from attacks import SHORT
from drive_attacks import DRIVE_ATTACKS
from drive_runs import GOOD, HIDDEN, MASTERS, PUBLIC, on_the_plane, run_drives
from nbclassroom.autograder.answer_key import load_key
from nbclassroom.autograder.make_answer_key import make_key
from nbclassroom.autograder.outcomes import BUDGET_MESSAGE
from nbclassroom.autograder.pool import autograde
from nbclassroom.autograder.sandbox.bubblewrap import Limits
from nbclassroom.autograder.sandbox.fork_server_client import KernelFactory
from nbclassroom.exercises.declaration import MasterError
from nbclassroom.exercises.kinds.drive.draw_scenarios import MARGIN, with_margin
from nbclassroom.exercises.kinds.drive.drive import LARGE, SLOW
from nbclassroom.exercises.kinds.drive.kind import scenario_of

pytestmark = pytest.mark.sandbox
ATTACKED = tuple(replace(case, calls=8) for case in (PUBLIC, HIDDEN))  # a second of processor time
BESIDE = """
import os, time
def control(observation, memory):
    for _ in range(2 * (observation["time"] == 0)):
        if os.fork() == 0:
            while time.process_time() < 1: pass
            os._exit(0)
        os.wait()
    return 0.0, 0.0
"""


@pytest.fixture(scope="module")
def factory():
    with KernelFactory(limits=SHORT) as kernels:
        yield kernels


@pytest.fixture
def drive(factory):
    """Runs a controller on the plane; its GradedExercise."""

    def driven(source, **options):
        with on_the_plane():
            return run_drives(factory, source, **options)[1]

    return driven


def looks_at(expression):
    """A controller that shows what it sees in its second step."""
    return (
        "def control(observation, memory):\n    if observation['time'] == 0:\n"
        "        memory['seen'] = 'memory'\n        return 0.25, 0.0\n"
        f"    raise ValueError({expression})"
    )


# ---------------------------------------------------------------- honest drives


def test_a_good_controller_gets_its_points_and_its_metrics(drive):
    exercise = drive(GOOD)
    assert exercise.points == 5
    assert [case.message for case in exercise.cases] == ["bumps 0, clearance 0.80 m, reach 1.00 m"] * 2
    assert "ends at x 1.0 m, y 0.0 m" in exercise.body


def test_a_controller_that_misses_a_threshold_gets_nothing_and_a_sentence(drive):
    exercise = drive("def control(observation, memory):\n    return 0.1, 0.0")
    assert exercise.points == 0
    assert {case.message for case in exercise.cases} == {
        "The robot got 0.40 m away from its start; the task asks for at least 0.80 m."
        " The robot never drove faster than 0.10 m/s; it can drive with 0.3 m/s"
        " (bumps 0, clearance 1.40 m, reach 0.40 m)"
    }


def test_a_controller_sees_exactly_what_the_sensors_see(drive):
    seen = "str([str(observation[n].dtype) + str(observation[n].shape) for n in ('scan', 'odometry')])"
    seen += "+ str(observation['scan'][0]) + str(observation['odometry']) + repr(observation['time'])"
    (case,) = drive(looks_at(seen), cases=(PUBLIC,), sensors=("scan", "odometry")).cases
    assert "['float32(360,)', 'float64(3,)']1.975[0.025 0.    0.   ]0.1 (line 5" in case.message
    far = {"start": [0.0, 0.0, 3.0]}
    (case,) = drive(
        looks_at("str(observation['scan'][0]) + memory['seen']"), cases=(PUBLIC,), scenario=far
    ).cases
    assert case.message.startswith("ValueError: infmemory (line 5")


def test_what_ends_a_drive_is_one_sentence_with_line_and_time(drive):
    exercise = drive(
        "def control(o, m):\n    if o['time'] > 1:\n        raise ValueError('oh')\n    return 0.1, 0.0"
    )
    messages = [case.message for case in exercise.cases]
    assert messages == [
        "ValueError: oh (line 3: raise ValueError('oh')), 1.1 s after the start",
        "ValueError",  # a text could carry out what the controller saw
    ]
    public, hidden = drive("def control(o, m):\n    return 'fast', 0").cases
    assert public.message == (
        "The drive ended after 0.0 s: control returned ('fast', 0): expected two numbers, (linear, angular)."
    )
    assert hidden.message == "it returned something else than two numbers"
    public, _ = drive("def control(o, m):\n    while True: pass").cases
    assert public.outcome == "time"
    assert public.message == "one step took more than 0.5 s of processor time, 0.0 s after the start"


@pytest.mark.parametrize(
    ("line", "outcome", "public", "hidden"),
    [
        ("time.sleep(0.08)", "time", f"control() {SLOW}, 1.9 s after the start", BUDGET_MESSAGE),
        ("m[o['time']] = np.ones(10**8, 'u1')", "memory", f"MemoryError: control() {LARGE}", "MemoryError"),
        ("time.sleep(600)", "time", "it did not finish in time, 0.0 s after the start", BUDGET_MESSAGE),
    ],
)
def test_a_controller_that_costs_too_much_ends_early_as_in_check(line, outcome, public, hidden):
    source = f"import time\ndef control(o, m):\n    {line}\n    return 0.25, 0.0"
    grace = 1.0 if "600" in line else 30.0  # a busy machine can halt any process for some seconds
    with KernelFactory(limits=Limits(wall_factor=1, wall_grace=grace)) as factory, on_the_plane():
        _, exercise = run_drives(factory, source, scenario={"duration": 4000.0})
    assert [(case.outcome, case.message) for case in exercise.cases] == [(outcome, public), (outcome, hidden)]


def test_a_stub_and_an_answer_without_the_function(drive):
    stub = drive("def control(o, m):\n    raise NotImplementedError")
    assert {case.outcome.value for case in stub.cases} == {"not attempted"}
    missing = drive("x = 1")
    assert {case.outcome.value for case in missing.cases} == {"missing"}


# ---------------------------------------------------------------- whose time, and whose fault


def test_the_time_of_the_robot_is_not_the_time_of_the_controller():
    limits = Limits(wall_factor=0, wall_grace=3.0)  # a drive takes 4 s
    with KernelFactory(limits=limits) as factory, on_the_plane("drive_runs:SlowEnv"):
        before = time.monotonic() + 1000
        exercise_run, exercise = run_drives(factory, GOOD, cases=(PUBLIC,))
    assert exercise.points == 2
    assert exercise_run.stop_at > before + 4 - 1


def test_what_fails_in_the_environment_is_no_fault_of_the_learner(factory):
    with on_the_plane("drive_runs:BrokenEnv"), pytest.raises(ValueError, match="the plane is broken"):
        run_drives(factory, GOOD)


# ---------------------------------------------------------------- attacks


@pytest.mark.parametrize("attack", DRIVE_ATTACKS, ids=[attack.name for attack in DRIVE_ATTACKS])
def test_an_attack_gains_nothing_sees_nothing_and_leaves_the_next_drive_alone(attack, drive):
    exercise = drive(attack.source, cases=ATTACKED)
    public, hidden = exercise.cases
    assert exercise.points == 0
    assert {case.outcome.value for case in exercise.cases} <= attack.outcomes
    assert attack.seen in public.message
    assert not [secret for secret in attack.secrets if secret in public.message]
    assert "seen" not in hidden.message
    assert drive(GOOD).points == 5


def test_all_processes_of_a_step_share_its_time(drive):
    assert {case.outcome.value for case in drive(BESIDE).cases} == {"time"}


def test_each_drive_has_a_kernel_of_its_own(drive):
    """Where the wall is far, this controller drives only if it has driven before."""
    waits = "SEEN = []\ndef control(observation, memory):\n"
    waits += "    memory.setdefault('waits', observation['scan'][0] > 2.2 and not SEEN)\n    SEEN.append(1)\n"
    waits += "    return (0.0 if memory['waits'] else 0.25), 0.0"
    assert drive(waits, hidden={"start": [-0.5, 0.0, 0.0]}).points == 2


def test_nothing_is_left_for_the_next_drive(drive):
    leaves = "open('/tmp/left', 'w').close()\n" + GOOD
    assert drive(leaves).points == 5
    looks = f"import os\nassert not os.path.exists('/tmp/left')\n{GOOD}\n" + GOOD
    assert drive(looks).points == 5 and drive(looks).message == ""


# ---------------------------------------------------------------- the scenarios of a key

MASTER = """# ---
# jupyter:
#   imgproc_course:
#     title: Plane
# ---

# %% [markdown]
# # Plane

# %%
from imgproc_course.exercises import check

# %% role="exercise"
exercise(
    "plane-drive", function="control", subject="drive", sensors=("scan",),
    hints=("What?", "How?", "The code."), explanation="Because.", another_way="Otherwise.",
)

# %% role="answer"
def control(observation, memory):
    return {stub}

# %% role="solution"
def control(observation, memory):
    return (0.25 if observation["scan"][0] > 0.6 else 0.0), 0.0

# %% role="check"
check("plane-drive", control)

# %% role="case" title="a wall" points=1 hint="Look."
def inputs(rng):
    return ({public},)

# %% role="hidden" title="another wall" points=2 hint="Look."
def inputs(rng):
    return ({hidden},)
"""
MISTAKE = """# %% [markdown]
# # plane-drive

# %% role="mistake" name="it comes too near" says="Look ahead."
def control(observation, memory):
    return 0.25, 0.0
"""
THRESHOLDS = '"thresholds": {"bumps": ["<=", 0], "reach": [">=", 0.5]}'
DRAWN = f'{{"seed": 1, "room": int(rng.integers(5, 30)), "duration": 8.0, {THRESHOLDS}}}'
FIXED = f'{{"seed": 1, "room": 30, "duration": 8.0, {THRESHOLDS}}}'


@pytest.fixture
def key_of(tmp_path):
    """Makes a key of a lesson with these sources of scenarios, on the plane."""

    def made(*, public=FIXED, hidden=DRAWN, stub="0.0, 0.0", seed="seed", **options):
        masters = tmp_path / "masters"
        masters.mkdir(exist_ok=True)
        source = MASTER.replace("{public}", public).replace("{hidden}", hidden).replace("{stub}", stub)
        (masters / "10_plane.py").write_text(source, encoding="utf-8")
        (masters / "10_plane.mistakes.py").write_text(MISTAKE, encoding="utf-8")
        with on_the_plane():
            return make_key(masters, seed, tmp_path / "key", replace=True, **options)

    return made


# The fourth draw of b: in the third one, a repeated drive passes.
@pytest.mark.parametrize(("seed", "fits"), [("a", 19), ("b", 16)])
def test_a_hidden_scenario_is_drawn_until_the_solution_passes_and_no_repeated_drive(key_of, seed, fits):
    key = key_of(seed=seed)
    public_wall, wall = (scenario_of(case)["room"] for case in key.exercise("plane-drive").cases)
    # The solution stops 0.6 m before a wall: one less than 1.2 m away leaves it no margin to 0.5 m.
    assert wall == fits
    assert public_wall == 30  # the blind one passes
    assert key.exercise("plane-drive").mistakes[0].results == {}


def test_the_margin_makes_each_threshold_stricter():
    thresholds = {"bumps": ["<=", 0], "ball_gap": ["<=", 0.5], "reach": [">=", 2.0]}
    stricter = with_margin({"seed": 1, "thresholds": thresholds})["thresholds"]
    assert MARGIN == 0.2
    assert stricter == {"bumps": ["<=", 0], "ball_gap": ["<=", 0.4], "reach": [">=", 2.4]}


def test_a_key_names_the_case_that_no_draw_fits(key_of):
    with pytest.raises(MasterError) as error:
        key_of(hidden=FIXED)
    assert "10_plane.py, line 34: hidden-plane-drive-1: none of 20 drawn scenarios fits" in str(error.value)
    assert "in a public scenario, repeated without looking, passes. Change inputs(rng)" in str(error.value)
    with pytest.raises(MasterError, match=r"none of 20 drawn .*the stub passes\. Change"):
        key_of(hidden=FIXED.replace("30", "16"), stub='(observation["scan"][0] > 0.6) / 4, 0.0')
    with pytest.raises(MasterError, match=r"plane-drive: the stub: control\(\) takes longer than"):
        key_of(stub="__import__('time').sleep(0.08) or 0.0, 0.0")
    near = DRAWN.replace("5, 30", "4, 9")
    with pytest.raises(
        MasterError,
        match=r"none of 20 drawn .*the solution does not pass with a margin of 20%: .*away from its start",
    ):
        key_of(hidden=near)


def test_a_key_knows_how_long_each_drive_is(key_of):
    exercise = key_of().exercise("plane-drive")
    assert exercise.kind.simulated_seconds(exercise) == 16.0


# ---------------------------------------------------------------- nbval, and the room


@pytest.fixture(scope="module")
def room_key(tmp_path_factory):
    return make_key(MASTERS, 8_675_309, tmp_path_factory.mktemp("key") / "key")


def test_nbval_grades_drives_through_the_room(room_key):
    answers = {
        "good": "def control(o, m):\n    return 0.25, 0.0",
        "slow": "def control(o, m):\n    return 0.1, 0.0",
        "ends": "import os\ndef control(o, m):\n    os._exit(0)",
    }
    submissions = [(name, "driven", {"driven-control": source}) for name, source in answers.items()]
    results = {result.name: result.exercises[0] for result in autograde(submissions, room_key, workers=1)}
    assert {name: exercise.points for name, exercise in results.items()} == {"good": 5, "slow": 0, "ends": 0}
    assert results["slow"].mistake == "it is slow"
    assert [case.outcome.value for case in results["ends"].cases] == ["crashed"] * 3


def test_an_environment_that_fails_leaves_the_drive_to_the_teacher(room_key):
    file = room_key.path / "checks/driven.json"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace('["room",null]', '["room","none"]'), encoding="utf-8")
    (result,) = autograde([("one", "driven", {"driven-control": GOOD})], load_key(room_key.path), workers=1)
    file.write_text(text, encoding="utf-8")
    assert {case.outcome.value for case in result.exercises[0].cases} == {"not graded"}
    public, hidden, _ = result.exercises[0].cases
    assert "got 'none'" in public.message and "none" not in hidden.message
