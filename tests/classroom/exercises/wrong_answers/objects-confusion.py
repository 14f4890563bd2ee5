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

# %% name="sums of the rows, no keepdims" origin="walk" sentence="Return the counts, do not divide by the sums of the rows." must_say=["counts", "sums? of the row|row"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count))
    for row, col in zip(truth, predicted):
        matrix[row, col] += 1
    return matrix / matrix.sum(axis=1)

# %% name="one row shared" origin="walk" sentence="All rows are one list: make a new one for each row." must_say=["rows?", "one list|same list"] kind="value"
def confusion(truth, predicted, count):
    table = [[0] * count] * count
    for t, p in zip(truth, predicted):
        table[t][p] += 1
    return np.array(table)

# %% name="range(count)" origin="walk" sentence="Go through all pairs: range(len(truth))." must_say=["all pairs|len\\(truth\\)"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for i in range(count):
        matrix[truth[i], predicted[i]] += 1
    return matrix

# %% name="errors twice" origin="walk" sentence="Add an error once, at row truth, column predicted." must_say=["both places|once"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for t, p in zip(truth, predicted):
        matrix[t, p] += 1
        if t != p:
            matrix[p, t] += 1
    return matrix

# %% name="two loops" origin="walk" sentence="Go through both together: zip(truth, predicted)." must_say=["zip|together"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for row in truth:
        for col in predicted:
            matrix[row, col] += 1
    return matrix

# %% name="no zip" origin="walk" sentence="Go through both together with zip." must_say=["zip"] must_not_say=["dictionary"] kind="error"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for i, j in truth, predicted:
        matrix[i, j] += 1
    return matrix

# %% name="shape as two arguments" origin="walk" sentence="The shape is one argument: np.zeros((count, count))." must_say=["\\(\\("] kind="error"
def confusion(truth, predicted, count):
    matrix = np.zeros(count, count)
    for i, j in zip(truth, predicted):
        matrix[i, j] += 1
    return matrix
