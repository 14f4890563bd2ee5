"""What a person reads while the tests run: which groups run, how many are left, and each failure at once."""

import time
from collections import Counter

from selection import group_of

SECONDS = 10  # between two lines


class Progress:
    """A line now and then in place of a dot for each test: a plugin of the process that hands them out."""

    def __init__(self, plugins):
        self._plugins, self._begin = plugins, time.monotonic()
        self._total, self._left, self._failed, self._written = Counter(), Counter(), 0, 0.0

    def pytest_collection_finish(self, session):
        self._expect(item.nodeid for item in session.items)

    def pytest_xdist_node_collection_finished(self, ids):
        self._expect(ids)

    def _expect(self, nodeids):
        if not self._total:
            self._left = Counter(map(group_of, nodeids))
            self._total = self._left.copy()

    def pytest_report_teststatus(self, report):
        if report.failed:
            return ("failed", "", "FAILED") if report.when == "call" else ("error", "", "ERROR")
        return ("passed" if report.when == "call" else "", "", "") if report.passed else None

    def pytest_runtest_logreport(self, report):
        if report.failed:
            self._failed += 1
            self._write_line(f"FAILED {report.nodeid} ({report.when})", red=True)
        if report.when == "teardown":
            group = group_of(report.nodeid)
            self._left[group] -= 1
            if not self._left[group] or time.monotonic() - self._written > SECONDS:
                self._write()

    def _write(self):
        self._written = time.monotonic()
        minutes, seconds = divmod(round(self._written - self._begin), 60)
        done, total = self._total.total() - self._left.total(), self._total.total()
        left = [(name, count) for name, count in self._left.items() if count]
        running = [f"{name} {count}" for name, count in left if count < self._total[name]]
        parts = [f"{minutes:3}:{seconds:02}  {done} of {total} tests"]
        parts += [f"{self._failed} failed"] * bool(self._failed)
        parts += [f"left of {', '.join(running)}"] * bool(running)
        parts += [f"{len(left) - len(running)} groups to come"] * (len(left) > len(running))
        self._write_line("; ".join(parts))

    def _write_line(self, line, **markup):
        self._plugins.get_plugin("terminalreporter").write_line(line, **markup)
