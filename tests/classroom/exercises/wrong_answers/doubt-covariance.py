# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def covariance(samples):
    d = samples - samples.mean(axis=0)
    C = d.T @ d / len(samples)

# %% name="product of values" origin="new" sentence="d.T * d multiplies value by value: use @." must_say=["@|shape|fit"] kind="error"
def covariance(samples):
    d = samples - samples.mean(axis=0)
    return d.T * d / len(samples)

# %% name="two columns only" origin="new" sentence="It must work for any number of columns." must_say=["column|shape|size"] kind="error"
def covariance(samples):
    a = samples[:, 0] - samples[:, 0].mean()
    b = samples[:, 1] - samples[:, 1].mean()
    return np.array([[(a * a).mean(), (a * b).mean()], [(a * b).mean(), (b * b).mean()]])

# %% name="median" origin="new" sentence="Subtract the mean, not the median." must_say=["mean"] kind="value"
def covariance(samples):
    d = samples - np.median(samples, axis=0)
    return d.T @ d / len(samples)
