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
