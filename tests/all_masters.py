"""The masters of every lesson, read once in a process, and not while pytest collects the tests."""

from functools import cache
from pathlib import Path

from nbclassroom.authoring.masters import find_masters, read_master

PATHS = find_masters(Path(__file__).parents[1] / "notebooks" / "masters")


@cache
def all_masters():
    """{name of a lesson: Master}, in their order."""
    return {master.name: master for master in map(read_master, PATHS)}


@cache
def all_exercises():
    """{id: Exercise} of every lesson."""
    return {exercise.id: exercise for master in all_masters().values() for exercise in master.exercises}
