# %% name="image times kernel" sentence="gray * kernel multiplies arrays of different shapes: the 3 × 3 kernel must slide over the image, nine products for each pixel." must_say=["shape|broadcast|size", "slide|each pixel|every pixel|nine|neighbo|window"] kind="error"
def my_sobel(gray):
    kernel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]])
    grad_col = gray * kernel
    grad_row = gray * kernel.T
    return grad_row.astype(np.int32), grad_col.astype(np.int32)

# %% name="result of uint8" sentence="Filter responses run from -1020 to 1020 and do not fit into uint8: make the results int32." must_say=["uint8", "int32", "fit|negative|-1020|results?|1020|cut"] kind="dtype"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])
    return row.astype(np.uint8), col.astype(np.uint8)
