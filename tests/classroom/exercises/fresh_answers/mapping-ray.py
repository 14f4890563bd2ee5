# %% name="counter begins at steps" origin="fresh" sentence="The counter begins at 0: halves go away from the start, not more." must_say=["round up|nearest|half|halves"] kind="value"
def ray_cells(start, end):
    n = max(abs(end[0] - start[0]), abs(end[1] - start[1]))
    cells = []
    for k in range(n + 1):
        cell = []
        for axis in (0, 1):
            way = end[axis] - start[axis]
            cell.append(start[axis] + (k * abs(way) + n - 1) // n * (1 if way > 0 else -1))
        cells.append(tuple(cell))
    return cells

# %% name="np.rint" origin="fresh" sentence="np.rint rounds halves to even numbers." must_say=["half|halves"] kind="value"
def ray_cells(start, end):
    n = max(abs(end[0] - start[0]), abs(end[1] - start[1]))
    rows = np.rint(np.linspace(start[0], end[0], n + 1)).astype(int)
    cols = np.rint(np.linspace(start[1], end[1], n + 1)).astype(int)
    return list(zip(rows.tolist(), cols.tolist()))

# %% name="for columns only" origin="fresh" sentence="Steep rays need a step for each row." must_say=["larger|max|step"] kind="error"
def ray_cells(start, end):
    n = abs(end[1] - start[1])
    cells = []
    for k in range(n + 1):
        row = start[0] + (end[0] - start[0]) * k // n
        col = start[1] + k if end[1] > start[1] else start[1] - k
        cells.append((row, col))
    return cells

# %% name="diagonal, then straight" origin="fresh" sentence="Take the nearest row in each step, so that the rows spread over the whole ray." must_say=["nearest|formula"] kind="value"
def ray_cells(start, end):
    row, col = start
    cells = [start]
    while (row, col) != tuple(end):
        row += (end[0] > row) - (end[0] < row)
        col += (end[1] > col) - (end[1] < col)
        cells.append((row, col))
    return cells

# %% name="sign inside" origin="fresh" sentence="// rounds down below zero: compute with abs." must_say=["abs|sign"] kind="value"
def ray_cells(start, end):
    n = max(abs(end[0] - start[0]), abs(end[1] - start[1]))
    return [tuple(start[a] + (2 * k * (end[a] - start[a]) + n) // (2 * n) for a in (0, 1)) for k in range(n + 1)]
