# %% name="set, not added" origin="fresh" sentence="Add the change to the old value." must_say=["add"] kind="value"
def add_scan(grid, rays, hit, passed):
    new = grid.copy()
    for ray in rays:
        for row, col in ray[:-1]:
            new[row, col] = math.log(passed / (1 - passed))
    for ray in rays:
        new[ray[-1]] = math.log(hit / (1 - hit))
    return np.clip(new, -6, 6)

# %% name="odds without log" origin="fresh" sentence="Take the logarithm of the odds." must_say=["logarithm|math.log"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = passed / (1 - passed)
    for ray in rays:
        change[ray[-1]] = hit / (1 - hit)
    return np.clip(grid + change, -6, 6)

# %% name="clipped to the wrong range" origin="fresh" sentence="The limits are -6 and 6." must_say=["6"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(passed / (1 - passed))
    for ray in rays:
        change[ray[-1]] = math.log(hit / (1 - hit))
    return np.clip(grid + change, 0, 6)

# %% name="log of 1 - p" origin="fresh" sentence="The log-odds are log(p / (1 - p))." must_say=["1 - p|log"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(1 - passed)
    for ray in rays:
        change[ray[-1]] = math.log(hit)
    return np.clip(grid + change, -6, 6)

# %% name="passing wins" origin="fresh" sentence="A hit wins: write the ends last." must_say=["win|last|second loop"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        change[ray[-1]] = math.log(hit / (1 - hit))
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(passed / (1 - passed))
    return np.clip(grid + change, -6, 6)
