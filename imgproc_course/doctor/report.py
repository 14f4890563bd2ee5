"""The doctor's report: a table in a notebook and in a terminal."""

import html
import re
from dataclasses import dataclass
from functools import partial

MARKS = {"ok": "✓", "warning": "!", "failure": "✗"}
# JupyterLab's colours that have a contrast of at least 4.5 in its light and in its dark theme.
HTML_COLOURS = {
    "ok": "var(--jp-success-color0, #1b5e20)",
    "warning": "var(--jp-content-font-color1, inherit)",
    "failure": "var(--jp-error-color1, #c62828)",
}
TERMINAL_COLOURS = {"ok": "green", "warning": "yellow", "failure": "bold red"}
# A path of two or more folders, except those in /dev and the topics of the course.
PATH = re.compile(
    r"(?<![\w./:])(?:[A-Za-z]:[\\/]|/(?!dev/|kachaka/|doctor_))(?:[^\s:'\"()\\/]+[\\/])+([^\s:'\"()\\/]*)"
)


@dataclass(frozen=True)
class Finding:
    """What one check of the doctor found; its texts contain no path of this machine."""

    name: str
    verdict: str  # "ok", "warning" (the lessons work all the same) or "failure"
    observation: str
    remedy: str = ""


def _finding(verdict, name, *texts):
    """A Finding; of each path only the last part stays: the report may be stored in a lesson."""
    return Finding(name, verdict, *(PATH.sub(r"\1", " ".join(str(text).split())) for text in texts))


# Functions of the name, the observation and, if not all is well, the remedy.
ok, warning, failure = (partial(_finding, verdict) for verdict in MARKS)


def failure_of(name, problem, remedy=""):
    """The failure that a text "observation; remedy" tells; it may leave out the remedy."""
    observation, _, own_remedy = str(problem).partition("; ")
    return failure(name, observation, own_remedy or remedy)


class Report:
    """All findings of the doctor, shown as a table in a notebook and in a terminal."""

    def __init__(self, findings):
        self.findings = list(findings)

    @property
    def ready(self):
        """Whether nothing failed; a warning is not a failure."""
        return all(finding.verdict != "failure" for finding in self.findings)

    @property
    def summary(self):
        verdicts = [finding.verdict for finding in self.findings]
        if not self.ready:
            count = f"{verdicts.count('failure')} of {len(verdicts)} failed"
            return f"{count}: follow the remedy beside each ✗, then run the doctor again."
        return "Ready. You can ignore the lines with !." if "warning" in verdicts else "Everything is ready."

    def print(self, console=None):
        """Prints the table, in colours where the terminal has them."""
        from rich.console import Console
        from rich.table import Table
        from rich.text import Text

        table = Table("", "", "", box=None, show_header=False, pad_edge=False)
        for finding in self.findings:
            colour = TERMINAL_COLOURS[finding.verdict]
            text = Text(finding.observation)
            if finding.remedy:
                text.append(f"\n→ {finding.remedy}", style=colour)
            table.add_row(Text(MARKS[finding.verdict], style=colour), Text(finding.name), text)
        console = console or Console()
        console.print(table)
        console.print(Text(self.summary, style="bold"))

    def __str__(self):
        width = max((len(finding.name) for finding in self.findings), default=0)
        lines = []
        for finding in self.findings:
            lines.append(f"{MARKS[finding.verdict]} {finding.name:{width}}  {finding.observation}")
            if finding.remedy:
                lines.append(f"  {'':{width}}  → {finding.remedy}")
        return "\n".join([*lines, self.summary])

    __repr__ = __str__

    def _repr_html_(self):
        rows = "".join(_html_row(finding) for finding in self.findings)
        return f"<table>{rows}</table><p><b>{html.escape(self.summary)}</b></p>"


def _html_row(finding):
    verdict = finding.verdict
    mark = f'<b style="color:{HTML_COLOURS[verdict]}" title="{verdict}">{MARKS[verdict]}</b>'
    remedy = f"<br><b>→ {html.escape(finding.remedy)}</b>" if finding.remedy else ""
    cells = (mark, html.escape(finding.name), html.escape(finding.observation) + remedy)
    return "<tr>" + "".join(f'<td style="text-align:left">{cell}</td>' for cell in cells) + "</tr>"
