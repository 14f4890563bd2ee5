# %% name="center returned" origin="fresh" sentence="Return the corner of the moved box, not the center of mass." must_say=["corner|width / 2|middle|half|box"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    return col + round(mean_col), row + round(mean_row), width, height

# %% name="image borders exchanged" origin="fresh" sentence="shape[0] is the number of rows: it limits row." must_say=["shape|inside|right"] kind="value"
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
    col = min(max(col, 0), weights.shape[0] - width)
    row = min(max(row, 0), weights.shape[1] - height)
    return col, row, width, height

# %% name="rounded mean" origin="fresh" sentence="Round the shift, not the mean and the half apart." must_say=["round"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + round(mean_col) - round(width / 2)
    row = row + round(mean_row) - round(height / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="only the column" origin="fresh" sentence="The box moves by rows too." must_say=["row"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + round(mean_col - width / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="empty box to the corner" origin="fresh" sentence="Without weights, the box stays where it is." must_say=["stay|0|as it is"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return 0, 0, width, height
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    col = col + round(mean_col - width / 2)
    row = row + round(mean_row - height / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height

# %% name="divided by the pixels" origin="fresh" sentence="Divide by the sum of the weights, not by the number of pixels." must_say=["sum|total|weight"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / (width * height)
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / (width * height)
    col = col + round(mean_col - width / 2)
    row = row + round(mean_row - height / 2)
    col = min(max(col, 0), weights.shape[1] - width)
    row = min(max(row, 0), weights.shape[0] - height)
    return col, row, width, height
