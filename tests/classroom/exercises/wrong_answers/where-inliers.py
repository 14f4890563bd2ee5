# %% name="no comparison" sentence="Compare: keep a mask only if it has more inliers." must_say=["last|compare|sum|keep"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T + t - after, axis=1) < limit
    return near

# %% name="R on the left" sentence="R @ before does not fit: the points are rows, so write before @ R.T." must_say=["before @ R\\.T|shape|fit|rows"] kind="error"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(R @ before + t - after, axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="axis 0" sentence="axis=0 gives one number for each coordinate: use axis=1." must_say=["axis|one for each pair|shape"] kind="shape"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T + t - after, axis=0) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="count" sentence="Return the mask, not how many." must_say=["mask"] kind="type"
def best_inliers(before, after, rotations, shifts, limit):
    best = 0
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T + t - after, axis=1) < limit
        if near.sum() > best:
            best = near.sum()
    return best

# %% name="masks joined" sentence="Only the inliers of the best motion count, not those of all." must_say=["best|all motions"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        best = best | (np.linalg.norm(before @ R.T + t - after, axis=1) < limit)
    return best
