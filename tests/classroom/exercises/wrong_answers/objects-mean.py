# %% name="classes at the positions" sentence="The positions belong to np.unique(classes), not to classes." must_say=["np.unique", "position"] kind="value"
def nearest_mean(vectors, classes, new):
    means = np.array([vectors[classes == k].mean(axis=0) for k in np.unique(classes)])
    return classes[((new[:, None] - means) ** 2).sum(axis=2).argmin(axis=1)]

# %% name="distances" sentence="Return the classes, not the distances." must_say=["class"] kind="type"
def nearest_mean(vectors, classes, new):
    means = np.array([vectors[classes == c].mean(axis=0) for c in np.unique(classes)])
    return np.linalg.norm(new[:, None] - means, axis=2).min(axis=1)

# %% name="axis 1" sentence="The mean of the vectors needs axis=0." must_say=["axis|shape"] kind="error"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].mean(axis=1) for c in numbers])
    return numbers[((new[:, None] - means) ** 2).sum(axis=2).argmin(axis=1)]

# %% name="first only" sentence="Return one class for each new vector." must_say=["each new vector"] kind="shape"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].mean(axis=0) for c in numbers])
    return numbers[[((new[0] - means) ** 2).sum(axis=1).argmin()]]

# %% name="no return" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].mean(axis=0) for c in numbers])
    result = numbers[((new[:, None] - means) ** 2).sum(axis=2).argmin(axis=1)]
