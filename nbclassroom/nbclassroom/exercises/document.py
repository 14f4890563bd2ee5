"""Feedback as blocks, which become plain text or the output of a notebook cell.

Both hold nothing that varies from run to run: no time, no address, no random order. nbval compares them byte
for byte.
"""

import html
import re
from dataclasses import dataclass
from itertools import chain, repeat
from typing import Any

# JupyterLab's colours that have a contrast of at least 4.5 in its light and in its dark theme.
COLOURS = {
    "passed": "var(--jp-success-color0, #1b5e20)",
    "failed": "var(--jp-error-color1, #c62828)",
    "open": "var(--jp-content-font-color2, #616161)",
    "help": "var(--jp-info-color1, #1976d2)",
}
_CODE = (
    "background: var(--jp-cell-editor-background, transparent); border: 1px solid"
    " var(--jp-border-color1, #9e9e9e); padding: 6px 10px; overflow-x: auto"
)
_CODE_SPAN = re.compile(r"`([^`]+)`")


@dataclass(frozen=True)
class Text:
    """A paragraph; a notebook keeps its lines."""

    text: str
    style: str = "white-space: pre-wrap"

    def plain(self):
        return self.text

    def html(self):
        return f'<div style="{self.style}">{html.escape(self.text)}</div>' if self.text else ""


@dataclass(frozen=True)
class Paragraphs:
    """A paragraph for each line, with code between backquotes."""

    text: str

    def plain(self):
        return self.text

    def html(self):
        style = "margin-top: 4px; white-space: pre-wrap"
        lines = [_CODE_SPAN.sub(r"<code>\1</code>", html.escape(line)) for line in self.text.splitlines()]
        return "".join(f'<div style="{style}">{line}</div>' for line in lines)


@dataclass(frozen=True)
class Code:
    """Python."""

    code: str

    def plain(self):
        return "\n".join(f"    {line}".rstrip() for line in self.code.splitlines())

    def html(self):
        return f'<pre style="{_CODE}" tabindex="0">{html.escape(self.code)}</pre>' if self.code else ""


@dataclass(frozen=True)
class Check:
    """The title of a check, and below it, indented, blocks on what went wrong."""

    title: str
    passed: bool
    blocks: tuple = ()

    def plain(self):
        blocks = "\n".join(filter(None, (block.plain() for block in self.blocks)))
        indented = [f"    {line}" for line in blocks.splitlines()]
        return "\n".join([f"{'✓' if self.passed else '✗'} {self.title}", *indented])

    def html(self):
        mark, colour = ("✓", COLOURS["passed"]) if self.passed else ("✗", COLOURS["failed"])
        line = f'<div><span style="color: {colour}">{mark}</span> {html.escape(self.title)}</div>'
        blocks = "".join(block.html() for block in self.blocks)
        return line if self.passed else f'{line}<div style="margin: 0 0 6px 18px">{blocks}</div>'


@dataclass(frozen=True)
class Table:
    """Rows of (text, whether it is marked) of each cell; with a head the first row is one."""

    rows: Any
    caption: str = ""
    has_head: bool = False

    def plain(self):
        width = max((len(text) for row in self.rows for text, _ in row), default=0) + 1
        lines = [
            "".join(f"{text:>{width}}{'*' if mark else ' '}" for text, mark in row).rstrip()
            for row in self.rows
        ]
        marks = ", * differs" if self._has_marks() else ""
        return "\n".join([f"{self.caption}{marks}", *lines] if self.caption else lines)

    def _has_marks(self):
        return any(mark for row in self.rows for _, mark in row)

    def html(self):
        marks = " (values that differ are framed)" if self._has_marks() else ""
        caption = f"<div>{html.escape(self.caption + marks)}</div>" if self.caption else ""
        return caption + self._table() if self.rows else caption

    def _table(self):
        plain = "padding: 1px 6px; text-align: right; white-space: nowrap; font-family: monospace"
        plain += "; border: 1px solid #9e9e9e"
        framed = f"{plain}; border: 2px solid {COLOURS['failed']}; font-weight: 700"
        lines, first = "", 'th scope="col"' if self.has_head else "td"
        for tag, row in zip(chain([first], repeat("td")), self.rows, strict=False):
            styled = [(framed if mark else plain, html.escape(text)) for text, mark in row]
            if tag.startswith("th"):  # a long name of a metric takes two lines
                styled = [(style.replace("nowrap", "normal"), text) for style, text in styled]
            cells = "".join(f'<{tag} style="{style}">{text}</{tag[:2]}>' for style, text in styled)
            lines += f"<tr>{cells}</tr>"
        table = f'<table style="border-collapse: collapse; margin: 2px 0 4px">{lines}</table>'
        return f'<div style="overflow-x: auto" tabindex="0">{table}</div>'


@dataclass(frozen=True)
class Figures:
    """AnswerImages in a row, and a text below them; `draw()` gives them. In plain text nothing."""

    draw: Any
    text: str = ""

    def plain(self):
        return ""

    def html(self):
        figures = "".join(map(_figure, self.draw()))
        flow = "display: flex; flex-wrap: wrap; gap: 10px; margin: 4px 0"
        return (f'<div style="{flow}">{figures}</div>' if figures else "") + Text(self.text).html()


def _figure(image):
    return (
        f'<figure style="margin: 0"><img src="{image.url}" alt="{html.escape(image.alt)}"'
        f' width="{image.width}" height="{image.height}"'
        ' style="max-width: 100%; height: auto; image-rendering: pixelated">'
        f"<figcaption>{html.escape(image.caption)}</figcaption></figure>"
    )


@dataclass(frozen=True)
class Document:
    """A heading, which ends with `end` in plain text, blocks, and the name of a colour in COLOURS."""

    heading: str
    blocks: tuple
    colour: str
    end: str = ""

    def plain(self):
        parts = (f"{self.heading}{self.end}", *(block.plain() for block in self.blocks))
        return "\n".join(filter(None, parts))

    def html(self):
        colour = COLOURS[self.colour]
        style = "font-weight: 600" + ("" if self.colour == "help" else f"; color: {colour}")
        heading = f'<div style="{style}">{html.escape(self.heading)}</div>'
        body = heading + "".join(block.html() for block in self.blocks)
        return f'<div style="border-left: 4px solid {colour}; padding: 4px 10px">{body}</div>'
