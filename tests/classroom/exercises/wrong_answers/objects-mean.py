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

# %% name="in the order of appearance" origin="walk" sentence="The means are in the order of np.unique, the classes in the order in which they come: use one list for both." must_say=["order"] kind="value"
def nearest_mean(vectors, classes, new):
    names = []
    for c in classes:
        if c not in names:
            names.append(c)
    means = np.array([vectors[classes == k].mean(axis=0) for k in np.unique(classes)])
    return np.array(names)[((new[:, None] - means) ** 2).sum(axis=2).argmin(axis=1)]

# %% name="sum before the square" origin="walk" sentence="Square the differences before you add them." must_say=["square"] must_not_say=["^Each of your means is one number"] kind="value"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == k].mean(axis=0) for k in numbers])
    result = []
    for v in new:
        distances = [np.sqrt((v - m).sum() ** 2) for m in means]
        result.append(numbers[np.argmin(distances)])
    return np.array(result)

# %% name="twelve classes" origin="walk" sentence="Classes that do not occur have the mean nan: use np.unique(classes)." must_say=["np.unique", "nan|occur"] kind="value"
def nearest_mean(vectors, classes, new):
    means = np.array([vectors[classes == place].mean(axis=0) for place in range(12)])
    return ((new[:, None] - means) ** 2).sum(axis=2).argmin(axis=1)

# %% name="best not set back" origin="walk" sentence="Begin with a large distance again for each new vector." must_say=["begin", "new vector"] kind="value"
def nearest_mean(vectors, classes, new):
    result = np.zeros(len(new), int)
    best = 1e9
    for i in range(len(new)):
        for k in np.unique(classes):
            d = np.sqrt(((new[i] - vectors[classes == k].mean(axis=0)) ** 2).sum())
            if d < best:
                best = d
                result[i] = k
    return result

# %% name="classes at the positions" origin="walk" sentence="The positions belong to np.unique(classes), not to classes." must_say=["np.unique", "position"] kind="value"
def nearest_mean(vectors, classes, new):
    means = np.array([vectors[classes == k].mean(axis=0) for k in np.unique(classes)])
    return classes[((new[:, None] - means) ** 2).sum(axis=2).argmin(axis=1)]
