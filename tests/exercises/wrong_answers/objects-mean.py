# %% name="nearest neighbour" origin="new" sentence="Take the mean of each class, not single vectors." must_say=["mean"] kind="value"
def nearest_mean(vectors, classes, new):
    distances = ((new[:, None] - vectors) ** 2).sum(axis=2)
    return classes[distances.argmin(axis=1)]

# %% name="positions" origin="new" sentence="argmin gives positions: return the classes at these positions." must_say=["position"] kind="value"
def nearest_mean(vectors, classes, new):
    means = np.array([vectors[classes == c].mean(axis=0) for c in np.unique(classes)])
    return ((new[:, None] - means) ** 2).sum(axis=2).argmin(axis=1)

# %% name="argmax" origin="new" sentence="Take the smallest distance." must_say=["smallest|argmin"] kind="value"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].mean(axis=0) for c in numbers])
    return numbers[((new[:, None] - means) ** 2).sum(axis=2).argmax(axis=1)]

# %% name="sum" origin="new" sentence="Divide by the number: take the mean." must_say=["mean"] kind="value"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].sum(axis=0) for c in numbers])
    return numbers[((new[:, None] - means) ** 2).sum(axis=2).argmin(axis=1)]

# %% name="mean of all numbers" origin="new" sentence="The mean of the vectors needs axis=0." must_say=["axis=0"] kind="value"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].mean() for c in numbers])
    return numbers[abs(new.mean(axis=1)[:, None] - means).argmin(axis=1)]

# %% name="axis 1" origin="new" sentence="The mean of the vectors needs axis=0." must_say=["axis|shape"] kind="error"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].mean(axis=1) for c in numbers])
    return numbers[((new[:, None] - means) ** 2).sum(axis=2).argmin(axis=1)]

# %% name="Manhattan" origin="new" sentence="Square the differences." must_say=["square|Euclid"] kind="value"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].mean(axis=0) for c in numbers])
    return numbers[abs(new[:, None] - means).sum(axis=2).argmin(axis=1)]

# %% name="no square" origin="new" sentence="Differences with signs cancel out: square them." must_say=["square"] kind="value"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].mean(axis=0) for c in numbers])
    return numbers[(new[:, None] - means).sum(axis=2).argmin(axis=1)]

# %% name="no broadcasting" origin="new" sentence="new has M rows, means has one row for each class: use new[:, None] - means, or a loop." must_say=["shape|new\\[:, None\\]|fit"] kind="error"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].mean(axis=0) for c in numbers])
    return numbers[((new - means) ** 2).sum(axis=1).argmin()]

# %% name="first only" origin="new" sentence="Return one class for each new vector." must_say=["each new vector"] kind="shape"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].mean(axis=0) for c in numbers])
    return numbers[[((new[0] - means) ** 2).sum(axis=1).argmin()]]

# %% name="distances" origin="new" sentence="Return the classes, not the distances." must_say=["class"] kind="type"
def nearest_mean(vectors, classes, new):
    means = np.array([vectors[classes == c].mean(axis=0) for c in np.unique(classes)])
    return np.linalg.norm(new[:, None] - means, axis=2).min(axis=1)

# %% name="argmin axis 0" origin="new" sentence="Take the smallest distance of each new vector: axis=1." must_say=["axis=1"] kind="error"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].mean(axis=0) for c in numbers])
    return numbers[((new[:, None] - means) ** 2).sum(axis=2).argmin(axis=0)]

# %% name="median" origin="new" sentence="Take the mean, not the median." must_say=["mean"] kind="value"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([np.median(vectors[classes == c], axis=0) for c in numbers])
    return numbers[((new[:, None] - means) ** 2).sum(axis=2).argmin(axis=1)]

# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].mean(axis=0) for c in numbers])
    result = numbers[((new[:, None] - means) ** 2).sum(axis=2).argmin(axis=1)]
