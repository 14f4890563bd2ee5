# %% name="padding ignored, first bytes taken" origin="new" sentence="You cut rows of width × 3 bytes, but a padded row is step bytes long, so the padding is read as pixels: reshape by step, then crop." must_say=["step|padd", "padd|shear|crop|\\bcut\\b"] kind="value"
def decode_padded(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    size = message.height * message.width * 3
    return flat[:size].reshape(message.height, message.width, 3)

# %% name="reshape without the padding" origin="new" sentence="With padding there are more bytes than height × width × 3: cut data into rows of step bytes first, then crop each row." must_say=["step|padd", "crop|cut|padd"] kind="error"
def decode_padded(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    return flat.reshape(message.height, message.width, 3)

# %% name="cropped at width bytes" origin="new" sentence="A row has width × 3 bytes before the padding, and you keep only width of them: crop at width * 3." must_say=["\\b3\\b|three", "crop|keep only|width bytes|too few|width ?(\\*|×) ?3"] kind="error"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    pixels = rows[:, : message.width]
    return pixels.reshape(message.height, message.width, 3)

# %% name="cropped at width bytes, no channels" origin="new" sentence="You keep width bytes of each row and return one number for a pixel: a pixel has three bytes, so crop at width * 3 and reshape to (height, width, 3)." must_say=["\\b3\\b|three", "crop|reshape|byte|channel"] kind="shape"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    return rows[:, : message.width]

# %% name="padding kept" origin="new" sentence="You cut the data into rows of step bytes, but the padding at the end of each row is still there: keep only the first width * 3 columns." must_say=["padd|end of (each|every|the) row", "keep only|crop|still|remove|cut off|columns"] kind="shape"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8)
    return rows.reshape(message.height, message.step)

# %% name="no axis for the channels" origin="new" sentence="The padding is gone, but the result is (height, 3 × width): the pixels need their channels, reshape(height, width, 3)." must_say=["channel|axis|dimension|reshape", "height, width, 3|third|last axis|reshape"] kind="shape"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    return rows[:, : message.width * 3]

# %% name="rows cropped instead of columns" origin="new" sentence="rows[: width * 3] keeps the first rows, not the first bytes of each row: write rows[:, : width * 3]." must_say=["row", "comma|:,|column|each row|every row|first bytes"] kind="error"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    pixels = rows[: message.width * 3]
    return pixels.reshape(message.height, message.width, 3)

# %% name="padding expected at the front" origin="new" sentence="The padding is at the end of each row, and you cut off the beginning: keep the first width * 3 bytes." must_say=["end|last|after the pixels", "first|begin|front|start"] kind="value"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    pixels = rows[:, message.step - message.width * 3 :]
    return pixels.reshape(message.height, message.width, 3)

# %% name="always three bytes of padding" origin="new" sentence="The padding has not always three bytes: how many there are, step tells; keep the first width * 3 bytes instead." must_say=["padd|step|not always|three bytes", "width|step|always|other|differ"] kind="error"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    pixels = rows[:, :-3]
    return pixels.reshape(message.height, message.width, 3)

# %% name="padding removed by its value" origin="new" sentence="A pixel may have the value 99 too, and padding may have any value: remove it by its place, the end of each row." must_say=["99|value", "place|position|end of|any|pixel"] kind="error"
def decode_padded(message):
    flat = np.frombuffer(message.data, dtype=np.uint8)
    pixels = flat[flat != 99]
    return pixels.reshape(message.height, message.width, 3)

# %% name="width before height" origin="new" sentence="The shape begins with the rows: (height, width, 3), not (width, height, 3)." must_say=["height", "width|rows", "first|swap|exchang|begin|wrong way|not \\(width"] kind="shape"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    pixels = rows[:, : message.width * 3]
    return pixels.reshape(message.width, message.height, 3)

# %% name="step before height" origin="new" sentence="Rows come first in a shape: reshape to (height, step), not (step, height)." must_say=["height", "step", "first|swap|exchang|begin|wrong way|not \\(step|rows"] kind="value"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.step, message.height)
    pixels = rows[: message.width * 3]
    return pixels.reshape(message.height, message.width, 3)

# %% name="return forgotten" origin="new" sentence="The array is stored in image, but the function ends without return: give image back." must_say=["return|give .* back", "never|forg|nothing|None|no return|without (a )?return|missing|add (a )?return|end with|end the function|lost"] kind="no-return"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    image = rows[:, : message.width * 3].reshape(message.height, message.width, 3)

# %% name="channels reversed" origin="new" sentence="You turned the channels around, but the task wants them in the order of data: leave [..., ::-1] out." must_say=["channel|red and blue|::-1", "order|revers|swap|as they|leave|turn"] kind="value"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    image = rows[:, : message.width * 3].reshape(message.height, message.width, 3)
    return image[..., ::-1]

# %% name="loop with rows of width times three" origin="new" sentence="Row r begins at byte r * step, because of the padding; you compute r * width * 3." must_say=["step", "begin|padd|row"] kind="value"
def decode_padded(message):
    image = np.zeros((message.height, message.width, 3), dtype=np.uint8)
    for row in range(message.height):
        for column in range(message.width):
            position = (row * message.width + column) * 3
            image[row, column] = list(message.data[position : position + 3])
    return image

# %% name="one byte too far" origin="new" sentence="Counting begins at 0, and 1 : leaves the first byte of each row out, so every pixel begins one byte too late: write rows[:, : width * 3]." must_say=["first byte|from 0|one byte|shift|begin", "byte|row|\\[:, :"] kind="value"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    pixels = rows[:, 1 : message.width * 3 + 1]
    return pixels.reshape(message.height, message.width, 3)

# %% name="the lesson's padded message" origin="new" sentence="You decode padded of an earlier cell, not the message that your function receives: use the parameter message." must_say=["padded|another cell|other cell|earlier cell", "message|argument|parameter"] kind="other-cell"
def decode_padded(message):
    rows = np.frombuffer(padded.data, dtype=np.uint8).reshape(padded.height, padded.step)
    return rows[:, : padded.width * 3].reshape(padded.height, padded.width, 3)

# %% name="step used as a function" origin="new" sentence="step is a number, not a function: write message.step without brackets." must_say=["step|number|not callable|int", "not a function|callable|without|parenthes|bracket"] kind="error"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step())
    return rows[:, : message.width * 3].reshape(message.height, message.width, 3)

# %% name="uint16 at the end" origin="new" sentence="The values are right, but the dtype is not: the pixels of rgb8 are uint8, so leave astype(np.uint16) out." must_say=["uint16|values are right", "uint8"] kind="dtype"
def decode_padded(message):
    rows = np.frombuffer(message.data, dtype=np.uint8).reshape(message.height, message.step)
    pixels = rows[:, : message.width * 3]
    return pixels.reshape(message.height, message.width, 3).astype(np.uint16)
