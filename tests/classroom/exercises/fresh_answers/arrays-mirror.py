# %% name="loop overwrites its own half" origin="fresh" sentence="You write into the given image while you read from it: make a copy first." must_say=["copy|given (image|array|input)|chang|overwrit|view"] kind="input-changed"
def mirror(image):
    width = image.shape[1]
    for col in range(width):
        image[:, col] = image[:, width - 1 - col]
    return image

# %% name="index width" origin="fresh" sentence="The last column has the index width - 1: width - col goes one too far for column 0." must_say=["width - 1|last|one too (far|large|many)|- ?1|0 to"] kind="error"
def mirror(image):
    height, width = image.shape[:2]
    result = image.copy()
    for col in range(width):
        result[:, col] = image[:, width - col]
    return result

# %% name="sorts the rows" origin="fresh" sentence="You sort the values; a mirror reverses the order of the columns, image[:, ::-1]." must_say=["revers|order|::-1|sort"] must_not_say=["rows? instead of|upside"] kind="value"
def mirror(image):
    return np.sort(image, axis=1)[:, ::-1]

# %% name="reversed of the image" origin="fresh" sentence="reversed() goes over the rows, and gives no array: reverse the columns with image[:, ::-1]." must_say=["array|reversed|columns|list"] kind="type"
def mirror(image):
    return list(reversed(image))

# %% name="stop 0 loses the first column" origin="fresh" sentence="The slice width:0:-1 stops before column 0, so the first column is lost: write image[:, ::-1]." must_say=["first column|column 0|stop|los|one column|::-1|width"] must_not_say=["step"] kind="shape"
def mirror(image):
    width = image.shape[1]
    return image[:, width:0:-1]
