"""Make text that a learner wrote safe to read in a terminal, on a page and in a table.

One rule holds everywhere: a character that a reader would not see is escaped. It is never dropped, because a
hidden character may be the very thing that the reader must know. HTML is escaped where HTML is written.
"""

import re

_ADDRESS = re.compile(r"0x[0-9a-fA-F]{6,}")
_MOST_READ = 4  # characters that are read of a text, for each one that is kept
_FORMULA_STARTS = ("=", "+", "-", "@", "\uff1d", "\uff0b", "\uff0d", "\uff20")
_AFTER_SEMICOLON = re.compile(rf"(;[ '\"]*)(?=[{re.escape(''.join(_FORMULA_STARTS))}])")


def sanitize_text(text, max_length=300):
    """Shorten a text and make its invisible characters visible: printable, and it can be encoded as UTF-8.

    Control characters (the start of a terminal's escape sequence too), lone surrogates and marks that change
    the direction of writing become `\\u202e` and the like. Line ends and tabs stay.
    """
    text = text if len(text) <= max_length else text[: max_length - 1] + "…"
    if text.isprintable():  # nearly every text
        return text
    escapes = {
        character: f"\\u{ord(character):04x}" if ord(character) < 0x10000 else f"\\U{ord(character):08x}"
        for character in set(text)
        if character not in "\n\t" and not character.isprintable()
    }
    return text.translate(str.maketrans(escapes))


def reproducible_text(text, max_length=500):
    """Sanitized text of a learner's without addresses, which differ from run to run."""
    return sanitize_text(_ADDRESS.sub("0x…", text[: _MOST_READ * max_length]), max_length)


def sanitize_line(text, max_length=300):
    """Do the same as `sanitize_text`, and escape line ends and tabs too: the result is one line."""
    return sanitize_text(text, max_length).replace("\n", "\\n").replace("\t", "\\t")


def spreadsheet_text(value):
    """One line that is no formula and no comment (#), by an apostrophe before it; a number is unchanged."""
    if isinstance(value, (int, float)):
        return value
    line = without_formulas(sanitize_line(value, 2000))
    is_hidden = value.startswith(("\t", "\r", "\n")) and not line.startswith("'")
    return f"'{line}" if is_hidden or value.lstrip(" '").startswith("#") else line


def without_formulas(text):
    """The text with an apostrophe before each part that a spreadsheet would take for a formula."""
    # A spreadsheet that separates cells by semicolons takes what follows one for a cell.
    text = _AFTER_SEMICOLON.sub(r"\1'", text)
    return f"'{text}" if text.lstrip(" '\"\t\r\n").startswith(_FORMULA_STARTS) else text
