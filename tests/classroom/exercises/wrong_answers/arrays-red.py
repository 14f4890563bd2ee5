# %% name="channel 0" origin="new" sentence="Channel 0 is blue: the order is blue, green, red, so red is channel 2." must_say=["blue", "2|order|red"] kind="value"
def red_channel(bgr):
    return bgr[..., 0]

# %% name="channel 1" origin="new" sentence="Channel 1 is green: the order is blue, green, red, so red is channel 2." must_say=["green", "2|order|red"] kind="value"
def red_channel(bgr):
    return bgr[..., 1]

# %% name="row 2" origin="new" sentence="bgr[2] is row 2 of the image: put the channel last, bgr[..., 2] or bgr[:, :, 2]." must_say=["row", "\\.\\.\\.|:, ?:|last|channel"] kind="value"
def red_channel(bgr):
    return bgr[2]

# %% name="column 2" origin="new" sentence="bgr[:, 2] is column 2 of the image: the channel is the third index, bgr[:, :, 2]." must_say=["column", "third|\\.\\.\\.|:, ?:|last|channel"] kind="value"
def red_channel(bgr):
    return bgr[:, 2]

# %% name="channel 3" origin="new" sentence="There is no channel 3: the index starts at 0, so the three channels are 0, 1 and 2." must_say=["from 0|starts? at 0|0, 1|no channel 3|2|out of", "channel|index|bounds"] kind="error"
def red_channel(bgr):
    return bgr[..., 3]

# %% name="slice keeps the axis" origin="new" sentence="2:3 is a slice and keeps an axis of length 1: use the index 2 alone." must_say=["slice|axis|2:3|, ?1\\)|shape|third", "index|shape|\\[\\.\\.\\., ?2\\]|axis"] kind="shape"
def red_channel(bgr):
    return bgr[..., 2:3]

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

# %% name="mean of the channels" origin="new" sentence="The mean of the channels is not the red one: take the channel with the index 2." must_say=["mean|average", "2|red|channel|index"] kind="value"
def red_channel(bgr):
    return bgr.mean(axis=2).astype(np.uint8)
