# %% name="half a metre between the points" origin="new" sentence="The points are 0.1 m apart." must_say=["0\\.1"] kind="value"
def count_new(place, heading, way, visited):
    cells = set()
    for d in np.arange(0.5, way, 0.5):
        x, y = place[0] + d * math.cos(heading), place[1] + d * math.sin(heading)
        cells.add((math.floor(x / 0.5), math.floor(y / 0.5)))
    return len(cells - {tuple(cell) for cell in visited.tolist()})

# %% name="the other direction" origin="new" sentence="The way goes in the direction of heading: add, do not subtract." must_say=["add|subtract|direction"] kind="value"
def count_new(place, heading, way, visited):
    cells = set()
    for d in np.arange(0.1, way, 0.1):
        x, y = place[0] - d * math.cos(heading), place[1] - d * math.sin(heading)
        cells.add((math.floor(x / 0.5), math.floor(y / 0.5)))
    return len(cells - {tuple(cell) for cell in visited.tolist()})

# %% name="the set itself, sorted" origin="new" sentence="Return the number of cells, len(...), not the cells." must_say=["number|len"] kind="value"
def count_new(place, heading, way, visited):
    cells = set()
    for d in np.arange(0.1, way, 0.1):
        x, y = place[0] + d * math.cos(heading), place[1] + d * math.sin(heading)
        cells.add((math.floor(x / 0.5), math.floor(y / 0.5)))
    return sorted(cells - {tuple(cell) for cell in visited.tolist()})

# %% name="visited cells on the way" origin="new" sentence="You count the cells that were visited. Subtract them." must_say=["subtract|not in|visited"] kind="value"
def count_new(place, heading, way, visited):
    cells = set()
    for d in np.arange(0.1, way, 0.1):
        x, y = place[0] + d * math.cos(heading), place[1] + d * math.sin(heading)
        cells.add((math.floor(x / 0.5), math.floor(y / 0.5)))
    return len(cells & {tuple(cell) for cell in visited.tolist()})

# %% name="the number of points less the visited" origin="new" sentence="Count cells, not points, and subtract the set." must_say=["set|cells"] kind="value"
def count_new(place, heading, way, visited):
    cells = set()
    for d in np.arange(0.1, way, 0.1):
        x, y = place[0] + d * math.cos(heading), place[1] + d * math.sin(heading)
        cells.add((math.floor(x / 0.5), math.floor(y / 0.5)))
    return len(np.arange(0.1, way, 0.1)) - len(visited)
