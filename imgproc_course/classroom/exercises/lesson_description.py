"""What a submission of a lesson must contain: a description made from an answer key or from a checks file."""

from dataclasses import dataclass

from imgproc_course.classroom.exercises.cell_syntax import bound_names


@dataclass(frozen=True)
class ExerciseDescription:
    """One exercise: its id, the function to write, the stub in its answer cell, its given cells' sources."""

    id: str
    function: str
    stub: str
    given: tuple = ()

    @property
    def answer_id(self):
        """The id of its answer cell."""
        return f"answer-{self.id}"

    @property
    def given_names(self):
        """The names that an answer has without defining them, as a set."""
        return {"np"}.union(*map(bound_names, self.given))


@dataclass(frozen=True)
class LessonDescription:
    """A lesson as it was handed out.

    version    of the course that the lesson was made from
    exercises  tuple of ExerciseDescription
    cells      {cell id: source of a check or given cell, None for the others}; empty if unknown
    """

    name: str
    version: str
    exercises: tuple
    cells: dict

    @classmethod
    def from_key(cls, lesson, cells):
        """The description of a KeyLesson; `cells` as in `LessonDescription`."""
        exercises = tuple(
            ExerciseDescription(exercise.id, exercise.function, exercise.stub, exercise.given)
            for exercise in lesson.exercises
        )
        return cls(lesson.name, lesson.version, exercises, cells)
