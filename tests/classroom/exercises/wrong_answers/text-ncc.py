# %% name="no normalization" sentence="Divide by the root of both sums of squares." must_say=["divide|root|normal"] kind="value"
def ncc(a, b):
    return float(((a - a.mean()) * (b - b.mean())).sum())

# %% name="no sum" sentence="Add the products with .sum(): the result is one number." must_say=["sum|one number|number"] kind="type"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    root = np.sqrt((a * a).sum() * (b * b).sum())
    return 0.0 if root == 0 else a * b / root

# %% name="no return" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    root = np.sqrt((a * a).sum() * (b * b).sum())
    result = 0.0 if root == 0 else float((a * b).sum() / root)

# %% name="matrix product" sentence="Multiply pixel by pixel with *, not @." must_say=["@|pixel by pixel|\\*"] kind="error"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    root = np.sqrt((a @ a).sum() * (b @ b).sum())
    return 0.0 if root == 0 else float((a @ b).sum() / root)

# %% name="clipped" sentence="The NCC can be negative." must_say=["negative"] kind="value"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    root = np.sqrt((a * a).sum() * (b * b).sum())
    return 0.0 if root == 0 else float(np.clip((a * b).sum() / root, 0, 1))
