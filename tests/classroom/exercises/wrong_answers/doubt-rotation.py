# %% name="last of many" sentence="All rotations count: take their mean." must_say=["mean|all"] kind="value"
def mean_rotation(rotations):
    U, s, V = np.linalg.svd(rotations[-1])
    return U @ V

# %% name="no return" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def mean_rotation(rotations):
    U, s, V = np.linalg.svd(rotations.mean(axis=0))
    R = U @ V

# %% name="angle of the plane only" sentence="It must work for three rows and columns too." must_say=["room|three|shape|size|3"] kind="shape"
def mean_rotation(rotations):
    mean = rotations.mean(axis=0)
    angle = math.atan2(mean[1, 0], mean[0, 0])
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])

# %% name="mean of the SVDs" sentence="Take the mean first, then the SVD." must_say=["mean"] kind="value"
def mean_rotation(rotations):
    U, s, V = np.linalg.svd(rotations)
    return (U @ V).mean(axis=0)

# %% name="mean of the angles" sentence="Angles jump at pi: take the mean of the matrices." must_say=["angle.*pi"] kind="value"
def mean_rotation(rotations):
    angles = [math.atan2(rotation[1, 0], rotation[0, 0]) for rotation in rotations]
    angle = sum(angles) / len(angles)
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
