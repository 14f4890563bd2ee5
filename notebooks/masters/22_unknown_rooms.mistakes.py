# %% [markdown]
# # unknown-coverage

# %%
def pairs_of(path, rounding=np.floor, size=0.5):
    return [tuple(pair) for pair in rounding(np.asarray(path)[:, :2] / size).astype(int).tolist()]


def reachable_of(cells):
    return {tuple(cell) for cell in np.asarray(cells).tolist()}

# %% role="mistake" name="rounded towards 0" says="You round towards 0: -0.1 and 0.1 come into one cell. Round down with np.floor before you make whole numbers."
def coverage(path, cells):
    return len(set(pairs_of(path, np.trunc)) & reachable_of(cells)) / len(cells)

# %% role="mistake" name="rounded to the nearest" says="You round to the nearest whole number. A cell begins at its lower border: round down with np.floor."
def coverage(path, cells):
    return len(set(pairs_of(path, np.rint)) & reachable_of(cells)) / len(cells)

# %% role="mistake" name="each visit counts" says="A cell counts each time that the robot is in it. Count it once: make a set of the pairs."
def coverage(path, cells):
    reachable = reachable_of(cells)
    return sum(pair in reachable for pair in pairs_of(path)) / len(cells)

# %% role="mistake" name="cells out of reach" says="You also count cells that are not in cells. Keep only the pairs that are in both sets: entered & reachable."
def coverage(path, cells):
    return len(set(pairs_of(path))) / len(cells)

# %% role="mistake" name="divided by the path" says="You divide by the number of places of the path. Divide by the number of cells that the robot can reach."
def coverage(path, cells):
    return len(set(pairs_of(path)) & reachable_of(cells)) / len(path)

# %% role="mistake" name="only the number" says="You return the number of cells. Divide it by the number of cells that the robot can reach."
def coverage(path, cells):
    return len(set(pairs_of(path)) & reachable_of(cells))

# %% role="mistake" name="cells of a metre" says="You did not divide x and y by 0.5: your cells are 1 m wide."
def coverage(path, cells):
    return len(set(pairs_of(path, size=1.0)) & reachable_of(cells)) / len(cells)

# %% role="mistake" name="only the cell before" says="You compare a cell only with the one just before. The robot can come back to it later: make a set of all pairs."
def coverage(path, cells):
    pairs, reachable = pairs_of(path), reachable_of(cells)
    news = [pair for k, pair in enumerate(pairs) if k == 0 or pair != pairs[k - 1]]
    return sum(pair in reachable for pair in news) / len(cells)

# %% [markdown]
# # unknown-new

# %%
def cells_along(place, x_part, y_part, distances, rounding=np.floor):
    points = np.column_stack([place[0] + distances * x_part, place[1] + distances * y_part])
    return [tuple(pair) for pair in rounding(points / 0.5).astype(int).tolist()]


def not_visited(pairs, visited):
    return len(set(pairs) - {tuple(cell) for cell in visited.tolist()})

# %% role="mistake" name="without the place" says="The way begins at the place: add place[0] and place[1]."
def count_new(place, heading, way, visited):
    distances = np.arange(0.1, way, 0.1)
    return not_visited(cells_along((0.0, 0.0), math.cos(heading), math.sin(heading), distances), visited)

# %% role="mistake" name="visited cells count" says="You also count the cells that were visited. Subtract their set."
def count_new(place, heading, way, visited):
    return len(set(cells_along(place, math.cos(heading), math.sin(heading), np.arange(0.1, way, 0.1))))

# %% role="mistake" name="only the end" says="You look only at the end of the way. Look at the points at 0.1 m, 0.2 m and so on."
def count_new(place, heading, way, visited):
    return not_visited(cells_along(place, math.cos(heading), math.sin(heading), np.array([way])), visited)

# %% role="mistake" name="only the columns" says="You compare only the columns. A cell is a pair, (column, row): the row comes from y and the sine of heading."
def count_new(place, heading, way, visited):
    pairs = cells_along(place, math.cos(heading), math.sin(heading), np.arange(0.1, way, 0.1))
    return len({column for column, _ in pairs} - set(visited[:, 0].tolist()))

# %% role="mistake" name="the number of visited cells" says="You subtract the number of all visited cells, but most of them are not on this way. Subtract the sets, and then count."
def count_new(place, heading, way, visited):
    pairs = cells_along(place, math.cos(heading), math.sin(heading), np.arange(0.1, way, 0.1))
    return max(0, len(set(pairs)) - len(visited))

# %% role="mistake" name="stops at a visited cell" says="You stop at the first visited cell. Leave this cell out, and go on: new cells can follow."
def count_new(place, heading, way, visited):
    known = {tuple(cell) for cell in visited.tolist()}
    pairs = cells_along(place, math.cos(heading), math.sin(heading), np.arange(0.1, way, 0.1))
    first = next((k for k, pair in enumerate(pairs) if pair in known), len(pairs))
    return len(set(pairs[:first]))

# %% [markdown]
# # unknown-drive

# %% role="mistake" name="it turns without an end" says="Your robot turns on the spot and drives hardly at all. Drive on while free_way ahead is long enough."
def control(observation, memory):
    return 0.03, 0.6

# %% role="mistake" name="a blind circle" says="Your robot drives in a circle, whatever it sees. Use the observation."
def control(observation, memory):
    return 0.25, 0.3

# %% role="mistake" name="the laser scanner alone" says="Your robot drives into something low. Use the points of the camera, too: obstacles(observation) has both. And remember them: what is low and near is below the image."
def control(observation, memory):
    return solution(dict(observation, depth=np.zeros((90, 160), np.uint16)), memory)

# %% role="mistake" name="it only brakes" says="Your robot stops in time, but then it stands. Choose another direction, and drive on."
def control(observation, memory):
    if free_way(obstacles(observation), 0.0) < 0.45:
        return 0.0, 0.0
    return 0.3, 0.0

# %% role="mistake" name="it takes the longest way" says="Your robot takes the longest free way, and drives to and fro over the same cells. Keep a set of the visited cells in memory, and choose the way with the most new ones."
def control(observation, memory):
    x, y, yaw = observation["odometry"]
    c, s = math.cos(yaw), math.sin(yaw)
    to_room = np.array([[c, s], [-s, c]])
    looks = memory.setdefault("looks", [])
    looks.append(obstacles(observation) @ to_room + (x, y))
    del looks[:-40]
    points = (np.concatenate(looks) - (x, y)) @ to_room.T
    error = math.remainder(memory.setdefault("heading", yaw) - yaw, 2 * math.pi)
    if abs(error) > 0.1:
        return 0.0, min(max(2.5 * error, -1.0), 1.0)
    if free_way(points, error, 0.64) > 0.45:
        return 0.3, 1.5 * error
    directions = np.radians(np.arange(-165, 181, 15))
    ways = [min(free_way(points, direction, 0.64), 3.0) - 0.1 * abs(direction) for direction in directions]
    memory["heading"] = yaw + float(directions[np.argmax(ways)])
    return 0.0, 0.0
