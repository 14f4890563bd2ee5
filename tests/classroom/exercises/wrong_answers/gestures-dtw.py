# %% name="point by point" origin="new" sentence="A point may be paired with several points: fill the table." must_say=["several|table"] kind="value"
def dtw_cost(track, other):
    total = 0.0
    for p, q in zip(track, other):
        total += np.linalg.norm(p - q)
    return total

# %% name="squares" origin="new" sentence="Take the square root: the L2 norm." must_say=["root|norm"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = ((track[i] - other[j]) ** 2).sum()
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs[-1, -1]

# %% name="L1" origin="new" sentence="The distance is the L2 norm." must_say=["L2|norm"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.abs(track[i] - other[j]).sum()
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs[-1, -1]

# %% name="only x" origin="new" sentence="A point has two numbers." must_say=["two numbers|x"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = abs(track[i][0] - other[j][0])
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs[-1, -1]

# %% name="no corner" origin="new" sentence="The neighbour above left is missing, so nothing comes from the 0." must_say=["above left|0 at"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + min(costs[i, j + 1], costs[i + 1, j])
    return costs[-1, -1]

# %% name="no left" origin="new" sentence="The neighbour to the left is missing." must_say=["left"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1])
    return costs[-1, -1]

# %% name="no above" origin="new" sentence="The neighbour above is missing." must_say=["above"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i + 1, j])
    return costs[-1, -1]

# %% name="zeros" origin="new" sentence="The border is infinite, not 0." must_say=["inf", "border"] kind="value"
def dtw_cost(track, other):
    costs = np.zeros((len(track) + 1, len(other) + 1))
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs[-1, -1]

# %% name="edit distance border" origin="new" sentence="The border is infinite; 0, 1, 2 belong to the edit distance." must_say=["inf", "border"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0] = np.arange(len(other) + 1)
    costs[:, 0] = np.arange(len(track) + 1)
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs[-1, -1]

# %% name="max" origin="new" sentence="Take the smallest of the three neighbours." must_say=["smallest"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + max(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs[-1, -1]

# %% name="no 0" origin="new" sentence="The table needs a 0 at the beginning." must_say=["0"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs[-1, -1]

# %% name="mean" origin="new" sentence="Return the sum, without a division." must_say=["sum|divided"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs[-1, -1] / (len(track) + len(other))

# %% name="the table" origin="new" sentence="Return the last number of the table." must_say=["last number"] kind="type"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs

# %% name="one too early" origin="new" sentence="The last number of the table is costs[-1, -1]." must_say=["last number|costs\\[-1, -1\\]"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs[len(track) - 1, len(other) - 1]

# %% name="index one too far" origin="new" sentence="The index is out of bounds: point i - 1 belongs to row i of the table." must_say=["index|out of bounds|begins with 0"] kind="error"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(1, len(track) + 1):
        for j in range(1, len(other) + 1):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i, j] = distance + min(costs[i - 1, j - 1], costs[i - 1, j], costs[i, j - 1])
    return costs[-1, -1]

# %% name="greedy" origin="new" sentence="One step after the other cannot correct an early choice: fill the whole table." must_say=["table"] kind="value"
def dtw_cost(track, other):
    i, j = 0, 0
    total = np.linalg.norm(track[0] - other[0])
    while i < len(track) - 1 or j < len(other) - 1:
        choices = []
        for a, b in [(i + 1, j + 1), (i + 1, j), (i, j + 1)]:
            if a < len(track) and b < len(other):
                choices.append((np.linalg.norm(track[a] - other[b]), a, b))
        step, i, j = min(choices)
        total += step
    return total

# %% name="nearest" origin="new" sentence="The order counts too: each point of both tracks is passed." must_say=["order|table"] kind="value"
def dtw_cost(track, other):
    total = 0.0
    for p in track:
        total += min(np.linalg.norm(p - q) for q in other)
    return total

# %% name="edit distance with 1" origin="walk" sentence="Each pair costs its distance, not 1." must_say=["distance"] kind="value"
def dtw_cost(track, other):
    n, m = len(track), len(other)
    costs = np.full((n + 1, m + 1), np.inf)
    costs[0, 0] = 0
    for i in range(1, n + 1):
        for j in range(1, m + 1):
            d = np.linalg.norm(track[i - 1] - other[j - 1])
            costs[i, j] = min(costs[i - 1, j] + 1, costs[i, j - 1] + 1, costs[i - 1, j - 1] + d)
    return costs[n, m]

# %% name="diagonal twice" origin="walk" sentence="The distance counts once for the step above left." must_say=["once|twice"] kind="value"
def dtw_cost(track, other):
    n, m = len(track), len(other)
    costs = np.full((n + 1, m + 1), np.inf)
    costs[0, 0] = 0
    for i in range(1, n + 1):
        for j in range(1, m + 1):
            d = np.linalg.norm(track[i - 1] - other[j - 1])
            costs[i, j] = min(costs[i - 1, j] + d, costs[i, j - 1] + d, costs[i - 1, j - 1] + 2 * d)
    return costs[n, m]

# %% name="free stretch" origin="walk" sentence="Each pair costs its distance." must_say=["each pair|distance"] kind="value"
def dtw_cost(track, other):
    n, m = len(track), len(other)
    costs = np.full((n + 1, m + 1), np.inf)
    costs[0, 0] = 0
    for i in range(1, n + 1):
        for j in range(1, m + 1):
            d = np.linalg.norm(track[i - 1] - other[j - 1])
            costs[i, j] = min(costs[i - 1, j], costs[i, j - 1], costs[i - 1, j - 1] + d)
    return costs[n, m]

# %% name="band" origin="walk" sentence="Fill the whole table, not a band." must_say=["whole table|band"] kind="value"
def dtw_cost(track, other):
    n, m = len(track), len(other)
    w = max(3, abs(n - m))
    costs = np.full((n + 1, m + 1), np.inf)
    costs[0, 0] = 0
    for i in range(1, n + 1):
        for j in range(max(1, i - w), min(m, i + w) + 1):
            d = np.linalg.norm(track[i - 1] - other[j - 1])
            costs[i, j] = d + min(costs[i - 1, j], costs[i, j - 1], costs[i - 1, j - 1])
    return costs[n, m]

# %% name="integers" origin="walk" sentence="The table must hold floats." must_say=["float|whole numbers"] kind="value"
def dtw_cost(track, other):
    n, m = len(track), len(other)
    big = 10 ** 9
    costs = np.full((n + 1, m + 1), big)
    costs[0, 0] = 0
    for i in range(1, n + 1):
        for j in range(1, m + 1):
            d = np.linalg.norm(track[i - 1] - other[j - 1])
            costs[i, j] = d + min(costs[i - 1, j], costs[i, j - 1], costs[i - 1, j - 1])
    return costs[n, m]
