# %% name="corner to the center" origin="new" sentence="The middle of the box belongs at the center of mass: subtract width / 2." must_say=["middle|width / 2|half"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + round(mean_col)
    row = row + round(mean_row)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="without the old place" origin="new" sentence="The mean is counted inside the box: add col and row." must_say=["add|inside|corner"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = round(mean_col - width / 2)
    row = round(mean_row - height / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="half of width minus 1" origin="new" sentence="The task subtracts width / 2, as OpenCV does." must_say=["width / 2"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + round(mean_col - (width - 1) / 2)
    row = row + round(mean_row - (height - 1) / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="int" origin="new" sentence="int cuts the digits off: use round." must_say=["round"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + int(mean_col - width / 2)
    row = row + int(mean_row - height / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="whole division" origin="new" sentence="width // 2 and // round down: use / and round." must_say=["round"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + int((mean_col - width / 2) // 1)
    row = row + int((mean_row - height / 2) // 1)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="not rounded" origin="new" sentence="A box has whole columns: round the shift." must_say=["round|whole"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + mean_col - width / 2
    row = row + mean_row - height / 2
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="away" origin="new" sentence="The box moves away from the weights: the shift is mean minus half, not the other way." must_say=["away|direction|minus|sign|other way"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + round(width / 2 - mean_col)
    row = row + round(height / 2 - mean_row)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="leaves the image" origin="new" sentence="Keep the box inside the image." must_say=["inside|leaves"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + round(mean_col - width / 2)
    row = row + round(mean_row - height / 2)
    return col, row, width, height

# %% name="left and top only" origin="new" sentence="The right and the lower border count too." must_say=["right|bottom|inside"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + round(mean_col - width / 2)
    row = row + round(mean_row - height / 2)
    col, row = max(col, 0), max(row, 0)
    return col, row, width, height

# %% name="no test for 0" origin="new" sentence="If all weights in the box are 0, you divide by 0: return the box." must_say=["0"] kind="error"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + round(mean_col - width / 2)
    row = row + round(mean_row - height / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="axes exchanged" origin="new" sentence="axis=0 gives one sum per column." must_say=["axis|column|row|shape|exchang"] kind="error"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=1) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=0) * np.arange(height)).sum() / total
    col = col + round(mean_col - width / 2)
    row = row + round(mean_row - height / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="unweighted" origin="new" sentence="Multiply by the weights: each pixel counts as much as its weight." must_say=["weight"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    rows, cols = np.nonzero(window)
    if len(rows) == 0:
        return box
    mean_col, mean_row = cols.mean(), rows.mean()
    col = col + round(mean_col - width / 2)
    row = row + round(mean_row - height / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="brightest pixel" origin="new" sentence="Use the center of mass, not the brightest pixel." must_say=["center of mass|all|brightest|largest"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    if not window.any():
        return box
    mean_row, mean_col = np.unravel_index(window.argmax(), window.shape)
    col = col + round(mean_col - width / 2)
    row = row + round(mean_row - height / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="only col and row" origin="new" sentence="Return the whole box: col, row, width, height." must_say=["four|width|box"] kind="shape"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + round(mean_col - width / 2)
    row = row + round(mean_row - height / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row

# %% name="row first" origin="new" sentence="The order is col, row, width, height." must_say=["order|col"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + round(mean_col - width / 2)
    row = row + round(mean_row - height / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return row, col, width, height

# %% name="the window exchanged" origin="new" sentence="Rows come first in an index: weights[row:row + height, col:col + width]." must_say=["row"] kind="error"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[col:col + width, row:row + height]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + round(mean_col - width / 2)
    row = row + round(mean_row - height / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="rows and columns of the window exchanged" origin="new" sentence="An array is indexed rows first: weights[row : row + height, col : col + width]." must_say=["rows", "exchanged|rows first"] kind="error" must_not_say=["padding"]
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[col : col + width, row : row + height]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + round(mean_col - width / 2)
    row = row + round(mean_row - height / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="the axes of the sums exchanged" origin="new" sentence="The axes are exchanged: axis=0 gives one number for each column, and belongs to mean_col." must_say=["column", "axis=0", "exchanged"] kind="error" must_not_say=["padding"]
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row : row + height, col : col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=1) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=0) * np.arange(height)).sum() / total
    col = col + round(mean_col - width / 2)
    row = row + round(mean_row - height / 2)
    col = max(0, min(col, weights.shape[1] - width))
    row = max(0, min(row, weights.shape[0] - height))
    return col, row, width, height
