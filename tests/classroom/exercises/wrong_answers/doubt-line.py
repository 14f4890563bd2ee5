# %% name="polyfit with squared weights" sentence="polyfit squares its weights: give 1 / sigmas." must_say=["square|sigma"] kind="value"
def fit_line(x, y, sigmas):
    slope, offset = np.polyfit(x, y, 1, w=1 / sigmas**2)
    return slope, offset

# %% name="no return" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def fit_line(x, y, sigmas):
    A = np.column_stack([x, np.ones(len(x))])
    slope, offset = np.linalg.lstsq(A / sigmas[:, np.newaxis], y / sigmas)[0]

# %% name="sigmas without a column" sentence="Divide each row by its sigma: sigmas[:, np.newaxis]." must_say=["newaxis|shape|fit|broadcast"] kind="error"
def fit_line(x, y, sigmas):
    A = np.column_stack([x, np.ones(len(x))])
    return tuple(np.linalg.lstsq(A / sigmas, y / sigmas)[0])

# %% name="weighted by sigma" sentence="The weight is 1 / sigma squared." must_say=["divide|1 / sigma|weight"] kind="value"
def fit_line(x, y, sigmas):
    A = np.column_stack([x, np.ones(len(x))])
    return tuple(np.linalg.lstsq(A * sigmas[:, np.newaxis], y * sigmas)[0])
