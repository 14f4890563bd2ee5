# %% name="weak includes strong" origin="fresh" sentence="Weak must not contain the strong pixels: add & (thinned <= high)." must_say=["strong|<= ?high|not above|both|between|~"] must_not_say=["order|uint8"] kind="value"
def double_threshold(thinned, low, high):
    weak = thinned > low
    strong = thinned > high
    return weak, strong

# %% name="high belongs to strong" origin="fresh" sentence="Strong means strictly above high: > and not >=." must_say=[">=|strictly|equal|above"] must_not_say=["order"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned >= high
    weak = (thinned > low) & (thinned < high)
    return weak, strong

# %% name="strong first" origin="fresh" sentence="The order is weak, strong; you return strong first." must_say=["order|weak first|first|swap|exchang|weak, ?strong"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) & (thinned <= high)
    return strong, weak

# %% name="chained comparison" origin="fresh" sentence="low < thinned <= high works for one number only: combine two masks with &." must_say=["&|two (comparisons|masks)|chain|one number|parenthes"] kind="error"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = low < thinned <= high
    return weak, strong

# %% name="and between masks" origin="fresh" sentence="and needs one truth value: combine masks with & and parentheses." must_say=["&"] kind="error"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) and not strong
    return weak, strong

# %% name="Uses >= at both thresholds" origin="fresh" sentence="Uses >= at both thresholds, but strictly above is asked for." must_say=[">="] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned >= high
    weak = (thinned >= low) & ~strong
    return weak, strong

# %% name="'and' does not work on arrays" origin="fresh" sentence="'and' does not work on arrays; the masks must be joined with &." must_say=["\\band\\b"] kind="error"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = thinned > low and thinned <= high
    return weak, strong

# %% name="The parentheses around the comparisons are missing" origin="fresh" sentence="The parentheses around the comparisons are missing, so & is computed first." must_say=["parenthes"] kind="error"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = thinned > low & thinned <= high
    return weak, strong

# %% name="Returns uint8 images with 0 and 255 instead of bool arrays" origin="fresh" sentence="Returns uint8 images with 0 and 255 instead of bool arrays." must_say=["bool"] kind="dtype"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) & ~strong
    return weak.astype(np.uint8) * 255, strong.astype(np.uint8) * 255

# %% name="low and high are exchanged" origin="fresh" sentence="low and high are exchanged." must_say=["exchanged|swapped"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > low
    weak = (thinned > high) & ~strong
    return weak, strong

# %% name="A pixel exactly equal to high is neither weak nor strong" origin="fresh" sentence="A pixel exactly equal to high is neither weak nor strong: < must be <=." must_say=["equal to high"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > high
    weak = (thinned > low) & (thinned < high)
    return weak, strong

# %% name="The thresholds 50 and 150 of the example are hard-coded" origin="fresh" sentence="The thresholds 50 and 150 of the example are hard-coded; the arguments are not used." must_say=["50"] kind="value"
def double_threshold(thinned, low, high):
    strong = thinned > 150
    weak = (thinned > 50) & (thinned <= 150)
    return weak, strong

# %% name="Returns the selected pixel values " origin="fresh" sentence="Returns the selected pixel values (flat arrays) instead of the bool masks." must_say=["the values|pixel values"] kind="shape"
def double_threshold(thinned, low, high):
    strong = thinned[thinned > high]
    weak = thinned[(thinned > low) & (thinned <= high)]
    return weak, strong
