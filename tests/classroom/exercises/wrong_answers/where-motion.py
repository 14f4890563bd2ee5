# %% name="mirror" origin="new" sentence="This can be a mirror: use the determinant." must_say=["mirror|determinant"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    R = U @ V
    return R, a - R @ b

# %% name="minus R" origin="new" sentence="Change only the last column of U, not the whole matrix." must_say=["last|column"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    R = U @ V
    if np.linalg.det(R) < 0:
        R = -R
    return R, a - R @ b

# %% name="first column" origin="new" sentence="The determinant belongs to the last column." must_say=["last|column"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    R = U @ np.diag([np.linalg.det(U @ V), 1, 1]) @ V
    return R, a - R @ b

# %% name="V transposed" origin="new" sentence="NumPy's third result is already transposed: no V.T." must_say=["V|transpos"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V.T
    return R, a - R @ b

# %% name="product exchanged" origin="new" sentence="This rotation goes from after to before: exchange the two in the product." must_say=["from after|exchang|order|transpos"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((before - b).T @ (after - a))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, a - R @ b

# %% name="not centered" origin="new" sentence="Subtract the means first." must_say=["mean"] kind="value"
def find_motion(before, after):
    U, _, V = np.linalg.svd(after.T @ before)
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, after.mean(axis=0) - R @ before.mean(axis=0)

# %% name="difference of means" origin="new" sentence="The mean of before must be turned: t = a - R @ b." must_say=["turn|R @"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, a - b

# %% name="t the other way" origin="new" sentence="The sign of t is wrong: t = a - R @ b." must_say=["sign|R @"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, R @ b - a

# %% name="b @ R" origin="new" sentence="Write R @ b, not b @ R." must_say=["R @"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, a - b @ R

# %% name="one mean" origin="new" sentence="Take the mean over axis 0: one for each coordinate." must_say=["axis"] kind="error"
def find_motion(before, after):
    b, a = before.mean(), after.mean()
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, a - R @ b

# %% name="means of the points" origin="new" sentence="axis=1 is the mean of x, y and z of each point: use axis=0." must_say=["axis"] kind="error"
def find_motion(before, after):
    b, a = before.mean(axis=1), after.mean(axis=1)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, a - R @ b

# %% name="order" origin="new" sentence="Return the rotation first." must_say=["first|order"] kind="shape"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return a - R @ b, R

# %% name="only the rotation" origin="new" sentence="Return two arrays: the shift is missing." must_say=["two|shift"] kind="shape"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    return U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V

# %% name="least squares" origin="new" sentence="This matrix also stretches: it is not a rotation." must_say=["rotation|stretch"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    R = np.linalg.lstsq(before - b, after - a)[0].T
    return R, a - R @ b

# %% name="in place" origin="new" sentence="You changed the input: make a new array, before - mean." must_say=["input|chang|new"] kind="input-changed"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    before -= b
    after -= a
    U, _, V = np.linalg.svd(after.T @ before)
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, a - R @ b

# %% name="rounded" origin="new" sentence="Return the exact numbers: leave round out." must_say=["round|exact"] kind="value"
def find_motion(before, after):
    b, a = before.mean(axis=0), after.mean(axis=0)
    U, _, V = np.linalg.svd((after - a).T @ (before - b))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R.round(2), (a - R @ b).round(2)

# %% name="two numbers on the diagonal" origin="new" sentence="The diagonal has three numbers: 1, 1 and the determinant." must_say=["diag", "n × n|three"] kind="error" must_not_say=["value by value"]
def find_motion(before, after):
    b = before - before.mean(axis=0)
    a = after - after.mean(axis=0)
    U, _, V = np.linalg.svd(a.T @ b)
    R = U @ np.diag([1, np.linalg.det(U @ V)]) @ V
    return R, after.mean(axis=0) - R @ before.mean(axis=0)

# %% name="a @ b.T" origin="new" sentence="The product must be 3 × 3: a.T @ b." must_say=["a.T @ b", "3 × 3"] kind="error" must_not_say=["value by value"]
def find_motion(before, after):
    b = before - before.mean(axis=0)
    a = after - after.mean(axis=0)
    U, _, V = np.linalg.svd(a @ b.T)
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, after.mean(axis=0) - R @ before.mean(axis=0)

# %% name="U * diag * V" origin="new" sentence="Matrices are multiplied with @, not with *." must_say=["@", "value by value|not with"] kind="value"
def find_motion(before, after):
    b = before - before.mean(axis=0)
    a = after - after.mean(axis=0)
    U, _, V = np.linalg.svd(a.T @ b)
    R = U * np.diag([1, 1, np.linalg.det(U @ V)]) * V
    return R, after.mean(axis=0) - R @ before.mean(axis=0)

# %% name="the mean over the columns" origin="new" sentence="axis=1 gives one number for each point; the mean of a cloud is axis=0." must_say=["axis=0", "each row|each point|each column"] kind="error" must_not_say=["table"]
def find_motion(before, after):
    before_mean = before.mean(axis=1)
    after_mean = after.mean(axis=1)
    b = before - before_mean
    a = after - after_mean
    U, _, V = np.linalg.svd(a.T @ b)
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, after_mean - R @ before_mean

# %% name="the mean of all numbers" origin="new" sentence="mean() without axis is one number: take axis=0." must_say=["axis=0", "single|one number"] kind="error" must_not_say=["value by value"]
def find_motion(before, after):
    b = before - before.mean()
    a = after - after.mean()
    U, _, V = np.linalg.svd(a.T @ b)
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, after.mean() - R @ before.mean()
