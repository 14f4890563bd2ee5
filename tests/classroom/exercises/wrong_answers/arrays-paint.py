# %% name="two = in one line" sentence="a = a[mask] = 255 stores 255 in a, too: write the assignment alone." must_say=["alone|stores", "255"] kind="error"
def paint_white(gray, mask):
    painted = gray.copy()
    painted = painted[mask] = 255
    return painted

# %% name="Adds 255 to the masked pixels instead of replacing them" sentence="Adds 255 to the masked pixels instead of replacing them, so they are not 255 (and the dtype is no longer uint8)." must_say=["added|adds"] kind="value"
def paint_white(gray, mask):
    return gray + mask * 255

# %% name="the given image is painted" sentence="You paint into the given image: make a copy first, gray.copy()." must_say=["copy", "chang|given|input|copy"] kind="input-changed"
def paint_white(gray, mask):
    gray[mask] = 255
    return gray

# %% name="return forgotten" sentence="You paint the copy but never give it back: write return." must_say=["return"] kind="no-return"
def paint_white(gray, mask):
    result = gray.copy()
    result[mask] = 255

# %% name="adds white" sentence="uint8 wraps around: 100 + 255 gives 99. Do not add, assign 255." must_say=["wrap|assign|add(ing|ition)?\\b|256|overflow"] must_not_say=["copy"] kind="value"
def paint_white(gray, mask):
    return gray + mask.astype(np.uint8) * 255
