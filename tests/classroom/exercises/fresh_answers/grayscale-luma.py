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

# %% name="Multiplies in uint8 without converting first" origin="fresh" sentence="Multiplies in uint8 without converting first, so the numbers are too large for the type." must_say=["uint8|the type"] kind="error"
def luma(bgr):
    blue = bgr[:, :, 0]
    green = bgr[:, :, 1]
    red = bgr[:, :, 2]
    sums = 299 * red + 587 * green + 114 * blue
    return ((sums + 500) // 1000).astype(np.uint8)

# %% name="Reads channel 0 as red and channel 2 as blue" origin="fresh" sentence="Reads channel 0 as red and channel 2 as blue, but the order is BGR." must_say=["order is|exchanged|BGR"] kind="value"
def luma(bgr):
    values = bgr.astype(np.int32)
    red = values[:, :, 0]
    green = values[:, :, 1]
    blue = values[:, :, 2]
    sums = 299 * red + 587 * green + 114 * blue
    rounded = (sums + 500) // 1000
    return rounded.astype(np.uint8)

# %% name="Does not round" origin="fresh" sentence="Does not round: // cuts the fraction off, so many pixels are one too dark." must_say=["cut"] kind="value"
def luma(bgr):
    values = bgr.astype(int)
    sums = 114 * values[:, :, 0] + 587 * values[:, :, 1] + 299 * values[:, :, 2]
    return (sums // 1000).astype(np.uint8)

# %% name="The result is not converted back to uint8" origin="fresh" sentence="The result is not converted back to uint8; it stays int32." must_say=["uint8"] kind="dtype"
def luma(bgr):
    values = bgr.astype(np.int32)
    sums = 114 * values[:, :, 0] + 587 * values[:, :, 1] + 299 * values[:, :, 2]
    rounded = (sums + 500) // 1000
    return rounded

# %% name="Converts the sums to uint8 before the division" origin="fresh" sentence="Converts the sums to uint8 before the division, so they overflow." must_say=["overflow|does not fit"] kind="error"
def luma(bgr):
    values = bgr.astype(np.int32)
    sums = 114 * values[:, :, 0] + 587 * values[:, :, 1] + 299 * values[:, :, 2]
    rounded = (sums + 500).astype(np.uint8) // 1000
    return rounded

# %% name="Computes the plain mean of the three channels instead of" origin="fresh" sentence="Computes the plain mean of the three channels instead of the weighted sum." must_say=["average|mean"] kind="value"
def luma(bgr):
    mean = bgr.mean(axis=2)
    return np.round(mean).astype(np.uint8)

# %% name="bgr[0]" origin="fresh" sentence="bgr[0], bgr[1], bgr[2] are the first three rows of the image, not the three channels." must_say=["rows"] kind="shape"
def luma(bgr):
    values = bgr.astype(np.int32)
    blue = values[0]
    green = values[1]
    red = values[2]
    sums = 299 * red + 587 * green + 114 * blue
    return ((sums + 500) // 1000).astype(np.uint8)

# %% name="Parentheses are missing" origin="fresh" sentence="Parentheses are missing: only 500 is divided by 1000, not the whole sum." must_say=["parenthes"] kind="value"
def luma(bgr):
    values = bgr.astype(np.int32)
    blue = values[:, :, 0]
    green = values[:, :, 1]
    red = values[:, :, 2]
    rounded = 299 * red + 587 * green + 114 * blue + 500 // 1000
    return rounded.astype(np.uint8)

# %% name="return is inside the loop over the rows" origin="fresh" sentence="return is inside the loop over the rows, so only the first row is computed and the rest stays black." must_say=["inside"] kind="value"
def luma(bgr):
    height, width, channels = bgr.shape
    gray = np.zeros((height, width), dtype=np.uint8)
    for row in range(height):
        for col in range(width):
            blue = int(bgr[row, col, 0])
            green = int(bgr[row, col, 1])
            red = int(bgr[row, col, 2])
            gray[row, col] = (299 * red + 587 * green + 114 * blue + 500) // 1000
        return gray

# %% name="The size 480 x 640 is hard-coded" origin="fresh" sentence="The size 480 x 640 is hard-coded, so an image of another size fails or gets the wrong shape." must_say=["hard-coded|another shape"] kind="error"
def luma(bgr):
    result = np.zeros((480, 640), dtype=np.uint8)
    for row in range(480):
        for col in range(640):
            b, g, r = bgr[row, col].astype(int)
            result[row, col] = (299 * r + 587 * g + 114 * b + 500) // 1000
    return result
