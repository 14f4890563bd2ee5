# %% name="inf without math" origin="fresh" sentence="inf has no name here: write math.inf." must_say=["math"] kind="error"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    if not mask.any():
        return inf
    return forward[mask].min()

# %% name="smallest of everything" origin="fresh" sentence="You return the smallest forward of all points: use the mask, forward[mask]." must_say=["mask|corridor|floor|height"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    if not mask.any():
        return math.inf
    return forward.min()

# %% name="height in centimetres" origin="fresh" sentence="The heights are in metres: 0.03, not 3." must_say=["metre|0\\.03|centimetre"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 3) & (height < 40)
    if not mask.any():
        return math.inf
    return forward[mask].min()

# %% name="left returned" origin="fresh" sentence="You return left; the task asks for forward." must_say=["forward"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    if not mask.any():
        return math.inf
    return left[mask].min()

# %% name="large number" origin="fresh" sentence="A free corridor is infinitely far: return math.inf, not 1000." must_say=["inf"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    if not mask.any():
        return 1000.0
    return forward[mask].min()
