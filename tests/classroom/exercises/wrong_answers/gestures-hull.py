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
