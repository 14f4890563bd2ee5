# %% name="numbers in uint8" sentence="Return whole numbers, not the mask." must_say=["number"] kind="value"
def label(mask):
    count = 0
    labels = mask.copy()
    for start in np.argwhere(mask):
        count += 1
        labels[tuple(start)] = count
    return labels
# %% name="calls itself for each pixel" sentence="before it calls itself again; if it does, use a loop" must_say=["loop"] kind="error"
def label(mask):
    labels = np.zeros(mask.shape, int)
    def fill(row, col, number):
        inside = 0 <= row < mask.shape[0] and 0 <= col < mask.shape[1]
        if inside and mask[row, col] and not labels[row, col]:
            labels[row, col] = number
            for i in (-1, 0, 1):
                for j in (-1, 0, 1):
                    fill(row + i, col + j, number)
    for row, col in np.argwhere(mask):
        fill(row, col, labels.max() + 1)
    return labels
