"""Docstrings as reStructuredText: sections become lists, `name` becomes code, the rest is plain text."""

import re

SECTIONS = ("Parameters", "Attributes", "Returns", "Raises", "Yields")
ITEM = re.compile(r"\s*(?:- )?([^:.;()]{1,60}|\([^)]*\)[^:]{0,40}) : (.*)")


def plain(text):
    """Text in which a bar and a star mean themselves, but for an *emphasized* word."""
    text = re.sub(r"(?<!`)`([^`]+)`(?!`)", r"``\1``", text)
    parts = re.split(r"(``.*?``)", text)
    parts[::2] = [re.sub(r"(\*\w+\*)|([|*])", lambda m: m[1] or f"\\{m[2]}", part) for part in parts[::2]]
    return "".join(parts)


def section_lines(title, body):
    """A section's entries as a list; what is no entry continues the one before."""
    items = []
    for line in body:
        found = ITEM.fullmatch(line)
        if found:
            items.append(f"**{plain(found[1])}** : {plain(found[2])}")
        elif items:
            items[-1] += f" {plain(line.strip())}"
        else:
            items.append(plain(line.strip()))
    return ["", f"*{title}*", "", *(f"- {item}" for item in items), ""]


def is_section(lines, number):
    dashes = lines[number + 1] if number + 1 < len(lines) else ""
    return lines[number] in SECTIONS and dashes and not dashes.strip("-")


def as_lists(app, what, name, obj, options, lines):
    """Rewrites the lines of a docstring in place."""
    given, number, is_code = list(lines), 0, False
    lines.clear()
    while number < len(given):
        line = given[number]
        if is_section(given, number):
            end = number + 2
            while end < len(given) and given[end] and not is_section(given, end):
                end += 1
            lines += section_lines(line, given[number + 2 : end])
            number = end
            continue
        is_code = is_code and (not line or line[0].isspace())
        lines.append(line if is_code else plain(line))
        is_code = is_code or line.endswith("::")
        number += 1


def skip_fields(app, what, name, obj, skip, options):
    """Leaves out the fields of a named tuple, whose docstring Python writes: the class describes them."""
    return True if str(getattr(obj, "__doc__", "")).startswith("Alias for field") else None


def setup(app):
    app.connect("autodoc-process-docstring", as_lists)
    app.connect("autodoc-skip-member", skip_fields)
    return {"parallel_read_safe": True}
