# %% name="the lesson's cell" sentence="This computes in degrees: the task asks for radians." must_say=["radians"] kind="value"
def choose_direction(directions, ways, goal, need):
    degrees = np.degrees(directions).round()
    enough = degrees[ways >= need]
    off = np.abs(enough - round(math.degrees(goal)))
    return enough[np.argmin(off)]

# %% name="remainder of an array" sentence="math.remainder takes one number: wrap in a loop." must_say=["remainder takes one number"] must_not_say=["astype", "log10"] kind="error"
def choose_direction(directions, ways, goal, need):
    off = np.abs(math.remainder(directions - goal, 2 * math.pi))
    off[ways < need] = math.inf
    if np.isinf(off).all():
        return None
    return float(directions[off.argmin()])

# %% name="no return" sentence="The function returns nothing." must_say=["return"] kind="no-return"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = float(direction), off

# %% name="a pair" sentence="Return the direction alone." must_say=["alone"] kind="type"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = (float(direction), float(way)), off
    return best

# %% name="the nearest direction, or none" sentence="If the nearest direction is blocked, another one may be free." must_say=["another"] kind="value"
def choose_direction(directions, ways, goal, need):
    off = [abs(math.remainder(d - goal, 2 * math.pi)) for d in directions]
    k = int(np.argmin(off))
    if ways[k] < need:
        return None
    return float(directions[k])
