# %% name="one chain forth and back" sentence="The lower side needs a chain of its own." must_say=["new.* chain|chain of its own"] kind="shape"
def convex_hull(points):
    pts = sorted(points.tolist())
    way = pts + pts[::-1][1:]
    chain = []
    for p in way:
        while len(chain) >= 2 and turn(chain[-2], chain[-1], p) <= 0:
            chain.pop()
        chain.append(p)
    return np.array(chain[:-1])

# %% name="bounding box" sentence="The corners of the hull are points of the input, not the corners of the bounding box." must_say=["bounding box|points of the input"] kind="value"
def convex_hull(points):
    x0, y0 = points.min(axis=0)
    x1, y1 = points.max(axis=0)
    return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])

# %% name="no return" sentence="Return the corners." must_say=["return"] kind="no-return"
def convex_hull(points):
    corners = []
    ordered = sorted(points.tolist())
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            while len(chain) >= 2 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
            chain.append(point)
        corners += chain[:-1]

# %% name="chain[-1] for the first argument" sentence="Look at the last two points of the chain: one point alone has no index -2." must_say=["two points|index|-2|empty"] kind="error"
def convex_hull(points):
    corners = []
    ordered = sorted(points.tolist())
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            while turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
            chain.append(point)
        corners += chain[:-1]
    return np.array(corners)

# %% name="extreme points" sentence="The hull can have more corners than the four outermost points." must_say=["outermost|more corners"] kind="value"
def convex_hull(points):
    left = points[np.argmin(points[:, 0])]
    top = points[np.argmin(points[:, 1])]
    right = points[np.argmax(points[:, 0])]
    bottom = points[np.argmax(points[:, 1])]
    return np.array([left, top, right, bottom])
