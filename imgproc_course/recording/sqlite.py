"""SQLite files of rosbag2 (.db3), also with a write-ahead log, or without their end."""

import sqlite3
from collections import Counter

from .channels import Channel

ROWS = "SELECT timestamp, id, topic_id FROM messages NOT INDEXED WHERE typeof(timestamp) = 'integer'"


class SqliteFile:
    """An open file: see `McapFile`, which has the same attributes and methods."""

    def __init__(self, path, name, stack):
        self.name, self.problem, self.missing = name, "", 0
        log = path.with_name(f"{path.name}-wal")
        has_log = log.exists() and log.stat().st_size
        # Without locks, and with the log's index in memory, SQLite writes nothing, also not beside the file.
        options = "mode=ro&vfs=unix-none" if has_log else "immutable=1"
        uri = f"{path.resolve().as_uri()}?{options}"
        self._database = database = sqlite3.connect(uri, uri=True, check_same_thread=False)
        stack.callback(database.close)
        database.text_factory = lambda text: text.decode(errors="replace")
        database.execute("PRAGMA locking_mode = exclusive")
        database.execute("PRAGMA writable_schema = on")  # opens also a file that was cut off
        definitions = {}
        if database.execute("PRAGMA table_info(message_definitions)").fetchall():
            columns = "topic_type, encoding, encoded_message_definition"
            rows = database.execute(f"SELECT {columns} FROM message_definitions")
            definitions = {kind: definition for kind, *definition in rows}
        self.channels = {
            number: Channel.of(topic, kind, encoding, *definitions.get(kind, ()))
            for number, topic, kind, encoding in database.execute(
                "SELECT id, name, type, serialization_format FROM topics ORDER BY id"
            )
        }
        entries: set[tuple] = set()
        for order in ("ASC", "DESC"):  # from both ends to what is damaged
            try:
                entries.update(database.execute(f"{ROWS} ORDER BY id {order}"))
                break
            except sqlite3.DatabaseError:
                self.problem = "is damaged"
        if self.problem and not entries:
            raise EOFError("none of its messages can be read")
        self._rows = sorted(entries)
        self.counts = Counter(number for _, _, number in self._rows)
        times = [time for time, _, _ in self._rows] or [0]
        self.start, self.seconds = times[0], (times[-1] - times[0]) / 1e9

    def messages(self, numbers):
        for time, place, number in self._rows:
            if number in numbers:
                try:
                    yield time, place, number, self.read(place)
                except sqlite3.DatabaseError:
                    yield time, place, number, None

    def read(self, place):
        return self._database.execute("SELECT data FROM messages WHERE id = ?", (place,)).fetchone()[0]
