# %% name="None for empty" sentence="Return math.inf, not None, if the corridor is free." must_say=["inf"] kind="type"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    if mask.any():
        return forward[mask].min()

# %% name="large number" sentence="A free corridor is infinitely far: return math.inf, not 1000." must_say=["inf"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    if not mask.any():
        return 1000.0
    return forward[mask].min()
