"""Serves the teacher's pages on this machine alone, and saves what is decided on them in decisions.csv.

Every address begins with a token, which nobody else on this machine or in another page can know.
"""

import contextlib
import csv
import io
import re
import secrets
import threading
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from itertools import chain
from operator import itemgetter
from pathlib import Path

from ..authoring.lesson_names import lesson_name
from ..autograder.sanitize import spreadsheet_text
from .answer_keys import load_keys
from .csv_table import TableError, csv_text, read_csv
from .report import count_of
from .result_store import write_grades_file
from .teacher_tables import DECISION_COLUMNS, read_decisions

_PAGES = ("*.html", "review/*.html", "learners/*.html")
_LENGTH = re.compile(r"\d{1,7}", re.A)  # of decisions saved at once, in bytes


class ReviewServer(ThreadingHTTPServer):
    """Serves the pages of a folder of grades on loopback; `url` is the address of their first page."""

    daemon_threads = True

    def __init__(self, out, decisions, answer_keys):
        super().__init__(("127.0.0.1", 0), _Handler)
        self.out, self.decisions, self.answer_keys = Path(out), Path(decisions), answer_keys
        self.token, self.lock = secrets.token_urlsafe(32), threading.Lock()
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
    with ReviewServer(out, decisions or Path(out) / "decisions.csv", load_keys(keys)) as server:
        say(f"Read the answers and decide: {server.url}")
        say("What you type there is saved at once, and counted when you press Ctrl-C here.")
        with contextlib.suppress(KeyboardInterrupt):
            server.serve_forever()


class _Handler(BaseHTTPRequestHandler):
    server: ReviewServer
    timeout = 60  # seconds that a browser may be silent

    def do_GET(self):
        page = self.server.read(self.path.partition("?")[0])
        self._answer(HTTPStatus.NOT_FOUND if page is None else HTTPStatus.OK, page or b"", "text/html")

    def do_POST(self):
        address = f"/{self.server.token}/decisions"
        if not secrets.compare_digest(self.path.encode(), address.encode()):
            return self._answer(HTTPStatus.NOT_FOUND)
        length = self.headers.get("Content-Length", "none")
        body = self.rfile.read(int(length)) if _LENGTH.fullmatch(length) else b""
        try:
            if str(len(body)) != length:
                raise ValueError(f"{len(body)} bytes came with the Content-Length {length[:20]!r}")
            with self.server.lock:  # another tab of the browser may save now
                number = save_decisions(self.server.decisions, body.decode(), self.server.answer_keys)
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


def save_decisions(path, lines, answer_keys):
    """Put lines (learner, lesson, exercise, points, comment) into the table of decisions; returns how many.

    A line takes the place of the one about the same; without points and comment it only removes that.
    TableError: a line has a mistake, and nothing is written.
    """
    table = read_csv(path)
    if set(DECISION_COLUMNS) - {name.casefold() for name in table.columns}:
        raise TableError(f"{path}: it needs the columns {', '.join(DECISION_COLUMNS)}")
    new = []
    for row in csv.reader(io.StringIO(lines, newline="")):
        if len(row) != len(DECISION_COLUMNS):
            raise TableError(f"a line has {len(row)} cells; expected {', '.join(DECISION_COLUMNS)}")
        new.append(dict(zip(DECISION_COLUMNS, row, strict=True)))
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
