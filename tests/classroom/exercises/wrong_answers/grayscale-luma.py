# %% name="bgr[0] for blue" sentence="bgr[0] is the first row of the image, not the blue channel: the channels are the last axis, so write bgr[..., 0]." must_say=["bgr\\[0\\]|first row|is (the|a) row|rows?,", "last|\\.\\.\\.|\\[:, ?:|channel|axis"] kind="shape"
def luma(bgr):
    b, g, r = bgr[0].astype(np.uint32), bgr[1].astype(np.uint32), bgr[2].astype(np.uint32)
    return ((b * 3735 + g * 19235 + r * 9798 + 2**14) >> 15).astype(np.uint8)

# %% name="float result" sentence="Your result is float, and uint8 was asked for: round it and end with .astype(np.uint8)." must_say=["float", "astype|uint8"] kind="dtype"
def luma(bgr):
    wide = bgr.astype(float)
    return np.floor((wide[..., 0] * 3735 + wide[..., 1] * 19235 + wide[..., 2] * 9798 + 2**14) / 2**15)

# %% name="loop writes a list" sentence="You return a list of lists, and an array was asked for: put the values into np.array(rows, dtype=np.uint8)." must_say=["\\blists?\\b", "array"] kind="type"
def luma(bgr):
    rows = []
    for y in range(bgr.shape[0]):
        row = []
        for x in range(bgr.shape[1]):
            b, g, r = (int(v) for v in bgr[y, x])
            row.append((b * 3735 + g * 19235 + r * 9798 + 2**14) >> 15)
        rows.append(row)
    return rows
