# %% name="std of the columns" sentence="These are standard deviations; a matrix of variances and covariances is asked for." must_say=["covarianc|varianc|shape"] kind="shape"
def covariance(samples):
    return samples.std(axis=0)

# %% name="product of values" sentence="d.T * d multiplies value by value: use @." must_say=["@|shape|fit"] kind="error"
def covariance(samples):
    d = samples - samples.mean(axis=0)
    return d.T * d / len(samples)
