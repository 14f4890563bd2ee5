# %% name="neighbours too" origin="new" sentence="j must be at least gap poses after i." must_say=["gap"] kind="value"
def find_loops(places, shares, radius, gap, least):
    loops = []
    for i in range(len(places)):
        for j in range(i + 1, len(places)):
            if math.dist(places[i], places[j]) <= radius and shares[i, j] >= least:
                loops.append((i, j))
    return loops

# %% name="gap + 1" origin="new" sentence="A pair exactly gap poses apart counts." must_say=["exactly gap|i \\+ gap"] kind="value"
def find_loops(places, shares, radius, gap, least):
    loops = []
    for i in range(len(places)):
        for j in range(i + gap + 1, len(places)):
            if math.dist(places[i], places[j]) <= radius and shares[i, j] >= least:
                loops.append((i, j))
    return loops

# %% name="places only" origin="new" sentence="Most points must fit as well: look at the share." must_say=["share"] kind="value"
def find_loops(places, shares, radius, gap, least):
    return [(i, j) for i in range(len(places)) for j in range(i + gap, len(places)) if math.dist(places[i], places[j]) <= radius]

# %% name="shares only" origin="new" sentence="The places must be near each other as well." must_say=["near|dist"] kind="value"
def find_loops(places, shares, radius, gap, least):
    return [(i, j) for i in range(len(places)) for j in range(i + gap, len(places)) if shares[i, j] >= least]

# %% name="or" origin="new" sentence="Both conditions must be true: and." must_say=["and"] kind="value"
def find_loops(places, shares, radius, gap, least):
    loops = []
    for i in range(len(places)):
        for j in range(i + gap, len(places)):
            if math.dist(places[i], places[j]) <= radius or shares[i, j] >= least:
                loops.append((i, j))
    return loops

# %% name="less than the radius" origin="new" sentence="At most means <=." must_say=["<=|exactly"] kind="value"
def find_loops(places, shares, radius, gap, least):
    loops = []
    for i in range(len(places)):
        for j in range(i + gap, len(places)):
            if math.dist(places[i], places[j]) < radius and shares[i, j] >= least:
                loops.append((i, j))
    return loops

# %% name="more than least" origin="new" sentence="At least means >=." must_say=[">=|exactly"] kind="value"
def find_loops(places, shares, radius, gap, least):
    loops = []
    for i in range(len(places)):
        for j in range(i + gap, len(places)):
            if math.dist(places[i], places[j]) <= radius and shares[i, j] > least:
                loops.append((i, j))
    return loops

# %% name="return in the loop" origin="new" sentence="The return is inside the loop: collect all pairs first." must_say=["return|loop"] kind="value"
def find_loops(places, shares, radius, gap, least):
    loops = []
    for i in range(len(places)):
        for j in range(i + gap, len(places)):
            if math.dist(places[i], places[j]) <= radius and shares[i, j] >= least:
                loops.append((i, j))
                return loops
    return loops

# %% name="j first" origin="new" sentence="The earlier pose comes first: (i, j)." must_say=["first|earlier"] kind="value"
def find_loops(places, shares, radius, gap, least):
    loops = []
    for i in range(len(places)):
        for j in range(i + gap, len(places)):
            if math.dist(places[i], places[j]) <= radius and shares[i, j] >= least:
                loops.append((j, i))
    return loops

# %% name="shares[j, i]" origin="new" sentence="The earlier pose is the row of shares: shares[i, j]." must_say=["shares\\[i, j\\]"] kind="value"
def find_loops(places, shares, radius, gap, least):
    loops = []
    for i in range(len(places)):
        for j in range(i + gap, len(places)):
            if math.dist(places[i], places[j]) <= radius and shares[j, i] >= least:
                loops.append((i, j))
    return loops

# %% name="outer loop over j" origin="new" sentence="All pairs of i = 0 first: i is the outer loop." must_say=["order|outer"] kind="value"
def find_loops(places, shares, radius, gap, least):
    loops = []
    for j in range(len(places)):
        for i in range(j - gap + 1):
            if math.dist(places[i], places[j]) <= radius and shares[i, j] >= least:
                loops.append((i, j))
    return loops

# %% name="break after the first" origin="new" sentence="All pairs count: leave break out." must_say=["break|all pairs|first j"] kind="value"
def find_loops(places, shares, radius, gap, least):
    loops = []
    for i in range(len(places)):
        for j in range(i + gap, len(places)):
            if math.dist(places[i], places[j]) <= radius and shares[i, j] >= least:
                loops.append((i, j))
                break
    return loops

# %% name="x only" origin="new" sentence="The distance needs x and y." must_say=["x"] kind="value"
def find_loops(places, shares, radius, gap, least):
    loops = []
    for i in range(len(places)):
        for j in range(i + gap, len(places)):
            if abs(places[i][0] - places[j][0]) <= radius and shares[i, j] >= least:
                loops.append((i, j))
    return loops
