"""The kernels that run one submission's page, and the processes in which its checks run."""

from .sandbox.cell_run import CellRun
from .sanitize import reproducible_text

_PAGE_SECONDS = 60.0  # of processor time, that a page may take beside its checks; see `exercises.page_run`
_MOST_ENDS = 10  # of kernels by statements of one page
_MOST_ATTEMPTS = 40


class PageKernels:
    """Kernels that run a page (see `exercises.page`) up to one check after another.

    Exercises that allow the same modules share a kernel, and each of them has a process that is forked from
    it: what one check leaves behind does not reach the next one. Each drive has a kernel of its own.
    """

    def __init__(self, page, kernel_factory):
        self._page, self._kernel_factory = page, kernel_factory
        self._kernel, self._allowed, self._place = None, (), []
        # Statements that end the process; those at which one ended once
        self._skip, self._ended_at = [], set()
        self.tried = {}  # {(exercise id or "", what its code tried): None}

    def in_order(self, exercises):
        """Exercises in the order in which their checks are to run."""
        allowed = list(dict.fromkeys(exercise.allowed for exercise in exercises))
        checks = self._page["checks"]
        return sorted(
            exercises, key=lambda one: (allowed.index(one.allowed), checks.get(one.id, [0, 0]), one.id)
        )

    def open_check(self, exercise, seconds, *, alone=False):
        """(the Connection to a process in which the page has run up to the check, the CellRun of the answer).

        `seconds` of processor time are the first case's. `alone`: while no other kernel waits, which could
        use memory that this one needs.
        """
        place = self._page["checks"][exercise.id]
        if not alone and exercise.kind.shares_kernel:
            kernel, run = self._run_to(place, exercise.allowed)
            check = None if run.ended else kernel.fork_check(seconds)
            if check is not None:
                return check, self._about(exercise, run, check.run_below(exercise.function))
        self.close()
        kernel, run = self._start(place, exercise.allowed, seconds, alone=alone)
        below = run if run.ended else kernel.run_below(exercise.function)
        return kernel, self._about(exercise, run, below)

    def _run_to(self, place, allowed):
        """(the kernel that the exercises share, the CellRun of the page, which runs on to a place in it)."""
        if self._kernel is not None and self._allowed == allowed and self._place <= place:
            run = self._kernel.run_page(place)
            self._place = place
            if not run.ended:
                return self._kernel, run
        self.close()
        self._kernel, run = self._start(place, allowed, 0.0)
        self._allowed, self._place = allowed, place
        return self._kernel, run

    def _start(self, place, allowed, seconds, *, alone=False):
        """(a kernel, the CellRun of the page up to a place in it), without what ends the process."""
        for _ in range(_MOST_ENDS):
            kernel = self._kernel_factory.start(allowed, _PAGE_SECONDS + seconds, alone=alone)
            run = kernel.open_page(self._page, self._skip)
            run = run if run.ended else kernel.run_page(place)
            if not run.ended or (not run.place and run.ended != "gone"):
                break
            self._note_end(run)
            kernel.stop()
        return kernel, run

    def _note_end(self, run):
        """Leave out the statement that ended a process; after an end of another kind only the second time.

        Somebody else may have ended it, for example the system, which had no memory left.
        """
        self.note_attempts(run)
        if run.ended == "time" or run.place in self._ended_at:
            self._skip.append(run.place)
        elif run.ended != "gone":
            self._ended_at.add(run.place)

    def _about(self, exercise, run, below):
        """The CellRun of an exercise's answer: its first error, and how it ended."""
        errors, cells = below.errors or run.errors, self._page["cells"]
        self.note_attempts(run)
        self.note_attempts(below)
        own = [
            error
            for number, *error in errors
            if number < len(cells) and cells[number]["exercise"] == exercise.id
        ]
        error = tuple(own[0]) if own else ("", "")
        return CellRun(ended=run.ended or below.ended, error=error, errors=errors)

    def note_attempts(self, run, exercise=""):
        """Note what a CellRun tried: that of a cell of the page, or of the check of an exercise."""
        cells = self._page["cells"]
        for number, text in run.tried[:_MOST_ATTEMPTS]:
            is_of_page = number is not None and number < len(cells)
            attempt = cells[number]["exercise"] if is_of_page else exercise, reproducible_text(text)
            if len(self.tried) < _MOST_ATTEMPTS:
                self.tried[attempt] = None

    def close(self):
        """End the kernel that exercises share."""
        if self._kernel is not None:
            self._kernel.stop()
        self._kernel = None
