# %% name="overflow" sentence="The product does not fit into uint8: widen the hue first." must_say=["widen|uint8|astype|overflow|wrap"] kind="value"
def backproject(hue, weights):
    bins = hue * len(weights) // 180
    return weights[bins]
