# %% name="int64 result" sentence="The values are right; only the dtype is not: np.where made int64, so end with .astype(np.uint8)." must_say=["dtype|type", "uint8"] kind="dtype"
def binarize(gray, level):
    return np.where(gray > level, 255, 0)

# %% name="np.were" sentence="The function is called np.where." must_say=["np\\.where"] kind="error"
def binarize(gray, level):
    return np.were(gray > level, 255, 0).astype(np.uint8)
