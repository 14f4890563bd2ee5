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

# %% name="no return" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.svd(np.array(rows))[2][-1].reshape(3, 3)
    H = H / H[2, 2]

# %% name="solved with 9 columns" sentence="np.linalg.solve needs a square matrix: there are 8 rows, but 9 columns." must_say=["square|9|8"] kind="error"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.solve(np.array(rows), np.zeros(8)).reshape(3, 3)
    return H / H[2, 2]

# %% name="plus" sentence="The products with u and v have a minus." must_say=["minus|sign"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, u * x, u * y, u])
        rows.append([0, 0, 0, x, y, 1, v * x, v * y, v])
    H = np.linalg.svd(np.array(rows))[2][-1].reshape(3, 3)
    return H / H[2, 2]
