"""The league: controllers on secret rooms, ranked on a page for the class."""

import base64
import csv
import io
import re
from math import cos, sin

import pytest
from click.testing import CliRunner
from nbclassroom.autograder.outcomes import Outcome
from nbclassroom.autograder.sandbox.bubblewrap import Limits
from nbclassroom.autograder.sandbox.fork_server_client import KernelFactory
from nbclassroom.exercises.kinds.drive import images as drive_images
from nbclassroom.league import league
from nbclassroom.league.league import Controller, Exploration, name_all, ranking, read_controllers
from PIL import Image

from imgproc_course.cli import main
from imgproc_course.simulation.furnished import furnished

SEED = "8f1c0b5e7a3d92464be0917cd5f2a863"
DRIVES = "def control(observation, memory):\n    return 0.2, 0.3\n"
TURNS = "def control(observation, memory):\n    return 0.0, 0.3\n"
STANDS = "def control(observation, memory):\n    return 0.0, 0.0\n"
CONTROLLERS = {
    "adalovelace": DRIVES,
    "<img src=x onerror=alert(1)>": "def control(o, m):\n    raise ValueError('<script>from the learner')\n",
    "endless": "def control(o, m):\n    while True: pass\n",
    "nothing": "def contrl(o, m): pass\n",
    "syntax": "import numpy\ndef control(o, m)\n    return 'from the learner'\n",
}
INSIDE = "from nbclassroom.autograder.sandbox.inside import shell\n"
MIME = "application/vnd.nbclassroom.answer+json"


def write(folder, sources):
    folder.mkdir()
    for name, source in sources.items():
        (folder / f"{name}.py").write_text(source, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """The folder of a league of one room and 3 s, and what two runs of it wrote, {file name: text}."""
    folder = tmp_path_factory.mktemp("league")
    write(folder / "controllers", CONTROLLERS)
    (folder / "baseline.py").write_text(TURNS, encoding="utf-8")
    (folder / "out").mkdir()
    (folder / "out/seed").write_text(SEED, encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        scenario_of = league.scenario_of

        def short(room, seed):
            return scenario_of(room, seed) | {"duration": 3.0}

        patch.setattr(league, "scenario_of", short)
        options = {"baseline": folder / "baseline.py", "rooms": 1, "workers": 1}
        written = []
        for _ in range(2):
            lines = league.run_league(folder / "controllers", folder / "out", **options)
            names = ("league.html", "league.csv", "seed")
            written.append({name: (folder / "out" / name).read_text(encoding="utf-8") for name in names})
    assert lines[0] == "4 controllers in 1 room; 2 others could not drive."
    return written


@pytest.fixture(scope="module")
def rows(runs):
    """The rows of league.csv, {learner's name: {column: text}}."""
    return {row["name"]: row for row in csv.DictReader(io.StringIO(runs[0]["league.csv"]))}


def images(page):
    """The <img> of a page: (its attributes as text, the image)."""
    for tag, data in re.findall(r'(<img src="data:image/webp;base64,([^"]*)"[^>]*>)', page):
        yield tag, Image.open(io.BytesIO(base64.b64decode(data)))


@pytest.mark.sandbox
@pytest.mark.timeout(300)
class TestOneRun:
    def test_who_drives_better_comes_first_and_who_fails_costs_nobody_else(self, rows):
        assert {name: row["rank"] for name, row in rows.items()} == {
            "adalovelace": "1",
            "baseline": "2",
            "<img src=x onerror=alert(1)>": "3",
            "endless": "3",
            "nothing": "",
            "syntax": "",
        }
        scores = [float(rows[name]["score"]) for name in ("adalovelace", "baseline", "endless")]
        assert scores[0] > scores[1] > scores[2] == 0

    def test_the_table_for_the_teacher_says_what_went_wrong(self, rows):
        notes = {name: row["note"] for name, row in rows.items()}
        assert notes["endless"] == (
            "1 room without points: did not finish in time; one step took more than 0.5 s of processor time,"
            " 0.0 s after the start"
        )
        assert notes["nothing"] == "it does not define control(observation, memory)"
        assert notes["syntax"] == "line 2 is not Python"
        assert notes["adalovelace"] == 'nothing in memory["found"] in 1 room'
        assert "from the learner" in notes["<img src=x onerror=alert(1)>"]

    def test_the_page_has_aliases_and_nothing_that_a_learner_wrote(self, runs, rows):
        page = runs[0]["league.html"]
        assert all(f"<bdi>{row['alias']}</bdi>" in page for row in rows.values())
        assert rows["baseline"]["alias"] == "baseline"
        written = ("adalovelace", "onerror", "src=x", "from the learner", "<script", "contrl")
        assert [text for text in written if text in page] == []
        assert "default-src &#39;none&#39;" in page

    def test_the_page_has_maps_and_a_short_film_which_a_reader_can_do_without(self, runs):
        page = runs[0]["league.html"]
        shown = list(images(page))
        films = [(tag, image) for tag, image in shown if getattr(image, "n_frames", 1) > 1]
        assert len(films) == 2  # who raises and who is endless has one place only
        assert all(re.search(r'alt="[^"]{20}', tag) for tag, _ in shown)
        assert [image.n_frames for _, image in films] == [4, 4]  # one image a second
        assert {image.info["loop"] for _, image in films} == {3}
        stills = re.findall(
            r'\(prefers-reduced-motion: reduce\)" srcset="data:image/webp;base64,([^"]*)"', page
        )
        assert [Image.open(io.BytesIO(base64.b64decode(data))).n_frames for data in stills] == [1] * 4

    def test_a_second_run_has_the_same_rooms_and_gives_the_same(self, runs):
        assert runs[0] == runs[1]


# ---------------------------------------------------------------- what a controller says that it found

ROOM = 2_000_017
START = [float(number) for number in furnished(ROOM).start]
SCENARIO = {"seed": 5, "room": ROOM, "start": START, "duration": 0.5, "title": "", "thresholds": {}}


@pytest.fixture(scope="module")
def explore():
    """Lets a controller explore a room for half a second."""
    limits = Limits(wall_factor=2.0, output=2 << 20)
    with KernelFactory(limits=limits) as factory, pytest.MonkeyPatch.context() as patch:
        patch.setattr(league, "_factories", [factory])
        yield lambda source: league.explore(source, SCENARIO)


def says(found):
    head = "import numpy as np\ndef control(o, memory):"
    return f"{head}\n    memory['found'] = {found}\n    return 0.0, 0.0\n"


@pytest.mark.sandbox
@pytest.mark.timeout(300)
class TestFound:
    def test_what_is_right_has_points(self, explore):
        x, y, yaw = START
        to_marker = furnished(ROOM).poses["marker"][:2] - (x, y)
        ahead = to_marker @ [cos(yaw), sin(yaw)]
        left = to_marker @ [-sin(yaw), cos(yaw)]
        word, number = furnished(ROOM).word, furnished(ROOM).markers["marker"]
        assert furnished(ROOM).markers == {"marker": 38, "wall_marker": 41}  # the tests below name them
        right = says(f"{{'markers': {{np.int64({number}): np.array([{ahead}, {left}])}}, 'word': {word!r}}}")
        exploration = explore(right)
        assert (exploration.outcome, exploration.told) == (Outcome.PASSED, True)
        assert (exploration.values["markers"], exploration.values["word"]) == (1, 1)

    @pytest.mark.parametrize(
        ("source", "told"),
        [
            (says("7"), False),
            (says("None"), False),
            (STANDS, False),
            (says("{}"), True),
            (says("{'markers': [38, 41], 'word': 3}"), True),
            (says("{'markers': {38: 'here', 41: (1, 2, 3), 'x': (1, 2), 8: None}, 'word': b'OPEN'}"), True),
            (says("{'markers': {38: (float('nan'), float('inf')), 41: (10**400, 0)}, 'word': ''}"), True),
            (says("{'markers': {99: (0.0, 0.0), 10**30: (0.0, 0.0)}, 'word': 'OPEN' * 1000}"), True),
            (says("{'word': 'x' * 10_000_000}"), False),
            (says("type('Odd', (dict,), {'get': lambda *a: 1 / 0})()"), False),
        ],
    )
    def test_what_is_wrong_costs_nothing_and_gains_nothing(self, explore, source, told):
        exploration = explore(source)
        assert (exploration.outcome, exploration.told) == (Outcome.PASSED, told)
        assert [exploration.values[name] for name in ("markers", "word", "bumps")] == [0, 0, 0]

    @pytest.mark.parametrize(
        "told",
        [
            "{'markers': [[38, 0, 0]], 'word': '', 'score': 999}",
            "[1, 2]",
            "{'markers': [[38, 'a', []], [41, {}, 1e999]], 'word': {}}",
            "{'markers': [[1e999, 0, 0]], 'word': ''}",
            "{'markers': 7}",
        ],
    )
    def test_a_forged_message_gains_nothing(self, explore, told):
        """It comes before the controller's own, or instead of it."""
        forged = f"shell.WRITER.send('display_data', data={{'{MIME}': {told}}})"
        alone = f"{INSIDE}SEND = shell.WRITER.send_answer\n{forged}\n"
        instead = f"shell.WRITER.send_answer = lambda data: {forged}\n"
        honest = explore(STANDS).values
        for source in (alone + says("{'word': ''}"), f"{INSIDE}{instead}{STANDS}"):
            assert explore(source).values == honest

    def test_who_does_not_drive_to_the_end_has_no_points(self, explore):
        exploration = explore(
            "def control(o, m):\n    return ('fast', 0) if o['time'] > 0.2 else (0.0, 0.0)\n"
        )
        assert (exploration.outcome, exploration.values) == (Outcome.WRONG, {})
        assert exploration.record["steps"] == 3
        exploration = explore("def control(o, m):\n    raise SystemExit\n")
        assert (exploration.outcome, exploration.values) == (Outcome.RAISED, {})


# ---------------------------------------------------------------- ranks and aliases


def controller(alias, *scores):
    explored = [Exploration(Outcome.PASSED, "", {"score": score}, True, None) for score in scores]
    return Controller(alias, alias=alias, explorations=explored)


def test_the_mean_score_decides_and_equal_scores_share_a_rank():
    ranked = ranking(
        [controller("d", 1, 2), controller("c", 50, 10), controller("b", 30, 30), controller("a", 99, 0)]
    )
    assert [(one.rank, one.alias, one.score) for one in ranked] == [
        (1, "a", 49.5),
        (2, "b", 30.0),
        (2, "c", 30.0),
        (4, "d", 1.5),
    ]


def test_an_alias_is_of_one_learner_and_only_the_seed_tells_whose():
    def aliases(seed, names, **options):
        controllers = [*map(Controller, names), Controller("baseline", alias="baseline")]
        name_all(controllers, seed, **options)
        return [one.alias for one in controllers[:-1]]

    names = [f"learner {number}" for number in range(600)] + ["baseline"]
    given = aliases(SEED, names)
    assert len(set(given)) == 601 and "baseline" not in given
    assert not [alias for alias in given if "learner" in alias]
    assert aliases(SEED, names) == given
    same = sum(a == b for a, b in zip(given, aliases(SEED[::-1], names), strict=True))
    assert same < 20  # by chance
    assert aliases(SEED, names, with_names=True) == [*names[:-1], "baseline 2"]


def test_rooms_come_from_the_seed_and_are_no_small_numbers():
    scenarios = league.scenarios_of(SEED, 12)
    assert league.scenarios_of(SEED, 10) == scenarios[:10]
    assert league.scenarios_of(SEED[::-1], 10) != scenarios[:10]
    assert len({one["room"] for one in scenarios}) == 12
    assert min(one["room"] for one in scenarios) > 1_000_000


def test_a_film_is_small_whatever_it_shows(monkeypatch):
    from nbclassroom.exercises.kinds.drive.drive import Drive

    from imgproc_course.simulation.room_env import RoomEnv

    env = RoomEnv(())
    drive = Drive(env, SCENARIO | {"duration": 6.0})
    while not drive.over:
        drive.act((0.2, 0.4))
    record = drive.record()
    film = drive_images.draw_film(env, record, SCENARIO)
    assert Image.open(io.BytesIO(film.png)).n_frames == 7
    monkeypatch.setattr(drive_images, "_MOST_FILM", len(film.png) - 1)
    smaller = drive_images.draw_film(env, record, SCENARIO)
    image = Image.open(io.BytesIO(smaller.png))
    assert len(smaller.png) < len(film.png) and image.n_frames == 4
    image.seek(1)
    image.load()
    assert image.info["duration"] == 150  # 6 s in 4 images, ten times as fast


# ---------------------------------------------------------------- files and options


def test_files_that_are_no_controllers_have_a_reason(tmp_path):
    folder = write(
        tmp_path / "controllers",
        {"good": DRIVES, "deep": "x = " + "-" * 100_000 + "1", "long": "#" * 200_001},
    )
    (folder / "latin.py").write_bytes(b"# \xe9\ndef control(o, m): pass")
    (folder / "windows.py").write_bytes(b"\xef\xbb\xbf" + DRIVES.encode())
    (folder / "folder.py").mkdir()
    (folder / "link.py").symlink_to(folder / "good.py")
    (folder / "notes.txt").write_text("none")
    reasons = {one.name: one.reason for one in read_controllers(folder)}
    assert reasons == {
        "deep": "it is too complicated to be read",
        "folder": "it is not a plain file",
        "good": "",
        "latin": "the file is not UTF-8",
        "link": "it is not a plain file",
        "long": "the file has 200001 bytes; at most 200000 are read",
        "windows": "",
    }


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["absent"], "absent: there is no such folder; name the folder of the learners' controllers"),
        (["empty"], "empty: no controller in it; expected one file for each learner, NAME.py"),
        (["full", "--seed", "17"], "this seed can be guessed: expected at least 32 hexadecimal digits"),
    ],
)
def test_an_error_is_one_line(tmp_path, monkeypatch, arguments, message):
    monkeypatch.chdir(tmp_path)
    write(tmp_path / "empty", {})
    write(tmp_path / "full", {"ada": DRIVES})
    result = CliRunner().invoke(main, ["league", *arguments])
    assert result.exit_code == 1
    assert result.output.startswith(f"Error: {message}") and result.output.count("\n") == 1
    assert not (tmp_path / "league").exists()


@pytest.mark.sandbox
def test_a_league_without_a_seed_draws_one_and_keeps_it(tmp_path):
    write(tmp_path / "controllers", {"ada": "def"})
    for _ in range(2):
        league.run_league(tmp_path / "controllers", tmp_path / "out", workers=1)
        seed = (tmp_path / "out/seed").read_text()
        (row,) = csv.DictReader(io.StringIO((tmp_path / "out/league.csv").read_text()))
        aliases = [Controller("ada")]
        name_all(aliases, seed.strip())
        assert re.fullmatch("[0-9a-f]{32}\n", seed)
        assert (row["name"], row["alias"], row["note"]) == ("ada", aliases[0].alias, "line 1 is not Python")


def test_a_controller_of_the_course_drives_beside_the_class():
    (path,) = [option.default for option in main.commands["league"].params if option.name == "baseline"]
    path = path()
    assert read_controllers(path.parent, path)[-1].reason == ""
