# %% name="mono16 read as bytes" sentence="A mono16 pixel takes two bytes, and you read every byte as a pixel: for mono16 read the data as uint16." must_say=["two bytes|2 bytes|every byte|16 bit", "as uint16|u2|read .*uint16|uint16 .*read|dtype"] kind="dtype"
def decode(message):
    rows = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)
    if message.encoding in ("rgb8", "bgr8"):
        return rows[:, : message.width * 3].reshape(message.height, message.width, 3)
    return rows[:, : message.width]

# %% name="reshape by width, padding not removed" sentence="Rows may be padded, so the data does not fit height × width: cut it into rows of step bytes first, then crop each row to the width." must_say=["step|padd", "crop|cut|padd"] kind="error"
def decode(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    if message.encoding == "mono8":
        return flat.reshape(message.height, message.width)
    if message.encoding == "mono16":
        order = ">u2" if message.is_bigendian else "<u2"
        return np.frombuffer(message.data, dtype=order).reshape(message.height, message.width).astype(np.uint16)
    return flat.reshape(message.height, message.width, 3)

# %% name="byte order ignored" sentence="You read mono16 always with the little end first; where is_bigendian is 1 the more significant byte comes first, so choose the dtype by that field." must_say=["endian|byte order|significant", "is_bigendian|>u2|field"] must_not_say=["padd"] kind="value"
def decode(message):
    rows = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)
    if message.encoding == "mono16":
        pixels = np.ascontiguousarray(rows[:, : message.width * 2])
        return pixels.view("<u2").reshape(message.height, message.width).astype(np.uint16)
    if message.encoding == "mono8":
        return rows[:, : message.width]
    return rows[:, : message.width * 3].reshape(message.height, message.width, 3)

# %% name="only mono8 is handled" sentence="You decode every message as mono8, one byte a pixel: look at message.encoding, because rgb8 and bgr8 take three bytes and mono16 two." must_say=["every message|one byte|message\\.encoding|look at .*encoding|always", "rgb8|mono16|three|colou?r|encoding"] kind="shape"
def decode(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    return rows[:, : message.width]

# %% name="the lesson's tiny message decoded" sentence="You decode tiny_message of an earlier cell, not the message that your function receives: use the parameter message everywhere." must_say=["tiny_message|another cell|other cell|earlier cell", "message|argument|parameter"] kind="other-cell"
def decode(message):
    flat = np.frombuffer(tiny_message.data, dtype=np.uint8)
    return flat.reshape(tiny_message.height, tiny_message.step)
