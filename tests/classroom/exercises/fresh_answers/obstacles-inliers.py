# %% name="abs before the offset" origin="fresh" sentence="Take abs of the whole height, after the offset is added." must_say=["abs|offset"] kind="value"
def inliers(points, normal, offset, tolerance):
    return np.abs(points @ normal) + offset < tolerance

# %% name="only below" origin="fresh" sentence="Only points below the plane are selected: use np.abs." must_say=["abs|below|above|either"] kind="value"
def inliers(points, normal, offset, tolerance):
    heights = points @ normal + offset
    return (heights <= 0) & (heights > -tolerance)

# %% name="one for all" origin="fresh" sentence="any gives one answer for all points: leave it out." must_say=["each point|mask|array|any"] kind="type"
def inliers(points, normal, offset, tolerance):
    return (np.abs(points @ normal + offset) < tolerance).any()

# %% name="squared without squaring the tolerance" origin="fresh" sentence="You compare the square with the tolerance: square both, or use np.abs." must_say=["squar|abs"] kind="value"
def inliers(points, normal, offset, tolerance):
    return (points @ normal + offset) ** 2 < tolerance

# %% name="tolerance doubled" origin="fresh" sentence="The tolerance holds on each side: do not double it." must_say=["tolerance|twice|double"] kind="value"
def inliers(points, normal, offset, tolerance):
    return np.abs(points @ normal + offset) < 2 * tolerance
