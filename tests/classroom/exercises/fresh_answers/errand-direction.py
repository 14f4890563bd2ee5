# %% name="no wrap" origin="fresh" sentence="Two directions near π and -π are near each other: wrap the difference." must_say=["wrap|remainder|turn"] kind="value"
def choose_direction(directions, ways, goal, need):
    free = directions[ways >= need]
    if len(free) == 0:
        return None
    return float(free[np.argmin(np.abs(free - goal))])

# %% name="the longest way" origin="fresh" sentence="You take the direction with the longest way. Take the one nearest to the goal." must_say=["goal"] kind="value"
def choose_direction(directions, ways, goal, need):
    k = int(np.argmax(ways))
    if ways[k] < need:
        return None
    return float(directions[k])

# %% name="position in the smaller array" origin="fresh" sentence="The position belongs to the chosen directions, not to all of them." must_say=["position|index"] kind="value"
def choose_direction(directions, ways, goal, need):
    mask = ways >= need
    if not mask.any():
        return None
    differences = [abs(math.remainder(d - goal, 2 * math.pi)) for d in directions[mask]]
    return float(directions[int(np.argmin(differences))])

# %% name="the difference itself" origin="fresh" sentence="You return how far the direction is from the goal. Return the direction." must_say=["return the direction|the direction itself|directions\\["] kind="value"
def choose_direction(directions, ways, goal, need):
    differences = [math.remainder(d - goal, 2 * math.pi) for d, way in zip(directions, ways) if way >= need]
    if not differences:
        return None
    return min(differences, key=abs)

# %% name="the goal if nothing is free" origin="fresh" sentence="If no direction has enough way, return None." must_say=["None"] kind="value"
def choose_direction(directions, ways, goal, need):
    best = goal
    nearest = math.inf
    for d, way in zip(directions, ways):
        off = abs(math.remainder(d - goal, 2 * math.pi))
        if way >= need and off < nearest:
            best, nearest = float(d), off
    return best
