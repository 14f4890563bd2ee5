# %% name="not centered" sentence="Subtract the means first." must_say=["mean"] kind="value"
def find_motion(before, after):
    U, _, V = np.linalg.svd(after.T @ before)
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, after.mean(axis=0) - R @ before.mean(axis=0)
