# %% name="Chebyshev" origin="fresh" sentence="Add the squares of all differences, not the largest one." must_say=["square"] kind="value"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].mean(axis=0) for c in numbers])
    return numbers[abs(new[:, None] - means).max(axis=2).argmin(axis=1)]

# %% name="range of classes" origin="fresh" sentence="The classes are not always 0, 1, 2: use np.unique(classes)." must_say=["class|unique|nan"] kind="value"
def nearest_mean(vectors, classes, new):
    count = len(np.unique(classes))
    means = np.array([vectors[classes == c].mean(axis=0) if (classes == c).any() else vectors[0] for c in range(count)])
    return ((new[:, None] - means) ** 2).sum(axis=2).argmin(axis=1)

# %% name="dot product" origin="fresh" sentence="Take the smallest distance, not the largest product." must_say=["distance"] kind="value"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == c].mean(axis=0) for c in numbers])
    return numbers[(new @ means.T).argmax(axis=1)]

# %% name="most frequent" origin="fresh" sentence="Compare each new vector with the means." must_say=["mean"] kind="value"
def nearest_mean(vectors, classes, new):
    numbers, counts = np.unique(classes, return_counts=True)
    return np.full(len(new), numbers[counts.argmax()])

# %% name="first vector" origin="fresh" sentence="Take the mean of all vectors of the class, not the first one." must_say=["mean"] kind="value"
def nearest_mean(vectors, classes, new):
    numbers, first = np.unique(classes, return_index=True)
    return numbers[((new[:, None] - vectors[first]) ** 2).sum(axis=2).argmin(axis=1)]

# %% name="sum for mean" origin="fresh" sentence="The sum is not the mean: divide by the number of vectors of the class." must_say=["mean"] kind="value"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors[classes == number].sum(axis=0) for number in numbers])
    distances = ((new[:, None] - means) ** 2).sum(axis=2)
    return numbers[distances.argmin(axis=1)]

# %% name="mean of all vectors" origin="fresh" sentence="The mean must be taken of the vectors of one class: vectors[classes == number]." must_say=["class"] kind="value"
def nearest_mean(vectors, classes, new):
    numbers = np.unique(classes)
    means = np.array([vectors.mean(axis=0) for number in numbers])
    distances = ((new[:, None] - means) ** 2).sum(axis=2)
    return numbers[distances.argmin(axis=1)]
# %% name="place, not class" origin="fresh" sentence="argmin gives the place among the means; the class is np.unique(classes) at this place." must_say=["argmin|place|position|index|class"] kind="value"
def nearest_mean(vectors, classes, new):
    names = np.unique(classes)
    means = np.array([vectors[classes == number].mean(axis=0) for number in names])
    distances = np.sqrt(((new[:, None] - means) ** 2).sum(axis=2))
    return distances.argmin(axis=1)
# %% name="classes from 0 on" origin="fresh" sentence="Not every number from 0 on is a class: the mean of no vectors is nan." must_say=["nan|empty|unique|0, 1, 2|no vector"] kind="value"
def nearest_mean(vectors, classes, new):
    means = []
    for number in range(classes.max() + 1):
        means.append(vectors[classes == number].mean(axis=0))
    means = np.array(means)
    distances = np.sqrt(((new[:, None] - means) ** 2).sum(axis=2))
    return distances.argmin(axis=1)
# %% name="nearest vector" origin="fresh" sentence="You take the class of the nearest single vector, not that of the nearest mean." must_say=["mean"] kind="value"
def nearest_mean(vectors, classes, new):
    distances = np.sqrt(((new[:, None] - vectors) ** 2).sum(axis=2))
    return classes[distances.argmin(axis=1)]
# %% name="mean of everything" origin="fresh" sentence="mean() without an axis gives one number; it needs axis=0, one number for each column." must_say=["axis"] kind="value"
def nearest_mean(vectors, classes, new):
    names = np.unique(classes)
    means = np.array([vectors[classes == number].mean() for number in names])
    result = []
    for vector in new:
        distances = [np.sqrt(((vector - mean) ** 2).sum()) for mean in means]
        result.append(names[np.argmin(distances)])
    return np.array(result)
# %% name="no square" origin="fresh" sentence="The differences must be squared before they are added; else plus and minus cancel." must_say=["square|\\*\\* ?2|cancel|negative|Euclid"] kind="value"
def nearest_mean(vectors, classes, new):
    names = np.unique(classes)
    means = np.array([vectors[classes == number].mean(axis=0) for number in names])
    distances = (new[:, None] - means).sum(axis=2)
    return names[distances.argmin(axis=1)]
# %% name="only the first new vector" origin="fresh" sentence="Only new[0] is classified; the result needs one class for each new vector." must_say=["each|first|every|all|new\\[0\\]"] kind="shape"
def nearest_mean(vectors, classes, new):
    best, nearest = None, 1e9
    for number in np.unique(classes):
        mean = vectors[classes == number].mean(axis=0)
        distance = np.sqrt(((new[0] - mean) ** 2).sum())
        if distance < nearest:
            best, nearest = number, distance
    return np.array([best])
# %% name="argmax" origin="fresh" sentence="argmax takes the farthest mean; the nearest has the smallest distance." must_say=["argmax|argmin|smallest|farthest|largest"] kind="value"
def nearest_mean(vectors, classes, new):
    names = np.unique(classes)
    means = np.array([vectors[classes == number].mean(axis=0) for number in names])
    distances = np.sqrt(((new[:, None] - means) ** 2).sum(axis=2))
    return names[distances.argmax(axis=1)]
# %% name="sum over the classes" origin="fresh" sentence="The sum must go over the numbers, axis 2, not over the classes, axis 1." must_say=["axis"] kind="value"
def nearest_mean(vectors, classes, new):
    names = np.unique(classes)
    means = np.array([vectors[classes == number].mean(axis=0) for number in names])
    distances = np.sqrt(((new[:, None] - means) ** 2).sum(axis=1))
    return names[distances.argmin(axis=1)]
# %% name="return in the loop" origin="fresh" sentence="The return stands in the loop, so only the first new vector gets a class." must_say=["return", "loop"] kind="shape"
def nearest_mean(vectors, classes, new):
    names = np.unique(classes)
    means = [vectors[classes == number].mean(axis=0) for number in names]
    result = []
    for vector in new:
        distances = [np.sqrt(((vector - mean) ** 2).sum()) for mean in means]
        result.append(names[np.argmin(distances)])
        return np.array(result)
# %% name="sum of absolute differences" origin="fresh" sentence="The Euclidean distance squares the differences; you add their absolute values." must_say=["Euclid|square|\\*\\* ?2"] kind="value"
def nearest_mean(vectors, classes, new):
    names = np.unique(classes)
    means = np.array([vectors[classes == number].mean(axis=0) for number in names])
    distances = np.abs(new[:, None] - means).sum(axis=2)
    return names[distances.argmin(axis=1)]
