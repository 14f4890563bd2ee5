# %% name="mean of columns" origin="fresh" sentence="axis=0 computes along the rows, one number for each column; you need axis=1." must_say=["axis|each column|every column|columns"] kind="shape"
def row_means(gray):
    return np.mean(gray, 0)

# %% name="whole division" origin="fresh" sentence="// drops the fraction: use / or mean(axis=1)." must_say=["//|fraction|round|whole|decimal|truncat"] must_not_say=["axis=0|wrap"] kind="value"
def row_means(gray):
    width = gray.shape[1]
    return (gray.sum(axis=1) // width).astype(np.float64)

# %% name="divides by the height" origin="fresh" sentence="The mean of a row divides by the number of its pixels, the width; you divide by the height." must_say=["width|shape\\[1\\]|number of columns|height|columns"] must_not_say=["wrap|axis=0"] kind="value"
def row_means(gray):
    height, width = gray.shape
    return gray.sum(axis=1) / height

# %% name="adding in uint8" origin="fresh" sentence="The sum stays uint8 and wraps around at 256; widen first, or use mean(axis=1)." must_say=["wrap|uint8|256|overflow|widen"] must_not_say=["axis=0"] kind="value"
def row_means(gray):
    height, width = gray.shape
    total = gray[:, 0]
    for col in range(1, width):
        total = total + gray[:, col]
    return total / width

# %% name="axis=0 gives the means of the columns" origin="fresh" sentence="axis=0 gives the means of the columns, not of the rows." must_say=["axis"] kind="shape"
def row_means(gray):
    return gray.mean(axis=0)

# %% name="Without axis the mean of the whole image comes back" origin="fresh" sentence="Without axis the mean of the whole image comes back: one number, not one for each row." must_say=["axis"] kind="type"
def row_means(gray):
    return gray.mean()

# %% name="Returns the sum of each row" origin="fresh" sentence="Returns the sum of each row, not the mean." must_say=["sum of each row"] kind="value"
def row_means(gray):
    return gray.sum(axis=1)

# %% name="Whole-number division // cuts off the fraction " origin="fresh" sentence="Whole-number division // cuts off the fraction (and gives integers, not float64)." must_say=["//|cut off"] kind="value"
def row_means(gray):
    height, width = gray.shape
    return gray.sum(axis=1) // width

# %% name="Divides each row sum by the number of rows instead of the" origin="fresh" sentence="Divides each row sum by the number of rows instead of the number of columns: right only for a square image." must_say=["number of rows"] kind="value"
def row_means(gray):
    return gray.sum(axis=1) / gray.shape[0]

# %% name="The function has the wrong name " origin="fresh" sentence="The function has the wrong name (row_mean), so row_means does not exist or is still the old one." must_say=["name|old function"] kind="other-name"
def row_mean(gray):
    return gray.mean(axis=1)

# %% name="Converts the means to uint8" origin="fresh" sentence="Converts the means to uint8, so the fractions are lost and the dtype is wrong." must_say=["uint8|integer dtype"] kind="dtype"
def row_means(gray):
    means = gray.mean(axis=1)
    return means.astype(np.uint8)

# %% name="return is inside the loop" origin="fresh" sentence="return is inside the loop, so only the mean of the first row is in the result." must_say=["inside"] kind="shape"
def row_means(gray):
    means = []
    for row in gray:
        means.append(row.mean())
        return np.array(means)

# %% name="Prints the means instead of returning them" origin="fresh" sentence="Prints the means instead of returning them." must_say=["print"] kind="no-return"
def row_means(gray):
    means = gray.mean(axis=1)
    print(means)

# %% name="Adds the uint8 pixels one by one in uint8" origin="fresh" sentence="Adds the uint8 pixels one by one in uint8, so the total overflows above 255." must_say=["overflow"] kind="value"
def row_means(gray):
    height, width = gray.shape
    means = np.zeros(height)
    for row in range(height):
        total = gray[row, 0]
        for col in range(1, width):
            total = total + gray[row, col]
        means[row] = total / width
    return means
