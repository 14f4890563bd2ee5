# %% name="no comparison" sentence="Compare: keep a mask only if it has more inliers." must_say=["last|compare|sum|keep"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T + t - after, axis=1) < limit
    return near
