# %% name="no return" sentence="The function returns nothing: return the list." must_say=["return"] kind="no-return"
def ray_cells(start, end):
    n = max(abs(end[0] - start[0]), abs(end[1] - start[1]))
    cells = []
    for k in range(n + 1):
        cells.append((start[0] + k, start[1] + k))
