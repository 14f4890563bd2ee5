# %% name="affine" sentence="The last row is not 0, 0, 1: far things must look smaller." must_say=["last row|perspective|far"] kind="value"
def find_homography(points, pixels):
    A = np.column_stack([points, np.ones(4)])
    columns = np.linalg.lstsq(A, pixels)[0]
    return np.vstack([columns.T, [0, 0, 1]])

# %% name="a line of nine" sentence="The result must have the shape (3, 3): use reshape." must_say=["reshape|\\(3, 3\\)|shape"] kind="shape"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.svd(np.array(rows))[2][-1]
    return H / H[-1]
