"""What the doctor found, and how it shows itself: a table in a notebook and in a terminal."""

import html
import re
from dataclasses import dataclass

MARKS = {"ok": "✓", "warning": "!", "failure": "✗"}
HTML_COLOURS = {"ok": "#1a7f37", "warning": "#9a6700", "failure": "#cf222e"}
TERMINAL_COLOURS = {"ok": "green", "warning": "yellow", "failure": "bold red"}
# A path of two folders or more, but nothing of /dev and no topic of ours.
PATH = re.compile(
    r"(?<![\w./:])(?:[A-Za-z]:[\\/]|/(?!dev/|kachaka/|doctor_))(?:[^\s:'\"()\\/]+[\\/])+([^\s:'\"()\\/]*)"
)


@dataclass(frozen=True)
class Finding:
    """One thing that the doctor looked at.

    Attributes
    ----------
    name : what it is
    verdict : "ok", "warning" (may stay as it is) or "failure"
    saw, remedy : what is the case, and what to do about it; no path of this machine is in either
    """

    name: str
    verdict: str
    saw: str
    remedy: str = ""


def ok(name, saw):
    return Finding(name, "ok", _without_paths(saw))


def warning(name, saw, remedy):
    return Finding(name, "warning", _without_paths(saw), _without_paths(remedy))


def failure(name, saw, remedy):
    return Finding(name, "failure", _without_paths(saw), _without_paths(remedy))


def _without_paths(text):
    """One line, in which a path is its last part alone: the page may be stored in a lesson."""
    return PATH.sub(r"\1", " ".join(str(text).split()))


class Report:
    """What the doctor found: shows itself as a table, in a notebook and in a terminal.

    Attributes
    ----------
    findings : list of Finding
    ready : whether nothing failed; a warning is no failure
    """

    def __init__(self, findings):
        self.findings = list(findings)

    @property
    def ready(self):
        return all(finding.verdict != "failure" for finding in self.findings)

    @property
    def summary(self):
        failures, warnings = (
            sum(finding.verdict == verdict for finding in self.findings) for verdict in ("failure", "warning")
        )
        if failures:
            return f"{failures} of {len(self.findings)} failed: do what stands beside ✗, then ask again."
        return "Everything is ready." if not warnings else "Ready; what stands beside ! may stay as it is."

    def print(self, console=None):
        """Prints the table, in colours where the terminal has them."""
        from rich.console import Console
        from rich.table import Table
        from rich.text import Text

        table = Table("", "", "", box=None, show_header=False, pad_edge=False)
        for finding in self.findings:
            colour = TERMINAL_COLOURS[finding.verdict]
            said = Text(finding.saw)
            if finding.remedy:
                said.append(f"\n→ {finding.remedy}", style=colour)
            table.add_row(Text(MARKS[finding.verdict], style=colour), Text(finding.name), said)
        console = console or Console()
        console.print(table)
        console.print(Text(self.summary, style="bold"))

    def __str__(self):
        width = max((len(finding.name) for finding in self.findings), default=0)
        lines = []
        for finding in self.findings:
            lines.append(f"{MARKS[finding.verdict]} {finding.name:{width}}  {finding.saw}")
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
    cells = (mark, html.escape(finding.name), html.escape(finding.saw) + remedy)
    return "<tr>" + "".join(f'<td style="text-align:left">{cell}</td>' for cell in cells) + "</tr>"
