"""Replaces `imgproc_course.exercises` and `imgproc_course.display` inside the sandbox.

An answer cell may check itself, ask for hints and show images, and nobody looks here.
"""


def __getattr__(name):
    if name.startswith("__"):
        raise AttributeError(name)
    return lambda *_arguments, **_options: None
