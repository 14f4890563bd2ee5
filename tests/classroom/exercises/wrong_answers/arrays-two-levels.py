# %% name="the second mask sees the first change" sentence="The second mask also selects what the first line changed: make both masks first." must_say=["second|both masks"] kind="value"
def two_levels(gray, level):
    out = gray.copy()
    out[out > level] = 0
    out[out <= level] = 255
    return out

# %% name="int64 result" sentence="The values are right; only the dtype is not: np.where made int64, so end with .astype(np.uint8)." must_say=["dtype|type", "uint8"] kind="dtype"
def two_levels(gray, level):
    return np.where(gray > level, 255, 0)

# %% name="return forgotten" sentence="You compute the image but never give it back: write return." must_say=["return"] kind="no-return"
def two_levels(gray, level):
    result = np.where(gray > level, 255, 0).astype(np.uint8)

# %% name="np.were" sentence="The function is called np.where." must_say=["np\\.where"] kind="error"
def two_levels(gray, level):
    return np.were(gray > level, 255, 0).astype(np.uint8)

# %% name="given image changed" sentence="You change the given image: work on a copy." must_say=["copy|chang", "gray|input|copy"] kind="input-changed"
def two_levels(gray, level):
    gray[gray > level] = 255
    gray[gray <= level] = 0
    return gray
