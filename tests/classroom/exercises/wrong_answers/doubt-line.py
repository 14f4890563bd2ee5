# %% name="polyfit with squared weights" sentence="polyfit squares its weights: give 1 / sigmas." must_say=["square|sigma"] kind="value"
def fit_line(x, y, sigmas):
    slope, offset = np.polyfit(x, y, 1, w=1 / sigmas**2)
    return slope, offset

# %% name="weighted by sigma" sentence="The weight is 1 / sigma squared." must_say=["divide|1 / sigma|weight"] kind="value"
def fit_line(x, y, sigmas):
    A = np.column_stack([x, np.ones(len(x))])
    return tuple(np.linalg.lstsq(A * sigmas[:, np.newaxis], y * sigmas)[0])
