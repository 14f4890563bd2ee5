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

# %% name="red and blue exchanged" origin="fresh" sentence="Channel 0 is blue: the weights of blue and red are exchanged." must_say=["blue|order|channel 0"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    total = wide[..., 0] * 9798 + wide[..., 1] * 19235 + wide[..., 2] * 3735
    return ((total + 2**14) >> 15).astype(np.uint8)

# %% name="rgb unpacked" origin="fresh" sentence="The order of the channels is blue, green, red." must_say=["blue|order"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    r, g, b = wide[..., 0], wide[..., 1], wide[..., 2]
    return ((r * 9798 + g * 19235 + b * 3735 + 16384) >> 15).astype(np.uint8)

# %% name="loop variable again" origin="fresh" sentence="r counts the rows, and inside the loop it becomes the red value: use another name." must_say=["(another|other) name|overwrit|writes over|used (again|twice)"] must_not_say=["np\\.pad"] kind="error"
def luma(bgr):
    height, width, _ = bgr.shape
    result = np.zeros((height, width), dtype=np.uint8)
    for r in range(height):
        for c in range(width):
            b, g, r = bgr[r, c].astype(np.uint32)
            result[r, c] = (b * 3735 + g * 19235 + r * 9798 + 16384) >> 15
    return result

# %% name="parentheses around the shift" origin="fresh" sentence="Python computes + before >>: 16384 is not added before the shift." must_say=["parenthes|before|round"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    total = wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798
    return (total >> 15 + 2**14).astype(np.uint8)

# %% name="parentheses missing in the mean" origin="fresh" sentence="Only the last product is divided: put the sum in parentheses." must_say=["parenthes|divide"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.float64)
    gray = wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798 / 32768
    return np.round(gray).astype(np.uint8)

# %% name="return inside the loop" origin="fresh" sentence="return stands inside the outer loop, so only one row is computed." must_say=["return.*(loop|inside)"] kind="value"
def luma(bgr):
    height, width, _ = bgr.shape
    result = np.zeros((height, width), dtype=np.uint8)
    for row in range(height):
        for col in range(width):
            b, g, r = bgr[row, col].astype(int)
            result[row, col] = (b * 3735 + g * 19235 + r * 9798 + 16384) >> 15
        return result

# %% name="not rounded" origin="fresh" sentence="The result is cut off: add 2**14 before the shift." must_say=["round|half|cut off"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    return ((wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798) >> 15).astype(np.uint8)

# %% name="bgr.heigth" origin="fresh" sentence="An array has no field for its height: it is bgr.shape[0]." must_say=["shape"] kind="error"
def luma(bgr):
    result = np.zeros((bgr.rows, bgr.cols), dtype=np.uint8)
    for row in range(bgr.rows):
        for col in range(bgr.cols):
            b, g, r = bgr[row, col].astype(int)
            result[row, col] = (b * 3735 + g * 19235 + r * 9798 + 16384) >> 15
    return result

# %% name="green twice" origin="fresh" sentence="The red channel is wide[..., 2], and you take channel 1 twice." must_say=["red|channel|\\[\\.\\.\\., 2\\]|1 right in .*or 2"] kind="value"
def luma(bgr):
    wide = bgr.astype(np.uint32)
    total = wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 1] * 9798
    return ((total + 2**14) >> 15).astype(np.uint8)

# %% name="not widened" origin="fresh" sentence="19235 does not fit into uint8: widen the frame first with astype(np.uint32)." must_say=["widen|uint32"] kind="error"
def luma(bgr):
    total = bgr[..., 0] * 3735 + bgr[..., 1] * 19235 + bgr[..., 2] * 9798
    return ((total + 2**14) >> 15).astype(np.uint8)
