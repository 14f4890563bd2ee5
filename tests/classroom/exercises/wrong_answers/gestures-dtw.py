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
