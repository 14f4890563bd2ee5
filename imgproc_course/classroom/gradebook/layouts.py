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
from collections import defaultdict
from dataclasses import dataclass
from functools import lru_cache
from itertools import chain
from pathlib import PurePosixPath

from ..authoring.lesson_names import lessons_named, name_in_stem, notebook_name, split_repetition
from ..autograder.sanitize import sanitize_line
from .archives import CollectError

_MOST_LISTED = 20  # files, in the list of what is in doubt
_NAME_THEM = 'Put each learner\'s name into the name of a folder or a file, such as "Ada - FILE.ipynb".'
_TOKENS = {  # of patterns; those after {learner} are the platforms' own
    "**/": r"(?:[^/]+/)*?",
    "**": r".*",
    "*": r"[^/]*",
    "/": r"(?:\.zip)?/",
    "{group}": r"[^/]+",
    "{learner}": r"(?P<learner>[^/]+?)",
    "{team}": r"(?P<learner>Team \d+)",
    "{anonymous}": r"(?P<learner>anon_[^/_]+)",
    "{last}": r"(?P<learner>[^/_]+)",
    "{first}": r"(?P<first>[^/_]+)",
    "{login}": r"[^/]+?",
    "{id}": r"(?P<id>\d{1,20})",  # the platform's number of a person
    "{upload}": r"(?P<upload>\d{1,18})",
    "{late}": r"(?P<late>LATE_)?",
}


@dataclass(frozen=True)
class Layout:
    """A form of folders: the first of its patterns that fits a path names the learner.

    name      what `--layout` takes; of a layout that no platform made it is the pattern
    platform  whose numbers of people are in the names, for tables and exports, or ""
    """

    name: str
    patterns: tuple
    platform: str = ""


def _in_groups(*several):
    """Layouts of these patterns, named after the last one of each, in no, one or two folders of groups."""
    return tuple(
        Layout(group + patterns[-1], tuple(group + pattern for pattern in patterns))
        for group in ("", "{group}/", "{group}/{group}/")
        for patterns in several
    )


_PARENTS = ("submitted", "Abgaben", "Submissions")  # folders of platforms that can be given themselves
_MOODLE = ("**/{learner}_{id}_assignsubmission_**", "**/{learner}_assignsubmission_**")  # of no team
_CANVAS = (
    "**/{late}{anonymous}_{upload}_**",
    "**/{learner}_{late}{id}_{upload}_**",
    "**/{learner}_{late}{id}_*.html",  # what was typed into the platform
)
_ILIAS = ("**/Abgaben/{team}/**", "**/Submissions/{team}/**", "**/{last}_{first}_{login}_{id}/**")
LAYOUTS = (
    (
        Layout("Moodle", _MOODLE, "moodle"),
        Layout("Canvas", _CANVAS, "canvas"),
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
        self.layouts = []

    def choose(self, paths, given=()):
        """Choose those `given` by name or pattern, or else the one that fits the paths of all notebooks.

        ValueError: what is given is no layout. CollectError, with a list: nobody knows whose the files are.
        """
        known = {layout.name.casefold(): layout for layout in chain(*LAYOUTS)}
        self.layouts = [known.get(name.casefold(), Layout(name, (name,))) for name in given]
        self.layouts.sort(key=lambda layout: layout not in LAYOUTS[0])
        every = self.layouts or list(chain(*LAYOUTS))
        readings = {layout: [self._sender(path, layout) for path in paths] for layout in every}
        for layouts in () if given else LAYOUTS[: 1 if _have_marks(readings) else None]:
            fitting = [layout for layout in layouts if None not in readings[layout]]
            plain = [layout for layout in fitting if self._is_plain(paths, readings[layout])]
            self.layouts = fitting if len(fitting) == 1 else plain
            if len(self.layouts) == 1:
                return
            if fitting:
                senders = zip(*map(readings.get, fitting), strict=True)
                names = (
                    dict.fromkeys(sanitize_line(one.learner, 60) for one in several) for several in senders
                )
                lines = (
                    f"{shown(path)}: {' or '.join(several)}"
                    for path, several in zip(paths, names, strict=True)
                )
                remedy = f"Give one: {_options(fitting, ' or ')}."
                raise doubt("several layouts fit, and they name different learners", lines, remedy)
        indices = range(len(paths))
        firsts = [_first(layout for layout in every if readings[layout][index]) for index in indices]
        needed = every if given else [layout for layout in every if layout in firsts]
        fitting = every if given else needed[:1]
        unknown = [shown(path) for path, first in zip(paths, firsts, strict=True) if first not in fitting]
        if unknown and not needed:
            raise doubt("nothing says whose these are", unknown, _NAME_THEM)
        if unknown:
            others = f"{len(paths) - len(unknown)} others fit {_options(fitting)}"
            remedy = f"Move or rename them, or give a layout for them, too: {_options(needed)}."
            raise doubt(f"nothing says whose these are; {others}", unknown, remedy)

    def sender_of(self, path):
        """The Sender of a file, or None if its path names nobody."""
        return _first(self._sender(path, layout) for layout in self.layouts)

    def _sender(self, path, layout):
        parent = self._parent if layout in LAYOUTS[0] else ""
        path = notebook_name(parent + path)
        match = _first(_expression(pattern, self._lessons).fullmatch(path) for pattern in layout.patterns)
        if match is None:
            return None
        fields = match.groupdict("")
        learner, (start, end) = fields["learner"], match.span("learner")
        if "first" in fields:
            learner = f"{fields['first']} {learner}"
        elif not layout.platform:
            learner = name_in_stem(learner, self._lessons)
        if not learner.strip():
            return None
        place = path[: path.rfind("/", 0, start) + 1]
        stem, copy = split_repetition(path.removesuffix(".ipynb"))
        # Where only the name of a file says whose it is, its number orders nothing: anybody can choose it.
        version = (path.removesuffix(".ipynb"), 0)
        if copy and (len(place) < start or path[end:] != ".ipynb"):
            version = (stem, copy)
        if upload := fields.get("upload"):
            version = (stem.partition(f"_{upload}_")[2], int(upload))
        return Sender(
            learner=learner,
            place=place.removeprefix(parent),
            platform=layout.platform,
            platform_id=fields.get("id", ""),
            late=bool(fields.get("late")),
            version=() if layout.platform == "moodle" else version,
        )

    def _is_plain(self, paths, senders):
        """Whether no learner has two files named after one lesson, and some group has several learners."""
        groups, files = defaultdict(set), defaultdict(set)
        for path, sender in zip(paths, senders, strict=True):
            groups[sender.place].add(sender.learner)
            for lesson in lessons_named(PurePosixPath(path).name, self._lessons):
                files[sender.learner, lesson].add(sender.version[:1])
        is_grouped = not any(groups) or any(len(learners) > 1 for learners in groups.values())
        return is_grouped and all(len(versions) == 1 for versions in files.values())


def doubt(text, lines, remedy):
    """The CollectError of what stops a run before anything is graded: a list, and what settles it."""
    lines = sorted(lines)
    more = [f"and {len(lines) - _MOST_LISTED} more"] if len(lines) > _MOST_LISTED else []
    listed = (f"  {line}" for line in lines[:_MOST_LISTED] + more)
    error = CollectError("\n".join([f"nothing was graded: {text}:", *listed, remedy]))
    error.exit_code = 3
    return error


def shown(path):
    """A path as one printable line."""
    return sanitize_line(path, 300)


def _options(layouts, separator=" "):
    return separator.join(f'--layout "{layout.name}"' for layout in layouts)


def _first(values):
    return next(filter(None, values), None)


def _have_marks(readings):
    """Whether platforms' marks are in names at the top, in a zip there, or of several people in a folder."""
    learners = defaultdict(set)
    for layout in LAYOUTS[0]:
        for sender in filter(None, readings[layout]):
            learners[layout, sender.place].add(sender.learner)
    return any(
        place if len(names) > 1 else layout.platform and re.fullmatch(r"([^/]+\.zip/)?", place)
        for (layout, place), names in learners.items()
    )


@lru_cache
def _expression(pattern, lessons):
    """The regular expression of a pattern; ValueError: it is none, or it names no learner."""
    names = "|".join(map(re.escape, sorted(lessons, key=len, reverse=True))) or r"(?!)"
    tokens = _TOKENS | {"{lesson}": rf"(?:\d\d_)?(?:{names})"}
    pieces = re.split(f"({'|'.join(map(re.escape, tokens))})", pattern)
    ending = r"(?:\.ipynb|(?:\.zip)?/.*)" if pattern.endswith("{learner}") else ""
    try:
        if unknown := re.search(r"[{}]", "".join(piece for piece in pieces if piece not in tokens)):
            raise KeyError(unknown[0])
        expression = "".join(tokens.get(piece, re.escape(piece)) for piece in pieces)
        compiled = re.compile(expression + ending, re.S)
        compiled.groupindex["learner"]
    except (KeyError, re.error) as error:
        text = f"--layout {sanitize_line(pattern, 80)!r} is no layout; give Moodle, Canvas, ILIAS, nbgrader"
        raise ValueError(f"{text}, or a pattern such as {{group}}/{{learner}}/*.ipynb") from error
    return compiled
