# %% name="no normalization" sentence="Divide by the root of both sums of squares." must_say=["divide|root|normal"] kind="value"
def ncc(a, b):
    return float(((a - a.mean()) * (b - b.mean())).sum())
