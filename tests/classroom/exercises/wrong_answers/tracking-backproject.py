# %% name="overflow" sentence="The product does not fit into uint8: widen the hue first." must_say=["widen|uint8|astype|overflow|wrap"] kind="value"
def backproject(hue, weights):
    bins = hue * len(weights) // 180
    return weights[bins]

# %% name="in the hue itself" sentence="You changed the input: make a new array." must_say=["input|chang|new"] kind="input-changed"
def backproject(hue, weights):
    hue[:] = weights[hue.astype(int) * len(weights) // 180]
    return hue

# %% name="mean of the weights" sentence="Return one weight for each pixel, not their mean." must_say=["each|pixel|mean|shape|array"] kind="type"
def backproject(hue, weights):
    bins = hue.astype(int) * len(weights) // 180
    return weights[bins].mean()
