# %% name="not divided" origin="new" sentence="Divide by the last number, so that H[2, 2] is 1." must_say=["last|H\\[2, 2\\]"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    return np.linalg.svd(np.array(rows))[2][-1].reshape(3, 3)

# %% name="first number" origin="new" sentence="Divide by the last number, not by the first." must_say=["last|H\\[2, 2\\]"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.svd(np.array(rows))[2][-1].reshape(3, 3)
    return H / H[0, 0]

# %% name="transposed" origin="new" sentence="The matrix is filled row by row: leave .T out." must_say=["row|transpos"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.svd(np.array(rows))[2][-1].reshape(3, 3).T
    return H / H[2, 2]

# %% name="a line of nine" origin="new" sentence="The result must have the shape (3, 3): use reshape." must_say=["reshape|\\(3, 3\\)|shape"] kind="shape"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.svd(np.array(rows))[2][-1]
    return H / H[-1]

# %% name="first vector" origin="new" sentence="The vector that gives 0 is the last row: vectors[-1]." must_say=["last"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.svd(np.array(rows))[2][0].reshape(3, 3)
    return H / H[2, 2]

# %% name="exchanged" origin="new" sentence="Points and pixels are exchanged." must_say=["exchang|from the points|from points"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (u, v), (x, y) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.svd(np.array(rows))[2][-1].reshape(3, 3)
    return H / H[2, 2]

# %% name="plus" origin="new" sentence="The products with u and v have a minus." must_say=["minus|sign"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, u * x, u * y, u])
        rows.append([0, 0, 0, x, y, 1, v * x, v * y, v])
    H = np.linalg.svd(np.array(rows))[2][-1].reshape(3, 3)
    return H / H[2, 2]

# %% name="v before u" origin="new" sentence="u is the first number of a pixel, v the second." must_say=["u and v|first"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (v, u) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.svd(np.array(rows))[2][-1].reshape(3, 3)
    return H / H[2, 2]

# %% name="y before x" origin="new" sentence="x is the first number of a point, y the second." must_say=["x and y|first"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (y, x), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.svd(np.array(rows))[2][-1].reshape(3, 3)
    return H / H[2, 2]

# %% name="affine" origin="new" sentence="The last row is not 0, 0, 1: far things must look smaller." must_say=["last row|perspective|far"] kind="value"
def find_homography(points, pixels):
    A = np.column_stack([points, np.ones(4)])
    columns = np.linalg.lstsq(A, pixels)[0]
    return np.vstack([columns.T, [0, 0, 1]])

# %% name="rounded" origin="new" sentence="Return the exact numbers: leave round out." must_say=["round|exact"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.svd(np.array(rows))[2][-1].reshape(3, 3)
    return (H / H[2, 2]).round(2)

# %% name="one row in place of eight" origin="new" sentence="Append the rows of all corners: begin the list before the loop." must_say=["loop|each corner|all"] kind="value"
def find_homography(points, pixels):
    for (x, y), (u, v) in zip(points, pixels):
        rows = []
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.svd(np.array(rows))[2][-1].reshape(3, 3)
    return H / H[2, 2]

# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.svd(np.array(rows))[2][-1].reshape(3, 3)
    H = H / H[2, 2]

# %% name="solved with 9 columns" origin="new" sentence="np.linalg.solve needs a square matrix: there are 8 rows, but 9 columns." must_say=["square|9|8"] kind="error"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.solve(np.array(rows), np.zeros(8)).reshape(3, 3)
    return H / H[2, 2]

# %% name="the last column of the third result" origin="new" sentence="Take the last row of the third result, not its last column." must_say=["last row"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    _, _, V = np.linalg.svd(np.array(rows))
    H = V[:, -1].reshape(3, 3)
    return H / H[2, 2]

# %% name="one row for each corner" origin="new" sentence="Each corner gives two rows, one for u and one for v." must_say=["two rows"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
    _, _, V = np.linalg.svd(np.array(rows))
    H = V[-1].reshape(3, 3)
    return H / H[2, 2]

# %% name="row v begins like row u" origin="new" sentence="The row of v begins with three zeros." must_say=["row of v|second", "0, 0, 0|zeros"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([x, y, 1, 0, 0, 0, -v * x, -v * y, -v])
    _, _, V = np.linalg.svd(np.array(rows))
    H = V[-1].reshape(3, 3)
    return H / H[2, 2]

# %% name="the first result of the decomposition" origin="new" sentence="U has 8 numbers in a row: the vector is in the third result." must_say=["9 numbers|third", "result"] kind="error" must_not_say=["cropped", "pixel not 3"]
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    U, s, V = np.linalg.svd(np.array(rows))
    H = U[-1].reshape(3, 3)
    return H / H[2, 2]

# %% name="the singular values" origin="new" sentence="The second result holds the singular values: the vector is in the third one." must_say=["9 numbers|third", "result|one"] kind="error" must_not_say=["cropped", "pixel not 3"]
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    _, s, V = np.linalg.svd(np.array(rows))
    H = s.reshape(3, 3)
    return H / H[2, 2]

# %% name="plus signs in the row of v" origin="new" sentence="In the row of v the minus signs are missing." must_say=["v", "sign"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, v * x, v * y, v])
    _, _, V = np.linalg.svd(np.array(rows))
    H = V[-1].reshape(3, 3)
    return H / H[2, 2]
