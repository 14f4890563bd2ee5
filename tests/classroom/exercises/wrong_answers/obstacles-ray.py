# %% name="pinhole only" origin="new" sentence="You return the ray of a pinhole camera: the distortion is missing." must_say=["pinhole|distortion|k1|factor"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    return (col - center[0]) / f, (row - center[1]) / f

# %% name="no loop" origin="new" sentence="You corrected only once: repeat it 20 times." must_say=["20|repeat|repetition"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    r2 = x * x + y * y
    factor = 1 + k1 * r2 + k2 * r2 * r2
    return x / factor, y / factor

# %% name="r2 before the loop" origin="new" sentence="r2 is computed only once, before the loop: compute it again from the newest x and y." must_say=["again|newest|each|repetition"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    r2 = x * x + y * y
    for _ in range(20):
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
    return x, y

# %% name="divides the guess" origin="new" sentence="x = x / factor divides the last guess again and again: divide the pinhole ray." must_say=["pinhole|guess"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x = x / factor
        y = y / factor
    return x, y

# %% name="multiplies" origin="new" sentence="Multiplying is what the lens does; divide by the factor." must_say=["divid"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = pinhole_x * factor, pinhole_y * factor
    return x, y

# %% name="root" origin="new" sentence="r2 is r squared: leave the root out." must_say=["r2|squared|root"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r = math.sqrt(x * x + y * y)
        factor = 1 + k1 * r + k2 * r * r
        x, y = pinhole_x / factor, pinhole_y / factor
    return x, y

# %% name="k2 * r2" origin="new" sentence="k2 belongs to the power of 4 of r: r2 * r2." must_say=["k2", "r2 \\* r2|power of 4|4"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
    return x, y

# %% name="center forgotten" origin="new" sentence="Subtract the principal point first: (col - center[0]) / f." must_say=["center|principal"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = col / f, row / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
    return x, y

# %% name="row first" origin="new" sentence="x belongs to the column: your x and y are exchanged." must_say=["exchang|order|column"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
    return y, x

# %% name="not divided by f" origin="new" sentence="Divide by the focal length f: a ray is not in pixels." must_say=["\\bf\\b|focal"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = col - center[0], row - center[1]
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
    return x, y

# %% name="with the 1" origin="new" sentence="The task asks for x and y, two numbers, without the 1." must_say=["two|2"] kind="type"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
    return x, y, 1

# %% name="return in the loop" origin="new" sentence="return stands inside the loop, so it ends after one repetition." must_say=["repetition|loop|20|return"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
        return x, y

# %% name="four times" origin="new" sentence="Four repetitions are too few: the task asks for 20." must_say=["20"] kind="value"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(4):
        r2 = x * x + y * y
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
    return x, y

# %% name="^" origin="new" sentence="In Python ^ is not a power: write r2 ** 2 or r2 * r2." must_say=["\\*\\*|power|\\^"] kind="error"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20):
        r2 = x ^ 2 + y ^ 2
        factor = 1 + k1 * r2 + k2 * r2 * r2
        x, y = pinhole_x / factor, pinhole_y / factor
    return x, y

# %% name="no colon" origin="new" sentence="The colon after range(20) is missing." must_say=["colon|:"] kind="syntax"
def pixel_ray(col, row, f, center, k1, k2):
    pinhole_x, pinhole_y = (col - center[0]) / f, (row - center[1]) / f
    x, y = pinhole_x, pinhole_y
    for _ in range(20)
        r2 = x * x + y * y
    return x, y
