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

# %% name="Crops each row to width bytes" origin="fresh" sentence="Crops each row to width bytes, but a colour row has 3 bytes per pixel." must_say=["3 bytes"] kind="error"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    rows = rows[:, :message.width]
    return rows.reshape(message.height, message.width, 3)

# %% name="Does not remove the padding" origin="fresh" sentence="Does not remove the padding, so there are too many bytes for the shape." must_say=["padding"] kind="error"
def decode_padded(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    return values.reshape(message.height, message.width, 3)

# %% name="The numbers of the example " origin="fresh" sentence="The numbers of the example (step 14, width 4) are hard-coded." must_say=["14"] kind="error"
def decode_padded(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    rows = values.reshape(message.height, 14)
    pixels = rows[:, :12]
    return pixels.reshape(message.height, 4, 3)

# %% name="Always cuts off two bytes per row" origin="fresh" sentence="Always cuts off two bytes per row, but the padding may have any length." must_say=["two bytes|too few"] kind="error"
def decode_padded(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    rows = values.reshape(message.height, message.step)
    rows = rows[:, :-2]
    return rows.reshape(message.height, message.width, 3)

# %% name="The slice is on the first axis" origin="fresh" sentence="The slice is on the first axis: it limits the rows and leaves the padding columns in." must_say=["first rows|first axis"] kind="error"
def decode_padded(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    rows = values.reshape(message.height, message.step)
    rows = rows[:message.width * 3]
    return rows.reshape(message.height, message.width, 3)

# %% name="A field name is misspelled" origin="fresh" sentence="A field name is misspelled: message.heigth does not exist." must_say=["height|heigth"] kind="error"
def decode_padded(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    rows = values.reshape(message.heigth, message.step)
    rows = rows[:, :message.width * 3]
    return rows.reshape(message.heigth, message.width, 3)

# %% name="step and height are exchanged in the first reshape" origin="fresh" sentence="step and height are exchanged in the first reshape, so the rows are mixed up." must_say=["exchanged"] kind="error"
def decode_padded(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    rows = values.reshape(message.step, message.height)
    rows = rows[:, :message.width * 3]
    return rows.reshape(message.height, message.width, 3)

# %% name="Reverses the channels at the end" origin="fresh" sentence="Reverses the channels at the end, so red and blue are exchanged although the encoding is rgb8." must_say=["exchanged|revers"] kind="value"
def decode_padded(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    rows = values.reshape(message.height, message.step)
    rows = rows[:, :3 * message.width]
    image = rows.reshape(message.height, message.width, 3)
    return image[:, :, ::-1]

# %% name="Removes the padding but does not form pixels" origin="fresh" sentence="Removes the padding but does not form pixels: the result has two axes instead of three." must_say=["axis of the channels|two axes"] kind="shape"
def decode_padded(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    rows = values.reshape(message.height, message.step)
    return rows[:, :message.width * 3]

# %% name="Cuts all the surplus bytes from the end of the data" origin="fresh" sentence="Cuts all the surplus bytes from the end of the data, but the padding is at the end of every row." must_say=["every row|each row"] kind="value"
def decode_padded(message):
    values = np.frombuffer(message.data, dtype=np.uint8)
    count = message.height * message.width * 3
    values = values[:count]
    return values.reshape(message.height, message.width, 3)
