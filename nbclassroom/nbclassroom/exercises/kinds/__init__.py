"""The kinds of answer, a folder each; an exercise names its kind with `subject`.

In each folder a module `kind` has a class `Kind`, which says what is particular about the kind (`kind.py`).
Nothing outside of the folders asks of which kind an answer is.
"""

import importlib
import pkgutil
from functools import cache

NAMES = tuple(sorted(module.name for module in pkgutil.iter_modules(__path__) if module.ispkg))


@cache
def kind_of(name):
    """The Kind of a name, such as "function"."""
    return importlib.import_module(f"{__name__}.{name}.kind").Kind()
