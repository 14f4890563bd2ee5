# %% name="no abs" origin="new" sentence="Points far below the plane are not near: use np.abs." must_say=["abs|below|negative|either side"] kind="value"
def inliers(points, normal, offset, tolerance):
    return points @ normal + offset < tolerance

# %% name="offset missing" origin="new" sentence="Add the offset to points @ normal." must_say=["offset"] kind="value"
def inliers(points, normal, offset, tolerance):
    return np.abs(points @ normal) < tolerance

# %% name="offset minus" origin="new" sentence="The height is points @ normal + offset, not minus." must_say=["offset"] kind="value"
def inliers(points, normal, offset, tolerance):
    return np.abs(points @ normal - offset) < tolerance

# %% name="far ones" origin="new" sentence="You selected the points that are far: use <." must_say=["far|exchang|<|smaller|other"] kind="value"
def inliers(points, normal, offset, tolerance):
    return np.abs(points @ normal + offset) > tolerance

# %% name="distances" origin="new" sentence="You return distances: compare them with the tolerance." must_say=["compar|tolerance|bool|True"] kind="dtype"
def inliers(points, normal, offset, tolerance):
    return np.abs(points @ normal + offset)

# %% name="count" origin="new" sentence="Return the mask, not how many are near." must_say=["mask|array|each point"] kind="type"
def inliers(points, normal, offset, tolerance):
    return (np.abs(points @ normal + offset) < tolerance).sum()

# %% name="selected points" origin="new" sentence="Return the mask, not the points themselves." must_say=["mask|bool|True"] kind="shape"
def inliers(points, normal, offset, tolerance):
    return points[np.abs(points @ normal + offset) < tolerance]

# %% name="indices" origin="new" sentence="Return True or False for each point, not the indices." must_say=["True|mask|indices"] kind="value"
def inliers(points, normal, offset, tolerance):
    return np.where(np.abs(points @ normal + offset) < tolerance)[0]

# %% name="ones and zeros" origin="new" sentence="Return bool: leave astype(int) out." must_say=["bool|True"] kind="dtype"
def inliers(points, normal, offset, tolerance):
    return (np.abs(points @ normal + offset) < tolerance).astype(int)

# %% name="fixed tolerance" origin="new" sentence="Use the argument tolerance, not 0.02." must_say=["tolerance"] kind="value"
def inliers(points, normal, offset, tolerance):
    return np.abs(points @ normal + offset) < 0.02

# %% name="normal first" origin="new" sentence="normal @ points does not fit: points have the coordinates in the last axis, so points @ normal." must_say=["points @ normal|shape|order|match"] kind="error"
def inliers(points, normal, offset, tolerance):
    return np.abs(normal @ points + offset) < tolerance

# %% name="python and" origin="new" sentence="and does not work on arrays: use &, or np.abs." must_say=["&|abs|and"] kind="error"
def inliers(points, normal, offset, tolerance):
    heights = points @ normal + offset
    return heights > -tolerance and heights < tolerance

# %% name="if over the array" origin="new" sentence="An if cannot decide for a whole array: return the comparison itself." must_say=["array|comparison|each|any"] kind="error"
def inliers(points, normal, offset, tolerance):
    if np.abs(points @ normal + offset) < tolerance:
        return True
    return False
