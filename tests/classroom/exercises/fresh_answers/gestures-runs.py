# %% name="runs that end" origin="fresh" sentence="Begin and end: the last run over the end is missing." must_say=["over the end|last|first"] kind="value"
def count_runs(mask, rows, cols):
    count, in_run = 0, False
    for row, col in zip(rows, cols):
        inside = 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1]
        if inside and mask[row, col] == 1:
            in_run = True
        elif in_run:
            count += 1
            in_run = False
    if in_run:
        count += 1
    return count

# %% name="whole mask" origin="fresh" sentence="Look at the pixels of the way only." must_say=["way"] kind="value"
def count_runs(mask, rows, cols):
    count = 0
    for r in range(mask.shape[0]):
        for c in range(mask.shape[1]):
            if mask[r, c] == 1 and (c == 0 or mask[r, c - 1] == 0):
                count += 1
    return count

# %% name="one run for all" origin="fresh" sentence="Set back the mark when a run ends." must_say=["run"] kind="value"
def count_runs(mask, rows, cols):
    count, in_run = 0, False
    for row, col in zip(rows, cols):
        inside = 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1]
        if inside and mask[row, col] == 1 and not in_run:
            count += 1
            in_run = True
    return count

# %% name="outside is 1" origin="fresh" sentence="Outside counts as 0." must_say=["outside", "0"] kind="value"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        inside = 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1]
        values.append(mask[row, col] if inside else 1)
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)

# %% name="only rows tested" origin="fresh" sentence="Test the columns as well." must_say=["column"] kind="error"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        inside = 0 <= row < mask.shape[0]
        values.append(mask[row, col] if inside else 0)
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)
