# %% name="added for each ray" origin="new" sentence="Each cell changes once in a scan: = into a grid of changes, not +=." must_say=["once"] kind="value"
def add_scan(grid, rays, hit, passed):
    result = grid.copy()
    for ray in rays:
        for row, col in ray[:-1]:
            result[row, col] += math.log(passed / (1 - passed))
        row, col = ray[-1]
        result[row, col] += math.log(hit / (1 - hit))
    return np.clip(result, -6, 6)

# %% name="one loop" origin="new" sentence="A later ray overwrites an end: write the ends in a second loop." must_say=["second loop|last|win"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(passed / (1 - passed))
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    return np.clip(grid + change, -6, 6)

# %% name="no clip" origin="new" sentence="Stop at -6 and 6." must_say=["6"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(passed / (1 - passed))
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    return grid + change

# %% name="old map lost" origin="new" sentence="Add the change to the old map." must_say=["add|old map"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(passed / (1 - passed))
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    return np.clip(change, -6, 6)

# %% name="probabilities" origin="new" sentence="Add log-odds, not probabilities." must_say=["log"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = passed
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = hit
    return np.clip(grid + change, -6, 6)

# %% name="log of the probability" origin="new" sentence="Log-odds are log(p / (1 - p))." must_say=["1 - p"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = np.log(passed)
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = np.log(hit)
    return np.clip(grid + change, -6, 6)

# %% name="base 10" origin="new" sentence="Use the natural logarithm." must_say=["natural|base 10|math.log"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = np.log10(passed / (1 - passed))
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = np.log10(hit / (1 - hit))
    return np.clip(grid + change, -6, 6)

# %% name="passed subtracted" origin="new" sentence="The log-odds of passed are negative already: add them." must_say=["negative"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = -math.log(passed / (1 - passed))
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    return np.clip(grid + change, -6, 6)

# %% name="fixed numbers" origin="new" sentence="Use hit and passed, not 0.85 and -0.4." must_say=["hit"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = -0.4
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = 0.85
    return np.clip(grid + change, -6, 6)

# %% name="grid changed in place" origin="new" sentence="The given grid must stay as it was: copy it, or make a new one." must_say=["copy|changed|new"] kind="input-changed"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(passed / (1 - passed))
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    grid += change
    np.clip(grid, -6, 6, out=grid)
    return grid

# %% name="ends only" origin="new" sentence="The cells on the way are free: add the log-odds of passed." must_say=["way|passed"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    return np.clip(grid + change, -6, 6)

# %% name="without the robot's cell" origin="new" sentence="The first cell is free too." must_say=["first"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[1:-1]:
            change[row, col] = math.log(passed / (1 - passed))
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    return np.clip(grid + change, -6, 6)

# %% name="return in the loop" origin="new" sentence="The return is inside the loop: only one ray counts." must_say=["loop|first ray"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(passed / (1 - passed))
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
        return np.clip(grid + change, -6, 6)
