# SPDX-FileCopyrightText: the imgproc-course contributors
# SPDX-License-Identifier: Apache-2.0
# You can copy this file alone.
"""The one exception of this package, and how its texts quote a value."""


class ConversionError(ValueError, TypeError):
    """A message or an array that cannot be converted; a TypeError too, as cv_bridge's own error.

    The text names the field, its value, what was expected, and what to do. A public function raises it
    without the inner calls in its traceback, since a notebook would show the source of each.
    """


def quoted(value, limit=60):
    """`repr` of a value from a message, shortened so that an error stays one readable line."""
    if isinstance(value, str | bytes | bytearray):
        text = repr(value[:limit])
        return text if len(value) <= limit else f"{text}… ({len(value)} in all)"
    if isinstance(value, int | float | bool | None):
        return repr(value) if not isinstance(value, int) or value.bit_length() < 200 else "a huge int"
    return f"a {type(value).__name__}"
