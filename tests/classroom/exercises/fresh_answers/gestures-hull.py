# %% name="extreme points" origin="fresh" sentence="The hull can have more corners than the four outermost points." must_say=["outermost|more corners"] kind="value"
def convex_hull(points):
    left = points[np.argmin(points[:, 0])]
    top = points[np.argmin(points[:, 1])]
    right = points[np.argmax(points[:, 0])]
    bottom = points[np.argmax(points[:, 1])]
    return np.array([left, top, right, bottom])

# %% name="by angle around the mean" origin="fresh" sentence="All points are in your result; remove those inside the band." must_say=["all points|remove"] kind="shape"
def convex_hull(points):
    middle = points.mean(axis=0)
    angles = np.arctan2(points[:, 1] - middle[1], points[:, 0] - middle[0])
    return points[np.argsort(angles)]

# %% name="sorted by y" origin="fresh" sentence="Sort by x, from left to right, not by y." must_say=["by x|left to right"] kind="value"
def convex_hull(points):
    corners = []
    ordered = sorted(points.tolist(), key=lambda p: (p[1], p[0]))
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            while len(chain) >= 2 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
            chain.append(point)
        corners += chain[:-1]
    return np.array(corners)

# %% name="second side not reversed" origin="fresh" sentence="Go over the points in reverse order for the lower side." must_say=["reverse"] kind="value"
def convex_hull(points):
    corners = []
    ordered = sorted(points.tolist())
    for side in (ordered, ordered):
        chain = []
        for point in side:
            while len(chain) >= 2 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
            chain.append(point)
        corners += chain[:-1]
    return np.array(corners)

# %% name="new point first in turn" origin="fresh" sentence="The path goes over the last two points of the chain to the new point." must_say=["turn|path|last two"] kind="value"
def convex_hull(points):
    corners = []
    ordered = sorted(points.tolist())
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            while len(chain) >= 2 and turn(point, chain[-1], chain[-2]) <= 0:
                chain.pop()
            chain.append(point)
        corners += chain[:-1]
    return np.array(corners)
