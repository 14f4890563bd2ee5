"""Which submissions of a lesson are similar, and which answers equal the course's solution.

Two submissions are compared by their common fingerprints (see `fingerprints`). What the lesson gives (given
cells, stubs), what the solution contains, and what more than MOST_COMMON different submissions contain says
nothing, and does not count. Similarity is a reason to look, never a verdict: no point depends on it.
"""

import json
import signal
import subprocess
import sys
from collections import Counter
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from pathlib import Path

from jinja2.utils import markupsafe

from imgproc_course.autograder.sanitize import sanitize_text
from imgproc_course.gradebook.report import render_page

SHORTEST_SOLUTION = 60  # tokens; independent learners often write the same short solution
MOST_COMMON = 10  # submissions that contain a fingerprint; MOSS has the same limit
FEWEST_PRINTS = 6  # of a submission that is compared
LEAST_SHARE = 0.5  # of the fingerprints of the smaller submission
MOST_PAIRS = 40  # of one lesson
_TRIES = 4
_LONGEST_LINE = 20_000  # characters that a page shows
_MARK = markupsafe.Markup("<mark>{}</mark>")
_PROGRAM = Path(__file__).with_name("fingerprints.py")
_NOTHING = {"shapes": {}, "prints": {}}


@dataclass(frozen=True)
class SimilarPair:
    """Two similar submissions of a lesson, or one that several learners submitted.

    share      0 to 1, of the fingerprints of the smaller one
    learners   names, of both
    sides      one or two of (names, {exercise id: source}, {exercise id: set of similar lines})
    """

    lesson: str
    share: float
    learners: tuple
    sides: tuple


@dataclass
class _Document:
    """Different learners' equal submission: its answers, shapes, and the fingerprints that count."""

    learners: list
    answers: dict
    shapes: dict
    prints: dict


def read_fingerprints(submissions):
    """The fingerprints of submissions, computed in a process of its own.

    Parameters
    ----------
    submissions : list of {exercise id: source}

    Returns
    -------
    list of dict as `fingerprints.fingerprints` returns them, empty ones for what ends the process
    """
    results, tries = [], _TRIES
    while len(results) < len(submissions):
        text = "".join(json.dumps(answers) + "\n" for answers in submissions[len(results) :])
        program = [sys.executable, "-I", "-S", "-B", str(_PROGRAM)]
        process = subprocess.run(program, input=text.encode("ascii"), capture_output=True, check=False)
        lines = process.stdout.splitlines(keepends=True)
        results += [json.loads(line) for line in lines if line.endswith(b"\n")]
        tries = tries - 1 if process.returncode == -signal.SIGKILL else 0
        if len(results) < len(submissions) and not tries:  # else somebody ended the process
            results.append(_NOTHING)
            tries = _TRIES
    return results


def compare(learners, answer_keys, store):
    """Compare all submissions that count.

    Parameters
    ----------
    learners : list of Learner
    answer_keys : AnswerKeys
    store : ResultStore, which has their answers

    Returns
    -------
    (list of SimilarPair, {answers digest: list of exercise ids}): the pairs of each lesson, the most similar
    first, and the answers that equal the solution
    """
    by_digest = {}
    for learner in learners:
        for lesson, submission in learner.submissions.items():
            if submission.answers_digest:
                by_digest.setdefault((lesson, submission.answers_digest), []).append(learner.name)
    places = sorted(by_digest)
    answers = [store.answers(digest)[2] for _, digest in places]
    lessons = sorted({lesson for lesson, _ in places})
    known = [known for lesson in lessons for known in answer_keys.known_code(lesson)]
    results = read_fingerprints([*answers, *known])
    compared, known = results[: len(places)], results[len(places) :]
    pairs, copies = [], {}
    for number, lesson in enumerate(lessons):
        handed_out, solution = known[2 * number : 2 * number + 2]
        documents = {}
        for (name, digest), sources, result in zip(places, answers, compared, strict=True):
            if name == lesson:
                copies[digest] = _copied(result["shapes"], solution["shapes"])
                _add_document(documents, by_digest[name, digest], sources, result)
        pairs += _pairs(
            lesson, list(documents.values()), handed_out["prints"].keys() | solution["prints"].keys()
        )
    return pairs, copies


def _copied(shapes, solution_shapes):
    """The exercises whose answer has the solution's shape, if that is long enough to say something."""
    return [
        id
        for id, shape in shapes.items()
        if shape == solution_shapes.get(id) and shape[1] >= SHORTEST_SOLUTION
    ]


def _add_document(documents, learners, sources, result):
    key = json.dumps(result["shapes"], sort_keys=True)
    document = documents.setdefault(key, _Document([], sources, result["shapes"], dict(result["prints"])))
    document.learners += learners


def _pairs(lesson, documents, known):
    counts = Counter(fingerprint for document in documents for fingerprint in document.prints)
    for document in documents:
        document.learners.sort(key=str.casefold)
        document.prints = {
            fingerprint: place
            for fingerprint, place in document.prints.items()
            if fingerprint not in known and counts[fingerprint] <= MOST_COMMON
        }
    documents = [document for document in documents if len(document.prints) >= FEWEST_PRINTS]
    pairs = [_pair(lesson, [document], 1.0) for document in documents if len(document.learners) > 1]
    for first, second in combinations(documents, 2):
        common = len(first.prints.keys() & second.prints.keys())
        share = common / min(len(first.prints), len(second.prints))
        if share >= LEAST_SHARE:
            pairs.append(_pair(lesson, [first, second], share))
    pairs.sort(key=lambda pair: (-pair.share, pair.learners))
    return pairs[:MOST_PAIRS]


def _pair(lesson, documents, share):
    documents = sorted(documents, key=lambda document: document.learners)
    common = set.intersection(*(set(document.prints) for document in documents))
    sides = []
    for document in documents:
        lines = {}
        for fingerprint in common:
            id, first, last = document.prints[fingerprint]
            lines.setdefault(id, set()).update(range(first, last + 1))
        sides.append((document.learners, {id: document.answers[id] for id in lines}, lines))
    learners = sorted({name for document in documents for name in document.learners}, key=str.casefold)
    return SimilarPair(lesson, share, tuple(learners), tuple(sides))


def report_copies(entries, learners, copies):
    """Add a finding for each answer that equals the course's solution.

    Parameters
    ----------
    entries : list of dict, the learners' parts of grades.json; they are changed
    learners : list of Learner, in the same order
    copies : {answers digest: list of exercise ids}

    Returns
    -------
    list of dict, the entries
    """
    text = "it equals the course's solution, whatever the names; the solutions are public: a reason to ask"
    for entry, learner in zip(entries, learners, strict=True):
        for lesson in entry["lessons"]:
            submission = learner.submissions.get(lesson["lesson"])
            for id in copies.get(submission.answers_digest, ()) if submission else ():
                lesson["findings"].append({"kind": "odd", "exercise": id, "text": text})
    return entries


def similar_entries(pairs):
    """The pairs as grades.json has them."""
    return [
        {"lesson": pair.lesson, "percent": round(100 * pair.share), "learners": list(pair.learners)}
        for pair in pairs
    ]


def similarity_page(pairs, names):
    """The teacher's page of similar submissions, side by side.

    Parameters
    ----------
    pairs : list of SimilarPair
    names : {learner's name: the name to show}

    Returns
    -------
    str, HTML; "" if there are none
    """
    views = []
    for pair in pairs:
        sides = [
            {
                "learners": [names[name] for name in learners],
                "answers": [
                    {"id": id, "source": _marked(source, lines[id])} for id, source in sorted(sources.items())
                ],
            }
            for learners, sources, lines in pair.sides
        ]
        views.append({"lesson": pair.lesson, "percent": round(100 * pair.share), "sides": sides})
    return render_page("similar.html", pairs=views) if views else ""


def _marked(source, similar):
    """A source as HTML, its similar lines marked; the template would take ten times as long."""
    lines = enumerate(map(_escaped, source.split("\n")), 1)
    return markupsafe.Markup("\n").join(
        _MARK.format(line) if number in similar else line for number, line in lines
    )


@lru_cache(maxsize=10_000)
def _escaped(line):
    return markupsafe.escape(sanitize_text(line, _LONGEST_LINE))
