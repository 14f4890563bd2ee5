# %% name="no division" origin="new" sentence="Divide by the third number." must_say=["third number|divide"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="greater or equal" origin="new" sentence="The first of two equally good samples counts: use >." must_say=[">|first"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        if near.sum() >= best.sum():
            best = near
    return best

# %% name="smaller" origin="new" sentence="Keep the sample with the most inliers." must_say=["most|more"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        if near.sum() < best.sum():
            best = near
    return best

# %% name="last sample" origin="new" sentence="Keep the mask only if it has more inliers." must_say=["most|more inliers"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        best = near
    return best

# %% name="return in the loop" origin="new" sentence="Compare all samples before you return." must_say=["return|loop"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        if near.sum() > best.sum():
            best = near
        return best

# %% name="not transposed" origin="new" sentence="Each row is multiplied by H.T." must_say=["transposed|H\\.T"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="pixels to points" origin="new" sentence="The homography goes from the points to the pixels." must_say=["points"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(pixels[sample], points[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="all matches" origin="new" sentence="Compute the homography of the four matches of the sample." must_say=["sample|four"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points, pixels)
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="Manhattan" origin="new" sentence="The distance is the root of the sum of squares." must_say=["root|norm|distance"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = abs(moved - pixels).sum(axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="both below" origin="new" sentence="Compare the distance, not each difference." must_say=["distance"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = (abs(moved - pixels) < limit).all(axis=1)
        if near.sum() > best.sum():
            best = near
    return best

# %% name="squared" origin="new" sentence="You compare the squared distance: take the root, or limit ** 2." must_say=["square"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = ((moved - pixels) ** 2).sum(axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="one norm" origin="new" sentence="axis=1 is missing: one distance for each match." must_say=["axis=1|each match|False everywhere|mask"] kind="error"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="outliers" origin="new" sentence="An inlier is nearer than the limit." must_say=["<|nearer|inlier"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels, axis=1) > limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="count" origin="new" sentence="Return the mask." must_say=["mask"] kind="type"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best.sum()

# %% name="positions" origin="new" sentence="Return the mask, not positions." must_say=["mask"] kind="type"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return np.nonzero(best)[0]

# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        if near.sum() > best.sum():
            best = near
