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
# %% name="changes the given grid" origin="fresh" sentence="You write into the given grid; the task wants a new one." must_say=["given|copy|chang"] kind="input-changed"
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
# %% name="each ray adds" origin="fresh" sentence="A cell that several rays pass must change once, you add again for each ray." must_say=["once|several|twice|each ray|more than one"] kind="value"
def add_scan(grid, rays, hit, passed):
    new = grid.copy()
    for ray in rays:
        for row, col in ray[:-1]:
            new[row, col] += math.log(passed / (1 - passed))
        row, col = ray[-1]
        new[row, col] += math.log(hit / (1 - hit))
    return np.clip(new, -6, 6)
# %% name="a later ray passes over a hit" origin="fresh" sentence="A later ray that passes overwrites the hit of an earlier one: write the ends last." must_say=["hit|end"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(passed / (1 - passed))
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    return np.clip(grid + change, -6, 6)
# %% name="probabilities added" origin="fresh" sentence="You add the probabilities, not their log-odds." must_say=["log|odds"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = passed
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = hit
    return np.clip(grid + change, -6, 6)
# %% name="odds upside down" origin="fresh" sentence="The odds are p / (1 - p), you have (1 - p) / p." must_say=["p / \\(1|sign|upside|1 - p|odds"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log((1 - passed) / passed)
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = math.log((1 - hit) / hit)
    return np.clip(grid + change, -6, 6)
# %% name="no limits" origin="fresh" sentence="The result must stay between -6 and 6." must_say=["6|clip|limit"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(passed / (1 - passed))
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    return grid + change
# %% name="numbers of the lesson" origin="fresh" sentence="0.85 and -0.4 are the numbers of the lesson; compute them from hit and passed." must_say=["hit|0\\.85|given"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = -0.4
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = 0.85
    return np.clip(grid + change, -6, 6)
# %% name="only the change is limited" origin="fresh" sentence="You limit the change, but the sum of grid and change must be limited." must_say=["6|clip|limit"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            change[row, col] = math.log(passed / (1 - passed))
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    return grid + np.clip(change, -6, 6)
# %% name="old map forgotten" origin="fresh" sentence="The change must be added to the given grid; you return only the change." must_say=["add|given grid|grid|old"] kind="value"
def add_scan(grid, rays, hit, passed):
    new = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[:-1]:
            new[row, col] = math.log(passed / (1 - passed))
    for ray in rays:
        row, col = ray[-1]
        new[row, col] = math.log(hit / (1 - hit))
    return np.clip(new, -6, 6)
# %% name="first cell left out" origin="fresh" sentence="The first cell of a ray is passed too; the slice begins at 1." must_say=["first|start|begin|ray\\[|0"] kind="value"
def add_scan(grid, rays, hit, passed):
    change = np.zeros(grid.shape)
    for ray in rays:
        for row, col in ray[1:-1]:
            change[row, col] = math.log(passed / (1 - passed))
    for ray in rays:
        row, col = ray[-1]
        change[row, col] = math.log(hit / (1 - hit))
    return np.clip(grid + change, -6, 6)
