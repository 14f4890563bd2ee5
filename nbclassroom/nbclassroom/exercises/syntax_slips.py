"""Sources that are Python but for a slip: a letter of a keyword, or characters that a word processor changes.

Only the standard library is imported: the process that reads notebooks loads this file.
"""

import ast
import difflib
import itertools
import keyword
import re

_MOST_CHARACTERS = 5_000  # of a source: each try reads all of it
_MOST_TRIES = 60
_UNPARSABLE = (SyntaxError, ValueError, RecursionError, MemoryError)
# What a keyboard writes, for what a chat, a word processor or a web page puts in its place.
_PLAIN = {
    **dict.fromkeys("\u201c\u201d\u201e\u201f\u2033\u00ab\u00bb", '"'),
    **dict.fromkeys("\u2018\u2019\u201a\u201b\u2032\u00b4", "'"),
    **dict.fromkeys("\u2010\u2011\u2012\u2013\u2014\u2015\u2212", "-"),
    **dict.fromkeys("\u00a0\u2002\u2003\u2007\u2009\u202f\u3000", " "),
    **dict.fromkeys("\u200b\u200c\u200d\u2060\ufeff\u00ad", ""),
    **{"\u00d7": "*", "\u00f7": "/", "\u2026": "...", "\u2264": "<=", "\u2265": ">=", "\u2260": "!="},
    # The wide forms of East Asian keyboards.
    **{chr(code): chr(code - 0xFEE0) for code in range(0xFF01, 0xFF5F) if not chr(code).isalnum()},
    **{"\u3001": ",", "\u3002": "."},
}
_PLAIN_BY_CODE = str.maketrans(_PLAIN)


def plain_character(character):
    """What a keyboard writes for a typographic character, "" for one that nobody sees; None if not known."""
    return _PLAIN.get(character)


def without_slip(source, error):
    """A source that does not parse, mended by one change in a line, and its ast.Module; or None."""
    if len(source) > _MOST_CHARACTERS:
        return None
    for candidate in itertools.islice(_candidates(source, error), _MOST_TRIES):
        try:
            return candidate, ast.parse(candidate)
        except _UNPARSABLE:
            continue
    return None


def _candidates(source, error):
    plain = source.translate(_PLAIN_BY_CODE)
    if plain != source:
        yield plain
    if isinstance(error, TabError):
        yield source.expandtabs(4)
        yield source.expandtabs(8)
    lines, number = source.split("\n"), (error.lineno or 1) - 1
    if number >= len(lines):
        return
    for line in _mended_lines(lines[number], error):
        yield "\n".join([*lines[:number], line, *lines[number + 1 :]])


def _mended_lines(line, error):
    """Lines with one space more or less, or with one word made a keyword, which it nearly is: `retrun`."""
    if isinstance(error, IndentationError):
        yield from (f" {line}", line[1:])
    elif "invalid syntax" in error.msg:
        for word in re.finditer(r"[A-Za-z]+", line):
            for name in difflib.get_close_matches(word[0], keyword.kwlist, n=2):
                yield line[: word.start()] + name + line[word.end() :]
