# %% name="mean of the columns" sentence="axis=0 gives one mean for each column: one for each row is axis=1." must_say=["column|axis ?= ?0", "axis ?= ?1|row"] kind="shape"
def row_means(gray):
    return gray.mean(axis=0)
