# %% [markdown]
# # gestures-hull

# %%
def chain_of(points, is_wrong):
    chain = []
    for point in points:
        while len(chain) >= 2 and is_wrong(turn(chain[-2], chain[-1], point)):
            chain.pop()
        chain.append(point)
    return chain

def hull_of(points, is_wrong=lambda value: value <= 0, key=None):
    ordered = sorted(points.tolist(), key=key)
    upper, lower = chain_of(ordered, is_wrong), chain_of(ordered[::-1], is_wrong)
    return np.array(upper[:-1] + lower[:-1])


# %% role="mistake" name="upper side only" says="These are only the corners of the upper side. Go over the points a second time, in reverse order, for the lower side."
def convex_hull(points):
    return np.array(chain_of(sorted(points.tolist()), lambda value: value <= 0))

# %% role="mistake" name="upper side only, without its end" says="These are only the corners of the upper side, without the last one. Go over the points a second time, in reverse order, for the lower side."
def convex_hull(points):
    return np.array(chain_of(sorted(points.tolist()), lambda value: value <= 0)[:-1])

# %% role="mistake" name="the other way round, from the right" says="Your corners go round in the other direction: you turned the list round. Return the corners in the order in which you found them."
def convex_hull(points):
    return solution(points)[::-1]

# %% role="mistake" name="lower side first" says="You begin with the lower side, at the right end. Begin with the points from left to right."
def convex_hull(points):
    ordered = sorted(points.tolist())
    upper, lower = (chain_of(side, lambda value: value <= 0)[:-1] for side in (ordered, ordered[::-1]))
    return np.array(lower + upper)

# %% role="mistake" name="bounding box" says="These are the corners of the bounding box. The corners of the hull are points of the input."
def convex_hull(points):
    (left, top), (right, bottom) = points.min(axis=0), points.max(axis=0)
    return np.array([[left, top], [right, top], [right, bottom], [left, bottom]])

# %% role="mistake" name="outermost points" says="You return only the outermost points: left, up, right and down. The hull can have many more corners."
def convex_hull(points):
    x, y = points[:, 0], points[:, 1]
    return points[[x.argmin(), y.argmin(), x.argmax(), y.argmax()]]

# %% role="mistake" name="sorted by x alone" says="You sort by x alone. Of points with the same x, the one with the smaller y comes first: sorted(points.tolist()) does that."
def convex_hull(points):
    return hull_of(points, key=lambda point: point[0])

# %% role="mistake" name="columns sorted" says="np.sort(points, axis=0) sorts the x and the y by themselves, so the points are torn apart. Use sorted(points.tolist())."
def convex_hull(points):
    return hull_of(np.sort(points, axis=0))

# %% role="mistake" name="y before x" says="Your corners are (y, x). Return x, y, as in the input."
def convex_hull(points):
    return solution(points)[:, ::-1]

# %% role="mistake" name="nothing removed" says="All points are in your result. Remove the last point of the chain while the path over it does not turn to the right."
def convex_hull(points):
    ordered = sorted(points.tolist())
    return np.array(ordered[:-1] + ordered[::-1][:-1])

# %% role="mistake" name="lower side with left turns" says="The lower side also turns only to the right, if you go over the points in reverse order. Go from right to left there: ordered[::-1]."
def convex_hull(points):
    ordered = sorted(points.tolist())
    upper, lower = chain_of(ordered, lambda value: value <= 0), chain_of(ordered, lambda value: value >= 0)
    return np.array(upper[:-1] + lower[:-1])

# %% role="mistake" name="the new point compared with itself" says="The new point is in the chain already when you look at the turn. Look first, remove, and add it after that."
def convex_hull(points):
    ordered = sorted(points.tolist())
    chains = []
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            chain.append(point)
            while len(chain) >= 2 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
        chains += chain[:-1]
    return np.array(chains)

# %% [markdown]
# # gestures-valley

# %%
def way_of(contour, start, end):
    return (start + 1 + np.arange((end - start - 1) % len(contour))) % len(contour)

def areas_of(contour, start, end, way):
    return turn(contour[start], contour[end], contour[way].T)

def length_of(contour, start, end):
    return float(np.hypot(*(contour[end] - contour[start])))

def deepest_of(way, depths):
    return int(way[np.argmax(depths)]), float(max(depths))

# %% role="mistake" name="with sign" says="turn has a sign. It is negative if the points lie on the other side of the line: take abs(...)."
def deepest_point(contour, start, end):
    way = way_of(contour, start, end)
    return deepest_of(way, areas_of(contour, start, end, way) / length_of(contour, start, end))

# %% role="mistake" name="the whole contour" says="You look at all points of the contour. Look only at those after start and before end."
def deepest_point(contour, start, end):
    way = np.arange(len(contour))
    return deepest_of(way, abs(areas_of(contour, start, end, way)) / length_of(contour, start, end))

# %% role="mistake" name="the other way round" says="You go from end to start. Go from start to end."
def deepest_point(contour, start, end):
    return solution(contour, end, start)

# %% role="mistake" name="position in the valley" says="You count the position from the corner at start. Return the position in the contour."
def deepest_point(contour, start, end):
    place, depth = solution(contour, start, end)
    return (place - start - 1) % len(contour), depth

# %% role="mistake" name="distance to the first corner" says="You measure the distance to the corner at start. Measure the distance to the line through both corners."
def deepest_point(contour, start, end):
    way = way_of(contour, start, end)
    return deepest_of(way, np.hypot(*(contour[way] - contour[start]).T))

# %% role="mistake" name="distance to the middle" says="You measure the distance to the middle between the corners. Measure the distance to the line through both corners."
def deepest_point(contour, start, end):
    way = way_of(contour, start, end)
    return deepest_of(way, np.hypot(*(contour[way] - (contour[start] + contour[end]) / 2).T))

# %% role="mistake" name="half" says="Your depth is half as large as it should be. turn is the area of the parallelogram, so there is no division by 2."
def deepest_point(contour, start, end):
    place, depth = solution(contour, start, end)
    return place, depth / 2

# %% role="mistake" name="divided by the squared length" says="You divided by the square of the length. Take the square root: np.hypot, or np.linalg.norm."
def deepest_point(contour, start, end):
    place, depth = solution(contour, start, end)
    return place, depth / length_of(contour, start, end)

# %% role="mistake" name="L1 length" says="You divided by |x| + |y|. The length of the line is the square root of the sum of squares: np.hypot."
def deepest_point(contour, start, end):
    place, depth = solution(contour, start, end)
    return place, depth * length_of(contour, start, end) / float(abs(contour[end] - contour[start]).sum())

# %% role="mistake" name="only the depth" says="You return only the depth. Return both, position and depth."
def deepest_point(contour, start, end):
    return solution(contour, start, end)[1]

# %% role="mistake" name="the point" says="You return the point itself. Return its position in the contour."
def deepest_point(contour, start, end):
    place, depth = solution(contour, start, end)
    return contour[place], depth

# %% role="mistake" name="whole pixels" says="You cut the depth to a whole number. Return the float."
def deepest_point(contour, start, end):
    place, depth = solution(contour, start, end)
    return place, float(int(depth))

# %% role="mistake" name="nearest" says="You keep the point that is nearest to the line. Keep the one that is farthest from it."
def deepest_point(contour, start, end):
    way = way_of(contour, start, end)
    depths = abs(areas_of(contour, start, end, way)) / length_of(contour, start, end)
    return int(way[np.argmin(depths)]), float(min(depths))

# %% role="mistake" name="first point missing" says="The first point after start is missing. Begin at start + 1."
def deepest_point(contour, start, end):
    way = way_of(contour, start, end)[1:]
    return deepest_of(way, abs(areas_of(contour, start, end, way)) / length_of(contour, start, end))

# %% role="mistake" name="last point missing" says="The last point before end is missing. Go on until the position is end."
def deepest_point(contour, start, end):
    way = way_of(contour, start, end)[:-1]
    return deepest_of(way, abs(areas_of(contour, start, end, way)) / length_of(contour, start, end))

# %% role="mistake" name="start + 1 without remainder" says="If start is the last position, start + 1 is too large. Take the remainder there as well: (start + 1) % len(contour)."
def deepest_point(contour, start, end):
    contour[start + 1]
    return solution(contour, start, end)

# %% role="mistake" name="not over the end, 0 and 0" says="If start is larger than end, range(start + 1, end) is empty. After the last point of the contour comes the first one: count with % len(contour)."
def deepest_point(contour, start, end):
    return solution(contour, start, end) if start < end else (0, 0)

# %% [markdown]
# # gestures-runs

# %%
def runs_in(values):
    return int(((values == 1) & (np.roll(values, 1) == 0)).sum())

# %% role="mistake" name="pixels counted" says="You count all ones on the way. Count only where a run begins: the value is 1, and the one before is 0."
def count_runs(mask, rows, cols):
    return int(values_on(mask, rows, cols).sum())

# %% role="mistake" name="beginnings and ends" says="You count where a run begins and also where it ends. Count only the beginnings. (Or do you subtract uint8 values? There, 0 - 1 is 255.)"
def count_runs(mask, rows, cols):
    return 2 * runs_in(values_on(mask, rows, cols))

# %% role="mistake" name="left out" says="You left out the pixels outside the mask, so the runs before and after them are joined. Such a pixel counts as 0."
def count_runs(mask, rows, cols):
    return runs_in(values_on(mask, rows, cols)[~is_outside(mask, rows, cols)])

# %% role="mistake" name="negative rows not tested" says="A negative row is outside too. NumPy counts it from the end, without an error: test row < 0 as well."
def count_runs(mask, rows, cols):
    outside = (cols < 0) | (rows >= mask.shape[0]) | (cols >= mask.shape[1])
    return runs_in(np.array([0 if out else mask[r, c] for r, c, out in zip(rows, cols, outside, strict=True)]))

# %% role="mistake" name="columns not tested" says="A pixel can also be outside because of its column. Test both, the row and the column."
def count_runs(mask, rows, cols):
    outside = (rows < 0) | (rows >= mask.shape[0])
    return runs_in(np.array([0 if out else mask[r, c] for r, c, out in zip(rows, cols, outside, strict=True)]))

# %% role="mistake" name="rows not tested" says="A pixel can also be outside because of its row. Test both, the row and the column."
def count_runs(mask, rows, cols):
    outside = (cols < 0) | (cols >= mask.shape[1])
    return runs_in(np.array([0 if out else mask[r, c] for r, c, out in zip(rows, cols, outside, strict=True)]))

# %% role="mistake" name="ten pixels" says="You look at the first ten pixels only. The way has len(rows) pixels."
def count_runs(mask, rows, cols):
    values = values_on(mask, rows, cols)
    return int(((values == 1) & (np.roll(values, 1) == 0))[:10].sum())

# %% role="mistake" name="row 0 is outside" says="Row 0 and column 0 are inside the mask: test >= 0, not > 0."
def count_runs(mask, rows, cols):
    return runs_in(np.where((rows == 0) | (cols == 0), 0, values_on(mask, rows, cols)))

# %% role="mistake" name="the whole mask" says="Your result does not depend on the way: you count runs in the rows of the mask. Take the pixels mask[row, col] of the way."
def count_runs(mask, rows, cols):
    padded = np.pad(mask.astype(int), ((0, 0), (1, 0)))
    return int((np.diff(padded, axis=1) == 1).sum())

# %% role="mistake" name="longest run" says="You return the length of the longest run. Return how many runs there are."
def count_runs(mask, rows, cols):
    values = values_on(mask, rows, cols)
    lengths, length = [], 0
    for value in np.roll(values, -int(np.flatnonzero(values == 0)[0])):
        length = length + 1 if value else 0
        lengths.append(length)
    return max(lengths)

# %% role="mistake" name="always one less" says="You subtract 1 always. A run goes on over the end only if the first and the last pixel are both 1."
def count_runs(mask, rows, cols):
    values = np.append(0, values_on(mask, rows, cols))
    return max(runs_in(values) - 1, 0)

# %% role="mistake" name="ends without the last" says="You count a run when the 0 after it comes. A run up to the last pixel has none in your loop: after the last pixel comes the first one, values[0]."
def count_runs(mask, rows, cols):
    values = values_on(mask, rows, cols)
    return int(((values[1:] == 0) & (values[:-1] == 1)).sum())

# %% [markdown]
# # gestures-dtw

# %%
def norm_of(differences):
    return np.linalg.norm(differences, axis=-1)

def table_of(track, other, distance=norm_of, corner=1.0, border=np.inf, free=False, choose=min, above=True, left=True):
    distances = distance(np.asarray(track)[:, None] - np.asarray(other))
    costs = np.full((len(track) + 1, len(other) + 1), border)
    costs[0, 0] = 0
    if free:
        costs[0] = 0
    for i in range(len(track)):
        for j in range(len(other)):
            before = [costs[i, j] if corner else np.inf]
            before += [costs[i, j + 1]] * above + [costs[i + 1, j]] * left
            if not corner and i == j == 0:
                before = [0.0]
            costs[i + 1, j + 1] = distances[i, j] + choose(before)
    return costs

# %% role="mistake" name="squares" says="You add the squares of the distances. Take the square root: np.linalg.norm(p - q)."
def dtw_cost(track, other):
    return float(table_of(track, other, lambda d: (d * d).sum(axis=-1))[-1, -1])

# %% role="mistake" name="L1 norm" says="You add |x| and |y| of the difference. The distance of two points is the L2 norm: np.linalg.norm(p - q)."
def dtw_cost(track, other):
    return float(table_of(track, other, lambda d: abs(d).sum(axis=-1))[-1, -1])

# %% role="mistake" name="x alone" says="You compare only the x of the points. A point has two numbers: np.linalg.norm(p - q)."
def dtw_cost(track, other):
    return float(table_of(track, other, lambda d: abs(d[..., 0]))[-1, -1])

# %% role="mistake" name="without the neighbour above left" says="Three neighbours come before a number: above, left, and above left. You left out the one above left."
def dtw_cost(track, other):
    return float(table_of(track, other, corner=0.0)[-1, -1])

# %% role="mistake" name="border of zeros" says="The first row and the first column are not added up: each number there is only its own distance. Is your border 0? Fill the table with np.inf, and write 0 only at [0, 0]."
def dtw_cost(track, other):
    return float(table_of(track, other, border=0.0)[-1, -1])

# %% role="mistake" name="free beginning" says="Your first row is 0, so the second track may begin anywhere. The border is np.inf; only costs[0, 0] is 0."
def dtw_cost(track, other):
    return float(table_of(track, other, free=True)[-1, -1])

# %% role="mistake" name="dearest" says="You take the largest of the three neighbours. Take the smallest."
def dtw_cost(track, other):
    distances = norm_of(np.asarray(track)[:, None] - np.asarray(other))
    costs = np.zeros((len(track) + 1, len(other) + 1))
    for i, j in np.ndindex(distances.shape):
        costs[i + 1, j + 1] = distances[i, j] + max(costs[i, j], costs[i, j + 1], costs[i + 1, j])
    return float(costs[-1, -1])

# %% role="mistake" name="mean" says="You divided by the lengths of the tracks. Return the sum; the division comes later."
def dtw_cost(track, other):
    return solution(track, other) / (len(track) + len(other))

# %% role="mistake" name="divided by the longer track" says="You divided by the length of the longer track. Return the sum."
def dtw_cost(track, other):
    return solution(track, other) / max(len(track), len(other))

# %% role="mistake" name="the table" says="You return the whole table. Return its last number, costs[-1, -1]."
def dtw_cost(track, other):
    return table_of(track, other)

# %% role="mistake" name="divided by the first track" says="You divided by the length of the first track. Return the sum."
def dtw_cost(track, other):
    return solution(track, other) / len(track)

# %% role="mistake" name="centered first" says="Do not subtract the mean here: compare the points as they are."
def dtw_cost(track, other):
    return solution(track - track.mean(axis=0), other - other.mean(axis=0))

# %% role="mistake" name="greedy" says="You go step by step to the cheapest next pair, and cannot correct an early choice. Fill the whole table: each number is the smallest of three, plus the distance."
def dtw_cost(track, other):
    i = j = 0
    cost = norm_of(track[0] - other[0])
    while i < len(track) - 1 or j < len(other) - 1:
        steps = [(i + 1, j + 1), (i + 1, j), (i, j + 1)]
        steps = [(r, c) for r, c in steps if r < len(track) and c < len(other)]
        i, j = min(steps, key=lambda step: norm_of(track[step[0]] - other[step[1]]))
        cost += norm_of(track[i] - other[j])
    return float(cost)

# %% role="mistake" name="nearest points" says="You pair each point with the nearest one of the other track. The order counts too: both tracks are passed through from the beginning to the end."
def dtw_cost(track, other):
    return float(norm_of(np.asarray(track)[:, None] - np.asarray(other)).min(axis=1).sum())

# %% role="mistake" name="all pairs" says="You add up the distances of all pairs. Add only the smallest of the three neighbours to each distance."
def dtw_cost(track, other):
    return float(norm_of(np.asarray(track)[:, None] - np.asarray(other)).sum())

# %% role="mistake" name="root of squares" says="You added squares, and took the root at the end. Take the root of each distance: np.linalg.norm(p - q)."
def dtw_cost(track, other):
    return float(np.sqrt(table_of(track, other, lambda d: (d * d).sum(axis=-1))[-1, -1]))

# %% role="mistake" name="no border" says="The first row and the first column of your distances are left out. Make the table one row and one column larger than the distances: costs[i + 1, j + 1] belongs to the points i and j."
def dtw_cost(track, other):
    return float(table_of(track[1:], other[1:])[-1, -1])

# %% role="mistake" name="edit distance" says="This is the edit distance, with 1 for a step to the side and 0, 1, 2 on the border. Here each pair costs its distance, from whichever neighbour it comes, and the border is np.inf."
def dtw_cost(track, other):
    distances = norm_of(np.asarray(track)[:, None] - np.asarray(other))
    costs = np.add.outer(np.arange(len(track) + 1.0), np.arange(len(other) + 1.0))
    for i, j in np.ndindex(distances.shape):
        costs[i + 1, j + 1] = min(costs[i, j] + distances[i, j], costs[i, j + 1] + 1, costs[i + 1, j] + 1)
    return float(costs[-1, -1])
