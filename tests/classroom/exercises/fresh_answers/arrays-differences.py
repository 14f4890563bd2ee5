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
