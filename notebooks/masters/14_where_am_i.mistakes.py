# %% [markdown]
# # where-homography

# %%
def rows_of(points, pixels, sign=-1.0, last=-1.0):
    rows = []
    for (x, y), (u, v) in zip(points, pixels, strict=True):
        rows.append([x, y, 1, 0, 0, 0, sign * u * x, sign * u * y, last * u])
        rows.append([0, 0, 0, x, y, 1, sign * v * x, sign * v * y, last * v])
    return np.array(rows)

def null_matrix(rows):
    matrix = np.linalg.svd(rows)[2][-1].reshape(3, 3)
    return matrix / matrix[2, 2]

# %% role="mistake" name="not divided" says="Your numbers are right up to a factor: the vector of NumPy has the length 1. Divide by the last number, so that H[2, 2] is 1."
def find_homography(points, pixels):
    H = solution(points, pixels)
    return H / np.linalg.norm(H)

# %% role="mistake" name="not divided, the other sign" says="Your numbers are right up to a factor: the vector of NumPy has the length 1, and any sign. Divide by the last number, so that H[2, 2] is 1."
def find_homography(points, pixels):
    H = solution(points, pixels)
    return -H / np.linalg.norm(H)

# %% role="mistake" name="divided by the sum" says="You divided by the sum. Divide by the last number, H[2, 2]."
def find_homography(points, pixels):
    H = solution(points, pixels)
    return H / H.sum()

# %% role="mistake" name="divided by the largest" says="You divided by the largest number. Divide by the last number, H[2, 2]."
def find_homography(points, pixels):
    H = solution(points, pixels)
    return H / np.abs(H).max()

# %% role="mistake" name="plus in place of minus" says="A sign is wrong: the products with u and v have a minus. -u * x, -u * y, -u, and the same with v."
def find_homography(points, pixels):
    return null_matrix(rows_of(points, pixels, 1.0, 1.0))

# %% role="mistake" name="minus at the last number only" says="A sign is wrong: also -u * x and -u * y have a minus, and the same with v."
def find_homography(points, pixels):
    return null_matrix(rows_of(points, pixels, 1.0, -1.0))

# %% role="mistake" name="pixels as (row, col)" says="Rows 0 and 1 of your matrix are exchanged, as if a pixel were (row, col). It is (u, v): the column comes first."
def find_homography(points, pixels):
    return solution(points, pixels[:, ::-1])

# %% role="mistake" name="no perspective" says="The last row of your matrix is always 0, 0, 1: this map has no perspective, and parallel lines stay parallel. All nine numbers are unknown: two equations for each corner, as in the text, and the SVD."
def find_homography(points, pixels):
    known = np.column_stack([points, np.ones(4)])
    return np.vstack([np.linalg.lstsq(known, pixels)[0].T, [0, 0, 1]])

# %% role="mistake" name="plus in the row of v" says="The row of u is right, but the row of v has a wrong sign: it ends with -v * x, -v * y, -v."
def find_homography(points, pixels):
    rows = rows_of(points, pixels)
    rows[1::2, 6:] *= -1
    return null_matrix(rows)

# %% role="mistake" name="rounded" says="The numbers are rounded. Return the exact numbers, and leave round out."
def find_homography(points, pixels):
    return solution(points, pixels).round(2)

# %% role="mistake" name="whole numbers" says="Your numbers are cut to whole numbers. Leave astype(int), or an array of int, out."
def find_homography(points, pixels):
    # Rounded before: on some processors a whole number comes out a little smaller.
    return np.trunc(np.round(solution(points, pixels), 6))

# %% [markdown]
# # where-motion

# %%
def decomposed(before, after):
    U, _, V = np.linalg.svd((after - after.mean(axis=0)).T @ (before - before.mean(axis=0)))
    return U, V

def with_shift(R, before, after):
    return R, after.mean(axis=0) - R @ before.mean(axis=0)

# %% role="mistake" name="one mean of all numbers" says="The mean of a cloud is a point of three numbers, mean(axis=0). Without axis, it is one number for all of them."
def find_motion(before, after):
    U, _, V = np.linalg.svd((after - after.mean()).T @ (before - before.mean()))
    R = U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V
    return R, after.mean() - R @ np.full(3, before.mean())

# %% role="mistake" name="all signs changed" says="If the matrix is a mirror, you change all its signs. Change only one, between U and V: np.diag([1, 1, np.linalg.det(U @ V)])."
def find_motion(before, after):
    U, V = decomposed(before, after)
    return with_shift(np.linalg.det(U @ V) * U @ V, before, after)

# %% role="mistake" name="the wrong column" says="If the matrix is a mirror, you turn its first direction round. Take the last one, in which the points differ least: np.diag([1, 1, ...]) between U and V."
def find_motion(before, after):
    U, V = decomposed(before, after)
    return with_shift(U @ np.diag([np.linalg.det(U @ V), 1, 1]) @ V, before, after)

# %% role="mistake" name="always -1" says="In these checks, you always turn the last direction round. Do it only for a mirror: multiply by the determinant of U @ V, not by -1."
def find_motion(before, after):
    U, V = decomposed(before, after)
    return with_shift(U @ np.diag([1, 1, -1]) @ V, before, after)

# %% role="mistake" name="the rotation back" says="This is the rotation from after to before. With (after - its mean).T @ (before - its mean), R is U @ diag @ V; with the other order, V.T @ diag @ U.T."
def find_motion(before, after):
    return with_shift(solution(before, after)[0].T, before, after)

# %% role="mistake" name="the whole motion back" says="This is the motion from after to before. Exchange the two clouds."
def find_motion(before, after):
    return solution(after, before)

# %% role="mistake" name="only the rotation transposed" says="The shift is right, but the rotation is transposed: R @ point must turn a point from before to after."
def find_motion(before, after):
    R, t = solution(before, after)
    return R.T, t

# %% role="mistake" name="the turned mean of after" says="You turned the mean of after. R turns what was before: t = after_mean - R @ before_mean."
def find_motion(before, after):
    R, _ = solution(before, after)
    return R, before.mean(axis=0) - R @ after.mean(axis=0)

# %% role="mistake" name="added means" says="You added the two means. The shift is their difference: t = after_mean - R @ before_mean."
def find_motion(before, after):
    R, _ = solution(before, after)
    return R, after.mean(axis=0) + R @ before.mean(axis=0)

# %% role="mistake" name="shift 0" says="Your shift is 0. After the rotation, the means must meet: t = after_mean - R @ before_mean."
def find_motion(before, after):
    return solution(before, after)[0], np.zeros(3)

# %% role="mistake" name="not centered" says="Both clouds still have their means when you multiply them. Subtract from each cloud its own mean first, mean(axis=0)."
def find_motion(before, after):
    U, _, V = np.linalg.svd(after.T @ before)
    return with_shift(U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V, before, after)

# %% role="mistake" name="one mean for all numbers" says="Your mean is one number. Take the mean over axis 0: three numbers, one for each coordinate."
def find_motion(before, after):
    U, _, V = np.linalg.svd((after - after.mean()).T @ (before - before.mean()))
    return with_shift(U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V, before, after)

# %% role="mistake" name="not a rotation" says="Your matrix fits the points, but it is not a rotation: it also stretches. Use the singular value decomposition: R = U @ diag @ V."
def find_motion(before, after):
    cloud, partner = before - before.mean(axis=0), after - after.mean(axis=0)
    return with_shift(np.linalg.lstsq(cloud, partner)[0].T, before, after)

# %% role="mistake" name="the first three pairs" says="You used the first three points only. All pairs count: the others make the noise smaller."
def find_motion(before, after):
    return solution(before[:3], after[:3])

# %% role="mistake" name="only the rotation" says="You return one array. Return two: the rotation and the shift."
def find_motion(before, after):
    return solution(before, after)[0]

# %% role="mistake" name="rounded" says="The numbers are rounded. Return the exact numbers, and leave round out."
def find_motion(before, after):
    R, t = solution(before, after)
    return R.round(2), t.round(2)

# %% role="mistake" name="the shift of the first pair" says="The shift comes from the first pair of points alone, with its noise. Take the means: t = after_mean - R @ before_mean."
def find_motion(before, after):
    R, _ = solution(before, after)
    return R, after[0] - R @ before[0]
