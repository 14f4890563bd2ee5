"""`check`: run an answer's public cases in the learner's notebook."""

import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np

from .cell_syntax import is_part_of, plain_python, program_lines
from .check_files import UnknownExerciseError, find_check_file
from .diagnosis import UNCHANGED
from .help_steps import Help
from .judging import CheckResult, judge
from .lesson import PUBLIC_SEED, Case, Exercise, ExpectedCall, Mistake, check_data_of
from .names_read import RUNS, NamesRead
from .one_change import sentence_on_branch, sentence_on_change
from .progress import ExerciseProgress, digest_of, note_progress, progress_of
from .running import NONE, attempt, cells_of, globals_of, source_of
from .source_remarks import SAYS, STUB_LINE, has_done, remarks_on_source

_MOST_LINES = 3  # of a program, that are named
_LONGEST_REMARK = 1_000  # characters


class CheckInterrupted(KeyboardInterrupt):
    """Somebody interrupted a check; a notebook shows one sentence, and runs no further cells."""

    def _render_traceback_(self):
        return ["The check was interrupted. Run its cell again: it drives from the start."]


def check(exercise_id: str, function: Callable | None = None) -> CheckResult | Help:
    """Check an answer: show what is right, what is wrong, and where to look.

    Of a written answer, which a person grades, it shows what to compare it with.

    Parameters
    ----------
    exercise_id : str, as the lesson names it: "grayscale-luma"
    function : the learner's function or class itself, `luma`, not a call of it; none for a written answer

    Returns
    -------
    CheckResult, which a notebook shows; programs use `.passed` and `.results`. Help: the exercise is gone, or
    its answer is written

    Raises
    ------
    CheckFileError : there is no such exercise, or its file is missing or damaged
    TypeError : `function` cannot be called, or is no class where the answer is one
    """
    try:
        exercise = find_check_file(exercise_id).exercise(exercise_id)
    except UnknownExerciseError:
        if progress_of(exercise_id) == ExerciseProgress():
            raise
        return Help(f"{exercise_id} is no longer in the course. Your answer and your progress are kept.")
    if exercise.kind.graded_by_person:
        return exercise.kind.look_at(exercise)
    if not exercise.kind.can_be_answer(function):
        noun = exercise.kind.noun
        raise TypeError(
            f"check({exercise_id!r}, ...) needs your {noun} {exercise.function} itself, got a value"
            f" of type {type(function).__name__}; run the cell with your {noun} first (if it shows"
            f" an error, repair that), and write check({exercise_id!r}, {exercise.function}), no parentheses"
            " after the name"
        )
    return _check_in_notebook(exercise, function)


def _check_in_notebook(exercise, function):
    name = exercise.function if _is_known(exercise, function) else getattr(function, "__name__", "")
    if why := RUNS.why_gone(name):
        why_older = SAYS["gone"].format(name=exercise.kind.name_of(name), why=why)
        return CheckResult(exercise, attempted=True, why_older=why_older)
    try:
        result = run_check(exercise, function)
    except KeyboardInterrupt:
        raise CheckInterrupted from None
    if result.passed:
        note_progress(exercise.id, ExerciseProgress(passed=True))
    elif result.attempted:
        note_progress(exercise.id, ExerciseProgress(tries=(digest_of(function),)))
    return result


def run_cases(
    exercise: Exercise, function: Callable, *, cases: Iterable[Case] | None = None, seed: int = PUBLIC_SEED
) -> CheckResult:
    """The CheckResult of an answer on an Exercise's cases, the public ones if omitted; inputs by a seed.

    Without the search for one change, which takes a second.
    """
    data = check_data_of(exercise, None if cases is None else tuple(cases), seed)
    return run_check(data, function, searches=False)


def run_mistake(exercise: Exercise, mistake: Mistake) -> CheckResult:
    """The CheckResult of a declared mistake of an Exercise on its public cases."""
    data = check_data_of(exercise)
    for one, case in product(data.mistakes, data.cases if data.kind.expects_values else ()):
        one.results[case.id]  # computed here: below, the comparison with all of them has few seconds
    wrong_function = exercise.function_of_mistake(mistake)
    return _judge_calls(data, wrong_function, data.kind.run_cases(data, wrong_function))


def run_check(exercise, function, *, searches=True):
    """The CheckResult of an answer, as the notebook has it, on the cases of an Exercise.

    `searches`: whether one change is looked for that makes it right.
    """
    calls = exercise.kind.run_cases(exercise, function)
    result = _judge_calls(exercise, function, calls)
    result = attempt(lambda: _with_names(result, NamesRead(function, RUNS)), result)
    searches = searches and exercise.kind.tries_changes and result.attempted and not result.mistake
    one_change = attempt(lambda: _one_change(result, function, calls), "", seconds=5) if searches else ""
    if searches and not one_change:
        one_change = attempt(lambda: _branch(result, function, calls), "")
    way = one_change and SAYS["way without return"].format(name=exercise.function)  # not the cause then
    remarks = tuple(remark for remark in result.remarks if remark != way)
    cell = next(iter(cells_of(function).values()), "")
    lines = attempt(lambda: program_lines(plain_python(cell)), ())[:_MOST_LINES]
    in_cell = [SAYS["line of a program"].format(line=line, code=code) for line, code in lines]
    remarks = (*_remark_on_name(exercise, function), *in_cell, *remarks)
    return replace(result, remarks=remarks, one_change=one_change)


def _with_names(result, names):
    exercise, given, remarks = result.exercise, set(result.exercise.provided), result.remarks
    values = ", ".join(names.values(given))
    is_wrong = result.attempted and not all(case_result.passed for case_result in result.results)
    if values and is_wrong and exercise.kind.shows_values:
        parts = {"values": values, "arguments": ", ".join(exercise.names)}
        remarks = (SAYS["value of another cell"].format(name=exercise.answer_name, **parts), *remarks)
    refused = names.refused(exercise.allowed, given)
    return replace(result, refused=refused, gone=names.gone(), remarks=remarks)


def _is_known(exercise, function):
    """Whether the notebook has this function under the name of the task."""
    return globals_of(function).get(exercise.function) is function


def _remark_on_name(exercise, function):
    """What to do about an answer that has another name than its task."""
    own_name = getattr(function, "__name__", "")
    if _is_known(exercise, function) or own_name == exercise.function or not RUNS.run_of(own_name):
        return ()
    return (SAYS["another try"].format(name=exercise.answer_name, other=own_name),)


def _one_change(result, function, calls):
    """Where one change would make a wrong answer right, unless only its type is wrong."""
    exercise, shown = result.exercise, result.shown
    if shown is None or any(call.result.timed_out for call in calls):
        return ""
    if all(call.has_right_values for call in calls):
        return ""
    # The shown call first: most changes fail it.
    ordered = sorted(calls, key=lambda call: call is not shown)
    pairs = [(call.case, ExpectedCall(call.arguments, call.expected)) for call in ordered]
    others = [(case, call) for case in exercise.witnesses for call in case.calls]
    may_warn = any(call.result.warning for call in calls)  # else a nan would only hide the mistake
    # With an inf, functions of np.linalg may compute for ever.
    level: Any = "warn" if may_warn else "raise"

    def passes(changed, seconds):
        judged = (exercise.judged_call(changed, *pair, seconds) for pair in (*pairs, *others))
        with np.errstate(divide=level, over=level, invalid=level):
            return all(call.passed and (may_warn or not call.result.warning) for call in judged)

    task = "\n".join((exercise.stub, *exercise.hints, *(call.case.hint for call in calls)))
    return sentence_on_change(function, passes, task)


def _branch(result, function, calls):
    """Which condition never held, where nothing else says why the values are wrong."""
    exercise, text = result.exercise, result.diagnosis.text
    is_explained = (text and UNCHANGED not in text) or not exercise.kind.shows_values
    if is_explained or result.passed or any(call.result.error or call.result.timed_out for call in calls):
        return ""
    return sentence_on_branch(function, lambda: [exercise.call(function, call.arguments) for call in calls])


def _judge_calls(exercise, function, calls):
    errors = {"TimeUp" if call.result.timed_out else call.result.error for call in calls}
    may_be_none = any(call.expected.value == NONE for call in calls)  # an answer may end without return
    if not may_be_none and any(call.difference and call.result.value == NONE for call in calls):
        errors.add("None")
    is_stub = is_part_of(source_of(function), exercise.stub)  # False if its source is not known
    if "NotImplementedError" in errors or (is_stub and exercise.kind.expects_values):
        of_class = () if is_stub else (STUB_LINE,)
        remarks = of_class if isinstance(function, type) else tuple(remarks_on_source(function))
        return CheckResult(exercise, attempted=False, remarks=remarks)
    mistake, remarks = None, ()
    if not all(call.passed for call in calls):
        mistake = attempt(lambda: _explanation(exercise, function, calls), None, 5)
        remarks = attempt(lambda: remarks_on_source(function, errors, exercise.unheeded), ())
    remarks = tuple(text for text in remarks if len(text) < _LONGEST_REMARK)  # it may quote a table
    return judge(exercise, calls, mistake, remarks, attempted=not is_stub)


def _explanation(exercise, function, calls):
    """The known mistake, if the answer lacks what it advises, and warns of nothing else."""
    mistake = exercise.kind.known_mistake(exercise, calls)
    says = mistake.says if mistake else ""
    warned = "".join(call.result.warning for call in calls)
    overflows = "overflow" in warned and not re.search(r"overflow|int|25[56]", says)
    has_no_nan = "the mean nan" in says and not warned  # the mean of no values warns
    return None if overflows or has_no_nan or has_done(source_of(function), says) else mistake
