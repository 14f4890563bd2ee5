# %% name="mean of columns" origin="fresh" sentence="axis=0 computes along the rows, one number for each column; you need axis=1." must_say=["axis|each column|every column|columns"] kind="shape"
def row_means(gray):
    return np.mean(gray, 0)

# %% name="whole division" origin="fresh" sentence="// drops the fraction: use / or mean(axis=1)." must_say=["//|fraction|round|whole|decimal|truncat"] must_not_say=["axis=0|wrap"] kind="value"
def row_means(gray):
    width = gray.shape[1]
    return (gray.sum(axis=1) // width).astype(np.float64)

# %% name="divides by the height" origin="fresh" sentence="The mean of a row divides by the number of its pixels, the width; you divide by the height." must_say=["width|shape\\[1\\]|number of columns|height|columns"] must_not_say=["wrap|axis=0"] kind="value"
def row_means(gray):
    height, width = gray.shape
    return gray.sum(axis=1) / height

# %% name="adding in uint8" origin="fresh" sentence="The sum stays uint8 and wraps around at 256; widen first, or use mean(axis=1)." must_say=["wrap|uint8|256|overflow|widen"] must_not_say=["axis=0"] kind="value"
def row_means(gray):
    height, width = gray.shape
    total = gray[:, 0]
    for col in range(1, width):
        total = total + gray[:, col]
    return total / width
