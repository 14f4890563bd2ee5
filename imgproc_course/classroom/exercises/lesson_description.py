"""What a submission of a lesson must contain."""

from dataclasses import dataclass


@dataclass(frozen=True)
class LessonDescription:
    """A lesson as it was handed out, from an answer key or from a checks file.

    version    of the course that the lesson was made from
    exercises  tuple of KeyExercise or CheckData
    cells      {cell id: source of a check or given cell, None for the others}; empty if unknown
    """

    name: str
    version: str
    exercises: tuple
    cells: dict
