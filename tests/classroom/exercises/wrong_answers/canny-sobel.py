# %% name="result of uint8" sentence="Filter responses run from -1020 to 1020 and do not fit into uint8: make the results int32." must_say=["uint8", "int32", "fit|negative|-1020|results?|1020|cut"] kind="dtype"
def my_sobel(gray):
    p = np.pad(gray.astype(np.int32), 1, mode="edge")
    col = (p[:-2, 2:] + 2 * p[1:-1, 2:] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[1:-1, :-2] + p[2:, :-2])
    row = (p[2:, :-2] + 2 * p[2:, 1:-1] + p[2:, 2:]) - (p[:-2, :-2] + 2 * p[:-2, 1:-1] + p[:-2, 2:])
    return row.astype(np.uint8), col.astype(np.uint8)
