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
