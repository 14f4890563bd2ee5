# %% name="overflow" sentence="The product does not fit into uint8: widen the hue first." must_say=["widen|uint8|astype|overflow|wrap"] kind="value"
def backproject(hue, weights):
    bins = hue * len(weights) // 180
    return weights[bins]

# %% name="mean of the weights" sentence="Return one weight for each pixel, not their mean." must_say=["each|pixel|mean|shape|array"] kind="type"
def backproject(hue, weights):
    bins = hue.astype(int) * len(weights) // 180
    return weights[bins].mean()
