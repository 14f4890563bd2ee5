"""What an exercise is: its declaration, read from the master that teaches it.

`imgproc_course.classroom.authoring.masters` describes the format of masters.
"""

import ast
import re
import zlib
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from imgproc_course.classroom.exercises.percent_script import MISTAKES_SUFFIX, ROLES, MasterError, read_script

PUBLIC_SEED = 20_240_501  # what `check` draws its inputs from; a teacher's key has a seed of its own

_MODULE = re.compile(r"(?!imgproc_course$)[A-Za-z_]\w*|imgproc_course\.\w+")
_ID = re.compile(r"[a-z0-9]+(-[a-z0-9]+)+")


def exercise(
    id,
    *,
    function,
    title="",
    time_limit=5.0,
    allowed=(),
    tolerance=0.0,
    exact_type=False,
    practice=False,
    hint="",
    border_hint="",
    hints=(),
    explanation="",
    another_way="",
):
    """Declare an exercise, in a master's `role="exercise"` cell.

    The arguments are literals: they are read without running anything. The rest of that cell (imports,
    functions that make inputs) runs before each case and each mistake. Neither the learner nor the learner's
    code sees it.

    Parameters
    ----------
    id : str, `<lesson>-<what>`, lower case: "grayscale-luma"
    title : str, the exercise's name in reports; its id if omitted
    function : str, the name of the function that the learner writes
    time_limit : float, seconds, for one call of the function
    allowed : tuple of str, modules that the answer may use beside NumPy and the standard library: ("scipy",
        "imgproc_course.imaging"). matplotlib, IPython.display and imgproc_course.display are there for
        looking
    tolerance : float >= 0, absolute, in the unit of the answer, for every case that declares none
    exact_type : bool, a right value in another type is wrong: the task says so to the learner. Otherwise
        `comparison` says which types stand for another one
    practice : bool, checked but not graded
    hint : str, shown if a case that fails has no hint of its own
    border_hint : str, shown instead if only values on the border of an image are wrong
    hints : tuple of str, the steps of `hint(id)`, from a question to nearly the code
    explanation : str, what `solution(id)` says below the code: why it is written in this way
    another_way : str, one sentence: how a right answer could be written differently

    Returns
    -------
    dict of the arguments, checked

    Raises
    ------
    MasterError : an argument of the wrong kind
    """
    if not isinstance(id, str) or not _ID.fullmatch(id):
        raise MasterError(
            f"exercise id {id!r}: expected <lesson>-<what> in lower case, such as 'grayscale-luma'"
        )
    if not isinstance(function, str) or not function.isidentifier():
        raise MasterError(f"exercise {id}: function={function!r}, expected the name of a function")
    if not time_limit > 0 or not tolerance >= 0:
        raise MasterError(
            f"exercise {id}: time_limit must be > 0 and tolerance >= 0, got {time_limit} and {tolerance}"
        )
    if isinstance(allowed, str):
        raise MasterError(f"exercise {id}: allowed={allowed!r}, expected a tuple: ({allowed!r},)")
    if not all(isinstance(name, str) and _MODULE.fullmatch(name) for name in allowed):
        raise MasterError(
            f"exercise {id}: allowed={allowed!r}, expected whole modules, or packages of the course:"
            ' ("scipy", "imgproc_course.imaging")'
        )
    if isinstance(hints, str):
        raise MasterError(f"exercise {id}: hints={hints!r}, expected a tuple of texts, one for each step")
    return {
        "id": id,
        "function": function,
        "title": title or id,
        "time_limit": float(time_limit),
        "allowed": tuple(allowed),
        "tolerance": float(tolerance),
        "exact_type": bool(exact_type),
        "practice": bool(practice),
        "hint": hint,
        "border_hint": border_hint,
        "hints": tuple(hints),
        "explanation": explanation,
        "another_way": another_way,
    }


@dataclass(frozen=True)
class Case:
    """One check of an exercise, public or hidden; `source` defines `inputs(rng)`."""

    id: str
    title: str
    points: int
    hint: str
    tolerance: float
    hidden: bool
    source: str
    line: int


@dataclass(frozen=True)
class Mistake:
    """A usual wrong answer, and the sentence that explains it; `source` defines the function."""

    name: str
    says: str
    source: str


@dataclass(frozen=True)
class Exercise:
    """An exercise as its master declares it; `exercise` documents the fields of the heading.

    `preparation` runs before each case and mistake, and then `helpers` before each mistake.
    """

    id: str
    function: str
    title: str
    time_limit: float
    allowed: tuple
    tolerance: float
    practice: bool
    hint: str
    border_hint: str
    hints: tuple
    explanation: str
    another_way: str
    master: Path
    exact_type: bool = False
    given: tuple = ()
    preparation: str = ""
    stub: str = ""
    solution: str = ""
    cases: tuple = ()
    mistakes: tuple = ()
    helpers: str = ""

    @property
    def public(self):
        return tuple(case for case in self.cases if not case.hidden)

    @property
    def hidden(self):
        return tuple(case for case in self.cases if case.hidden)

    @property
    def points(self):
        return sum(case.points for case in self.cases)

    def namespace(self):
        """A new namespace as an answer gets it in grading: np, and what the given cells define."""
        names = {"np": np, "__name__": self.id}
        for number, source in enumerate(self.given):
            _run(source, names, f"{self.master.name}, given cell {number + 1} of {self.id}")
        return names

    def _prepared(self, helpers=""):
        """A new namespace for the master's own cases and mistakes."""
        names = self.namespace() | {"exercise": exercise}
        _run(self.preparation, names, f"{self.master.name}, declaration of {self.id}")
        _run(helpers, names, f"{self.master.name}, helpers of the mistakes of {self.id}")
        return names

    def function_of(self, source, label, *, prepared=False):
        """The exercise's function as a source defines it in a new namespace; MasterError if it does not.

        Prepared, as for a mistake, it has the helpers, and the right answer as `solution`.
        """
        names = self.namespace()
        if prepared:
            names = self._prepared(self.helpers) | {"solution": self.function_of(self.solution, "solution")}
        _run(source, names, f"{self.master.name}, {label} of {self.id}")
        if not callable(names.get(self.function)):
            raise MasterError(
                f"{self.master.name}: the {label} of {self.id} does not define {self.function}()"
            )
        return names[self.function]

    def arguments(self, case, seed=PUBLIC_SEED):
        """A tuple of arguments for each call that a case makes; it depends only on the seed and the case."""
        place = f"{self.master.name}, line {case.line}: {case.id}"
        names = self._prepared()
        _run(case.source, names, place)
        if "inputs" not in names:
            raise MasterError(f"{place} does not define inputs(rng)")
        rng = np.random.default_rng([seed, zlib.crc32(case.id.encode())])
        try:
            inputs = names["inputs"](rng)
        except Exception as error:
            raise MasterError(f"{place}: inputs(rng) raised {type(error).__name__}: {error}") from error
        calls = inputs if isinstance(inputs, list) else [inputs]
        if not calls or not all(isinstance(call, tuple) for call in calls):
            raise MasterError(
                f"{place}: inputs(rng) must return a tuple of arguments, (frame,), or a list of such tuples"
            )
        return calls


def _run(source, names, place):
    try:
        exec(compile(source, f"<{place}>", "exec", dont_inherit=True), names)
    except Exception as error:
        raise MasterError(f"{place}: {type(error).__name__}: {error}") from error


def read_exercises(path):
    """The exercises that a master declares, in order, with the known mistakes in the file beside it.

    Parameters
    ----------
    path : Path of a master

    Returns
    -------
    tuple of Exercise

    Raises
    ------
    MasterError : what is wrong with the declaration, and in which line
    """
    path = Path(path)
    files = (path, path.with_suffix(MISTAKES_SUFFIX))
    return _read_exercises(path, tuple(file.stat().st_mtime_ns for file in files if file.exists()))


@lru_cache(maxsize=64)
def _read_exercises(path, _modified):
    headings, preparations, owned_cells = {}, {}, []
    latest = None
    for cell in read_script(path).role_cells:
        place = f"{path.name}, line {cell.line}"
        if cell.role == "predict":
            continue
        if cell.role == "exercise":
            heading = _heading(cell, place)
            latest = heading["id"]
            if latest in headings:
                raise MasterError(f"{place}: exercise {latest} is declared twice")
            headings[latest], preparations[latest] = heading, cell
            continue
        owners = cell.options.get("exercise", latest)
        if owners is None:
            raise MasterError(
                f'{place}: a {cell.role} cell before any exercise; write exercise="..." in its header'
            )
        owned_cells.append((cell, [owners] if isinstance(owners, str) else owners, place))
    for _, owners, place in owned_cells:
        for owner in owners:
            if owner not in headings:
                raise MasterError(f"{place}: exercise={owner!r} is not declared in this master")
    owned_cells += _cells_beside(path, headings)
    return tuple(
        _assemble(
            path,
            heading,
            preparations[id],
            [(cell, place) for cell, owners, place in owned_cells if id in owners],
        )
        for id, heading in headings.items()
    )


def _cells_beside(path, headings):
    """(cell, its owner as a list, its place) of each mistake and helper in the file beside a master."""
    file, owner = path.with_suffix(MISTAKES_SUFFIX), None
    for cell in read_script(file).cells if file.exists() else ():
        place = f"{file.name}, line {cell.line}" if cell.line else file.name
        if cell.kind == "markdown":
            if not cell.source.startswith("# "):
                continue
            owner = cell.source.removeprefix("# ").strip()
            if owner not in headings:
                raise MasterError(
                    f"{place}: no exercise {owner!r} in {path.name}; a heading names one of"
                    f" {', '.join(headings) or 'none'}"
                )
        elif cell.role not in ("", "mistake") or cell.options.get("exercise", owner) != owner:
            raise MasterError(f'{place}: only role="mistake" cells of the exercise in the heading stand here')
        elif owner is None:
            raise MasterError(f"{place}: code before any heading; write its exercise above: # # an-id")
        else:
            yield cell, [owner], place


def _heading(cell, place):
    try:
        calls = [node for node in ast.walk(ast.parse(cell.source)) if _is_declaration(node)]
        if len(calls) != 1:
            raise MasterError(f"{place}: expected one call of exercise(...), found {len(calls)}")
        arguments = [ast.literal_eval(value) for value in calls[0].args]
        keywords = {keyword.arg: ast.literal_eval(keyword.value) for keyword in calls[0].keywords}
        return exercise(*arguments, **keywords)
    except MasterError as error:
        raise MasterError(f"{place}: {error}") from error
    except (SyntaxError, ValueError, TypeError) as error:
        raise MasterError(
            f"{place}: cannot read the declaration ({error}); exercise(...) takes literals only"
        ) from error


def _is_declaration(node):
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "exercise"


def _assemble(path, heading, preparation, cells):
    cells_by_role = {role: [(cell, place) for cell, place in cells if cell.role == role] for role in ROLES}
    for role in ("answer", "solution"):
        if len(cells_by_role[role]) != 1:
            place = f"{path.name}: exercise {heading['id']}"
            raise MasterError(f'{place} needs one role="{role}" cell, found {len(cells_by_role[role])}')
    cases = [_case(heading, cell, place, k) for k, (cell, place) in enumerate(cells_by_role["case"], 1)]
    cases += [_case(heading, cell, place, k) for k, (cell, place) in enumerate(cells_by_role["hidden"], 1)]
    mistakes = [
        Mistake(_text(cell, "name", place), _text(cell, "says", place), cell.source)
        for cell, place in cells_by_role["mistake"]
    ]
    return Exercise(
        **heading,
        master=path,
        given=tuple(cell.source for cell, _ in cells_by_role["given"]),
        preparation=preparation.source,
        stub=cells_by_role["answer"][0][0].source,
        solution=cells_by_role["solution"][0][0].source,
        cases=tuple(cases),
        mistakes=tuple(mistakes),
        helpers="\n\n".join(cell.source for cell, _ in cells if not cell.role),
    )


def _case(heading, cell, place, number):
    points = 0 if heading["practice"] else cell.options.get("points", 1)
    if not isinstance(points, int) or points < 0:
        raise MasterError(f"{place}: points={points!r}, expected a whole number >= 0")
    return Case(
        id=f"{cell.role}-{heading['id']}-{number}",
        title=_text(cell, "title", place),
        points=points,
        hint=cell.options.get("hint", heading["hint"]),
        tolerance=float(cell.options.get("tolerance", heading["tolerance"])),
        hidden=cell.role == "hidden",
        source=cell.source,
        line=cell.line,
    )


def _text(cell, key, place):
    value = cell.options.get(key)
    if not isinstance(value, str) or not value.strip():
        raise MasterError(f'{place}: a {cell.role} cell needs {key}="..." in its header')
    return value
