# %% name="median" sentence="Subtract the mean, not the median." must_say=["mean"] kind="value"
def covariance(samples):
    d = samples - np.median(samples, axis=0)
    return d.T @ d / len(samples)

# %% name="std of the columns" sentence="These are standard deviations; a matrix of variances and covariances is asked for." must_say=["covarianc|varianc|shape"] kind="shape"
def covariance(samples):
    return samples.std(axis=0)

# %% name="no return" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def covariance(samples):
    d = samples - samples.mean(axis=0)
    C = d.T @ d / len(samples)

# %% name="product of values" sentence="d.T * d multiplies value by value: use @." must_say=["@|shape|fit"] kind="error"
def covariance(samples):
    d = samples - samples.mean(axis=0)
    return d.T * d / len(samples)

# %% name="mean of everything" sentence="Each place of the matrix has its own sum of products." must_say=["matrix|shape|number|array|each"] kind="type"
def covariance(samples):
    d = samples - samples.mean(axis=0)
    return (d * d).mean()
