# %% name="crops width bytes" origin="fresh" sentence="A pixel has 3 bytes: keep width * 3 bytes of each row before reshape." must_say=["3 (bytes|channels)|three|bytes|\\* 3|3 \\*|channel"] kind="error"
def decode_padded(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    rows = flat.reshape(message.height, message.step)
    rows = rows[:, :message.width]
    return rows.reshape(message.height, message.width, 3)

# %% name="padding cut only at the end" origin="fresh" sentence="The padding is at the end of every row; you cut it only at the end of the data. First reshape to (height, step), then crop." must_say=["every row|each row|step|end of"] must_not_say=["order"] kind="value"
def decode_padded(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    number = message.height * message.width * 3
    return flat[:number].reshape(message.height, message.width, 3)

# %% name="padding at the front" origin="fresh" sentence="You keep the last bytes of each row; the padding is at the end, so keep the first width * 3." must_say=["first|end|begin|padding|last|left|front"] kind="value"
def decode_padded(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    rows = flat.reshape(message.height, message.step)
    pad = message.step - message.width * 3
    rows = rows[:, pad:]
    return rows.reshape(message.height, message.width, 3)

# %% name="step divided by 3" origin="fresh" sentence="step is not always a multiple of 3: crop the bytes first, then make pixels." must_say=["step|padding|crop|multiple|divis|bytes"] kind="error"
def decode_padded(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    pixels = flat.reshape(message.height, message.step // 3, 3)
    return pixels[:, :message.width]

# %% name="slices rows with the width" origin="fresh" sentence="rows[: width * 3] selects rows; the columns stand after the comma: rows[:, : width * 3]." must_say=["comma|column|rows|\\[:,"] kind="shape"
def decode_padded(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    rows = flat.reshape(message.height, message.step)
    rows = rows[:message.width * 3]
    return rows.reshape(message.height, -1, 3)
