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
_CODE_SPAN = re.compile(r"`([^`]+)`")
_CELL = "padding: 1px 6px; text-align: right; white-space: nowrap; font-family: monospace"
_CELL += "; border: 1px solid #9e9e9e"
_STYLES = {
    "text": "white-space: pre-wrap",
    "below": "margin-top: 4px",
    "paragraph": "margin-top: 4px; white-space: pre-wrap",
    "code": "background: var(--jp-cell-editor-background, transparent); border: 1px solid"
    " var(--jp-border-color1, #9e9e9e); padding: 6px 10px; overflow-x: auto",
    **{mark: f"color: {COLOURS[mark]}" for mark in ("passed", "failed", "open")},
    "details": "margin: 0 0 6px 18px",
    "scroll": "overflow-x: auto",
    "values": "border-collapse: collapse; margin: 2px 0 4px",
    "value": _CELL,
    "wrong value": f"{_CELL}; border: 2px solid {COLOURS['failed']}; font-weight: 700",
    "images": "display: flex; flex-wrap: wrap; gap: 10px; margin: 4px 0",
    "image": "margin: 0",
    "pixels": "max-width: 100%; height: auto; image-rendering: pixelated",
}
_STYLES |= {f"head {name}": _STYLES[name].replace("nowrap", "normal") for name in ("value", "wrong value")}


class Html:
    """How blocks become HTML: for the output of a cell, whose elements carry their styles."""

    def look(self, name):
        """The attribute that gives an element one of the looks in _STYLES."""
        return f'style="{_STYLES[name]}"'

    def text(self, text):
        return html.escape(text)


@dataclass(frozen=True)
class Text:
    """A paragraph; a notebook keeps its lines."""

    text: str
    look: str = "text"

    def plain(self):
        return self.text

    def html(self, out):
        return f"<div {out.look(self.look)}>{out.text(self.text)}</div>" if self.text else ""


class Paragraphs(Text):
    """A paragraph for each line, with code between backquotes."""

    def html(self, out):
        lines = [_CODE_SPAN.sub(r"<code>\1</code>", out.text(line)) for line in self.text.splitlines()]
        return "".join(f"<div {out.look('paragraph')}>{line}</div>" for line in lines)


@dataclass(frozen=True)
class Code:
    code: str

    def plain(self):
        return "\n".join(f"    {line}".rstrip() for line in self.code.splitlines())

    def html(self, out):
        return f'<pre {out.look("code")} tabindex="0">{out.text(self.code)}</pre>' if self.code else ""


@dataclass(frozen=True)
class Check:
    """The title of a check, with a note such as its points, and indented blocks on what went wrong."""

    title: str
    passed: bool
    blocks: tuple = ()
    note: str = ""
    is_open: bool = False  # neither right nor wrong

    def plain(self):
        blocks = "\n".join(filter(None, (block.plain() for block in self.blocks)))
        indented = [f"    {line}" for line in blocks.splitlines()]
        return "\n".join([f"{'✓' if self.passed else '✗'} {self.title}{self.note}", *indented])

    def html(self, out):
        mark, look = ("✓", "passed") if self.passed else ("○", "open") if self.is_open else ("✗", "failed")
        title = out.text(f"{self.title}{self.note}")
        line = f"<div><span {out.look(look)}>{mark}</span> {title}</div>"
        blocks = "".join(block.html(out) for block in self.blocks)
        return line if self.passed else f"{line}<div {out.look('details')}>{blocks}</div>"


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

    def html(self, out):
        marks = " (values that differ are framed)" if self._has_marks() else ""
        caption = f"<div>{out.text(self.caption + marks)}</div>" if self.caption else ""
        return caption + self._table(out) if self.rows else caption

    def _table(self, out):
        lines, first = "", 'th scope="col"' if self.has_head else "td"
        for tag, row in zip(chain([first], repeat("td")), self.rows, strict=False):
            head = "head " if tag.startswith("th") else ""  # a long name of a metric takes two lines
            cells = "".join(
                f"<{tag} {out.look(head + ('wrong value' if mark else 'value'))}>{out.text(text)}</{tag[:2]}>"
                for text, mark in row
            )
            lines += f"<tr>{cells}</tr>"
        return f'<div {out.look("scroll")} tabindex="0"><table {out.look("values")}>{lines}</table></div>'


@dataclass(frozen=True)
class Figures:
    """AnswerImages in a row, and a text below them; `draw()` gives them. In plain text nothing."""

    draw: Any
    text: str = ""

    def plain(self):
        return ""

    def html(self, out):
        figures = "".join(_figure(image, out) for image in self.draw())
        figures = f"<div {out.look('images')}>{figures}</div>" if figures else ""
        return figures + Text(self.text).html(out)


def _figure(image, out):
    return (
        f'<figure {out.look("image")}><img src="{image.url}" alt="{out.text(image.alt)}"'
        f' width="{image.width}" height="{image.height}"'
        f" {out.look('pixels')}>"
        f"<figcaption>{out.text(image.caption)}</figcaption></figure>"
    )


@dataclass(frozen=True)
class Document:
    """A heading, which ends with `end` in plain text, blocks, and the name of a colour in COLOURS.

    A notebook shows it as HTML; `print` gives the same as plain text.
    """

    heading: str
    blocks: tuple
    colour: str
    end: str = ""

    def __repr__(self):
        parts = (f"{self.heading}{self.end}", *(block.plain() for block in self.blocks))
        return "\n".join(filter(None, parts))

    def _repr_html_(self):
        colour, out = COLOURS[self.colour], Html()
        style = "font-weight: 600" + ("" if self.colour == "help" else f"; color: {colour}")
        heading = f'<div style="{style}">{out.text(self.heading)}</div>'
        body = heading + "".join(block.html(out) for block in self.blocks)
        return f'<div style="border-left: 4px solid {colour}; padding: 4px 10px">{body}</div>'
