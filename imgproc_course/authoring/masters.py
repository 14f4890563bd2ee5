"""Read masters: the one source of a lesson, its solved twin, and what grades it.

A master is `notebooks/masters/NN_name.py`, a percent script (JupyterLab opens it with jupytext). It is
ordinary Python: prose in `# %% [markdown]` cells, code in `# %%` cells, and *roles* in the cells' headers.
A whole one:

    # ---
    # jupyter:
    #   imgproc_course:
    #     title: Doubling
    #     minutes: 5
    # ---

    # %% [markdown]
    # # Doubling
    # You will write a function, and see it checked.

    # %% role="given" exercise="template-double"
    import numpy as np

    LIMIT = 255

    # %%
    from imgproc_course.exercises import check

    # %% role="exercise"
    from imgproc_course.exercises import exercise

    exercise("template-double", function="double", time_limit=5, refused=("cv2",))

    # %% [markdown]
    # **Your turn.** Write `double`: each value twice, never above 255.

    # %% role="answer"
    def double(pixels):
        raise NotImplementedError("your turn")

    # %% role="solution"
    def double(pixels):
        return np.minimum(pixels.astype(np.uint16) * 2, LIMIT).astype(np.uint8)

    # %% role="check"
    check("template-double", double)

    # %% role="case" title="Bright pixels" points=1 hint="Widen before you multiply: uint8 ends at 255."
    def inputs(rng):
        return (rng.integers(100, 256, (3, 4), dtype=np.uint8),)

    # %% role="hidden" title="Any pixels" points=2 hint="What does 200 become?"
    def inputs(rng):
        return [(rng.integers(0, 256, (5, 5), dtype=np.uint8),) for _ in range(3)]

    # %% role="mistake" name="uint8 wraps" says="uint8 ends at 255, and 200 * 2 became 144: widen first."
    def double(pixels):
        return pixels * 2

Front matter
    `jupyter: imgproc_course:` holds `title` (also the `# heading` of the first cell) and `minutes`.

Roles (`role="..."` in a code cell's header; every other value is JSON: "text", 3, 0.5, true, ["a", "b"])
    given      visible in the lesson; runs before the learner's answer, before each case, and in grading. What
               an answer may use from outside its own cell stands here, imports too (`np` is always there).
               `exercise=` names its exercise, or a list of them.
    exercise   the declaration; dropped from the lesson: one call of `exercise(...)`, with literals only (see
               `imgproc_course.exercises.exercise`). What else stands there (imports, functions that make
               inputs) runs before each case and mistake of this exercise.
    answer     the stub: it raises NotImplementedError, or its body is `...`. The learner edits this cell, and
               this cell alone is graded. Its id in the lesson is `answer-<exercise>`.
    solution   stands in the answer's place in the solved twin.
    check      visible: `check("<exercise>", function)`. Its id is `check-<exercise>-<n>`.
    case       a public check; `inputs(rng)` draws the arguments of one call (a tuple), or a list of such
               tuples, from a NumPy Generator. `title`, `points` (1 unless said), `hint`, `tolerance` in the
               header. Expected answers are never written down: the solution gives them. Dropped.
    hidden     the same, run only in grading. Dropped.
    mistake    a wrong answer that learners give, with `name` and what it `says` to the learner. It may call
               the right answer, `solution(...)`, and bend what comes back. Dropped.
    After the declaration, a role cell belongs to the last declared exercise unless it says `exercise="..."`.

Tags (`tags=["..."]`, any code cell)
    nbval-ignore-output        its output varies (a live picture); an assert stands in it or in the next one
    nbval-raises-exception     the lesson's planned failure: the cell raises, and the error is stored
    long                       more than 12 lines of code, on purpose

A practice exercise (`practice=True`) is checked but not graded: its points count as 0.
"""

import ast
import re
from dataclasses import dataclass
from pathlib import Path

from imgproc_course.exercises.declaration import MasterError, read_exercises
from imgproc_course.exercises.percent_script import read_script

LESSON_NAME = re.compile(r"\d\d_[a-z0-9_]+")
VARYING = "nbval-ignore-output"
RAISING = ("nbval-raises-exception", "raises-exception")
MOST_LINES = 12
_DROPPED = ("exercise", "case", "hidden", "mistake")
_HIDING_TAGS = re.compile(r"(hide|remove|skip)([-_]|$)|nbval-skip")


@dataclass(frozen=True)
class Cell:
    """One cell that a lesson shows.

    id        "answer-<exercise>", "check-<exercise>-<n>", "given-<exercise>-<n>", or "<lesson>-<position>"
    kind      "markdown" or "code"
    source    what the lesson shows; solved_source what the solved twin shows
    role      "given", "answer", "check" or ""
    exercise  the id of its exercise, or ""
    tags      tuple of str
    """

    id: str
    kind: str
    source: str
    solved_source: str
    role: str = ""
    exercise: str = ""
    tags: tuple = ()

    @property
    def varies(self):
        return VARYING in self.tags


@dataclass(frozen=True)
class Master:
    """A master as read: `cells` are the lesson's, `exercises` what grading knows."""

    path: Path
    title: str
    minutes: int
    cells: tuple
    exercises: tuple

    @property
    def name(self):
        return self.path.stem


def find_masters(folder, names=()):
    """The masters in a folder, sorted by name.

    Parameters
    ----------
    folder : Path
    names : names of lessons; all of them where empty. "02" and "02_images" name 02_images_as_messages

    Returns
    -------
    list of Path

    Raises
    ------
    MasterError : there is no such folder, no master in it, or a name fits none or several
    """
    found = sorted(path for path in Path(folder).glob("*.py") if LESSON_NAME.fullmatch(path.stem))
    if not found:
        raise MasterError(f"no masters in {folder}; a master is named like 02_images_as_messages.py")
    if not names:
        return found
    chosen = set()
    for name in names:
        wanted = Path(name).stem
        fitting = [path for path in found if path.stem == wanted] or [
            path for path in found if path.stem.startswith(wanted)
        ]
        if len(fitting) != 1:
            there = ", ".join(path.stem for path in fitting or found)
            raise MasterError(f"{name!r} names {'several lessons' if fitting else 'no lesson'}: {there}")
        chosen.add(fitting[0])
    return sorted(chosen)


def read_master(path):
    """Read a master whole, and refuse one that breaks the format's rules.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Master

    Raises
    ------
    MasterError : every rule that it breaks, a line each
    """
    path = Path(path)
    script = read_script(path)
    exercises = read_exercises(path)
    master = Master(
        path=path,
        title=str(script.front_matter.get("title", "")),
        minutes=script.front_matter.get("minutes", 0),
        cells=tuple(_visible_cells(path, script, exercises)),
        exercises=exercises,
    )
    problems = [
        *_problems_of_lesson(master),
        *(problem for each in exercises for problem in _problems_of(each)),
    ]
    if problems:
        raise MasterError("\n".join(f"{path.name}: {problem}" for problem in problems))
    return master


def _visible_cells(path, script, exercises):
    counts, last, shown = {}, "", 0
    declared = iter(exercises)
    solutions = {each.id: each.solution for each in exercises}
    for cell in script.cells:
        role = cell.role
        if role == "exercise":
            last = next(declared).id
        if role in _DROPPED or role == "solution":
            continue
        shown += 1
        owners = cell.options.get("exercise", last)
        owner = (owners if isinstance(owners, str) else owners[0]) if role else ""
        tags = tuple(cell.options.get("tags", ()))
        id = f"{path.stem}-{shown}"
        if role == "answer":
            id = f"answer-{owner}"
        elif role:
            counts[role, owner] = counts.get((role, owner), 0) + 1
            id = f"{role}-{owner}-{counts[role, owner]}"
        solved = solutions[owner] if role == "answer" else cell.source
        yield Cell(id, cell.kind, cell.source, solved, role, owner, tags)


# ---------------------------------------------------------------- the rules


def _problems_of(declared):
    if not declared.public:
        yield f'exercise {declared.id} has no role="case"; without one `check` has nothing to say'
    if not declared.hidden:
        yield f'exercise {declared.id} has no role="hidden"; the public values could be copied into an answer'
    if not declared.mistakes:
        yield f'exercise {declared.id} has no role="mistake"; which wrong answer do learners give?'
    names = [mistake.name for mistake in declared.mistakes]
    yield from (
        f"exercise {declared.id} declares the mistake {name!r} twice"
        for name in sorted(set(names))
        if names.count(name) > 1
    )


def _problems_of_lesson(master):
    first = master.cells[0] if master.cells else None
    if not master.title or not isinstance(master.minutes, int) or master.minutes <= 0:
        yield "the front matter needs jupyter: imgproc_course: title: and minutes:"
    if (
        first is None
        or first.kind != "markdown"
        or not re.match(rf"# (.*\W)?{re.escape(master.title)}\W*$", first.source, re.M)
    ):
        yield f"the first cell must be markdown that begins with the heading '# {master.title}'"
    functions = {each.function for each in master.exercises}
    for cell in master.cells:
        if cell.kind == "code" and not cell.role:
            for name in sorted(functions & _names_bound(cell)):
                yield f"{cell.id} binds {name}, which an exercise asks the learner for; take another name"
    ids = [cell.id for cell in master.cells]
    yield from (f"two cells have the id {id}" for id in sorted(set(ids)) if ids.count(id) > 1)
    yield from (
        f"the id {id} is longer than the 64 characters that a notebook takes" for id in ids if len(id) > 64
    )
    for each in master.exercises:
        if f"check-{each.id}-1" not in ids:
            yield f'exercise {each.id} has no role="check" cell'
    code = [cell for cell in master.cells if cell.kind == "code"]
    for cell, following in zip(code, [*code[1:], None], strict=True):
        yield from (
            f"{cell.id}: {problem}\n    {_first_line(cell)}" for problem in _problems_of_cell(cell, following)
        )


def _first_line(cell):
    return cell.source.splitlines()[0] if cell.source else "(empty)"


def _problems_of_cell(cell, following):
    lines = [line for line in cell.source.splitlines() if line.strip() and not line.strip().startswith("#")]
    if not lines:
        yield "a code cell without code; nbval would never compare it"
        return
    if len(lines) > MOST_LINES and cell.role != "answer" and "long" not in cell.tags:
        yield f'{len(lines)} lines of code, at most {MOST_LINES}; split it, or tag it "long", with a reason'
    if any(
        re.match(r"\s*(from\s+\S+\s+import\s+\*|%%(capture|script|html|javascript))", line) for line in lines
    ):
        yield "star imports and cells that hide their work are refused; name what is imported, show what runs"
    if lines[-1].rstrip().endswith(";"):
        yield "ends with ';', which nbval does not heed: assign the value to _ instead"
    if any(_HIDING_TAGS.match(tag) for tag in cell.tags):
        yield "a tag hides this cell; everything a lesson does is seen"
    if re.search(r"^\s*#\s*(NBVAL_|PYTEST_VALIDATE)", cell.source, re.M):
        yield f'give nbval its orders as a tag (tags=["{VARYING}"]), not as a comment'
    if cell.varies and not _asserts(cell) and not (following and _asserts(following)):
        yield f"tagged {VARYING}: it must hold an assert, or the next code cell must"
    if cell.role and not _is_python(cell.source):
        yield f"a {cell.role} cell must be plain Python; it takes no magics"
    if cell.role == "check" and not re.search(
        rf"""check\(\s*["']{re.escape(cell.exercise)}["']""", cell.source
    ):
        yield f'must call check("{cell.exercise}", ...)'


def _is_python(source):
    try:
        ast.parse(source)
    except SyntaxError:
        return False
    return True


def _names_bound(cell):
    """What a cell defines for the cells after it: its functions, classes and variables."""
    try:
        body = ast.parse(cell.source).body
    except SyntaxError:
        return set()  # a magic; running it will tell
    defined = {node.name for node in body if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    plain = [node for node in body if not isinstance(node, ast.FunctionDef | ast.ClassDef)]
    stored = (name for node in plain for name in ast.walk(node) if isinstance(name, ast.Name))
    return defined | {name.id for name in stored if isinstance(name.ctx, ast.Store)}


def _asserts(cell):
    try:
        return any(isinstance(node, ast.Assert) for node in ast.walk(ast.parse(cell.source)))
    except SyntaxError:
        return False  # a magic; running it will tell
