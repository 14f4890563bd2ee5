# %% name="median" origin="fresh" sentence="Take the mean, not the median." must_say=["mean"] kind="value"
def mean_rotation(rotations):
    U, s, V = np.linalg.svd(np.median(rotations, axis=0))
    return U @ V

# %% name="rows made 1 long" origin="fresh" sentence="The rows are then not perpendicular: use U @ V." must_say=["U @ V|SVD|perpendicular"] kind="value"
def mean_rotation(rotations):
    mean = rotations.mean(axis=0)
    return mean / np.linalg.norm(mean, axis=1)[:, np.newaxis]

# %% name="angle of the plane only" origin="fresh" sentence="It must work for three rows and columns too." must_say=["room|three|shape|size|3"] kind="shape"
def mean_rotation(rotations):
    mean = rotations.mean(axis=0)
    angle = math.atan2(mean[1, 0], mean[0, 0])
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])

# %% name="U alone" origin="fresh" sentence="U is only one of the two rotations: U @ V." must_say=["V"] kind="value"
def mean_rotation(rotations):
    U, s, V = np.linalg.svd(rotations.mean(axis=0))
    return U

# %% name="last of many" origin="fresh" sentence="All rotations count: take their mean." must_say=["mean|all"] kind="value"
def mean_rotation(rotations):
    U, s, V = np.linalg.svd(rotations[-1])
    return U @ V
