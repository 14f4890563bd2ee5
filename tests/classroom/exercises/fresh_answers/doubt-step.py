# %% name="errors the other way round" origin="fresh" sentence="The error is expected minus measured." must_say=["minus|measured|up|sign"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    expected = np.hypot(ahead - x, aside)
    J = -(ahead - x) / expected
    w = 1 / sigmas**2
    return x - (w * J * (distances - expected)).sum() / (w * J * J).sum()

# %% name="without aside" origin="fresh" sentence="The distance needs aside as well: np.hypot." must_say=["aside|hypot"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    expected = ahead - x
    J = -(ahead - x) / expected
    w = 1 / sigmas**2
    return x - (w * J * (expected - distances)).sum() / (w * J * J).sum()

# %% name="squared distance" origin="fresh" sentence="The distance is the root of the sum of squares." must_say=["root|hypot|distance"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    expected = (ahead - x) ** 2 + aside**2
    J = -(ahead - x) / expected
    w = 1 / sigmas**2
    return x - (w * J * (expected - distances)).sum() / (w * J * J).sum()

# %% name="negative step" origin="fresh" sentence="Add the step to x." must_say=["x"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    expected = np.hypot(ahead - x, aside)
    J = -(ahead - x) / expected
    w = 1 / sigmas**2
    step = -(w * J * (expected - distances)).sum() / (w * J * J).sum()
    return step - x

# %% name="mean of the weights" origin="fresh" sentence="Each look has its own weight." must_say=["weight|sigma"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    expected = np.hypot(ahead - x, aside)
    J = -(ahead - x) / expected
    w = (1 / sigmas**2).mean()
    return x - (w * J * (expected - distances)).sum() / (w * J * J).sum()
