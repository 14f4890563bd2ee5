# %% name="not centered" sentence="Subtract the means first." must_say=["mean"] kind="value"
def find_motion(before, after):
    U, _, V = np.linalg.svd(after.T @ before)
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, after.mean(axis=0) - R @ before.mean(axis=0)

# %% name="only the rotation" sentence="Return two arrays: the shift is missing." must_say=["two|shift"] kind="shape"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    return U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
