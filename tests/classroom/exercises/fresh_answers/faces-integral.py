# %% name="cumsum along the rows twice" origin="fresh" sentence="One of the two running sums goes down the columns: axis=0." must_say=["axis=0|columns"] kind="value"
def integral_image(gray):
    sums = gray.astype(np.int64).cumsum(axis=1).cumsum(axis=1)
    return np.pad(sums, ((1, 0), (1, 0)))

# %% name="insert a row only" origin="fresh" sentence="The column of zeros on the left is missing." must_say=["column", "left|zeros"] kind="shape"
def integral_image(gray):
    sums = gray.astype(np.int64).cumsum(axis=0).cumsum(axis=1)
    return np.vstack([np.zeros((1, sums.shape[1]), np.int64), sums])

# %% name="only zeros" origin="fresh" sentence="Your table is full of zeros: the loop never writes into it." must_say=["zeros"] kind="value"
def integral_image(gray):
    sums = np.zeros((gray.shape[0] + 1, gray.shape[1] + 1), np.int64)
    for row in gray:
        total = 0
        for pixel in row:
            total += int(pixel)
    return sums

# %% name="running total over the whole image" origin="fresh" sentence="The running sum goes on into the next row: it has to begin again in each row, and the row above is added." must_say=["row"] kind="value"
def integral_image(gray):
    sums = np.zeros((gray.shape[0] + 1, gray.shape[1] + 1), np.int64)
    total = 0
    for r in range(gray.shape[0]):
        for c in range(gray.shape[1]):
            total += int(gray[r, c])
            sums[r + 1, c + 1] = total
    return sums

# %% name="wrong size" origin="fresh" sentence="The integral image has one row and one column more than the image." must_say=["\\+ 1|one row|zeros|index"] kind="error"
def integral_image(gray):
    sums = np.zeros(gray.shape, np.int64)
    for r in range(gray.shape[0]):
        for c in range(gray.shape[1]):
            sums[r + 1, c + 1] = gray[: r + 1, : c + 1].sum()
    return sums
