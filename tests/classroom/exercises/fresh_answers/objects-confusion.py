# %% name="column shares" origin="fresh" sentence="Return counts, not shares." must_say=["counts"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count))
    for t, p in zip(truth, predicted):
        matrix[t, p] += 1
    return matrix / np.maximum(matrix.sum(axis=0), 1)

# %% name="both places" origin="fresh" sentence="Add 1 only at row truth, column predicted." must_say=["row|only"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for t, p in zip(truth, predicted):
        matrix[t, p] += 1
        matrix[p, t] += 1
    return matrix

# %% name="classes from 1" origin="fresh" sentence="The classes begin with 0: leave out - 1." must_say=["- 1|class 0|begin"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for t, p in zip(truth, predicted):
        matrix[t - 1, p - 1] += 1
    return matrix

# %% name="truth twice" origin="fresh" sentence="The column is the predicted class." must_say=["column|predicted"] kind="value"
def confusion(truth, predicted, count):
    matrix = np.zeros((count, count), int)
    for t, p in zip(truth, predicted):
        matrix[t, t] += 1
    return matrix

# %% name="one row more" origin="fresh" sentence="count rows and columns are enough." must_say=["too large|count"] kind="shape"
def confusion(truth, predicted, count):
    matrix = np.zeros((count + 1, count + 1), int)
    for t, p in zip(truth, predicted):
        matrix[t, p] += 1
    return matrix
