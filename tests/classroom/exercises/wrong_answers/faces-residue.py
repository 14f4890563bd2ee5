# %% name="mean not subtracted" origin="new" sentence="Subtract the mean before you compute the weights." must_say=["subtract the mean"] kind="value"
def residue(vector, mean, directions):
    weights = directions @ vector
    rebuilt = mean + weights @ directions
    return float(np.sqrt(((vector - rebuilt) ** 2).sum()))

# %% name="mean not added" origin="new" sentence="Add the mean when you rebuild the vector." must_say=["add the mean"] kind="value"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    rebuilt = weights @ directions
    return float(np.sqrt(((vector - rebuilt) ** 2).sum()))

# %% name="no mean at all" origin="new" sentence="The mean is missing." must_say=["mean"] kind="value"
def residue(vector, mean, directions):
    rebuilt = (directions @ vector) @ directions
    return float(np.sqrt(((vector - rebuilt) ** 2).sum()))

# %% name="no root" origin="new" sentence="Take the square root." must_say=["root"] kind="value"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    rebuilt = mean + weights @ directions
    return float(((vector - rebuilt) ** 2).sum())

# %% name="mean squared error" origin="new" sentence="It is the root of the sum of the squares, not their mean." must_say=["sum|mean", "root"] kind="value"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    rebuilt = mean + weights @ directions
    return float(((vector - rebuilt) ** 2).mean())

# %% name="rms" origin="new" sentence="It is the root of the sum, not of the mean." must_say=["sum"] kind="value"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    rebuilt = mean + weights @ directions
    return float(np.sqrt(((vector - rebuilt) ** 2).mean()))

# %% name="absolute values" origin="new" sentence="The residue is the L2 norm." must_say=["L2"] kind="value"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    rebuilt = mean + weights @ directions
    return float(np.abs(vector - rebuilt).sum())

# %% name="norm of the weights" origin="new" sentence="The residue is the length of what is left over, not of the weights." must_say=["weights", "left over|rebuilt"] kind="value"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    return float(np.linalg.norm(weights))

# %% name="distance to the mean" origin="new" sentence="Compare the vector with the rebuilt one, not with the mean." must_say=["rebuilt"] kind="value"
def residue(vector, mean, directions):
    return float(np.linalg.norm(vector - mean))

# %% name="rebuilt compared with the difference twice" origin="new" sentence="rebuilt has the mean in it: compare it with the vector itself." must_say=["mean|vector - rebuilt|wrong two"] kind="value"
def residue(vector, mean, directions):
    difference = vector - mean
    weights = directions @ difference
    rebuilt = mean + weights @ directions
    return float(np.linalg.norm(difference - rebuilt))

# %% name="directions exchanged" origin="new" sentence="The directions come first: directions @ (vector - mean)." must_say=["directions @|shape|dimension|match"] kind="error"
def residue(vector, mean, directions):
    weights = (vector - mean) @ directions
    rebuilt = mean + weights @ directions
    return float(np.linalg.norm(vector - rebuilt))

# %% name="only one direction" origin="new" sentence="Use all directions, each with its own weight." must_say=["all directions|first direction"] kind="value"
def residue(vector, mean, directions):
    weight = (directions[0] * (vector - mean)).sum()
    rebuilt = mean + weight * directions[0]
    return float(np.linalg.norm(vector - rebuilt))

# %% name="vector of what is left" origin="new" sentence="Return the length, one number." must_say=["length|one number"] kind="type"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    return vector - (mean + weights @ directions)

# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    print(np.linalg.norm(vector - (mean + weights @ directions)))

# %% name="times instead of @" origin="walk" sentence="* multiplies value by value: use @." must_say=["@"] kind="value"
def residue(vector, mean, directions):
    weights = directions * (vector - mean)
    rebuilt = mean + weights * directions
    return np.sqrt(((vector - rebuilt) ** 2).sum())

# %% name="rounded" origin="walk" sentence="Do not round the length." must_say=["round"] kind="value"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    rebuilt = mean + weights @ directions
    return round(np.sqrt(((vector - rebuilt) ** 2).sum()), 2)

# %% name="sum squared" origin="walk" sentence="Square each difference before you add." must_say=["square"] kind="value"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    rebuilt = mean + weights @ directions
    return np.sqrt((vector - rebuilt).sum() ** 2)
