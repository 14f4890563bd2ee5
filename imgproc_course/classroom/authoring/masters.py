"""Read masters: a master is the one source of a lesson, its solved twin and its grading.

A master is `notebooks/masters/NN_name.py`: `name` is the lesson's identity, NN is only its place in the
course. It is a percent script (JupyterLab opens it with jupytext). It is
ordinary Python: prose in `# %% [markdown]` cells, code in `# %%` cells, and *roles* in the cells' headers.
`new_lesson.py.txt` beside this module is a whole one.

Front matter
    `jupyter: imgproc_course:` holds the `title`. The first cell begins with the heading `# title`;
    the lesson has its number there, too.

Minutes, core and deeper
    `[[minutes]]` in a heading begins a section: build writes its minutes. `([[minutes]], deeper)` marks what
    can be left out. In the line **Time**, `[[minutes]]` is the time of the lesson; `minutes` has the rule.

References
    Other lessons, their sections and the terms of the glossary are referred to by name:
    [[images_as_messages]], [[canny_stages#4]], [[term:mask]]; `references` describes them.

Roles (`role="..."` in a code cell's header; every other value is JSON: "text", 3, 0.5, true, ["a", "b"])
    given      visible in the lesson; runs before the learner's answer, before each case, and in grading. It
               holds everything that an answer may use from outside its own cell, imports too (`np` is always
               defined). `exercise=` names its exercise, or a list of them.
    exercise   the declaration, dropped from the lesson: one call of `exercise(...)`, with literals only (see
               `imgproc_course.classroom.exercises.exercise`); three hints, an explanation and another way are
               required. The rest of the cell (imports, functions that make inputs) runs before each case and
               mistake of this exercise.
    answer     the stub: it raises NotImplementedError, or its body is `...`, or, in an exercise that drives,
               it drives badly. The learner edits this cell. It is graded with what it reads of other cells.
               Its id in the lesson is `answer-<exercise>`, and its metadata name the exercise.
    solution   replaces the answer in the solved twin.
    check      visible: `check("<exercise>", function)`. Its id is `check-<exercise>-<n>`. Of an exercise that
               drives, nbval does not compare the output: a path depends on the processor.
    case       a public check; `inputs(rng)` draws the arguments of one call (a tuple), or a list of such
               tuples, from a NumPy Generator. `title`, `points` (1 if omitted), `hint`, `tolerance` in the
               header. The solution gives the expected values; nobody writes them down. In an exercise that
               drives, the argument is one scenario, and its thresholds judge. Dropped.
    hidden     the same, run only in grading. Dropped.
    mistake    a wrong answer that learners give, with `name` and what it `says` to the learner. It may call
               the right answer, `solution(...)`, and change its result. Dropped. See Known mistakes.
    predict    the learner's guess, before the result: `guess_share = None  # how many percent?`. Its id is
               `predict-<lesson>-<n>`. It belongs to no exercise. See Predictions.
    texts      `figure_texts = {"wrapped": ("caption.", "alt text."), ...}`, the literal texts of figures; a
               figure names them: `show(wrapped, text="<lesson>/wrapped")`. Dropped: the build writes them
               into texts/<lesson>.json beside the lesson. It belongs to no exercise.
    After the declaration, a role cell belongs to the last declared exercise, or to the one that `exercise=`
    names.

Known mistakes
    They stand in the master, or, when there are many, in `NN_name.mistakes.py` beside it, below a heading
    for each exercise. Cells without a role run before each of them; nothing else stands there but comments
    in Markdown:

        # %% [markdown]
        # # template-double

        # %%
        ONE = np.uint8(1)

        # %% role="mistake" name="one too many" says="You return 2 * pixels + 1: where does the 1 come from?"
        def double(pixels):
            return solution(pixels) + ONE

Predictions
    A Markdown cell that says **Predict** is followed by a predict cell, and that by a cell that computes the
    result and ends with a comparison. Nothing above shows the result, and the value is computed:

        # %% [markdown]
        # **Predict** how many percent of the pixels are bright.

        # %% role="predict"
        guess_share = None  # your guess: how many percent of the pixels?

        # %%
        share = round((gray > 200).mean() * 100)
        compare_guess(guess_share, share, "%")

    Each predict cell has a name of its own, `guess_...`: a guess that was not made cannot be compared with
    another result. Choices stand in the comment: `# your guess: "left" or "right"?`.

Folded cells
    JupyterLab shows only the first line, a comment, of a cell that holds only asserts, and assignments and
    imports for them: `# Check: the numbers in this section`, once at the end of a section. An assert stands
    in no other cell; only a cell whose output varies may hold its own.

Tags (`tags=["..."]`, any code cell)
    nbval-ignore-output        its output varies (a live image); the next code cell holds asserts
    nbval-raises-exception     the lesson's planned failure: the cell raises, and the error is stored
    keep-output                learners' copies keep this output; they keep no other (the course's index)
    long                       more than 12 lines of code, on purpose

A practice exercise (`practice=True`) is checked but not graded: its points count as 0.
"""

import ast
from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path

from ..exercises.declaration import MasterError, read_exercises
from ..exercises.percent_script import DROPPED_ROLES, MISTAKES_SUFFIX, read_script
from .lesson_names import LESSON_FILE, lesson_name
from .minutes import timed_script
from .questions import OF_QUESTIONS, with_questions
from .references import References
from .rules import CHECK_LINE, VARYING_TAG, master_problems

# Fields of an Exercise and its parts that are Python, and those that are texts.
_SOURCES = ("stub", "solution", "preparation", "helpers", "given")
_TEXTS = ("title", "hint", "border_hint", "hints", "explanation", "another_way", "says")


@dataclass(frozen=True)
class Cell:
    """One cell of a lesson."""

    id: str  # "answer-<exercise>", "check-<exercise>-<n>", "predict-<lesson>-<n>", "<lesson>-<n>", …
    kind: str  # "markdown" or "code"
    source: str  # in the lesson
    solved_source: str  # in the solved twin
    role: str = ""  # "given", "answer", "check", "predict", "question", "ask" or ""
    exercise: str = ""  # the id of its exercise
    tags: tuple = ()
    deeper: bool = False  # whether it can be left out: it is in a deeper section

    @property
    def varies(self):
        return VARYING_TAG in self.tags

    @property
    def folded(self):
        """Whether JupyterLab shows only its first line."""
        return self.kind == "code" and self.source.startswith(CHECK_LINE)


@dataclass(frozen=True)
class Master:
    """A master: `cells` are the lesson's, `exercises` are the declarations that grading needs."""

    path: Path
    title: str
    minutes: int  # of the whole lesson
    core_minutes: int
    cells: tuple
    exercises: tuple
    texts: dict  # {name of a figure: (caption, alternative text)}
    questions: dict  # {name of a question from an earlier lesson: its answer and replies}

    @property
    def name(self):
        """The lesson's identity: "images_as_messages"."""
        return lesson_name(self.path.stem)

    @property
    def number(self):
        """Its place in the course: "03"."""
        match = LESSON_FILE.fullmatch(self.path.stem)
        return match["number"] if match else ""  # the index has none

    @property
    def deeper_exercises(self):
        """The ids of the exercises that can be left out."""
        return tuple(cell.exercise for cell in self.cells if cell.role == "answer" and cell.deeper)

    @property
    def handed_out(self):
        """{cell id: source of a check or given cell, which learners leave as it is; None for the others}."""
        return {cell.id: cell.source if cell.role in ("check", "given") else None for cell in self.cells}


def find_masters(folder, names=()):
    """The paths of the masters in a folder, in the order of the course; of all, or of those that are named.

    "03", "images_as_messages", "images" and "03_images_as_messages" name images_as_messages; of a number
    and a name, the name decides. MasterError: a name of no lesson or of several, no master, two of one name,
    or known mistakes without their master.
    """
    for path in sorted(Path(folder).glob(f"*{MISTAKES_SUFFIX}")):
        master = path.with_name(path.name.removesuffix(MISTAKES_SUFFIX) + ".py")
        if not master.exists():
            raise MasterError(f"{path}: there is no {master.name}; rename it like its master, or delete it")
    return _find(folder, names, "masters", "a master", ".py")


def find_lessons(folder, names=()):
    """The built lessons in a folder, in the order of the course; otherwise as `find_masters`."""
    return _find(folder, names, "notebooks", "a lesson", ".ipynb")


def _find(folder, names, plural, singular, suffix):
    paths = sorted(path for path in Path(folder).glob(f"*{suffix}") if LESSON_FILE.fullmatch(path.stem))
    if not paths:
        raise MasterError(f"no {plural} in {folder}; {singular} is named like 03_images_as_messages{suffix}")
    lessons = [lesson_name(path.stem) for path in paths]
    for name in lessons:
        if lessons.count(name) > 1:
            raise MasterError(f"{folder} has two {plural} of the lesson {name}; rename one of them")
    if not names:
        return paths
    return sorted({_find_master(paths, name) for name in names})


def _find_master(paths, name):
    stem = Path(name).stem
    name_part = lesson_name(stem)
    matches = [path for path in paths if name_part in (path.name[:2], lesson_name(path.stem))]
    matches = matches or [
        path for path in paths if stem in path.stem[:2] or lesson_name(path.stem).startswith(name_part)
    ]
    if len(matches) != 1:
        lessons = ", ".join(path.stem for path in matches or paths)
        raise MasterError(f"{name!r} names {'several lessons' if matches else 'no lesson'}: {lessons}")
    return matches[0]


def read_master(path):
    """Read a whole Master; MasterError has a line for each rule of the format that it breaks."""
    path = Path(path)
    script, references = read_script(path), References(path)
    exercises = tuple(_resolved(exercise, references) for exercise in read_exercises(path))
    title = str(script.front_matter.get("title", ""))
    match = LESSON_FILE.fullmatch(path.stem)
    with_asks, questions = with_questions(script.cells, path, references)
    timed = timed_script(replace(script, cells=with_asks), match["number"] if match else "")
    cells = list(_lesson_cells(path, timed, exercises, references))
    if match and cells and cells[0].kind == "markdown":
        cells[0] = _numbered(cells[0], match["number"])
    parts = tuple(cells), exercises, _texts(script, references), questions
    master = Master(path, title, timed.whole, timed.core, *parts)
    problems = master_problems(master)
    if problems:
        raise MasterError("\n".join(f"{path.name}: {problem}" for problem in problems))
    return master


def _texts(script, references):
    """The texts of the figures; MasterError: they are no literal dict of pairs."""
    texts = {}
    for cell in script.cells:
        if cell.role == "texts":
            try:
                texts |= ast.literal_eval(ast.parse(references.in_code(cell.source)).body[0].value)
                pairs = [pair for pair in texts.values() if isinstance(pair, tuple) and len(pair) == 2]
                is_right = len(pairs) == len(texts) and all(all(map(str.strip, pair)) for pair in pairs)
            except (SyntaxError, ValueError, TypeError, AttributeError):
                is_right = False
            if not is_right:
                raise MasterError(
                    f'{cell.place}: expected figure_texts = {{"name": ("caption", "alt"), ...}}'
                )
    return texts


def _numbered(cell, number):
    """The lesson's first cell with the lesson's number in its heading."""
    if not cell.source.startswith("# "):
        return cell
    source = f"# {number} · {cell.source[2:]}"
    return replace(cell, source=source, solved_source=source)


def _resolved(record, references):
    """An Exercise, Case or Mistake with the references in its texts and sources resolved."""
    changes = {}
    for name, value in vars(record).items():
        resolve = references.in_text if name in _TEXTS else references.in_code
        if name in ("cases", "mistakes"):
            changes[name] = tuple(_resolved(part, references) for part in value)
        elif name in _TEXTS or name in _SOURCES:
            changes[name] = resolve(value) if isinstance(value, str) else tuple(map(resolve, value))
    return replace(record, **changes)


def _lesson_cells(path, timed, exercises, references):
    counts, latest = Counter(), ""
    declared = iter(exercises)
    solutions = {exercise.id: exercise.solution for exercise in exercises}
    drives = {exercise.id for exercise in exercises if exercise.subject == "drive"}
    position = 0
    for cell, deeper in zip(timed.cells, timed.deeper, strict=True):
        role = cell.role
        if role == "exercise":
            latest = next(declared).id
        if role in DROPPED_ROLES:
            continue
        position += role not in OF_QUESTIONS
        owners = cell.options.get("exercise", latest)
        owner = (owners if isinstance(owners, str) else owners[0]) if role else ""
        if role in ("predict", *OF_QUESTIONS):
            owner = lesson_name(path.stem)
        tags = tuple(cell.options.get("tags", ()))
        if role == "check" and owner in drives:  # a path depends on the processor
            tags = (*tags, VARYING_TAG)
        id = f"{lesson_name(path.stem)}-{position}"
        if role == "answer":
            id = f"answer-{owner}"
        elif role:
            counts[role, owner] += 1
            id = f"{role}-{owner}-{counts[role, owner]}"
        resolve = references.in_prose if cell.kind == "markdown" else references.in_code
        source = resolve(cell.source)
        solved_source = solutions[owner] if role == "answer" else source
        exercise = "" if role in ("predict", *OF_QUESTIONS) else owner
        yield Cell(id, cell.kind, source, solved_source, role, exercise, tags, deeper)
