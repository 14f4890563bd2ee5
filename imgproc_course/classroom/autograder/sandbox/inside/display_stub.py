"""Replaces `imgproc_course.display` inside the sandbox: an answer may show images, and nobody looks here."""


def __getattr__(name):
    if name.startswith("__"):
        raise AttributeError(name)
    return _show_nothing


def _show_nothing(*_arguments, **_options):
    """Show nothing, whatever it is."""
