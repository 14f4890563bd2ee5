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

# %% name="the other pixels painted" origin="new" sentence="You paint the pixels where the mask is False: leave ~ out." must_say=["False|other|invert|~|not in the mask|outside|opposite|where the mask", "mask|~|True"] kind="value"
def paint_white(gray, mask):
    result = gray.copy()
    result[~mask] = 255
    return result

# %% name="only the painted pixels returned" origin="new" sentence="result[mask] is a list of the selected pixels: return the whole image." must_say=["whole|shape|select|only|image", "image|shape|pixels|result"] kind="shape"
def paint_white(gray, mask):
    result = gray.copy()
    result[mask] = 255
    return result[mask]

# %% name="painted with 1" origin="new" sentence="White is 255; 1 is almost black." must_say=["255", "white|1|black"] kind="value"
def paint_white(gray, mask):
    result = gray.copy()
    result[mask] = 1
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

# %% name="the mask itself" origin="new" sentence="You return the mask: paint into a copy of gray, and return that." must_say=["mask|bool|True", "gray|copy|255|image"] kind="dtype"
def paint_white(gray, mask):
    return mask

# %% name="mask added in uint8" origin="new" sentence="gray + 255 overflows in uint8, so the painted pixels became one darker: set them, result[mask] = 255." must_say=["overflow|wrap|255|one (gray level )?(darker|less)|256", "set|=|uint8|assign|white"] kind="value"
def paint_white(gray, mask):
    return gray + mask.astype(np.uint8) * np.uint8(255)

# %% name="return forgotten" origin="new" sentence="You paint the copy but never give it back: write return." must_say=["return"] kind="no-return"
def paint_white(gray, mask):
    result = gray.copy()
    result[mask] = 255

# %% name="unchanged copy" origin="new" sentence="The image comes back unchanged: set the pixels of the mask to 255 before you return it." must_say=["unchanged|same|as it is|as given|not painted|equal|input", "mask|255|paint|set|image|input"] kind="value"
def paint_white(gray, mask):
    result = gray.copy()
    result[mask].fill(255)
    return result

# %% name="255 added" origin="walk" sentence="The painted pixels must become 255, not grow by 255." must_say=["255", "add|grow"] kind="value"
def paint_white(gray, mask):
    return gray + mask * 255

# %% name="two = in one line" origin="walk" sentence="a = a[mask] = 255 stores 255 in a, too: write the assignment alone." must_say=["alone|stores", "255"] kind="error"
def paint_white(gray, mask):
    painted = gray.copy()
    painted = painted[mask] = 255
    return painted
