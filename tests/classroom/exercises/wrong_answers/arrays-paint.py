# %% name="the given image is painted" origin="new" sentence="You paint into the given image: make a copy first, gray.copy()." must_say=["copy", "chang|given|input|copy"] kind="input-changed"
def paint_white(gray, mask):
    gray[mask] = 255
    return gray

# %% name="a second name is no copy" origin="new" sentence="result = gray gives the same array a second name; it is no copy: write gray.copy()." must_say=["copy", "name|same|chang|input|=|copy"] kind="input-changed"
def paint_white(gray, mask):
    result = gray
    result[mask] = 255
    return result

# %% name="a full slice is a view" origin="new" sentence="gray[:] is a view of the same numbers, not a copy: write gray.copy()." must_say=["copy", "view|same|chang|input|slice"] kind="input-changed"
def paint_white(gray, mask):
    result = gray[:]
    result[mask] = 255
    return result

# %% name="the rest is black" origin="new" sentence="Pixels outside the mask lost their gray level: begin with a copy of gray, not with zeros." must_say=["outside|rest|other|not in the mask|keep|lost|begin|zeros|black", "copy|gray|keep|unchanged|0"] kind="value"
def paint_white(gray, mask):
    result = np.zeros_like(gray)
    result[mask] = 255
    return result

# %% name="if with an array" origin="new" sentence="if needs one truth value, and a mask has one for each pixel: write result[mask] = 255." must_say=["truth|if |each pixel|ambiguous|one for each", "mask|\\[|any|all|pixel|element"] kind="error"
def paint_white(gray, mask):
    result = gray.copy()
    if mask:
        result = 255
    return result

# %% name="return forgotten" origin="new" sentence="You paint the copy but never give it back: write return." must_say=["return"] kind="no-return"
def paint_white(gray, mask):
    result = gray.copy()
    result[mask] = 255

# %% name="unchanged copy" origin="new" sentence="The image comes back unchanged: set the pixels of the mask to 255 before you return it." must_say=["unchanged|same|as it is|as given|not painted|equal|input", "mask|255|paint|set|image|input"] kind="value"
def paint_white(gray, mask):
    result = gray.copy()
    result[mask].fill(255)
    return result

# %% name="two = in one line" origin="walk" sentence="a = a[mask] = 255 stores 255 in a, too: write the assignment alone." must_say=["alone|stores", "255"] kind="error"
def paint_white(gray, mask):
    painted = gray.copy()
    painted = painted[mask] = 255
    return painted
