"""Names the extra of this distribution that brings what is missing."""

import contextlib
from collections.abc import Iterator

# What pip calls an extra, and the modules of it that this package imports; `lab` brings all of them.
EXTRAS = {"ros": ("rosbags", "ruamel", "psutil"), "room": ("gymnasium",)}
_LAB = ("IPython", "anywidget", "click", "ipywidgets", "matplotlib", "rich", "traitlets")


@contextlib.contextmanager
def naming_extra() -> Iterator[None]:
    """Says of a module that cannot be imported which extra brings it."""
    try:
        yield
    except ModuleNotFoundError as error:
        module = (error.name or "").partition(".")[0]
        extra = next((extra for extra, modules in EXTRAS.items() if module in modules), "lab")
        if extra == "lab" and module not in _LAB:
            raise
        text = f'{module} is not installed; in the checkout of the course: pip install ".[{extra}]"'
        raise ModuleNotFoundError(text, name=error.name) from error
