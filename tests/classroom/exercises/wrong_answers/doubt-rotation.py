# %% name="last of many" sentence="All rotations count: take their mean." must_say=["mean|all"] kind="value"
def mean_rotation(rotations):
    U, s, V = np.linalg.svd(rotations[-1])
    return U @ V

# %% name="mean of the SVDs" sentence="Take the mean first, then the SVD." must_say=["mean"] kind="value"
def mean_rotation(rotations):
    U, s, V = np.linalg.svd(rotations)
    return (U @ V).mean(axis=0)
