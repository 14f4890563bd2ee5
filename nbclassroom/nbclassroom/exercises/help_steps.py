"""`hint` and `solution`: help in steps, for a learner who is stuck. Neither changes anything in grading."""

import json
import numbers

from .check_files import SOLUTIONS, find_check_file, read_lesson_file, reading
from .document import Code, Document, Paragraphs
from .progress import ExerciseProgress, note_progress, progress_of

TRIES = 3  # honest ones, before a solution opens


class Help(Document):
    """Help with an exercise: a heading of one line, sentences, each paragraph on a line, code, and more."""

    def __init__(self, heading, text="", code="", more=""):
        super().__init__(heading, (Paragraphs(text), Code(code), Paragraphs(more)), "help")


def hint(exercise_id: str, step: int | None = None) -> Help:
    """Show the next hint: first a question, then the steps in words, then nearly the code.

    Parameters
    ----------
    exercise_id : str, as the lesson names it: "grayscale-luma"
    step : int from 1, to see one hint again; the next one if omitted

    Returns
    -------
    Help, which a notebook shows

    Raises
    ------
    CheckFileError : there is no such exercise, or its file is missing or damaged
    """
    exercise = find_check_file(exercise_id).exercise(exercise_id)
    hints = exercise.hints
    quoted_id = json.dumps(exercise_id)
    if not hints:
        return Help(f"There are no hints for {exercise_id}.")
    if step is None:
        step = progress_of(exercise_id).hints + 1
        if step > len(hints):
            return Help(
                f"There are no more hints for {exercise_id}: you saw all {len(hints)}.",
                f"hint({quoted_id}, step=1) shows the first one again. solution({quoted_id}) shows how the"
                f" {exercise.kind.noun} can be written.",
            )
    if isinstance(step, bool) or not isinstance(step, numbers.Integral) or not 1 <= int(step) <= len(hints):
        return Help(f"{exercise_id} has the hints 1 to {len(hints)}.", f"Write hint({quoted_id}, step=1).")
    note_progress(exercise_id, ExerciseProgress(hints=int(step)))
    return Help(f"{exercise_id}: hint {step} of {len(hints)}", hints[step - 1])


def solution(exercise_id: str, give_up: bool = False) -> Help:
    """Show a solution with its explanation, after three honest tries or after a right answer.

    An honest try is a `check` of an answer of yours that runs and does not pass. The same answer counts once.

    Parameters
    ----------
    exercise_id : str, as the lesson names it: "grayscale-luma"
    give_up : bool, True: show it at once

    Returns
    -------
    Help, which a notebook shows

    Raises
    ------
    CheckFileError : there is no such exercise, or a file is missing or damaged
    """
    file = find_check_file(exercise_id)
    exercise = file.exercise(exercise_id)
    path = file.path.parents[1] / SOLUTIONS / file.path.name
    if not path.is_file():
        return Help(f"Your teacher has not released the solution of {exercise_id} yet.")
    if exercise.kind.graded_by_person and not give_up:
        return exercise.kind.look_at(exercise)
    progress = progress_of(exercise_id)
    if not (give_up or progress.passed or len(progress.tries) >= TRIES):
        quoted_id, count = json.dumps(exercise.id), len(progress.tries)
        so_far = {0: "no try", 1: "1 try"}.get(count, f"{count} tries")
        return Help(
            f"The solution of {exercise.id} opens after {TRIES} tries of your own: {so_far} so far.",
            f"A try is check({quoted_id}, {exercise.function}) with a changed {exercise.kind.noun} that runs"
            f" and does not pass yet. hint({quoted_id}) gives help."
            f" solution({quoted_id}, give_up=True) opens it now.",
        )
    with reading(path):
        entry = read_lesson_file(path)["solutions"][exercise_id]
        code, explanation = str(entry["code"]).strip(), str(entry["explanation"]).strip()
    another_way = f"What else could be right:\n{exercise.another_way}" if exercise.another_way else ""
    more = "\n".join(part for part in (explanation, another_way) if part)
    return Help(f"{exercise_id}: one solution", code=code, more=more)
