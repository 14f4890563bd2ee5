# %% name="overflow" origin="new" sentence="The product does not fit into uint8: widen the hue first." must_say=["widen|uint8|astype|overflow|wrap"] kind="value"
def backproject(hue, weights):
    bins = hue * len(weights) // 180
    return weights[bins]

# %% name="divided by 256" origin="new" sentence="The hue ends at 179: divide by 180." must_say=["180"] kind="value"
def backproject(hue, weights):
    bins = hue.astype(int) * len(weights) // 256
    return weights[bins]

# %% name="divided by 255" origin="new" sentence="The hue ends at 179: divide by 180." must_say=["180"] kind="value"
def backproject(hue, weights):
    bins = hue.astype(int) * len(weights) // 255
    return weights[bins]

# %% name="divided by 360" origin="new" sentence="OpenCV counts steps of two degrees: divide by 180." must_say=["180"] kind="value"
def backproject(hue, weights):
    bins = hue.astype(int) * len(weights) // 360
    return weights[bins]

# %% name="ten hues" origin="new" sentence="The number of bins is len(weights), not always 18." must_say=["len|bins|18"] kind="error"
def backproject(hue, weights):
    return weights[hue // 10]

# %% name="bins, not weights" origin="new" sentence="Look up the weight of each bin: weights[bins]." must_say=["weight"] kind="value"
def backproject(hue, weights):
    bins = hue.astype(int) * len(weights) // 180
    return bins.astype(np.uint8)

# %% name="a float index" origin="new" sentence="An index must be whole: use //, not /." must_say=["//|whole|integer|index"] kind="error"
def backproject(hue, weights):
    bins = hue.astype(int) * len(weights) / 180
    return weights[bins]

# %% name="hue as the index" origin="new" sentence="The hue is not the bin: compute hue * bins // 180 first." must_say=["bin|180|index|bounds"] kind="error"
def backproject(hue, weights):
    return weights[hue]

# %% name="rounded bins" origin="new" sentence="A bin begins at its first hue: round down with //." must_say=["//|down|round"] kind="error"
def backproject(hue, weights):
    bins = np.rint(hue.astype(int) * len(weights) / 180).astype(int)
    return weights[bins]

# %% name="width of a bin" origin="new" sentence="180 // bins loses digits: multiply first, then divide." must_say=["multiply|digits|180|bounds"] kind="error"
def backproject(hue, weights):
    return weights[hue.astype(int) // (180 // len(weights))]

# %% name="0 to 1" origin="new" sentence="Return the weights as they are, not divided by 255." must_say=["255|uint8|as they are"] kind="value"
def backproject(hue, weights):
    bins = hue.astype(int) * len(weights) // 180
    return weights[bins] / 255

# %% name="black or white" origin="new" sentence="Return the weights, not 255 or 0." must_say=["weight"] kind="value"
def backproject(hue, weights):
    bins = hue.astype(int) * len(weights) // 180
    return np.where(weights[bins] > 127, 255, 0).astype(np.uint8)

# %% name="reversed" origin="new" sentence="Bin 0 has the first weight: you looked up from the other end." must_say=["first|end|revers|order"] kind="value"
def backproject(hue, weights):
    bins = hue.astype(int) * len(weights) // 180
    return weights[len(weights) - 1 - bins]

# %% name="one column" origin="new" sentence="The result has the shape of the image: do not flatten it." must_say=["shape|flatten|ravel"] kind="shape"
def backproject(hue, weights):
    bins = hue.ravel().astype(int) * len(weights) // 180
    return weights[bins]

# %% name="in the hue itself" origin="new" sentence="You changed the input: make a new array." must_say=["input|chang|new"] kind="input-changed"
def backproject(hue, weights):
    hue[:] = weights[hue.astype(int) * len(weights) // 180]
    return hue

# %% name="18 bins in uint8" origin="new" sentence="Widen first, and take the number of bins from len(weights)." must_say=["astype|widen|fit|overflow|uint8", "len"] kind="value"
def backproject(hue, weights):
    bins = hue * 18 // 180
    return weights[bins]

# %% name="divided by the number of bins" origin="new" sentence="You divided by the number of bins: a bin has 180 / bins hues, so it is hue * bins // 180." must_say=["divid", "180"] kind="value"
def backproject(hue, weights):
    bins = hue.astype(int) // len(weights)
    return weights[bins]

# %% name="the hue times the weights" origin="new" sentence="The weights are a table with one value for each bin: multiply by their number, len(weights), and look the bin up: weights[bins]." must_say=["table|look", "len\\("] kind="error"
def backproject(hue, weights):
    bins = hue.astype(int) * weights // 180
    return weights[bins]

# %% name="a float result" origin="new" sentence="The values are right, but the task asks for uint8." must_say=["values are right", "uint8"] kind="dtype"
def backproject(hue, weights):
    result = np.zeros(hue.shape)
    for row in range(hue.shape[0]):
        for col in range(hue.shape[1]):
            result[row, col] = weights[int(hue[row, col]) * len(weights) // 180]
    return result
