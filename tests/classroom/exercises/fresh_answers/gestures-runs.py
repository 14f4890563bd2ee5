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
# %% name="outside not handled" origin="fresh" sentence="Pixels outside the mask raise an error or, with -1, read the other side; they must count as 0." must_say=["outside|out of|beyond"] kind="error"
def count_runs(mask, rows, cols):
    values = mask[rows, cols]
    count = 0
    for i in range(len(values)):
        if values[i] == 1 and values[i - 1] == 0:
            count += 1
    return count
# %% name="over the end twice" origin="fresh" sentence="A run over the end is counted twice: the pixel before the first one is the last one." must_say=["end|last|closed|first"] kind="value"
def count_runs(mask, rows, cols):
    height, width = mask.shape
    count = 0
    before = 0
    for r, c in zip(rows, cols):
        value = 0
        if 0 <= r < height and 0 <= c < width:
            value = mask[r, c]
        if value == 1 and before == 0:
            count += 1
        before = value
    return count
# %% name="counts the ones" origin="fresh" sentence="You count all pixels that are 1, not the runs." must_say=["run", "begin|pixel|start|ones"] kind="value"
def count_runs(mask, rows, cols):
    height, width = mask.shape
    count = 0
    for r, c in zip(rows, cols):
        if 0 <= r < height and 0 <= c < width and mask[r, c] == 1:
            count += 1
    return count
# %% name="begins at 1" origin="fresh" sentence="The loop begins at 1, so a run that begins at the position 0 is not counted." must_say=["0|first|begin"] kind="value"
def count_runs(mask, rows, cols):
    height, width = mask.shape
    values = []
    for r, c in zip(rows, cols):
        inside = 0 <= r < height and 0 <= c < width
        values.append(int(mask[r, c]) if inside else 0)
    count = 0
    for i in range(1, len(values)):
        if values[i] == 1 and values[i - 1] == 0:
            count += 1
    return count
# %% name="only negative ones are outside" origin="fresh" sentence="Rows and columns that are too large are outside too." must_say=["outside|out of|large|height|shape|size"] kind="error"
def count_runs(mask, rows, cols):
    values = []
    for r, c in zip(rows, cols):
        if r < 0 or c < 0:
            values.append(0)
        else:
            values.append(mask[r, c])
    count = 0
    for i in range(len(values)):
        if values[i] == 1 and values[i - 1] == 0:
            count += 1
    return count
# %% name="height and width exchanged" origin="fresh" sentence="shape is (height, width), rows first; the rows are compared with the width." must_say=["row|column|height|width|shape"] kind="value"
def count_runs(mask, rows, cols):
    width, height = mask.shape
    values = []
    for r, c in zip(rows, cols):
        if 0 <= r < height and 0 <= c < width:
            values.append(mask[r, c])
        else:
            values.append(0)
    count = 0
    for i in range(len(values)):
        if values[i] == 1 and values[i - 1] == 0:
            count += 1
    return count
# %% name="outside left out" origin="fresh" sentence="The pixels outside are left out; they must count as 0, else two runs become one." must_say=["outside", "0|zero"] kind="value"
def count_runs(mask, rows, cols):
    height, width = mask.shape
    values = []
    for r, c in zip(rows, cols):
        if 0 <= r < height and 0 <= c < width:
            values.append(mask[r, c])
    count = 0
    for i in range(len(values)):
        if values[i] == 1 and values[i - 1] == 0:
            count += 1
    return count
# %% name="return in the loop" origin="fresh" sentence="The return is inside the loop: it ends after the first pixel." must_say=["return", "loop"] kind="value"
def count_runs(mask, rows, cols):
    height, width = mask.shape
    values = []
    for r, c in zip(rows, cols):
        if 0 <= r < height and 0 <= c < width:
            values.append(mask[r, c])
        else:
            values.append(0)
    count = 0
    for i in range(len(values)):
        if values[i] == 1 and values[i - 1] == 0:
            count += 1
        return count
# %% name="begins and ends" origin="fresh" sentence="You count each change, so each run counts twice, at its begin and its end." must_say=["twice|begin|end|change|both|double"] kind="value"
def count_runs(mask, rows, cols):
    height, width = mask.shape
    values = []
    for r, c in zip(rows, cols):
        if 0 <= r < height and 0 <= c < width:
            values.append(mask[r, c])
        else:
            values.append(0)
    count = 0
    for i in range(len(values)):
        if values[i] != values[i - 1]:
            count += 1
    return count
# %% name="clipped to the border" origin="fresh" sentence="np.clip moves pixels outside to the border, where the mask can be 1; they must count as 0." must_say=["outside|clip|border"] kind="value"
def count_runs(mask, rows, cols):
    height, width = mask.shape
    rows = np.clip(rows, 0, height - 1)
    cols = np.clip(cols, 0, width - 1)
    values = mask[rows, cols]
    count = 0
    for i in range(len(values)):
        if values[i] == 1 and values[i - 1] == 0:
            count += 1
    return count
