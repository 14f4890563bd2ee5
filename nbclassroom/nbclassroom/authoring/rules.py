"""The rules that every master follows; `masters` describes the format."""

import ast
import re
from collections import Counter

from .. import course
from ..exercises.cell_syntax import bound_names, top_level

VARYING_TAG = "nbval-ignore-output"
RAISING_TAGS = ("nbval-raises-exception", "raises-exception")
CHECK_LINE = "# Check: "  # JupyterLab shows only this first line of the cell
MOST_LINES = 12  # of code in a cell
_FIGURES = ("show", "show_figure", "tune")
HINTS = 3  # of every exercise
_MOST_ID_CHARACTERS = 64  # of a cell id in a notebook
_HIDES_WORK = re.compile(r"\s*(from\s+\S+\s+import\s+\*|%%(capture|script|html|javascript))")
_HIDING_TAGS = re.compile(r"(hide|remove|skip)([-_]|$)|nbval-skip")


def master_problems(master):
    """The rules that a master breaks, a text for each."""
    rules = (_heading_problems, _name_problems, _id_problems, _text_problems)
    problems = [problem for rule in rules for problem in rule(master)]
    code_cells = [cell for cell in master.cells if cell.kind == "code"]
    for cell, next_cell in zip(code_cells, [*code_cells[1:], None], strict=False):
        first_line = cell.source.splitlines()[0] if cell.source else "(empty)"
        problems += [f"{cell.id}: {problem}\n    {first_line}" for problem in _cell_problems(cell, next_cell)]
    problems += _prediction_problems(master)
    for exercise in master.exercises:
        rules = _exercise_rules(exercise)
        problems += [f"exercise {exercise.id} {problem}" for is_broken, problem in rules if is_broken]
    return problems


def _exercise_rules(exercise):
    """(whether an exercise breaks the rule, the problem) of each rule."""
    if exercise.kind.graded_by_person:
        yield not exercise.solution.strip(), 'needs a model answer, in its role="solution" cell'
        return
    hints = exercise.hints
    yield not exercise.public, 'has no role="case"; without one, `check` has nothing to run'
    yield not exercise.hidden, 'has no role="hidden"; an answer could copy the public values'
    classes = {node.name for node in top_level(exercise.stub) if isinstance(node, ast.ClassDef)}
    explains = exercise.kind.has_sentences
    yield not (exercise.mistakes or explains), 'has no role="mistake"; which wrong answer do learners give?'
    yield (
        len(hints) != HINTS or not all(map(_is_text, hints)),
        f"needs hints=(...) with {HINTS} texts: a question that points to the idea, the steps in words,"
        f" nearly the code; it has {len(hints)}",
    )
    why = "needs explanation=...: why is its solution written in this way?"
    yield not _is_text(exercise.explanation), why
    yield not _is_text(exercise.another_way), 'needs another_way="You can also write ...", one sentence'
    no_class = f'has subject="node"; its answer cell must define class {exercise.function}(Node)'
    yield exercise.kind.noun == "class" and exercise.function not in classes, no_class
    for name, count in Counter(mistake.name for mistake in exercise.mistakes).items():
        yield count > 1, f"declares the mistake {name!r} twice"


def _is_text(value):
    return isinstance(value, str) and bool(value.strip())


def _heading_problems(master):
    first = master.cells[0] if master.cells else None
    if not master.title:
        yield f"the front matter needs jupyter: {course.name}: title:"
    heading = f"# {master.number} · {master.title}" if master.number else f"# {master.title}"
    if first is None or first.kind != "markdown" or first.source.splitlines()[:1] != [heading]:
        yield f"the first cell must be markdown that begins with '# {master.title}'; build adds the number"


def _name_problems(master):
    functions = {exercise.function for exercise in master.exercises}
    for cell in master.cells:
        if cell.kind == "code" and not cell.role:
            for name in sorted(functions & bound_names(cell.source)):
                yield f"{cell.id} defines {name}, which is the name of an exercise's function; rename it"


def _id_problems(master):
    ids = [cell.id for cell in master.cells]
    for id in (id for id in ids if len(id) > _MOST_ID_CHARACTERS):
        yield f"the id {id} is longer than the {_MOST_ID_CHARACTERS} characters that a notebook allows"
    for exercise in master.exercises:
        if f"check-{exercise.id}-1" not in ids:
            yield f'exercise {exercise.id} has no role="check" cell'


def _text_problems(master):
    """The names of texts that are not in the master, and the texts that no figure takes."""
    texts = {f"{master.name}/{name}" for name in master.texts | master.questions}
    nodes = [node for cell in master.cells if cell.kind == "code" for node in _nodes(cell)]
    values = {getattr(node, "value", None) for node in nodes if getattr(node, "arg", "") == "text"}
    strings = [node for node in nodes if isinstance(getattr(node, "value", None), str)]
    named = {node.value for node in strings if node in values or node.value.startswith(f"{master.name}/")}
    for name in sorted(named - texts):
        yield f'text="{name}": no role="texts" cell has it; there are: {", ".join(sorted(texts)) or "none"}'
    yield from (f'no figure takes text="{name}"; delete it' for name in sorted(texts - named))


def _cell_problems(cell, next_cell):
    lines = [line for line in cell.source.splitlines() if line.strip() and not line.strip().startswith("#")]
    if not lines:
        yield "a code cell without code: write some; a text, such as a written answer, is # %% [markdown]"
        return
    yield from (problem for is_broken, problem in _cell_rules(cell, lines, next_cell) if is_broken)
    yield from _figure_problems(cell)
    if cell.folded and not (_asserts(cell) and all(map(_belongs_to_asserts, top_level(cell.source)))):
        yield f"a cell that begins with '{CHECK_LINE}' is folded: it holds only asserts, and names for them"


def _cell_rules(cell, lines, next_cell):
    """(whether a cell breaks the rule, the problem) of each rule."""
    may_be_long = cell.folded or cell.role == "answer" or "long" in cell.tags
    long = f'{len(lines)} lines of code, at most {MOST_LINES}; split it, or tag it "long", with a reason'
    yield len(lines) > MOST_LINES and not may_be_long, long
    hiding = "star imports and magics that hide work are refused; name each import, and show each step"
    yield any(_HIDES_WORK.match(line) for line in lines), hiding
    ignored = "ends with ';', which nbval ignores: assign the value to _ instead"
    yield lines[-1].rstrip().endswith(";"), ignored
    is_hidden = any(_HIDING_TAGS.match(tag) for tag in cell.tags)
    yield is_hidden, "a tag hides this cell; every cell of a lesson is visible"
    comment = f'write instructions for nbval as a tag (tags=["{VARYING_TAG}"]), not as a comment'
    yield re.search(r"^\s*#\s*(NBVAL_|PYTEST_VALIDATE)", cell.source, re.M), comment
    varies = f"tagged {VARYING_TAG}: the next code cell must begin with '{CHECK_LINE}' and hold its asserts"
    yield cell.varies and cell.role != "check" and not (next_cell and _asserts(next_cell)), varies
    yield not cell.folded and _asserts(cell), f"move its asserts into a cell that begins with '{CHECK_LINE}'"
    is_python = bool(top_level(cell.source))
    yield cell.role and not is_python, f"a {cell.role} cell must be plain Python; it takes no magics"
    call = re.search(rf"""check\(\s*["']{re.escape(cell.exercise)}["']""", cell.source)
    yield cell.role == "check" and not call, f'must call check("{cell.exercise}", ...)'


def _figure_problems(cell):
    calls = [node for node in _nodes(cell) if isinstance(node, ast.Call)]
    for name, call in [(getattr(call.func, "id", ""), call) for call in calls]:
        keywords = {keyword.arg for keyword in call.keywords}
        if name in _FIGURES and "text" not in keywords and not {"caption", "alt"} <= keywords:
            yield f'{name}(...) needs text="<lesson>/<name>"'


def _belongs_to_asserts(node):
    if isinstance(node, ast.For | ast.With):
        return all(_belongs_to_asserts(inner) for inner in node.body)
    return isinstance(node, ast.Assert | ast.Assign | ast.Import | ast.ImportFrom)


def _prediction_problems(master):
    guesses, has_exercises = [_guess_name(cell) for cell in master.cells if cell.role == "predict"], False
    for cell, next_cell in zip(master.cells, [*master.cells[1:], None], strict=True):
        is_prompt = cell.kind == "markdown" and "**Predict" in cell.source
        if is_prompt and (next_cell is None or next_cell.role != "predict"):
            yield f'{cell.id} says **Predict**; the next cell must have role="predict"'
        has_exercises = has_exercises or course.face in cell.source
        if cell.role == "predict" and not has_exercises:
            yield f"{cell.id}: no cell above imports {course.face}, which reads guesses"
        if cell.role == "predict" and _guess_name(cell) is None:
            yield f"{cell.id}: write one line, guess_share = None  # your guess: how many percent?"
        elif cell.role == "predict" and guesses.count(_guess_name(cell)) > 1:
            yield f"{cell.id}: {_guess_name(cell)} is the guess of another cell too; rename it"
        elif cell.role == "predict" and not _is_compared(_guess_name(cell), _cell_after(master, cell)):
            comparison = f"compare_guess({_guess_name(cell)}, value)"
            yield f"{cell.id}: the next code cell must end with {comparison}, where the value is computed"


def _guess_name(cell):
    match = re.fullmatch(r"(guess(_\w+)?) = None  # your guess: \S.*", cell.source.strip())
    return match and match[1]


def _cell_after(master, predict_cell):
    """The next code cell that can compare: not one that raises."""
    cells = master.cells[master.cells.index(predict_cell) + 1 :]
    may_compare = (cell for cell in cells if cell.kind == "code" and not {*cell.tags} & {*RAISING_TAGS})
    return next(may_compare, None)


def _is_compared(guess, cell):
    match cell and top_level(cell.source)[-1:]:
        case [ast.Expr(ast.Call(ast.Name("compare_guess"), [ast.Name(name), value, *_]))]:
            return name == guess and any(isinstance(node, ast.Name) for node in ast.walk(value))
    return False


def _asserts(cell):
    return any(isinstance(node, ast.Assert) for node in _nodes(cell))


def _nodes(cell):
    """The syntax nodes of a cell; none if it has a magic or an error, which running it will show."""
    return [node for statement in top_level(cell.source) for node in ast.walk(statement)]
