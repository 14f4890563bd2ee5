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

# %% name="with the 1" sentence="The task asks for x and y, two numbers, without the 1." must_say=["two|2"] kind="type"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
    return x, y, 1

# %% name="^" sentence="In Python ^ is not a power: write r2 ** 2 or r2 * r2." must_say=["\\*\\*|power|\\^"] kind="error"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = x ^ 2 + y ^ 2
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
    return x, y

# %% name="center divided too" sentence="Subtract the center before you divide by f: parentheses are missing." must_say=["parenthes|center|principal|before"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    px, py = col - center[0] / f, row - center[1] / f
    x, y = px, py
    for _ in range(20):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = px / factor, py / factor
    return x, y
