# %% name="Python's round" origin="new" sentence="round(0.5) is 0: use whole numbers, so that halves go away from the start." must_say=["half|halves"] kind="value"
def ray_cells(start, end):
    d_row, d_col = end[0] - start[0], end[1] - start[1]
    n = max(abs(d_row), abs(d_col))
    return [(round(start[0] + d_row * k / n), round(start[1] + d_col * k / n)) for k in range(n + 1)]

# %% name="int cuts off" origin="new" sentence="int cuts off: take the nearest cell." must_say=["nearest"] kind="value"
def ray_cells(start, end):
    d_row, d_col = end[0] - start[0], end[1] - start[1]
    n = max(abs(d_row), abs(d_col))
    return [(start[0] + int(d_row * k / n), start[1] + int(d_col * k / n)) for k in range(n + 1)]

# %% name="// of a negative way" origin="new" sentence="// rounds down: take abs of the way first, and the sign afterwards." must_say=["sign|abs"] kind="value"
def ray_cells(start, end):
    d_row, d_col = end[0] - start[0], end[1] - start[1]
    n = max(abs(d_row), abs(d_col))
    return [(start[0] + (2 * k * d_row + n) // (2 * n), start[1] + (2 * k * d_col + n) // (2 * n)) for k in range(n + 1)]

# %% name="one cell for each column" origin="new" sentence="Steep rays need a step for each row: the larger of both ways." must_say=["larger|max"] kind="value"
def ray_cells(start, end):
    cells = []
    n = end[1] - start[1]
    if n == 0:
        return [start]
    step = 1 if n > 0 else -1
    for k in range(abs(n) + 1):
        way = end[0] - start[0]
        rows = (2 * k * abs(way) + abs(n)) // (2 * abs(n))
        cells.append((start[0] + rows * (1 if way > 0 else -1), start[1] + k * step))
    return cells

# %% name="end missing" origin="new" sentence="The end belongs to the ray: range(steps + 1)." must_say=["last|end"] kind="value"
def ray_cells(start, end):
    d_row, d_col = end[0] - start[0], end[1] - start[1]
    n = max(abs(d_row), abs(d_col))
    cells = []
    for k in range(n):
        rows, cols = (2 * k * abs(d_row) + n) // (2 * n), (2 * k * abs(d_col) + n) // (2 * n)
        cells.append((start[0] + rows * (1 if d_row > 0 else -1), start[1] + cols * (1 if d_col > 0 else -1)))
    return cells

# %% name="begins at k = 1" origin="new" sentence="The start belongs to the ray: count from 0." must_say=["first|start"] kind="value"
def ray_cells(start, end):
    d_row, d_col = end[0] - start[0], end[1] - start[1]
    n = max(abs(d_row), abs(d_col))
    cells = []
    for k in range(1, n + 1):
        rows, cols = (2 * k * abs(d_row) + n) // (2 * n), (2 * k * abs(d_col) + n) // (2 * n)
        cells.append((start[0] + rows * (1 if d_row > 0 else -1), start[1] + cols * (1 if d_col > 0 else -1)))
    return cells

# %% name="no sign" origin="new" sentence="The way can be negative: multiply by the sign." must_say=["sign|negative"] kind="value"
def ray_cells(start, end):
    d_row, d_col = abs(end[0] - start[0]), abs(end[1] - start[1])
    n = max(d_row, d_col)
    return [(start[0] + (2 * k * d_row + n) // (2 * n), start[1] + (2 * k * d_col + n) // (2 * n)) for k in range(n + 1)]

# %% name="start not added" origin="new" sentence="Add the start to the way." must_say=["start"] kind="value"
def ray_cells(start, end):
    d_row, d_col = end[0] - start[0], end[1] - start[1]
    n = max(abs(d_row), abs(d_col))
    cells = []
    for k in range(n + 1):
        rows, cols = (2 * k * abs(d_row) + n) // (2 * n), (2 * k * abs(d_col) + n) // (2 * n)
        cells.append((rows * (1 if d_row > 0 else -1), cols * (1 if d_col > 0 else -1)))
    return cells

# %% name="(column, row)" origin="new" sentence="A cell is (row, column)." must_say=["row"] kind="value"
def ray_cells(start, end):
    d_row, d_col = end[0] - start[0], end[1] - start[1]
    n = max(abs(d_row), abs(d_col))
    cells = []
    for k in range(n + 1):
        rows, cols = (2 * k * abs(d_row) + n) // (2 * n), (2 * k * abs(d_col) + n) // (2 * n)
        cells.append((start[1] + cols * (1 if d_col > 0 else -1), start[0] + rows * (1 if d_row > 0 else -1)))
    return cells

# %% name="return in the loop" origin="new" sentence="The return is inside the loop." must_say=["return|loop"] kind="value"
def ray_cells(start, end):
    d_row, d_col = end[0] - start[0], end[1] - start[1]
    n = max(abs(d_row), abs(d_col))
    cells = []
    for k in range(n + 1):
        rows, cols = (2 * k * abs(d_row) + n) // (2 * n), (2 * k * abs(d_col) + n) // (2 * n)
        cells.append((start[0] + rows * (1 if d_row > 0 else -1), start[1] + cols * (1 if d_col > 0 else -1)))
        return cells

# %% name="floats" origin="new" sentence="A cell has whole numbers: round." must_say=["round|whole"] kind="value"
def ray_cells(start, end):
    n = max(abs(end[0] - start[0]), abs(end[1] - start[1]))
    return [(start[0] + (end[0] - start[0]) * k / n, start[1] + (end[1] - start[1]) * k / n) for k in range(n + 1)]

# %% name="no return" origin="new" sentence="The function returns nothing: return the list." must_say=["return"] kind="no-return"
def ray_cells(start, end):
    n = max(abs(end[0] - start[0]), abs(end[1] - start[1]))
    cells = []
    for k in range(n + 1):
        cells.append((start[0] + k, start[1] + k))

# %% name="min in place of max" origin="new" sentence="The steps are the larger of both ways." must_say=["larger|max"] kind="value"
def ray_cells(start, end):
    d_row, d_col = end[0] - start[0], end[1] - start[1]
    n = max(1, min(abs(d_row), abs(d_col)))
    cells = []
    for k in range(n + 1):
        rows, cols = (2 * k * abs(d_row) + n) // (2 * n), (2 * k * abs(d_col) + n) // (2 * n)
        cells.append((start[0] + rows * (1 if d_row > 0 else -1), start[1] + cols * (1 if d_col > 0 else -1)))
    return cells
