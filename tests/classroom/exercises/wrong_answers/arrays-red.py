# %% name="row 2" sentence="bgr[2] is row 2 of the image: put the channel last, bgr[..., 2] or bgr[:, :, 2]." must_say=["row", "\\.\\.\\.|:, ?:|last|channel"] kind="value"
def red_channel(bgr):
    return bgr[2]

# %% name="channel 3" sentence="There is no channel 3: the index starts at 0, so the three channels are 0, 1 and 2." must_say=["from 0|starts? at 0|0, 1|no channel 3|2|out of", "channel|index|bounds"] kind="error"
def red_channel(bgr):
    return bgr[..., 3]
