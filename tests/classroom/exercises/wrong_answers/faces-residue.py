# %% name="sum squared" sentence="Square each difference before you add." must_say=["square"] kind="value"
def residue(vector, mean, directions):
    weights = directions @ (vector - mean)
    rebuilt = mean + weights @ directions
    return np.sqrt((vector - rebuilt).sum() ** 2)

# %% name="times instead of @" sentence="* multiplies value by value: use @." must_say=["@"] kind="value"
def residue(vector, mean, directions):
    weights = directions * (vector - mean)
    rebuilt = mean + weights * directions
    return np.sqrt(((vector - rebuilt) ** 2).sum())
