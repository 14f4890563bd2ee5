# %% name="always tolerance 1" origin="fresh" sentence="You always use 3 × 3: the number of shifts must follow tolerance, 2 * tolerance + 1." must_say=["tolerance|3 × 3|3x3"] must_not_say=["dtype|bool"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, 1)
    result = np.zeros_like(mask)
    size = 3
    for row in range(size):
        for col in range(size):
            result |= padded[row:row + height, col:col + width]
    return result

# %% name="size without + 1" origin="fresh" sentence="The size is 2 * tolerance + 1: you forget one row and one column." must_say=["\\+ ?1|one (row|more|column)|2 ?[*×] ?tolerance|last"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, tolerance)
    result = np.zeros_like(mask)
    size = 2 * tolerance
    for row in range(size):
        for col in range(size):
            result |= padded[row:row + height, col:col + width]
    return result

# %% name="padding of 1" origin="fresh" sentence="The padding must be tolerance pixels wide; with 1 the shifted copies are too small." must_say=["pad|tolerance"] kind="error"
def near(mask, tolerance):
    height, width = mask.shape
    padded = np.pad(mask, 1)
    result = np.zeros_like(mask)
    size = 2 * tolerance + 1
    for row in range(size):
        for col in range(size):
            result |= padded[row:row + height, col:col + width]
    return result

# %% name="a cross, not a square" origin="fresh" sentence="You add row and column distance; each of them may be up to tolerance, so the corners count too." must_say=["corner|diagonal|square|and\\b"] must_not_say=["\\+ ?1 (is )?missing"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    result = np.zeros((height, width), dtype=bool)
    for row in range(height):
        for col in range(width):
            if mask[row, col]:
                for d in range(-tolerance, tolerance + 1):
                    if 0 <= row + d < height:
                        result[row + d, col] = True
                    if 0 <= col + d < width:
                        result[row, col + d] = True
    return result

# %% name="negative index wraps" origin="fresh" sentence="At the border row - tolerance becomes negative, and the slice then counts from the end: pad the mask or use max(0, ...)." must_say=["negative|border|outside|pad|max\\(0|edge of"] must_not_say=["corner"] kind="value"
def near(mask, tolerance):
    height, width = mask.shape
    result = np.zeros((height, width), dtype=bool)
    for row in range(height):
        for col in range(width):
            window = mask[row - tolerance:row + tolerance + 1, col - tolerance:col + tolerance + 1]
            result[row, col] = window.any()
    return result
