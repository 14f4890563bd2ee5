# %% name="the smallest singular value" origin="fresh" sentence="Take the vector, the third result, not the singular values." must_say=["third|vector|reshape|size|shape"] kind="error"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.svd(np.array(rows))[1].reshape(3, 3)
    return H / H[2, 2]

# %% name="rows of u first, v forgotten" origin="fresh" sentence="Each corner has two rows: the row of v is missing." must_say=["two rows|row of v|each corner"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
    H = np.linalg.svd(np.array(rows))[2][-1].reshape(3, 3)
    return H / H[2, 2]

# %% name="divided by its length" origin="fresh" sentence="Divide by the last number, not by the length." must_say=["last|H\\[2, 2\\]"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    H = np.linalg.svd(np.array(rows))[2][-1].reshape(3, 3)
    return H / np.linalg.norm(H)

# %% name="a list of rows without array" origin="fresh" sentence="Divide each number: a list cannot be divided, make an array." must_say=["array|list"] kind="error"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    h = np.linalg.svd(np.array(rows))[2][-1].tolist()
    H = [h[0:3], h[3:6], h[6:9]]
    return H / H[2][2]

# %% name="transposed at the end" origin="fresh" sentence="The matrix is filled row by row: leave .T out." must_say=["row|transpos"] kind="value"
def find_homography(points, pixels):
    rows = []
    for (x, y), (u, v) in zip(points, pixels):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y, -u])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y, -v])
    h = np.linalg.svd(np.array(rows))[2][-1]
    return (h / h[8]).reshape(3, 3).transpose()
