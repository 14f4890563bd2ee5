# %% name="the given image is painted" sentence="You paint into the given image: make a copy first, gray.copy()." must_say=["copy", "chang|given|input|copy"] kind="input-changed"
def paint_white(gray, mask):
    gray[mask] = 255
    return gray
