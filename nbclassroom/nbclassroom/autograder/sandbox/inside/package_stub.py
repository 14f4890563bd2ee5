"""Replaces packages inside the sandbox: those that check, give hints or show something (`silent_packages`).

An answer cell may check itself, ask for hints and show images, and nobody looks here.
"""

import importlib.util


def __getattr__(name):
    if name.startswith("__") or (
        __spec__.parent == __name__ and importlib.util.find_spec(f"{__name__}.{name}")
    ):
        raise AttributeError(name)
    return lambda *_arguments, **_options: None
