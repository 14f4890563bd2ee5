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
# %% name="measured distance in J" origin="fresh" sentence="J needs the computed distance, not the measured one." must_say=["comput|measured"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    errors = np.hypot(ahead - x, aside) - distances
    J = -(ahead - x) / distances
    w = 1 / sigmas**2
    step = -(w * J * errors).sum() / (w * J * J).sum()
    return float(x + step)
# %% name="J once below" origin="fresh" sentence="In the denominator J stands twice: w * J * J." must_say=["J \\* J|J\\*\\*2|square|twice|denominator|divide"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    computed = np.hypot(ahead - x, aside)
    errors = computed - distances
    J = -(ahead - x) / computed
    w = 1 / sigmas**2
    step = -(w * J * errors).sum() / (w * J).sum()
    return float(x + step)
# %% name="1 / sigma" origin="fresh" sentence="The weight is 1 / σ², you forgot the square." must_say=["σ²|square|sigmas?\\*\\*|weight"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    computed = np.hypot(ahead - x, aside)
    errors = computed - distances
    J = -(ahead - x) / computed
    w = 1 / sigmas
    step = -(w * J * errors).sum() / (w * J * J).sum()
    return float(x + step)
# %% name="error the other way round" origin="fresh" sentence="The error is computed minus measured, you have measured minus computed." must_say=["sign|minus (the )?measured"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    computed = np.hypot(ahead - x, aside)
    errors = distances - computed
    J = -(ahead - x) / computed
    w = 1 / sigmas**2
    step = -(w * J * errors).sum() / (w * J * J).sum()
    return float(x + step)
# %% name="weights only above" origin="fresh" sentence="The weights are missing in the denominator." must_say=["weight|w |σ|sigma"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    computed = np.hypot(ahead - x, aside)
    errors = computed - distances
    J = -(ahead - x) / computed
    w = 1 / sigmas**2
    step = -(w * J * errors).sum() / (J * J).sum()
    return float(x + step)
# %% name="returns the step" origin="fresh" sentence="The function should return x after the step: x + step." must_say=["x \\+|add|step"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    computed = np.hypot(ahead - x, aside)
    errors = computed - distances
    J = -(ahead - x) / computed
    w = 1 / sigmas**2
    step = -(w * J * errors).sum() / (w * J * J).sum()
    return float(step)
# %% name="x forgotten" origin="fresh" sentence="The distance must be computed from the guess: ahead - x, not ahead." must_say=["ahead - x|guess|x"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    computed = np.hypot(ahead, aside)
    errors = computed - distances
    J = -ahead / computed
    w = 1 / sigmas**2
    step = -(w * J * errors).sum() / (w * J * J).sum()
    return float(x + step)
# %% name="no sums" origin="fresh" sentence="The sums are missing, so the result is an array with one number for each look." must_say=["sum|one number|float|array"] kind="shape"
def place_step(x, ahead, aside, distances, sigmas):
    computed = np.hypot(ahead - x, aside)
    errors = computed - distances
    J = -(ahead - x) / computed
    w = 1 / sigmas**2
    step = -(w * J * errors) / (w * J * J)
    return x + step
# %% name="five steps" origin="fresh" sentence="You do five steps; the task wants only one." must_say=["one step|once|more than one|several|loop|5|five"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    w = 1 / sigmas**2
    for _ in range(5):
        computed = np.hypot(ahead - x, aside)
        errors = computed - distances
        J = -(ahead - x) / computed
        x = x - (w * J * errors).sum() / (w * J * J).sum()
    return float(x)
# %% name="1.62 of the lesson" origin="fresh" sentence="1.62 is the marker of the lesson; use the given aside." must_say=["aside|1\\.62"] kind="value"
def place_step(x, ahead, aside, distances, sigmas):
    computed = np.hypot(ahead - x, 1.62)
    errors = computed - distances
    J = -(ahead - x) / computed
    w = 1 / sigmas**2
    step = -(w * J * errors).sum() / (w * J * J).sum()
    return float(x + step)
