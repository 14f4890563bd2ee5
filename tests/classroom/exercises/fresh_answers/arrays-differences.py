# %% name="keeps the last column" origin="fresh" sentence="The result has width − 1 columns: the last column has no right neighbour; you pad it." must_say=["width|last|column|one less|shape|neighbou?r"] must_not_say=["uint8"] kind="shape"
def differences(gray):
    wide = gray.astype(np.int16)
    result = np.zeros_like(wide)
    result[:, :-1] = wide[:, 1:] - wide[:, :-1]
    return result

# %% name="converted after subtracting" origin="fresh" sentence="The subtraction happens in uint8 and wraps around: convert to int16 before you subtract." must_say=["wrap|before|first|widen|uint8"] must_not_say=["absolute|left"] kind="value"
def differences(gray):
    right = gray[:, 1:]
    middle = gray[:, :-1]
    return (right - middle).astype("int16")

# %% name="rows subtracted" origin="fresh" sentence="You subtract rows from each other; the right neighbour is in the next column: gray[:, 1:] - gray[:, :-1]." must_say=["column|rows|right neighbou?r|down|below|, 1:"] must_not_say=["uint8"] kind="shape"
def differences(gray):
    wide = gray.astype(np.int16)
    return wide[1:] - wide[:-1]

# %% name="two to the right" origin="fresh" sentence="gray[:, 2:] is two columns to the right; the right neighbour is gray[:, 1:]." must_say=["two|1:|one (pixel|column)|next|width"] kind="shape"
def differences(gray):
    g = gray.astype(np.int16)
    return g[:, 2:] - g[:, :-2]

# %% name="int8" origin="fresh" sentence="int8 goes only from -128 to 127: a difference can be -255 to 255, so use int16." must_say=["int8|int16|127|range"] must_not_say=["absolute"] kind="dtype"
def differences(gray):
    wide = gray.astype(np.int16)
    return (wide[:, 1:] - wide[:, :-1]).astype(np.int8)

# %% name="left minus right" origin="fresh" sentence="The signs are exchanged: it is the right neighbour minus the pixel." must_say=["sign|minus"] kind="value"
def differences(gray):
    wide = gray.astype(np.int16)
    return wide[:, :-1] - wide[:, 1:]

# %% name="absolute" origin="fresh" sentence="Negative differences must stay negative: leave np.abs out." must_say=["abs|negative|sign"] kind="value"
def differences(gray):
    wide = gray.astype(np.int16)
    return np.abs(wide[:, 1:] - wide[:, :-1])

# %% name="widened too late" origin="fresh" sentence="The subtraction is done in uint8, and wraps around: widen first." must_say=["widen|uint8|before|negative"] kind="value"
def differences(gray):
    return (gray[:, 1:] - gray[:, :-1]).astype(np.int16)

# %% name="rows instead of columns" origin="fresh" sentence="These are the differences of the rows below: take columns, [:, 1:]." must_say=["column|row"] kind="shape"
def differences(gray):
    wide = gray.astype(np.int16)
    return wide[1:] - wide[:-1]

# %% name="np.diff along the wrong axis" origin="fresh" sentence="axis=0 goes down the rows; the right neighbour is along axis 1." must_say=["axis|column|row"] kind="shape"
def differences(gray):
    return np.diff(gray.astype(np.int16), axis=0)

# %% name="one column too many" origin="fresh" sentence="The last pixel has no right neighbour: the result has one column less." must_say=["one column|1 column|too many"] kind="shape"
def differences(gray):
    height, width = gray.shape
    result = np.zeros((height, width), dtype=np.int16)
    for row in range(height):
        for col in range(width - 1):
            result[row, col] = int(gray[row, col + 1]) - int(gray[row, col])
    return result

# %% name="index one too far" origin="fresh" sentence="In the last column col + 1 is outside: the loop must end at width - 1." must_say=["last|outside|width - 1|- 1"] kind="error"
def differences(gray):
    height, width = gray.shape
    result = np.zeros((height, width - 1), dtype=np.int16)
    for row in range(height):
        for col in range(width):
            result[row, col] = int(gray[row, col + 1]) - int(gray[row, col])
    return result

# %% name="gray.astyp" origin="fresh" sentence="The method is called astype." must_say=["astype"] kind="error"
def differences(gray):
    wide = gray.astyp(np.int16)
    return wide[:, 1:] - wide[:, :-1]

# %% name="two to the right again" origin="fresh" sentence="You subtract the neighbour two columns away." must_say=["two|neighbour|shift|slice"] must_not_say=["widen"] kind="value"
def differences(gray):
    wide = np.pad(gray.astype(np.int16), ((0, 0), (0, 1)), mode="edge")
    return wide[:, 2:] - wide[:, :-2]

# %% name="int8 again" origin="fresh" sentence="int8 ends at 127, and a difference may be 255: use int16." must_say=["int8|int16|fit"] kind="value"
def differences(gray):
    wide = gray.astype(np.int8)
    return (wide[:, 1:] - wide[:, :-1]).astype(np.int16)
