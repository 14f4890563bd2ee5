# %% name="np.roll" origin="new" sentence="np.roll brings pixels from the opposite side in at the border: pad the mask with False and take shifted slices." must_say=["roll|opposite|other side", "pad|border|slice"] kind="value"
def near(mask, tolerance):
    result = np.zeros_like(mask)
    for dy in range(-tolerance, tolerance + 1):
        for dx in range(-tolerance, tolerance + 1):
            result |= np.roll(mask, (dy, dx), axis=(0, 1))
    return result

# %% name="a cross" origin="new" sentence="You look along the row and along the column only: look at the whole square, corners included." must_say=["cross|along the row|row and .*column only", "square|corner|diagonal|both"] kind="value"
def near(mask, tolerance):
    h, w = mask.shape
    p = np.pad(mask, tolerance)
    result = mask.copy()
    for k in range(2 * tolerance + 1):
        result |= p[k : k + h, tolerance : tolerance + w]
        result |= p[tolerance : tolerance + h, k : k + w]
    return result

# %% name="round distance" origin="new" sentence="You measure a round distance: the neighbourhood is a square, tolerance rows and tolerance columns in each direction." must_say=["round|circle|distance|euclid", "square|rows and|corner"] kind="value"
def near(mask, tolerance):
    result = np.zeros_like(mask)
    points = np.argwhere(mask)
    for y in range(mask.shape[0]):
        for x in range(mask.shape[1]):
            distance = np.sqrt(((points - (y, x)) ** 2).sum(axis=1))
            result[y, x] = (distance <= tolerance).any()
    return result

# %% name="always one pixel" origin="new" sentence="You always look 1 pixel far: use the argument tolerance." must_say=["tolerance", "always|\\b1\\b|3 ?[×x] ?3|argument"] kind="value"
def near(mask, tolerance):
    h, w = mask.shape
    p = np.pad(mask, 1)
    return np.any([p[y : y + h, x : x + w] for y in range(3) for x in range(3)], axis=0)

# %% name="always two pixels" origin="new" sentence="You always look 2 pixels far: use the argument tolerance." must_say=["tolerance", "always|\\b2\\b|5 ?[×x] ?5|argument"] kind="value"
def near(mask, tolerance):
    h, w = mask.shape
    p = np.pad(mask, 2)
    return np.any([p[y : y + h, x : x + w] for y in range(5) for x in range(5)], axis=0)

# %% name="range one too short" origin="new" sentence="range(2 * tolerance) ends one too early: the window has 2 * tolerance + 1 rows and columns." must_say=["range|one (too|short|less)|window", "\\+ ?1|below|right"] kind="value"
def near(mask, tolerance):
    h, w = mask.shape
    p = np.pad(mask, tolerance)
    result = mask.copy()
    for y in range(2 * tolerance):
        for x in range(2 * tolerance):
            result |= p[y : y + h, x : x + w]
    return result

# %% name="the padded result" origin="new" sentence="Your result is larger than the mask by the padding: cut the padding off, so that the result has the shape of the mask." must_say=["larger|shape|pad|size", "cut|pad|same shape|shape of"] kind="shape"
def near(mask, tolerance):
    p = np.pad(mask, tolerance)
    result = np.zeros_like(p)
    for y, x in np.argwhere(p):
        result[y - tolerance : y + tolerance + 1, x - tolerance : x + tolerance + 1] = True
    return result

# %% name="slice empty for tolerance 0" origin="new" sentence="With tolerance 0 the slice [t:-t] is [0:0] and empty: cut with t : t + height." must_say=["tolerance|\\b0\\b|\\[?t ?: ?-t", "empty|slice|0:0|height|shape"] kind="shape"
def near(mask, tolerance):
    p = np.pad(mask, tolerance)
    result = np.zeros_like(p)
    for y, x in np.argwhere(p):
        result[y - tolerance : y + tolerance + 1, x - tolerance : x + tolerance + 1] = True
    return result[tolerance:-tolerance, tolerance:-tolerance]

# %% name="all instead of any" origin="new" sentence="You ask whether all pixels of the neighbourhood are True: one True pixel is enough, so use | or np.any." must_say=["\\ball\\b|every", "\\bany\\b|one|enough|\\|"] kind="value"
def near(mask, tolerance):
    h, w = mask.shape
    p = np.pad(mask, tolerance)
    steps = range(2 * tolerance + 1)
    return np.all([p[y : y + h, x : x + w] for y in steps for x in steps], axis=0)

# %% name="0 and 255" origin="new" sentence="You return 0 and 255: the task asks for a bool array, True and False." must_say=["255|uint8|dtype", "bool|True"] kind="dtype"
def near(mask, tolerance):
    h, w = mask.shape
    p = np.pad(mask, tolerance)
    steps = range(2 * tolerance + 1)
    result = np.any([p[y : y + h, x : x + w] for y in steps for x in steps], axis=0)
    return np.where(result, 255, 0).astype(np.uint8)

# %% name="the pixel itself left out" origin="new" sentence="You leave the pixel itself out: a True pixel is near itself, at distance 0." must_say=["itself|own|centre|center|middle", "near|count|True|distance 0|too"] kind="value"
def near(mask, tolerance):
    h, w = mask.shape
    p = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for y in range(2 * tolerance + 1):
        for x in range(2 * tolerance + 1):
            if (y, x) != (tolerance, tolerance):
                result |= p[y : y + h, x : x + w]
    return result

# %% name="less than the tolerance" origin="new" sentence="At most tolerance means <=: a pixel exactly tolerance rows or columns away is near, too." must_say=["at most|<=|exactly", "tolerance"] kind="value"
def near(mask, tolerance):
    result = np.zeros_like(mask)
    points = np.argwhere(mask)
    for y in range(mask.shape[0]):
        for x in range(mask.shape[1]):
            result[y, x] = (np.abs(points - (y, x)).max(axis=1) < tolerance).any()
    return result

# %% name="numbers of neighbours" origin="new" sentence="You return how many pixels are near: the task asks for True or False, so compare with > 0, or use any." must_say=["how many|number|count|int", "True|bool|> ?0|\\bany\\b"] kind="dtype"
def near(mask, tolerance):
    h, w = mask.shape
    p = np.pad(mask, tolerance).astype(int)
    steps = range(2 * tolerance + 1)
    return np.sum([p[y : y + h, x : x + w] for y in steps for x in steps], axis=0)

# %% name="grows while it looks" origin="new" sentence="You write into the array that you still read, so new True pixels make more True pixels: read the mask, and write into a new array." must_say=["still read|while|read|same array|already", "new array|copy|mask|unchanged|original"] kind="value"
def near(mask, tolerance):
    result = mask.copy()
    for y in range(mask.shape[0]):
        for x in range(mask.shape[1]):
            top, left = max(y - tolerance, 0), max(x - tolerance, 0)
            if result[top : y + tolerance + 1, left : x + tolerance + 1].any():
                result[y, x] = True
    return result

# %% name="negative slice at the border" origin="new" sentence="At the border y - tolerance is negative, and a slice that begins at -1 begins at the last row: pad the mask, or use max(y - tolerance, 0)." must_say=["border|negative|-1|last row|top|left", "pad|max\\("] kind="value"
def near(mask, tolerance):
    result = np.zeros_like(mask)
    for y in range(mask.shape[0]):
        for x in range(mask.shape[1]):
            result[y, x] = mask[y - tolerance : y + tolerance + 1, x - tolerance : x + tolerance + 1].any()
    return result

# %% name="border left False" origin="new" sentence="Your loops leave out the pixels at the border: pad the mask with False, and visit every pixel." must_say=["border|outermost", "pad|every pixel|visit|left out|leave"] kind="value"
def near(mask, tolerance):
    result = np.zeros_like(mask)
    h, w = mask.shape
    for y in range(tolerance, h - tolerance):
        for x in range(tolerance, w - tolerance):
            result[y, x] = mask[y - tolerance : y + tolerance + 1, x - tolerance : x + tolerance + 1].any()
    return result

# %% name="window without its last row" origin="new" sentence="A slice ends before its second number: write y + tolerance + 1, or the row below is left out." must_say=["slice|ends? before|range|one (too|short|less)|window", "\\+ ?1|below|right"] kind="value"
def near(mask, tolerance):
    result = np.zeros_like(mask)
    for y in range(mask.shape[0]):
        for x in range(mask.shape[1]):
            top, left = max(y - tolerance, 0), max(x - tolerance, 0)
            result[y, x] = mask[top : y + tolerance, left : x + tolerance].any()
    return result

# %% name="rows or columns" origin="new" sentence="A pixel must be near in the rows and in the columns: you accept one of the two." must_say=["rows? (or|and)|\\bor\\b|one of the two", "\\band\\b|both"] kind="value"
def near(mask, tolerance):
    result = np.zeros_like(mask)
    points = np.argwhere(mask)
    for y in range(mask.shape[0]):
        for x in range(mask.shape[1]):
            distance = np.abs(points - (y, x))
            result[y, x] = (distance <= tolerance).any()
    return result

# %% name="cv2.dilate" origin="new" sentence="cv2 is refused in this task: look at the shifted slices of a padded mask." must_say=["cv2|opencv", "refus|not allowed|without it|numpy|yourself"] kind="refused"
import cv2


def near(mask, tolerance):
    kernel = np.ones((2 * tolerance + 1, 2 * tolerance + 1), np.uint8)
    return cv2.dilate(mask.astype(np.uint8), kernel) > 0

# %% name="return forgotten" origin="new" sentence="The function has no return: add return result at the end." must_say=["return"] kind="no-return"
def near(mask, tolerance):
    h, w = mask.shape
    p = np.pad(mask, tolerance)
    steps = range(2 * tolerance + 1)
    result = np.any([p[y : y + h, x : x + w] for y in steps for x in steps], axis=0)

# %% name="range of tolerance" origin="walk" sentence="range(tolerance) gives only tolerance shifts: a square around the pixel needs 2 * tolerance + 1." must_say=["2 \\* tolerance \\+ 1|2 rows"] must_not_say=["border"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(tolerance):
        for col in range(tolerance):
            result |= padded[row : row + height, col : col + width]
    return result

# %% name="plus instead of or, in int" origin="walk" sentence="+ counts the True pixels, and a count is no bool: combine with |, or compare with > 0." must_say=["bool"] kind="dtype"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros(mask.shape)
    for row in range(2 * tolerance + 1):
        for col in range(2 * tolerance + 1):
            result = result + padded[row : row + height, col : col + width]
    return result

# %% name="np.zeros without bool" origin="walk" sentence="np.zeros makes floats: for a mask write dtype=bool." must_say=["float", "bool"] kind="error"
def near(mask, tolerance):
    h, w = mask.shape
    p = np.pad(mask, tolerance)
    out = np.zeros((h, w))
    for r in range(2 * tolerance + 1):
        for c in range(2 * tolerance + 1):
            out = out | p[r:r+h, c:c+w]
    return out

# %% name="negative slice, float64" origin="new" sentence="At the border row - tolerance is negative, so the slice is empty: pad the mask; and make a bool array." must_say=["negative|empty", "bool"] kind="value"
def near(mask, tolerance):
    result = np.zeros(mask.shape)
    for row in range(mask.shape[0]):
        for col in range(mask.shape[1]):
            if mask[row - tolerance : row + tolerance + 1, col - tolerance : col + tolerance + 1].any():
                result[row, col] = True
    return result

# %% name="three shifts for every tolerance" origin="new" sentence="range(3) is right for tolerance 1 only: the square has 2 * tolerance + 1 rows and columns." must_say=["3|always", "2 \\* tolerance \\+ 1"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(3):
        for col in range(3):
            result |= padded[row : row + height, col : col + width]
    return result

# %% name="tolerance + 2 shifts" origin="new" sentence="The square has 2 * tolerance + 1 rows and columns, not tolerance + 2." must_say=["tolerance \\+ 2", "2 \\* tolerance \\+ 1"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    for row in range(tolerance + 2):
        for col in range(tolerance + 2):
            result |= padded[row : row + height, col : col + width]
    return result
