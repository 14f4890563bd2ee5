# %% name="little-endian always" origin="fresh" sentence="You ignore is_bigendian: read with \">u2\" if it is 1." must_say=["bigendian|big-endian|byte order|order of the (two )?bytes|>u2"] kind="value"
def decode_mono16(message):
    flat = np.frombuffer(message.data, dtype=np.uint16)
    return flat.reshape(message.height, message.width)

# %% name="signs reversed" origin="fresh" sentence="< means little-endian and > big-endian: you exchanged them." must_say=["exchang|swap|revers|other way|opposite|big-endian|>u2|bigendian"] kind="value"
def decode_mono16(message):
    if message.is_bigendian == 1:
        kind = "<u2"
    else:
        kind = ">u2"
    return np.frombuffer(message.data, dtype=kind).reshape(message.height, message.width)

# %% name="bytes not widened" origin="fresh" sentence="256 does not fit into uint8: convert the bytes to uint16 before you multiply." must_say=["uint8|uint16|widen|fit|convert|wrap|astype"] must_not_say=["bigendian is ignored"] kind="value"
def decode_mono16(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    rows = flat.reshape(message.height, message.step)
    first = rows[:, 0::2]
    second = rows[:, 1::2]
    if message.is_bigendian:
        return (first << 8) + second
    return (second << 8) + first

# %% name="uint8 values converted" origin="fresh" sentence="Each pixel is two bytes: read the data as 16-bit numbers, astype only changes the type of each byte." must_say=["two bytes|2 bytes|u2|\\b16|bytes"] kind="error"
def decode_mono16(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    flat = flat.astype(np.uint16)
    return flat.reshape(message.height, message.width)

# %% name="factor 255" origin="fresh" sentence="The more significant byte counts 256 times, not 255 times." must_say=["256"] kind="value"
def decode_mono16(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    rows = flat.reshape(message.height, message.step)
    a = rows[:, 0::2].astype(np.uint16)
    b = rows[:, 1::2].astype(np.uint16)
    if message.is_bigendian == 1:
        return a * 255 + b
    return b * 255 + a
