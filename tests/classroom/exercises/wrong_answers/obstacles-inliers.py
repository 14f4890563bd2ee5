# %% name="distances" sentence="You return distances: compare them with the tolerance." must_say=["compar|tolerance|bool|True"] kind="dtype"
def inliers(points, normal, offset, tolerance):
    return np.abs(points @ normal + offset)

# %% name="count" sentence="Return the mask, not how many are near." must_say=["mask|array|each point"] kind="type"
def inliers(points, normal, offset, tolerance):
    return (np.abs(points @ normal + offset) < tolerance).sum()

# %% name="normal first" sentence="normal @ points does not fit: points have the coordinates in the last axis, so points @ normal." must_say=["points @ normal|shape|order|match"] kind="error"
def inliers(points, normal, offset, tolerance):
    return np.abs(normal @ points + offset) < tolerance
