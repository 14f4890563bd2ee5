# %% name="not tested" sentence="Some pixels are outside the mask: test the row and the column first." must_say=["outside|bounds"] kind="error"
def count_runs(mask, rows, cols):
    values = [mask[row, col] for row, col in zip(rows, cols)]
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)

# %% name="clipped" sentence="Outside pixels count as 0; do not move them to the border." must_say=["outside", "0"] kind="value"
def count_runs(mask, rows, cols):
    rows = np.clip(rows, 0, mask.shape[0] - 1)
    cols = np.clip(cols, 0, mask.shape[1] - 1)
    values = mask[rows, cols]
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)

# %% name="only rows tested" sentence="Test the columns as well." must_say=["column"] kind="error"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        inside = 0 <= row < mask.shape[0]
        values.append(mask[row, col] if inside else 0)
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)

# %% name="pixels" sentence="Count where runs begin, not all ones." must_say=["begin"] kind="value"
def count_runs(mask, rows, cols):
    count = 0
    for row, col in zip(rows, cols):
        if 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1] and mask[row, col] == 1:
            count += 1
    return count

# %% name="left out" sentence="A pixel outside counts as 0; if you leave it out, two runs become one." must_say=["left out|leave", "0"] kind="value"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        if row < 0 or row >= mask.shape[0] or col < 0 or col >= mask.shape[1]:
            continue
        values.append(mask[row, col])
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)
