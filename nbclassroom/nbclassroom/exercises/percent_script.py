"""Read a master, a percent script: its cells with their roles and options.

jupytext is imported when the first master is read: the processes that grade import this package too, and
they read no master.
"""

import re
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from .. import course

ROLES = ("given", "exercise", "answer", "solution", "check", "case", "hidden", "mistake", "predict", "texts")
IN_WORDS = ("answer", "solution")  # roles whose cells may be Markdown, for answers that a person grades
DROPPED_ROLES = ("exercise", "solution", "case", "hidden", "mistake", "texts")  # what a learner does not get
MISTAKES_SUFFIX = ".mistakes.py"  # of the file beside a master that holds its known mistakes

_ROLE_HEADER = re.compile(r"# ?%%(?!%).*\brole=")
_UNREADABLE = "incorrectly_encoded_metadata"  # where jupytext puts a header that it cannot read


class MasterError(ValueError):
    """A master that cannot be read, or an unknown exercise; the message says where and what to do."""


@dataclass(frozen=True)
class ScriptCell:
    kind: str  # "markdown" or "code"
    role: str  # one of ROLES, or ""
    options: dict  # the other values of its header: {"points": 1}
    source: str
    line: int  # of its header, from 1; 0 without a role
    file: str

    @property
    def place(self):
        """The script and the line, for messages."""
        return f"{self.file}, line {self.line}" if self.line else self.file


@dataclass(frozen=True)
class Script:
    """A percent script: what its front matter says under `jupyter:` and the course's name, and its cells."""

    front_matter: dict
    cells: tuple


def read_script(path):
    """Read a Script, once if the file has not changed; MasterError for a header or role that is not known."""
    path = Path(path)
    return _read_script(path, path.stat().st_mtime_ns)


@lru_cache(maxsize=64)
def _read_script(path, _modified):
    import jupytext

    text = path.read_text(encoding="utf-8")
    notebook = jupytext.reads(text, fmt="py:percent")
    lines = text.splitlines()
    cells, position = [], 0
    for notebook_cell in notebook.cells:
        options, line = dict(notebook_cell.metadata), 0
        if _UNREADABLE in options:
            header = options[_UNREADABLE]
            line = next((number for number, text in enumerate(lines, 1) if text.endswith(header)), 0)
            raise MasterError(
                f"{path.name}, line {line}: cannot read the header {header!r}; write each value as JSON:"
                ' key="text", key=3, key=0.5, key=true or key=["a", "b"]'
            )
        role = options.pop("role", "")
        if role:
            headers = enumerate(lines[position:], position + 1)
            line = next(number for number, text in headers if _ROLE_HEADER.match(text))
            position = line + len(notebook_cell.source.splitlines())
        cell = ScriptCell(notebook_cell.cell_type, role, options, notebook_cell.source, line, path.name)
        _check_header(cell)
        cells.append(cell)
    return Script(notebook.metadata.get(course.name) or {}, tuple(cells))


def _check_header(cell):
    if cell.role and cell.role not in ROLES:
        raise MasterError(f"{cell.place}: role={cell.role!r}, expected one of {', '.join(ROLES)}")
    if cell.role and cell.role not in IN_WORDS and cell.kind != "code":
        raise MasterError(f"{cell.place}: a {cell.role} cell is a {cell.kind} cell; a role needs a code cell")
    for key, value in cell.options.items():
        if value is None and cell.role:
            raise MasterError(f'{cell.place}: {key} has no value; write {key}="text" or {key}=3')
