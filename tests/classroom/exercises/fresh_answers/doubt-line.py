# %% name="plain means" origin="fresh" sentence="The means must be weighted as well." must_say=["mean|weight|sigma"] kind="value"
def fit_line(x, y, sigmas):
    w = 1 / sigmas**2
    dx, dy = x - x.mean(), y - y.mean()
    slope = (w * dx * dy).sum() / (w * dx * dx).sum()
    return slope, y.mean() - slope * x.mean()

# %% name="weighted by sigma" origin="fresh" sentence="The weight is 1 / sigma squared." must_say=["divide|1 / sigma|weight"] kind="value"
def fit_line(x, y, sigmas):
    A = np.column_stack([x, np.ones(len(x))])
    return tuple(np.linalg.lstsq(A * sigmas[:, np.newaxis], y * sigmas)[0])

# %% name="W on one side" origin="fresh" sentence="W belongs to the right side as well." must_say=["W|sigma|both|y"] kind="value"
def fit_line(x, y, sigmas):
    A = np.column_stack([x, np.ones(len(x))])
    W = np.diag(1 / sigmas**2)
    return tuple(np.linalg.solve(A.T @ W @ A, A.T @ y))

# %% name="polyfit without weights" origin="fresh" sentence="The sigmas are not used." must_say=["sigma"] kind="value"
def fit_line(x, y, sigmas):
    slope, offset = np.polyfit(x, y, 1)
    return slope, offset

# %% name="polyfit with squared weights" origin="fresh" sentence="polyfit squares its weights: give 1 / sigmas." must_say=["square|sigma"] kind="value"
def fit_line(x, y, sigmas):
    slope, offset = np.polyfit(x, y, 1, w=1 / sigmas**2)
    return slope, offset
