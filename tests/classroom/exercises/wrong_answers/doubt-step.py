# %% name="errors at the beginning" sentence="The errors are computed at x = 0: they belong to the guess." must_say=["errors are computed at x = 0"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    errors = np.hypot(ahead, aside) - distances
    J = -(ahead - x) / np.hypot(ahead - x, aside)
    w = 1 / sigmas**2
    return x - np.sum(w * J * errors) / np.sum(w * J**2)

# %% name="no return" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def place_step(x, ahead, aside, distances, sigmas):
    expected = np.hypot(ahead - x, aside)
    J = -(ahead - x) / expected
    w = 1 / sigmas**2
    x = x - (w * J * (expected - distances)).sum() / (w * J * J).sum()

# %% name="sums forgotten" sentence="Add up over the looks: sum() above and below." must_say=["sum|one number|float|array"] kind="type"
def place_step(x, ahead, aside, distances, sigmas):
    expected = np.hypot(ahead - x, aside)
    J = -(ahead - x) / expected
    w = 1 / sigmas**2
    return x - (w * J * (expected - distances)) / (w * J * J)

# %% name="no sums" sentence="The sums are missing, so the result is an array with one number for each look." must_say=["sum|one number|float|array"] kind="shape"
def place_step(x, ahead, aside, distances, sigmas):
    computed = np.hypot(ahead - x, aside)
    errors = computed - distances
    J = -(ahead - x) / computed
    w = 1 / sigmas**2
    step = -(w * J * errors) / (w * J * J)
    return x + step

# %% name="mean of the weights" sentence="Each look has its own weight." must_say=["weight|sigma"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    expected = np.hypot(ahead - x, aside)
    J = -(ahead - x) / expected
    w = (1 / sigmas**2).mean()
    return x - (w * J * (expected - distances)).sum() / (w * J * J).sum()
