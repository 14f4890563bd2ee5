# %% name="bgr8 turned to rgb8" origin="fresh" sentence="The channels must keep the order of data: do not reverse bgr8." must_say=["order|revers|swap|bgr8|::-1"] must_not_say=["padding|step"] kind="value"
def decode(message):
    data = np.frombuffer(message.data, dtype=np.uint8)
    rows = data.reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows[:, :message.width]
    if message.encoding == "rgb8":
        return rows[:, :message.width * 3].reshape(message.height, message.width, 3)
    if message.encoding == "bgr8":
        image = rows[:, :message.width * 3].reshape(message.height, message.width, 3)
        return image[:, :, ::-1]
    first = rows[:, 0:message.width * 2:2].astype(np.uint16)
    second = rows[:, 1:message.width * 2:2].astype(np.uint16)
    if message.is_bigendian:
        return first * 256 + second
    return second * 256 + first

# %% name="bgr8 forgotten" origin="fresh" sentence="There is no branch for bgr8, so the function returns None: treat it like rgb8." must_say=["bgr8|None|return"] kind="no-return"
def decode(message):
    data = np.frombuffer(message.data, dtype=np.uint8)
    rows = data.reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows[:, :message.width]
    elif message.encoding == "rgb8":
        return rows[:, :message.width * 3].reshape(message.height, message.width, 3)
    elif message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        cut = rows[:, :message.width * 2].tobytes()
        return np.frombuffer(cut, dtype=order).reshape(message.height, message.width)

# %% name="mono16 with the width of one byte" origin="fresh" sentence="A mono16 pixel has two bytes: crop to width * 2 bytes before you pair them; you keep only half of the pixels." must_say=["two bytes|2 bytes|width \\* 2|2 \\* width|half|bytes (for|of) (each|a|every) pixel"] must_not_say=["bigendian"] kind="shape"
def decode(message):
    data = np.frombuffer(message.data, dtype=np.uint8)
    rows = data.reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows[:, :message.width]
    if message.encoding == "mono16":
        rows = rows[:, :message.width]
        a = rows[:, 0::2].astype(np.uint16)
        b = rows[:, 1::2].astype(np.uint16)
        if message.is_bigendian:
            return a * 256 + b
        return b * 256 + a
    return rows[:, :message.width * 3].reshape(message.height, message.width, 3)

# %% name="compares encoding with a wrong text" origin="fresh" sentence="The encoding is \"mono16\", and you compare with \"16UC1\", so mono16 takes the colour branch." must_say=["mono16|encoding"] kind="error"
def decode(message):
    data = np.frombuffer(message.data, dtype=np.uint8)
    rows = data.reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows[:, :message.width]
    if message.encoding == "16UC1":
        cut = rows[:, :message.width * 2].tobytes()
        order = ">u2" if message.is_bigendian else "<u2"
        return np.frombuffer(cut, dtype=order).reshape(message.height, message.width)
    return rows[:, :message.width * 3].reshape(message.height, message.width, 3)

# %% name="mono8 keeps padding" origin="fresh" sentence="Crop the padding of mono8 too: keep the first width columns." must_say=["padding|width|crop|step"] must_not_say=["byte order|bigendian"] kind="shape"
def decode(message):
    data = np.frombuffer(message.data, dtype=np.uint8)
    rows = data.reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows
    if message.encoding == "mono16":
        cut = rows[:, :message.width * 2].tobytes()
        order = ">u2" if message.is_bigendian else "<u2"
        return np.frombuffer(cut, dtype=order).reshape(message.height, message.width)
    return rows[:, :message.width * 3].reshape(message.height, message.width, 3)

# %% name="message.rows" origin="fresh" sentence="A message has height, and no field rows." must_say=["height"] kind="error"
def decode(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.rows, message.step)
    if message.encoding == "mono8":
        return rows[:, :message.width]
    if message.encoding in ("rgb8", "bgr8"):
        return rows[:, :message.width * 3].reshape(message.height, message.width, 3)
    wide = rows[:, :message.width * 2].astype(np.uint16)
    if message.is_bigendian:
        return wide[:, 0::2] * 256 + wide[:, 1::2]
    return wide[:, 1::2] * 256 + wide[:, 0::2]

# %% name="padding not cut" origin="fresh" sentence="The rows still have their padding: crop at width * 3 before the reshape." must_say=["padding|crop"] kind="error"
def decode(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows
    if message.encoding in ("rgb8", "bgr8"):
        return rows.reshape(message.height, message.width, 3)
    pixels = rows[:, :message.width * 2].copy().view(">u2" if message.is_bigendian else "<u2")
    return pixels.astype(np.uint16)

# %% name="only one colour encoding" origin="fresh" sentence="bgr8 is forgotten: nothing is returned for it." must_say=["bgr8|case missing|None for this"] kind="no-return"
def decode(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows[:, :message.width]
    if message.encoding == "rgb8":
        return rows[:, :message.width * 3].reshape(message.height, message.width, 3)
    if message.encoding == "mono16":
        pixels = rows[:, :message.width * 2].copy().view(">u2" if message.is_bigendian else "<u2")
        return pixels.astype(np.uint16)

# %% name="bgr turned" origin="fresh" sentence="The channels stay in the order of data: do not turn them." must_say=["order|channels"] kind="value"
def decode(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows[:, :message.width]
    if message.encoding == "mono16":
        pixels = rows[:, :message.width * 2].copy().view(">u2" if message.is_bigendian else "<u2")
        return pixels.astype(np.uint16)
    image = rows[:, :message.width * 3].reshape(message.height, message.width, 3)
    if message.encoding == "bgr8":
        image = image[..., ::-1]
    return image

# %% name="always true or" origin="fresh" sentence="encoding == \"rgb8\" or \"bgr8\" is always true: compare with both." must_say=["always true"] kind="shape"
def decode(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    if message.encoding == "rgb8" or "bgr8":
        return rows[:, :message.width * 3].reshape(message.height, message.width, 3)
    if message.encoding == "mono8":
        return rows[:, :message.width]
    pixels = rows[:, :message.width * 2].copy().view(">u2" if message.is_bigendian else "<u2")
    return pixels.astype(np.uint16)

# %% name="byte order exchanged" origin="fresh" sentence="The byte order is exchanged: with is_bigendian 1 the more significant byte comes first." must_say=["is_bigendian|byte"] kind="value"
def decode(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows[:, :message.width]
    if message.encoding in ("rgb8", "bgr8"):
        return rows[:, :message.width * 3].reshape(message.height, message.width, 3)
    wide = rows[:, :message.width * 2].astype(np.uint16)
    if message.is_bigendian:
        return wide[:, 1::2] * 256 + wide[:, 0::2]
    return wide[:, 0::2] * 256 + wide[:, 1::2]

# %% name="width and height exchanged" origin="fresh" sentence="reshape takes the rows first, height." must_say=["height|rows first|exchanged"] kind="error"
def decode(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows[:, :message.width]
    if message.encoding in ("rgb8", "bgr8"):
        return rows[:, :message.width * 3].reshape(message.width, message.height, 3)
    pixels = rows[:, :message.width * 2].copy().view(">u2" if message.is_bigendian else "<u2")
    return pixels.astype(np.uint16)

# %% name="not widened" origin="fresh" sentence="256 times a uint8 does not fit: widen to uint16 first." must_say=["uint16|widen|fit"] kind="dtype"
def decode(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows[:, :message.width]
    if message.encoding in ("rgb8", "bgr8"):
        return rows[:, :message.width * 3].reshape(message.height, message.width, 3)
    pixels = rows[:, :message.width * 2]
    first, second = pixels[:, 0::2], pixels[:, 1::2]
    if message.is_bigendian:
        return first * 256 + second
    return second * 256 + first

# %% name="step as the width" origin="fresh" sentence="A row has width * 3 bytes of pixels; step counts the padding too." must_say=["step|width"] kind="error"
def decode(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows[:, :message.width]
    if message.encoding in ("rgb8", "bgr8"):
        return rows.reshape(message.height, message.step, 3)
    pixels = rows[:, :message.width * 2].copy().view(">u2" if message.is_bigendian else "<u2")
    return pixels.astype(np.uint16)

# %% name="np.frombuffered" origin="fresh" sentence="NumPy calls it frombuffer." must_say=["frombuffer"] kind="error"
def decode(message):
    rows = np.from_buffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    if message.encoding == "mono8":
        return rows[:, :message.width]
    return rows[:, :message.width * 3].reshape(message.height, message.width, 3)
