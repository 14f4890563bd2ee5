# %% name="cosine" origin="new" sentence="Subtract the mean of each image first." must_say=["mean"] kind="value"
def ncc(a, b):
    root = np.sqrt((a ** 2).sum() * (b ** 2).sum())
    return 0.0 if root == 0 else float((a * b).sum() / root)

# %% name="no normalization" origin="new" sentence="Divide by the root of both sums of squares." must_say=["divide|root|normal"] kind="value"
def ncc(a, b):
    return float(((a - a.mean()) * (b - b.mean())).sum())

# %% name="covariance" origin="new" sentence="The mean of the products is not enough: divide by the root of both sums of squares." must_say=["root|divide"] kind="value"
def ncc(a, b):
    return float(((a - a.mean()) * (b - b.mean())).mean())

# %% name="no root" origin="new" sentence="The square root is missing." must_say=["root"] kind="value"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    below = (a * a).sum() * (b * b).sum()
    return 0.0 if below == 0 else float((a * b).sum() / below)

# %% name="nan" origin="new" sentence="If one image has only one value, you divide by 0: return 0.0 then." must_say=["return 0\\.0|0\\.0"] kind="value"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    with np.errstate(all="ignore"):
        return float((a * b).sum() / np.sqrt((a * a).sum() * (b * b).sum()))

# %% name="abs" origin="new" sentence="Leave abs out: a negative has the NCC -1." must_say=["abs|-1|negative"] kind="value"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    root = np.sqrt((a * a).sum() * (b * b).sum())
    return 0.0 if root == 0 else abs(float((a * b).sum() / root))

# %% name="a only" origin="new" sentence="Subtract the mean of b from b too." must_say=["mean of b|mean"] kind="value"
def ncc(a, b):
    a = a - a.mean()
    root = np.sqrt((a * a).sum() * (b * b).sum())
    return 0.0 if root == 0 else float((a * b).sum() / root)

# %% name="sum of squares added" origin="new" sentence="Multiply the two sums of squares, do not add them." must_say=["multiply"] kind="value"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    root = np.sqrt((a * a).sum() + (b * b).sum())
    return 0.0 if root == 0 else float((a * b).sum() / root)

# %% name="no sum" origin="new" sentence="Add the products with .sum(): the result is one number." must_say=["sum|one number|number"] kind="type"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    root = np.sqrt((a * a).sum() * (b * b).sum())
    return 0.0 if root == 0 else a * b / root

# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    root = np.sqrt((a * a).sum() * (b * b).sum())
    result = 0.0 if root == 0 else float((a * b).sum() / root)

# %% name="std with ddof" origin="new" sentence="Use the sums of the formula: ddof=1 divides by N - 1." must_say=["N - 1|ddof|too small|sums"] kind="value"
def ncc(a, b):
    below = a.std(ddof=1) * b.std(ddof=1)
    return 0.0 if below == 0 else float(((a - a.mean()) * (b - b.mean())).mean() / below)

# %% name="squared differences" origin="new" sentence="Add the products of the two images, do not subtract one from the other." must_say=["products"] kind="value"
def ncc(a, b):
    return float(((a - b) ** 2).sum())

# %% name="one for constants" origin="new" sentence="An image without form has the NCC 0.0." must_say=["0\\.0"] kind="value"
def ncc(a, b):
    a, b = a - a.mean(), b - b.mean()
    root = np.sqrt((a * a).sum() * (b * b).sum())
    return 1.0 if root == 0 else float((a * b).sum() / root)
