# %% name="numbers in uint8" sentence="Return whole numbers, not the mask." must_say=["number"] kind="value"
def label(mask):
    count = 0
    labels = mask.copy()
    for start in np.argwhere(mask):
        count += 1
        labels[tuple(start)] = count
    return labels

# %% name="count before the test" sentence="Add 1 to the count only if the pixel has no number yet." must_say=["no number|count"] kind="value"
def label(mask):
    labels = np.zeros(mask.shape, int)
    count = 0
    for start in np.argwhere(mask):
        count += 1
        stack = [tuple(start)]
        while stack:
            row, col = stack.pop()
            if 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1] and mask[row, col] and labels[row, col] == 0:
                labels[row, col] = count
                stack += [(row + i, col + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    return labels
