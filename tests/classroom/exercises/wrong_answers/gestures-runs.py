# %% name="not tested" sentence="Some pixels are outside the mask: test the row and the column first." must_say=["outside|bounds"] kind="error"
def count_runs(mask, rows, cols):
    values = [mask[row, col] for row, col in zip(rows, cols)]
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)

# %% name="left out" sentence="A pixel outside counts as 0; if you leave it out, two runs become one." must_say=["left out|leave", "0"] kind="value"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        if row < 0 or row >= mask.shape[0] or col < 0 or col >= mask.shape[1]:
            continue
        values.append(mask[row, col])
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)
