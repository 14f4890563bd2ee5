# %% name=">=" origin="new" sentence="The first of two equally good motions counts: use >." must_say=["first|>"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T + t - after, axis=1) < limit
        if near.sum() >= best.sum():
            best = near
    return best

# %% name="no comparison" origin="new" sentence="Compare: keep a mask only if it has more inliers." must_say=["last|compare|sum|keep"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T + t - after, axis=1) < limit
    return near

# %% name="return in the loop" origin="new" sentence="return stands inside the loop: only the first motion is looked at." must_say=["first|loop"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T + t - after, axis=1) < limit
        if near.sum() > best.sum():
            best = near
        return best

# %% name="fewest" origin="new" sentence="Keep the most inliers, not the fewest." must_say=["most|fewest"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.ones(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T + t - after, axis=1) < limit
        if near.sum() < best.sum():
            best = near
    return best

# %% name="R without T" origin="new" sentence="Rows are turned by R.T." must_say=["R\\.T|turn"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R + t - after, axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="R on the left" origin="new" sentence="R @ before does not fit: the points are rows, so write before @ R.T." must_say=["before @ R\\.T|shape|fit|rows"] kind="error"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(R @ before + t - after, axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="no shift" origin="new" sentence="Add the shift t." must_say=["shift|\\+ t"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T - after, axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="no axis" origin="new" sentence="norm without axis gives one number: use axis=1." must_say=["axis"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T + t - after) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="axis 0" origin="new" sentence="axis=0 gives one number for each coordinate: use axis=1." must_say=["axis|one for each pair|shape"] kind="shape"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T + t - after, axis=0) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="the outliers" origin="new" sentence="An inlier is nearer than the limit: use <." must_say=["<|nearer|opposite"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.ones(len(before), bool)
    for R, t in zip(rotations, shifts):
        far = np.linalg.norm(before @ R.T + t - after, axis=1) > limit
        if far.sum() < best.sum():
            best = far
    return best

# %% name="count" origin="new" sentence="Return the mask, not how many." must_say=["mask"] kind="type"
def best_inliers(before, after, rotations, shifts, limit):
    best = 0
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T + t - after, axis=1) < limit
        if near.sum() > best:
            best = near.sum()
    return best

# %% name="motion returned" origin="new" sentence="Return the mask of the inliers, not the motion." must_say=["mask|array"] kind="type"
def best_inliers(before, after, rotations, shifts, limit):
    most = 0
    for R, t in zip(rotations, shifts):
        near = np.linalg.norm(before @ R.T + t - after, axis=1) < limit
        if near.sum() > most:
            most, best = near.sum(), (R, t)
    return best

# %% name="sum of differences" origin="new" sentence="Take the length of each difference: np.linalg.norm." must_say=["length|norm"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = (before @ R.T + t - after).sum(axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="abs sum" origin="new" sentence="The distance is the root of the sum of squares." must_say=["root|norm"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = np.abs(before @ R.T + t - after).sum(axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="squares" origin="new" sentence="This is the squared distance: take the root." must_say=["squar|root"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = ((before @ R.T + t - after) ** 2).sum(axis=1) < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="norm without axis" origin="new" sentence="np.linalg.norm needs axis=1 for one distance for each pair." must_say=["axis=1", "each pair"] kind="value" must_not_say=["never stored"]
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        distances = np.linalg.norm(before @ R.T + t - after)
        near = distances < limit
        if near.sum() > best.sum():
            best = near
    return best

# %% name="each coordinate below the limit" origin="new" sentence="The distance is the length of the difference, not each coordinate alone." must_say=["length", "x, y and z|coordinate"] kind="value"
def best_inliers(before, after, rotations, shifts, limit):
    best = np.zeros(len(before), bool)
    for R, t in zip(rotations, shifts):
        near = (abs(before @ R.T + t - after) < limit).all(axis=1)
        if near.sum() > best.sum():
            best = near
    return best
