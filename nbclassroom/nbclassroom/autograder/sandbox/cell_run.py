"""What running one cell did, built from the messages of a kernel. A kernel's messages may be forged."""

from dataclasses import dataclass, field

from nbclassroom.autograder.sandbox.inside import MIME

_MAX_TEXT = 2_000  # characters of an error's text that are kept
_MAX_NAME = 100  # characters of an exception's name


@dataclass
class CellRun:
    # "" if it ran to its end; else "time", "memory", "output", "crashed" or "hostile", as in Outcome; or
    # "gone" if the process that forks kernels was ended.
    ended: str = ""
    answers: list = field(default_factory=list)  # what check cells showed: the data of our MIME type
    error: tuple = ("", "")  # type and text of the exception that ended the cell
    errors: list = field(default_factory=list)  # of a page: (number of a cell, type, text) of a statement
    place: tuple = ()  # of a page that did not come to its end: (cell, statement) that ran last
    tried: list = field(default_factory=list)  # (number of a cell or None, what its code tried)
    status: dict = field(default_factory=dict)  # of a process that was forked: how it ended

    def add(self, kind, content):
        """Add a message; returns whether it ended the cell. ValueError, TypeError, KeyError: it is none."""
        if kind == "idle":
            self.error = (_text(content["ename"])[:_MAX_NAME], _text(content["evalue"]))
        elif kind == "display_data":
            data = dict(content["data"])
            self.answers += [data[MIME]] if MIME in data else []
        elif kind == "tried":
            cell = content["cell"]
            self.tried.append((None if cell is None else _number(cell), _text(content["text"])))
        elif kind == "errors":
            errors = content["errors"]
            self.errors = [(_number(cell), _text(name), _text(text)) for cell, name, text in errors]
        elif kind == "ended":
            self.status = {name: float(content[name]) for name in ("signal", "code", "cpu")}
        else:
            raise ValueError(f"a message of the kind {kind!r}")
        return kind == "idle"


def _number(value):
    if type(value) is not int or value < 0:
        raise ValueError(f"expected the number of a cell, got {str(value)[:20]}")
    return value


def _text(value):
    if not isinstance(value, str):
        raise TypeError(f"expected a text, got {type(value).__name__}")
    return value[:_MAX_TEXT]
