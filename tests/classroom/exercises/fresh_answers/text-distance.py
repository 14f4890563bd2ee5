# %% name="max in place of min" origin="fresh" sentence="Take the smallest of the three numbers: min." must_say=["smallest|min"] kind="value"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = max(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    return int(t[-1, -1])

# %% name="without deleting" origin="fresh" sentence="The number above, plus 1, is missing." must_say=["above|delet"] kind="value"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    return int(t[-1, -1])

# %% name="index without minus one" origin="fresh" sentence="Row i belongs to a[i - 1]: a[i] is the character after." must_say=["i - 1|last index|index"] kind="error"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i] != b[j]))
    return int(t[-1, -1])

# %% name="plus one at the upper left always" origin="fresh" sentence="Equal characters cost nothing." must_say=["equal|differ"] kind="value"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + 1)
    return int(t[-1, -1])

# %% name="no return" origin="fresh" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def edit_distance(a, b):
    t = np.zeros((len(a) + 1, len(b) + 1), int)
    t[:, 0] = range(len(a) + 1)
    t[0, :] = range(len(b) + 1)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    print(t[-1, -1])
