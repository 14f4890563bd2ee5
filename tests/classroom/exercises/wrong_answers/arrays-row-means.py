# %% name="mean of the columns" sentence="axis=0 gives one mean for each column: one for each row is axis=1." must_say=["column|axis ?= ?0", "axis ?= ?1|row"] kind="shape"
def row_means(gray):
    return gray.mean(axis=0)

# %% name="rounded to integers" sentence="The means lost their decimals: return them as float, without astype or rounding." must_say=["decimal|round|fraction|whole|float|dtype|trunc|cut"] kind="dtype"
def row_means(gray):
    return gray.mean(axis=1).astype(np.uint8)
