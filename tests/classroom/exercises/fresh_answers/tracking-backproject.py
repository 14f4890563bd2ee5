# %% name="widened too late" origin="fresh" sentence="You widened after the product: widen the hue before you multiply." must_say=["widen|before|uint8|astype|overflow"] kind="value"
def backproject(hue, weights):
    bins = (hue * len(weights)).astype(int) // 180
    return weights[bins]

# %% name="divided by 179" origin="fresh" sentence="Divide by 180: the hue 179 is still in the last bin." must_say=["180"] kind="error"
def backproject(hue, weights):
    bins = hue.astype(int) * len(weights) // 179
    return weights[bins]

# %% name="weights as index" origin="fresh" sentence="The index and the array are exchanged: weights[bins]." must_say=["weights\\[|exchang|index|bounds"] kind="error"
def backproject(hue, weights):
    bins = hue.astype(int) * len(weights) // 180
    return bins[weights]

# %% name="mean of the weights" origin="fresh" sentence="Return one weight for each pixel, not their mean." must_say=["each|pixel|mean|shape|array"] kind="type"
def backproject(hue, weights):
    bins = hue.astype(int) * len(weights) // 180
    return weights[bins].mean()

# %% name="the first row" origin="fresh" sentence="Return all rows of the image, not the first." must_say=["row|shape|\\(H, W\\)"] kind="shape"
def backproject(hue, weights):
    bins = hue.astype(int) * len(weights) // 180
    return weights[bins][0]
