# %% name="sets" sentence="The order of the letters counts, not only which letters there are." must_say=["order"] kind="value"
def edit_distance(a, b):
    return len(set(a) - set(b)) + len(set(b) - set(a))

# %% name="table too small" sentence="The table has one row more than a has characters, and one column more than b." must_say=["last index|index|\\+ 1|one row|range"] kind="error"
def edit_distance(a, b):
    t = np.zeros((len(a), len(b)), int)
    for i in range(1, len(a) + 1):
        for j in range(1, len(b) + 1):
            t[i, j] = min(t[i - 1, j] + 1, t[i, j - 1] + 1, t[i - 1, j - 1] + (a[i - 1] != b[j - 1]))
    return int(t[-1, -1])
