# %% name="places only" sentence="Most points must fit as well: look at the share." must_say=["share"] kind="value"
def find_loops(places, shares, radius, gap, least):
    return [(i, j) for i in range(len(places)) for j in range(i + gap, len(places)) if math.dist(places[i], places[j]) <= radius]

# %% name="count" sentence="Return the list of pairs, not how many." must_say=["list|pairs"] kind="type"
def find_loops(places, shares, radius, gap, least):
    count = 0
    for i in range(len(places)):
        for j in range(i + gap, len(places)):
            if math.dist(places[i], places[j]) <= radius and shares[i, j] >= least:
                count += 1
    return count

# %% name="shares only" sentence="The places must be near each other as well." must_say=["near|dist"] kind="value"
def find_loops(places, shares, radius, gap, least):
    return [(i, j) for i in range(len(places)) for j in range(i + gap, len(places)) if shares[i, j] >= least]

# %% name="only the last pose" sentence="Every later pose can close a loop, not only the last one." must_say=["last|every later|all"] kind="value"
def find_loops(places, shares, radius, gap, least):
    j = len(places) - 1
    return [(i, j) for i in range(j - gap + 1) if math.dist(places[i], places[j]) <= radius and shares[i, j] >= least]

# %% name="only neighbours" sentence="At least gap poses apart: from i + gap on." must_say=["gap"] kind="value"
def find_loops(places, shares, radius, gap, least):
    loops = []
    for i in range(len(places)):
        for j in range(i + 1, min(i + gap + 1, len(places))):
            if math.dist(places[i], places[j]) <= radius and shares[i, j] >= least:
                loops.append((i, j))
    return loops
