"""An exercise as a notebook, which nbval grades: given cells, the answer, and one check cell for each case.

The stored outputs of the check cells are the values of the answer key.
"""

from .sandbox.inside.answer_mime import MIME

_KERNEL = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}


def notebook_of(exercise, answer):
    """The notebook of a key's Exercise with an answer, plain data of nbformat 4."""
    given = [(f"given-{exercise.id}-{number}", source) for number, source in enumerate(exercise.given, 1)]
    before = [*given, (f"answer-{exercise.id}", answer)]
    cells = [_cell(*parts, ["nbval-ignore-output", "nbval-raises-exception"]) for parts in before]
    check = exercise.kind.check_source(exercise)
    cells += [_cell(case.id, check, [], _stored_outputs(case)) for case in exercise.cases]
    for count, cell in enumerate(cells, 1):
        cell["execution_count"] = count  # nbval never compares a cell without one
    return {"cells": cells, "metadata": {"kernelspec": _KERNEL}, "nbformat": 4, "nbformat_minor": 5}


def _cell(id, source, tags, outputs=()):
    """A code cell; nbval never compares one that is run only for what it defines, by its tags."""
    about = {"cell_type": "code", "id": id, "metadata": {"tags": tags}}
    return about | {"source": source, "outputs": list(outputs)}


def _stored_outputs(case):
    """The output of a check cell, as the solution's; nothing of a drive, which thresholds judge."""
    values = [call.result.value for call in case.calls]
    calls = [{"changed": [], "printed": "", "value": value} for value in values if value is not None]
    return [{"output_type": "display_data", "metadata": {}, "data": {MIME: {"calls": calls}}}]
