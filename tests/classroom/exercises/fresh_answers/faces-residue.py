# %% name="sum of differences" origin="fresh" sentence="Square the differences before you add them: they cancel out." must_say=["square|cancel"] kind="value"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    rebuilt = mean + weights @ directions
    return float((vector - rebuilt).sum())

# %% name="overwritten in the loop" origin="fresh" sentence="The loop keeps only the last direction: add with +=." must_say=["last direction|\\+="] kind="value"
def residue(vector, mean, directions):
    for direction in directions:
        weight = (direction * (vector - mean)).sum()
        rebuilt = mean + weight * direction
    return float(np.linalg.norm(vector - rebuilt))

# %% name="mean of the vector" origin="fresh" sentence="Subtract the given mean, not the mean of the numbers of the vector." must_say=["mean"] kind="value"
def residue(vector, mean, directions):
    vector = vector - vector.mean()
    rebuilt = (directions @ vector) @ directions
    return float(np.linalg.norm(vector - rebuilt))

# %% name="mean minus vector" origin="fresh" sentence="The sign is wrong: it is vector - mean." must_say=["vector - mean"] kind="value"
def residue(vector, mean, directions):
    weights = directions @ (mean - vector)
    rebuilt = mean + weights @ directions
    return float(np.linalg.norm(vector - rebuilt))

# %% name="largest difference" origin="fresh" sentence="Not the largest difference: the root of the sum of squares." must_say=["largest|sum"] kind="value"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    rebuilt = mean + weights @ directions
    return float(np.abs(vector - rebuilt).max())
