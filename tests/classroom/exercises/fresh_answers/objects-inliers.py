# %% name="H returned" origin="fresh" sentence="Return the mask, not the matrix." must_say=["mask"] kind="type"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        if near.sum() > best.sum():
            best, keep = near, H
    return keep

# %% name="any sample" origin="fresh" sentence="Return the inliers of the best sample only." must_say=["best|one sample|the most"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        best = best | near
    return best

# %% name="first column" origin="fresh" sentence="The distance contains both coordinates." must_say=["both|norm"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = abs(moved[:, 0] - pixels[:, 0]) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="divided by x" origin="fresh" sentence="Divide by the third number, not by the first." must_say=["third|divide"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, 1:] / moved[:, :1]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="list of masks" origin="fresh" sentence="Return the best mask only." must_say=["mask|best|array|first sample"] kind="value"
def find_inliers(points, pixels, samples, limit):
    best = np.zeros(len(points), bool)
    with_one = np.column_stack([points, np.ones(len(points))])
    masks = []
    for sample in samples:
        H = homography(points[sample], pixels[sample])
        moved = with_one @ H.T
        moved = moved[:, :2] / moved[:, 2:]
        near = np.linalg.norm(moved - pixels, axis=1) < limit
        masks.append(near)
    return masks[0]
