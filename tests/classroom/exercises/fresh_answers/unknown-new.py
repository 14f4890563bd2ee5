# %% name="cells of a metre" origin="fresh" sentence="Divide by 0.5: a cell is 0.5 m wide." must_say=["0\\.5"] kind="value"
def count_new(place, heading, way, visited):
    cells = set()
    for d in np.arange(0.1, way, 0.1):
        x, y = 2 * 0.25 * (place[0] + d * math.cos(heading)), 2 * 0.25 * (place[1] + d * math.sin(heading))
        cells.add((math.floor(x / 0.5), math.floor(y / 0.5)))
    return len(cells - {tuple(cell) for cell in visited.tolist()})

# %% name="row before column" origin="fresh" sentence="A cell is (column, row): x first." must_say=["column|x first|exchanged"] kind="value"
def count_new(place, heading, way, visited):
    cells = set()
    for d in np.arange(0.1, way, 0.1):
        x, y = place[1] + d * math.sin(heading), place[0] + d * math.cos(heading)
        cells.add((math.floor(x / 0.5), math.floor(y / 0.5)))
    return len(cells - {tuple(cell) for cell in visited.tolist()})

# %% name="all visited subtracted" origin="fresh" sentence="Subtract only the visited cells that are on the way: the difference of two sets." must_say=["set|difference"] kind="value"
def count_new(place, heading, way, visited):
    cells = set()
    for d in np.arange(0.1, way, 0.1):
        x, y = place[0] + d * math.cos(heading), place[1] + d * math.sin(heading)
        cells.add((math.floor(x / 0.5), math.floor(y / 0.5)))
    return len(cells) - len(visited)

# %% name="whether something is new" origin="fresh" sentence="Return how many cells are new, not whether there is one." must_say=["how many|number|len"] kind="value"
def count_new(place, heading, way, visited):
    cells = set()
    for d in np.arange(0.1, way, 0.1):
        x, y = place[0] + d * math.cos(heading), place[1] + d * math.sin(heading)
        cells.add((math.floor(x / 0.5), math.floor(y / 0.5)))
    return int(len(cells - {tuple(cell) for cell in visited.tolist()}) > 0)
# %% name="counts points" origin="fresh" sentence="You count every point; several points in one cell must count once." must_say=["once|set|several|same cell|points"] kind="value"
def count_new(place, heading, way, visited):
    known = set(map(tuple, visited.tolist()))
    new = 0
    for d in np.arange(0.1, way, 0.1):
        col = math.floor((place[0] + d * math.cos(heading)) / 0.5)
        row = math.floor((place[1] + d * math.sin(heading)) / 0.5)
        if (col, row) not in known:
            new += 1
    return new
# %% name="end of the way included" origin="fresh" sentence="The distance must be less than way; your last point is at way or behind it." must_say=["less than|way|end|too far"] kind="value"
def count_new(place, heading, way, visited):
    known = set(map(tuple, visited.tolist()))
    cells = set()
    for d in np.arange(0.1, way + 0.1, 0.1):
        col = math.floor((place[0] + d * math.cos(heading)) / 0.5)
        row = math.floor((place[1] + d * math.sin(heading)) / 0.5)
        cells.add((col, row))
    return len(cells - known)
# %% name="int for floor" origin="fresh" sentence="int cuts towards 0, so -0.2 becomes 0; math.floor gives -1." must_say=["floor|negative|towards 0|round"] kind="value"
def count_new(place, heading, way, visited):
    known = set(map(tuple, visited.tolist()))
    cells = set()
    for d in np.arange(0.1, way, 0.1):
        col = int((place[0] + d * math.cos(heading)) / 0.5)
        row = int((place[1] + d * math.sin(heading)) / 0.5)
        cells.add((col, row))
    return len(cells - known)
# %% name="begins at 0" origin="fresh" sentence="The first point is at 0.1 m, not at the place itself." must_say=["0\\.1|place itself|first"] kind="value"
def count_new(place, heading, way, visited):
    known = set(map(tuple, visited.tolist()))
    cells = set()
    for d in np.arange(0, way, 0.1):
        col = math.floor((place[0] + d * math.cos(heading)) / 0.5)
        row = math.floor((place[1] + d * math.sin(heading)) / 0.5)
        cells.add((col, row))
    return len(cells - known)
# %% name="heading not used" origin="fresh" sentence="The way goes in the direction heading; you go only along x." must_say=["heading|direction"] kind="value"
def count_new(place, heading, way, visited):
    distances = np.arange(0.1, way, 0.1)
    columns = np.floor((place[0] + distances) / 0.5).astype(int)
    row = math.floor(place[1] / 0.5)
    cells = set((int(col), row) for col in columns)
    return len(cells - set(map(tuple, visited.tolist())))
# %% name="sin and cos exchanged" origin="fresh" sentence="x needs the cosine of the heading, y the sine." must_say=["cos|sin|x and y|exchang|swap"] kind="value"
def count_new(place, heading, way, visited):
    known = set(map(tuple, visited.tolist()))
    cells = set()
    for d in np.arange(0.1, way, 0.1):
        col = math.floor((place[0] + d * math.sin(heading)) / 0.5)
        row = math.floor((place[1] + d * math.cos(heading)) / 0.5)
        cells.add((col, row))
    return len(cells - known)
# %% name="in with an array" origin="fresh" sentence="`in` with a NumPy array is true if one number anywhere is equal; compare whole rows, or make a set of tuples." must_say=["\\bin\\b.*(array|NumPy)|array.*\\bin\\b|tuple|whole row|one number"] kind="value"
def count_new(place, heading, way, visited):
    cells = []
    for d in np.arange(0.1, way, 0.1):
        col = math.floor((place[0] + d * math.cos(heading)) / 0.5)
        row = math.floor((place[1] + d * math.sin(heading)) / 0.5)
        if [col, row] not in visited and [col, row] not in cells:
            cells.append([col, row])
    return len(cells)
# %% name="radians of radians" origin="fresh" sentence="heading is in radians already; math.radians makes it much too small." must_say=["radian|degrees"] kind="value"
def count_new(place, heading, way, visited):
    known = set(map(tuple, visited.tolist()))
    heading = math.radians(heading)
    cells = set()
    for d in np.arange(0.1, way, 0.1):
        col = math.floor((place[0] + d * math.cos(heading)) / 0.5)
        row = math.floor((place[1] + d * math.sin(heading)) / 0.5)
        cells.add((col, row))
    return len(cells - known)
# %% name="numbers subtracted" origin="fresh" sentence="You subtract the number of visited cells, but not all of them lie on this way." must_say=["visited|on (this|the) way|not all|set"] kind="value"
def count_new(place, heading, way, visited):
    cells = set()
    for d in np.arange(0.1, way, 0.1):
        col = math.floor((place[0] + d * math.cos(heading)) / 0.5)
        row = math.floor((place[1] + d * math.sin(heading)) / 0.5)
        cells.add((col, row))
    return len(cells) - len(visited)
