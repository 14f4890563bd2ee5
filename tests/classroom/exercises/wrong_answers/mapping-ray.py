# %% name="sign inside" sentence="// rounds down below zero: compute with abs." must_say=["abs|sign"] kind="value"
def ray_cells(start, end):
    n = max(abs(end[0] - start[0]), abs(end[1] - start[1]))
    return [tuple(start[a] + (2 * k * (end[a] - start[a]) + n) // (2 * n) for a in (0, 1)) for k in range(n + 1)]

# %% name="no return" sentence="The function returns nothing: return the list." must_say=["return"] kind="no-return"
def ray_cells(start, end):
    n = max(abs(end[0] - start[0]), abs(end[1] - start[1]))
    cells = []
    for k in range(n + 1):
        cells.append((start[0] + k, start[1] + k))

# %% name="for columns only" sentence="Steep rays need a step for each row." must_say=["larger|max|step"] kind="error"
def ray_cells(start, end):
    n = abs(end[1] - start[1])
    cells = []
    for k in range(n + 1):
        row = start[0] + (end[0] - start[0]) * k // n
        col = start[1] + k if end[1] > start[1] else start[1] - k
        cells.append((row, col))
    return cells

# %% name="floats" sentence="A cell has whole numbers: round." must_say=["round|whole"] kind="value"
def ray_cells(start, end):
    n = max(abs(end[0] - start[0]), abs(end[1] - start[1]))
    return [(start[0] + (end[0] - start[0]) * k / n, start[1] + (end[1] - start[1]) * k / n) for k in range(n + 1)]

# %% name="Python's round" sentence="round(0.5) is 0: use whole numbers, so that halves go away from the start." must_say=["half|halves"] kind="value"
def ray_cells(start, end):
    d_row, d_col = end[0] - start[0], end[1] - start[1]
    n = max(abs(d_row), abs(d_col))
    return [(round(start[0] + d_row * k / n), round(start[1] + d_col * k / n)) for k in range(n + 1)]
