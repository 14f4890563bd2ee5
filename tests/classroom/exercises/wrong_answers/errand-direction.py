# %% name="difference not wrapped" origin="new" sentence="Wrap the difference." must_say=["wrap|remainder"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(direction - goal)
        if way >= need and off < nearest:
            best, nearest = float(direction), off
    return best

# %% name="modulo 2 pi" origin="new" sentence="% gives 0 to 2π: use math.remainder and abs." must_say=["remainder"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = (direction - goal) % (2 * math.pi)
        if way >= need and off < nearest:
            best, nearest = float(direction), off
    return best

# %% name="remainder of the length in degrees" origin="new" sentence="The angles are in radians: 2 * math.pi, not 360." must_say=["2 \\* math\\.pi|radian"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 360))
        if way >= need and off < nearest:
            best, nearest = float(direction), off
    return best

# %% name="no abs" origin="new" sentence="Take abs of the difference." must_say=["abs"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = math.remainder(direction - goal, 2 * math.pi)
        if way >= need and off < nearest:
            best, nearest = float(direction), off
    return best

# %% name="remainder by pi" origin="new" sentence="A whole turn is 2π." must_say=["2 \\* math\\.pi|2π"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, math.pi))
        if way >= need and off < nearest:
            best, nearest = float(direction), off
    return best

# %% name="larger than" origin="new" sentence="At least means >=." must_say=[">=|at least"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way > need and off < nearest:
            best, nearest = float(direction), off
    return best

# %% name="the wrong comparison" origin="new" sentence="Choose directions with way >= need." must_say=[">="] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way <= need and off < nearest:
            best, nearest = float(direction), off
    return best

# %% name="less or equal" origin="new" sentence="Of equals the first: compare with <." must_say=["first"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and off <= nearest:
            best, nearest = float(direction), off
    return best

# %% name="largest difference" origin="new" sentence="Take the smallest difference, not the largest." must_say=["nearest|smallest"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, farthest = None, -1.0
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and off > farthest:
            best, farthest = float(direction), off
    return best

# %% name="goal forgotten" origin="new" sentence="Compare with the goal, not with straight ahead." must_say=["goal"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = float(direction), off
    return best

# %% name="goal added" origin="new" sentence="Take the difference, not the sum." must_say=["difference|less|subtract"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction + goal, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = float(direction), off
    return best

# %% name="need forgotten" origin="new" sentence="Only directions with ways of at least need count." must_say=["need"] kind="value"
def choose_direction(directions, ways, goal, need):
    off = [abs(math.remainder(d - goal, 2 * math.pi)) for d in directions]
    return float(directions[int(np.argmin(off))])

# %% name="argmax of the ways" origin="new" sentence="Not the longest way: the direction nearest to the goal." must_say=["goal"] kind="value"
def choose_direction(directions, ways, goal, need):
    if ways.max() < need:
        return None
    return float(directions[ways.argmax()])

# %% name="argmax without need" origin="new" sentence="Not the longest way: the direction nearest to the goal." must_say=["goal"] kind="value"
def choose_direction(directions, ways, goal, need):
    return float(directions[np.argmax(ways)])

# %% name="return in the loop" origin="new" sentence="You return the first one: look at all of them." must_say=["all|first"] kind="value"
def choose_direction(directions, ways, goal, need):
    for direction, way in zip(directions, ways):
        if way >= need:
            return float(direction)
    return None

# %% name="index of the masked array" origin="new" sentence="The position belongs to the masked array." must_say=["position|smaller array"] kind="value"
def choose_direction(directions, ways, goal, need):
    free = directions[ways >= need]
    if free.size == 0:
        return None
    off = np.abs([math.remainder(d - goal, 2 * math.pi) for d in free])
    return float(directions[off.argmin()])

# %% name="argmin of nothing" origin="new" sentence="If no direction is free, return None before argmin." must_say=["None"] kind="error"
def choose_direction(directions, ways, goal, need):
    free = directions[ways >= need]
    off = np.abs([math.remainder(d - goal, 2 * math.pi) for d in free])
    return float(free[np.argmin(off)])

# %% name="the index" origin="new" sentence="Return the direction, not its position." must_say=["direction itself|position"] kind="value"
def choose_direction(directions, ways, goal, need):
    off = np.array([abs(math.remainder(d - goal, 2 * math.pi)) for d in directions])
    off[ways < need] = math.inf
    if np.isinf(off).all():
        return None
    return int(off.argmin())

# %% name="the offset" origin="new" sentence="Return the direction itself, not the difference." must_say=["direction itself"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = float(direction), off
    return None if best is None else nearest

# %% name="the way" origin="new" sentence="Return the direction, not the way." must_say=["direction"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = float(way), off
    return best

# %% name="a pair" origin="new" sentence="Return the direction alone." must_say=["alone"] kind="type"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = (float(direction), float(way)), off
    return best

# %% name="zero if none" origin="new" sentence="Return None if none is free." must_say=["None"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = 0.0, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = float(direction), off
    return best

# %% name="goal if none" origin="new" sentence="Return None if none is free." must_say=["None"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = goal, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = float(direction), off
    return best

# %% name="best of the bad" origin="new" sentence="Return None if none is free." must_say=["None"] kind="value"
def choose_direction(directions, ways, goal, need):
    mask = ways >= need
    if not mask.any():
        return float(directions[ways.argmax()])
    free = directions[mask]
    return float(min(free, key=lambda d: abs(math.remainder(d - goal, 2 * math.pi))))

# %% name="sorted first" origin="new" sentence="Of equals, the first in directions counts; you sorted them." must_say=["first"] kind="value"
def choose_direction(directions, ways, goal, need):
    pairs = sorted((abs(math.remainder(d - goal, 2 * math.pi)), float(d)) for d, way in zip(directions, ways) if way >= need)
    return pairs[0][1] if pairs else None

# %% name="isfinite" origin="new" sentence="An infinite way is free as well." must_say=["inf"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if np.isfinite(way) and way >= need and off < nearest:
            best, nearest = float(direction), off
    return best

# %% name="degrees returned" origin="new" sentence="Return radians." must_say=["radian"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = float(direction), off
    return None if best is None else math.degrees(best)

# %% name="no return" origin="new" sentence="The function returns nothing." must_say=["return"] kind="no-return"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = float(direction), off

# %% name="not best" origin="walk" sentence="0.0 counts as False: write best is None." must_say=["0\\.0 counts as False"] must_not_say=["inf >= need"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and (not best or off < nearest):
            best, nearest = float(direction), off
    return best

# %% name="if best" origin="walk" sentence="0.0 counts as False: ask whether best is None." must_say=["0\\.0 counts as False"] must_not_say=["inf >= need"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = float(direction), off
    if best:
        return best
    return None

# %% name="the nearest direction, or none" origin="walk" sentence="If the nearest direction is blocked, another one may be free." must_say=["another"] kind="value"
def choose_direction(directions, ways, goal, need):
    off = [abs(math.remainder(d - goal, 2 * math.pi)) for d in directions]
    k = int(np.argmin(off))
    if ways[k] < need:
        return None
    return float(directions[k])

# %% name="1.0 for need" origin="walk" sentence="You typed 1.0: use the argument need." must_say=["argument need"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= 1.0 and off < nearest:
            best, nearest = float(direction), off
    return best

# %% name="the lesson's cell" origin="walk" sentence="This computes in degrees: the task asks for radians." must_say=["radians"] kind="value"
def choose_direction(directions, ways, goal, need):
    degrees = np.degrees(directions).round()
    enough = degrees[ways >= need]
    off = np.abs(enough - round(math.degrees(goal)))
    return enough[np.argmin(off)]

# %% name="remainder of an array" origin="walk" sentence="math.remainder takes one number: wrap in a loop." must_say=["remainder takes one number"] must_not_say=["astype", "log10"] kind="error"
def choose_direction(directions, ways, goal, need):
    off = np.abs(math.remainder(directions - goal, 2 * math.pi))
    off[ways < need] = math.inf
    if np.isinf(off).all():
        return None
    return float(directions[off.argmin()])

# %% name="return best inside the loop" origin="walk" sentence="Your return stands inside of the loop." must_say=["inside of the loop"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(math.remainder(direction - goal, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = float(direction), off
            return best

# %% name="wrapped by hand, only from above" origin="walk" sentence="The angle can also be smaller than -π: wrap it on that side, too." must_say=["smaller than -π"] must_not_say=["not wrapped"] kind="value"
def choose_direction(directions, ways, goal, need):
    off = directions - goal
    off[off > math.pi] -= 2 * math.pi
    off = np.abs(off)
    off[ways < need] = math.inf
    k = int(np.argmin(off))
    return float(directions[k]) if ways[k] >= need else None

# %% name="wrapped by hand, only from below" origin="walk" sentence="The angle can also be larger than π: wrap it on that side, too." must_say=["larger than π"] must_not_say=["not wrapped"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = direction - goal
        if off < -math.pi:
            off = off + 2 * math.pi
        if way >= need and abs(off) < nearest:
            best, nearest = float(direction), abs(off)
    return best

# %% name="a full turn subtracted after abs" origin="walk" sentence="After abs, the difference gets negative: wrap first, then abs." must_say=["negative"] kind="value"
def choose_direction(directions, ways, goal, need):
    best, nearest = None, math.inf
    for direction, way in zip(directions, ways):
        off = abs(direction - goal)
        if off > math.pi:
            off = off - 2 * math.pi
        if way >= need and off < nearest:
            best, nearest = float(direction), off
    return best
