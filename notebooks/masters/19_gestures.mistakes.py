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

# %% role="mistake" name="not over the end, 0 and 0" says="If start is larger than end, you look at no point: nothing lies in range(start + 1, end). After the last point of the contour comes the first one: count with % len(contour)."
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

# %% role="mistake" name="left out" says="Runs before and after pixels outside the mask are joined: these pixels are left out, or are not 0. Each of them counts as 0."
def count_runs(mask, rows, cols):
    return runs_in(values_on(mask, rows, cols)[~is_outside(mask, rows, cols)])

# %% role="mistake" name="row and column exchanged" says="Row and column of a pixel are exchanged: it is mask[row, col], the row comes first."
def count_runs(mask, rows, cols):
    outside = is_outside(mask, rows, cols)
    return runs_in(np.array([0 if out else mask[c, r] for r, c, out in zip(rows, cols, outside, strict=True)]))

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

