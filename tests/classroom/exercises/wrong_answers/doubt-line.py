# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def fit_line(x, y, sigmas):
    A = np.column_stack([x, np.ones(len(x))])
    slope, offset = np.linalg.lstsq(A / sigmas[:, np.newaxis], y / sigmas)[0]

# %% name="sigmas without a column" origin="new" sentence="Divide each row by its sigma: sigmas[:, np.newaxis]." must_say=["newaxis|shape|fit|broadcast"] kind="error"
def fit_line(x, y, sigmas):
    A = np.column_stack([x, np.ones(len(x))])
    return tuple(np.linalg.lstsq(A / sigmas, y / sigmas)[0])

# %% name="slope only" origin="new" sentence="Return the offset as well." must_say=["offset|two"] kind="type"
def fit_line(x, y, sigmas):
    A = np.column_stack([x, np.ones(len(x))])
    return np.linalg.lstsq(A / sigmas[:, np.newaxis], y / sigmas)[0][0]

# %% name="all of lstsq" origin="new" sentence="lstsq returns four things: take the first, [0]." must_say=["\\[0\\]|first|two|four"] kind="type"
def fit_line(x, y, sigmas):
    A = np.column_stack([x, np.ones(len(x))])
    return np.linalg.lstsq(A / sigmas[:, np.newaxis], y / sigmas)
