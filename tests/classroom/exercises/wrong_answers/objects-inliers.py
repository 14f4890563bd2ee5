# %% name="axis=0" sentence="One distance for each match: axis=1." must_say=["axis=1"] must_not_say=["multiplies value by value"] kind="value"
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
