# %% name="range of tolerance" sentence="range(tolerance) gives only tolerance shifts: a square around the pixel needs 2 * tolerance + 1." must_say=["2 \\* tolerance \\+ 1|2 rows"] must_not_say=["border"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(tolerance):
        for col in range(tolerance):
            result |= padded[row : row + height, col : col + width]
    return result

# %% name="plus instead of or, in int" sentence="+ counts the True pixels, and a count is no bool: combine with |, or compare with > 0." must_say=["bool"] kind="dtype"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros(mask.shape)
    for row in range(2 * tolerance + 1):
        for col in range(2 * tolerance + 1):
            result = result + padded[row : row + height, col : col + width]
    return result

# %% name="np.zeros without bool" sentence="np.zeros makes floats: for a mask write dtype=bool." must_say=["float", "bool"] kind="error"
def near(mask, tolerance):
    h, w = mask.shape
    p = np.pad(mask, tolerance)
    out = np.zeros((h, w))
    for r in range(2 * tolerance + 1):
        for c in range(2 * tolerance + 1):
            out = out | p[r:r+h, c:c+w]
    return out

# %% name="return forgotten" sentence="The function has no return: add return result at the end." must_say=["return"] kind="no-return"
def near(mask, tolerance):
    h, w = mask.shape
    p = np.pad(mask, tolerance)
    steps = range(2 * tolerance + 1)
    result = np.any([p[y : y + h, x : x + w] for y in steps for x in steps], axis=0)

# %% name="the padded result" sentence="Your result is larger than the mask by the padding: cut the padding off, so that the result has the shape of the mask." must_say=["larger|shape|pad|size", "cut|pad|same shape|shape of"] kind="shape"
def near(mask, tolerance):
    p = np.pad(mask, tolerance)
    result = np.zeros_like(p)
    for y, x in np.argwhere(p):
        result[y - tolerance : y + tolerance + 1, x - tolerance : x + tolerance + 1] = True
    return result
