# %% name="ends only" sentence="The cells on the way are free: add the log-odds of passed." must_say=["way|passed"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    return np.clip(grid + change, -6, 6)

# %% name="changes the given grid" sentence="You write into the given grid; the task wants a new one." must_say=["given|copy|chang"] kind="input-changed"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(passed / (1 - passed))
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    grid += change
    return np.clip(grid, -6, 6)

# %% name="passing wins" sentence="A hit wins: write the ends last." must_say=["win|last|second loop"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        change[ray[-1]] = math.log(hit / (1 - hit))
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(passed / (1 - passed))
    return np.clip(grid + change, -6, 6)

# %% name="each ray adds" sentence="A cell that several rays pass must change once, you add again for each ray." must_say=["once|several|twice|each ray|more than one"] kind="value"
def add_scan(grid, rays, hit, passed):
    new = grid.copy()
    for ray in rays:
        for row, col in ray[:-1]:
            new[row, col] += math.log(passed / (1 - passed))
        row, col = ray[-1]
        new[row, col] += math.log(hit / (1 - hit))
    return np.clip(new, -6, 6)

# %% name="a later ray passes over a hit" sentence="A later ray that passes overwrites the hit of an earlier one: write the ends last." must_say=["hit|end"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(passed / (1 - passed))
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    return np.clip(grid + change, -6, 6)
