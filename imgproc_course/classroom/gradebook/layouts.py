"""Whose a file is: the layout of the folder of submissions names the learner of every notebook in it.

A layout is a row of LAYOUTS, or a pattern that the teacher gives. In a pattern, {learner} and {group} are
names of folders, zips or files, {lesson} is the name of a lesson, * is any text in a name, and ** any folders
and files. A zip counts as a folder. A pattern that ends with {learner} means their folder, zip or notebook.

One layout holds for the whole folder. Marks that a platform writes come before a form that people write too,
and this before names alone, of which none may have a platform's marks. If several of these fit, one must
remain that leaves no learner two files named after one lesson and has several learners in some group.
Otherwise nobody knows, and nothing is graded.
"""

import re
from dataclasses import dataclass
from functools import lru_cache
from itertools import chain
from pathlib import PurePosixPath
from string import Formatter

from ..authoring.lesson_names import (
    lesson_name,
    lessons_named,
    name_in_stem,
    notebook_name,
    split_repetition,
    without_copy_words,
)
from ..autograder.sanitize import sanitize_line
from .archives import IN_DOUBT, CollectError

_MOST_LISTED = 20  # files, in the list of what is in doubt
_NAME_THEM = 'Put each learner\'s name into the name of a folder or a file, such as "Ada - FILE.ipynb".'
_FIELDS = {
    "learner": r"[^/]+?",
    "team": r"Team \d+",
    "anonymous": r"anon_[^/_]+",
    "last": r"[^/_]+",
    "first": r"[^/_]+",
    "login": r"[^/]+?",
    "id": r"\d{1,20}",  # the platform's number of a person
    "number": r"\d{1,18}",  # of an upload
    "late": r"(?:LATE_)?",
}
_NAMES = ("learner", "team", "anonymous", "last")  # a pattern has one of these
_WILD = {"**/": r"(?:[^/]+/)*?", "**": r".*", "*": r"[^/]*", "/": r"(?:\.zip)?/"}


@dataclass(frozen=True)
class Layout:
    """A form of folders: the first of its patterns that fits a path names the learner.

    name      what `--layout` takes; of a layout that no platform made it is the pattern
    platform  whose numbers of people are in the names, for tables and exports, or ""
    versions  what orders the files of one lesson: "date", "upload" (its number), "copy" (the number in "(1)")
    """

    name: str
    patterns: tuple
    platform: str = ""
    versions: str = "copy"


def _in_groups(*several):
    """Layouts of these patterns, named after the last one of each, in no, one or two folders of groups."""
    return tuple(
        Layout(group + patterns[-1], tuple(group + pattern for pattern in patterns))
        for group in ("", "{group}/", "{group}/{group}/")
        for patterns in several
    )


_MOODLE = (
    "**/{learner}_{id}_assignsubmission_**",
    "**/{learner}_assignsubmission_**",  # the team of those who are in none
)
_CANVAS = (
    *("**/{late}{anonymous}_{number}_**", "**/{learner}_{late}{id}_{number}_**"),
    "**/{learner}_{late}{id}_*.html",  # what was typed into the platform
)
_ILIAS = ("**/Abgaben/{team}/**", "**/Submissions/{team}/**", "**/{last}_{first}_{login}_{id}/**")
_PARENTS = ("submitted", "Abgaben", "Submissions")  # folders of platforms that can be given themselves
LAYOUTS = (
    (
        Layout("Moodle", _MOODLE, "moodle", "date"),
        Layout("Canvas", _CANVAS, "canvas", "upload"),
        Layout("ILIAS", _ILIAS),
        Layout("nbgrader", ("**/submitted/{learner}/*/**", "**/{learner}+*+* UTC*/**")),
    ),
    _in_groups(("{learner} - {lesson}*.ipynb", "{learner} - *.ipynb"), ("* - {learner}.ipynb",)),  # Google's
    _in_groups(("{learner}",)),
)


@dataclass(kw_only=True)
class Sender:
    """Who sent a file, as its path says.

    place    the path of what the learner's name is in, "" or with "/" at its end
    version  (a text that versions of one file share, the number of this one), or () if dates order them
    """

    learner: str = ""
    place: str = ""
    platform: str = ""
    platform_id: str = ""
    late: bool = False
    version: tuple = ()


class FolderLayout:
    """The `layouts` of a folder of this name, for the names of some lessons; `choose` sets them.

    A path has "/" between its parts, and at its end if it is a folder or a zip that cannot be read.
    """

    def __init__(self, name, lessons):
        self._parent = f"{name}/" if name in _PARENTS else ""
        self._lessons = tuple(lessons)
        self.layouts = ()

    def choose(self, paths, given=()):
        """Choose those `given` by name or pattern, or else the one that fits the paths of all notebooks.

        ValueError: what is given is no layout. CollectError, with a list: nobody knows whose the files are.
        """
        self.layouts = sorted(map(_layout_named, given), key=lambda layout: layout not in LAYOUTS[0])
        every = self.layouts or chain(*LAYOUTS)
        readings = {layout: [self._sender(path, layout) for path in paths] for layout in every}
        for layouts in () if given else LAYOUTS[: 1 if _have_marks(readings) else None]:
            fitting = {layout: readings[layout] for layout in layouts if None not in readings[layout]}
            if fitting:
                self.layouts = [self._only_one(paths, fitting)]
                return
        needed, rest = {}, range(len(paths))  # {layout: indices of the paths that it is the first to read}
        for layout, senders in readings.items():
            needed[layout] = [index for index in rest if senders[index]]
            rest = [index for index in rest if not senders[index]]
        needed = self.layouts or [layout for layout, indices in needed.items() if indices]
        fitting = self.layouts or needed[:1]
        unknown = [
            path
            for path, *several in zip(paths, *map(readings.get, fitting), strict=True)
            if not any(several)
        ]
        if unknown:
            text = "nothing says whose these are"
            if fitting:
                text += f"; {len(paths) - len(unknown)} others fit {_options(fitting, ' ')}"
            remedy = f"Move or rename them, or give a layout for them, too: {_options(needed, ' ')}."
            raise doubt(text, map(shown, unknown), remedy if needed else _NAME_THEM)

    def sender_of(self, path):
        """The Sender of a file, or None if its path names nobody."""
        return _first(self._sender(path, layout) for layout in self.layouts)

    def _sender(self, path, layout):
        parent = self._parent if layout in LAYOUTS[0] else ""
        folder, slash, name = f"{parent}{path}".rpartition("/")
        path = folder + slash + notebook_name(name)
        match = _first(_expression(pattern, self._lessons).fullmatch(path) for pattern in layout.patterns)
        if match is None:
            return None
        fields = dict.fromkeys(_FIELDS, "") | match.groupdict()
        start, end = match.span(next(name for name in _NAMES if fields[name]))
        learner = path[start:end]
        if not layout.platform:
            learner = without_copy_words(learner)
        if fields["first"]:
            learner = f"{fields['first']} {learner}"
        elif not layout.platform and path[end:].startswith("/"):
            learner = "" if lesson_name(learner) in self._lessons else learner
        elif not layout.platform:
            learner = name_in_stem(learner, self._lessons)
        place = path[: path.rfind("/", 0, start) + 1]
        version = _version(path, layout.versions, fields["number"], start == len(place) and path[end:])
        about = {"platform": layout.platform, "platform_id": fields["id"], "late": bool(fields["late"])}
        sender = Sender(learner=learner, place=place.removeprefix(parent), version=version, **about)
        return sender if learner.strip() else None

    def _only_one(self, paths, readings):
        """The layout that remains of {layout: the Senders of all paths}."""
        plain = [layout for layout, senders in readings.items() if self._is_plain(paths, senders)]
        for remaining in (list(readings), plain):
            if len(remaining) == 1:
                return remaining[0]
        lines = (
            f"{shown(path)}: {' or '.join(dict.fromkeys(sanitize_line(one.learner, 60) for one in senders))}"
            for path, *senders in zip(paths, *readings.values(), strict=True)
        )
        text = "several layouts fit, and they name different learners"
        raise doubt(text, lines, f"Give one: {_options(readings, ' or ')}.")

    def _is_plain(self, paths, senders):
        """Whether no learner has two files named after one lesson, and some group has several learners."""
        files, groups = {}, {}
        for path, sender in zip(paths, senders, strict=True):
            groups.setdefault(sender.place, set()).add(sender.learner)
            for lesson in lessons_named(PurePosixPath(path).name, self._lessons):
                files.setdefault((sender.learner, lesson), set()).add(sender.version[:1])
        is_grouped = not any(groups) or any(len(learners) > 1 for learners in groups.values())
        return is_grouped and all(len(versions) == 1 for versions in files.values())


def doubt(text, lines, remedy):
    """The CollectError of what stops a run before anything is graded: a list, and what settles it."""
    lines = sorted(lines)
    listed = [f"  {line}" for line in lines[:_MOST_LISTED]]
    if len(lines) > _MOST_LISTED:
        listed.append(f"  and {len(lines) - _MOST_LISTED} more")
    return CollectError("\n".join([f"nothing was graded: {text}:", *listed, remedy]), IN_DOUBT)


def shown(path):
    """A path as one printable line."""
    return sanitize_line(path, 300)


def _options(layouts, separator):
    return separator.join(f'--layout "{layout.name}"' for layout in layouts)


def _first(values):
    return next(filter(None, values), None)


def _have_marks(readings):
    """Whether no name is alone: names at the top, or in a zip there, or of several in a folder have marks."""
    learners = {}
    for layout in LAYOUTS[0]:
        for sender in filter(None, readings.get(layout, ())):
            learners.setdefault((layout.platform, sender.place), set()).add(sender.learner)
    top = re.compile(r"([^/]+\.zip/)?")
    return any(
        (len(names) > 1 and place) or (platform and top.fullmatch(place))
        for (platform, place), names in learners.items()
    )


def _version(path, versions, number, after_name):
    """See Sender; `after_name` is what follows the learner's name, if no text is before it."""
    stem, copy = split_repetition(path.removesuffix(".ipynb"))
    if versions == "date":
        return ()
    if versions == "upload" and number:
        return stem.partition(f"_{number}_")[2], int(number)
    # Where only the name of a file says whose it is, its number orders nothing: anybody can choose it.
    return (stem, copy) if copy and after_name != ".ipynb" else (path.removesuffix(".ipynb"), 0)


def _layout_named(text):
    layout = _first(one for one in chain(*LAYOUTS) if one.name.casefold() == text.casefold())
    if layout is None:
        _expression(text, ())
    return layout or Layout(text, (text,))


@lru_cache
def _expression(pattern, lessons):
    """The regular expression of a pattern; ValueError: it is none, or it names no learner."""
    names = "|".join(map(re.escape, sorted(lessons, key=len, reverse=True))) or r"(?!)"
    unnamed = {"group": r"[^/]+", "lesson": rf"(?:\d\d_)?(?:{names})"}
    expression = ""
    try:
        for literal, field, *_ in Formatter().parse(pattern):
            pieces = re.split(r"(\*\*/|\*\*|\*|/)", literal)
            expression += "".join(_WILD.get(piece, re.escape(piece)) for piece in pieces)
            if field is not None:
                expression += unnamed[field] if field in unnamed else rf"(?P<{field}>{_FIELDS[field]})"
        ending = r"(?:\.ipynb|(?:\.zip)?/.*)" if pattern.endswith("{learner}") else ""
        compiled = re.compile(expression + ending, re.S)
        if not compiled.groupindex.keys() & set(_NAMES):
            raise ValueError("no learner")
    except (ValueError, KeyError, re.error) as error:
        text = f"--layout {sanitize_line(pattern, 80)!r} is no layout; give Moodle, Canvas, ILIAS, nbgrader"
        raise ValueError(f"{text}, or a pattern such as {{group}}/{{learner}}/*.ipynb") from error
    return compiled
