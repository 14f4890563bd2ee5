# %% name="pixels" origin="new" sentence="Count where runs begin, not all ones." must_say=["begin"] kind="value"
def count_runs(mask, rows, cols):
    count = 0
    for row, col in zip(rows, cols):
        if 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1] and mask[row, col] == 1:
            count += 1
    return count

# %% name="open way" origin="new" sentence="A run that goes on over the end counts once: compare the first pixel with the last one." must_say=["over the end|last one"] kind="value"
def count_runs(mask, rows, cols):
    count, before = 0, 0
    for row, col in zip(rows, cols):
        inside = 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1]
        value = mask[row, col] if inside else 0
        if value == 1 and before == 0:
            count += 1
        before = value
    return count

# %% name="from 1" origin="new" sentence="A run can begin at the first pixel: compare it with the last one." must_say=["first"] kind="value"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        inside = 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1]
        values.append(mask[row, col] if inside else 0)
    count = 0
    for i in range(1, len(values)):
        if values[i] == 1 and values[i - 1] == 0:
            count += 1
    return count

# %% name="changes" origin="new" sentence="Count only the beginnings, not the ends as well." must_say=["begin"] kind="value"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        inside = 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1]
        values.append(mask[row, col] if inside else 0)
    count = 0
    for i in range(len(values)):
        if values[i] != values[i - 1]:
            count += 1
    return count

# %% name="fingers" origin="new" sentence="Return all runs; the arm is taken off later." must_say=["arm"] kind="value"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        inside = 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1]
        values.append(mask[row, col] if inside else 0)
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0) - 1

# %% name="not tested" origin="new" sentence="Some pixels are outside the mask: test the row and the column first." must_say=["outside|bounds"] kind="error"
def count_runs(mask, rows, cols):
    values = [mask[row, col] for row, col in zip(rows, cols)]
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)

# %% name="only the large ones tested" origin="new" sentence="Negative rows and columns are outside too." must_say=["negative"] kind="value"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        if row >= mask.shape[0] or col >= mask.shape[1]:
            values.append(0)
        else:
            values.append(mask[row, col])
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)

# %% name="IndexError caught" origin="new" sentence="A negative index raises no error: test for it." must_say=["negative"] kind="value"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        try:
            values.append(mask[row, col])
        except IndexError:
            values.append(0)
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)

# %% name="clipped" origin="new" sentence="Outside pixels count as 0; do not move them to the border." must_say=["outside", "0"] kind="value"
def count_runs(mask, rows, cols):
    rows = np.clip(rows, 0, mask.shape[0] - 1)
    cols = np.clip(cols, 0, mask.shape[1] - 1)
    values = mask[rows, cols]
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)

# %% name="left out" origin="new" sentence="A pixel outside counts as 0; if you leave it out, two runs become one." must_say=["left out|leave", "0"] kind="value"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        if row < 0 or row >= mask.shape[0] or col < 0 or col >= mask.shape[1]:
            continue
        values.append(mask[row, col])
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)

# %% name="columns first" origin="new" sentence="Rows and columns are exchanged: mask[row, col]." must_say=["exchanged|row, col"] kind="value"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        inside = 0 <= row < mask.shape[1] and 0 <= col < mask.shape[0]
        values.append(mask[col, row] if inside else 0)
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)

# %% name="one too far" origin="new" sentence="Rows go from 0 to the height minus 1: a row equal to the height is outside." must_say=["outside|bounds|height"] kind="error"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        inside = 0 <= row <= mask.shape[0] and 0 <= col <= mask.shape[1]
        values.append(mask[row, col] if inside else 0)
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)

# %% name="return in the loop" origin="new" sentence="Return after the loop." must_say=["loop|return"] kind="value"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        inside = 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1]
        values.append(mask[row, col] if inside else 0)
    count = 0
    for i in range(len(values)):
        if values[i] == 1 and values[i - 1] == 0:
            count += 1
            return count

# %% name="diff of uint8" origin="new" sentence="The difference of uint8 wraps round: 0 - 1 is 255, and the way is closed." must_say=["uint8|over the end|last one|first"] kind="value"
def count_runs(mask, rows, cols):
    values = []
    for row, col in zip(rows, cols):
        inside = 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1]
        values.append(mask[row, col] if inside else 0)
    return int((np.diff(np.array(values, np.uint8)) == 1).sum())

# %% name="shape unpacked wrongly" origin="new" sentence="mask.shape is (height, width): rows first." must_say=["row|height|outside|exchanged|bounds"] kind="error"
def count_runs(mask, rows, cols):
    width, height = mask.shape
    values = []
    for row, col in zip(rows, cols):
        inside = 0 <= row < height and 0 <= col < width
        values.append(mask[row, col] if inside else 0)
    return sum(1 for i in range(len(values)) if values[i] == 1 and values[i - 1] == 0)
