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

# %% name="no transpose" sentence="(after - a) must be transposed, so that the product is 3 x 3." must_say=["\\.T|transpos|shape|fit"] kind="error"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a) @ (before - b))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, a - R @ b

# %% name="in place" sentence="You changed the input: make a new array, before - mean." must_say=["input|chang|new"] kind="input-changed"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    before -= b
    after -= a
    U, _, V = np.linalg.svd(after.T @ before)
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, a - R @ b

# %% name="least squares" sentence="This matrix also stretches: it is not a rotation." must_say=["rotation|stretch"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    R = np.linalg.lstsq(before - b, after - a)[0].T
    return R, a - R @ b
