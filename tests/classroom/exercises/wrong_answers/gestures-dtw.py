# %% name="edit distance with 1" sentence="Each pair costs its distance, not 1." must_say=["distance"] kind="value"
def dtw_cost(track, other):
    n, m = len(track), len(other)
    costs = np.full((n + 1, m + 1), np.inf)
    costs[0, 0] = 0
    for i in range(1, n + 1):
        for j in range(1, m + 1):
            d = np.linalg.norm(track[i - 1] - other[j - 1])
            costs[i, j] = min(costs[i - 1, j] + 1, costs[i, j - 1] + 1, costs[i - 1, j - 1] + d)
    return costs[n, m]

# %% name="square table" sentence="The table has as many columns as the second track has points, plus one." must_say=["column|shape|out of bounds|len"] kind="error"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(track) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs[-1, -1]

# %% name="the table" sentence="Return the last number of the table." must_say=["last number"] kind="type"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = np.linalg.norm(track[i] - other[j])
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs

# %% name="nearest" sentence="The order counts too: each point of both tracks is passed." must_say=["order|table"] kind="value"
def dtw_cost(track, other):
    total = 0.0
    for p in track:
        total += min(np.linalg.norm(p - q) for q in other)
    return total

# %% name="squares" sentence="Take the square root: the L2 norm." must_say=["root|norm"] kind="value"
def dtw_cost(track, other):
    costs = np.full((len(track) + 1, len(other) + 1), np.inf)
    costs[0, 0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            distance = ((track[i] - other[j]) ** 2).sum()
            costs[i + 1, j + 1] = distance + min(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return costs[-1, -1]
