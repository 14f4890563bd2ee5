# %% name="heading not used" sentence="The way goes in the direction heading; you go only along x." must_say=["heading|direction"] kind="value"
def count_new(place, heading, way, visited):
    distances = np.arange(0.1, way, 0.1)
    columns = np.floor((place[0] + distances) / 0.5).astype(int)
    row = math.floor(place[1] / 0.5)
    cells = set((int(col), row) for col in columns)
    return len(cells - set(map(tuple, visited.tolist())))

# %% name="half a metre between the points" sentence="The points are 0.1 m apart." must_say=["0\\.1"] kind="value"
def count_new(place, heading, way, visited):
    cells = set()
    for d in np.arange(0.5, way, 0.5):
        x, y = place[0] + d * math.cos(heading), place[1] + d * math.sin(heading)
        cells.add((math.floor(x / 0.5), math.floor(y / 0.5)))
    return len(cells - {tuple(cell) for cell in visited.tolist()})
