# %% name="the padded result" sentence="Your result is larger than the mask by the padding: cut the padding off, so that the result has the shape of the mask." must_say=["larger|shape|pad|size", "cut|pad|same shape|shape of"] kind="shape"
def near(mask, tolerance):
    p = np.pad(mask, tolerance)
    result = np.zeros_like(p)
    for y, x in np.argwhere(p):
        result[y - tolerance : y + tolerance + 1, x - tolerance : x + tolerance + 1] = True
    return result
