# %% name="shape as two arguments" sentence="The shape is one argument: np.zeros((count, count))." must_say=["\\(\\("] kind="error"
def confusion(truth, predicted, count):
    matrix = np.zeros(count, count)
    for i, j in zip(truth, predicted):
        matrix[i, j] += 1
    return matrix

# %% name="sums of the rows, no keepdims" sentence="Return the counts, do not divide by the sums of the rows." must_say=["counts", "sums? of the row|row"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count))
    for row, col in zip(truth, predicted):
        matrix[row, col] += 1
    return matrix / matrix.sum(axis=1)

# %% name="accuracy" sentence="Return the whole matrix." must_say=["matrix"] kind="type"
def confusion(truth, predicted, count):
    return (truth == predicted).mean()

# %% name="diagonal" sentence="Return the whole matrix, not its diagonal." must_say=["matrix"] kind="shape"
def confusion(truth, predicted, count):
    return np.array([((truth == c) & (predicted == c)).sum() for c in range(count)])

# %% name="no return" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for t, p in zip(truth, predicted):
        matrix[t, p] += 1
