# %% name="no normalization" sentence="Divide by the root of both sums of squares." must_say=["divide|root|normal"] kind="value"
def ncc(a, b):
    return float(((a - a.mean()) * (b - b.mean())).sum())

# %% name="clipped" sentence="The NCC can be negative." must_say=["negative"] kind="value"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    root = np.sqrt((a * a).sum() * (b * b).sum())
    return 0.0 if root == 0 else float(np.clip((a * b).sum() / root, 0, 1))
