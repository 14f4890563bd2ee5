"""What an exercise is: its declaration, read from the master that teaches it (docs/teach/masters.md)."""

import ast
import re
from functools import lru_cache
from pathlib import Path

from .. import course
from .kinds import NAMES, kind_of
from .lesson import Case, Exercise, Mistake
from .percent_script import MISTAKES_SUFFIX, ROLES, MasterError, read_script

_ID = re.compile(r"[a-z0-9]+(-[a-z0-9]+)+")


def exercise(
    id: str,
    *,
    function: str = "",
    subject: str = "function",
    sensors: tuple[str, ...] = (),
    title: str = "",
    time_limit: float = 5.0,
    allowed: tuple[str, ...] = (),
    tolerance: float = 0.0,
    exact_type: bool = False,
    practice: bool = False,
    hint: str = "",
    border_hint: str = "",
    hints: tuple[str, ...] = (),
    explanation: str = "",
    another_way: str = "",
    points: int = 0,
    rubric: tuple[tuple[str, int], ...] = (),
) -> dict:
    """Declare an exercise, in a master's `role="exercise"` cell.

    The arguments are literals: they are read without running anything. The rest of that cell (imports,
    functions that make inputs) runs before each case and each mistake. Neither the learner nor the learner's
    code sees it.

    Parameters
    ----------
    id : str, `<lesson>-<what>`, lower case: "grayscale-luma"
    title : str, the exercise's name in reports; its id if omitted
    function : str, the name of the function or of the class that the learner writes
    subject : str, what the answer is: "function", or "node", the class of a ROS 2 node, which is driven as
        each case says with its arguments (part, steps), see `node.feed`, or "package", a function that
        returns the files of a ROS 2 package, see `package.feed`, or "drive", a function
        control(observation, memory) that returns two speeds; each case gives one scenario, see `drive`, or
        "written": text, or a figure, which a person grades; it has no function and no case
    sensors : tuple of str, what `control` observes: some of `drive.SENSORS`
    time_limit : float, seconds, for one call of the function; for that of a controller, see `drive`
    allowed : tuple of str, modules that the answer may use beside NumPy and the standard library ("scipy",
        or a package of the course). A node may use those of `course.node_modules()`, too. matplotlib,
        IPython.display and what the course always allows are there for looking
    tolerance : float >= 0, absolute, in the unit of the answer, for every case that declares none
    exact_type : bool, a right value in another type is wrong: the task says so to the learner. Otherwise
        `comparison` says which types stand for another one
    practice : bool, checked but not graded
    hint : str, shown if a case that fails has no hint of its own
    border_hint : str, shown instead if only values on the border of an image are wrong
    hints : tuple of str, the steps of `hint(id)`, from a question to nearly the code
    explanation : str, what `solution(id)` says below the code: why it is written in this way
    another_way : str, one sentence: how a right answer could be written differently
    points : int > 0, of a written answer
    rubric : tuple of (text, points), of a written answer: what to look for. A line with points < 0 takes
        them away; those with points > 0 give `points` or more

    Returns
    -------
    dict of the arguments, checked

    Raises
    ------
    MasterError : an argument of the wrong kind
    """
    declared = dict(locals())
    if not isinstance(id, str) or not _ID.fullmatch(id):
        expected = "expected <lesson>-<what> in lower case, such as 'grayscale-luma'"
        raise MasterError(f"exercise id {id!r}: {expected}")
    for is_wrong, problem in _declaration_rules(**declared):
        if is_wrong:
            raise MasterError(f"exercise {id}: {problem}")
    return declared | {
        "sensors": tuple(sensors),
        "title": title or id,
        "time_limit": float(time_limit),
        "allowed": (*allowed, *kind_of(subject).modules()),
        "tolerance": float(tolerance),
        "exact_type": bool(exact_type),
        "practice": bool(practice),
        "hints": tuple(hints),
        "rubric": tuple(map(tuple, rubric)),
    }


def _is_module(name):
    """Whether a name is a whole module, or a package of the course's own."""
    package, _, inner = name.partition(".")
    return package.isidentifier() and (inner.isidentifier() if package == course.package else not inner)


def _declaration_rules(
    function, subject, sensors, time_limit, tolerance, allowed, hints, points, rubric, **_others
):
    """(whether an argument is wrong, what is wrong with it) of each rule."""
    yield subject not in NAMES, f"subject={subject!r}, expected {' or '.join(map(repr, NAMES))}"
    yield from kind_of(subject).declaration_rules(function, points, rubric)
    known = kind_of(subject).sensors
    are_sensors = not isinstance(sensors, str) and {*sensors} <= {*known}
    expected = f"a tuple with some of {', '.join(known)}" if known else "none"
    yield (
        not are_sensors or bool(sensors) != bool(known),
        f"sensors={sensors!r}, expected {expected} for subject={subject!r}",
    )
    limits = f"time_limit must be > 0 and tolerance >= 0, got {time_limit} and {tolerance}"
    yield not time_limit > 0 or not tolerance >= 0, limits
    yield isinstance(allowed, str), f"allowed={allowed!r}, expected a tuple: ({allowed!r},)"
    yield (
        not all(isinstance(name, str) and _is_module(name) for name in allowed),
        f"allowed={allowed!r}, expected whole modules, or packages of the course:"
        f' ("scipy", "{course.package}.{min(course.packages, default="")}")',
    )
    yield isinstance(hints, str), f"hints={hints!r}, expected a tuple of texts, one for each step"


def read_exercises(path: Path | str) -> tuple[Exercise, ...]:
    """The exercises that a master declares, in order, with the known mistakes in the file beside it.

    Returns a tuple of Exercise; MasterError says what is wrong with the declaration, and in which line.
    """
    path = Path(path)
    files = (path, path.with_suffix(MISTAKES_SUFFIX))
    return _read_exercises(path, tuple(file.stat().st_mtime_ns for file in files if file.exists()))


@lru_cache(maxsize=64)
def _read_exercises(path, _modified):
    headings, owned_cells, latest = {}, [], None
    for cell in read_script(path).cells:
        if cell.role == "exercise":
            heading = _heading(cell)
            latest = heading["id"]
            if latest in headings:
                raise MasterError(f"{cell.place}: exercise {latest} is declared twice")
            headings[latest] = heading
        elif cell.role not in ("", "predict", "texts"):
            owners = cell.options.get("exercise", latest)
            if owners is None:
                text = f'a {cell.role} cell before any exercise; write exercise="..." in its header'
                raise MasterError(f"{cell.place}: {text}")
            owned_cells.append((cell, [owners] if isinstance(owners, str) else owners))
    for cell, owners in owned_cells:
        for owner in owners:
            if owner not in headings:
                raise MasterError(f"{cell.place}: exercise={owner!r} is not declared in this master")
    owned_cells += _cells_beside(path, headings)
    return tuple(
        _assemble(path, heading, [cell for cell, owners in owned_cells if id in owners])
        for id, heading in headings.items()
    )


def _cells_beside(path, headings):
    """(cell, its owner as a list) of each mistake and helper in the file beside a master."""
    file, owner = path.with_suffix(MISTAKES_SUFFIX), None
    for cell in read_script(file).cells if file.exists() else ():
        if cell.kind == "markdown":
            if not cell.source.startswith("# "):
                continue
            owner = cell.source.removeprefix("# ").strip()
            if owner not in headings:
                raise MasterError(
                    f"{cell.place}: no exercise {owner!r} in {path.name}; a heading names one of"
                    f" {', '.join(headings) or 'none'}"
                )
        elif cell.role not in ("", "mistake") or cell.options.get("exercise", owner) != owner:
            text = 'only role="mistake" cells of the exercise in the heading stand here'
            raise MasterError(f"{cell.place}: {text}")
        elif owner is None:
            raise MasterError(f"{cell.place}: code before any heading; write its exercise above: # # an-id")
        else:
            yield cell, [owner]


def _heading(cell):
    try:
        calls = [node for node in ast.walk(ast.parse(cell.source)) if isinstance(node, ast.Call)]
        calls = [call for call in calls if getattr(call.func, "id", "") == "exercise"]
        if len(calls) != 1:
            raise MasterError(f"expected one call of exercise(...), found {len(calls)}")
        arguments = [ast.literal_eval(value) for value in calls[0].args]
        keywords = {str(keyword.arg): ast.literal_eval(keyword.value) for keyword in calls[0].keywords}
        return exercise(*arguments, **keywords) | {"preparation": cell.source}
    except MasterError as error:
        raise MasterError(f"{cell.place}: {error}") from error
    except (SyntaxError, ValueError, TypeError) as error:
        text = f"cannot read the declaration ({error}); exercise(...) takes literals only"
        raise MasterError(f"{cell.place}: {text}") from error


def _assemble(path, heading, cells):
    cells_by_role = {role: [cell for cell in cells if cell.role == role] for role in ("", *ROLES)}
    for role in ("answer", "solution"):
        if len(cells_by_role[role]) != 1:
            place = f"{path.name}: exercise {heading['id']}"
            raise MasterError(f'{place} needs one role="{role}" cell, found {len(cells_by_role[role])}')
    kind = kind_of(heading["subject"])
    for cell in cells_by_role["answer"] + cells_by_role["solution"]:
        if cell.kind not in kind.cell_kinds:
            text = f"a {cell.role} cell is a {cell.kind} cell; here a role needs a {kind.cell_kinds[0]} cell"
            raise MasterError(f"{cell.place}: {text}")
    cases, hidden = (
        [_case(heading, cell, number) for number, cell in enumerate(cells_by_role[role], 1)]
        for role in ("case", "hidden")
    )
    if kind.graded_by_person:
        points = 0 if heading["practice"] else heading["points"]
        cases = [Case(f"case-{heading['id']}-1", "graded by a person", points, "", 0.0)]
    left_out = ("hint", "tolerance", "points")
    return Exercise(
        **{name: value for name, value in heading.items() if name not in left_out},
        master=path,
        figure=kind.graded_by_person and cells_by_role["answer"][0].kind == "code",
        given=tuple(cell.source for cell in cells_by_role["given"]),
        stub=cells_by_role["answer"][0].source,
        solution=cells_by_role["solution"][0].source,
        cases=(*cases, *hidden),
        hidden_count=len(hidden),
        hidden_points=sum(case.points for case in hidden),
        mistakes=tuple(
            Mistake(_text(cell, "name"), _text(cell, "says"), cell.source)
            for cell in cells_by_role["mistake"]
        ),
        helpers="\n\n".join(cell.source for cell in cells_by_role[""]),
    )


def _case(heading, cell, number):
    points = 0 if heading["practice"] else cell.options.get("points", 1)
    if not isinstance(points, int) or points < 0:
        raise MasterError(f"{cell.place}: points={points!r}, expected a whole number >= 0")
    return Case(
        id=f"{cell.role}-{heading['id']}-{number}",
        title=_text(cell, "title"),
        points=points,
        hint=cell.options.get("hint", heading["hint"]),
        tolerance=float(cell.options.get("tolerance", heading["tolerance"])),
        hidden=cell.role == "hidden",
        source=cell.source,
        line=cell.line,
    )


def _text(cell, key):
    value = cell.options.get(key)
    if not isinstance(value, str) or not value.strip():
        raise MasterError(f'{cell.place}: a {cell.role} cell needs {key}="..." in its header')
    return value
