# %% name="sum squared" sentence="Square each difference before you add." must_say=["square"] kind="value"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    rebuilt = mean + weights @ directions
    return np.sqrt((vector - rebuilt).sum() ** 2)

# %% name="vector of what is left" sentence="Return the length, one number." must_say=["length|one number"] kind="type"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    return vector - (mean + weights @ directions)

# %% name="no return" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    print(np.linalg.norm(vector - (mean + weights @ directions)))

# %% name="directions exchanged" sentence="The directions come first: directions @ (vector - mean)." must_say=["directions @|shape|dimension|match"] kind="error"
def residue(vector, mean, directions):
    weights = (vector - mean) @ directions
    rebuilt = mean + weights @ directions
    return float(np.linalg.norm(vector - rebuilt))

# %% name="times instead of @" sentence="* multiplies value by value: use @." must_say=["@"] kind="value"
def residue(vector, mean, directions):
    weights = directions * (vector - mean)
    rebuilt = mean + weights * directions
    return np.sqrt(((vector - rebuilt) ** 2).sum())
