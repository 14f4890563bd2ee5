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

# %% name="computed again from the inliers" origin="walk" sentence="Return the inliers of the sample's own homography, do not compute it again." must_say=["again|sample's own"] must_not_say=["multiplies value by value"] kind="value"
def find_inliers(points, pixels, samples, limit):
    with_one = np.column_stack([points, np.ones(len(points))])
    best = np.zeros(len(points), bool)
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        distances = np.linalg.norm(moved - pixels, axis=1)
        inliers = distances < limit
        if inliers.sum() > best.sum():
            best = inliers
    H = homography(points[best], pixels[best])
    moved = with_one @ H.T
    moved = moved[:, :2] / moved[:, 2:]
    return np.linalg.norm(moved - pixels, axis=1) < limit

# %% name="axis=0" origin="walk" sentence="One distance for each match: axis=1." must_say=["axis=1"] must_not_say=["multiplies value by value"] kind="value"
def find_inliers(points, pixels, samples, limit):
    with_one = np.column_stack([points, np.ones(len(points))])
    best = np.zeros(len(points), bool)
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        distances = np.linalg.norm(moved - pixels, axis=0)
        inliers = distances < limit
        if inliers.sum() > best.sum():
            best = inliers
    return best

# %% name="len, last of equals" origin="walk" sentence="Count the inliers with near.sum(), not with len." must_say=["sum\\(", "len"] must_not_say=["multiplies value by value"] kind="value"
def find_inliers(points, pixels, samples, limit):
    with_one = np.column_stack([points, np.ones(len(points))])
    best = np.zeros(len(points), bool)
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        distances = np.linalg.norm(moved - pixels, axis=1)
        inliers = distances < limit
        if len(inliers) > len(best):
            best = inliers
    return best

# %% name="len" origin="walk" sentence="Count the inliers with near.sum(), not with len." must_say=["sum\\(", "len"] must_not_say=["multiplies value by value"] kind="value"
def find_inliers(points, pixels, samples, limit):
    with_one = np.column_stack([points, np.ones(len(points))])
    count = 0
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        distances = np.linalg.norm(moved - pixels, axis=1)
        inliers = distances < limit
        if len(inliers) > count:
            count = len(inliers)
            best = inliers
    return best

# %% name="only the sample moved" origin="walk" sentence="Move all points, not only the four of the sample." must_say=["all points"] must_not_say=["same for every input"] kind="shape"
def find_inliers(points, pixels, samples, limit):
    with_one = np.column_stack([points, np.ones(len(points))])
    best = np.zeros(len(points), bool)
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one[sample] @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        distances = np.linalg.norm(moved - pixels[sample], axis=1)
        inliers = distances < limit
        if inliers.sum() > best.sum():
            best = inliers
    return best

# %% name="smallest sum of distances" origin="walk" sentence="Keep the sample with the most inliers, not with the smallest sum of distances." must_say=["most inliers"] must_not_say=["multiplies value by value"] kind="value"
def find_inliers(points, pixels, samples, limit):
    with_one = np.column_stack([points, np.ones(len(points))])
    smallest = 1e12
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        distances = np.linalg.norm(moved - pixels, axis=1)
        if distances.sum() < smallest:
            smallest = distances.sum()
            best = distances < limit
    return best

# %% name="pixels moved" origin="walk" sentence="Move the points, not the pixels." must_say=["moved? the p"] must_not_say=["multiplies value by value"] kind="value"
def find_inliers(points, pixels, samples, limit):
    with_one = np.column_stack([pixels, np.ones(len(points))])
    best = np.zeros(len(points), bool)
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        distances = np.linalg.norm(moved - points, axis=1)
        inliers = distances < limit
        if inliers.sum() > best.sum():
            best = inliers
    return best

# %% name="third numbers without a column" origin="walk" sentence="moved[:, 2] has one axis: write moved[:, 2:]." must_say=[":, 2:"] must_not_say=["multiplies value by value", "width and height"] kind="error"
def find_inliers(points, pixels, samples, limit):
    with_one = np.column_stack([points, np.ones(len(points))])
    best = np.zeros(len(points), bool)
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2]
        distances = np.linalg.norm(moved - pixels, axis=1)
        inliers = distances < limit
        if inliers.sum() > best.sum():
            best = inliers
    return best
