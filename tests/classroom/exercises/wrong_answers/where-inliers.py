# %% name="no comparison" sentence="Compare: keep a mask only if it has more inliers." must_say=["last|compare|sum|keep"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T + t - after, axis=1) < limit
    return near

# %% name="count" sentence="Return the mask, not how many." must_say=["mask"] kind="type"
def best_inliers(before, after, rotations, shifts, limit):
    best = 0
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T + t - after, axis=1) < limit
        if near.sum() > best:
            best = near.sum()
    return best
