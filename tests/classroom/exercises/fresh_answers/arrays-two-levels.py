# %% name="keeps the bright values" origin="fresh" sentence="The bright pixels must become 255; you leave them unchanged." must_say=["255|white|unchanged|bright"] must_not_say=["1 instead|astype|dtype|uint8"] kind="value"
def two_levels(gray, level):
    result = gray.copy()
    result[gray <= level] = 0
    return result

# %% name="reversed levels" origin="fresh" sentence="Bright pixels become 255 and the others 0; you have exchanged them." must_say=["exchang|swap|opposite|revers|255|invert|brighter|other way"] must_not_say=["uint8|>="] kind="value"
def two_levels(gray, level):
    return np.where(gray > level, 0, 255).astype(np.uint8)

# %% name="1 instead of 255" origin="fresh" sentence="astype(uint8) makes True to 1; white is 255, so multiply by 255." must_say=["255|white"] kind="value"
def two_levels(gray, level):
    return (gray > level).astype(np.uint8)

# %% name="if on the array" origin="fresh" sentence="if needs one truth value, and gray > level has one per pixel: use np.where." must_say=["np\\.where|one truth|each pixel|every pixel|mask|truth value"] kind="error"
def two_levels(gray, level):
    if gray > level:
        return 255
    else:
        return 0

# %% name="second step sees the first" origin="fresh" sentence="You write into the given image: first gray.copy(), or np.where." must_say=["copy|given (image|array|input)|chang"] kind="input-changed"
def two_levels(gray, level):
    gray[gray > level] = 255
    gray[gray <= level] = 0
    return gray
