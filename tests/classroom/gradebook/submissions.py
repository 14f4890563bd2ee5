"""Submissions made from masters: notebooks as JupyterLab saves them, with chosen answers."""

import json
import os
import random
import sys
import zipfile
from datetime import datetime
from pathlib import Path

sys.path.append(str(Path(__file__).parents[2]))
from master_answers import sample_answers

MASTERS = Path(__file__).parent / "masters"
SEED = "a-secret-of-the-tests"
VERSION = "0.1.0"


def notebook(master, answers=None, *, version=VERSION):
    """A lesson as it was handed out, its answer cells changed; a dict of nbformat 4.5."""
    answers = answers or {}
    cells = [_cell(cell, answers.get(cell.exercise)) for cell in master.cells]
    about = {"lesson": master.name, "version": version}
    kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    metadata = {"imgproc_course": about, "kernelspec": kernel}
    return {"nbformat": 4, "nbformat_minor": 5, "metadata": metadata, "cells": cells}


def _cell(cell, answer):
    source = answer if cell.role == "answer" and answer is not None else cell.source
    made = {"id": cell.id, "cell_type": cell.kind, "metadata": {}, "source": source}
    return made | ({"outputs": [], "execution_count": None} if cell.kind == "code" else {})


def answers_of(master, kind):
    """Answers to every graded exercise: "right", "untouched", "raising", or the n-th known mistake."""
    chosen = {}
    for declared in master.exercises:
        samples = sample_answers(declared)
        wrong = sorted(set(samples) - {"right", "untouched"})
        if kind == "raising":
            chosen[declared.id] = f"def {declared.function}(*values):\n    raise ValueError('not today')"
        else:
            wrong = wrong or ["untouched"]  # a node has no known mistakes
            chosen[declared.id] = samples[kind if isinstance(kind, str) else wrong[kind % len(wrong)]]
    return chosen


def cell_of(made, id):
    """The first cell of that id."""
    return next(cell for cell in made["cells"] if cell["id"] == id)


def write(path, made, when=None):
    """Write a notebook (a dict, a text or bytes), and set the time of its submission."""
    path.parent.mkdir(parents=True, exist_ok=True)
    data = json.dumps(made).encode() if isinstance(made, dict) else made
    path.write_bytes(data.encode("utf-8") if isinstance(data, str) else data)
    moment = (when or datetime(2026, 11, 30, 12, 0)).timestamp()
    os.utime(path, (moment, moment))
    return path


def make_zip(path, members, when=datetime(2026, 11, 30, 12), modified=datetime(2026, 12, 24, 18)):
    """Write a zip of (name, data) members, each of the date `when`; the date of the zip is `modified`."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in members:
            archive.writestr(zipfile.ZipInfo(name, when.timetuple()[:6]), data, zipfile.ZIP_DEFLATED)
    os.utime(path, (modified.timestamp(), modified.timestamp()))
    return path


BROKEN = [
    b"{",
    b"",
    b"\xff\xfe{\x00}\x00",
    b'{"nbformat": 3, "nbformat_minor": 0, "metadata": {}, "worksheets": []}',
    b'{"nbformat": 5, "nbformat_minor": 0, "metadata": {}, "cells": []}',
    b"[" * 200_000,
]


def thirty(folder, masters, seed=7):
    """Write thirty submissions, of right, wrong, untouched, raising and broken ones in turn.

    Returns
    -------
    list of (learner, lesson, kind, points expected or None)
    """
    chance, written = random.Random(seed), []
    for number in range(30):
        master = masters[number % len(masters)]
        kind = ["right", 0, "untouched", "raising", 1, "broken", "right"][number % 7]
        learner = f"learner {number:02d}"
        made = (
            BROKEN[chance.randrange(len(BROKEN))]
            if kind == "broken"
            else notebook(master, answers_of(master, kind))
        )
        write(folder / learner / f"{master.name}.ipynb", made, datetime(2026, 11, 1 + number % 28, 9, number))
        written.append((learner, master.name, kind))
    return written
