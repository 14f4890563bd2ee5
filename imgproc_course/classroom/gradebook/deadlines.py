"""Deadlines: who is late, by how many days, and what that costs.

    --deadline 2026-12-01T23:59 --late "10% a day, 3 days"

Each day that has begun after the deadline costs 10 % of the points that the lesson got; after three days the
lesson gets none. Without the second part the deduction grows to 100 %. A learner can have another deadline.
"""

import contextlib
import math
import re
from dataclasses import dataclass, field
from datetime import date, datetime, time, timedelta

_POLICY = re.compile(r"(\d{1,3}(?:\.\d{1,2})?) ?% (?:a|per) day(?:, ?(\d{1,4}) days?)?", re.I)


def local_time_of(text):
    """The local time in a text like 2026-12-01T23:59, perhaps with a zone; ValueError: it holds none.

    A date alone means its last second: work of that day is in time.
    """
    with contextlib.suppress(ValueError):
        return datetime.combine(date.fromisoformat(text), time(23, 59, 59))
    moment = datetime.fromisoformat(text)
    return moment.astimezone().replace(tzinfo=None) if moment.tzinfo else moment


@dataclass(frozen=True)
class LatePolicy:
    """What lateness costs: `percent` of the points per day; after `days` days (None: no such limit) all."""

    percent: float
    days: int | None
    text: str

    def factor(self, days_late):
        """The share of the points that is left, 0 to 1."""
        if self.days is not None and days_late > self.days:
            return 0.0
        return max(0.0, 1 - self.percent * days_late / 100)


def read_late_policy(text):
    """The LatePolicy of a text, "10% a day" or "10% a day, 3 days"; ValueError: it is something else."""
    match = _POLICY.fullmatch(text.strip())
    if not match or not 0 < float(match[1]) <= 100:
        raise ValueError(f'{text[:60]!r} is no late policy; write "10% a day" or "10% a day, 3 days"')
    return LatePolicy(float(match[1]), int(match[2]) if match[2] else None, text.strip())


@dataclass(frozen=True)
class Deadlines:
    """The deadline, a local time, the late policy, and {learner's name: list of Extension}."""

    deadline: datetime | None = None
    policy: LatePolicy | None = None
    extensions: dict = field(default_factory=dict)

    def due(self, learner, lesson):
        """(the deadline of a learner's lesson or None, whether it is an extension)."""
        for scope in (lesson, ""):
            for extension in self.extensions.get(learner, ()):
                if extension.lesson == scope:
                    return extension.deadline, True
        return self.deadline, False

    def days_late(self, learner, lesson, file):
        """How many days had begun after the deadline when a file was submitted; 0 if it was in time."""
        due, _ = self.due(learner, lesson)
        if due is None or file.submitted_at is None or file.submitted_at <= due:
            return 0
        return math.ceil((file.submitted_at - due) / timedelta(days=1))

    def is_late(self, learner, lesson, file):
        """Whether a file is late: by its time, or as the platform says if there is no extension."""
        _, extended = self.due(learner, lesson)
        return self.days_late(learner, lesson, file) > 0 or (file.late and not extended)
