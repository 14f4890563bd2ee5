# %% name="all red pixels as a mask of the maximum" origin="fresh" sentence="You compute the largest channel of each pixel; the red channel is the one with index 2." must_say=["index 2|channel 2|\\[2\\]|, 2\\]|red is|red channel|last channel|third|maximum|largest"] must_not_say=["blue channel|green channel|index 0|index 1"] kind="value"
def red_channel(bgr):
    return bgr.max(axis=2)

# %% name="other channels set to zero" origin="fresh" sentence="The result still has three channels: select one channel, bgr[..., 2]." must_say=["three channels|3 channels|one channel|select|shape|\\(height, width\\)|, 2\\]"] kind="shape"
def red_channel(bgr):
    red = bgr.copy()
    red[..., 0] = 0
    red[..., 1] = 0
    return red

# %% name="index 3" origin="fresh" sentence="Channels are counted from 0: red is the third channel, so its index is 2, not 3." must_say=["(from|with|at) 0|0, 1|index 2|, 2\\]"] kind="error"
def red_channel(bgr):
    return bgr[:, :, 3]

# %% name="keeps the axis" origin="fresh" sentence="A slice keeps the axis: 2:3 gives the shape (height, width, 1); write 2 for one channel." must_say=["2:3|slice|axis|\\(height, width|dimension|1\\)"] kind="shape"
def red_channel(bgr):
    return bgr[:, :, 2:3]

# %% name="swaps first then takes last" origin="fresh" sentence="After you reverse the channels red is channel 0, and channel 2 is blue." must_say=["blue|revers|order|channel 0|first"] kind="value"
def red_channel(bgr):
    rgb = bgr[..., ::-1]
    return rgb[..., 2]
