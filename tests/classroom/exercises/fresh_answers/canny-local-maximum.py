# %% name=">= on the left" origin="fresh" sentence="The rule is > left and >= right; you exchanged the signs, so of two equal pixels the right one is kept." must_say=["\\bequal|>="] must_not_say=["outside|border|copy"] kind="value"
def keep_peaks(magnitude):
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for col in range(len(magnitude)):
        left, right = padded[col], padded[col + 2]
        if magnitude[col] >= left and magnitude[col] > right:
            result[col] = magnitude[col]
    return result

# %% name="or instead of and" origin="fresh" sentence="Both conditions must be true: use and, not or." must_say=["and|both"] must_not_say=["outside|>="] kind="value"
def keep_peaks(magnitude):
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for col in range(len(magnitude)):
        left, right = padded[col], padded[col + 2]
        if magnitude[col] > left or magnitude[col] >= right:
            result[col] = magnitude[col]
    return result

# %% name="neighbours shifted" origin="fresh" sentence="pixel col is at padded[col + 1], so the left neighbour is padded[col]; you take padded[col - 1] and padded[col + 1]." must_say=["col \\+ 2|neighbou?r|shift|padded|itself|col \\+ 1"] kind="value"
def keep_peaks(magnitude):
    padded = np.pad(magnitude, 1)
    result = np.zeros_like(magnitude)
    for col in range(len(magnitude)):
        left, right = padded[col - 1], padded[col + 1]
        if magnitude[col] > left and magnitude[col] >= right:
            result[col] = magnitude[col]
    return result

# %% name="skips the two ends" origin="fresh" sentence="You leave out the first and the last pixel; outside the image the magnitude is 0, so they can be peaks too." must_say=["first|last|outside|end|border|0"] must_not_say=["equal|>="] kind="value"
def keep_peaks(magnitude):
    result = np.zeros_like(magnitude)
    for col in range(1, len(magnitude) - 1):
        if magnitude[col] > magnitude[col - 1] and magnitude[col] >= magnitude[col + 1]:
            result[col] = magnitude[col]
    return result

# %% name="returns the mask" origin="fresh" sentence="You return only True and False; the result is the magnitude where a pixel is kept." must_say=["magnitude|mask|bool|True"] kind="dtype"
def keep_peaks(magnitude):
    padded = np.pad(magnitude, 1)
    left = padded[:-2]
    right = padded[2:]
    kept = (magnitude > left) & (magnitude >= right)
    return kept
