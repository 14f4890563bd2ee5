"""Exercises: declared in a master, checked in the learner's notebook, graded by the instructor."""

import sys

from .canonical import array_of
from .check_files import CheckFileError
from .checking import CheckResult, check, run_cases
from .declaration import MasterError, exercise, read_exercises
from .error_advice import advise_everywhere
from .guesses import GuessComparison, ask, compare_guess, read_bare_guess
from .help_steps import hint, solution
from .kinds.node.ros_double import offer_modules
from .names_read import RUNS
from .overview import Overview, certificate, overview
from .progress_bar import with_progress

__all__ = ["CheckFileError", "CheckResult", "GuessComparison", "MasterError", "Overview"]
__all__ += ["array_of", "ask", "certificate", "check", "compare_guess", "exercise", "hint", "offer_modules"]
__all__ += ["overview", "read_exercises", "run_cases", "solution", "with_progress"]

_shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
if _shell is not None:  # a kernel
    _shell.events.register("pre_run_cell", RUNS.begin)
    _shell.events.register("post_run_cell", RUNS.end)
    _shell.input_transformers_cleanup.append(lambda lines: read_bare_guess(lines, _shell.user_ns))
advise_everywhere()
