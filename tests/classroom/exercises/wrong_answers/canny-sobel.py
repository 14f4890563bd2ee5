# %% name="absolute values" sentence="You take the absolute value, but a jump from bright to dark must be negative: leave np.abs out." must_say=["absolute|\\babs\\b|without (its|their) sign|sign is lost", "negative|sign|leave"] must_not_say=["turned around", "swap"] kind="value"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])
    return np.abs(row), np.abs(col)

# %% name="image times kernel" sentence="gray * kernel multiplies arrays of different shapes: the 3 × 3 kernel must slide over the image, nine products for each pixel." must_say=["shape|broadcast|size", "slide|each pixel|every pixel|nine|neighbo|window"] kind="error"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    grad_col = gray * kernel
    grad_row = gray * kernel.T
    return grad_row.astype(np.int32), grad_col.astype(np.int32)

# %% name="the course's sobel" sentence="sobel is the course's own function, from another cell: the task is to write it yourself." must_say=["\\bsobel\\b", "yourself|own|another cell|refus|import"] kind="other-cell"
def my_sobel(gray):
    grad_row, grad_col = sobel(gray)
    return grad_row, grad_col

# %% name="return forgotten" sentence="The two arrays are computed, but the function has no return: add return grad_row, grad_col." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    grad_col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    grad_row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])

# %% name="result of uint8" sentence="Filter responses run from -1020 to 1020 and do not fit into uint8: make the results int32." must_say=["uint8", "int32", "fit|negative|-1020|results?|1020|cut"] kind="dtype"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])
    return row.astype(np.uint8), col.astype(np.uint8)
