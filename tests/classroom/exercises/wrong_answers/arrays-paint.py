# %% name="Adds 255 to the masked pixels instead of replacing them" sentence="Adds 255 to the masked pixels instead of replacing them, so they are not 255 (and the dtype is no longer uint8)." must_say=["added|adds"] kind="value"
def paint_white(gray, mask):
    return gray + mask * 255

# %% name="the given image is painted" sentence="You paint into the given image: make a copy first, gray.copy()." must_say=["copy", "chang|given|input|copy"] kind="input-changed"
def paint_white(gray, mask):
    gray[mask] = 255
    return gray
