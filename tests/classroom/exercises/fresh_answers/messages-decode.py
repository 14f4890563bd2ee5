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
