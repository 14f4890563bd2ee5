"""Read and write a CSV table: one that a platform or a spreadsheet exported, or one that a teacher wrote."""

import csv
import io
import unicodedata
from dataclasses import dataclass
from pathlib import Path


class TableError(ValueError):
    """A table has a mistake, or cannot be read or filled; one line with the file, the row and the remedy."""


@dataclass(frozen=True)
class CsvTable:
    """A table in UTF-8; its first row that is not empty and no comment (#) has the names of the columns.

    `rows` are (number of its last line, list of cells) of those after it. The delimiter is a comma, a
    semicolon or a tab, and the byte order mark "" if the file has none.
    """

    path: Path
    columns: tuple
    rows: list
    delimiter: str
    byte_order_mark: str

    def record(self, row):
        """{column, in small letters: cell, without spaces around it} of a row."""
        cells = (unicodedata.normalize("NFC", cell.strip()) for cell in row)
        return dict(zip(map(str.casefold, self.columns), cells, strict=False))


def read_csv(path, text=None):
    """The CsvTable in a file, or in the text that it shall have; TableError: it cannot be read."""
    path = Path(path)
    if text is None:
        try:
            text = path.read_bytes().decode("utf-8")
        except UnicodeDecodeError as error:
            raise TableError(f"{path}: it is not UTF-8; export it again, or save it as CSV UTF-8") from error
        except OSError as error:
            raise TableError(f"{path}: it cannot be read ({error.strerror})") from error
    byte_order_mark = "\ufeff" if text.startswith("\ufeff") else ""
    text = text.removeprefix(byte_order_mark)
    first_line = next((line for line in text.splitlines() if not is_comment([line.strip(' "')])), "")
    delimiter = max(",;\t", key=first_line.count)
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)
    try:
        rows = [(reader.line_num, row) for row in reader]
    except csv.Error as error:
        raise TableError(f"{path}, row {reader.line_num}: it is not CSV ({error})") from error
    header = next((place for place, (_, row) in enumerate(rows) if not is_comment(row)), len(rows))
    columns = tuple(column.strip() for _, row in rows[header : header + 1] for column in row)
    rows = rows[header + 1 :]
    return CsvTable(path, columns, rows, delimiter, byte_order_mark)


def is_comment(cells):
    """Whether a row is empty, or begins with #."""
    return not any(map(str.strip, cells)) or cells[0].strip().startswith("#")


def csv_text(rows, **options):
    """The text of a CSV file, its lines ended as spreadsheets do; `options` are those of `csv.writer`."""
    buffer = io.StringIO()
    csv.writer(buffer, **options).writerows(rows)
    return buffer.getvalue()
