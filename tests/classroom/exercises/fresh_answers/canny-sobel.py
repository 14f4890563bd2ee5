# %% name="zeros in the padding" origin="fresh" sentence="np.pad without mode adds zeros; repeat the outermost pixels with mode=\"edge\"." must_say=["edge|replicate|repeat|zeros?|outermost"] must_not_say=["swap|\\border|uint8"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    height, width = gray.shape
    padded = np.pad(gray, 1).astype(np.int32)
    grad_row = np.zeros((height, width), dtype=np.int32)
    grad_col = np.zeros((height, width), dtype=np.int32)
    for row in range(height):
        for col in range(width):
            window = padded[row:row + 3, col:col + 3]
            grad_col[row, col] = (window * kernel).sum()
            grad_row[row, col] = (window * kernel.T).sum()
    return grad_row, grad_col

# %% name="kernel is matrix multiplied" origin="fresh" sentence="@ is the matrix product; multiply element by element with *." must_say=["matrix|@|element|each (pixel|value)|\\*"] must_not_say=["swap|order|border"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    height, width = gray.shape
    padded = np.pad(gray, 1, mode="edge").astype(np.int32)
    grad_row = np.zeros((height, width), dtype=np.int32)
    grad_col = np.zeros((height, width), dtype=np.int32)
    for row in range(height):
        for col in range(width):
            window = padded[row:row + 3, col:col + 3]
            grad_col[row, col] = (window @ kernel).sum()
            grad_row[row, col] = (window @ kernel.T).sum()
    return grad_row, grad_col

# %% name="window from the unpadded place" origin="fresh" sentence="The window begins at row - 1 and goes out of the padded image: pixel (row, col) is the middle of padded[row:row+3, col:col+3]." must_say=["row ?: ?row|window|middle|row - 1|-1"] must_not_say=["swap|order"] kind="error"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    height, width = gray.shape
    padded = np.pad(gray, 1, mode="edge").astype(np.int32)
    grad_row = np.zeros((height, width), dtype=np.int32)
    grad_col = np.zeros((height, width), dtype=np.int32)
    for row in range(height):
        for col in range(width):
            window = padded[row - 1:row + 2, col - 1:col + 2]
            grad_col[row, col] = (window * kernel).sum()
            grad_row[row, col] = (window * kernel.T).sum()
    return grad_row, grad_col

# %% name="prewitt kernel" origin="fresh" sentence="The middle row of the kernel is -2, 0, 2; you use 1 in all rows." must_say=["-?2, 0, 2|kernel|twice|middle row|weights?"] must_not_say=["swap|order|border"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-1, 0, 1], [-1, 0, 1]])
    height, width = gray.shape
    padded = np.pad(gray, 1, mode="edge").astype(np.int32)
    grad_row = np.zeros((height, width), dtype=np.int32)
    grad_col = np.zeros((height, width), dtype=np.int32)
    for row in range(height):
        for col in range(width):
            window = padded[row:row + 3, col:col + 3]
            grad_col[row, col] = (window * kernel).sum()
            grad_row[row, col] = (window * kernel.T).sum()
    return grad_row, grad_col

# %% name="grad_row upside down" origin="fresh" sentence="grad_row has the wrong sign: it is the row below minus the row above." must_say=["sign|below|minus|above|negative|flip"] must_not_say=["border"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    height, width = gray.shape
    padded = np.pad(gray, 1, mode="edge").astype(np.int32)
    grad_row = np.zeros((height, width), dtype=np.int32)
    grad_col = np.zeros((height, width), dtype=np.int32)
    for row in range(height):
        for col in range(width):
            window = padded[row:row + 3, col:col + 3]
            grad_col[row, col] = (window * kernel).sum()
            grad_row[row, col] = (window * kernel.T[::-1]).sum()
    return grad_row, grad_col
