# %% name="product of values" sentence="d.T * d multiplies value by value: use @." must_say=["@|shape|fit"] kind="error"
def covariance(samples):
    d = samples - samples.mean(axis=0)
    return d.T * d / len(samples)
