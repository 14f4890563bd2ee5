"""The cheat sheet: two pages to print, whose numbers are computed when the lessons are built.

`masters/cheat_sheet.html` is a Jinja template. `masters/cheat_sheet.py` defines the names of its examples. In
the template `run("tiny[2, 4]")` gives the value of a line of Python, so the page shows what it computes.
References such as [[arrays#2]] become plain text: JupyterLab shows the page in a frame, where a link would
open a lesson as raw JSON.

    python -m nbclassroom.authoring.cheat_sheet TEMPLATE

prints the page, with unresolved references.
"""

import re
import runpy
import subprocess
import sys
from pathlib import Path

import jinja2

from ..exercises.percent_script import MasterError
from .references import References

CHEAT_SHEET = "cheat_sheet.html"
_EXAMPLE = re.compile(r'File "example: ([^"]*)", line 1')


def cheat_sheet_page(template):
    """The HTML of a cheat sheet; the Python file beside the template defines the names of its examples."""
    # In a process of its own: the examples are code of the template's author.
    command = [sys.executable, "-m", __name__, str(template)]
    process = subprocess.run(command, capture_output=True, encoding="utf-8")
    if process.returncode:
        examples = _EXAMPLE.findall(process.stderr)
        error = (process.stderr.strip().splitlines() or [f"exit code {process.returncode}"])[-1]
        raise MasterError(f"{template.name}: {f'in {examples[-1]!r}: ' if examples else ''}{error}")
    return References(template).in_text(process.stdout)


def render(template):
    """The page of a template, in which references are not resolved yet."""
    names = runpy.run_path(str(template.with_suffix(".py")))

    def run(line):
        """The value of an expression; None after a statement."""
        try:
            code = compile(line, f"example: {line}", "eval")
        except SyntaxError:
            code = compile(line, f"example: {line}", "exec")
        return eval(code, names)

    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    return environment.from_string(template.read_text(encoding="utf-8")).render(names, run=run) + "\n"


if __name__ == "__main__":
    sys.stdout.reconfigure(encoding="utf-8")
    print(render(Path(sys.argv[1])), end="")
