# %% name="numbers in uint8" sentence="Return whole numbers, not the mask." must_say=["number"] kind="value"
def label(mask):
    count = 0
    labels = mask.copy()
    for start in np.argwhere(mask):
        count += 1
        labels[tuple(start)] = count
    return labels
