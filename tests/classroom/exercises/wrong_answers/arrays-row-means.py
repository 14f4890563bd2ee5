# %% name="mean of the columns" origin="new" sentence="axis=0 gives one mean for each column: one for each row is axis=1." must_say=["column|axis ?= ?0", "axis ?= ?1|row"] kind="shape"
def row_means(gray):
    return gray.mean(axis=0)

# %% name="mean of the image" origin="new" sentence="Without an axis, mean gives one number for the whole image: use axis=1." must_say=["axis|whole|one number|each row", "row|axis|array"] kind="type"
def row_means(gray):
    return gray.mean()

# %% name="sum instead of mean" origin="new" sentence="You add the gray levels of each row: divide by the number of columns, or use mean." must_say=["sum|add", "mean|divid|columns"] kind="value"
def row_means(gray):
    return gray.sum(axis=1).astype(float)

# %% name="rounded to integers" origin="new" sentence="The means lost their decimals: return them as float, without astype or rounding." must_say=["decimal|round|fraction|whole|float|dtype|trunc|cut"] kind="dtype"
def row_means(gray):
    return gray.mean(axis=1).astype(np.uint8)

# %% name="divided by the number of rows" origin="new" sentence="You divide by the number of rows: a row has as many pixels as the image has columns, shape[1]." must_say=["rows?|shape\\[0\\]|len", "columns?|shape\\[1\\]|width"] kind="value"
def row_means(gray):
    return gray.sum(axis=1) / gray.shape[0]

# %% name="axis 2" origin="new" sentence="A gray image has the axes 0 and 1 only: the mean of each row is axis=1." must_say=["axis", "1|two|out of|0 and 1"] kind="error"
def row_means(gray):
    return gray.mean(axis=2)

# %% name="sum in uint8" origin="new" sentence="A sum in uint8 overflows: widen first, or use mean." must_say=["overflow|wrap|255|uint8", "widen|mean|astype|larger|uint8"] kind="value"
def row_means(gray):
    return gray.sum(axis=1, dtype=np.uint8) / gray.shape[1]

# %% name="a column vector" origin="new" sentence="keepdims keeps an axis of length 1: the shape must be (rows,)." must_say=["keepdims|axis|shape|, ?1\\)", "shape|axis|keepdims|rows"] kind="shape"
def row_means(gray):
    return gray.mean(axis=1, keepdims=True)

# %% name="median instead of mean" origin="new" sentence="The median is the middle value: the task asks for the mean." must_say=["median|middle", "mean"] kind="value"
def row_means(gray):
    return np.median(gray, axis=1)

# %% name="brightest instead of mean" origin="new" sentence="max gives the brightest pixel of each row: use mean." must_say=["max|brightest|largest", "mean|average"] kind="value"
def row_means(gray):
    return gray.max(axis=1).astype(float)

# %% name="divided with //" origin="new" sentence="// cuts the decimals: divide with /." must_say=["//|decimal|whole|integer|fraction|cut|trunc|float"] kind="value"
def row_means(gray):
    return (gray.sum(axis=1) // gray.shape[1]).astype(float)

# %% name="only the first row" origin="new" sentence="gray[0] is only the first row: take the mean of every row, with axis=1." must_say=["first row|only|one number|each row|every row|row 0", "axis|every|each|row|array"] kind="type"
def row_means(gray):
    return gray[0].mean()
