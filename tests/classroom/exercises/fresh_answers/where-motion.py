# %% name="V by itself" origin="fresh" sentence="The rotation needs both U and V." must_say=["U"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    R = V @ U
    return R, a - R @ b

# %% name="one mean for both" origin="fresh" sentence="Subtract from after its own mean." must_say=["mean"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - b).T @ (before - a))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, a - R @ b

# %% name="elementwise" origin="fresh" sentence="* is element-wise: use @." must_say=["@"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, a - (R * b).sum(axis=0)

# %% name="t is the mean" origin="fresh" sentence="Subtract the turned mean of before." must_say=["mean of before|R @|subtract"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, a

# %% name="no transpose" origin="fresh" sentence="(after - a) must be transposed, so that the product is 3 x 3." must_say=["\\.T|transpos|shape|fit"] kind="error"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a) @ (before - b))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, a - R @ b
