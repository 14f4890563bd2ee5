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
