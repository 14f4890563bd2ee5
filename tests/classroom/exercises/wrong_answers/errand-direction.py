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
