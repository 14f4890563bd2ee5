"""Which answers equal the course's solution: a reason to look, never a verdict; no point depends on it."""

from .notebook_reader import NotebookReader

EQUALS = "it equals the course's solution, whatever the names and numbers; it is public: a reason to ask"
SHORTEST_SOLUTION = 60  # tokens; independent learners often write the same short solution
_SECONDS = 5  # of processor time, for the answers of one submission


def find_copies(learners, answer_keys, store):
    """{digest of a submission's answers: sorted ids of those that equal the solution}."""
    digests = {item for learner in learners for item in learner.digests.items()}
    copies, solutions = {}, {}
    with NotebookReader(_SECONDS) as reader:
        for lesson, digest in sorted(digests):
            if lesson not in solutions:
                solutions[lesson] = reader.shapes(answer_keys.solutions(lesson))
            shapes = reader.shapes(store.page(digest)[2]["answers"])
            equal = dict(shapes.items() & solutions[lesson].items())
            copies[digest] = sorted(id for id, (_, count) in equal.items() if count >= SHORTEST_SOLUTION)
    return copies


def report_copies(entries, learners, copies):
    """Add a finding for each graded answer that equals the solution; `copies` is from `find_copies`."""
    for entry, learner in zip(entries, learners, strict=True):
        for lesson in entry["lessons"]:
            copied = copies.get(learner.digests.get(lesson["lesson"]), ())
            graded = {exercise["id"] for exercise in lesson["exercises"]}
            found = [{"kind": "odd", "exercise": id, "text": EQUALS} for id in copied if id in graded]
            lesson["findings"] += found
    return entries
