# %% name="y with the new x" origin="fresh" sentence="r2 is computed from x and y of different guesses. Change x and y together." must_say=["r2|together|guess|x and y"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = pinhole_x * x + pinhole_y * y
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
    return x, y

# %% name="factor without the 1" origin="fresh" sentence="The factor begins with 1: without it, a lens without distortion would divide by 0." must_say=["\\b1\\b"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = x * x + y * y
        factor = k1 * r2 + k2 * r2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
    return x, y

# %% name="k1 twice" origin="fresh" sentence="You used k1 in place of k2." must_say=["k2"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k1 * r2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
    return x, y

# %% name="center divided too" origin="fresh" sentence="Subtract the center before you divide by f: parentheses are missing." must_say=["parenthes|center|principal|before"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    px, py = col - center[0] / f, row - center[1] / f
    x, y = px, py
    for _ in range(20):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = px / factor, py / factor
    return x, y

# %% name="only x" origin="fresh" sentence="y is not corrected: divide it by the factor too." must_say=["\\by\\b"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x = pinhole_x / factor
    return x, y
