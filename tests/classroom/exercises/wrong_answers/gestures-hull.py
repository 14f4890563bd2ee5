# %% name="collinear kept" origin="new" sentence="A point in the middle of a straight side is no corner: remove it also if turn is 0." must_say=["straight", "0"] kind="value"
def convex_hull(points):
    corners = []
    ordered = sorted(points.tolist())
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            while len(chain) >= 2 and turn(chain[-2], chain[-1], point) < 0:
                chain.pop()
            chain.append(point)
        corners += chain[:-1]
    return np.array(corners)

# %% name="if for while" origin="new" sentence="Look again after you removed a point: use while." must_say=["while|again"] kind="value"
def convex_hull(points):
    corners = []
    ordered = sorted(points.tolist())
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            if len(chain) >= 2 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
            chain.append(point)
        corners += chain[:-1]
    return np.array(corners)

# %% name="upper only" origin="new" sentence="The lower side is missing: go over the points in reverse order as well." must_say=["lower"] kind="shape"
def convex_hull(points):
    chain = []
    for point in sorted(points.tolist()):
        while len(chain) >= 2 and turn(chain[-2], chain[-1], point) <= 0:
            chain.pop()
        chain.append(point)
    return np.array(chain)

# %% name="ends twice" origin="new" sentence="Leave out the last point of each chain, because the other chain begins with it." must_say=["last point"] kind="shape"
def convex_hull(points):
    corners = []
    ordered = sorted(points.tolist())
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            while len(chain) >= 2 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
            chain.append(point)
        corners += chain
    return np.array(corners)

# %% name="the last of the lower side kept" origin="new" sentence="The first corner is at the end again." must_say=["first|last"] kind="shape"
def convex_hull(points):
    sides = []
    ordered = sorted(points.tolist())
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            while len(chain) >= 2 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
            chain.append(point)
        sides.append(chain)
    return np.array(sides[0] + sides[1][1:])

# %% name="left turns" origin="new" sentence="Your corners go the other way round: clockwise on the screen, turn is positive." must_say=["other|direction|clockwise"] kind="value"
def convex_hull(points):
    corners = []
    ordered = sorted(points.tolist())
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            while len(chain) > 1 and turn(chain[-2], chain[-1], point) >= 0:
                chain.pop()
            chain.append(point)
        corners += chain[:-1]
    return np.array(corners)

# %% name="not sorted" origin="new" sentence="Sort the points from left to right first." must_say=["sort"] kind="value"
def convex_hull(points):
    corners = []
    ordered = points.tolist()
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            while len(chain) >= 2 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
            chain.append(point)
        corners += chain[:-1]
    return np.array(corners)

# %% name="sorted by x only" origin="new" sentence="Of points with the same x, the one with the smaller y comes first." must_say=["same x"] kind="value"
def convex_hull(points):
    corners = []
    ordered = sorted(points.tolist(), key=lambda p: p[0])
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            while len(chain) >= 2 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
            chain.append(point)
        corners += chain[:-1]
    return np.array(corners)

# %% name="one chain for both sides" origin="new" sentence="The lower side needs a new chain." must_say=["new.* chain"] kind="value"
def convex_hull(points):
    ordered = sorted(points.tolist())
    chain = []
    for side in (ordered, ordered[::-1]):
        for point in side:
            while len(chain) >= 2 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
            chain.append(point)
    return np.array(chain)

# %% name="sorted result" origin="new" sentence="The corners are right; their order is not. Do not sort them at the end." must_say=["order|sort"] kind="value"
def convex_hull(points):
    corners = []
    ordered = sorted(points.tolist())
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            while len(chain) >= 2 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
            chain.append(point)
        corners += chain
    return np.unique(np.array(corners), axis=0)

# %% name="bounding box" origin="new" sentence="The corners of the hull are points of the input, not the corners of the bounding box." must_say=["bounding box|points of the input"] kind="value"
def convex_hull(points):
    x0, y0 = points.min(axis=0)
    x1, y1 = points.max(axis=0)
    return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])

# %% name="np.sort" origin="new" sentence="np.sort along axis 0 sorts x and y by themselves, and tears the points apart." must_say=["apart|themselves"] kind="value"
def convex_hull(points):
    corners = []
    ordered = np.sort(points, axis=0).tolist()
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            while len(chain) >= 2 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
            chain.append(point)
        corners += chain[:-1]
    return np.array(corners)

# %% name="append before the look" origin="new" sentence="Look at the turn before you add the new point." must_say=["before|after|first"] kind="shape"
def convex_hull(points):
    corners = []
    ordered = sorted(points.tolist())
    for side in (ordered, ordered[::-1]):
        chain = []
        for point in side:
            chain.append(point)
            while len(chain) >= 2 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
        corners += chain[:-1]
    return np.array(corners)

# %% name="chain[-1] for the first argument" origin="new" sentence="Look at the last two points of the chain: one point alone has no index -2." must_say=["two points|index|-2|empty"] kind="error"
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

# %% name="no return" origin="new" sentence="Return the corners." must_say=["return"] kind="no-return"
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

# %% name="lower side with left turns" origin="walk" sentence="The lower side also turns to the right when you go from right to left." must_say=["lower side", "right"] kind="value"
def convex_hull(points):
    points = sorted(points.tolist())
    upper = []
    for p in points:
        while len(upper) >= 2 and turn(upper[-2], upper[-1], p) <= 0:
            upper.pop()
        upper.append(p)
    lower = []
    for p in reversed(points):
        while len(lower) >= 2 and turn(lower[-2], lower[-1], p) >= 0:
            lower.pop()
        lower.append(p)
    return np.array(upper[:-1] + lower[:-1])

# %% name="one chain forth and back" origin="walk" sentence="The lower side needs a chain of its own." must_say=["new.* chain|chain of its own"] kind="shape"
def convex_hull(points):
    pts = sorted(points.tolist())
    way = pts + pts[::-1][1:]
    chain = []
    for p in way:
        while len(chain) >= 2 and turn(chain[-2], chain[-1], p) <= 0:
            chain.pop()
        chain.append(p)
    return np.array(chain[:-1])

# %% name="neighbours in the sorted list" origin="walk" sentence="Look at the last two points of the chain, not of the list." must_say=["chain"] kind="shape"
def convex_hull(points):
    p = sorted(points.tolist())
    upper = [p[0]]
    for i in range(1, len(p) - 1):
        if turn(p[i - 1], p[i], p[i + 1]) > 0:
            upper.append(p[i])
    upper.append(p[-1])
    q = p[::-1]
    lower = [q[0]]
    for i in range(1, len(q) - 1):
        if turn(q[i - 1], q[i], q[i + 1]) > 0:
            lower.append(q[i])
    return np.array(upper + lower[1:])
