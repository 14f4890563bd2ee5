# %% name="knight's neighbours left out" origin="fresh" sentence="The two neighbours at the lower corners are missing: eight neighbours." must_say=["eight|corner|neighbours"] kind="value"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    for start in np.argwhere(mask):
        if labels[tuple(start)] == 0:
            count += 1
            stack = [tuple(start)]
            while stack:
                row, col = stack.pop()
                if 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1] and mask[row, col] and labels[row, col] == 0:
                    labels[row, col] = count
                    stack += [(row + 1, col), (row - 1, col), (row, col + 1), (row, col - 1), (row - 1, col - 1), (row - 1, col + 1)]
    return labels

# %% name="runs of a row" origin="fresh" sentence="A component continues in the rows above and below." must_say=["above|below|neighbours"] kind="value"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    for row in range(mask.shape[0]):
        for col in range(mask.shape[1]):
            if mask[row, col]:
                if col == 0 or not mask[row, col - 1]:
                    count += 1
                labels[row, col] = count
    return labels

# %% name="numbers in uint8" origin="fresh" sentence="Return whole numbers, not the mask." must_say=["number"] kind="value"
def label(mask):
    count = 0
    labels = mask.copy()
    for start in np.argwhere(mask):
        count += 1
        labels[tuple(start)] = count
    return labels

# %% name="rows and columns exchanged" origin="fresh" sentence="Rows and columns are exchanged in the test for inside." must_say=["inside|row|border|index"] kind="value"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    for start in np.argwhere(mask):
        if labels[tuple(start)] == 0:
            count += 1
            stack = [tuple(start)]
            while stack:
                row, col = stack.pop()
                if 0 <= row < mask.shape[0] and 0 <= col < mask.shape[0] and mask[row, col] and labels[row, col] == 0:
                    labels[row, col] = count
                    stack += [(row + i, col + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    return labels

# %% name="neighbours never visited" origin="fresh" sentence="Put the neighbours on the stack: each pixel has a number of its own." must_say=["neighbours|share|stack"] kind="value"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    for start in np.argwhere(mask):
        if labels[tuple(start)] == 0:
            count += 1
            labels[tuple(start)] = count
    return labels
