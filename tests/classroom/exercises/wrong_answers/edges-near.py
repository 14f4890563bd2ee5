# %% name="plus instead of or, in int" sentence="+ counts the True pixels, and a count is no bool: combine with |, or compare with > 0." must_say=["bool"] kind="dtype"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros(mask.shape)
    for row in range(2 * tolerance + 1):
        for col in range(2 * tolerance + 1):
            result = result + padded[row : row + height, col : col + width]
    return result

# %% name="the padded result" sentence="Your result is larger than the mask by the padding: cut the padding off, so that the result has the shape of the mask." must_say=["larger|shape|pad|size", "cut|pad|same shape|shape of"] kind="shape"
def near(mask, tolerance):
    p = np.pad(mask, tolerance)
    result = np.zeros_like(p)
    for y, x in np.argwhere(p):
        result[y - tolerance : y + tolerance + 1, x - tolerance : x + tolerance + 1] = True
    return result
