# %% name="transposed" origin="new" sentence="The row is the true class." must_say=["row|exchanged"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for t, p in zip(truth, predicted):
        matrix[p, t] += 1
    return matrix

# %% name="fancy index" origin="new" sentence="matrix[truth, predicted] += 1 counts each pair once: use a loop." must_say=["loop|once"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    matrix[truth, predicted] += 1
    return matrix

# %% name="right ones only" origin="new" sentence="Count the errors too." must_say=["errors"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for t, p in zip(truth, predicted):
        if t == p:
            matrix[t, p] += 1
    return matrix

# %% name="errors only" origin="new" sentence="Count the right ones too." must_say=["right"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for t, p in zip(truth, predicted):
        if t != p:
            matrix[t, p] += 1
    return matrix

# %% name="percent" origin="new" sentence="Return the counts, not shares." must_say=["counts"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count))
    for t, p in zip(truth, predicted):
        matrix[t, p] += 1
    return matrix / matrix.sum()

# %% name="row shares" origin="new" sentence="Return the counts, not shares." must_say=["counts|0"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count))
    for t, p in zip(truth, predicted):
        matrix[t, p] += 1
    return matrix / np.maximum(matrix.sum(axis=1)[:, None], 1)

# %% name="size of the classes that occur" origin="new" sentence="The size is count, also if a class does not occur." must_say=["count"] kind="shape"
def confusion(truth, predicted, count):
    n = len(np.unique(truth))
    matrix = np.zeros((n, n), int)
    for t, p in zip(truth, predicted):
        matrix[t, p] += 1
    return matrix

# %% name="assigned" origin="new" sentence="Use += 1: = 1 overwrites." must_say=["once|\\+="] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for t, p in zip(truth, predicted):
        matrix[t, p] = 1
    return matrix

# %% name="return in the loop" origin="new" sentence="return belongs after the loop." must_say=["return|loop"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for t, p in zip(truth, predicted):
        matrix[t, p] += 1
        return matrix

# %% name="accuracy" origin="new" sentence="Return the whole matrix." must_say=["matrix"] kind="type"
def confusion(truth, predicted, count):
    return (truth == predicted).mean()

# %% name="diagonal" origin="new" sentence="Return the whole matrix, not its diagonal." must_say=["matrix"] kind="shape"
def confusion(truth, predicted, count):
    return np.array([((truth == c) & (predicted == c)).sum() for c in range(count)])

# %% name="off by one" origin="new" sentence="The last pair is missing: go through all pairs, range(len(truth))." must_say=["last"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for i in range(len(truth) - 1):
        matrix[truth[i], predicted[i]] += 1
    return matrix

# %% name="ones" origin="new" sentence="Begin with zeros." must_say=["zeros|one too high"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.ones((count, count), int)
    for t, p in zip(truth, predicted):
        matrix[t, p] += 1
    return matrix

# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for t, p in zip(truth, predicted):
        matrix[t, p] += 1
