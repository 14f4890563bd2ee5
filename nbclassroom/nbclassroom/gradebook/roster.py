"""A roster: the table of everybody who should submit, as Moodle or Canvas exports it, or written by hand.

Canvas has one column for the name, Student ("Lovelace, Ada"), Moodle Full name, or First name and Last name;
by hand a column `name`, `student` or `email` is enough.
"""

import re
import unicodedata
from collections import Counter
from dataclasses import dataclass

from ..autograder.sanitize import sanitize_line
from .csv_table import TableError, read_csv

_FULL_NAME = ("student", "full name", "name", "learner", "student name")
_FIRST_NAME = ("first name", "firstname")
_LAST_NAME = ("last name", "lastname", "surname")
_OF_CANVAS = ("sis login id", "sis user id", "integration id", "login")
_IDENTITIES = ("email address", "email", "e-mail", "username", "id number", *_OF_CANVAS)
_NUMBERS = {"id": "canvas", "identifier": "moodle"}
_NUMBER = re.compile(r"(?<!\d)\d+$")
_CLASS_LIST_NUMBER = re.compile(r"\d+[ _.-]+(?=\S)")  # 01_ada
_NO_PEOPLE = ("", "student, test", "points possible")


@dataclass(frozen=True)
class RosterEntry:
    """One row: the `name` to show, all `names` of submissions, and `number`, (platform, digits) or None."""

    name: str
    names: tuple
    number: tuple | None

    def is_sender(self, name, numbers):
        """Whether a learner of this name, with these {(platform, digits)}, is this person."""
        # In Canvas a person has one number; in Moodle another one in each assignment.
        platforms = {platform for platform, _ in numbers}
        is_another = self.number and self.number[0] == "canvas" and "canvas" in platforms
        return self.number in numbers or (self.has_name(name) and not is_another)

    def has_name(self, name):
        """Whether this person's submission can arrive under a name."""
        return squeezed(name) in {squeezed(own) for own in self.names}


def read_roster(path):
    """Read a roster, as a list of RosterEntry; TableError: it cannot be read, or no column names people."""
    table = read_csv(path)
    columns = table.record(table.columns)
    if not columns.keys() & {*_FULL_NAME, *_FIRST_NAME, *_LAST_NAME, *_IDENTITIES}:
        listed = sanitize_line(", ".join(columns), 200) or "nothing"
        expected = "Student (Canvas), Full name, or First name and Last name (Moodle), name, email"
        raise TableError(f"{path}: its columns are {listed}; expected one that names people: {expected}")
    return list(filter(None, (entry_of(table.record(row)) for _, row in table.rows)))


def entry_of(row):
    """The RosterEntry of {column: cell}; None if the row is no person's."""
    full, *other_forms = _forms_of_name(row)
    identities = [row[column] for column in _IDENTITIES if row.get(column)]
    if full.casefold() in _NO_PEOPLE and not (full == "" and identities):
        return None
    identities += [text.partition("@")[0] for text in identities if "@" in text]
    names = tuple(dict.fromkeys(filter(None, (full, *other_forms, *identities))))
    numbers = ((platform, _NUMBER.search(row.get(column, ""))) for column, platform in _NUMBERS.items())
    number = next(((platform, match[0]) for platform, match in numbers if match), None)
    return RosterEntry(sanitize_line(full or identities[0], 120), names, number)


def _forms_of_name(row):
    """A person's name as the table has it, and with the first and with the last name first; perhaps empty."""
    full, first, last = (
        next((row[column] for column in columns if row.get(column)), "")
        for columns in (_FULL_NAME, _FIRST_NAME, _LAST_NAME)
    )
    if not full:
        full = f"{first} {last}".strip()
    elif "," in full:
        last, _, first = (part.strip() for part in full.partition(","))
    elif not last:
        first, _, last = full.rpartition(" ")
    return full, f"{first} {last}".strip(), f"{last} {first}".strip()


def squeezed(name):
    """A name by its letters and digits alone: Canvas writes lovelaceada for "Lovelace, Ada"."""
    return "".join(filter(str.isalnum, unicodedata.normalize("NFC", name).casefold()))


def _people(roster, learners):
    """{RosterEntry: the learners who are this person}.

    A folder that a class list numbered, 01_ada, is Ada's if nothing else arrived under her name.
    """
    people = {entry: [one for one in learners if entry.is_sender(one.name, one.numbers)] for entry in roster}
    names = {learner.name for senders in people.values() for learner in senders}
    numbers = [(one, _CLASS_LIST_NUMBER.match(one.name)) for one in learners if one.name not in names]
    numbered = [(one, one.name[number.end() :]) for one, number in numbers if number]
    for entry, senders in people.items():
        others = [learner for learner, name in numbered if entry.has_name(name)]
        if not senders and len(others) == 1:
            senders += others
    return people


def names_in_roster(roster, learners):
    """{a name that one person of a roster has: the learner's name, None if they submitted nothing}."""
    names: dict[str, str | None] = {}
    count = Counter(name for entry in roster for name in {entry.name, *entry.names})
    for entry, senders in _people(roster, learners).items():
        # Of two with nearly one name, the platform's number decides, then the exact name.
        own = set(map(str.casefold, entry.names))
        certainties = [(entry.number in one.numbers, one.name.casefold() in own, one.name) for one in senders]
        sender = max(certainties)[-1] if senders else None
        names |= {name: sender for name in (entry.name, *entry.names) if count[name] == 1}
    return names


def roster_report(roster, learners):
    """The roster's `count`, who submitted nothing (`missing`), and who is not in it (`unknown`): names."""
    people = _people(roster, learners)
    known = {learner.name for senders in people.values() for learner in senders}
    return {
        "count": len(roster),
        "missing": [entry.name for entry in roster if not people[entry]],
        "unknown": [learner.name for learner in learners if learner.name not in known],
    }
