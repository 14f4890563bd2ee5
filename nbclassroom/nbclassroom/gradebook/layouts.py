"""Whose a file is: the layout of the folder of submissions names the learner of every notebook in it.

A layout is an entry of LAYOUTS, or a pattern that the teacher gives. In a pattern, {learner} and {group} are
names of folders, zips or files, {lesson} is the name of a lesson, * is any text in a name, and ** any folders
and files. A pattern that ends with {learner} means their folder, zip or notebook.

Marks that a platform writes come before a form that people write too, and this before names alone, of which
none may have a platform's marks. If several layouts fit, one must remain that leaves no learner two files
named after one lesson and has several learners in some group.
"""

import re
from collections import defaultdict
from contextlib import suppress
from functools import lru_cache
from pathlib import PurePosixPath
from types import SimpleNamespace

from ..authoring.lesson_names import lessons_named, name_in_stem, notebook_name, split_repetition
from ..autograder.sanitize import sanitize_line
from .archives import CollectError

MOST_LISTED = 20  # files, in a list of what is in doubt or ignored
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

_MARKED = {
    "Moodle": (
        "**/{learner}_{id}_assignsubmission_**",
        "**/{learner}_assignsubmission_**",  # of those who are in no team
    ),
    "Canvas": (
        "**/{late}{anonymous}_{upload}_**",
        "**/{learner}_{late}{id}_{upload}_**",
        "**/{learner}_{late}{id}_*.html",  # what was typed into the platform
    ),
    "ILIAS": ("**/Abgaben/{team}/**", "**/Submissions/{team}/**", "**/{last}_{first}_{login}_{id}/**"),
    "nbgrader": ("**/submitted/{learner}/*/**", "**/{learner}+*+* UTC*/**"),
}
_GROUPS = ("", "{group}/", "{group}/{group}/")
_FORMED = {  # Google Classroom's
    group + name: (group + with_lesson, group + name)
    for group in _GROUPS
    for with_lesson, name in (
        ("{learner} - {lesson}*.ipynb", "{learner} - *.ipynb"),
        ("*{lesson} - {learner}.ipynb", "* - {learner}.ipynb"),
    )
}
_NAMED = {f"{group}{{learner}}": (f"{group}{{learner}}",) for group in _GROUPS}
LAYOUTS = _MARKED | _FORMED | _NAMED  # {name: patterns}; the first that fits a path names the learner
_PLATFORMS = {"Moodle": "moodle", "Canvas": "canvas"}  # their numbers of people are for tables and exports
_PARENTS = ("submitted", "Abgaben", "Submissions")  # folders of platforms that can be given themselves


class FolderLayout:
    """The names of the `layouts` of a folder: those `given`, or the one that fits the paths of all notebooks.

    A path has "/" between its parts, and at its end if it is a folder or a zip that cannot be read.
    ValueError: what is given is no layout. CollectError, with a list: nobody knows whose the files are.
    """

    def __init__(self, folder, lessons, paths, given=()):
        self._parent = f"{folder}/" if folder in _PARENTS else ""
        self._lessons = tuple(lessons)
        by_name = {layout.casefold(): layout for layout in LAYOUTS}
        named = [by_name.get(layout.casefold(), layout) for layout in given]
        named.sort(key=lambda layout: layout not in _MARKED)
        readings = {
            path: {layout: sender for layout in named or LAYOUTS if (sender := self._sender(path, layout))}
            for path in paths
        }
        self.layouts = named or self._fitting(readings)
        firsts = {next(iter(senders), None) for senders in readings.values()}
        needed = self.layouts or [layout for layout in LAYOUTS if layout in firsts]
        fitting = self.layouts or needed[:1]
        unknown = [path for path, senders in readings.items() if not senders.keys() & fitting]
        text = "nothing says whose these are"
        remedy = 'Put each learner\'s name into the name of a folder or a file, such as "Ada - FILE.ipynb".'
        if needed:
            text += f"; {len(readings) - len(unknown)} others fit {_options(fitting)}"
            remedy = f"Move or rename them, or give a layout for them, too: {_options(needed)}."
        if unknown:
            raise doubt(text, map(sanitize_line, unknown), remedy)

    def _fitting(self, readings):
        """A list of the one of LAYOUTS that fits all paths, or an empty one; CollectError: several do."""
        for layouts in (_MARKED,) if _have_marks(readings) else (_MARKED, _FORMED, _NAMED):
            fitting = [one for one in layouts if all(one in senders for senders in readings.values())]
            plain = [layout for layout in fitting if self._is_plain(readings, layout)]
            if 1 in (len(fitting), len(plain)):
                return plain if len(plain) == 1 else fitting
            if fitting:
                lines = (
                    sanitize_line(f"{path}: {' or '.join({senders[one].learner: None for one in fitting})}")
                    for path, senders in readings.items()
                )
                remedy = f"Give one: {_options(fitting, ' or ')}."
                raise doubt("several layouts fit, and they name different learners", lines, remedy)
        return []

    def sender_of(self, path):
        """Who sent a file, as its path says: fields of a SubmittedFile. None if it names nobody."""
        return next(filter(None, (self._sender(path, layout) for layout in self.layouts)), None)

    def _sender(self, path, layout):
        parent, platform = self._parent if layout in _MARKED else "", _PLATFORMS.get(layout, "")
        path = notebook_name(parent + path)
        patterns = LAYOUTS.get(layout, (layout,))
        matches = (_expression(pattern, self._lessons).fullmatch(path) for pattern in patterns)
        match = next(filter(None, matches), None)
        if match is None:
            return None
        fields = match.groupdict("")
        learner, (start, end) = fields["learner"], match.span("learner")
        if "first" in fields:
            learner = f"{fields['first']} {learner}"
        elif not platform:
            learner = name_in_stem(learner, self._lessons)
        if not learner.strip():
            return None
        place = path[: path.rfind("/", 0, start) + 1]
        stem, copy = split_repetition(path.removesuffix(".ipynb"))
        if upload := fields.get("upload"):
            stem, copy = stem.partition(f"_{upload}_")[2], int(upload)
        elif not copy or path == f"{place}{path[start:end]}.ipynb":
            # If only the name of a file says whose it is, its number orders nothing: anybody can choose it.
            stem, copy = path.removesuffix(".ipynb"), 0
        return SimpleNamespace(
            learner=learner,
            place=place.removeprefix(parent),
            platform=platform,
            platform_id=fields.get("id", ""),
            late=bool(fields.get("late")),
            version=() if platform == "moodle" else (stem, copy),  # Moodle's are ordered by their dates
        )

    def _is_plain(self, readings, layout):
        """Whether no learner has two files named after one lesson, and some group has several learners."""
        groups, files = defaultdict(set), defaultdict(set)
        for path, senders in readings.items():
            sender = senders[layout]
            groups[sender.place].add(sender.learner)
            for lesson in lessons_named(PurePosixPath(path).name, self._lessons):
                files[sender.learner, lesson].add(sender.version[:1])
        is_grouped = not any(groups) or any(len(learners) > 1 for learners in groups.values())
        return is_grouped and all(len(versions) == 1 for versions in files.values())


def doubt(text, lines, remedy):
    """The CollectError of what stops a run before anything is graded: a list, and what settles it."""
    listed = sorted(lines)
    listed[MOST_LISTED:] = [f"and {len(listed) - MOST_LISTED} more"] if len(listed) > MOST_LISTED else []
    error = CollectError("\n  ".join([f"nothing was graded: {text}:", *listed]) + f"\n{remedy}")
    error.exit_code = 3
    return error


def _options(layouts, separator=" "):
    return separator.join(f'--layout "{layout}"' for layout in layouts)


def _have_marks(readings):
    """Whether platforms' marks are in names at the top, in a zip there, or of several people in a folder."""
    learners = defaultdict(set)
    for senders in readings.values():
        for layout in _MARKED.keys() & senders:
            learners[layout, senders[layout].place].add(senders[layout].learner)
    return any(
        place if len(names) > 1 else layout in _PLATFORMS and re.fullmatch(r"([^/]+\.zip/)?", place)
        for (layout, place), names in learners.items()
    )


@lru_cache
def _expression(pattern, lessons):
    """The regular expression of a pattern; ValueError: it is none, or it names no learner."""
    names = "|".join(map(re.escape, sorted(lessons, key=len, reverse=True))) or r"(?!)"
    tokens = _TOKENS | {"{lesson}": rf"(?:\d\d_)?(?:{names})"}
    pieces = re.split(f"({'|'.join(map(re.escape, tokens))})", pattern)
    ending = r"(?:\.ipynb|(?:\.zip)?/.*)" if pattern.endswith("{learner}") else ""
    expression = "".join(tokens.get(piece, re.escape(piece)) for piece in pieces)
    unknown = re.search(r"[{}]", "".join({*pieces} - tokens.keys()))
    with suppress(re.error):  # a name stands in it twice
        compiled = re.compile(expression + ending, re.S)
        if "learner" in compiled.groupindex and not unknown:
            return compiled
    text = f"--layout {sanitize_line(pattern, 80)!r} is no layout; give Moodle, Canvas, ILIAS, nbgrader"
    raise ValueError(f"{text}, or a pattern such as {{group}}/{{learner}}/*.ipynb")
