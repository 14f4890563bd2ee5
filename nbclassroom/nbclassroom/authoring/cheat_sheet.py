"""The cheat sheet: two pages to print, whose numbers are computed when the lessons are built.

`masters/cheat_sheet.html` is a Jinja template. `masters/cheat_sheet.py` defines the names of its examples. In
the template `run("tiny[2, 4]")` gives the value of a line of Python, so the page shows what it computes.
References such as [[arrays#2]] become plain text: JupyterLab shows the page in a frame, where a link would
open a lesson as raw JSON.
"""

import runpy

import jinja2

from ..exercises.percent_script import MasterError
from .references import References

CHEAT_SHEET = "cheat_sheet.html"


def cheat_sheet_page(template):
    """The HTML of a cheat sheet; the Python file beside the template defines the names of its examples."""
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    try:
        names = runpy.run_path(str(template.with_suffix(".py")))
        source = environment.from_string(template.read_text(encoding="utf-8"))
        page = source.render(names, run=lambda line: _value_of(line, names))
    except Exception as error:  # the examples are code of the template's author
        text = error if isinstance(error, MasterError) else f"{type(error).__name__}: {error}"
        raise MasterError(f"{template.name}: {text}") from error
    return References(template).in_text(f"{page}\n")


def _value_of(line, names):
    """The value of an expression; None after a statement."""
    try:
        try:
            code = compile(line, "example", "eval")
        except SyntaxError:
            code = compile(line, "example", "exec")
        return eval(code, names)
    except Exception as error:  # the line is code of the template's author
        raise MasterError(f"in {line!r}: {type(error).__name__}: {error}") from error
