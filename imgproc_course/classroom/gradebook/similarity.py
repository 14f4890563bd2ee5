"""Which submissions of a lesson are similar, and which answers equal the course's solution.

Two submissions are compared by their common fingerprints (see `fingerprints`). What the lesson gives (given
cells, stubs), what the solution contains, and what more than MOST_COMMON different submissions contain says
nothing, and does not count. Submissions of which each is similar to another one are a group, and the page
shows their common answers once. Similarity is a reason to look, never a verdict: no point depends on it.
"""

import json
from collections import Counter, namedtuple
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations

import numpy as np

from ..autograder.sanitize import sanitize_text, without_machine_paths
from .notebook_reader import NotebookReader
from .report import render_page

SHORTEST_SOLUTION = 60  # tokens; independent learners often write the same short solution
MOST_COMMON = 10  # submissions that contain a fingerprint; MOSS has the same limit
FEWEST_PRINTS = 6  # of a submission that is compared
LEAST_SHARE = 0.5  # of the fingerprints of the smaller submission
MOST_GROUPS = 40  # of one lesson
MOST_VERSIONS = 6  # of an answer, that the page shows of a group
_SECONDS = 5  # of processor time, for the fingerprints of one submission
_LONGEST_LINE = 20_000  # characters that a page shows


# One of the ways in which an exercise is answered in a group; others have these lines, too.
Version = namedtuple("Version", ("learners", "source", "lines"))


@dataclass(frozen=True)
class SimilarGroup:
    """Submissions of a lesson of which each is similar to another one; {exercise id: tuple of Version}.

    Two of them share most: 0 to 1, of the fingerprints of the smaller one.
    """

    lesson: str
    share: float
    learners: tuple
    versions: dict


@dataclass
class _Document:
    """Different learners' equal submission: its answers, shapes, and the fingerprints that count."""

    learners: list
    answers: dict
    shapes: dict
    prints: dict


def compare(learners, answer_keys, store):
    """(SimilarGroups, a lesson's most similar first; {digest of answers: ids that equal the solution})."""
    by_lesson, groups, copies = {}, [], {}
    for learner in learners:
        for lesson, digest in learner.digests.items():
            by_lesson.setdefault(lesson, {}).setdefault(digest, []).append(learner.name)
    with NotebookReader(_SECONDS) as reader:
        for lesson, by_digest in sorted(by_lesson.items()):
            handed_out, solution = map(reader.fingerprints, answer_keys.known_code(lesson))
            documents = {}
            for digest, names in sorted(by_digest.items()):
                answers = store.answers(digest)[2]
                result = reader.fingerprints(answers)
                shapes, prints = result["shapes"], dict(result["prints"])
                copies[digest] = _copied(shapes, solution["shapes"])
                document = _Document([], answers, shapes, prints)
                documents.setdefault(json.dumps(shapes, sort_keys=True), document).learners += names
            known = handed_out["prints"].keys() | solution["prints"].keys()
            groups += _groups(lesson, list(documents.values()), known)
    return groups, copies


def _copied(shapes, solution_shapes):
    """The exercises whose answer has the solution's shape, if that is long enough to say something."""
    equal = [id for id in shapes.keys() & solution_shapes if shapes[id][2] == solution_shapes[id][2]]
    return sorted(id for id in equal if shapes[id][1] >= SHORTEST_SOLUTION)


def _groups(lesson, documents, known):
    counts = Counter(fingerprint for document in documents for fingerprint in document.prints)
    telling = {fingerprint for fingerprint, count in counts.items() if count <= MOST_COMMON} - known
    for document in documents:
        document.learners.sort(key=str.casefold)
        document.prints = {digest: place for digest, place in document.prints.items() if digest in telling}
    documents = [document for document in documents if len(document.prints) >= FEWEST_PRINTS]
    shares = np.diag([float(len(document.learners) > 1) for document in documents])
    for (i, first), (j, second) in combinations(enumerate(documents), 2):
        common = len(first.prints.keys() & second.prints.keys())
        shares[i, j] = common / min(len(first.prints), len(second.prints))
    shares[shares < LEAST_SHARE] = 0
    groups = []
    for members in _connected(shares + shares.T > 0):
        share = float(shares[np.ix_(members, members)].max())
        if share:
            groups.append(_group(lesson, [documents[place] for place in members], share))
    groups.sort(key=lambda group: (-group.share, group.learners))
    return groups[:MOST_GROUPS]


def _connected(is_linked):
    """The places that a symmetric bool array (n, n) links, directly or over others: a sorted list each.

    SciPy's connected_components does the same, and its import would take a tenth of a small class's grading.
    """
    left = set(range(len(is_linked)))
    while left:
        members, new = set(), {min(left)}
        while new:
            members |= new
            new = set(np.flatnonzero(is_linked[sorted(new)].any(axis=0)).tolist()) - members
        left -= members
        yield sorted(members)


def _group(lesson, documents, share):
    counts = Counter(fingerprint for document in documents for fingerprint in document.prints)
    documents = sorted(documents, key=lambda document: document.learners)
    versions = {}
    for document in documents:
        lines = {}
        for fingerprint, (id, first, last) in document.prints.items():
            if counts[fingerprint] > 1 or len(documents) == 1:
                lines.setdefault(id, set()).update(range(first, last + 1))
        for id, similar in lines.items():
            by_shape = versions.setdefault(id, {})
            by_shape.setdefault(tuple(document.shapes[id]), []).append((document, similar))
    versions = {id: _versions(id, by_shape.values()) for id, by_shape in sorted(versions.items())}
    return SimilarGroup(lesson, share, _names(documents), versions)


def _names(documents):
    """The names of the learners of some documents, as a sorted tuple."""
    return tuple(sorted((name for document in documents for name in document.learners), key=str.casefold))


def _versions(id, equal_answers):
    """The versions of an answer; answers that differ in names only are one, shown as the first has it."""
    versions = []
    for answers in equal_answers:
        first, similar = answers[0]
        names = _names(document for document, _ in answers)
        versions.append(Version(names, first.answers[id], frozenset(similar)))
    return tuple(sorted(versions, key=lambda version: (-len(version.learners), version.learners)))


def report_copies(entries, learners, copies):
    """Add a finding for each graded answer that equals the solution; `copies` is from `compare`."""
    text = "it equals the course's solution, whatever the names and numbers; it is public: a reason to ask"
    for entry, learner in zip(entries, learners, strict=True):
        for lesson in entry["lessons"]:
            copied = copies.get(learner.digests.get(lesson["lesson"]), ())
            graded = {exercise["id"] for exercise in lesson["exercises"]}
            found = [{"kind": "odd", "exercise": id, "text": text} for id in copied if id in graded]
            lesson["findings"] += found
    return entries


def similar_entries(groups):
    """The groups as grades.json has them."""
    return [
        {"lesson": group.lesson, "percent": round(100 * group.share), "learners": list(group.learners)}
        for group in groups
    ]


def similarity_page(groups, names):
    """The page of similar submissions, HTML, or ""; `names` are {learner's name: the name to show}."""
    content = {"groups": groups, "names": names, "marked": _marked, "most": MOST_VERSIONS}
    return render_page("similar.html", **content) if groups else ""


def _marked(source, similar):
    """A source as HTML, its similar lines marked; the template would take ten times as long."""
    from jinja2.utils import markupsafe  # see `report.prepare_templates`

    mark, lines = markupsafe.Markup("<mark>{}</mark>"), enumerate(map(_escaped, source.split("\n")), 1)
    marked = (mark.format(line) if number in similar else line for number, line in lines)
    return markupsafe.Markup("\n").join(marked)


@lru_cache(maxsize=10_000)
def _escaped(line):
    from jinja2.utils import markupsafe

    return markupsafe.escape(without_machine_paths(sanitize_text(line, _LONGEST_LINE)))
