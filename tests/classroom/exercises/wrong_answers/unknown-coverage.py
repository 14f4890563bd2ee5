# %% name="in percent" sentence="The result is a share from 0 to 1, not in percent." must_say=["0 to 1|100|percent"] kind="value"
def coverage(path, cells):
    pairs = {(math.floor(x / 0.5), math.floor(y / 0.5)) for x, y, _ in path}
    reachable = {tuple(cell) for cell in cells.tolist()}
    return 100 * len(pairs & reachable) / len(reachable)

# %% name="divided by what was entered" sentence="Divide by the number of cells that the robot can reach." must_say=["reach|len\\(cells\\)"] kind="value"
def coverage(path, cells):
    pairs = {(math.floor(x / 0.5), math.floor(y / 0.5)) for x, y, _ in path}
    reachable = {tuple(cell) for cell in cells.tolist()}
    return len(pairs & reachable) / max(len(pairs), 1)
