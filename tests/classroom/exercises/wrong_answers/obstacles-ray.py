# %% name="pinhole only" sentence="You return the ray of a pinhole camera: the distortion is missing." must_say=["pinhole|distortion|k1|factor"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    return (col - center[0]) / f, (row - center[1]) / f
