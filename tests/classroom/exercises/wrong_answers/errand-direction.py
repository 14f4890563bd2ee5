# %% name="a pair" sentence="Return the direction alone." must_say=["alone"] kind="type"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = (float(direction), float(way)), off
    return best
