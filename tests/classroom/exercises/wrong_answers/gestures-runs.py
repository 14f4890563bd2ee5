# %% name="not tested" sentence="Some pixels are outside the mask: test the row and the column first." must_say=["outside|bounds"] kind="error"
def count_runs(mask, rows, cols):
    values = [mask[row, col] for row, col in zip(rows, cols)]
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)
