# %% name="pinhole only" sentence="You return the ray of a pinhole camera: the distortion is missing." must_say=["pinhole|distortion|k1|factor"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    return (col - center[0]) / f, (row - center[1]) / f

# %% name="no colon" sentence="The colon after range(20) is missing." must_say=["colon|:"] kind="syntax"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20)
        r2 = x * x + y * y
    return x, y
