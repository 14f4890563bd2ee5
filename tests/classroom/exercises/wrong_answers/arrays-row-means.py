# %% name="mean of the columns" origin="new" sentence="axis=0 gives one mean for each column: one for each row is axis=1." must_say=["column|axis ?= ?0", "axis ?= ?1|row"] kind="shape"
def row_means(gray):
    return gray.mean(axis=0)

# %% name="mean of the image" origin="new" sentence="Without an axis, mean gives one number for the whole image: use axis=1." must_say=["axis|whole|one number|each row", "row|axis|array"] kind="type"
def row_means(gray):
    return gray.mean()

# %% name="rounded to integers" origin="new" sentence="The means lost their decimals: return them as float, without astype or rounding." must_say=["decimal|round|fraction|whole|float|dtype|trunc|cut"] kind="dtype"
def row_means(gray):
    return gray.mean(axis=1).astype(np.uint8)

# %% name="axis 2" origin="new" sentence="A gray image has the axes 0 and 1 only: the mean of each row is axis=1." must_say=["axis", "1|two|out of|0 and 1"] kind="error"
def row_means(gray):
    return gray.mean(axis=2)

# %% name="only the first row" origin="new" sentence="gray[0] is only the first row: take the mean of every row, with axis=1." must_say=["first row|only|one number|each row|every row|row 0", "axis|every|each|row|array"] kind="type"
def row_means(gray):
    return gray[0].mean()
