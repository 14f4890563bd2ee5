# %% name="truncated" origin="fresh" sentence="You do not round: add 2**14 before >> 15." must_say=["round|16384|2 ?\\*\\* ?14|half"] must_not_say=["order|red|wrap|uint8"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    sums = wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798
    gray = sums // 32768
    return gray.astype(np.uint8)

# %% name="shift without parentheses" origin="fresh" sentence="+ is computed before >>: write (sums + 2**14) >> 15 with parentheses." must_say=["parenthes|before >>|brackets|shift"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    sums = wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798
    return (sums >> 15 + 2**14).astype(np.uint8)

# %% name="weights in rgb order" origin="fresh" sentence="The channels are blue, green, red: blue (channel 0) gets 3735 and red (channel 2) 9798; you exchanged them." must_say=["blue|red|order|exchang|swap"] must_not_say=["round|wrap"] kind="value"
def luma(bgr):
    red = bgr[:, :, 0].astype(np.int32)
    green = bgr[:, :, 1].astype(np.int32)
    blue = bgr[:, :, 2].astype(np.int32)
    total = red * 9798 + green * 19235 + blue * 3735
    return ((total + 2**14) >> 15).astype(np.uint8)

# %% name="uint16 too small" origin="fresh" sentence="uint16 ends at 65535 and the products are larger, so they wrap around: use uint32." must_say=["uint16|uint32|65535|wrap|overflow|too small"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.uint16)
    sums = wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798
    return ((sums + 16384) >> 15).astype(np.uint8)

# %% name="mean of the channels" origin="fresh" sentence="The mean gives each channel the same weight; luma weighs blue with 3735, green 19235 and red 9798." must_say=["weight|mean|same"] must_not_say=["order|swap|exchang"] kind="value"
def luma(bgr):
    return bgr.mean(axis=2).round().astype(np.uint8)
