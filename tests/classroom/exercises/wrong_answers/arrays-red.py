# %% name="row 2" origin="new" sentence="bgr[2] is row 2 of the image: put the channel last, bgr[..., 2] or bgr[:, :, 2]." must_say=["row", "\\.\\.\\.|:, ?:|last|channel"] kind="value"
def red_channel(bgr):
    return bgr[2]

# %% name="channel 3" origin="new" sentence="There is no channel 3: the index starts at 0, so the three channels are 0, 1 and 2." must_say=["from 0|starts? at 0|0, 1|no channel 3|2|out of", "channel|index|bounds"] kind="error"
def red_channel(bgr):
    return bgr[..., 3]

# %% name="the other channels set to 0" origin="new" sentence="You keep three channels and set two to 0: return only the red one, an array with two axes." must_say=["three|channels|axes|shape", "only|one|two axes|red|shape"] kind="shape"
def red_channel(bgr):
    result = bgr.copy()
    result[..., 0] = 0
    result[..., 1] = 0
    return result

# %% name="attribute red" origin="new" sentence="An array has no attribute red: a channel is found by its number, bgr[..., 2]." must_say=["attribute|no .*red|number", "2|index|channel|attribute"] kind="error"
def red_channel(bgr):
    return bgr.red

# %% name="mask of the red channel" origin="new" sentence="bgr[..., 2] > 0 is a mask, True or False for each pixel: return the numbers themselves." must_say=["mask|bool|True|compar|> ?0", "number|value|uint8|dtype|bool"] kind="dtype"
def red_channel(bgr):
    return bgr[..., 2] > 0

# %% name="channels and rows unpacked" origin="new" sentence="Unpacking splits the rows, not the channels: take the channel with the last index." must_say=["unpack|rows|values to", "\\.\\.\\.|last|channel|index|unpack"] kind="error"
def red_channel(bgr):
    blue, green, red = bgr
    return red

# %% name="return forgotten" origin="new" sentence="You take the channel but never give it back: write return." must_say=["return"] kind="no-return"
def red_channel(bgr):
    red = bgr[..., 2]
