# %% name="mean of the window" origin="fresh" sentence="You compute the mean of the nine pixels; the task asks for the median." must_say=["mean|median"] must_not_say=["border|edge"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros_like(gray)
    height, width = gray.shape
    for row in range(height):
        for col in range(width):
            result[row, col] = padded[row:row + 3, col:col + 3].mean()
    return result

# %% name="takes the fourth value" origin="fresh" sentence="The median of nine sorted values has the index 4; you take index 3, the fourth." must_say=["index 4|\\[4\\]|middle|fifth|median"] must_not_say=["border|pad"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros_like(gray)
    height, width = gray.shape
    for row in range(height):
        for col in range(width):
            values = sorted(padded[row:row + 3, col:col + 3].flatten())
            result[row, col] = values[3]
    return result

# %% name="not sorted" origin="fresh" sentence="The values are not sorted, so the middle one is the pixel itself: sort first." must_say=["sort|unchanged|itself|same|median"] must_not_say=["border"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros_like(gray)
    height, width = gray.shape
    for row in range(height):
        for col in range(width):
            values = padded[row:row + 3, col:col + 3].flatten()
            result[row, col] = values[4]
    return result

# %% name="window of 2" origin="fresh" sentence="The window has 2 × 2 pixels: row : row + 2 stops before row + 2; write row + 3." must_say=["3|window|2 × 2|2x2|neighbou?rhood"] must_not_say=["border"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros_like(gray)
    height, width = gray.shape
    for row in range(height):
        for col in range(width):
            result[row, col] = np.median(padded[row:row + 2, col:col + 2])
    return result

# %% name="border stays black" origin="fresh" sentence="The border pixels stay 0: pad the image and compute all pixels." must_say=["border|outermost|pad|replicate|edge"] kind="value"
def median3(gray):
    result = np.zeros_like(gray)
    height, width = gray.shape
    for row in range(1, height - 1):
        for col in range(1, width - 1):
            result[row, col] = np.median(gray[row - 1:row + 2, col - 1:col + 2])
    return result
