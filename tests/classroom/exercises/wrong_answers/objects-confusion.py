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
