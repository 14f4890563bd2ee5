# %% name="whole width" origin="new" sentence="The corridor reaches width / 2 to each side, not width." must_say=["width / 2|half"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width) & (height > 0.03) & (height < 0.40)
    if not mask.any():
        return math.inf
    return forward[mask].min()

# %% name="no abs" origin="new" sentence="Points on the right have a negative left: use np.abs." must_say=["abs"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (left <= width / 2) & (height > 0.03) & (height < 0.40)
    if not mask.any():
        return math.inf
    return forward[mask].min()

# %% name="no corridor" origin="new" sentence="You did not use the corridor: np.abs(left) <= width / 2." must_say=["corridor|left"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (height > 0.03) & (height < 0.40)
    if not mask.any():
        return math.inf
    return forward[mask].min()

# %% name="floor" origin="new" sentence="The floor counts as an obstacle: height > 0.03 is missing." must_say=["0\\.03|floor"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height < 0.40)
    if not mask.any():
        return math.inf
    return forward[mask].min()

# %% name="high" origin="new" sentence="Things above the robot count: height < 0.40 is missing." must_say=["0\\.40|above"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03)
    if not mask.any():
        return math.inf
    return forward[mask].min()

# %% name="empty corridor" origin="new" sentence="If no point is in the corridor, min fails: return math.inf first." must_say=["inf"] kind="error"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    return forward[mask].min()

# %% name="zero for empty" origin="new" sentence="A free corridor is infinitely far, not 0: return math.inf." must_say=["inf"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    if not mask.any():
        return 0
    return forward[mask].min()

# %% name="None for empty" origin="new" sentence="Return math.inf, not None, if the corridor is free." must_say=["inf"] kind="type"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    if mask.any():
        return forward[mask].min()

# %% name="argmin" origin="new" sentence="argmin is an index: use min." must_say=["index|min\\b"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    if not mask.any():
        return math.inf
    return forward[mask].argmin()

# %% name="max" origin="new" sentence="The nearest has the smallest forward: min, not max." must_say=["smallest|min|nearest"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    if not mask.any():
        return math.inf
    return forward[mask].max()

# %% name="and" origin="new" sentence="and does not work on arrays: use & with parentheses." must_say=["&"] kind="error"
def nearest_obstacle(forward, left, height, width):
    mask = np.abs(left) <= width / 2 and height > 0.03 and height < 0.40
    if not mask.any():
        return math.inf
    return forward[mask].min()

# %% name="no parentheses" origin="new" sentence="Put each comparison into parentheses: & is computed before <=." must_say=["parenthes"] kind="error"
def nearest_obstacle(forward, left, height, width):
    mask = np.abs(left) <= width / 2 & height > 0.03 & height < 0.40
    if not mask.any():
        return math.inf
    return forward[mask].min()

# %% name="or" origin="new" sentence="All conditions must hold: combine them by &, not by |." must_say=["&"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) | (height > 0.03) & (height < 0.40)
    if not mask.any():
        return math.inf
    return forward[mask].min()

# %% name="inf as a text" origin="new" sentence="The number infinity is math.inf, without quotes." must_say=["math\\.inf|quotes|text"] kind="type"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    if not mask.any():
        return "inf"
    return forward[mask].min()

# %% name="all distances" origin="new" sentence="Return one number, the minimum: you return all of them." must_say=["min|one number|single|number"] kind="type"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    if not mask.any():
        return math.inf
    return forward[mask]

# %% name="fixed width" origin="new" sentence="Use the argument width, not 0.20." must_say=["width"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (np.abs(left) <= 0.20) & (height > 0.03) & (height < 0.40)
    if not mask.any():
        return math.inf
    return forward[mask].min()

# %% name="a loop that keeps the largest" origin="new" sentence="You keep the largest forward: begin with math.inf and keep the smaller one." must_say=["farthest|largest|small", "inf"] kind="value"
def nearest_obstacle(forward, left, height, width):
    best = 0
    for f, l, h in zip(forward.ravel(), left.ravel(), height.ravel()):
        if abs(l) <= width / 2 and 0.03 < h < 0.40 and f > best:
            best = f
    return best

# %% name="the mask not used" origin="new" sentence="You take the minimum of all points. Take that of the points in the mask: forward[mask].min()." must_say=["forward\\[mask\\]", "all points|select"] kind="value" must_not_say=["height is not used"]
def nearest_obstacle(forward, left, height, width):
    mask = (abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    if mask.any():
        return forward.min()
    return math.inf

# %% name="the first point of the mask" origin="new" sentence="The first point need not be the nearest: take the minimum." must_say=["first", "smallest|min"] kind="value"
def nearest_obstacle(forward, left, height, width):
    mask = (abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    if mask.sum() == 0:
        return math.inf
    return forward[mask][0]

# %% name="forward times the mask" origin="new" sentence="Points outside become 0 and are the minimum: select with forward[mask]." must_say=["forward\\[mask\\]", "0"] kind="value" must_not_say=["fixed"]
def nearest_obstacle(forward, left, height, width):
    mask = (abs(left) <= width / 2) & (height > 0.03) & (height < 0.40)
    return (forward * mask).min()
