# %% name="center returned" sentence="Return the corner of the moved box, not the center of mass." must_say=["corner|width / 2|middle|half|box"] kind="value"
def mean_shift_step(weights, box):
    col, row, width, height = box
    window = weights[row:row + height, col:col + width]
    total = window.sum()
    if total == 0:
        return box
    mean_col = (window.sum(axis=0) * np.arange(width)).sum() / total
    mean_row = (window.sum(axis=1) * np.arange(height)).sum() / total
    return col + round(mean_col), row + round(mean_row), width, height

# %% name="no test for 0" sentence="If all weights in the box are 0, you divide by 0: return the box." must_say=["0"] kind="error"
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
