"""Without a teacher: a learner compares a written answer with a model answer, and ticks what it has."""

import contextlib
import json
import os
from pathlib import Path

from .... import course
from ...check_files import DAMAGED, SOLUTIONS, read_lesson_file, reading
from ...help_steps import Help
from ...progress import LAB_VARIABLE, TEST_VARIABLE, ExerciseProgress, note_progress, progress_of

_NOTHING_YET = (
    "Write your answer into its cell above, save the notebook (Ctrl+S), and run this cell again: then you see"
    " an answer to compare yours with, and what to look for."
)


class SelfAssessment(Help):
    """A model answer, and the lines of a rubric as boxes to tick; `print` gives the same as plain text."""

    def __init__(self, id, lines, model, more):
        super().__init__(f"{id}: one good answer", model, more=more)
        self.id, self.lines = id, lines

    def __repr__(self):
        ticks = progress_of(self.id).ticks or ()
        boxes = (f"{'☑' if k in ticks else '☐'} {line}" for k, line in enumerate(self.lines, 1))
        return "\n".join([super().__repr__(), *boxes])

    def _ipython_display_(self):
        from IPython.display import HTML, display  # only here: the processes that grade import this package

        display(HTML(self._repr_html_()), self.boxes())

    def boxes(self):
        """The boxes; each tick is kept at once."""
        import ipywidgets as widgets

        ticks, layout = progress_of(self.id).ticks or (), widgets.Layout(width="auto")
        boxes = [
            widgets.Checkbox(k in ticks, description=line, indent=False, layout=layout)
            for k, line in enumerate(self.lines, 1)
        ]

        def keep(_change):
            ticks = tuple(k for k, box in enumerate(boxes, 1) if box.value)
            note_progress(self.id, ExerciseProgress(ticks=ticks))

        for box in boxes:
            box.observe(keep, "value")
        return widgets.VBox(boxes)


def self_assessment(exercise):
    """What `check` shows of a written answer: a SelfAssessment once there is one, else Help."""
    path = exercise.master.parents[1] / SOLUTIONS / exercise.master.name
    if not _is_written(exercise):
        return Help(f"{exercise.id}: the saved notebook has no answer yet", _NOTHING_YET)
    if not path.is_file():
        return Help(f"{exercise.id}: your teacher has not released the answer to compare with yet.")
    with reading(path):
        entry = read_lesson_file(path)["solutions"][exercise.id]
        model = str(entry["code"]).strip()
        lines = [text if worth > 0 else f"{text} (a mistake)" for text, worth in entry["rubric"]]
    if progress_of(exercise.id).ticks is None:
        note_progress(exercise.id, ExerciseProgress(ticks=()))
    more = f"{exercise.another_way}\nWhat of this does your answer have? Tick it. Ticks give no points."
    return SelfAssessment(exercise.id, lines, model, more.strip())


def _is_written(exercise):
    """Whether the answer cell, as the notebook was saved last, holds more than it was handed out with."""
    path = Path.cwd() / Path(os.environ.get(LAB_VARIABLE, "")).name
    if TEST_VARIABLE in os.environ or not path.is_file():
        return False
    texts = []
    with contextlib.suppress(OSError, *DAMAGED):
        for cell in json.loads(path.read_bytes())["cells"]:
            mark = cell["metadata"].get(course.name, {}).get("exercise")
            if mark == exercise.id or cell.get("id") == f"answer-{exercise.id}":
                texts.append("".join(cell["source"]).strip())
    return any(text and text != exercise.stub.strip() for text in texts)
