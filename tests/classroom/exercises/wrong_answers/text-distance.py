# %% name="place by place" origin="new" sentence="One inserted letter moves all others: fill the table with the three steps." must_say=["place by place|three|table"] kind="value"
def edit_distance(a, b):
    wrong = 0
    for x, y in zip(a, b):
        if x != y:
            wrong += 1
    return wrong + abs(len(a) - len(b))

# %% name="only the common length" origin="new" sentence="The rest of the longer text counts too: fill the table." must_say=["longer|table"] kind="value"
def edit_distance(a, b):
    wrong = 0
    for x, y in zip(a, b):
        wrong += x != y
    return int(wrong)

# %% name="no replace" origin="new" sentence="Replacing a character is one step: the number at the upper left plus 1." must_say=["replac"] kind="value"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            if a[i - 1] == b[j - 1]:
                t[i, j] = t[i - 1, j - 1]
            else:
                t[i, j] = min(t[i - 1, j], t[i, j - 1]) + 1
    return int(t[-1, -1])

# %% name="first row zeros" origin="new" sentence="The first row counts up: 0, 1, 2." must_say=["first row"] kind="value"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    return int(t[-1, -1])

# %% name="first column zeros" origin="new" sentence="The first column counts up: 0, 1, 2." must_say=["first column"] kind="value"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    return int(t[-1, -1])

# %% name="no first row and column" origin="new" sentence="The first row and the first column count up." must_say=["first row|first column"] kind="value"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    return int(t[-1, -1])

# %% name="equal and not equal exchanged" origin="new" sentence="Equal characters cost 0, others 1: use !=." must_say=["!=|equal"] kind="value"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] == b[j - 1]))
    return int(t[-1, -1])

# %% name="table too small" origin="new" sentence="The table has one row more than a has characters, and one column more than b." must_say=["last index|index|\\+ 1|one row|range"] kind="error"
def edit_distance(a, b):
    t = np.zeros((len(a), len(b)), int)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    return int(t[-1, -1])

# %% name="sizes of the example" origin="new" sentence="7 and 8 are the sizes of the example: use len(a) + 1 and len(b) + 1." must_say=["len\\(|length|size|shape|fit"] kind="error"
def edit_distance(a, b):
    t = np.zeros((7, 8), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, 7):
        for j in range(1, 8):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    return int(t[6, 7])

# %% name="loops end too early" origin="new" sentence="range(1, len(a)) ends before len(a): the last character is not compared." must_say=["last char|range|too early"] kind="value"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a)):
        for j in range(1, len(b)):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    return int(t[-1, -1])

# %% name="the table" origin="new" sentence="Return the last number of the table, not the table." must_say=["last number|one number|whole number|integer|int"] kind="type"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    return t

# %% name="capitals" origin="new" sentence="k and K are different characters: leave lower out." must_say=["capital|lower|different characters"] kind="value"
def edit_distance(a, b):
    a, b = a.lower(), b.lower()
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    return int(t[-1, -1])

# %% name="sets" origin="new" sentence="The order of the letters counts, not only which letters there are." must_say=["order"] kind="value"
def edit_distance(a, b):
    return len(set(a) - set(b)) + len(set(b) - set(a))

# %% name="always one more" origin="new" sentence="Add 1 at the upper left only if the characters differ." must_say=["differ"] kind="value"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j], t[i, j - 1], t[i - 1, j - 1]) + 1
    return int(t[-1, -1])
