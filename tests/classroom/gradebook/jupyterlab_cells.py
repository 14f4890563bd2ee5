"""What editors do to the cells of a notebook (a dict), as JupyterLab's notebook model does it.

JupyterLab's `mergeCells` joins sources with an empty line and keeps the metadata of the active cell; its
`splitCell` gives each part the metadata. The new cells have new ids.
"""

import uuid


def position_of(made, id):
    return next(number for number, cell in enumerate(made["cells"]) if cell["id"] == id)


def new_cell(source, kind="code", metadata=None):
    cell = {"id": uuid.uuid4().hex[:8], "cell_type": kind, "metadata": dict(metadata or {}), "source": source}
    return cell | ({"outputs": [], "execution_count": None} if kind == "code" else {})


def insert(made, position, *cells):
    made["cells"][position:position] = cells


def merge(made, first, last, active):
    """Merge the cells from `first` to `last` while the cell `active` is the active one."""
    cells = made["cells"][first : last + 1]
    main = made["cells"][active]
    metadata = main["metadata"] | ({"trusted": True} if main["cell_type"] == "code" else {})
    source = "\n\n".join(cell["source"] for cell in cells)
    made["cells"][first : last + 1] = [new_cell(source, main["cell_type"], metadata)]


def split(made, position, offset):
    """Split a cell at an offset of its source."""
    cell = made["cells"][position]
    parts = cell["source"][:offset], cell["source"][offset:]
    halves = [new_cell(part.strip("\n"), cell["cell_type"], cell["metadata"]) for part in parts]
    made["cells"][position : position + 1] = halves


def change_type(made, position, kind):
    cell = made["cells"][position]
    made["cells"][position] = new_cell(cell["source"], kind, cell["metadata"])


def copy_and_paste(made, position):
    cell = made["cells"][position]
    insert(made, position + 1, new_cell(cell["source"], cell["cell_type"], cell["metadata"]))
