"""The league: a class's controllers explore secret rooms, and a page for the class ranks them.

In a drive the robot and its score are in a process of the league, the controller in a kernel of the sandbox,
as in grading. Anybody may have forged what it says that it found: it is only compared.

The folder of the league holds

    league.html   the page: aliases instead of names, and nothing that a learner wrote
    league.csv    for the teacher: whose alias it is, and what went wrong
    seed          from which rooms and aliases are drawn: with it, the next league has the same
"""

import ast
import atexit
import hmac
import itertools
import os
import signal
import statistics
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field
from functools import cached_property
from multiprocessing import get_context
from pathlib import Path
from types import SimpleNamespace

from tqdm import tqdm

from nbclassroom import course
from nbclassroom.autograder.answer_key import secret_seed
from nbclassroom.autograder.nbval_plugin import MAX_ANSWER, ExerciseRun, PageKernels
from nbclassroom.autograder.outcomes import PHRASES, Outcome
from nbclassroom.autograder.results import checked_exercise
from nbclassroom.autograder.sandbox import bubblewrap
from nbclassroom.autograder.sandbox.fork_server_client import KernelFactory
from nbclassroom.autograder.sandbox.inside import confine
from nbclassroom.autograder.sanitize import spreadsheet_text
from nbclassroom.autograder.verdict import CaseRun
from nbclassroom.exercises.cell_syntax import UNPARSABLE, bound_names
from nbclassroom.exercises.kinds.drive.drive import SENSORS, environment
from nbclassroom.exercises.kinds.drive.images import draw_film, draw_map
from nbclassroom.exercises.lesson import Case, Exercise, ExpectedCall
from nbclassroom.exercises.page import page_of
from nbclassroom.gradebook.csv_table import csv_text
from nbclassroom.gradebook.report import count_of, render_page
from nbclassroom.gradebook.result_store import open_grades_folder, write_grades_file

FUNCTION = "control"
_CHECK = f"from nbclassroom.autograder.sandbox.inside.drive_cell import explore\n\nexplore({FUNCTION})"
_factories: list[KernelFactory] = []  # this process's KernelFactory
_COLOURS = "amber black blue brown copper coral cyan golden green grey olive orange purple red silver white"
_ANIMALS = "badger bear beaver cat crane deer eagle falcon fox goat hare heron lion lynx mole moose newt"
_ANIMALS += " otter owl panda pike puma raven robin salmon seal sloth stork swan tiger toad wolf"
_COLUMNS = ("rank", "alias", "name", "score", "coverage", "markers", "words", "bumps", "scores", "note")
_SUMS = ("markers", "word", "bumps")


@dataclass
class Controller:
    """A learner's controller; `best` and `worst` are (number of a room, its map, its film or None)."""

    name: str
    source: str = ""
    reason: str = ""
    alias: str = ""
    explorations: list = field(default_factory=list)
    rank: int = 0
    best: tuple = ()
    worst: tuple = ()

    @property
    def scores(self):
        return [drive.values.get("score", 0) for drive in self.explorations]

    @cached_property
    def score(self):
        """The mean of its scores, 0 to 140 or so."""
        return round(statistics.fmean(self.scores), 1)

    @cached_property
    def coverage(self):
        """The mean share of a room that it came to."""
        return statistics.fmean(drive.values.get("coverage", 0.0) for drive in self.explorations)

    @cached_property
    def sums(self):
        """{"markers", "word", "bumps": of all rooms together}."""
        return {name: sum(drive.values.get(name, 0) for drive in self.explorations) for name in _SUMS}

    @cached_property
    def notes(self):
        """Sentences about what went wrong, without a text of the learner's."""
        outcomes = [drive.outcome for drive in self.explorations if not drive.values]
        ends = [(outcomes.count(outcome), PHRASES[outcome]) for outcome in Outcome if outcome in outcomes]
        notes = [f"{count_of(count, 'room')} without points: {label}" for count, label in ends]
        silent = sum(bool(drive.values) and not drive.told for drive in self.explorations)
        return notes + ([f'nothing in memory["found"] in {count_of(silent, "room")}'] if silent else [])


def run_league(folder, out, *, baseline=None, rooms=10, seed=None, names=False, **options):
    """Let the controllers in a folder drive, and write the league's folder; returns lines to print.

    folder    of NAME.py files, one for each learner
    baseline  file of a controller that drives beside them, or None
    rooms     how many
    seed      secret; None: the one stored in `out`, or a new one
    names     show names instead of aliases
    options   workers, None for one per core; unsafe: without a sandbox

    SandboxError and ValueErrors are one line with the remedy.
    """
    out, controllers = Path(out), read_controllers(Path(folder), baseline)
    if seed is not None:  # it may be refused, before a folder is made
        secret_seed(seed, out)
    if not options.get("unsafe"):
        bubblewrap.require_sandbox()
    with open_grades_folder(out):
        seed = secret_seed(seed, out / "seed")
        name_all(controllers, seed, with_names=names)
        driving = [controller for controller in controllers if not controller.reason]
        ranked = _drive_and_draw(driving, scenarios_of(seed, rooms), **options)
        excluded = [controller for controller in controllers if controller.reason]
        page = render_page("league.html", controllers=ranked, excluded=excluded, rooms=rooms)
        write_grades_file(out / "league.html", page)
        write_grades_file(out / "league.csv", league_csv(ranked, excluded))
    drove = f"{count_of(len(driving), 'controller')} in {count_of(rooms, 'room')}"
    return [
        f"{drove}; {count_of(len(excluded), 'other')} could not drive." if excluded else f"{drove}.",
        f"For the class: {out}/league.html   For you, with names: {out}/league.csv",
    ]


def read_controllers(folder, baseline=None):
    """The Controllers in a folder, and the baseline; one that cannot drive has a reason."""
    if not folder.is_dir():
        raise ValueError(f"{folder}: there is no such folder; name the folder of the learners' controllers")
    controllers = [_read(path) for path in sorted(folder.glob("*.py"))]
    if not controllers:
        raise ValueError(f"{folder}: no controller in it; expected one file for each learner, NAME.py")
    return controllers + ([_read(Path(baseline), alias="baseline")] if baseline else [])


def _read(path, **about):
    try:
        return Controller(path.stem, _source_of(path), **about)
    except ValueError as error:
        return Controller(path.stem, reason=str(error), **about)


def _source_of(path):
    """The source in a file; ValueError: why it is not run, without a text of the learner's."""
    if path.is_symlink() or not path.is_file():
        raise ValueError("it is not a plain file")
    if (size := path.stat().st_size) > MAX_ANSWER:
        raise ValueError(f"the file has {size} bytes; at most {MAX_ANSWER} are read")
    try:
        source = path.read_text(encoding="utf-8-sig")
        ast.parse(source)
    except OSError:
        raise ValueError("the file cannot be read") from None
    except UnicodeDecodeError:
        raise ValueError("the file is not UTF-8") from None
    except SyntaxError as error:
        raise ValueError(f"line {error.lineno or 1} is not Python") from None
    except UNPARSABLE:
        raise ValueError("it is too complicated to be read") from None
    if not bound_names(source) & {FUNCTION, "*"}:
        raise ValueError("it does not define control(observation, memory)")
    return source


def name_all(controllers, seed, *, with_names=False):
    """Give each learner the name that the page shows: an alias that only the seed's owner can compute."""
    aliases = {controller.alias for controller in controllers}
    for controller in controllers:
        if controller.alias:  # the baseline
            continue
        number = _secret_number(seed, f"alias of {controller.name}")
        alias = f"{_COLOURS.split()[number % 16]} {_ANIMALS.split()[number // 16 % 32]}"
        alias = controller.name if with_names else alias
        names = itertools.chain([alias], (f"{alias} {number}" for number in itertools.count(2)))
        controller.alias = next(name for name in names if name not in aliases)
        aliases.add(controller.alias)


def scenarios_of(seed, rooms):
    return [
        scenario_of(*(_secret_number(seed, f"{what} {number}") for what in ("room", "drive")))
        for number in range(rooms)
    ]


def _secret_number(seed, about):
    digest = hmac.digest(seed.encode(), about.encode("utf-8", "surrogateescape"), "sha256")
    return int.from_bytes(digest[:4]) >> 1


def _drive_and_draw(controllers, scenarios, *, workers=None, unsafe=False):
    """The controllers in the order of their scores, with their explorations, ranks and images."""
    executor = ProcessPoolExecutor(workers, get_context("spawn"), start_drives, (unsafe,))
    try:
        # One room after another: its images are made once in each process.
        pairs = list(itertools.product(scenarios, controllers))
        futures = [executor.submit(explore, one.source, scenario) for scenario, one in pairs]
        bar = tqdm(futures, desc="driving", unit=" drives", disable=None, leave=False)
        for (_, controller), future in zip(pairs, bar, strict=True):
            controller.explorations.append(future.result())
        ranked = ranking(controllers)
        _draw_all(executor, ranked, scenarios)
    except BrokenProcessPool as error:
        reason = "a process of the league ended, perhaps because memory ran out"
        raise ValueError(f"{reason}; use fewer --workers") from error
    finally:
        executor.shutdown(cancel_futures=True)
    return ranked


def ranking(controllers):
    """The controllers in the order of their scores, those with the same score by their alias; sets ranks."""
    ranked = sorted(controllers, key=lambda one: (-one.score, one.alias))
    for controller in ranked:
        controller.rank = 1 + sum(other.score > controller.score for other in ranked)
    return ranked


def _draw_all(executor, controllers, scenarios):
    """Draw the best and the worst room of each controller, of those in which its robot drove."""
    futures = []
    for controller in controllers:
        numbers = [number for number, drive in enumerate(controller.explorations) if drive.record]
        numbers.sort(key=controller.scores.__getitem__, reverse=True)
        ends = dict.fromkeys(numbers[:1] + numbers[-1:])  # of one room, the best is the worst
        for place, number in zip(("best", "worst"), ends, strict=False):
            arguments = controller.explorations[number].record, scenarios[number]
            future = executor.submit(draw, *arguments, with_film=place == "best")
            futures.append((controller, place, number, future))
    for controller, place, number, future in futures:
        setattr(controller, place, (number, *future.result()))


def league_csv(ranked, excluded):
    """The table for the teacher: names beside aliases, and what went wrong."""
    rows = []
    for entry in ranked:
        scores = " ".join(map(str, entry.scores))
        figures = [entry.score, round(entry.coverage, 3), *entry.sums.values(), scores]
        messages = dict.fromkeys(drive.message for drive in entry.explorations if drive.message)
        rows.append([entry.rank, entry.alias, entry.name, *figures, "; ".join([*entry.notes, *messages])])
    rows += [["", entry.alias, entry.name, *[""] * (len(_COLUMNS) - 4), entry.reason] for entry in excluded]
    return csv_text([_COLUMNS, *(map(spreadsheet_text, row) for row in rows)])


@dataclass(frozen=True)
class Exploration:
    outcome: Outcome  # it passes if the robot drove to the end
    message: str  # why it did not, with texts of the learner's
    values: dict  # what `course.league_score` gives; {} if the robot did not drive to the end
    told: bool  # whether the controller said what it found
    record: dict | None  # of the drive, see `drive.Drive.record`; None if there was none


def scenario_of(room, seed):
    """The scenario of a room's number, with a seed."""
    return course.load(course.league_scenario)(room, seed) | {"title": "", "thresholds": {}}


def start_drives(unsafe):
    """Get this process ready for `explore`; it ends with the one that started it."""
    confine.die_with_parent()
    signal.signal(signal.SIGINT, lambda *_: os._exit(1))  # Ctrl-C: no drive is waited for
    _factories.append(KernelFactory(unsafe=unsafe))
    atexit.register(_factories[0].__exit__)


def explore(source, scenario):
    """The Exploration of a controller, by its source."""
    exercise = Exercise(
        id="league",
        function=FUNCTION,
        subject="drive",
        sensors=SENSORS,
        allowed=(*course.drive_allowed, *course.league_allowed),
        cases=(Case("room", "", 1, "", 0.0, calls=(ExpectedCall((scenario,)),)),),
    )
    page = page_of({exercise.id: source}, SimpleNamespace(exercises=[exercise]))
    exercise_run = ExerciseRun(exercise, PageKernels(page, _factories[0]))
    try:
        run = exercise_run.run(exercise.cases[0], _CHECK)
    finally:
        exercise_run.close()
    is_whole = run.verdict.passed
    found = _found(run) if is_whole else None
    values = course.load(course.league_score)(environment(SENSORS), found) if is_whole else {}
    (case,) = checked_exercise(exercise_run)[0].cases
    record = next((call.record for call in run.verdict.calls), None)
    outcome, message = (Outcome.PASSED, "") if is_whole else (case.outcome, case.message)
    return Exploration(outcome, message, values, found is not None, record)


def draw(record, scenario, *, with_film):
    """(the map of a drive, its film or None) as AnswerImages."""
    film = draw_film(environment(()), record, scenario) if with_film else None
    return draw_map(record, scenario), film


def _found(run: CaseRun) -> dict | None:
    """What a controller says that it found, as `course.league_score` takes it; None if it says nothing."""
    try:
        (told,) = run.told
        return {"markers": {int(number): (x, y) for number, x, y in told["markers"]}, "word": told["word"]}
    except (TypeError, ValueError, LookupError, OverflowError):
        return None
