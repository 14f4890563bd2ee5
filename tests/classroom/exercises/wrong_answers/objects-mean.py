# %% name="distances" sentence="Return the classes, not the distances." must_say=["class"] kind="type"
def nearest_mean(vectors, classes, new):
    means = np.array([vectors[classes == c].mean(axis=0) for c in np.unique(classes)])
    return np.linalg.norm(new[:, None] - means, axis=2).min(axis=1)
