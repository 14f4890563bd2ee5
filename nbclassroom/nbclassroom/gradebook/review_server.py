"""Serves the teacher's pages on this machine alone, and saves what is decided on them in decisions.csv.

Every address begins with a token, which nobody else on this machine or in another page can know.
"""

import contextlib
import csv
import io
import json
import re
import secrets
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from itertools import chain
from operator import itemgetter
from pathlib import Path

from ..authoring.lesson_names import lesson_name
from ..autograder.sanitize import spreadsheet_text
from ..exercises.progress import one_at_a_time
from .answer_keys import AnswerKeys
from .csv_table import TableError, csv_text, is_comment, read_csv
from .report import count_of
from .result_store import write_grades_file
from .teacher_tables import DECISION_COLUMNS, read_decisions

_PAGES = ("*.html", "review/*.html", "learners/*.html")
_VERSIONED = len(DECISION_COLUMNS) + 2  # cells of a line that also says which points and comment it replaces
_LENGTH = re.compile(r"\d{1,7}", re.A)  # of decisions saved at once, in bytes


class ReviewServer(ThreadingHTTPServer):
    """Serves the pages of a folder of grades on loopback; `url` is the address of their first page."""

    daemon_threads = True

    def __init__(self, out, decisions, answer_keys):
        super().__init__(("127.0.0.1", 0), _Handler)
        self.out, self.decisions, self.answer_keys = Path(out), Path(decisions), answer_keys
        self.token = secrets.token_urlsafe(32)
        self.url = f"http://127.0.0.1:{self.server_port}/{self.token}/review.html"

    def read(self, path):
        """The page of that address, or None: only pages are served, and only with the token."""
        token, _, name = path.lstrip("/").partition("/")
        if not secrets.compare_digest(token.encode(), self.token.encode()):
            return None
        paths = chain.from_iterable(map(self.out.glob, _PAGES))
        pages = {path.relative_to(self.out).as_posix(): path for path in paths}
        return pages[name].read_bytes() if name in pages else None


def serve_review(out, keys, decisions=None, *, say=print):
    """Serve the pages of a folder of grades until Ctrl-C; the arguments are those of the command `grade`."""
    with ReviewServer(out, decisions or Path(out) / "decisions.csv", AnswerKeys(keys)) as server:
        say(f"Read the answers and decide: {server.url}")
        say("What you type there is saved at once, and counted when you press Ctrl-C here.")
        with contextlib.suppress(KeyboardInterrupt):
            server.serve_forever()


class _Handler(BaseHTTPRequestHandler):
    server: ReviewServer
    timeout = 60  # seconds that a browser may be silent

    def do_GET(self):
        if self._is_for_decisions():
            saved = json.dumps(saved_decisions(self.server.decisions)).encode()
            return self._answer(HTTPStatus.OK, saved, "application/json")
        page = self.server.read(self.path.partition("?")[0])
        return self._answer(HTTPStatus.NOT_FOUND if page is None else HTTPStatus.OK, page or b"", "text/html")

    def _is_for_decisions(self):
        return secrets.compare_digest(self.path.encode(), f"/{self.server.token}/decisions".encode())

    def do_POST(self):
        if not self._is_for_decisions():
            return self._answer(HTTPStatus.NOT_FOUND)
        length = self.headers.get("Content-Length", "none")
        body = self.rfile.read(int(length)) if _LENGTH.fullmatch(length) else b""
        try:
            if str(len(body)) != length:
                raise ValueError(f"{len(body)} bytes came with the Content-Length {length[:20]!r}")
            number = save_decisions(self.server.decisions, body.decode(), self.server.answer_keys)
        except ConflictError as error:
            return self._answer(HTTPStatus.CONFLICT, f"Not saved: {error}".encode())
        except (ValueError, csv.Error) as error:
            return self._answer(HTTPStatus.BAD_REQUEST, f"Not saved: {error}".encode())
        text = f"{count_of(number, 'line')} saved. The points change when you end the command with Ctrl-C."
        return self._answer(HTTPStatus.OK, text.encode())

    def _answer(self, status, data=b"", kind="text/plain"):
        self.send_response(status)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        self.send_header("Content-Length", str(len(data)))
        self.send_header("Cache-Control", "no-store")
        self.end_headers()
        self.wfile.write(data)

    def log_message(self, *_):
        """Print nothing: the terminal shows what the command says."""


class ConflictError(TableError):
    """Somebody else has saved another decision meanwhile; nothing is written."""


def saved_decisions(path):
    """{learner, lesson, exercise as a line of CSV: [points, comment]} of the table of decisions."""
    table = read_csv(path)
    records = [table.record(cells) for _, cells in table.rows if not is_comment(cells)]
    return {_line_of(row): [row.get("points", ""), row.get("comment", "")] for row in records}


def _line_of(row):
    return csv_text([_target(row)], lineterminator="")


def save_decisions(path, lines, answer_keys):
    """Put lines (learner, lesson, exercise, points, comment) into the table of decisions; returns how many.

    A line takes the place of the one about the same; without points and comment it only removes that. Two
    more cells say which points and comment the line is to replace: ConflictError, if there are others.
    TableError: a line has a mistake, and nothing is written.
    """
    with one_at_a_time(path.with_name(f".{path.name}.lock")):  # another tab, or another run, may save now
        table, saved, new = read_csv(path), saved_decisions(path), []
        if set(DECISION_COLUMNS) - {name.casefold() for name in table.columns}:
            raise TableError(f"{path}: it needs the columns {', '.join(DECISION_COLUMNS)}")
        for row in csv.reader(io.StringIO(lines, newline="")):
            if len(row) not in (len(DECISION_COLUMNS), _VERSIONED):
                raise TableError(f"a line has {len(row)} cells; expected {', '.join(DECISION_COLUMNS)}")
            new.append(dict(zip(DECISION_COLUMNS, row, strict=False)))
            is_there = saved.get(_line_of(new[-1]), ["", ""])
            if len(row) == _VERSIONED and is_there != row[-2:]:
                there = ", ".join(filter(None, is_there)) or "no decision"
                raise ConflictError(f"{row[0]} has got {there!r} from another page; reload this one")
        text = _without(table, {_target(row) for row in new})
        cells_of = itemgetter(*map(str.casefold, table.columns))
        decided = [cells_of(row) for row in new if row["points"] or row["comment"]]
        text += csv_text(decided, delimiter=table.delimiter)
        read_decisions(path, answer_keys, text)
        write_grades_file(path, text)
    return len(new)


def _without(table, targets):
    """The text of a table without its rows about `targets`, ended by a line end."""
    lines = list(io.StringIO(table.path.read_bytes().decode("utf-8"), newline=""))
    reader, kept, begin = csv.reader(iter(lines), delimiter=table.delimiter), [], 0
    for cells in reader:
        if _target(table.record(cells)) not in targets:
            kept += lines[begin : reader.line_num]
        begin = reader.line_num
    text = "".join(kept)
    return text if text.endswith("\n") else f"{text}\n"


def _target(row):
    learner = row.get("learner", "")  # as grades.csv writes it, or by hand without an apostrophe
    learner = learner if "'" in learner else spreadsheet_text(learner)
    return learner, lesson_name(row.get("lesson", "")), row.get("exercise", "")
