# %% name="black and white swapped" origin="new" sentence="Bright pixels became 0 and dark ones 255: the value for True comes first in np.where." must_say=["swap|invert|other way|turned|first|exchang|opposite|wrong way|reversed", "255|white|black|True|bright"] kind="value"
def two_levels(gray, level):
    return np.where(gray > level, 0, 255).astype(np.uint8)

# %% name="int64 result" origin="new" sentence="The values are right; only the dtype is not: np.where made int64, so end with .astype(np.uint8)." must_say=["dtype|type", "uint8"] kind="dtype"
def two_levels(gray, level):
    return np.where(gray > level, 255, 0)

# %% name="a mask" origin="new" sentence="You return the mask of True and False: make 255 and 0 of it, as uint8." must_say=["mask|bool|True", "255"] kind="dtype"
def two_levels(gray, level):
    return gray > level

# %% name="0 and 1" origin="new" sentence="True became 1: multiply by 255, or use np.where with 255." must_say=["255", "\\b1\\b|multipl|times|where"] kind="value"
def two_levels(gray, level):
    return (gray > level).astype(np.uint8)

# %% name="given image changed" origin="new" sentence="You change the given image: work on a copy." must_say=["copy|chang", "gray|input|copy"] kind="input-changed"
def two_levels(gray, level):
    gray[gray > level] = 255
    gray[gray <= level] = 0
    return gray

# %% name="dark pixels keep their values" origin="new" sentence="Only the bright pixels are set to 255; the dark ones keep their gray level: they must become 0." must_say=["dark|rest|0|only the bright|not (set|changed)|black", "0|black|dark"] kind="value"
def two_levels(gray, level):
    result = gray.copy()
    result[gray > level] = 255
    return result

# %% name="if with an array" origin="new" sentence="if needs one truth value, and gray > level has one for each pixel: use np.where." must_say=["truth|if |each pixel|ambiguous|one for each", "where|mask|any|all|pixel|element"] kind="error"
def two_levels(gray, level):
    if gray > level:
        return 255
    return 0

# %% name="bright pixels keep their values" origin="new" sentence="Bright pixels keep their gray level: the result must have only 0 and 255." must_say=["keep|own|gray level|255", "255|only|two|white"] kind="value"
def two_levels(gray, level):
    return np.where(gray > level, gray, 0).astype(np.uint8)

# %% name="list of lists" origin="new" sentence="You return a list of lists: make an array of it, np.array(result, dtype=np.uint8)." must_say=["list", "np\\.array|array"] kind="type"
def two_levels(gray, level):
    result = []
    for row in gray:
        result.append([255 if value > level else 0 for value in row])
    return result

# %% name="return forgotten" origin="new" sentence="You compute the image but never give it back: write return." must_say=["return"] kind="no-return"
def two_levels(gray, level):
    result = np.where(gray > level, 255, 0).astype(np.uint8)

# %% name="the second mask sees the first change" origin="walk" sentence="The second mask also selects what the first line changed: make both masks first." must_say=["second|both masks"] kind="value"
def two_levels(gray, level):
    out = gray.copy()
    out[out > level] = 0
    out[out <= level] = 255
    return out
