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

# %% name="The two results are returned in the wrong order " origin="fresh" sentence="The two results are returned in the wrong order (grad_col first)." must_say=["swapped|wrong order"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray.astype(np.int32), 1, mode="edge")
    grad_row = np.zeros(gray.shape, dtype=np.int32)
    grad_col = np.zeros(gray.shape, dtype=np.int32)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row : row + 3, col : col + 3]
            grad_col[row, col] = np.sum(window * kernel)
            grad_row[row, col] = np.sum(window * kernel.T)
    return grad_col, grad_row

# %% name="The result arrays are uint8 " origin="fresh" sentence="The result arrays are uint8 (like gray), so negative and large values wrap around." must_say=["uint8"] kind="dtype"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray, 1, mode="edge")
    grad_row = np.zeros_like(gray)
    grad_col = np.zeros_like(gray)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row : row + 3, col : col + 3]
            grad_col[row, col] = (window * kernel).sum()
            grad_row[row, col] = (window * kernel.T).sum()
    return grad_row, grad_col

# %% name="Pads with zeros instead of repeating the border pixels" origin="fresh" sentence="Pads with zeros instead of repeating the border pixels, so there are false edges at the border." must_say=["zeros"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray.astype(np.int32), 1)
    height, width = gray.shape
    grad_row = np.zeros((height, width), dtype=np.int32)
    grad_col = np.zeros((height, width), dtype=np.int32)
    for row in range(height):
        for col in range(width):
            window = padded[row : row + 3, col : col + 3]
            grad_col[row, col] = np.sum(window * kernel)
            grad_row[row, col] = np.sum(window * kernel.T)
    return grad_row, grad_col

# %% name="The signs of the kernel are reversed " origin="fresh" sentence="The signs of the kernel are reversed (left minus right), so both parts have the wrong sign." must_say=["sign"] kind="value"
def my_sobel(gray):
    kernel = np.array([[1, 0, -1],
                       [2, 0, -2],
                       [1, 0, -1]])
    padded = np.pad(gray.astype(np.int32), 1, mode="edge")
    grad_row = np.zeros(gray.shape, dtype=np.int32)
    grad_col = np.zeros(gray.shape, dtype=np.int32)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row : row + 3, col : col + 3]
            grad_col[row, col] = np.sum(window * kernel)
            grad_row[row, col] = np.sum(window * kernel.T)
    return grad_row, grad_col

# %% name="The middle row of the kernel has 1 instead of 2" origin="fresh" sentence="The middle row of the kernel has 1 instead of 2." must_say=["middle row"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1],
                       [-1, 0, 1],
                       [-1, 0, 1]])
    padded = np.pad(gray.astype(np.int32), 1, mode="edge")
    grad_row = np.zeros(gray.shape, dtype=np.int32)
    grad_col = np.zeros(gray.shape, dtype=np.int32)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row : row + 3, col : col + 3]
            grad_col[row, col] = np.sum(window * kernel)
            grad_row[row, col] = np.sum(window * kernel.T)
    return grad_row, grad_col

# %% name="The kernel is not transposed for grad_row" origin="fresh" sentence="The kernel is not transposed for grad_row, so both results are the same." must_say=["transposed|kernel\\.T"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray.astype(np.int32), 1, mode="edge")
    grad_row = np.zeros(gray.shape, dtype=np.int32)
    grad_col = np.zeros(gray.shape, dtype=np.int32)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row : row + 3, col : col + 3]
            grad_row[row, col] = np.sum(window * kernel)
            grad_col[row, col] = np.sum(window * kernel)
    return grad_row, grad_col

# %% name="Uses the matrix product @ where each pixel must be" origin="fresh" sentence="Uses the matrix product @ where each pixel must be multiplied by its own weight with *." must_say=["@|matrix"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray.astype(np.int32), 1, mode="edge")
    grad_row = np.zeros(gray.shape, dtype=np.int32)
    grad_col = np.zeros(gray.shape, dtype=np.int32)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row : row + 3, col : col + 3]
            grad_col[row, col] = np.sum(window @ kernel)
            grad_row[row, col] = np.sum(window @ kernel.T)
    return grad_row, grad_col

# %% name="Subtracts the uint8 neighbours before converting to int32" origin="fresh" sentence="Subtracts the uint8 neighbours before converting to int32, so negative differences wrap around." must_say=["wrap"] kind="value"
def my_sobel(gray):
    p = np.pad(gray, 1, mode="edge")
    right = p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]
    left = p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2]
    below = p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]
    above = p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:]
    grad_col = (right - left).astype(np.int32)
    grad_row = (below - above).astype(np.int32)
    return grad_row, grad_col

# %% name="return is indented into the loop over the rows" origin="fresh" sentence="return is indented into the loop over the rows, so everything below the first row stays 0." must_say=["stands inside|first row"] kind="value"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    padded = np.pad(gray.astype(np.int32), 1, mode="edge")
    grad_row = np.zeros(gray.shape, dtype=np.int32)
    grad_col = np.zeros(gray.shape, dtype=np.int32)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            window = padded[row : row + 3, col : col + 3]
            grad_col[row, col] = np.sum(window * kernel)
            grad_row[row, col] = np.sum(window * kernel.T)
        return grad_row, grad_col
