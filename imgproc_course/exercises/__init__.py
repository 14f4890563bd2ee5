"""What a lesson imports of the exercises: the names that `imgproc_course.classroom.exercises` lists."""

from imgproc_course.classroom.exercises import *  # noqa: F403
