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

# %% name="greater or equal" origin="fresh" sentence="A pixel equal to level is not brighter: write > instead of >=." must_say=[">=|equal to|\\bequal\\b|brighter than"] kind="value"
def two_levels(gray, level):
    return np.where(gray >= level, 255, 0).astype(np.uint8)

# %% name="256 for white" origin="fresh" sentence="The largest value of uint8 is 255: 256 does not fit." must_say=["255"] must_not_say=["widen|uint32"] kind="error"
def two_levels(gray, level):
    result = np.zeros(gray.shape, dtype=np.uint8)
    result[gray > level] = 256
    return result

# %% name="a loop that returns at once" origin="fresh" sentence="return stands inside the loop: only the first pixel is looked at." must_say=["return.*(loop|inside)"] kind="value"
def two_levels(gray, level):
    result = np.zeros_like(gray)
    for row in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            if gray[row, col] > level:
                result[row, col] = 255
        return result

# %% name="np.were" origin="fresh" sentence="The function is called np.where." must_say=["np\\.where"] kind="error"
def two_levels(gray, level):
    return np.were(gray > level, 255, 0).astype(np.uint8)

# %% name="other way round" origin="fresh" sentence="The two are exchanged: white belongs to the brighter pixels." must_say=["exchanged|other way|order"] kind="value"
def two_levels(gray, level):
    return np.where(gray > level, 0, 255).astype(np.uint8)

# %% name="two ifs in order" origin="fresh" sentence="After the first line the bright pixels are 255, and then the second condition looks at changed values." must_say=["changed|after the|already|order|copy"] kind="value"
def two_levels(gray, level):
    result = gray.copy()
    result[result <= level] = 255
    result[result > level] = 0
    return 255 - result

# %% name="mask times one" origin="fresh" sentence="You return 1 where 255 is asked: multiply the mask by 255." must_say=["255"] kind="value"
def two_levels(gray, level):
    return (gray > level).astype(np.uint8)

# %% name="misspelled method" origin="fresh" sentence="The method is called astype." must_say=["astype"] kind="error"
def two_levels(gray, level):
    result = np.where(gray > level, 255, 0)
    return result.as_type(np.uint8)

# %% name="level is overwritten" origin="fresh" sentence="level is used for the loop, so the argument is lost." must_say=["loop|overwrit|writes over|another name"] kind="error"
def two_levels(gray, level):
    result = np.zeros_like(gray)
    for level in range(gray.shape[0]):
        for col in range(gray.shape[1]):
            if gray[level, col] > level:
                result[level, col] = 255
    return result

# %% name="unchanged when dark" origin="fresh" sentence="Where the pixel is not brighter, the result must be 0, and you keep the gray level." must_say=["\\b0\\b.*(else|every|where)|else|must be 0"] kind="value"
def two_levels(gray, level):
    result = gray.copy()
    result[gray > level] = 255
    return result
