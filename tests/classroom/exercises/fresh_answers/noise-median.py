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

# %% name="window one off" origin="fresh" sentence="The window must begin at row and col in the padded image." must_say=["window|begin|row \\+ 3|row : row|shift"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros_like(gray)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            result[row, col] = np.median(padded[row:row + 2, col:col + 2])
    return result

# %% name="window begins one late" origin="fresh" sentence="The window begins one row and one column too late: padded[row : row + 3]." must_say=["window|begin|row : row|shift"] kind="value"
def median3(gray):
    padded = np.pad(gray, 2, mode="edge")
    result = np.zeros_like(gray)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            result[row, col] = np.median(padded[row:row + 3, col:col + 3])
    return result

# %% name="zeros at the border" origin="fresh" sentence="At the border repeat the outermost rows: mode=\"edge\"." must_say=["edge|repeat"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1)
    result = np.zeros_like(gray)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            result[row, col] = np.median(padded[row:row + 3, col:col + 3])
    return result

# %% name="mean" origin="fresh" sentence="This is the mean; the task asks for the median, the middle one." must_say=["median|mean|sort|fifth"] kind="value"
def median3(gray):
    padded = np.pad(gray.astype(float), 1, mode="edge")
    result = np.zeros_like(gray)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            result[row, col] = np.mean(padded[row:row + 3, col:col + 3])
    return result

# %% name="index 5" origin="fresh" sentence="The fifth value has the index 4, because Python counts from 0." must_say=["index 4|counts from 0|fifth"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros_like(gray)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            values = np.sort(padded[row:row + 3, col:col + 3].ravel())
            result[row, col] = values[5]
    return result

# %% name="not sorted again" origin="fresh" sentence="The nine values are not sorted, so the fifth is the pixel itself." must_say=["sort|equal to the input"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros_like(gray)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            values = padded[row:row + 3, col:col + 3].ravel()
            result[row, col] = values[4]
    return result

# %% name="return in the inner loop" origin="fresh" sentence="return stands inside the loops: only the first pixel is computed." must_say=["return.*(loop|inside)"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros_like(gray)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            result[row, col] = np.median(padded[row:row + 3, col:col + 3])
            return result

# %% name="sort in place, None" origin="fresh" sentence="values.sort() sorts in place and gives None." must_say=["None|in place"] kind="error"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros_like(gray)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            values = padded[row:row + 3, col:col + 3].flatten()
            values = values.sort()
            result[row, col] = values[4]
    return result

# %% name="no padding, border left" origin="fresh" sentence="The border is never computed: pad the image first." must_say=["border|pad"] kind="value"
def median3(gray):
    result = gray.copy()
    for row in range(1, gray.shape[0] - 1):
        for col in range(1, gray.shape[1] - 1):
            result[row, col] = np.median(gray[row - 1:row + 2, col - 1:col + 2])
    return result

# %% name="np.medain" origin="fresh" sentence="The function is called np.median." must_say=["np\\.median"] kind="error"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros_like(gray)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            result[row, col] = np.medain(padded[row:row + 3, col:col + 3])
    return result

# %% name="Computes the mean of the window instead of the median" origin="fresh" sentence="Computes the mean of the window instead of the median." must_say=["mean of|mean"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros_like(gray)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row:row + 3, col:col + 3]
            result[row, col] = np.mean(window)
    return result

# %% name="np" origin="fresh" sentence="np.pad without a mode fills the border with zeros instead of repeating the outermost pixels." must_say=["zeros"] kind="value"
def median3(gray):
    height, width = gray.shape
    padded = np.pad(gray, 1)
    result = np.zeros((height, width), dtype=np.uint8)
    for row in range(height):
        for col in range(width):
            result[row, col] = np.median(padded[row:row + 3, col:col + 3])
    return result

# %% name="Uses reflect at the border" origin="fresh" sentence="Uses reflect at the border, not replicate (edge)." must_say=["reflect"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="reflect")
    result = gray.copy()
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row:row + 3, col:col + 3]
            result[row, col] = np.median(window)
    return result

# %% name="Takes row - 1 " origin="fresh" sentence="Takes row - 1 : row + 2 in the padded image, which is already shifted by one, so the window is at the wrong place (and empty at row 0)." must_say=["empty|shifted|below 0"] kind="value"
def median3(gray):
    height, width = gray.shape
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros((height, width), dtype=np.uint8)
    for row in range(height):
        for col in range(width):
            window = padded[row - 1:row + 2, col - 1:col + 2]
            result[row, col] = np.median(window)
    return result

# %% name="Leaves the border pixels as they are instead of using" origin="fresh" sentence="Leaves the border pixels as they are instead of using replicate." must_say=["border"] kind="value"
def median3(gray):
    height, width = gray.shape
    result = gray.copy()
    for row in range(1, height - 1):
        for col in range(1, width - 1):
            window = gray[row - 1:row + 2, col - 1:col + 2]
            result[row, col] = np.median(window)
    return result

# %% name="result = gray makes no copy" origin="fresh" sentence="result = gray makes no copy, so the given image is changed." must_say=["changed|copy"] kind="input-changed"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = gray
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row:row + 3, col:col + 3]
            result[row, col] = np.median(window)
    return result

# %% name="return is inside the inner loop" origin="fresh" sentence="return is inside the inner loop, so only the first pixel is computed." must_say=["inside"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros_like(gray)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row:row + 3, col:col + 3]
            result[row, col] = np.median(window)
            return result

# %% name="Takes index 5 of the nine sorted values" origin="fresh" sentence="Takes index 5 of the nine sorted values; the middle one has index 4." must_say=["index"] kind="value"
def median3(gray):
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros_like(gray)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row:row + 3, col:col + 3]
            values = sorted(window.flatten())
            result[row, col] = values[5]     # the 5th is in the middle
    return result

# %% name="Height and width are exchanged " origin="fresh" sentence="Height and width are exchanged (shape is height first), so it fails for an image that is not square." must_say=["exchanged"] kind="shape"
def median3(gray):
    width, height = gray.shape
    padded = np.pad(gray, 1, mode="edge")
    result = np.zeros((height, width), dtype=np.uint8)
    for row in range(height):
        for col in range(width):
            window = padded[row:row + 3, col:col + 3]
            result[row, col] = np.median(window)
    return result
