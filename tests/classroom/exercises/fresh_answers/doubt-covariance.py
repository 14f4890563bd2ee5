# %% name="std of the columns" origin="fresh" sentence="These are standard deviations; a matrix of variances and covariances is asked for." must_say=["covarianc|varianc|shape"] kind="shape"
def covariance(samples):
    return samples.std(axis=0)

# %% name="cov without transpose" origin="fresh" sentence="np.cov wants the numbers in rows: samples.T, and bias=True." must_say=["row|shape|\\.T"] kind="shape"
def covariance(samples):
    return np.cov(samples, bias=True)

# %% name="mean of everything" origin="fresh" sentence="Each place of the matrix has its own sum of products." must_say=["matrix|shape|number|array|each"] kind="type"
def covariance(samples):
    d = samples - samples.mean(axis=0)
    return (d * d).mean()

# %% name="divided by N twice" origin="fresh" sentence="Divide by the number of measurements once." must_say=["divid|smaller|times|factor"] kind="value"
def covariance(samples):
    d = samples - samples.mean(axis=0)
    return d.T @ d / len(samples) ** 2

# %% name="deviations not squared in the diagonal" origin="fresh" sentence="The diagonal has the variances, not the standard deviations." must_say=["varianc|diagonal"] kind="value"
def covariance(samples):
    d = samples - samples.mean(axis=0)
    C = d.T @ d / len(samples)
    for k in range(len(C)):
        C[k, k] = math.sqrt(C[k, k])
    return C
