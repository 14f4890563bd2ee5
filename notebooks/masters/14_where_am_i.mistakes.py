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

# %% role="mistake" name="plus in the row of v" says="The row of u is right, but the row of v has a wrong sign: it ends with -v * x, -v * y, -v."
def find_homography(points, pixels):
    rows = rows_of(points, pixels)
    rows[1::2, 6:] *= -1
    return null_matrix(rows)

# %% role="mistake" name="rounded" says="The numbers are rounded. Return the exact numbers, and leave round out."
def find_homography(points, pixels):
    return solution(points, pixels).round(2)

# %% role="mistake" name="whole numbers" says="Your matrix has whole numbers only. Leave astype(int) out."
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

# %% role="mistake" name="all signs changed" says="If U @ V is a mirror, you change the signs of the whole matrix. Change only the last column of U: np.diag([1, 1, np.linalg.det(U @ V)])."
def find_motion(before, after):
    U, V = decomposed(before, after)
    return with_shift(np.linalg.det(U @ V) * U @ V, before, after)

# %% role="mistake" name="the wrong column" says="If U @ V is a mirror, you change the first column of U. Change the last one, np.diag([1, 1, ...]): it belongs to the direction in which the points differ least."
def find_motion(before, after):
    U, V = decomposed(before, after)
    return with_shift(U @ np.diag([np.linalg.det(U @ V), 1, 1]) @ V, before, after)

# %% role="mistake" name="always -1" says="You always change the sign of the last column. Change it only for a mirror: multiply by the determinant of U @ V, not by -1."
def find_motion(before, after):
    U, V = decomposed(before, after)
    return with_shift(U @ np.diag([1, 1, -1]) @ V, before, after)

# %% role="mistake" name="the rotation back" says="This is the rotation from after to before. The order of the product is (after - its mean).T @ (before - its mean)."
def find_motion(before, after):
    return with_shift(solution(before, after)[0].T, before, after)

# %% role="mistake" name="the whole motion back" says="This is the motion from after to before. Exchange the two clouds."
def find_motion(before, after):
    return solution(after, before)

# %% role="mistake" name="only the rotation transposed" says="The shift is right, but the rotation is transposed: return R, not R.T."
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

# %% role="mistake" name="only one mean subtracted twice" says="You subtracted the mean of before from both clouds. Subtract from each cloud its own mean."
def find_motion(before, after):
    mean = before.mean(axis=0)
    U, _, V = np.linalg.svd((after - mean).T @ (before - mean) + len(before) * np.outer(after.mean(axis=0) - mean, mean))
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

# %% [markdown]
# # where-inliers

# %%
def masks_of(before, after, rotations, shifts, limit):
    return np.array([
        np.linalg.norm(before @ R.T + t - after, axis=1) < limit for R, t in zip(rotations, shifts, strict=True)
    ])

def most(masks):
    return masks[np.argmax(masks.sum(axis=1))]

# %% role="mistake" name="the fewest" says="You kept the motion with the fewest inliers. Keep the one with the most."
def best_inliers(before, after, rotations, shifts, limit):
    masks = masks_of(before, after, rotations, shifts, limit)
    return masks[np.argmin(masks.sum(axis=1))]

# %% role="mistake" name="of any motion" says="Your mask holds the inliers of all motions together. Only those of the best motion count."
def best_inliers(before, after, rotations, shifts, limit):
    return masks_of(before, after, rotations, shifts, limit).any(axis=0)

# %% role="mistake" name="the outliers" says="Your mask is the opposite: an inlier is nearer than the limit, so use <."
def best_inliers(before, after, rotations, shifts, limit):
    return ~solution(before, after, rotations, shifts, limit)

# %% role="mistake" name="the smallest mean" says="You chose the motion with the smallest mean distance. Wrong pairs spoil a mean: choose the motion with the most inliers."
def best_inliers(before, after, rotations, shifts, limit):
    means = [np.linalg.norm(before @ R.T + t - after, axis=1).mean() for R, t in zip(rotations, shifts, strict=True)]
    return masks_of(before, after, rotations, shifts, limit)[np.argmin(means)]

# %% role="mistake" name="how many" says="You return how many inliers there are. Return the mask: one True or False for each pair."
def best_inliers(before, after, rotations, shifts, limit):
    return int(solution(before, after, rotations, shifts, limit).sum())

# %% role="mistake" name="number of the motion" says="You return the number of the best motion. Return the mask of its inliers."
def best_inliers(before, after, rotations, shifts, limit):
    return int(np.argmax(masks_of(before, after, rotations, shifts, limit).sum(axis=1)))

# %% role="mistake" name="not turned" says="The rotation is missing: the moved points are before @ R.T + t."
def best_inliers(before, after, rotations, shifts, limit):
    return most(masks_of(before, after, np.array([np.eye(3)] * len(shifts)), shifts, limit))

# %% role="mistake" name="moved the wrong cloud" says="You moved the points after. The motion goes from before to after: before @ R.T + t."
def best_inliers(before, after, rotations, shifts, limit):
    return most(masks_of(after, before, rotations, shifts, limit))

# %% role="mistake" name="squared distance" says="You compare the squared distance with the limit. Take the root (np.linalg.norm), or compare with limit ** 2."
def best_inliers(before, after, rotations, shifts, limit):
    return most(masks_of(before, after, rotations, shifts, limit**0.5))

# %% role="mistake" name="each coordinate alone" says="You compare the distances in x, y and z with the limit one by one. A pair can be too far in all three together: take the length of the difference, np.linalg.norm with axis=1."
def best_inliers(before, after, rotations, shifts, limit):
    masks = [(np.abs(before @ R.T + t - after) < limit).all(axis=1) for R, t in zip(rotations, shifts, strict=True)]
    return most(np.array(masks))

# %% [markdown]
# # where-keyframes

# %%
def moved(a, b):
    return math.dist(a[:2], b[:2])

def turned(a, b):
    return abs(math.remainder(a[2] - b[2], 2 * math.pi))

def chosen(places, is_next):
    """Frame 0, and each frame of which is_next(place, place of the last keyframe) is true."""
    numbers = [0]
    for k in range(1, len(places)):
        if is_next(places[k], places[numbers[-1]]):
            numbers.append(k)
    return numbers

# %% role="mistake" name="compared with the frame before" says="You compare each frame with the frame before it. Compare it with the last keyframe, places[numbers[-1]]: small steps add up."
def keyframes(places, distance, angle):
    pairs = zip(places[1:], places, strict=False)
    return [0] + [k for k, (a, b) in enumerate(pairs, 1) if moved(a, b) >= distance or turned(a, b) >= angle]

# %% role="mistake" name="compared with frame 0" says="You compare each frame with frame 0. Compare it with the last keyframe, places[numbers[-1]]."
def keyframes(places, distance, angle):
    first = places[0]
    return [0] + [k for k in range(1, len(places)) if moved(places[k], first) >= distance or turned(places[k], first) >= angle]

# %% role="mistake" name="the way added up" says="You add up the steps since the last keyframe. A robot that drives forth and back is near it again: compare the two places, with math.dist."
def keyframes(places, distance, angle):
    numbers, way = [0], 0.0
    for k in range(1, len(places)):
        way += moved(places[k], places[k - 1])
        if way >= distance or turned(places[k], places[numbers[-1]]) >= angle:
            numbers.append(k)
            way = 0.0
    return numbers

# %% role="mistake" name="the near frames" says="You keep the frames that are near the last keyframe. A keyframe is far enough from it, by at least distance or angle: >=, not <."
def keyframes(places, distance, angle):
    return chosen(places, lambda a, b: moved(a, b) < distance or turned(a, b) < angle)

# %% role="mistake" name="only the angle" says="You look at the angle only. A way of at least distance also makes a keyframe."
def keyframes(places, distance, angle):
    return chosen(places, lambda a, b: turned(a, b) >= angle)

# %% role="mistake" name="without the remainder" says="Across π, the difference of two yaws jumps by 2π: 3.1 and -3.1 are almost the same direction. Use math.remainder(yaw - key_yaw, 2 * math.pi)."
def keyframes(places, distance, angle):
    return chosen(places, lambda a, b: moved(a, b) >= distance or abs(a[2] - b[2]) >= angle)

# %% role="mistake" name="turns to the left only" says="A turn to the right gives a negative difference. Take its absolute value with abs."
def keyframes(places, distance, angle):
    return chosen(places, lambda a, b: moved(a, b) >= distance or math.remainder(a[2] - b[2], 2 * math.pi) >= angle)

# %% role="mistake" name="turns to the right only" says="Your difference has the wrong sign for turns to the left. Take the absolute value of the difference with abs."
def keyframes(places, distance, angle):
    return chosen(places, lambda a, b: moved(a, b) >= distance or math.remainder(b[2] - a[2], 2 * math.pi) >= angle)

# %% role="mistake" name="% in place of remainder" says="% gives a difference from 0 to 2π, so a small turn to the right looks like a large one. Use math.remainder, which gives -π to π."
def keyframes(places, distance, angle):
    return chosen(places, lambda a, b: moved(a, b) >= distance or (a[2] - b[2]) % (2 * math.pi) >= angle)

# %% role="mistake" name="remainder by half a turn" says="You took the remainder by π, which is half a turn: a robot that looks back would not have turned. Use 2 * math.pi."
def keyframes(places, distance, angle):
    return chosen(places, lambda a, b: moved(a, b) >= distance or abs(math.remainder(a[2] - b[2], math.pi)) >= angle)

# %% role="mistake" name="without frame 0" says="Frame 0 is missing: it is the first keyframe. Begin with the list [0]."
def keyframes(places, distance, angle):
    return solution(places, distance, angle)[1:]

# %% role="mistake" name="with the last frame" says="You added the last frame. It is a keyframe only if it is far enough from the last one."
def keyframes(places, distance, angle):
    return sorted({*solution(places, distance, angle), len(places) - 1})

# %% role="mistake" name="numbers from 1" says="Your numbers are one too high: the first frame has the number 0."
def keyframes(places, distance, angle):
    return [k + 1 for k in solution(places, distance, angle)]

# %% role="mistake" name="the frame before" says="You keep the frame before the one that is far enough. The frame itself is the keyframe."
def keyframes(places, distance, angle):
    return [0] + [k - 1 for k in solution(places, distance, angle)[1:]]

# %% role="mistake" name="True and False" says="You return True or False for each frame. Return the list of the numbers of the keyframes."
def keyframes(places, distance, angle):
    numbers = solution(places, distance, angle)
    return [k in numbers for k in range(len(places))]

# %% role="mistake" name="begins at the origin" says="Your list begins empty, and your last keyframe is (0, 0, 0). Frame 0 is the first keyframe, wherever the robot stands: begin with numbers = [0] and compare with places[0]."
def keyframes(places, distance, angle):
    numbers, last = [], (0.0, 0.0, 0.0)
    for k, place in enumerate(places):
        if moved(place, last) >= distance or turned(place, last) >= angle:
            numbers.append(k)
            last = place
    return numbers

# %% role="mistake" name="the first frame at this place" says="places.index finds the first frame at a place, and a robot can come back to it. Take the number of the frame from the loop: for k in range(1, len(places))."
def keyframes(places, distance, angle):
    return [places.index(places[k]) for k in solution(places, distance, angle)]

# %% role="mistake" name="squared distance" says="You compare the squared distance. Take the root: math.dist gives the distance itself."
def keyframes(places, distance, angle):
    return chosen(places, lambda a, b: moved(a, b) ** 2 >= distance or turned(a, b) >= angle)

# %% role="mistake" name="x and y added" says="You added the ways in x and y. The distance is the root of the sum of squares: math.dist."
def keyframes(places, distance, angle):
    return chosen(places, lambda a, b: abs(a[0] - b[0]) + abs(a[1] - b[1]) >= distance or turned(a, b) >= angle)

# %% role="mistake" name="only x" says="You look at x only. The distance has two parts, x and y: math.dist."
def keyframes(places, distance, angle):
    return chosen(places, lambda a, b: abs(a[0] - b[0]) >= distance or turned(a, b) >= angle)

# %% role="mistake" name="yaw in the distance" says="Your distance also contains the yaw. The place has two numbers: math.dist((x, y), (key_x, key_y))."
def keyframes(places, distance, angle):
    return chosen(places, lambda a, b: math.dist(a, b) >= distance or turned(a, b) >= angle)
