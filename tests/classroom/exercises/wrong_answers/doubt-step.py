# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def place_step(x, ahead, aside, distances, sigmas):
    expected = np.hypot(ahead - x, aside)
    J = -(ahead - x) / expected
    w = 1 / sigmas**2
    x = x - (w * J * (expected - distances)).sum() / (w * J * J).sum()

# %% name="sums forgotten" origin="new" sentence="Add up over the looks: sum() above and below." must_say=["sum|one number|float|array"] kind="type"
def place_step(x, ahead, aside, distances, sigmas):
    expected = np.hypot(ahead - x, aside)
    J = -(ahead - x) / expected
    w = 1 / sigmas**2
    return x - (w * J * (expected - distances)) / (w * J * J)

# %% name="both signs of the Jacobian" origin="new" sentence="J has a minus: -(ahead - x) / expected." must_say=["minus|sign|up"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    expected = np.hypot(ahead - x, aside)
    J = (ahead - x) / expected
    w = 1 / sigmas**2
    return x - (w * J * (expected - distances)).sum() / (w * J * J).sum()

# %% name="x in the wrong coordinate" origin="new" sentence="Subtract x from ahead, not from aside." must_say=["ahead"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    expected = np.hypot(ahead, aside - x)
    J = -(aside - x) / expected
    w = 1 / sigmas**2
    return x - (w * J * (expected - distances)).sum() / (w * J * J).sum()

# %% name="J with the measured distances" origin="new" sentence="J is divided by the measured distances: divide by the computed ones." must_say=["measured distances"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    errors = np.hypot(ahead - x, aside) - distances
    J = (x - ahead) / distances
    w = 1 / sigmas**2
    return x - np.sum(w * J * errors) / np.sum(w * J**2)

# %% name="J at the beginning" origin="new" sentence="J is computed at x = 0: it belongs to the guess." must_say=["J is computed at x = 0"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    errors = np.hypot(ahead - x, aside) - distances
    J = -ahead / np.sqrt(ahead**2 + aside**2)
    w = 1 / sigmas**2
    return x - np.sum(w * J * errors) / np.sum(w * J**2)

# %% name="errors at the beginning" origin="new" sentence="The errors are computed at x = 0: they belong to the guess." must_say=["errors are computed at x = 0"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    errors = np.hypot(ahead, aside) - distances
    J = -(ahead - x) / np.hypot(ahead - x, aside)
    w = 1 / sigmas**2
    return x - np.sum(w * J * errors) / np.sum(w * J**2)
