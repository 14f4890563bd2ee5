"""Stands for Pillow inside the sandbox, because matplotlib imports it. It computes nothing."""

from imgproc_course.classroom.autograder.sandbox.inside.refusal import Unusable


def __getattr__(name):
    if name.startswith("__"):
        raise AttributeError(name)
    return Unusable("PIL")
