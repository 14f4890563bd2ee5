# %% name="mean of both" origin="fresh" sentence="Each image has its own mean." must_say=["own mean"] kind="value"
def ncc(a, b):
    m = (a.mean() + b.mean()) / 2
    a, b = a - m, b - m
    root = np.sqrt((a * a).sum() * (b * b).sum())
    return 0.0 if root == 0 else float((a * b).sum() / root)

# %% name="median" origin="fresh" sentence="Subtract the mean, not the median." must_say=["mean"] kind="value"
def ncc(a, b):
    a, b = a - np.median(a), b - np.median(b)
    root = np.sqrt((a * a).sum() * (b * b).sum())
    return 0.0 if root == 0 else float((a * b).sum() / root)

# %% name="matrix product" origin="fresh" sentence="Multiply pixel by pixel with *, not @." must_say=["@|pixel by pixel|\\*"] kind="error"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    root = np.sqrt((a @ a).sum() * (b @ b).sum())
    return 0.0 if root == 0 else float((a @ b).sum() / root)

# %% name="variance of a twice" origin="fresh" sentence="The root contains the sum of squares of b too." must_say=["both|of b"] kind="value"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    below = np.sqrt((a * a).sum() * (a * a).sum())
    return 0.0 if below == 0 else float((a * b).sum() / below)

# %% name="clipped" origin="fresh" sentence="The NCC can be negative." must_say=["negative"] kind="value"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    root = np.sqrt((a * a).sum() * (b * b).sum())
    return 0.0 if root == 0 else float(np.clip((a * b).sum() / root, 0, 1))
