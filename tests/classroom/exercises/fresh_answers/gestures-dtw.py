# %% name="min of the last row" origin="fresh" sentence="The pairing must reach the end of both tracks: the last number." must_say=["last"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs[-1].min()

# %% name="distance not added" origin="fresh" sentence="Add the distance of the two points to the smallest neighbour." must_say=["distance|add"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs[-1, -1]

# %% name="plus one for a stretch" origin="fresh" sentence="A stretch costs nothing by itself." must_say=["costs|neighbour|distance|add"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1] + 1, costs[i + 1, j] + 1)
    return costs[-1, -1]

# %% name="resampled" origin="fresh" sentence="Do not resample; fill the table." must_say=["table|several"] kind="value"
def dtw_cost(track, other):
    new = np.linspace(0, 1, 24)
    total = 0.0
    a = [np.interp(new, np.linspace(0, 1, len(track)), track[:, k]) for k in (0, 1)]
    b = [np.interp(new, np.linspace(0, 1, len(other)), other[:, k]) for k in (0, 1)]
    return float(np.hypot(a[0] - b[0], a[1] - b[1]).sum())

# %% name="square table" origin="fresh" sentence="The table has as many columns as the second track has points, plus one." must_say=["column|shape|out of bounds|len"] kind="error"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(track) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs[-1, -1]
