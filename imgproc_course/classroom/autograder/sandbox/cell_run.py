"""What running one cell did, built from the messages of a kernel. A kernel's messages may be forged."""

from dataclasses import dataclass, field

from imgproc_course.classroom.autograder.sandbox.inside.answer_mime import MIME

_MAX_TEXT = 2_000  # characters of an error's text, and of what a cell printed, that are kept
_MAX_NAME = 100  # characters of an exception's name


@dataclass
class CellRun:
    """What running one cell did.

    ended     "" if the cell ran to its end; else "time", "memory", "output", "crashed" or "hostile", as in
              Outcome; or "gone" if the process that forks kernels was ended
    answers   what check cells showed: the data of our MIME type
    error     type and text of the exception that ended the cell, ("", "") if there was none
    printed   the first part of what it printed
    """

    ended: str = ""
    answers: list = field(default_factory=list)
    error: tuple = ("", "")
    printed: str = ""

    def add(self, kind, content):
        """Add a message of a kernel; returns whether it was the cell's end."""
        if kind == "idle":
            if not self.error[0]:  # a cell can fail without showing an error: an unknown magic
                self._set_error(content)
            return True
        if kind == "stream" and len(self.printed) < _MAX_TEXT:
            self.printed = (self.printed + content["text"])[:_MAX_TEXT]
        elif kind == "error" and not self.error[0]:  # of several statements, the first that fails is reported
            self._set_error(content)
        elif MIME in content.get("data", ()):
            self.answers.append(content["data"][MIME])
        return False

    def _set_error(self, content):
        self.error = (content["ename"][:_MAX_NAME], content["evalue"][:_MAX_TEXT])
