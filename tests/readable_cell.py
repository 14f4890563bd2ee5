"""Run a cell as IPython does: its source stays readable by the name of its file."""

import linecache


def run_cell(source, names=None, file="<cell>"):
    """The namespace after a source has run in it, a new one if none is given."""
    names = {} if names is None else names
    linecache.cache[file] = (len(source), None, source.splitlines(keepends=True), file)
    exec(compile(source, file, "exec"), names)
    return names
