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
