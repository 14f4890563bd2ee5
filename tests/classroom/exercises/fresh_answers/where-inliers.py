# %% name="best mean" origin="fresh" sentence="Choose the most inliers, not the smallest mean distance: wrong pairs spoil the mean." must_say=["most|mean"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    smallest = np.inf
    for R, t in zip(rotations, shifts):
        distances = np.linalg.norm(before @ R.T + t - after, axis=1)
        if distances.mean() < smallest:
            smallest, best = distances.mean(), distances < limit
    return best

# %% name="minus t" origin="fresh" sentence="Add the shift, do not subtract it." must_say=["\\+ t|shift|add"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T - t - after, axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="masks joined" origin="fresh" sentence="Only the inliers of the best motion count, not those of all." must_say=["best|all motions"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        best = best | (np.linalg.norm(before @ R.T + t - after, axis=1) < limit)
    return best

# %% name="shift first" origin="fresh" sentence="First turn, then shift." must_say=["turn|before @ R\\.T"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm((before + t) @ R.T - after, axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="a list" origin="fresh" sentence="Return an array of bool, not a list of numbers." must_say=["mask|array|True"] kind="type"
def best_inliers(before, after, rotations, shifts, limit):
    best = []
    for R, t in zip(rotations, shifts):
        distances = np.linalg.norm(before @ R.T + t - after, axis=1)
        near = [k for k in range(len(before)) if distances[k] < limit]
        if len(near) > len(best):
            best = near
    return best
