# %% [markdown]
# # tracking-iou

# %%
def common(a, b, axis):
    """The signed common length of two boxes: axis 0 for columns, 1 for rows."""
    return min(a[axis] + a[axis + 2], b[axis] + b[axis + 2]) - max(a[axis], b[axis])

def both_of(a, b):
    return max(common(a, b, 0), 0) * max(common(a, b, 1), 0)

# %% role="mistake" name="the intersection counted twice" says="You divided by the sum of both areas. The intersection lies in both, so the sum counts it twice: subtract it once."
def iou(a, b):
    return both_of(a, b) / (a[2] * a[3] + b[2] * b[3])

# %% role="mistake" name="twice the intersection" says="You computed another measure (Dice): 2 * both / (sum of the areas). The IoU divides the intersection by the union."
def iou(a, b):
    return 2 * both_of(a, b) / (a[2] * a[3] + b[2] * b[3])

# %% role="mistake" name="over the first box" says="You divided by the area of the first box. Divide by the union of both."
def iou(a, b):
    return both_of(a, b) / (a[2] * a[3])

# %% role="mistake" name="over the second box" says="You divided by the area of the second box. Divide by the union of both."
def iou(a, b):
    return both_of(a, b) / (b[2] * b[3])

# %% role="mistake" name="over the smaller box" says="You divided by the area of the smaller box. Divide by the union of both."
def iou(a, b):
    return both_of(a, b) / min(a[2] * a[3], b[2] * b[3])

# %% role="mistake" name="over the larger box" says="You divided by the area of the larger box. Divide by the union of both."
def iou(a, b):
    return both_of(a, b) / max(a[2] * a[3], b[2] * b[3])

# %% role="mistake" name="the box around both" says="You divided by the area of the box around both. This box also covers pixels that lie in none of the two; the union is both areas minus the intersection."
def iou(a, b):
    width = max(a[0] + a[2], b[0] + b[2]) - min(a[0], b[0])
    height = max(a[1] + a[3], b[1] + b[3]) - min(a[1], b[1])
    return both_of(a, b) / (width * height)

# %% role="mistake" name="only the intersection" says="This is the area of the intersection. Divide it by the area of the union."
def iou(a, b):
    return float(both_of(a, b))

# %% role="mistake" name="width and height as ends" says="You read a[2] and a[3] as the right and the lower end of the box. They are the width and the height: the right end is a[0] + a[2], the lower end a[1] + a[3]."
def iou(a, b):
    width, height = (min(a[k + 2], b[k + 2]) - max(a[k], b[k]) for k in (0, 1))
    both = max(width, 0) * max(height, 0)
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% role="mistake" name="width and height as ends, also in the areas" says="You read a[2] and a[3] as the right and the lower end of the box. They are the width and the height: the right end is a[0] + a[2], the lower end a[1] + a[3], and the area a[2] * a[3]."
def iou(a, b):
    width, height = (min(a[k + 2], b[k + 2]) - max(a[k], b[k]) for k in (0, 1))
    both = max(width, 0) * max(height, 0)
    areas = [(box[2] - box[0]) * (box[3] - box[1]) for box in (a, b)]
    return both / (sum(areas) - both)

# %% role="mistake" name="width and height exchanged" says="Width and height are exchanged: a box is (col, row, width, height), so the columns end at a[0] + a[2], and the rows at a[1] + a[3]."
def iou(a, b):
    width = min(a[0] + a[3], b[0] + b[3]) - max(a[0], b[0])
    height = min(a[1] + a[2], b[1] + b[2]) - max(a[1], b[1])
    both = max(width, 0) * max(height, 0)
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% role="mistake" name="only the columns" says="You compared the columns only. The intersection also has a height, from the rows."
def iou(a, b):
    width = max(common(a, b, 0), 0)
    return width / (a[2] + b[2] - width)

# %% role="mistake" name="only the rows" says="You compared the rows only. The intersection also has a width, from the columns."
def iou(a, b):
    height = max(common(a, b, 1), 0)
    return height / (a[3] + b[3] - height)

# %% role="mistake" name="upside down" says="The fraction is upside down: the intersection is above the line, the union below it."
def iou(a, b):
    both = both_of(a, b)
    return (a[2] * a[3] + b[2] * b[3] - both) / both if both else 0.0

# %% role="mistake" name="one pixel more" says="You added 1 to the width and to the height of the intersection. The width counts pixels already: it is the end minus the start."
def iou(a, b):
    both = max(common(a, b, 0) + 1, 0) * max(common(a, b, 1) + 1, 0)
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% role="mistake" name="rounded" says="The result is rounded. Return the exact number, and leave round out."
def iou(a, b):
    return round(solution(a, b), 2)

# %% role="mistake" name="whole division" says="// gives a whole number, so your result is 0 or 1. Divide with /."
def iou(a, b):
    return float(solution(a, b) // 1)

# %% role="mistake" name="distance of the union" says="You return 1 - IoU, which is 0 for equal boxes. Return the IoU itself."
def iou(a, b):
    return 1 - solution(a, b)

# %% role="mistake" name="start and end exchanged" says="min and max are exchanged: you computed the box around both. The common part starts at the larger start, and ends at the smaller end."
def iou(a, b):
    width = max(a[0] + a[2], b[0] + b[2]) - min(a[0], b[0])
    height = max(a[1] + a[3], b[1] + b[3]) - min(a[1], b[1])
    both = width * height
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% role="mistake" name="the smaller height" says="Your common height does not depend on where the rows begin. Compute it as the width: the smaller end minus the larger start."
def iou(a, b):
    both = max(common(a, b, 0), 0) * min(a[3], b[3])
    return both / (a[2] * a[3] + b[2] * b[3] - both)

# %% [markdown]
# # tracking-backproject

# %%
def bins_of(hue, weights):
    return hue.astype(int) * len(weights) // 180

# %% role="mistake" name="overflow" says="You multiplied in uint8, and large products wrapped around. First widen: hue.astype(int)."
def backproject(hue, weights):
    return weights[np.minimum(hue * np.uint8(len(weights)) // 180, len(weights) - 1)]

# %% role="mistake" name="divided by 256" says="You divided by 256. OpenCV's hue ends at 179: divide by 180."
def backproject(hue, weights):
    return weights[hue.astype(int) * len(weights) // 256]

# %% role="mistake" name="divided by 360" says="You divided by 360. OpenCV's hue counts steps of two degrees and ends at 179: divide by 180."
def backproject(hue, weights):
    return weights[hue.astype(int) * len(weights) // 360]

# %% role="mistake" name="divided by 255" says="You divided by 255. OpenCV's hue ends at 179: divide by 180."
def backproject(hue, weights):
    return weights[hue.astype(int) * len(weights) // 255]

# %% role="mistake" name="always 18 bins" says="You always divide by 10, which is right for 18 bins only. The number of bins is len(weights)."
def backproject(hue, weights):
    return weights[np.minimum(hue // 10, len(weights) - 1)]

# %% role="mistake" name="always 18 bins, and overflow" says="Two things are wrong: hue is uint8, so hue * 18 does not fit (widen it: hue.astype(int)), and the number of bins is len(weights), not always 18."
def backproject(hue, weights):
    return weights[hue * 18 // 180]

# %% role="mistake" name="divided by the number of bins" says="You divided by the number of bins. A bin has 180 / bins hues: multiply by the number of bins, and divide by 180."
def backproject(hue, weights):
    return weights[hue.astype(int) // len(weights)]

# %% role="mistake" name="numbers of the bins" says="These are the numbers of the bins. Look up the weight of each of them: weights[bins]."
def backproject(hue, weights):
    return bins_of(hue, weights).astype(np.uint8)

# %% role="mistake" name="nearest bin" says="You rounded to the nearest bin. A bin begins at its first hue: use //, which rounds down."
def backproject(hue, weights):
    return weights[np.minimum(np.rint(hue.astype(int) * len(weights) / 180).astype(int), len(weights) - 1)]

# %% role="mistake" name="one bin too far" says="Your bins are one too high: bins count from 0. Leave the + 1 out."
def backproject(hue, weights):
    return weights[np.minimum(bins_of(hue, weights) + 1, len(weights) - 1)]

# %% role="mistake" name="one bin too low" says="Your bins are one too low: the hue 0 is in bin 0. Leave the - 1 out."
def backproject(hue, weights):
    return weights[bins_of(hue, weights) - 1]

# %% role="mistake" name="reversed" says="You looked up the bins from the other end. The hue 0 has the first weight, weights[0]."
def backproject(hue, weights):
    return weights[::-1][bins_of(hue, weights)]

# %% role="mistake" name="white or black" says="You return 255 or 0. Return the weight itself."
def backproject(hue, weights):
    return np.where(solution(hue, weights) >= 128, 255, 0).astype(np.uint8)

# %% role="mistake" name="0 to 1" says="You divided the weights by 255. Return the weights as they are, in uint8."
def backproject(hue, weights):
    return solution(hue, weights) / 255

# %% role="mistake" name="weights multiplied with the hue" says="You multiplied the weight with the hue. The result is the weight itself, weights[bins]."
def backproject(hue, weights):
    return (solution(hue, weights).astype(int) * hue).clip(0, 255).astype(np.uint8)

# %% role="mistake" name="width of a bin cut off" says="You divided 180 by the number of bins first, and // cuts the width of a bin off. Multiply first: hue.astype(int) * len(weights) // 180."
def backproject(hue, weights):
    return weights[np.minimum(hue // max(180 // len(weights), 1), len(weights) - 1)]

# %% role="mistake" name="width of a bin cut off, around the end" says="You divided 180 by the number of bins first, and // cuts the width of a bin off. Multiply first: hue.astype(int) * len(weights) // 180."
def backproject(hue, weights):
    return weights[hue // max(180 // len(weights), 1) % len(weights)]

# %% [markdown]
# # tracking-mean-shift

# %%
def means_of(window):
    """The mean column and the mean row; None without weights."""
    total = window.sum()
    if total == 0:
        return None
    col = (window.sum(axis=0) * np.arange(window.shape[1])).sum() / total
    row = (window.sum(axis=1) * np.arange(window.shape[0])).sum() / total
    return col, row

def step_with(weights, box, shift, inside=True, window=None):
    """A step with another shift: shift(mean, size, start) for columns and rows."""
    col, row, width, height = box
    cut = weights[row : row + height, col : col + width] if window is None else window
    means = means_of(cut)
    if means is None:
        return box
    col, row = (int(shift(*given)) for given in zip(means, (width, height), (col, row), strict=True))
    if inside:
        col = min(max(col, 0), weights.shape[1] - width)
        row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

def right_shift(mean, size, start):
    return start + round(mean - size / 2)

# %% role="mistake" name="the center of mass as the corner" says="You put the corner of the box to the center of mass. Its middle belongs there: subtract half of the width and of the height."
def mean_shift_step(weights, box):
    return step_with(weights, box, lambda mean, size, start: start + round(mean))

# %% role="mistake" name="without the place of the box" says="Your column and row are counted from the corner of the box. Add the col and the row of the box."
def mean_shift_step(weights, box):
    return step_with(weights, box, lambda mean, size, start: round(mean - size / 2))

# %% role="mistake" name="middle of the pixels" says="Your box is a pixel too far to the right or too low. Subtract width / 2, as OpenCV does, and not (width - 1) / 2; and use round, which does not always round up."
def mean_shift_step(weights, box):
    return step_with(weights, box, lambda mean, size, start: start + round(mean - (size - 1) / 2))

# %% role="mistake" name="cut off" says="You used int, which cuts the digits off. Use round, which takes the nearest whole number."
def mean_shift_step(weights, box):
    return step_with(weights, box, lambda mean, size, start: start + int(mean - size / 2))

# %% role="mistake" name="rounded down" says="You rounded down (// or floor). Use round, which takes the nearest whole number."
def mean_shift_step(weights, box):
    return step_with(weights, box, lambda mean, size, start: start + math.floor(mean - size / 2))

# %% role="mistake" name="the other direction" says="The box moves away from the weights: the shift is mean - width / 2, not the other way round."
def mean_shift_step(weights, box):
    return step_with(weights, box, lambda mean, size, start: start - round(mean - size / 2))

# %% role="mistake" name="not kept inside" says="Your box leaves the image. Keep col between 0 and weights.shape[1] - width, and row between 0 and weights.shape[0] - height."
def mean_shift_step(weights, box):
    return step_with(weights, box, right_shift, inside=False)

# %% role="mistake" name="only the left and upper border" says="Your box stays inside at the left and at the top, but not at the right and at the bottom: col must not be above weights.shape[1] - width."
def mean_shift_step(weights, box):
    col, row, width, height = step_with(weights, box, right_shift, inside=False)
    return max(col, 0), max(row, 0), width, height

# %% role="mistake" name="all weights equal" says="Each pixel with a weight counts the same in your mean. Multiply by the weights."
def mean_shift_step(weights, box):
    col, row, width, height = box
    return step_with(weights, box, right_shift, window=(weights[row : row + height, col : col + width] > 0).astype(int))

# %% role="mistake" name="the brightest pixel" says="You moved the box to the pixel with the largest weight. Use the center of mass: all weights in the box count."
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row : row + height, col : col + width]
    return step_with(weights, box, right_shift, window=((window == window.max()) & (window > 0)).astype(int))

# %% role="mistake" name="the whole image" says="You took the center of mass of the whole image. Only the weights inside the box count: weights[row:row + height, col:col + width]."
def mean_shift_step(weights, box):
    means, (_, _, width, height) = means_of(weights), box
    if means is None:
        return box
    col, row = round(means[0] - width / 2), round(means[1] - height / 2)
    return min(max(col, 0), weights.shape[1] - width), min(max(row, 0), weights.shape[0] - height), width, height

# %% role="mistake" name="all the steps" says="You repeated the step until the box stays. The task asks for one step."
def mean_shift_step(weights, box):
    for _ in range(10):
        box = solution(weights, box)
    return box

# %% role="mistake" name="columns and rows exchanged" says="Columns and rows are exchanged: window.sum(axis=0) has one number per column, and belongs to col."
def mean_shift_step(weights, box):
    col, row, width, height = box
    means = means_of(weights[row : row + height, col : col + width])
    if means is None:
        return box
    col, row = col + round(means[1] - width / 2), row + round(means[0] - height / 2)
    return min(max(col, 0), weights.shape[1] - width), min(max(row, 0), weights.shape[0] - height), width, height

# %% role="mistake" name="rows and columns of the window exchanged" says="Rows and columns are exchanged in the window. An array is indexed rows first: weights[row : row + height, col : col + width]."
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[col : col + width, row : row + height]
    if not window.any():
        return box
    cols, rows = window.sum(axis=0) * np.arange(width), window.sum(axis=1) * np.arange(height)
    col = col + round(cols.sum() / window.sum() - width / 2)
    row = row + round(rows.sum() / window.sum() - height / 2)
    return min(max(col, 0), weights.shape[1] - width), min(max(row, 0), weights.shape[0] - height), width, height

# %% role="mistake" name="borders exchanged" says="The two sizes of the image are exchanged: weights.shape[0] is the number of rows, and limits row; weights.shape[1] limits col."
def mean_shift_step(weights, box):
    col, row, width, height = step_with(weights, box, right_shift, inside=False)
    if means_of(weights[box[1] : box[1] + height, box[0] : box[0] + width]) is None:
        return box
    return min(max(col, 0), weights.shape[0] - width), min(max(row, 0), weights.shape[1] - height), width, height

# %% role="mistake" name="divided by the pixels" says="You divided by the number of pixels (or took a mean of the products). Divide by the sum of the weights, so that each pixel counts as much as its weight."
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row : row + height, col : col + width]
    if not window.any():
        return box
    share = window.sum() / window.size
    means = [mean * share for mean in means_of(window)]
    col, row = col + round(means[0] - width / 2), row + round(means[1] - height / 2)
    return min(max(col, 0), weights.shape[1] - width), min(max(row, 0), weights.shape[0] - height), width, height

# %% role="mistake" name="row before column" says="The order is (col, row, width, height); you return row before col."
def mean_shift_step(weights, box):
    col, row, width, height = solution(weights, box)
    return row, col, width, height

# %% role="mistake" name="only column and row" says="You return two numbers. Return the whole box: col, row, width, height."
def mean_shift_step(weights, box):
    return solution(weights, box)[:2]

# %% [markdown]
# # tracking-predict

# %% role="mistake" name="without Q" says="Q is missing: each prediction makes the state less certain. Add Q to the covariance."
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance @ F.T

# %% role="mistake" name="minus Q" says="You subtracted Q. A prediction makes the state less certain: add Q."
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance @ F.T - Q

# %% role="mistake" name="without the transposed matrix" says="The second F must be transposed: F @ covariance @ F.T."
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance @ F + Q

# %% role="mistake" name="transposed on the left" says="F and F.T are exchanged: F stands on the left of the covariance, F.T on its right."
def predict(state, covariance, F, Q):
    return F @ state, F.T @ covariance @ F + Q

# %% role="mistake" name="F only from the left" says="F is missing on the right side of the covariance: F @ covariance @ F.T."
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance + Q

# %% role="mistake" name="element by element" says="You multiplied the covariance element by element, with *. Matrices are multiplied with @."
def predict(state, covariance, F, Q):
    return F @ state, F * covariance * F.T + Q

# %% role="mistake" name="state element by element" says="You multiplied the state with *, value by value, so it became a matrix. F @ state multiplies each row of F with the state, and adds up."
def predict(state, covariance, F, Q):
    return F * state, F @ covariance @ F.T + Q

# %% role="mistake" name="everything element by element" says="You multiplied with *, value by value, so the state became a matrix. Matrices are multiplied with @: F @ state, and F @ covariance @ F.T + Q."
def predict(state, covariance, F, Q):
    return F * state, F * covariance * F.T + Q

# %% role="mistake" name="Q added to the state" says="You added Q to the state. Q belongs to the covariance: the state is F @ state, the covariance is F @ covariance @ F.T + Q."
def predict(state, covariance, F, Q):
    return F @ state + Q, F @ covariance @ F.T

# %% role="mistake" name="state not predicted" says="Your state has not changed. The predicted state is F @ state."
def predict(state, covariance, F, Q):
    return state, F @ covariance @ F.T + Q

# %% role="mistake" name="covariance not predicted" says="Only Q was added to your covariance. F changes it too: F @ covariance @ F.T + Q."
def predict(state, covariance, F, Q):
    return F @ state, covariance + Q

# %% role="mistake" name="added to the state" says="You added F @ state to the state. F @ state is the new state itself: F already contains the old place."
def predict(state, covariance, F, Q):
    return state + F @ state, F @ covariance @ F.T + Q

# %% role="mistake" name="state times F" says="state @ F multiplies with the columns of F. Write F @ state."
def predict(state, covariance, F, Q):
    return state @ F, F @ covariance @ F.T + Q

# %% role="mistake" name="the other order" says="The order is wrong: return the state first, then the covariance."
def predict(state, covariance, F, Q):
    return F @ covariance @ F.T + Q, F @ state

# %% role="mistake" name="rounded" says="The numbers are rounded. Return the exact numbers, and leave round out."
def predict(state, covariance, F, Q):
    return (F @ state).round(2), (F @ covariance @ F.T + Q).round(2)

# %% role="mistake" name="Q in between" says="Q is added too early: you multiplied it with F as well. Write F @ covariance @ F.T + Q."
def predict(state, covariance, F, Q):
    return F @ state, F @ (covariance + Q) @ F.T

# %% [markdown]
# # tracking-update

# %%
def gain_of(covariance, H, R):
    return covariance @ H.T @ np.linalg.inv(H @ covariance @ H.T + R)

def updated(state, covariance, measurement, H, gain):
    return state + gain @ (measurement - H @ state), (np.eye(len(state)) - gain @ H) @ covariance

# %% role="mistake" name="without R" says="R is missing in S: then the measurement counts as exact. S = H @ covariance @ H.T + R."
def update(state, covariance, measurement, H, R):
    return updated(state, covariance, measurement, H, gain_of(covariance, H, 0 * R))

# %% role="mistake" name="minus R" says="You subtracted R. The uncertainties of prediction and measurement add up: S = H @ covariance @ H.T + R."
def update(state, covariance, measurement, H, R):
    return updated(state, covariance, measurement, H, gain_of(covariance, H, -R))

# %% role="mistake" name="without the inverse" says="You multiplied by S. The gain divides by it: multiply by its inverse, np.linalg.inv(S)."
def update(state, covariance, measurement, H, R):
    gain = covariance @ H.T @ (H @ covariance @ H.T + R)
    return updated(state, covariance, measurement, H, gain)

# %% role="mistake" name="gain without S" says="S is missing in the gain: covariance @ H.T @ np.linalg.inv(S)."
def update(state, covariance, measurement, H, R):
    return updated(state, covariance, measurement, H, covariance @ H.T)

# %% role="mistake" name="inverse of R" says="You took the inverse of R alone. The gain needs the inverse of S = H @ covariance @ H.T + R."
def update(state, covariance, measurement, H, R):
    return updated(state, covariance, measurement, H, covariance @ H.T @ np.linalg.inv(R))

# %% role="mistake" name="expected minus measured" says="The state moves away from the measurement: the difference is the measurement minus H @ state."
def update(state, covariance, measurement, H, R):
    gain = gain_of(covariance, H, R)
    return state - gain @ (measurement - H @ state), (np.eye(len(state)) - gain @ H) @ covariance

# %% role="mistake" name="plus the expected measurement" says="You added H @ state to the measurement. The gain belongs to their difference: measurement - H @ state."
def update(state, covariance, measurement, H, R):
    gain = gain_of(covariance, H, R)
    return state + gain @ (measurement + H @ state), (np.eye(len(state)) - gain @ H) @ covariance

# %% role="mistake" name="the whole measurement" says="You added gain @ measurement. The gain belongs to the difference, measurement - H @ state."
def update(state, covariance, measurement, H, R):
    gain = gain_of(covariance, H, R)
    return state + gain @ measurement, (np.eye(len(state)) - gain @ H) @ covariance

# %% role="mistake" name="covariance not corrected" says="Your covariance has not changed. A measurement makes the state more certain: (np.eye(n) - gain @ H) @ covariance."
def update(state, covariance, measurement, H, R):
    return solution(state, covariance, measurement, H, R)[0], covariance

# %% role="mistake" name="state not corrected" says="Your state has not changed. Add gain @ (measurement - H @ state)."
def update(state, covariance, measurement, H, R):
    return state, solution(state, covariance, measurement, H, R)[1]

# %% role="mistake" name="larger covariance" says="Your covariance becomes larger: use np.eye(n) minus gain @ H, not plus."
def update(state, covariance, measurement, H, R):
    gain = gain_of(covariance, H, R)
    return state + gain @ (measurement - H @ state), (np.eye(len(state)) + gain @ H) @ covariance

# %% role="mistake" name="only what the gain takes away" says="You return gain @ H @ covariance. This is what the measurement takes away: subtract it from the covariance."
def update(state, covariance, measurement, H, R):
    gain = gain_of(covariance, H, R)
    return state + gain @ (measurement - H @ state), gain @ H @ covariance

# %% role="mistake" name="covariance on the left" says="The order of the last product is exchanged: (np.eye(n) - gain @ H) stands on the left of the covariance."
def update(state, covariance, measurement, H, R):
    gain = gain_of(covariance, H, R)
    return state + gain @ (measurement - H @ state), covariance @ (np.eye(len(state)) - gain @ H)

# %% role="mistake" name="gain element by element" says="You multiplied the gain with *, value by value. The gain is a matrix: gain @ (measurement - H @ state)."
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    state = state + gain * (measurement - H @ state)
    return state, (np.eye(len(state)) - gain @ H) @ covariance

# %% role="mistake" name="covariance element by element" says="The state is right. The covariance was multiplied with *, value by value: (np.eye(len(state)) - gain @ H) @ covariance."
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    state = state + gain @ (measurement - H @ state)
    return state, (np.eye(len(state)) - gain @ H) * covariance

# %% role="mistake" name="one instead of the identity matrix" says="1 - gain @ H subtracts from 1 everywhere. The 1 of matrices is np.eye(n), which has ones on its diagonal only."
def update(state, covariance, measurement, H, R):
    gain = gain_of(covariance, H, R)
    return state + gain @ (measurement - H @ state), (1 - gain @ H) @ covariance

# %% role="mistake" name="the other order" says="The order is wrong: return the state first, then the covariance."
def update(state, covariance, measurement, H, R):
    return solution(state, covariance, measurement, H, R)[::-1]

# %% role="mistake" name="state used twice" says="You computed the difference with the corrected state and added it once more. Correct the state once."
def update(state, covariance, measurement, H, R):
    gain = gain_of(covariance, H, R)
    state, covariance = updated(state, covariance, measurement, H, gain)
    return state + gain @ (measurement - H @ state), covariance

# %% role="mistake" name="divided value by value" says="1 / S divides value by value. The inverse of a matrix is np.linalg.inv(S); only for one measurement are both the same."
def update(state, covariance, measurement, H, R):
    gain = covariance @ H.T @ (1 / (H @ covariance @ H.T + R))
    return updated(state, covariance, measurement, H, gain)

# %% [markdown]
# # tracking-drive

# %% role="mistake" name="the mean of everything red" says="Your robot follows the mean of all red pixels. Other things are red, too: take one spot, the largest one near the place where the ball was."
def control(observation, memory):
    hue, saturation, _ = cv2.split(cv2.cvtColor(observation["image"], cv2.COLOR_BGR2HSV))
    cols = np.nonzero(((hue < 9) | (hue > 174)) & (saturation > 120))[1]
    if not cols.size:
        return 0.0, 0.4
    linear = 1.2 * (176.25 * 0.22 / (np.ptp(cols) + 1) - 0.6)
    return float(min(max(linear, -0.3), 0.3)), float(2 * (160 - cols.mean()) / 176.25)

# %% role="mistake" name="no distance" says="Your robot follows the ball at one speed, whatever the distance is, and pushes it. Drive in proportion to the distance minus 0.6."
def control(observation, memory):
    return 0.2, solution(observation, memory)[1]

# %% role="mistake" name="it only turns" says="Your robot turns to the ball, but does not follow it. Let it drive in proportion to the distance minus 0.6."
def control(observation, memory):
    return 0.0, solution(observation, memory)[1]

# %% role="mistake" name="the other side" says="Your robot turns away from the ball. If the ball is on the left, its column is smaller than 160, and the angular speed must be positive."
def control(observation, memory):
    linear, angular = solution(observation, memory)
    return linear, -angular

# %% role="mistake" name="it turns without an end" says="Your robot only turns, and never drives. Use the column of the ball."
def control(observation, memory):
    return 0.03, 0.6
