"""Lift answers out of what learners handed in: the source of answer cells, by their ids, and nothing else.

Everything else that was handed in (check cells, outputs, metadata, kernels, tags) is ignored; where it was
changed in a way that grading would mind, it is told.
"""

import contextlib
import json
import select
import subprocess
import sys
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path

from imgproc_course.gradebook.sanitize import visible_line

SECONDS = 60  # for reading one notebook
MEMORY = 2 << 30
_READER = Path(__file__).with_name("submission_reader.py")
_ORDERS = ("# NBVAL_", "# PYTEST_VALIDATE_")


@dataclass(frozen=True)
class Finding:
    """Something to be told of a submission.

    kind      "message": for the learner too; "odd": for the teacher alone
    exercise  its id, or "" for the whole
    text      one line
    """

    kind: str
    exercise: str
    text: str


@dataclass
class SubmissionContent:
    """What was content out of one file.

    lesson    its name, or None where it is none of the key's;  version: str or None, as the file says
    answers   {exercise id: source}
    claims    exercise ids whose stored outputs say that every check passes
    reason    why nothing could be content, or ""
    """

    lesson: str | None = None
    version: str | None = None
    answers: dict = field(default_factory=dict)
    findings: list = field(default_factory=list)
    claims: list = field(default_factory=list)
    reason: str = ""

    def as_json(self):
        """Itself as data that JSON holds."""
        return asdict(self)


class NotebookReader:
    """The process that reads notebooks, started when needed and again when one has ended it."""

    def __init__(self, seconds=SECONDS, memory=MEMORY):
        self._seconds, self._memory, self._process = seconds, memory, None

    def read(self, data):
        """What a notebook holds: (dict of `submission_reader.read_notebook`, "") or (None, the reason)."""
        if self._process is None:
            self._start()
        try:
            line = self._answer(data)
        except OSError:
            line = b""
        if not line.endswith(b"\n"):
            self.close()
            return None, "reading it takes more time or memory than a notebook needs"
        answer = json.loads(line)
        return answer.get("read"), answer.get("reason", "")

    def _answer(self, data):
        stdin, stdout = self._process.stdin, self._process.stdout
        stdin.write(b"%d\n" % len(data))
        stdin.write(data)
        stdin.flush()
        until, line = time.monotonic() + self._seconds, b""
        while not line.endswith(b"\n"):
            ready, _, _ = select.select([stdout], [], [], max(0.0, until - time.monotonic()))
            more = stdout.read1(1 << 20) if ready else b""
            if not more:
                break
            line += more
        return line

    def _start(self):
        self._process = subprocess.Popen(
            [sys.executable, "-I", "-S", "-B", str(_READER), str(self._memory)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )

    def close(self):
        """End the process."""
        if self._process is None:
            return
        process, self._process = self._process, None
        process.kill()
        for stream in (process.stdin, process.stdout):
            with contextlib.suppress(OSError):
                stream.close()
        process.wait()

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self.close()


def read_submission(data, answer_keys, reader):
    """Lift the answers out of one file.

    Parameters
    ----------
    data : bytes
    answer_keys : AnswerKeys, whose keys say which lessons and exercises there are
    reader : NotebookReader

    Returns
    -------
    SubmissionContent
    """
    read, reason = reader.read(data)
    if read is None:
        return SubmissionContent(reason=reason)
    content = SubmissionContent(version=read["version"])
    cells = [cell for cell in read["cells"] if cell is not None]
    content.lesson = _lesson_of(read, cells, answer_keys, content)
    if content.lesson is None:
        told = f"; it says that it is {visible_line(read['lesson'], 80)!r}" if read["lesson"] else ""
        content.reason = f"it is no lesson of this key{told}; the key has {', '.join(answer_keys.lessons)}"
        return content
    if len(cells) < len(read["cells"]):
        content.findings.append(
            Finding("odd", "", f"{len(read['cells']) - len(cells)} of its cells are none")
        )
    if read["kernel"] not in (None, "python3"):
        kernel = visible_line(read["kernel"], 60)
        content.findings.append(
            Finding("odd", "", f"it asks for the kernel {kernel!r}; grading uses its own")
        )
    key = answer_keys.key_for(content.lesson, content.version)
    lesson, handed_out = key.lessons[content.lesson], answer_keys.handed_out(key, content.lesson)
    for exercise in lesson.exercises:
        _lift_answer(exercise, cells, handed_out, content)
        _compare_given(exercise, cells, handed_out, content)
    return content


def _lesson_of(read, cells, answer_keys, content):
    """The lesson by its metadata, if its answer cells agree; else the one whose answer cells there are."""
    ids = {cell["id"] for cell in cells}
    counts = {name: len(ids & answer_keys.answer_ids(name)) for name in answer_keys.lessons}
    best = max(counts, key=counts.get, default=None)
    said = read["lesson"]
    if said in counts and (counts[said] or not counts[best]):
        return said
    if best is None or not counts[best]:
        return None
    if said in counts:
        text = f"it says that it is {said}, and its answer cells are those of {best}"
        content.findings.append(Finding("message", "", f"{text}; it is graded as {best}"))
    return best


def _lift_answer(exercise, cells, handed_out, content):
    id = f"answer-{exercise.id}"
    standing = [number for number, cell in enumerate(cells) if cell["id"] == id]

    def tell(text, kind="message"):
        content.findings.append(Finding(kind, exercise.id, text))

    if not standing:
        where = _defined_elsewhere(exercise.function, cells)
        place = (
            f"; {exercise.function}() stands in another cell ({where}), which is not graded" if where else ""
        )
        tell(f"its answer cell was deleted{place}")
        return
    code = [number for number in standing if cells[number]["type"] == "code"]
    if len(standing) > 1:
        tell(f"its answer cell stands there {len(standing)} times; the first one with code is graded")
    if not code:
        tell(f"its answer cell was made a {visible_line(cells[standing[0]]['type'], 20) or 'nameless'} cell")
        return
    cell = cells[code[0]]
    if cell["source"] is None:
        tell("the source of its answer cell is no text")
        return
    content.answers[exercise.id] = cell["source"]
    if cell["orders"] or any(order in cell["source"] for order in _ORDERS):
        tell("its answer cell gives orders to a grader (tags or comments), which are ignored", "odd")
    _tell_of_split(exercise, cells, code[0], handed_out, tell)


def _tell_of_split(exercise, cells, number, handed_out, tell):
    """A cell that was split: its function, or a part of it, stands where grading does not look."""
    defines = f"def {exercise.function}" in cells[number]["source"]
    elsewhere = _defined_elsewhere(exercise.function, cells)
    if not defines and elsewhere:
        tell(
            f"its answer cell does not define {exercise.function}(), but cell {elsewhere} does, which is not"
            " graded: was it split? Join the two (Edit > Merge Cells)"
        )
        return
    after = cells[number + 1] if number + 1 < len(cells) else None
    foreign = handed_out and after and after["id"] not in handed_out and not after.get("blank", True)
    if foreign and after["type"] == "code" and after.get("defines"):
        names = ", ".join(f"{visible_line(name, 60)}()" for name in after["defines"][:3])
        tell(f"a cell behind its answer defines {names}; the answer's own cell alone is graded")


def _defined_elsewhere(function, cells):
    found = next((cell for cell in cells if function in cell.get("defines", ())), None)
    return None if found is None else visible_line(found["id"], 80) or "without an id"


def _compare_given(exercise, cells, handed_out, content):
    """Tell of check and given cells that were changed or removed, and of what check cells claim."""
    standing = {}
    for cell in cells:
        standing.setdefault(cell["id"], cell)
    for id, source in handed_out.items():
        if source is None or not id.startswith((f"check-{exercise.id}-", f"given-{exercise.id}-")):
            continue
        what = "check cell" if id.startswith("check-") else "given cell"
        cell = standing.get(id)
        changed = "was removed" if cell is None else "is no code any more" if cell["type"] != "code" else ""
        if not changed and (cell["source"] or "").strip() != source.strip():
            changed = "was changed"
        if changed:
            content.findings.append(
                Finding("message", exercise.id, f"its {what} ({id}) {changed}; grading uses its own")
            )
    shown = "\n".join(
        cell["shown"] for id, cell in standing.items() if id.startswith(f"check-{exercise.id}-")
    )
    claims = (f"{exercise.id}: the check passes", f"{exercise.id}: all ")
    if any(
        line.startswith(claims) and line.rstrip(".").endswith(("passes", "pass"))
        for line in shown.splitlines()
    ):
        content.claims.append(exercise.id)
