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
# %% name="width not halved" origin="fresh" sentence="The corridor goes half of its width to each side." must_say=["half|width / 2|/ 2"] kind="value"
def nearest_obstacle(forward, left, height, width):
    corridor = np.abs(left) <= width
    stands = (height > 0.03) & (height < 0.40)
    if not (corridor & stands).any():
        return math.inf
    return float(forward[corridor & stands].min())
# %% name="no abs" origin="fresh" sentence="Points on the right have a negative left; without abs they are all in the corridor." must_say=["abs|right|negative|both sides|side"] kind="value"
def nearest_obstacle(forward, left, height, width):
    corridor = left <= width / 2
    stands = (height > 0.03) & (height < 0.40)
    if (corridor & stands).sum() == 0:
        return math.inf
    return forward[corridor & stands].min()
# %% name="no parentheses around the comparisons" origin="fresh" sentence="& binds stronger than > and <: put each comparison into parentheses." must_say=["parenthes|bracket"] kind="error"
def nearest_obstacle(forward, left, height, width):
    corridor = np.abs(left) <= width / 2
    stands = height > 0.03 & height < 0.40
    found = forward[corridor & stands]
    if len(found) == 0:
        return math.inf
    return found.min()
# %% name="and between arrays" origin="fresh" sentence="`and` does not work with arrays: write & with parentheses." must_say=["&"] kind="error"
def nearest_obstacle(forward, left, height, width):
    corridor = np.abs(left) <= width / 2
    stands = height > 0.03 and height < 0.40
    found = forward[corridor & stands]
    if len(found) == 0:
        return math.inf
    return found.min()
# %% name="no case for none" origin="fresh" sentence="If no point is an obstacle, min() of nothing fails: return math.inf." must_say=["inf|empty|no (point|obstacle)|none"] kind="error"
def nearest_obstacle(forward, left, height, width):
    corridor = np.abs(left) <= width / 2
    stands = (height > 0.03) & (height < 0.40)
    return float(forward[corridor & stands].min())
# %% name="None for none" origin="fresh" sentence="If there is no obstacle, the task wants math.inf, not None." must_say=["inf", "None|nothing"] kind="type"
def nearest_obstacle(forward, left, height, width):
    corridor = np.abs(left) <= width / 2
    stands = (height > 0.03) & (height < 0.40)
    found = forward[corridor & stands]
    if found.size > 0:
        return found.min()
    else:
        return None
# %% name="first one found" origin="fresh" sentence="You return the first obstacle of the array, not the nearest: the return is in the loop." must_say=["first|loop|smallest|all"] kind="value"
def nearest_obstacle(forward, left, height, width):
    forward, left, height = forward.ravel(), left.ravel(), height.ravel()
    for i in range(len(forward)):
        if abs(left[i]) <= width / 2 and height[i] > 0.03 and height[i] < 0.40:
            return forward[i]
    return math.inf
# %% name="width of the lesson" origin="fresh" sentence="The corridor is always 0.40 m wide; use the given width." must_say=["width|0\\.40?"] kind="value"
def nearest_obstacle(forward, left, height, width):
    corridor = np.abs(left) <= 0.40 / 2
    stands = (height > 0.03) & (height < 0.40)
    found = forward[corridor & stands]
    if len(found) == 0:
        return math.inf
    return found.min()
# %% name="argmin" origin="fresh" sentence="argmin gives the place of the smallest number, not the number itself." must_say=["argmin|place|position|index"] kind="value"
def nearest_obstacle(forward, left, height, width):
    corridor = np.abs(left) <= width / 2
    stands = (height > 0.03) & (height < 0.40)
    found = forward[corridor & stands]
    if len(found) == 0:
        return math.inf
    return float(found.argmin())
# %% name="upper limit forgotten" origin="fresh" sentence="Points higher than 0.40 m must not count: the robot drives under them." must_say=["0\\.40?|under|lower|too high|higher"] kind="value"
def nearest_obstacle(forward, left, height, width):
    corridor = np.abs(left) <= width / 2
    stands = height > 0.03
    found = forward[corridor & stands]
    if len(found) == 0:
        return math.inf
    return found.min()
