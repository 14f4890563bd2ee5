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
