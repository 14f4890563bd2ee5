# %% name="left minus right" origin="new" sentence="The sign is turned: the task asks for the right neighbour minus the pixel itself." must_say=["sign|order|turned|left minus|minus the|swap|opposite|wrong way", "right|sign|minus|subtract"] kind="value"
def differences(gray):
    wide = gray.astype(np.int16)
    return wide[:, :-1] - wide[:, 1:]

# %% name="absolute differences" origin="new" sentence="You take the absolute value, and a step down loses its sign: leave np.abs out." must_say=["abs|sign|negative", "leave|without|sign|negative|positive|down"] kind="value"
def differences(gray):
    wide = gray.astype(np.int16)
    return np.abs(wide[:, 1:] - wide[:, :-1])

# %% name="slices of different length" origin="new" sentence="The two slices have different lengths: both must have one column less than the image." must_say=["broadcast|shape|length|differ", "column|slice|same|one (column )?less|:-1|shape"] kind="error"
def differences(gray):
    wide = gray.astype(np.int16)
    return wide[:, 1:] - wide[:, :-2]

# %% name="loop goes one too far" origin="new" sentence="The last pixel has no right neighbour: stop the loop one column earlier." must_say=["last|right neighbour|out of|bounds|width - 1|one column", "neighbour|column|index|range|bounds|loop"] kind="error"
def differences(gray):
    height, width = gray.shape
    result = np.zeros((height, width - 1), np.int16)
    for row in range(height):
        for column in range(width):
            result[row, column] = int(gray[row, column + 1]) - int(gray[row, column])
    return result

# %% name="loop subtracts uint8" origin="new" sentence="Inside the loop both numbers are uint8, so a negative difference wraps around: convert them with int first." must_say=["uint8|negative|wrap|overflow", "int|widen|convert|astype"] kind="value"
def differences(gray):
    height, width = gray.shape
    result = np.zeros((height, width - 1), np.int16)
    for row in range(height):
        for column in range(width - 1):
            result[row, column] = gray[row, column + 1] - gray[row, column]
    return result

# %% name="a row of zeros kept" origin="new" sentence="You keep the shape of the image and leave the last column 0: return only the differences, one column less." must_say=["shape|column", "less|last|one|shape"] kind="shape"
def differences(gray):
    result = np.zeros(gray.shape, np.int16)
    wide = gray.astype(np.int16)
    result[:, :-1] = wide[:, 1:] - wide[:, :-1]
    return result

# %% name="return forgotten" origin="new" sentence="You compute the differences but never give them back: write return." must_say=["return"] kind="no-return"
def differences(gray):
    wide = gray.astype(np.int16)
    result = wide[:, 1:] - wide[:, :-1]
