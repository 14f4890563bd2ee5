"""Text of a learner's made safe to look at: in a terminal, in a page, in a table."""

_FORMULA = ("=", "+", "-", "@", "\uff1d", "\uff0b", "\uff0d", "\uff20")


def visible(text, longest=300):
    """Text in which what a reader would not see stands as a visible escape.

    Control characters, lone surrogates and marks that turn the direction of writing around become `\\u202e`
    and the like; line ends and tabs stay. HTML is escaped where HTML is written.

    Parameters
    ----------
    text : str
    longest : int, characters that are kept

    Returns
    -------
    str, printable, encodable as UTF-8
    """
    text = text if len(text) <= longest else text[: longest - 1] + "…"
    return "".join(each if each in "\n\t" or each.isprintable() else _escape(each) for each in text)


def visible_line(text, longest=300):
    """The same in one line: line ends and tabs become escapes too."""
    return visible(text, longest).replace("\n", "\\n").replace("\t", "\\t")


def for_spreadsheet(text):
    """One line that no spreadsheet takes for a formula: an apostrophe stands before one that begins like it.

    Parameters
    ----------
    text : str, or a number, which stays as it is

    Returns
    -------
    str or the number
    """
    if isinstance(text, (int, float)):
        return text
    line = visible_line(text, 2000)
    return f"'{line}" if line.lstrip(" '\"").startswith(_FORMULA) or (text[:1] in "\t\r\n" and text) else line


def _escape(character):
    code = ord(character)
    return f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"
