"""A progress bar in a learner's notebook."""

import contextlib
import os
import sys
from collections.abc import Iterable, Iterator

from .progress import TEST_VARIABLE


@contextlib.contextmanager
def progress_bar(text):
    """Shows in a learner's notebook how much is done: gives a function of the share, else None."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    if not hasattr(shell, "kernel") or TEST_VARIABLE in os.environ:
        yield None
        return
    from IPython.display import display

    shown = display(_bar(text, 0), raw=True, display_id=True)
    try:
        yield lambda share: shown.update(_bar(text, share), raw=True)
    finally:
        shown.update({"text/plain": "", "text/html": ""}, raw=True)


def with_progress(values: Iterable, text: str) -> Iterator:
    """The values one by one; a learner's notebook shows how many are done."""
    values = list(values)
    with progress_bar(text) as progress:
        for number, value in enumerate(values):
            if progress:
                progress(number / len(values))
            yield value


def _bar(text, share):
    bar = f'<progress value="{share:.2f}" max="1" aria-label="{text}"></progress>'
    return {"text/plain": f"{text}: {share:.0%}", "text/html": f"<div>{text} {bar} {share:.0%}</div>"}
