# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def mean_rotation(rotations):
    U, s, V = np.linalg.svd(rotations.mean(axis=0))
    R = U @ V

# %% name="mean over everything" origin="new" sentence="Take the mean over axis 0: it is a matrix." must_say=["axis"] kind="error"
def mean_rotation(rotations):
    U, s, V = np.linalg.svd(rotations.mean())
    return U @ V

# %% name="sum of the parts" origin="new" sentence="Multiply U and V, do not add them." must_say=["@|multipl"] kind="value"
def mean_rotation(rotations):
    U, s, V = np.linalg.svd(rotations.mean(axis=0))
    return U + V

# %% name="mean of the SVDs" origin="new" sentence="Take the mean first, then the SVD." must_say=["mean"] kind="value"
def mean_rotation(rotations):
    U, s, V = np.linalg.svd(rotations)
    return (U @ V).mean(axis=0)

# %% name="mean of the angles" origin="new" sentence="Angles jump at pi: take the mean of the matrices." must_say=["angle.*pi"] kind="value"
def mean_rotation(rotations):
    angles = [math.atan2(rotation[1, 0], rotation[0, 0]) for rotation in rotations]
    angle = sum(angles) / len(angles)
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
